"""What is said of a mutant: which change of the formula gives the student's output.

A sentence names nothing that only the kit's own solution has: the names in it are those
of the arguments, or stand in the student's own function.
"""

import ast
import builtins
import copy
import re
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any

from labkit.judge.answers import SYMBOLS, capitalised, listed
from labkit.judge.form import is_like, is_of_its_form
from labkit.judge.hypothesis import evidence
from labkit.judge.mistake import AS_A_SOLUTION, REDONE, Finding
from labkit.judge.mutant import Mutant
from labkit.judge.operators import called
from labkit.judge.own_line import Line, OwnFunction
from labkit.judge.statements import Block
from labkit.lesson.lab_module import definition
from labkit.lesson.starter import function_lines

MODULES = ("np", "se3", "screws", "math")
NO_NAMES: Mapping[str, str] = MappingProxyType({})
EVERYWHERE = ", in every similar line"  # of a change that is made in several places

# What "your code" does, where the place of a change says no more.
SAYS = {
    "sign": "reverses one sign",
    "negated": "reverses one sign",
    "order": "puts two operands in the wrong order",
    "left-out": "omits a part of the formula",
    "operation": "uses a wrong operator",
    "sign-lost": "makes a negative value positive",
    "name": "uses a wrong value",
    "index": "uses a wrong index or range",
    "number": "uses a wrong number in the formula",
    "factor": "omits a factor of two, or has one too many",
    "bracket": "opens or closes a bracket in the wrong place",
    "transpose": "omits a transpose, or has one too many",
    "inverse": "omits an inverse, or has one too many",
    "squared": "omits a square, or has one too many",
    "exchanged": "swaps two variables",
    "scaled": "multiplies or divides the result by one variable too many",
    "function": "calls a wrong function",
    "condition": "has a wrong condition",
    "line": "omits one line, repeats it, or has it in the wrong place",
    "clamp": "omits a limit, or applies it only on one side",
    "norm": "uses a wrong norm or normalisation",
    "root": "omits a square root, or has one too many",
    "unit": "omits a unit conversion, or has one too many",
    "rounded": "rounds a value inside the formula",
    "diagonal": "uses only a part of a matrix",
    "entries": "puts the entries of a list or vector in the wrong order",
    "entry-zero": "omits one entry of a list or vector, as if it were 0",
    "entry-twice": "uses a wrong entry of a list or vector",
    "entry-some": "uses only some entries of a list or vector",
    "added": "adds a term that does not belong to the formula",
}
OF_FACTORS = {  # by the factor that is one too many
    2.0: "has a factor of two too many, or omits a division by two",
    0.5: "omits a factor of two, or divides by two",
}
# Kinds that are true of the numbers, whatever algorithm gives them.
TELLING = {
    "sign", "negated", "sign-lost", "left-out", "factor", "transpose", "inverse",
    "squared", "root", "exchanged", "order", "unit", "rounded",
}  # fmt: skip
# Kinds of a formula as it is written, which another one need not have.
OF_A_FORM = {
    "number", "scaled", "function", "name", "bracket", "line", "clamp", "added",
}  # fmt: skip
OF_A_VALUE = TELLING - {"left-out", "exchanged", "order"}
CLAMPS = {  # that a value has where the reference has none
    ("maximum", "0.0"): "sets negative values to 0",
    ("minimum", "1.0"): "sets values above 1 to 1",
    ("clip", "0.0", "1.0"): "clamps a value to [0, 1]",
    ("clip", "-1.0", "1.0"): "clamps a value to [-1, 1]",
}
ORDERED = {ast.List: "entries", ast.Tuple: "entries", ast.Call: "arguments"}
OF_A_PART = {
    ast.Add: "omits a term", ast.Sub: "omits a term",
    ast.Mult: "omits a factor", ast.MatMult: "omits a factor",
    ast.Div: "omits a division", ast.Pow: "omits an exponent",
}  # fmt: skip


