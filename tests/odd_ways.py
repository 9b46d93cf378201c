"""Every function of every day, its answers altered in some fifty ways: a soak.

    python tests/odd_ways.py              all days
    python tests/odd_ways.py 8 12         these days
    python tests/odd_ways.py 12 extend    one function

Each way is what a slip, a wrong idea of the task or chance makes of an answer: one
value too few, infinity, strings, a nested list, None in some calls. The checker must
have a verdict on each. It prints a line for each that stops the checker, and per day
how many ways were judged, how many passed, and the seconds of a processor.
"""

import functools
import sys
import time
import zlib
from collections.abc import Callable, Iterator
from itertools import count
from typing import Any, NamedTuple

import inprocess
import numpy as np
import pytest
import whole

from conftest import ROOT
from labkit.judge.mistake import Verdict
from labkit.judge.written import stop
from labkit.lesson.day import Day, Task, day_numbers, find_day
from labkit.lesson.lab_module import load_lab

FRESH = 4  # of the questions that are drawn anew every fourth is asked
Array = np.ndarray


def _mixed(x: Array) -> Array:
    """Return an array whose first number is NaN and whose last is infinite."""
    y = np.array(x, dtype=float)
    y.flat[:1] = np.nan
    y.flat[-1:] = np.inf
    return y


