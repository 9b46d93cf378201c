"""The student's worksheet: definitions in their own words, answers, drawings."""

import re
from collections import Counter

from labkit.base.text import count, visible
from labkit.handin.handin import Handin, Item, image_names, picture_path
from labkit.lesson.day import Day

FEWEST_WORDS, FEWEST_DIFFERENT = 8, 5  # the shortest definition
SHINGLE = 5  # words in a row that count as taken over
TAKEN_OVER = 0.5  # share of a definition's shingles that may stand in the lab guide
DRAWN_LINES = 3  # the shortest drawing made of text
FEWEST_ANSWER_WORDS = 4  # "Its own: multiply right." answers a question
# The same text twice is pasted where it is as long as a definition, a shorter one from
# three times on; below an answer's length ("yes", a number) it is no sentence at all.
PASTED = {FEWEST_WORDS: 2, FEWEST_ANSWER_WORDS: 3}  # times, by words
LONGEST = 2000  # characters of a line that are looked at

# The next action for a definition or a drawing, by its state.
_DEFINE = {
    "empty": "Still empty: {}.",
    "short": f"Write a whole sentence (at least {FEWEST_WORDS} words): {{}}.",
    "taken": "Copied from the guide: {}. Use your own words.",
}
_DRAW = {
    "missing": "Drawing {}: add ![](photo.jpg), or draw it as text, of "
    f"{DRAWN_LINES} lines or more, between two lines of ```.",
    "broken": "Drawing {}: its image file is not there. A picture is a file of your "
    "own, such as ../figures/photo.jpg, and no web address.",
    "kits": "Drawing {}: the kit's picture; draw your own.",
}

_COMMENT = re.compile(r"<!(?=--).*?-->", re.DOTALL)
# Searched in one line, without the spaces around it: no search takes long.
_FENCE = re.compile(r"```|~~~")
_QUESTION = re.compile(r"\d+[.)]\s+\S")
# A template's own words: quoted instructions, those in italics and brackets, and lines
# to write on. What somebody types between the template's asterisks is theirs.
_PROMPT = re.compile(r">.*|\*\([^*]*\)\*|_\([^_]*\)_|[._\s…]*|TODO.*")
# Where people put no spaces between words, a letter counts as one.
_ALONE = "\u0e00-\u0eff\u1000-\u109f\u1780-\u17ff\u3040-\u30ff\u3400-\u9fff"
_WORD = re.compile(f"[{_ALONE}]|[^\\W_{_ALONE}]+")


def check_worksheet(day: Day, handin: Handin) -> list[Item]:
    """Check the day's worksheet: what is written, and the drawings.

    Args:
        day: from the kit's manifest.
        handin: what the student's folder holds.
    """
    where = day.files["worksheet"]
    names = ("definitions", "drawings")
    data = handin.files.get(where)
    if data is None:
        return [Item(name, "todo", f"{where} is not there.") for name in names]
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        says = f"{where} cannot be read as text in UTF-8."
        return [Item(name, "wrong", says) for name in names]
    sections = split_sections(_without_comments(text))
    try:
        guide = (day.folder / day.guide).read_text("utf-8")
    except OSError:
        guide = ""
    return [
        _texts(sections, day, guide, where),
        _drawings(sections, day, handin, where),
    ]


def _without_comments(text: str) -> str:
    """Return Markdown without its comments; one that is never closed stays."""
    closed, end, rest = text.rpartition("-->")  # then every later "<!--" has its end
    return _COMMENT.sub("", closed + end) + rest


def split_sections(text: str) -> dict[str, str]:
    """Return {heading in lower case: the text below it, with its subsections}.

    Args:
        text: Markdown. A `#` inside a fenced block is no heading.
    """
    sections: dict[str, list[str]] = {}
    open_now: list[tuple[int, str]] = []
    fenced = False
    for line in text.splitlines():
        line = line[:LONGEST]
        if _FENCE.match(line.strip()):
            fenced = not fenced
        level = len(line) - len(line.lstrip("#"))
        if not fenced and 1 <= level <= 6 and line[level : level + 1].isspace():
            name = line.strip("# \t").strip(" *_`").lower()
            open_now = [(depth, other) for depth, other in open_now if depth < level]
            open_now.append((level, name))
            sections.setdefault(name, [])
        else:
            for _, name in open_now:
                sections[name].append(line)
    return {name: "\n".join(lines) for name, lines in sections.items()}


def _texts(sections: dict[str, str], day: Day, guide: str, where: str) -> Item:
    """Check what is written: the definitions, the answers, and the predictions.

    The message has a line for each of them that is still open.
    """
    given = _shingles(_words(guide))
    texts = {term: sections.get(term.lower(), "") for term in day.terms}
    states = {term: _definition(text, given) for term, text in texts.items()}
    item = _item("definitions", states, _DEFINE, where)
    answers = _answers(sections.get("can you explain?", ""), day.questions)
    table = sections.get("predictions", "")
    written = [_words(_without_template(text)) for text in texts.values()]
    pasted = _pasted([*written, *answers], _reasons(table))
    left = _still_open(answers, _blank_cells(table), pasted)
    if not left:
        return item
    status = "wrong" if pasted else item.status
    if not item.passed:
        return Item(item.name, status, "\n".join([item.message, *left.values()]))
    (first, says), *others = left.items()
    lines = [f"{says[:-1]}, in {where}.", *(line for _, line in others)]
    if day.terms and not pasted:
        lines.append("All definitions are there.")
    status = "wrong" if pasted else "todo"
    return Item(item.name, status, "\n".join(lines), upcoming=first)


