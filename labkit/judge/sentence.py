"""What is said of a mutant: which change of the formula gives the student's output.

A sentence names nothing that only the kit's own solution has: the names in it are those
of the arguments, or stand in the student's own function.
"""

import ast
import builtins
from collections.abc import Sequence
from typing import Any

from labkit.judge.answers import capitalised
from labkit.judge.hypothesis import evidence
from labkit.judge.mistake import Finding
from labkit.judge.mutant import Mutant
from labkit.lesson.starter import function_lines

# What is said of a change where its place says no more.
SAYS = {
    "sign": "one sign is reversed",
    "negated": "one sign is reversed",
    "order": "two operands are in the wrong order",
    "left-out": "a part of the formula is missing",
    "operation": "one operation is wrong",
    "sign-lost": "a sign is lost, because an absolute value is taken",
    "name": "one variable is used in the place of another",
    "index": "an index or a range is wrong",
    "number": "a number in the formula is wrong",
    "factor": "a factor of two is missing, or one too many",
    "bracket": "a bracket opens or closes in the wrong place",
    "transpose": "a transpose is missing, or one too many",
    "inverse": "an inverse is missing, or one too many",
    "squared": "a square is missing, or one too many",
    "exchanged": "two variables are exchanged",
    "scaled": "the result is multiplied or divided by one variable too many",
    "function": "one function is used in the place of another",
    "condition": "a condition is wrong",
    "line": "one line is missing, repeated, or in the wrong place",
    "clamp": "a limit is missing, or is applied on one side only",
    "norm": "a norm or a normalisation is wrong",
    "root": "a square root is missing, or one too many",
    "unit": "a unit is converted that should not be, or is not converted",
    "rounded": "a value is rounded inside the formula",
    "diagonal": "only a part of a matrix is used",
    "entries": "the entries of a vector are in the wrong place",
    "added": "a term is added that does not belong to the formula",
}
OF_A_PART = {
    ast.Add: "a term is missing", ast.Sub: "a term is missing",
    ast.Mult: "a factor is missing", ast.MatMult: "a factor is missing",
    ast.Div: "a division is missing", ast.Pow: "a power is missing",
}  # fmt: skip


def of_mutants(m: Any, found: Sequence[Mutant]) -> Finding:
    """Return what is said of a mutant that gives all answers, or of one of two."""
    says = list(dict.fromkeys(what(one) for one in found))
    texts = [text for one in found if (text := known_text(m, one))]
    first = f"Either {', or '.join(says)}" if len(says) > 1 else capitalised(says[0])
    own = ""
    if texts:
        own = f": your output equals the correct formula {', or '.join(texts)}"
    how = f"{capitalised(m.off())}; that {evidence(True)}"
    return Finding(f"slip-{found[0].kind}", f"{first}{own}. ({how}.)")


def half(m: Any, mutant: Mutant) -> str:
    """Return what is said of one mutant of two; "" where it says too little."""
    text = known_text(m, mutant)
    return f"{what(mutant)} ({text})" if text else ""


def what(mutant: Mutant) -> str:
    """Return what kind of change a mutant is, in words of the formula."""
    node = getattr(mutant.edits[0][0], "node", None)
    if mutant.kind == "left-out":
        if isinstance(node, ast.BinOp):
            return OF_A_PART.get(type(node.op), SAYS["left-out"])
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
            return f"`{ast.unparse(node.func)}` is missing"
    many = len(mutant.edits) > 1
    return SAYS[mutant.kind] + (", in every line of its kind" if many else "")


def known_text(m: Any, mutant: Mutant) -> str:
    """Return "with `kp * e + ed`", or "" where a student has not seen its names."""
    text = mutant.text
    code = text.removeprefix("without ")
    if not text or not _names(code) <= _known(m, mutant):
        return ""
    return f"with `{text}`" if code == text else f"without `{code}`"


def _names(text: str) -> set[str]:
    """Return the names in a text; of what is no Python an unknown one."""
    text = text.replace(", then ", "; ").removesuffix(":")
    for tried in (text, f"{text}: pass"):
        try:
            tree = ast.parse(tried)
        except SyntaxError:
            continue
        return {n.id for n in ast.walk(tree) if isinstance(n, ast.Name)}
    return {""}


def _known(m: Any, mutant: Mutant) -> set[str]:
    """Return the names that a student has seen: arguments, and those of the file."""
    own = function_lines(m.case.source, mutant.body.function.name)[2]
    given = {*m.case.names, *(mutant.body.arguments if mutant.body.own else ())}
    names = {"np", *vars(builtins), *given}
    if mutant.body.own:
        made = {n for n in mutant.body.names if n not in mutant.body.arguments}
        seen = _names_in("\n".join(own))
        module = set(mutant.body.space) - made
        names |= module | (made & seen)
    return names


def _names_in(text: str) -> set[str]:
    try:
        tree = ast.parse(text)
    except SyntaxError:
        return set()
    return {n.id for n in ast.walk(tree) if isinstance(n, ast.Name)}