def _one(x: Array, value: float) -> Array:
    y = np.array(x, dtype=float)
    y.flat[y.size // 2 : y.size // 2 + 1] = value
    return y


def _rows(x: Array) -> Array:
    return x if np.ndim(x) else np.array([x])


# What becomes of each array of an answer.
OF_ARRAYS: dict[str, Callable[[Any], Any]] = {
    "one short": lambda x: _rows(x)[:-1],
    "first missing": lambda x: _rows(x)[1:],
    "one alone": lambda x: _rows(x)[:1],
    "one more": lambda x: np.concatenate([_rows(x), _rows(x)[-1:]]),
    "twice": lambda x: np.concatenate([_rows(x), _rows(x)]),
    "empty": lambda x: _rows(x)[:0],
    "no columns": lambda x: _rows(x)[..., :0],
    "a column short": lambda x: _rows(x)[..., :-1],
    "transposed": lambda x: np.transpose(x),
    "flat": lambda x: np.ravel(x),
    "one axis more": lambda x: np.expand_dims(x, -1),
    "one axis before": lambda x: np.expand_dims(x, 0),
    "turned over": lambda x: _rows(x)[::-1],
    "first number": lambda x: float(np.ravel(x)[0]) if np.size(x) else 0.0,
    "infinite": lambda x: np.full(np.shape(x), np.inf),
    "minus infinity": lambda x: np.full(np.shape(x), -np.inf),
    "NaN": lambda x: np.full(np.shape(x), np.nan),
    "one NaN": lambda x: _one(x, np.nan),
    "one infinite": lambda x: _one(x, np.inf),
    "NaN and infinity": _mixed,
    "zeros": lambda x: np.zeros(np.shape(x)),
    "ones": lambda x: np.ones(np.shape(x)),
    "huge": lambda x: np.asarray(x, float) * 1e20,
    "at the limit": lambda x: np.full(np.shape(x), 1e308),
    "tiny": lambda x: np.asarray(x, float) * 1e-20,
    "negated": lambda x: -np.asarray(x, float),
    "one added": lambda x: np.asarray(x, float) + 1.0,
    "a little off": lambda x: np.asarray(x, float) * (1.0 + 1e-7),
    "whole numbers": lambda x: np.asarray(x, float).astype(int),
    "booleans": lambda x: np.asarray(x, float) > 0,
    "float32": lambda x: np.asarray(x, np.float32),
    "complex": lambda x: np.asarray(x, complex) * 1j,
    "complex, but real": lambda x: np.asarray(x, complex),
    "strings": lambda x: np.asarray(x).astype(str),
    "words in lists": lambda x: [str(one) for one in np.ravel(x)],
    "nested lists": lambda x: [[np.asarray(x).tolist()], [1.0, [2.0]]],
    "in a list": lambda x: [x],
    "a tuple of its rows": lambda x: tuple(_rows(x)),
    "objects": lambda x: np.asarray(x, dtype=object),
}
# What becomes of a whole answer, from it, the call's arguments and its number.
OF_ANSWERS: dict[str, Callable[[Any, tuple[Any, ...], int], Any]] = {
    "None": lambda x, args, i: None,
    "None now and then": lambda x, args, i: None if i % 3 == 1 else x,
    "its first argument": lambda x, args, i: args[0] if args else 0.0,
    "its last argument": lambda x, args, i: args[-1] if args else 0.0,
    "all arguments": lambda x, args, i: args,
    "a word": lambda x, args, i: "right",
    "True": lambda x, args, i: True,
    "a dictionary": lambda x, args, i: {"answer": x},
    "the answer and 1": lambda x, args, i: (x, 1.0),
    "the first result": lambda x, args, i: x[0] if isinstance(x, tuple) else x,
    "results turned over": lambda x, args, i: x[::-1] if isinstance(x, tuple) else 0,
    "of one call in all": lambda x, args, i: np.asarray(i, float),
    "infinite now and then": lambda x, args, i: (
        x if i % 3 else _each(OF_ARRAYS["infinite"], x)
    ),
    "short now and then": lambda x, args, i: (
        x if i % 3 else _each(OF_ARRAYS["one short"], x)
    ),
    "stops now and then": lambda x, args, i: x if i % 3 else [][i],
}
WAYS = [*OF_ARRAYS, *OF_ANSWERS]


class Odd(NamedTuple):
    """One way of one function."""

    day: Day
    task: Task
    function: str
    way: str


def _each(change: Callable[[Any], Any], answer: Any) -> Any:
    """Return an answer, every array or number of it changed; None and words stay."""
    if isinstance(answer, tuple):
        return tuple(_each(change, part) for part in answer)
    return answer if answer is None or isinstance(answer, str) else change(answer)


def altered(function: Callable[..., Any], way: str) -> Callable[..., Any]:
    """Return a function whose answers are altered in one way."""
    number = count()

    @functools.wraps(function)  # its arguments' names
    def odd(*args: Any) -> Any:
        answer = function(*args)
        if way in OF_ARRAYS:
            return _each(OF_ARRAYS[way], answer)
        return OF_ANSWERS[way](answer, args, next(number))

    return odd


def all_of(day: Day) -> Iterator[Odd]:
    """Yield every way of every function of a day."""
    for task in day.tasks:
        for function in task.functions:
            for way in WAYS:
                yield Odd(day, task, function, way)


def some_of(day: Day, n: int) -> list[Odd]:
    """Return some ways: others at each commit, and where the checker or day changes."""
    every = list(all_of(day))
    files = sorted([*ROOT.glob("labkit/judge/*.py"), *day.own.glob("*.py")])
    texts = [whole.commit().encode(), *(path.read_bytes() for path in files)]
    step = zlib.crc32(b"".join(texts)) % len(every)
    apart = -(-len(every) // n)
    return [every[(step + i * apart) % len(every)] for i in range(n)]


def judged(odd: Odd) -> Verdict:
    """Return the verdict on a file with one function altered; it asks no other task."""
    function = getattr(load_lab(odd.day.source), odd.function)
    instead = {odd.function: altered(function, odd.way)}
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Day, "needs", lambda *_: ())
        found = inprocess.verdicts(
            odd.day, odd.day.source, odd.task.id, instead=instead, fresh=FRESH
        )
    return found[odd.task.id]


def soak(day: Day, only: str = "") -> int:
    """Print what stops the checker, and a day's totals; return how many do."""
    began = time.process_time()
    passed = stopped = total = 0
    with inprocess.worked_out_once():
        for odd in all_of(day):
            if only and odd.function != only:
                continue
            total += 1
            try:
                passed += judged(odd).status == "passed"
            except Exception as error:
                stopped += 1
                print(f"{odd.task.id} {odd.function}, {odd.way}: it {stop(error)}")
    seconds = time.process_time() - began
    print(
        f"Day {day.number}: {total} ways judged, {passed} passed, {stopped} stop the "
        f"checker, {seconds:.0f} s of a processor",
        flush=True,
    )
    return stopped


if __name__ == "__main__":
    words = sys.argv[1:]
    names = [word for word in words if not word.isdecimal()]
    numbers = [int(word) for word in words if word.isdecimal()] or day_numbers()
    sys.exit(bool(sum(soak(find_day(n), *names[:1]) for n in numbers)))
