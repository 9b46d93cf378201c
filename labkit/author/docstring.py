"""Tests of a docstring: its worked cases are run, and its shapes are compared.

A worked case is a call and its answer, anywhere in the docstring:

    layer([[1, 2]], [[0.5], [1]], 0.0) -> [[2.5]]

A number typed with decimals is right to those decimals. A shape stands in parentheses
behind an argument, "X (n, d)", "q, (7,)", or behind what is returned; the same letter
is the same size.
"""

import ast
import contextlib
import re
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

from labkit.judge.ask import as_plain
from labkit.judge.row import Row

_SHAPE = re.compile(r"\(((?:\d+|[a-z])(?:, (?:\d+|[a-z]))*,?)\)")
_SOURCE = re.compile(r"\b(?:sections?|eq\.|equation|appendix|definition) [\w.]+")
_PLAIN = ("pi", "sqrt", "exp", "log", "sin", "cos", "tan", "nan", "inf")
_NAMES = {"np": np, "True": True, "False": False, "None": None} | {
    name: getattr(np, name) for name in _PLAIN
}
FIRST = 3  # questions that a docstring in words may be about
EXACT = 1e-9  # the relative tolerance of a number without decimals


def faults_of(row: Row) -> Iterator[str]:
    """Yield what a function's docstring says and is not so.

    Args:
        row: the function's; its lab has the docstring.
    """
    function = getattr(row.lab, row.function)
    text = " ".join((function.__doc__ or "").split())
    for call, value in cases(text, row.function):
        try:
            answer = _called(function, call, row.ask.main[0])
            off = _difference(answer, ast.parse(value, mode="eval").body)
        except Exception as error:
            off = f"{type(error).__name__}: {error}"
        if off:
            yield f"the docstring's case {call} -> {value} is not so: {off}"
    try:
        yield from _shapes(text, row, function)
    except Exception as error:
        yield f"it stops at a question of its own: {type(error).__name__}: {error}"


def capitals(row: Row) -> Iterator[str]:
    """Yield the sentences of mistakes that begin with a capital, as in "Your code ...".

    A sentence may follow "In line 12, ". A name in capitals, such as "R is", is none.
    """
    for way in row.named:
        if re.match(r"[A-Z][a-z]+ ", way.says):
            yield (
                f"the sentence of {way.slug} begins with a capital, but it may follow "
                f'"In line 12, ": {way.says.partition(". ")[0]}'
            )


def _called(function: Callable[..., Any], call: str, like: Sequence[Any]) -> Any:
    """Return what a function answers to a call, typed as text.

    Args:
        function: of the lab.
        call: "skew([0, 0, 1])".
        like: a question's arguments: an array where one of these is one.
    """
    given = ast.parse(call, mode="eval").body
    if not isinstance(given, ast.Call):
        raise ValueError("it is no call")
    args = [_argument(node, one) for node, one in zip(given.args, like, strict=False)]
    more = map(_value, given.args[len(args) :])
    named = {one.arg: _value(one.value) for one in given.keywords if one.arg}
    return function(*args, *more, **named)


def unlike_its_questions(row: Row) -> list[str]:
    """Return the decimals of a docstring that its first questions do not have.

    A case in words cannot be run; its numbers are those of the first questions or of
    the answers, or it is about something else: worth a look, and no fault.

    Args:
        row: the function's.
    """
    function = getattr(row.lab, row.function)
    text = " ".join((function.__doc__ or "").split())
    for case in cases(text, row.function):
        text = text.replace(case[0], "").replace(case[1], "")
    typed = re.findall(r"(?<![\w.])\d+\.\d+", _SOURCE.sub("", text))
    there = [0.0]
    for call in row.ask.main[:FIRST] if typed else ():
        args = [as_plain(arg) for arg in call]
        with contextlib.suppress(Exception):  # `faults_of` says so
            there += _numbers([*args, function(*args)])
    known = np.abs(there)
    return [
        one
        for one in dict.fromkeys(typed)
        if not (np.abs(known - float(one)) <= _half(one) + EXACT).any()
    ]


def _numbers(value: Any) -> list[float]:
    """Return all numbers in arguments or answers."""
    if isinstance(value, list | tuple):
        return [number for one in value for number in _numbers(one)]
    if isinstance(value, int | float | np.ndarray | np.generic):
        return np.ravel(np.asarray(value, dtype=float)).tolist()
    return []


def _half(typed: str) -> float:
    """Return half of the last decimal of a number."""
    return 0.5 * 10.0 ** -len(typed.partition(".")[2])


def cases(text: str, name: str) -> list[tuple[str, str]]:
    """Return the worked cases of a docstring: (call, answer), as typed.

    Args:
        text: of the docstring, in one line.
        name: of the function.
    """
    found = []
    for begin in re.finditer(rf"\b{name}(?=\()", text):
        end = _bracket_end(text, begin.end())
        arrow = re.match(r" *-> *", text[end:])
        if arrow:
            start = end + arrow.end()
            found.append((text[begin.start() : end], _first_value(text[start:])))
    return found


def _bracket_end(text: str, at: int) -> int:
    """Return where the bracket at `at` is closed, behind it; the end where never."""
    depth = 0
    for i, letter in enumerate(text[at:], at):
        depth += (letter in "([{") - (letter in ")]}")
        if depth == 0:
            return i + 1
    return len(text)