def of_mutants(m: Any, found: Sequence[Mutant]) -> Finding:
    """Return what is said of the likeliest of some mutants that give all answers.

    It is one that stands in the student's function, else the first.
    """
    one = next((one for one in found if _in_own_words(m, one)), found[0])
    says = _sentences(m, one)
    if says.startswith(AS_A_SOLUTION):  # which is the evidence
        return Finding(f"slip-{one.kind}", f"{says} {m.off()}".rstrip())
    how = m.with_error(f"{REDONE} {evidence(True)}")
    return Finding(f"slip-{one.kind}", f"{says} {how}")


def _in_own_words(m: Any, mutant: Mutant) -> bool:
    """Return whether the student's function has a mutant's line or expression."""
    return bool(own_line(m, mutant) or own_expressions(m, mutant))


def _sentences(m: Any, mutant: Mutant) -> str:
    """Return what a student's code does, and the line or the expression that does."""
    if line := own_line(m, mutant):
        text = f": `{line.text}`" if len(line.text) <= LONG else ""
        used = _or_where_used(mutant, line)
        where = f"The wrong line is line {line.number}{text}{used}."
        return f"Your code {what(mutant, line)}. {where}"
    if texts := own_expressions(m, mutant):
        verb = "expression is" if len(texts) == 1 else "expressions are"
        does = what(mutant, given=_arguments(m, mutant))
        return f"Your code {does}. The wrong {verb} {listed(texts)}."
    if not _own_function(m, mutant) and tells(mutant):
        return f"{capitalised(told(m, mutant))}."
    # Without a place in the student's own text it may have no such sign or step,
    # although its output is the same.
    says = told(m, mutant).removeprefix("your code ")
    which = "whose code" if says.startswith("for ") else "that"
    return f"{AS_A_SOLUTION} {which} {says}."


def _or_where_used(mutant: Mutant, line: Line) -> str:
    """Return that a change of all that is assigned may belong where its name is used.

    A factor that is missing in `f_n = ...` may be missing in `fraction * f_n`.
    """
    place, _ = mutant.edits[0]
    whole = not isinstance(place, Block) and isinstance(place.parent, ast.Assign)
    if not whole or mutant.kind not in OF_A_VALUE | {"left-out"}:
        return ""
    name = line.text.partition(" = ")[0]
    return f", or one that uses `{name}`" if name.isidentifier() else ""


def shows(m: Any, mutant: Mutant) -> bool:
    """Return whether a mutant's sentence says where a change is, or enough without.

    A changed formula whose names a student has seen is told by its kind alone.
    """
    if _in_own_words(m, mutant):
        return True
    if glosses(mutant):
        function = mutant.body.function
        steps = function.body[bool(ast.get_docstring(function)) :]
        # That a mistake is in the only step says nothing.
        return len(steps) > 1 or not _is_of_a_form(mutant)
    return tells(mutant) and is_known(m, mutant)


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
    own = _own_function(m, mutant)
    if own is None or _in_own_words(m, mutant):
        return True
    if not _has_its_call(own.own, mutant):
        return False
    others = [body.function for body in m.bodies]
    return mutant.body.own or is_of_its_form(own.own, mutant, others)


def _has_its_call(own: ast.FunctionDef, mutant: Mutant) -> bool:
    """Return whether a student calls the function whose arguments a mutant swaps."""
    node = mutant.edits[0][0].node
    if mutant.kind != "order" or not isinstance(node, ast.Call):
        return True
    calls = (one for one in ast.walk(own) if isinstance(one, ast.Call))
    return any(called(one) == called(node) for one in calls)


def tells(mutant: Mutant) -> bool:
    """Return whether a mutant's kind says enough without a place.

    "Your code omits a division" does, and "omits a part of the formula" does not.
    """
    return mutant.kind in TELLING and what(mutant) != SAYS["left-out"]