def _still_open(answers: list[list[str]], blank: int, pasted: str) -> dict[str, str]:
    """Return {part of the worksheet that is still open: what to do in it}, in order.

    Args:
        answers: the words of each answer, [] where there is none.
        blank: how many cells of the table of predictions are empty.
        pasted: what to say of a repeated sentence, or "".
    """
    numbers = ", ".join(str(i) for i, words in enumerate(answers, start=1) if not words)
    explain = f"Can you explain? {numbers}: answer below each question."
    cells = f"Predictions: {count(blank, 'cell')} still to fill in."
    lines = {
        "repeated sentence": pasted,
        'answers to "Can you explain?"': explain if numbers else "",
        "table of predictions": cells if blank else "",
    }
    return {part: line for part, line in lines.items() if line}


def _blank_cells(section: str) -> int:
    """Return how many cells of a table nobody has filled in."""
    rows = (line.strip() for line in section.splitlines())
    cells = (c for row in rows if row[:1] == "|" for c in row.strip("|").split("|"))
    return sum(bool(_PROMPT.fullmatch(cell.strip())) for cell in cells)


def _reasons(section: str) -> list[list[str]]:
    """Return the words of the last cell of each row: why the two numbers differ."""
    rows = (line.strip() for line in section.splitlines())
    return [_words(row.strip("|").rpartition("|")[2]) for row in rows if row[:1] == "|"]


def _pasted(answers: list[list[str]], reasons: list[list[str]]) -> str:
    """Return what to say of a sentence that stands in several places, or ""."""
    told = Counter(map(tuple, answers))
    for words, times in (told + Counter(map(tuple, reasons))).items():
        # Two predictions may be apart, or right, for one reason; three rarely are.
        alone = max(told[words], times - 1)
        if any(len(words) >= long and alone >= most for long, most in PASTED.items()):
            says = visible(" ".join(words), 60)
            return f'The same sentence {times} times, but each needs its own: "{says}".'
    return ""


def _answers(section: str, number: int) -> list[list[str]]:
    """Return the words of the answer to each question, [] where it has none.

    A question ends with the last question mark of its first paragraph; what comes
    after it is the answer.
    """
    found: list[list[str]] = []
    for line in section.splitlines():
        if _QUESTION.match(line.strip()):
            found.append([])
        if found:
            found[-1].append("" if _PROMPT.fullmatch(line.strip()) else line)
    answered = []
    for lines in found:
        first, _, rest = "\n".join(lines).partition("\n\n")
        answer = first.rpartition("?")[2] if "?" in first else ""
        words = _words(f"{answer} {rest}")
        answered.append(words if len(words) >= FEWEST_ANSWER_WORDS else [])
    return (answered + [[]] * number)[:number]


def _without_template(text: str) -> str:
    """Return a section without the template's own lines."""
    lines = (line for line in text.splitlines() if not _PROMPT.fullmatch(line.strip()))
    return " ".join(lines)


def _definition(text: str, given: set[tuple[str, ...]]) -> str:
    """Return how a definition stands: in a sentence, and not in the guide's words."""
    words = _words(_without_template(text))
    own = _shingles(words)
    if not words:
        return "empty"
    if len(words) < FEWEST_WORDS or len(set(words)) < FEWEST_DIFFERENT:
        return "short"
    return "taken" if own and len(own & given) > TAKEN_OVER * len(own) else "done"


def _drawings(sections: dict[str, str], day: Day, handin: Handin, where: str) -> Item:
    """Check that each drawing is an image of the student's, or drawn as text."""
    states = {}
    for index in map(str, range(1, day.drawings + 1)):
        start = rf"drawing {index}\b"  # "Drawing 1: the hand's frame"
        named = (body for name, body in sections.items() if re.match(start, name))
        states[index] = _drawing(next(named, ""), handin, where)
    return _item("drawings", states, _DRAW, where)


def _item(name: str, states: dict[str, str], says: dict[str, str], where: str) -> Item:
    """Return how a deliverable stands by the states of its parts: "done", or in `says`.

    The first state there is that of a part nobody has begun.
    """
    found = list(states.values())
    done = found.count("done")
    if done == len(found):
        return Item(name)
    told = [f"{done} of {len(found)} in {where}."]
    for state, to_do in says.items():
        if state in found:
            parts = ", ".join(part for part, its in states.items() if its == state)
            told.append(to_do.format(parts))
    begun = set(found) != {next(iter(says))}
    return Item(name, "wrong" if begun else "todo", " ".join(told))


def _drawing(text: str, handin: Handin, where: str) -> str:
    """Return how one drawing stands."""
    if _is_drawn(text):
        return "done"
    addresses = image_names(text)
    paths = [picture_path(address, where) for address in addresses]
    kits = [handin.pictures[path] for path in paths if path in handin.pictures]
    if kits:
        return "kits" if all(kits) else "done"
    return "broken" if addresses else "missing"


def _is_drawn(text: str) -> bool:
    """Return whether a fenced block holds a drawing made of characters."""
    fenced, lines = False, 0
    for line in text.splitlines():
        if _FENCE.match(line.strip()):
            fenced = not fenced
        elif fenced and line.strip():
            lines += 1
    return lines >= DRAWN_LINES


def _words(text: str) -> list[str]:
    return _WORD.findall(text.lower())


def _shingles(words: list[str]) -> set[tuple[str, ...]]:
    return {tuple(words[i : i + SHINGLE]) for i in range(len(words) - SHINGLE + 1)}
