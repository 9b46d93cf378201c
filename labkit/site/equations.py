"""Formulas of the library's docstrings, from plain letters to LaTeX.

    latex("V_i = V_(i-1) + S_i qd_i")    V_{i} = V_{i-1} + S_{i} \\dot q_{i}
    inline("It is R^T t.")               It is :math:`R^{T} t`.

A docstring is read in a terminal, too, so its formulas stay in plain letters there:
`qd` is a time derivative, `^T` a transpose, [[a, b], [c, d]] a matrix and [w] a bracket
matrix. What is not certainly a formula stays as it is.
"""

import re
from collections.abc import Iterator

_GREEK = "alpha gamma delta zeta theta Lambda lambda mu xi sigma tau phi omega rho"
GREEK = _GREEK.split()
KNOWN = ["sin", "cos", "cot", "cosh", "sinh", "exp", "log", "det"]  # in LaTeX
OTHERS = ["trace", "tr", "Ad", "ad", "atan"]
# Names of several letters that have a symbol of their own.
NAMES = {
    "kp": "k_p", "kd": "k_d", "ki": "k_i", "dq": r"\delta q", "dt": "dt", "ds": "ds",
    "sdd": r"\ddot s", "dM": "dM", "pi": r"\pi ", "dV": r"\Delta V",
    "delta_q": r"\Delta q", "dq_ds": "q'", "d2q_ds2": "q''", "sd2": r"\mathrm{sd2}",
}  # fmt: skip
WORDS = 2  # of a displayed line that are no symbols; a sentence has more
_LETTER = "|".join([*GREEK, "[A-Za-z]"])
_SYMBOL = re.compile(rf"({_LETTER})(dot|dd|d)?(\d|(?<=[qSB])n)?")
_SECOND = re.compile(r"([QVlf])(xx|uu|ux|x|u)")  # partial derivatives
_DOTS = {"d": r"\dot ", "dot": r"\dot ", "dd": r"\ddot "}
_TOKEN = re.compile(
    r"delta_q(?![a-z])|d2q_ds2|dq_ds|\.\.\.|(?<= )\.(?= )|[A-Za-z]+\d?"
    r"|\d+(?:\.\d+)?|\^-?[A-Za-z\d]+|\^\+|\^|_|  +"
    r"|[-+=/|;,()\[\]<>'×]|\s"
)
_UNIT = re.compile(r"(?<![\w^])((?:kg m|(?:m|rad|1|kg)/s|kg|rad|m|s))\^(\d)(?!\w)")
_SUPERSCRIPTS = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")
# Words of a formula in a sentence: a symbol with what opens and what closes around it.
_OPEN = rf"(?:(?:{'|'.join([*KNOWN, *OTHERS, 'sqrt'])})\(|[-(\[|])*"
_POWER = r"(?:\^(?:\[[^\]\n]*\]|\([^)\n]*\)|-?\w+|\+))"
_BELOW = r"(?:_(?:\(\w[-+]\w\)|[ij]?[a-zA-Z\d]|space|site|body)\b)"
_ATOM = (
    rf"(?:{'|'.join(sorted(NAMES, key=len)[::-1])}|[QVlf](?:xx|uu|ux)"
    rf"|(?:{_LETTER})(?:dot|dd|d)?\d?|[qSB]n|\d+|[a-z]+(?=\^)"
    rf"|(?<=\[)[a-z]+(?=\])|(?:sin|cos)(?=\)))"
)
_TERM = rf"{_OPEN}(?:[\ue000-\ue0ff]|{_ATOM}{_BELOW}?{_POWER}?)(?:[)\]|]{_POWER}?)*"
_WORD = rf"(?:{_TERM}(?:/{_TERM})*|\.\.\.|[-+=/.](?=\s))"
_GAP = r"(?: |\n *(?=\S)(?![-:*]))"
_RUN = re.compile(
    rf"(?<![\w`'^.:/\ue000-\ue0ff])({_WORD}(?:{_GAP}{_WORD})*)(?=[\s,.;:)]|$)"
)
_PARTIAL = re.compile(r"\bd[A-Z]\w*/dq|/dq_")
_CROSS = re.compile(r"\b(omega(?:_\w)?|g) x (?=\w)")
_EDGE = re.compile(r"^(?:[aA](?! sdd)|[-+=/.])\s+|\s+(?:a|[-+=/.]|\.\.\.)$")
_STRONG = re.compile(
    rf"\^|\b(?:sin|cos|exp)\(|{_BELOW}(?<!space)(?<!site)(?<!body)|[\ue000-\ue0ff]"
)
# What stands before and after a part of a longer formula that is not read.
_IN_ANOTHER = re.compile(r"[-+=/(\[|]\s*$"), re.compile(r"\s+[-+=/]\s|[(\[|)]")
_MATRIX = "\ue000"  # the first letter that stands for a matrix in a run