def tells_of(m: Any, mutant: Mutant) -> bool:
    """Return whether a mutant's kind says enough of the student's own function.

    In another form a factor of two may stand for any term.
    """
    return tells(mutant) and (mutant.kind != "factor" or _is_like(m, mutant))


def _is_like(m: Any, mutant: Mutant) -> bool:
    """Return whether the student's function is written like a mutant's, if known."""
    own = _own_function(m, mutant)
    return own is None or is_like(own.own, own.reference)


def is_in_another_form(m: Any) -> bool:
    """Return whether the student's function is written like no right one, if known."""
    if "another form" not in m.known:
        rights = m.ask.bodies
        try:
            own = definition(m.case.source, rights[0].name) if rights else None
        except (SyntaxError, ValueError):
            own = None
        alike = own is None or any(is_like(own, one.function) for one in rights)
        m.known["another form"] = not alike
    return bool(m.known["another form"])


def half(m: Any, mutant: Mutant) -> str:
    """Return what is said of one mutant of two; "" where it says too little."""
    return told(m, mutant) if shows(m, mutant) else ""


def told(m: Any, mutant: Mutant) -> str:
    """Return a clause on a mutant that stands alone."""
    if line := own_line(m, mutant):
        code = f", `{line.text}`" if len(line.text) <= LONG else ""
        return f"in line {line.number}{code}, your code {what(mutant, line)}"
    given = _arguments(m, mutant)
    if texts := own_expressions(m, mutant):
        does = what(mutant, given=given).removesuffix(EVERYWHERE)
        return f"in {listed(texts)}, your code {does}"
    does = f"{what(mutant, given=given)}{_or_transposed(mutant)}"
    if not (steps := glosses(mutant)):
        return f"your code {does}"
    if _is_of_a_form(mutant):
        does = "contains a mistake"
    return f"your code {for_steps(steps)} {does.removesuffix(EVERYWHERE)}"


def _is_of_a_form(mutant: Mutant) -> bool:
    """Return whether a change is one of a text, as of the arguments of a call."""
    swaps = mutant.kind == "order" and isinstance(mutant.edits[0][0].node, ast.Call)
    return swaps or mutant.kind in OF_A_FORM


def for_steps(glosses: Sequence[str]) -> str:
    """Return steps as they stand between "your code" and its verb."""
    where = " and ".join(f"for {of_a_step(gloss)}" for gloss in glosses)
    clause = "," in INDEX.sub("", where) and not LISTED.search(where)
    return where + "," * clause


def _arguments(m: Any, mutant: Mutant) -> dict[str, str]:
    """Return the student's names of the reference's arguments."""
    return dict(zip(mutant.body.arguments, m.case.names, strict=False))


# Words with which a gloss begins that is no noun without an article.
DETERMINERS = {
    "the", "a", "an", "its", "those", "each", "every", "both", "all", "no", "half",
    "twice", "one", "two", "four", "at",
}  # fmt: skip
LISTED = re.compile(r"(?:, \S+ and \S+|(?:, \S+){2,})$")  # "of s^2, s and 1"
INDEX = re.compile(r"\[[^]]*\]")  # its comma ends no clause: "entry [a, b]"
NUMBERED = re.compile(r"\w+ (\d+|[b-z])\b")  # "row 1" and "row i"
ADVERBS = {"from", "without", "at", "up", "after", "inward", "outward", "true"}


def of_a_step(gloss: str) -> str:
    """Return a gloss, "overdamped response", as it follows "your code for"."""
    gloss = _briefly(gloss)
    first = gloss.partition(" ")[0]
    if first.lower() in ADVERBS or not first[:1].isalpha():
        return f'the step "{gloss}"'
    word = first.replace("-", "").isalpha() and len(first) > 1
    bare = first.lower() in DETERMINERS or first in SYMBOLS or NUMBERED.match(gloss)
    return f"the {gloss}" if word and not bare else gloss