def _first_value(text: str) -> str:
    """Return the value that a text begins with, up to the sentence's next part."""
    if text[:1] in ("(", "["):
        return text[: _bracket_end(text, 0)]
    found = re.match(r"[^;,:]+?(?=[;,:]|\.(?:\s|$)|$)", text)
    return found[0].strip() if found else text


def _value(node: ast.expr) -> Any:
    """Return what an expression of numbers is."""
    return eval(compile(ast.Expression(node), "docstring", "eval"), dict(_NAMES))


def _argument(node: ast.expr, like: Any) -> Any:
    """Return an argument as questions have it: an array where that one is an array."""
    value = _value(node)
    return np.array(value, dtype=like.dtype) if isinstance(like, np.ndarray) else value


def _difference(answer: Any, wanted: ast.expr) -> str:
    """Return how an answer differs from the one that is typed; "" where it does not."""
    value = _value(wanted)
    several = isinstance(answer, tuple) and isinstance(value, tuple)
    pairs = list(zip(answer, value, strict=True)) if several else [(answer, value)]
    sizes = _decimals(wanted)
    limits = sizes if several else [sizes]
    for (got, told), limit in zip(pairs, limits, strict=True):
        if np.shape(got) != np.shape(told):
            return f"it returns shape {np.shape(got)}, and {np.shape(told)} is typed"
        if told is None and got is None:
            continue
        right = np.asarray(told, dtype=float)
        most = np.asarray(limit, dtype=float) + EXACT * np.abs(right)
        if not (np.abs(np.asarray(got, dtype=float) - right) <= most).all():
            return f"it returns {_short(answer)}"
    return ""


def _short(answer: Any) -> str:
    parts = answer if isinstance(answer, tuple) else (answer,)
    told = [np.array2string(np.asarray(one), separator=", ") for one in parts]
    text = " ".join(", ".join(told).split())
    return f"({text})" if isinstance(answer, tuple) else text


def _decimals(node: ast.expr) -> Any:
    """Return how far each typed number may be off: half of its last decimal."""
    if isinstance(node, ast.List | ast.Tuple):
        return [_decimals(one) for one in node.elts]
    typed = [
        _half(ast.unparse(one))
        for one in ast.walk(node)
        if isinstance(one, ast.Constant) and isinstance(one.value, float)
    ]
    plain = isinstance(node, ast.Constant | ast.UnaryOp)
    return min(typed) + EXACT if typed and plain else EXACT


def _shapes(text: str, row: Row, function: Callable[..., Any]) -> Iterator[str]:
    """Yield the first shape of a docstring that the row's questions do not have."""
    told = _documented_shapes(text, row.arguments)
    for call in row.ask.main if told else ():
        args = [as_plain(arg) for arg in call]
        given = dict(zip(row.arguments, args, strict=False))  # the rest is usual
        known: dict[str, int] = {}
        for name, dims in told:
            value = given[name] if name else function(*args)
            if why := _shape_fault(dims, value, known):
                what = name or "what it returns"
                yield f"the docstring says that {what} is ({dims}); {why}"
                return


def _documented_shapes(text: str, arguments: Sequence[str]) -> list[tuple[str, str]]:
    """Return the shapes that a docstring tells: (argument, or "" of the answer, dims).

    Args:
        text: of the docstring, in one line.
        arguments: names.
    """
    found: dict[int, str] = {}
    for name in arguments:
        place = rf"(?<![\w.]){re.escape(name)}(?:,| is| are|:)? (?=\()"
        found |= dict.fromkeys((one.end() for one in re.finditer(place, text)), name)
    first = text.partition(". ")[0]
    told, answers = [], []
    for shape in _SHAPE.finditer(text):
        of_the_answer = text[shape.start() - 2 :][:1] == ","
        # Behind "Return A^-1 e, (n,)." the first sentence ends: it is no shape of e.
        ends = of_the_answer and shape.end() == len(first.rstrip("."))
        if shape.start() in found and not ends:
            told.append((found[shape.start()], shape[1]))
        elif shape.end() <= len(first) and of_the_answer:
            answers.append(("", shape[1]))
    # Several answers do not show to which result each belongs.
    return [*told, *answers] if len(answers) == 1 else told


def _shape_fault(dims: str, value: Any, known: dict[str, int]) -> str:
    """Return why a value has another shape, "" where it has that one, or none.

    Args:
        dims: "n, 3".
        value: an argument or an answer; of a tuple its first part.
        known: letters that stand for a size already; new ones are added.
    """
    value = value[0] if isinstance(value, tuple) else value
    if not isinstance(value, np.ndarray):
        return ""
    wanted = [one.strip() for one in dims.split(",") if one.strip()]
    vague = "," in dims.rstrip(",") and not re.search("[a-z]", dims)
    if vague and value.ndim != len(wanted):  # numbers, such as a point's
        return ""
    sizes = [known.get(one, one) for one in wanted]
    fits = len(sizes) == value.ndim and all(
        str(size) == str(there) or str(size).isalpha()
        for size, there in zip(sizes, value.shape, strict=True)
    )
    letters = [one for one in wanted if one.isalpha()]
    said = ", ".join(f"{one} = {known[one]}" for one in letters if one in known)
    if not fits:
        where = f" where {said}" if said else ""
        return f"a question of its row has shape {value.shape}{where}"
    known |= {w: n for w, n in zip(wanted, value.shape, strict=True) if w.isalpha()}
    return ""
