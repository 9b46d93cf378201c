"""What is said of a mutant: which change of the formula gives the student's output.

A sentence names nothing that only the kit's own solution has: the names in it are those
of the arguments, or stand in the student's own function.
"""

import ast
import builtins
import copy
from collections.abc import Sequence
from typing import Any

from labkit.judge.answers import capitalised
from labkit.judge.form import is_of_its_form
from labkit.judge.hypothesis import evidence
from labkit.judge.mistake import REDONE, Finding
from labkit.judge.mutant import Mutant
from labkit.judge.own_line import Line, OwnFunction
from labkit.judge.statements import Block
from labkit.lesson.lab_module import definition
from labkit.lesson.starter import function_lines

MODULES = ("np", "se3", "screws", "math")
EVERYWHERE = ", in every line of its kind"  # of a change that is made in several places

# What is said of a change where its place says no more.
SAYS = {
    "sign": "one sign is reversed",
    "negated": "one sign is reversed",
    "order": "two operands are in the wrong order",
    "left-out": "a part of the formula is missing",
    "operation": "one operator is wrong",
    "sign-lost": "a sign is lost, because the code takes an absolute value",
    "name": "one variable is used where another belongs",
    "index": "an index or a range is wrong",
    "number": "a number in the formula is wrong",
    "factor": "a factor of two is missing, or there is one too many",
    "bracket": "a bracket opens or closes in the wrong place",
    "transpose": "a transpose is missing, or there is one too many",
    "inverse": "an inverse is missing, or there is one too many",
    "squared": "a square is missing, or there is one too many",
    "exchanged": "two variables are swapped",
    "scaled": "the result is multiplied or divided by one variable too many",
    "function": "one function is used where another belongs",
    "condition": "a condition is wrong",
    "line": "one line is missing, repeated, or in the wrong place",
    "clamp": "a limit is missing, or it is applied only on one side",
    "norm": "a norm or a normalisation is wrong",
    "root": "a square root is missing, or there is one too many",
    "unit": "a unit conversion is missing, or there is one too many",
    "rounded": "a value is rounded inside the formula",
    "diagonal": "only a part of a matrix is used",
    "entries": "the entries of a list or vector are in the wrong order",
    "entry-zero": "one entry of a list or vector is missing, as if it were 0",
    "entry-twice": "one entry of a list or vector is used where another belongs",
    "entry-some": "only some entries of a list or vector are used",
    "added": "a term that does not belong to the formula is added",
}
# Kinds that are true of the numbers, whatever algorithm gives them.
TELLING = {
    "sign", "negated", "sign-lost", "left-out", "factor", "transpose", "inverse",
    "squared", "root", "exchanged", "order", "unit", "rounded",
}  # fmt: skip
ORDERED = {ast.List: "entries", ast.Tuple: "entries", ast.Call: "arguments"}
OF_A_PART = {
    ast.Add: "a term is missing", ast.Sub: "a term is missing",
    ast.Mult: "a factor is missing", ast.MatMult: "a factor is missing",
    ast.Div: "a division is missing", ast.Pow: "a power is missing",
}  # fmt: skip


def of_mutants(m: Any, found: Sequence[Mutant]) -> Finding:
    """Return what is said of a mutant that gives all answers, or of one of two.

    One whose line stands in the student's function is the likeliest.
    """
    found = next(([one] for one in found if own_line(m, one)), list(found[:2]))
    texts = [known_text(m, one) for one in found]
    says = _of_the_formula(m, found[0])
    if len(found) > 1 and all(texts):
        some = list(dict.fromkeys(what(one) for one in found))
        says = f"either {', or '.join(some)}" if len(some) > 1 else some[0]
        says += f"{WRITTEN} {' or '.join(texts)}"
    how = m.with_error(f"{REDONE} {evidence(True)}")
    return Finding(f"slip-{found[0].kind}", f"{capitalised(says)}. {how}")