def equations(lines: list[str]) -> list[str] | None:
    """Return indented lines of a docstring as LaTeX, or None if they are no formulas.

    Lines of code have an @ or a call of the kit's own, and a table has no equals sign.
    """
    found = [line.strip() for line in lines if line.strip()]
    if any("@" in line or "`" in line or " = " not in line for line in found):
        return None
    try:
        made = [latex(line) for line in found]
    except ValueError:
        return None
    return None if any(one.count(r"\mathrm{") > WORDS for one in made) else made


def inline(text: str) -> str:
    """Return a docstring whose formulas and powers of units are marked up.

    Code in backquotes, field names such as `:param q:` and indented code stay.
    """
    kept = r"(``?[^`]+``?|^ *:\w+(?: \w+)*:)"
    pieces = re.split(kept, text, flags=re.MULTILINE)
    pieces[::2] = [_marked(piece) for piece in pieces[::2]]
    return "".join(pieces)


def latex(formula: str) -> str:
    """Return a formula of plain letters as LaTeX.

    Raises:
        ValueError: it has a part that no formula has.
    """
    short, matrices = _without_matrices(formula)
    return _plain(re.sub(r"(?<=\w)\+(?=\s=|\s*$|\s\s)", "^+", short), matrices)


def _plain(formula: str, matrices: list[str]) -> str:
    if _PARTIAL.search(formula):
        raise ValueError("a partial derivative")
    crossed = _CROSS.sub(r"\1 × ", formula)
    return "".join(_parts(crossed, matrices)).strip()


def _without_matrices(text: str) -> tuple[str, list[str]]:
    """Return a text with a letter in the place of each [[...]], and these."""
    matrices = list[str]()
    at = 0
    while (at := text.find("[[", at)) >= 0:
        end = _closing(text, at)
        if text[end - 2 : end] == "]]" and "], [" in text[at:end]:
            letter = chr(ord(_MATRIX) + len(matrices))
            matrices.append(text[at:end])
            text = text[:at] + letter + text[end:]
        at += 1
    return text, matrices


def _closing(text: str, at: int) -> int:
    """Return where the bracket at an index is closed, or the end."""
    depth = 0
    for end in range(at, len(text)):
        depth += (text[end] in "([") - (text[end] in ")]")
        if depth == 0:
            return end + 1
    return len(text)


def _marked(prose: str) -> str:
    units = _UNIT.sub(lambda m: m[1] + m[2].translate(_SUPERSCRIPTS), prose)
    short, matrices = _without_matrices(units)

    def role(found: re.Match[str]) -> str:
        return _role(found, matrices)

    marked = _RUN.sub(role, short)
    for i, matrix in enumerate(matrices):  # of those that stand in no formula
        marked = marked.replace(chr(ord(_MATRIX) + i), matrix)
    return marked


