"""What a function returns, result by result, as its row says.

A row's kind is one kind, or a tuple of them, one for each result; a result may be such
a tuple again. Flat, the results are the parts that are compared: arrays of numbers, in
which a truth value is 0 or 1, and None is NaN.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from labkit.base.text import count
from labkit.judge.answers import capitalised, listed
from labkit.judge.kinds import Kind
from labkit.judge.mistake import Finding
from robo47.errors import Robo47Error

ORDINALS = ("first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth")
SHAPE = "the wrong shape"
Kinds = Kind | tuple[Any, ...]  # one of an answer, or of each of its results


def checked(kind: Any, deep: int = 2) -> Kinds:
    """Return the kind of an answer, where it is one.

    Raises:
        Robo47Error: it is none; says what to write.
    """
    if isinstance(kind, Kind):
        return kind
    if isinstance(kind, tuple) and deep and len(kind) > 1:
        return tuple(checked(one, deep - 1) for one in kind)
    remedy = "a kind of labkit.judge, such as Vector((3,)), or a tuple of several"
    if isinstance(kind, type) and issubclass(kind, Kind):
        remedy = f"{kind.__name__}(...), with its arguments"
    elif isinstance(kind, tuple):
        remedy = "the kind itself where there is one result, and tuples nested once"
    raise Robo47Error(f"{kind!r} is no kind of an answer; expected {remedy}")


def flat_kinds(kind: Kinds) -> tuple[Kind, ...]:
    """Return the kinds of an answer's parts."""
    if isinstance(kind, Kind):
        return (kind,)
    return tuple(one for inner in kind for one in flat_kinds(inner))


def places(kind: Kinds, so_far: str = "") -> tuple[str, ...]:
    """Return where each part stands in an answer: "", or "[0]", "[1][0]" and so on."""
    if isinstance(kind, Kind):
        return (so_far,)
    inner = (places(one, f"{so_far}[{i}]") for i, one in enumerate(kind))
    return tuple(place for some in inner for place in some)


def split(kind: Kinds, value: Any) -> tuple[Any, ...] | Finding:
    """Return an answer's parts as they came, or what it is instead."""
    if isinstance(kind, Kind):
        return (value,)
    some = _results(kind, value)
    if some is None:
        says = f"Your function returns {_given(value)}; {expected(kind)}."
        return Finding("parts", says)
    parts: tuple[Any, ...] = ()
    for one, item in zip(kind, some, strict=True):
        if isinstance(found := split(one, item), Finding):
            return found
        parts += found
    return parts


def _results(kind: tuple[Any, ...], value: Any) -> Sequence[Any] | None:
    """Return as many results as there are kinds; None if an answer has not as many."""
    flat = all(isinstance(one, Kind) for one in kind)  # no result is a tuple itself
    whole = isinstance(value, np.ndarray) and value.ndim and flat
    some = tuple(value) if whole else value  # a result in each row
    good = isinstance(some, tuple | list) and len(some) == len(kind)
    return some if good else None


def not_split(kind: Kinds, value: Any, place: str = "") -> tuple[str, str] | None:
    """Return the place of the first tuple without its results, and what it is."""
    if isinstance(kind, Kind):
        return None
    some = _results(kind, value)
    if some is None:
        return place, _given(value)
    pairs = enumerate(zip(kind, some, strict=True))
    found = (not_split(one, item, f"{place}[{i}]") for i, (one, item) in pairs)
    return next(filter(None, found), None)


def numbers(kind: Kinds, value: Any) -> Any:
    """Return a right or a mistaken answer as numbers: an array, or a tuple of them.

    Raises:
        ValueError: it has not the parts that its kind has.
    """
    if isinstance(kind, Kind):
        return kind.numbers(value)
    parts = split(kind, value)
    if isinstance(parts, Finding):
        raise ValueError(parts.message)
    pairs = zip(flat_kinds(kind), parts, strict=True)
    return tuple(one.numbers(part) for one, part in pairs)


def read(kind: Kinds, values: Sequence[Any]) -> list[list[Any]] | Finding:
    """Return a student's answers, checked: a list of arrays per part."""
    rows = [split(kind, value) for value in values]
    kinds = flat_kinds(kind)
    found = []
    for row in rows:
        if isinstance(row, Finding):
            return row
    for j, (one, column) in enumerate(zip(kinds, zip(*rows, strict=True), strict=True)):
        part = one.read(column)
        if isinstance(part, Finding):
            return Finding(part.slug, of_one(kind, j, part.message))
        found.append(part)
    return found


def of_one(kind: Kinds, j: int, says: str) -> str:
    """Return what "your function returns" as said of one result of several."""
    if isinstance(kind, Kind):
        return says
    this = capitalised(nth(kind, j))
    says = says.replace(
        f"Your function returns an array of {SHAPE}", f"{this} has {SHAPE}"
    )
    return says.replace("Your function returns", f"{this} is", 1)


def nth(kind: Kinds, j: int) -> str:
    """Return one result of several in words: "your second result, the covariance,"."""
    place, called = places(kind)[j], flat_kinds(kind)[j].called
    flat = place.count("[") == 1 and j < len(ORDINALS)
    which = f"{ORDINALS[j]} result" if flat else f"result {place}"
    return f"your {which}, {called}," if called else f"your {which}"


def as_sent(kind: Kinds, parts: Sequence[Any]) -> Any:
    """Return an answer of such parts as the function returns it."""
    left = iter(parts)

    def one(inner: Kinds) -> Any:
        if isinstance(inner, Kind):
            return inner.sent(next(left))
        return tuple(map(one, inner))

    return one(kind)


def expected(kind: Kinds) -> str:
    """Return what is expected, as the end of a sentence."""
    if isinstance(kind, Kind):
        return f"expected {kind.expected}"
    every = [_expected(one) for one in kind]
    names = [one.called for one in kind if isinstance(one, Kind) and one.called]
    named = len(names) == len(kind)
    if len(set(every)) == 1:
        which = f" ({listed(names)})" if named else ""
        return f"expected {len(kind)} results{which}, each {every[0]}"
    if named:
        pairs = zip(names, every, strict=True)
        every = [f"{name} ({its})" for name, its in pairs]
    return f"expected {len(kind)} results: {listed(every)}"


def _given(value: Any) -> str:
    """Return what came for several results, in words."""
    if isinstance(value, str | None):
        return repr(value)
    if isinstance(value, tuple | list):
        return count(len(value), "result")
    shape = np.shape(value)
    return f"one array of shape {shape}" if shape else "one number"


def _expected(kind: Kinds) -> str:
    if isinstance(kind, Kind):
        return kind.expected
    return f"a tuple of {len(kind)} results"