def _briefly(gloss: str) -> str:
    """Return a gloss without what explains it: "row 1: the x axis" is "row 1"."""
    return re.split(r"[:;] ", gloss)[0]


def _or_transposed(mutant: Mutant) -> str:
    """Return the other name of a matrix product's wrong order: x A is A^T x."""
    product = isinstance(getattr(mutant.edits[0][0].node, "op", None), ast.MatMult)
    return ", or omits a transpose" if mutant.kind == "order" and product else ""


def what(
    mutant: Mutant, line: Line | None = None, given: Mapping[str, str] = NO_NAMES
) -> str:
    """Return what "your code" does that has a mutant's change.

    Args:
        mutant: one that gives the student's answers.
        line: the student's line, whose names may be said.
        given: the student's names of the reference's arguments.
    """
    place, new = mutant.edits[0]
    if isinstance(place, Block):
        return place.says
    several = len(mutant.edits) > 1
    if mutant.kind == "factor" and (says := _of_a_factor(new, line, given)):
        return says + EVERYWHERE * (several and not line)
    says = _of_an_expression(mutant, place.node, new, line) or SAYS[mutant.kind]
    if mutant.kind == "factor" and not _divides(mutant, place.node):
        match new:
            case ast.BinOp(ast.Constant(float(factor)), ast.Mult()):
                says = OF_FACTORS.get(factor, says)
    return says + EVERYWHERE * several


def _divides(mutant: Mutant, node: ast.expr) -> bool:
    """Return whether an expression is in a denominator, where twice makes a half."""
    divisions = (
        one.right
        for one in ast.walk(mutant.body.function)
        if isinstance(one, ast.BinOp) and isinstance(one.op, ast.Div)
    )
    return any(one is node for right in divisions for one in ast.walk(right))


def _of_a_factor(new: ast.expr, line: Line | None, given: Mapping[str, str]) -> str:
    """Return which value is multiplied by 2 or 0.5, if it is one that can be named."""
    match new:
        case ast.BinOp(ast.Constant(2.0 | 0.5 as factor), ast.Mult(), value):
            its = _own(value, line.names if line else given)
        case _:
            return ""
    if not its or len(its) > LONG:
        return ""
    if line:
        return f"multiplies `{its}` by {factor:g}"
    return f"uses {'twice' if factor == 2.0 else 'half of'} `{its}`"


def _of_an_expression(
    mutant: Mutant, node: Any, new: ast.expr, line: Line | None
) -> str:
    """Return how an expression differs, with names where a line is known, or ""."""
    is_sum = isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add | ast.Sub)
    names = line.names if line else NO_NAMES
    if mutant.kind == "left-out":
        if isinstance(node, ast.BinOp):
            says = OF_A_PART.get(type(node.op), "")
            # Without a, a - b is -b: of b alone the sign is wrong as well.
            right = isinstance(node.op, ast.Sub) and ast.dump(node.right)
            return says + " and reverses one sign" * (ast.dump(new) == right)
        taught = mutant.body.own and isinstance(node, ast.Call)
        if taught and _is_of_a_module(node.func):
            return f"omits `{ast.unparse(node.func)}`"
    if mutant.kind == "clamp":
        return of_a_limit(node, new)
    if mutant.kind == "sign" and is_sum and (its := _own(node.right, names)):
        return f"reverses the sign of `{its}`"
    if mutant.kind == "name" and isinstance(new, ast.Name):
        its = _own(new, names)
        return its and _another_name(mutant, node, new, its)
    if mutant.kind == "order" and (parts := ORDERED.get(type(node))):
        return f"puts two {parts} in the wrong order"
    if mutant.kind == "order" and isinstance(node, ast.BinOp):
        pair = [_own(one, names) for one in (node.left, node.right)]
        if all(pair):
            return f"puts `{pair[0]}` and `{pair[1]}` in the wrong order"
        if isinstance(node.op, ast.Sub):
            return "subtracts two values in the wrong order, or reverses one sign"
    return ""