def _role(found: re.Match[str], matrices: list[str]) -> str:
    """Return a run as a formula, without what stands at its edges as a word."""
    run = found[1]
    start, end = 0, len(run)
    while edge := _EDGE.search(run[start:end]):
        if edge.start() == 0:
            start += edge.end()
        else:
            end = start + edge.start()
    formula = run[start:end]
    balanced = all(formula.count(a) == formula.count(b) for a, b in ("()", "[]"))
    before, after = (
        found.string[: found.start() + start],
        found.string[found.start() + end :],
    )
    inner = _IN_ANOTHER[0].search(before) or _IN_ANOTHER[1].match(after)
    alone = not inner or (before.endswith("(") and after.startswith(")"))
    strong = _STRONG.search(formula) and balanced and formula.count("|") % 2 == 0
    if not (alone and strong):
        return run
    try:
        made = _plain(" ".join(formula.split()), matrices)
    except ValueError:
        return run
    return f"{run[:start]}:math:`{made}`{run[end:]}"


def _parts(formula: str, matrices: list[str]) -> Iterator[str]:
    at = 0
    while at < len(formula):
        if _MATRIX <= formula[at] < "\ue100":
            yield _matrix(matrices[ord(formula[at]) - ord(_MATRIX)])
            at += 1
            continue
        found = _TOKEN.match(formula, at)
        if not found:
            raise ValueError(formula[at:])
        at = found.end()
        if found[0] in ("_", "^"):
            group, at = _group(formula, at)
            yield f"{found[0]}{{{group}}}"
        elif found[0] == "sqrt" and formula[at : at + 1] == "(":
            end = _closing(formula, at)
            yield rf"\sqrt{{{_plain(formula[at + 1 : end - 1], matrices)}}}"
            at = end
        else:
            yield _one(found[0])


def _group(formula: str, at: int) -> tuple[str, int]:
    """Return what stands above or below, as LaTeX, and where it ends."""
    if formula[at : at + 1] in ("(", "["):
        end = _closing(formula, at)
        inner = formula[at + 1 : end - 1] if formula[at] == "(" else formula[at:end]
        return latex(inner), end
    name = re.compile(r"[A-Za-z0-9]+").match(formula, at)
    if not name:
        raise ValueError(formula[at:])
    return (name[0] if len(name[0]) < 3 else rf"\mathrm{{{name[0]}}}"), name.end()


def _matrix(text: str) -> str:
    """Return [[a, b], [c, d]] as a matrix."""
    rows = _split(text[1:-1])
    cells = [" & ".join(map(latex, _split(row[1:-1]))) for row in rows]
    entries = r" \\ ".join(cells)
    return rf"\begin{{bmatrix}}{entries}\end{{bmatrix}}"


def _split(text: str) -> list[str]:
    """Return the parts between commas that stand in no bracket."""
    parts, depth = [""], 0
    for letter in text:
        depth += (letter in "([") - (letter in ")]")
        if letter == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    return [part.strip() for part in parts]


def _one(token: str) -> str:
    """Return a token as LaTeX."""
    operators = {"...": r"\cdots ", ".": r"\cdot ", "×": r"\times "}
    if token in operators:
        return operators[token]
    if token.startswith("^"):
        above = token[1:]
        return f"^{{{_name(above) if above in GREEK else above}}}"
    if token.isspace():
        return " " if len(token) == 1 else r" \qquad "
    return _name(token) if token[0].isalpha() else token


def _name(word: str) -> str:
    """Return a name as LaTeX: a function, a symbol with dots and index, or a word."""
    if word in OTHERS:
        return rf"\mathrm{{{word}}} "
    if word in NAMES or word in KNOWN:
        return NAMES.get(word, rf"\{word} ")
    if found := _SECOND.fullmatch(word):
        return rf"{found[1]}_{{{found[2]}}}"
    found = _SYMBOL.fullmatch(word)
    if not found:
        return rf"\mathrm{{{word}}}"
    letter, dots, index = found.groups()
    made = _DOTS.get(dots, "") + (rf"\{letter} " if letter in GREEK else letter)
    return made + (f"_{{{index}}}" if index else "")