def _of_the_formula(m: Any, mutant: Mutant) -> str:
    """Return `told`, as a change of the correct formula where no line has it.

    Another algorithm may have no such bracket or number, although its output equals
    that of the changed formula.
    """
    says = told(m, mutant)
    known = own_line(m, mutant) or known_text(m, mutant)
    if mutant.kind in TELLING or known:
        return says
    return f"your code gives the result of the correct formula with one change: {says}"


def shows(m: Any, mutant: Mutant) -> bool:
    """Return whether a student can see where a mutant's change would be."""
    return bool(own_line(m, mutant) or known_text(m, mutant) or glosses(mutant))


WRITTEN = ", which gives the wrong expression"
LONG = 80  # characters; a longer line is named by its number alone
COMPARES = (ast.Compare, ast.IfExp, ast.BoolOp)
CHOOSES = ("where", "clip", "min", "max", "minimum", "maximum", "argmin", "argmax")


def has_its_kind(m: Any, mutant: Mutant) -> bool:
    """Return whether the student's function can have a mutant's mistake.

    A condition is wrong only in a function that compares something; of another right
    body, which bisects, say, such a mutant is a formula's mistake by another name.
    """
    if mutant.kind != "condition":
        return True
    try:
        own = definition(m.case.source, mutant.body.name)
    except (SyntaxError, ValueError):
        own = None
    if own is None:  # nothing is known of it
        return True
    return any(
        isinstance(node, COMPARES)
        or (getattr(node, "attr", None) or getattr(node, "id", "")) in CHOOSES
        for node in ast.walk(own)
    )


def is_in_its_form(m: Any, mutant: Mutant) -> bool:
    """Return whether a mutant's sentence is about something in the student's function.

    The lab's form is the one that the guide teaches; another right function may have
    steps that the student's has not.
    """
    if mutant.body.own or own_line(m, mutant):
        return True
    own = _own_function(m, mutant)
    others = [body.function for body in m.bodies]
    return own is None or is_of_its_form(own.own, mutant, others)


def tells(mutant: Mutant) -> bool:
    """Return whether a mutant's kind says enough without a place.

    "A division is missing" does, and "a part of the formula is missing" does not.
    """
    return mutant.kind in TELLING and what(mutant) != SAYS["left-out"]


def half(m: Any, mutant: Mutant) -> str:
    """Return what is said of one mutant of two; "" where it says too little."""
    return told(m, mutant) if shows(m, mutant) else ""


def told(m: Any, mutant: Mutant) -> str:
    """Return a clause on a mutant that stands alone."""
    if line := own_line(m, mutant):
        code = f", `{line.text}`" if len(line.text) <= LONG else ""
        return f"in line {line.number}{code}, {what(mutant, line)}"
    if text := known_text(m, mutant):
        return f"{what(mutant)}{WRITTEN} {text}"
    says = f"{what(mutant)}{_or_transposed(mutant)}"
    if not (steps := glosses(mutant)):
        return says
    where = " and ".join(f'"{step}"' for step in steps)
    each = "step" if len(steps) == 1 else "steps"
    return f"{says.removesuffix(EVERYWHERE)} in the {each} {where}"


def _or_transposed(mutant: Mutant) -> str:
    """Return the other name of a matrix product's wrong order: x A is A^T x."""
    product = isinstance(getattr(mutant.edits[0][0].node, "op", None), ast.MatMult)
    return ", or a transpose is missing" if mutant.kind == "order" and product else ""


def what(mutant: Mutant, line: Line | None = None) -> str:
    """Return what kind of change a mutant is, in words of the formula.

    Args:
        mutant: one that gives the student's answers.
        line: the student's line, whose names may be said.
    """
    place, new = mutant.edits[0]
    if isinstance(place, Block):
        return place.says
    says = _of_an_expression(mutant, place.node, new, line) or SAYS[mutant.kind]
    return says + EVERYWHERE * (len(mutant.edits) > 1)