def of_a_limit(node: Any, new: ast.expr) -> str:
    """Return what is wrong with a limit: `np.clip(x, -1, 1)` for x is one too many.

    Args:
        node: the reference's expression.
        new: the one with the mistake.
    """
    before, after = map(ast.dump, (node, new))
    if before in map(ast.dump, getattr(new, "args", ())):
        return _of_an_added_clamp(new)
    if after in map(ast.dump, getattr(node, "args", ())):
        return "omits a limit"
    names = [getattr(getattr(one, "func", None), "attr", "") for one in (node, new)]
    one_side = names[0] == "clip" and names[1] in ("maximum", "minimum")
    return "applies a limit only on one side" if one_side else "applies a wrong limit"


def _of_an_added_clamp(new: ast.expr) -> str:
    """Return which limits a value has that has none in the formula."""
    match new:
        case ast.Call(ast.Attribute(attr=name), [_, *limits]):
            given = (name, *map(ast.unparse, limits))
            if given in CLAMPS:
                return CLAMPS[given]
    return "applies a limit that does not belong to the formula"


def _is_of_a_module(function: ast.expr) -> bool:
    """Return whether a function has a name that students know, as np.sqrt has."""
    inner = function
    while isinstance(inner, ast.Attribute):
        inner = inner.value
    return inner is not function and getattr(inner, "id", "") in MODULES


def _another_name(mutant: Mutant, node: ast.expr, new: ast.Name, its: str) -> str:
    """Return which variable is wrong, and what belongs there if that has a gloss."""
    names = new.id, getattr(node, "id", "")
    meaning, right = (_briefly(mutant.body.meaning(name)) for name in names)
    wrong = f"`{its}` ({meaning})" if meaning else f"`{its}`"
    other = f"another value ({right}) belongs" if right else "another value belongs"
    return f"uses {wrong} where {other}"


def _own(node: ast.expr, names: Mapping[str, str]) -> str:
    """Return an expression in the student's names; "" where one is not known."""
    if not names:
        return ""
    found = copy.deepcopy(node)
    for one in (n for n in ast.walk(found) if isinstance(n, ast.Name)):
        known = one.id in names
        one.id = names.get(one.id, one.id)
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
        m.known[key] = own and OwnFunction(own, copy.deepcopy(reference))
    return m.known[key]


def glosses(mutant: Mutant) -> list[str]:
    """Return what the reference's changed lines are; none if a comment is missing."""
    nodes = [place.node for place, _ in mutant.edits]
    names = {node.id for node in nodes if isinstance(node, ast.Name)}
    every = len(names) == 1 < len(nodes) and all(isinstance(n, ast.Name) for n in nodes)
    if every and mutant.kind in OF_A_VALUE and (meaning := mutant.body.meaning(*names)):
        return [meaning]  # each use of one variable: the mistake is where it is made
    lines = [getattr(node, "lineno", 0) for node in nodes]
    steps = dict.fromkeys(mutant.body.glosses.get(line, "") for line in lines)
    return list(steps) if all(steps) else []


def own_expressions(m: Any, mutant: Mutant) -> list[str]:
    """Return the student's expressions that have a mutant's changes, as quotations.

    There are none where one of the changes is not in the student's function.
    """
    if (own := _own_function(m, mutant)) is None:
        return []
    with mutant.made():
        around = map(mutant.around, range(len(mutant.edits)))
        texts = [own.expression(one, LONG) for one in around]
    return [f"`{one}`" for one in dict.fromkeys(texts)] if all(texts) else []


def is_known(m: Any, mutant: Mutant) -> bool:
    """Return whether a changed formula has only names that a student has seen."""
    names = _names(mutant.text.removeprefix("without "))
    return bool(names - set(MODULES)) and names <= _known(m, mutant)


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