def _of_an_expression(
    mutant: Mutant, node: Any, new: ast.expr, line: Line | None
) -> str:
    """Return how an expression differs, with names where a line is known, or ""."""
    is_sum = isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add | ast.Sub)
    if mutant.kind == "left-out":
        if isinstance(node, ast.BinOp):
            return OF_A_PART.get(type(node.op), "")
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
            return f"`{ast.unparse(node.func)}` is missing"
    if mutant.kind == "factor" and (size := _size(new)):
        return f"one value is {size} as large as it should be"
    if mutant.kind == "sign" and is_sum and (its := _own(node.right, line)):
        return f"the sign of `{its}` is reversed"
    if mutant.kind == "name" and isinstance(new, ast.Name) and (its := _own(new, line)):
        return _another_name(mutant, node, new, its)
    if mutant.kind == "order" and (parts := ORDERED.get(type(node))):
        return f"two {parts} are in the wrong order"
    if mutant.kind == "order" and isinstance(node, ast.BinOp):
        pair = [_own(one, line) for one in (node.left, node.right)]
        if all(pair):
            return f"`{pair[0]}` and `{pair[1]}` are in the wrong order"
    return ""


def _size(new: ast.expr) -> str:
    """Return "twice" of 2.0 * x, "half" of 0.5 * x, or ""."""
    factor: Any = getattr(getattr(new, "left", None), "value", None)
    product = isinstance(getattr(new, "op", None), ast.Mult)
    return {2.0: "twice", 0.5: "half"}.get(factor, "") if product else ""


def _another_name(mutant: Mutant, node: ast.expr, new: ast.Name, its: str) -> str:
    """Return which variable is wrong, and what belongs there if that has a gloss."""
    meaning = mutant.body.meaning(new.id)
    wrong = f"`{its}` ({meaning})" if meaning else f"`{its}`"
    right = mutant.body.meaning(node.id) if isinstance(node, ast.Name) else ""
    other = f"another value ({right}) belongs" if right else "another value belongs"
    return f"{wrong} is used where {other}"


def _own(node: ast.expr, line: Line | None) -> str:
    """Return an expression in the student's names; "" where one is not known."""
    if line is None:
        return ""
    found = copy.deepcopy(node)
    for one in (n for n in ast.walk(found) if isinstance(n, ast.Name)):
        known = one.id in line.names
        one.id = line.names.get(one.id, one.id)
        if not known and isinstance(one.ctx, ast.Load) and one.id not in MODULES:
            return ""
    return ast.unparse(found)


def own_line(m: Any, mutant: Mutant) -> Line | None:
    """Return the student's line that has a mutant's change; None without one."""
    own = _own_function(m, mutant)
    if own is None or len(mutant.edits) > 1:
        return None
    with mutant.made():
        changed = mutant.statement()
        return own.line(changed) if changed else None


def _own_function(m: Any, mutant: Mutant) -> OwnFunction | None:
    reference = mutant.body.function
    key = f"own {id(reference)}"
    if key not in m.known:
        try:
            own = definition(m.case.source, mutant.body.name)
        except (SyntaxError, ValueError):
            own = None
        m.known[key] = own and OwnFunction(own, reference)
    return m.known[key]


def glosses(mutant: Mutant) -> list[str]:
    """Return what the reference's changed lines are; none if a comment is missing."""
    lines = [getattr(place.node, "lineno", 0) for place, _ in mutant.edits]
    steps = dict.fromkeys(mutant.body.glosses.get(line, "") for line in lines)
    return list(steps) if all(steps) else []


def known_text(m: Any, mutant: Mutant) -> str:
    """Return the changed formula, or "" where a student has not seen its names."""
    text = mutant.text
    code = text.removeprefix("without ")
    names = _names(code)
    if not names - set(MODULES) or not names <= _known(m, mutant):
        return ""
    return f"`{text}`" if code == text else f"the formula without `{code}`"


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
    own = function_lines(m.case.source, mutant.body.name)[2]
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
