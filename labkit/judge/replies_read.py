"""Replies read as answers, or why one is no answer: none, shape, state."""

import linecache
import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from labkit.base.exchange import Exchange, Reply
from labkit.judge import results
from labkit.judge.answers import (
    InTurn,
    Parts,
    as_one,
    as_real,
    capitalised,
    in_calls,
    own,
    parts,
)
from labkit.judge.ask import Ask, Asked, of_complex, replies, stacked
from labkit.judge.mistake import Finding, Verdict
from labkit.lesson.slips import OTHER_PACKAGES, arguments, draws, no_python
from robo47.checks import Array
from robo47.paths import ROOT

ONLY_NUMPY = " The checker has only NumPy, the kit and Python's own modules."
ONLY_IN_MAIN = (
    "A task is solved with NumPy, the kit's library and Python's own modules, so the "
    "checker has no other package. Use others in main(), for example for pictures, "
    "because the checker does not run main()."
)
IN_MAIN = 'Keep it below `if __name__ == "__main__":`, or in main().'
SAME = 1e-9  # how far two answers to one question may differ: a last digit


def no_answer(reply: Reply, function: str, task: str) -> Verdict | None:
    """Return the verdict on a reply that never was an answer, or None.

    Args:
        reply: what came of a call; of an exception of the student's own see
            `stops_with`, which is no verdict before it is known how often.
        function: that was called.
        task: whose it is, "" where it is no task's.
    """
    match reply.kind:
        case "stopped":
            slug = "stopped"
            says = f"{function} did not return: {reply.error}."
        case "unsendable":
            slug = "not-an-array"
            says = f"Your `{function}` {reply.error.removeprefix('it ')}."
        case "huge":
            slug = "huge-numbers"
            says = f"I{reply.error[1:]}, far larger than any right "
            says += "answer. Is something divided by almost zero, or does an "
            says += "exponential grow?"
        case "missing":
            slug = "missing"
            says = f"The file has no function {function}."
            says += f" To restore its starter: make start RESET={task}." if task else ""
        case "BdbQuit":
            slug = "breakpoint"
            says = f"Your function stops in the debugger (line {reply.line}): "
            says += "delete the call breakpoint()."
        case "RefusedError":
            return refusal(reply.refused[0] if reply.refused else "", reply.line)
        case "waits":
            stopped = reply.error.removeprefix("task ")
            says = f"Not tested: it builds on task {stopped}, which did not return."
            return Verdict("todo", "waits", says, follows=stopped)
        case "NotImplementedError":
            named = re.search(r"task (\d+\.\d+)", reply.error)
            if named and named[1] != task:
                says = f"Your function calls task {named[1]}, which is not written yet."
                return Verdict("todo", "waits", says, follows=named[1])
            known = ("", f"task {task}", f"task {task}: write {function}")
            more = "" if reply.error in known else f": {reply.error}"
            says = f"Not written yet{more or '.'}"
            return Verdict("todo", "unwritten", says)
        case _:
            return None
    return Verdict("wrong", slug, says)


def stops_with(reply: Reply, often: str = "") -> str:
    """Return an exception of the student's own in a sentence.

    Args:
        reply: whose kind is the exception's name.
        often: in how many calls, "in 2 of 6 calls"; "" for one call.
    """
    callers = ", which is called from ".join(f"line {line}" for line in reply.callers)
    called = f", called from {callers}" if callers else ""
    where = f"The error occurs in line {reply.line}{called}:" if reply.line else ""
    text = " ".join(f"{reply.kind}: {reply.error}".replace("`", "'").split())
    text = text.removesuffix(":")
    why = f" {ONLY_IN_MAIN}" if reply.kind == "ModuleNotFoundError" else ""
    if reply.kind == "EOFError":
        why = (
            " Does your function call input()? The checker provides no input, so use "
            "the arguments."
        )
    stops = f"Your function stops with an error {often}".rstrip()
    return f"{stops}. {where or 'The error is'} `{text}`.{why}"


def refusal(what: str, line: int | None) -> Verdict:
    """Return the verdict on code that wanted more than its arguments.

    Args:
        what: it wanted: "read notes.txt".
        line: of the student's file, where it is known.
    """
    where = f" (line {line})" if line else ""
    for root in (str(ROOT), ROOT.as_posix()):
        what = what.replace(root + "/", "").replace(root + "\\", "")
    slug, why = "refused", "A task needs only its arguments."
    package = re.match(r"(?:call|use|load) (\w+)", what)
    if package and package[1] in OTHER_PACKAGES:
        slug, why = "other-package", ONLY_IN_MAIN
    elif what.startswith("call "):
        slug = "not-by-hand"
        why = "In a task you compute the answer yourself; MuJoCo is only the reference."
    return Verdict("wrong", slug, f"Your function tries to {what}{where}. {why}")


def not_loaded(script: Path, reply: Reply) -> str:
    """Return one line on a file that Python could not load."""
    where = f"{script.name}, line {reply.line}" if reply.line else script.name
    if reply.kind == "SystemExit":
        return f"{where}: it ends Python while it is loaded. {IN_MAIN}"
    if reply.kind == "RefusedError" and reply.refused:
        return f"{where}: while it is loaded, it tries to {reply.refused[0]}. {IN_MAIN}"
    if reply.kind == "EOFError":
        return f"{where}: while it is loaded, it calls input(). {IN_MAIN}"
    if reply.kind == "stopped":
        return f"{where}: while it is loaded, {reply.error}. {IN_MAIN}"
    why = f"{where}: {reply.kind}: {reply.error}".rstrip(": ")
    if reply.kind == "ModuleNotFoundError":
        why += f".{ONLY_NUMPY} Import others in main(), which the checker does not run."
    elif reply.kind in ("SyntaxError", "NameError"):
        linecache.checkcache(str(script))
        lines = linecache.getlines(str(script))
        why += f". {no_python(lines, (reply.line or 0) - 1)}"
    return why.removesuffix(". ")


def values(exchanges: Sequence[Exchange]) -> list[Any]:
    """Return the values of replies; complex ones as pairs, where that was asked."""
    found = []
    for one, reply in zip(exchanges, replies(exchanges), strict=True):
        pairs = of_complex(one.question)
        found.append(as_real(reply.value) if pairs else reply.value)
    return found


def read(exchanges: Sequence[Exchange], ask: Ask, source: str = "") -> Parts | Finding:
    """Return the answers' parts stacked, (n, *shape), or what keeps them from it.

    Args:
        exchanges: the questions, with their replies.
        ask: the function's row.
        source: the student's file, for the slips that show in it.
    """
    replied = replies(exchanges)
    if broken := [reply for reply in replied if reply.kind]:
        text = f"{broken[0].kind}: {broken[0].error}"
        often = in_calls(len(broken), len(replied))
        for slip in ask.slips:
            if re.search(slip.error, text) and re.search(slip.source, source):
                stops = f" Your function stops with an error {often}."
                stops = stops if len(broken) < len(replied) else ""
                return Finding(slip.slug, f"{slip.says}{stops}")
        return Finding("raises", stops_with(broken[0], often))
    nothing = sum(reply.value is None for reply in replied)
    if nothing and not getattr(ask.kind, "none", ""):
        says = "Your function returns nothing (None). Is the result computed, but not "
        says += "returned?"
        if nothing < len(replied):
            some = in_calls(nothing, len(replied))
            says = f"Your function returns None {some}; {results.expected(ask.kind)}."
        return Finding("nothing-returned", says)
    columns = results.read(ask.kind, values(exchanges))
    return columns if isinstance(columns, Finding) else tuple(map(as_one, columns))


def not_accepted(asked: Asked) -> Iterator[tuple[Exchange, Finding]]:
    """Yield the calls that a function with many right answers got wrong, and why."""
    if not (accept := asked.ask.accept):
        return
    for one in (*asked.main, *asked.fresh):
        S = read([one], asked.ask)
        if isinstance(S, Finding):
            continue
        answer = results.as_sent(asked.ask.kind, [part[0] for part in S])
        if why := accept(*map(own, one.question.args), answer):
            yield one, why if isinstance(why, Finding) else Finding("not-accepted", why)


def of_another_size(asked: Asked, other: bool = False) -> Finding | None:
    """Return that answers have not the size that their questions ask for, if so.

    Args:
        asked: the questions, with their replies.
        other: whether something else was said of further questions.
    """
    off = wrong_sizes(asked.ask, asked.main)
    if not off:
        return None
    _, j, got, right = off[0]
    calls = len(off)
    says = asked.ask.kinds[j].another_size(got, right)
    says = f"{says} {in_calls(calls, len(asked.main), other)}."
    return Finding("shape", results.of_one(asked.ask.kind, j, says))


def of_another_length(asked: Asked) -> bool:
    """Return whether answers differ from the right ones in their number of rows alone.

    A row may have more to say of these, since a path can have more points than another.
    A vector with an entry too few has no such meaning.
    """
    return all(
        got == right or (len(got) > 1 and got[1:] == right[1:])
        for _, _, got, right in sizes(asked.ask, asked.main)
    )


def wrong_sizes(
    ask: Ask, exchanges: Sequence[Exchange]
) -> list[tuple[int, int, tuple[int, ...], tuple[int, ...]]]:
    """Return the wrong shapes of the first result that has one, a call each."""
    off = [one for one in sizes(ask, exchanges) if one[2] != one[3]]
    return [one for one in off if one[1] == off[0][1]]


def sizes(
    ask: Ask, exchanges: Sequence[Exchange]
) -> Iterator[tuple[int, int, tuple[int, ...], tuple[int, ...]]]:
    """Yield the call, the place, the shape and the right shape of each result.

    Nothing is yielded where no question decides them, and of no None.
    """
    truth, kinds = ask.truth, ask.kinds
    if not isinstance(truth, InTurn) or all(None not in kind.shape for kind in kinds):
        return
    right = map(parts, truth.each(stacked(exchanges)))
    given = results.read(ask.kind, values(exchanges))
    assert not isinstance(given, Finding)  # it was read before
    for i, (its, mine) in enumerate(zip(right, zip(*given, strict=True), strict=True)):
        for j, (T, S, kind) in enumerate(zip(its, mine, kinds, strict=True)):
            if not (kind.is_none(T) or kind.is_none(S)):
                yield i, j, S.shape, T.shape


def kept_state(asked: Asked, source: str = "") -> Finding | None:
    """Return that a function keeps something between its calls, if it does."""
    replied = replies([*asked.main, *asked.fresh])
    differ = [reply for reply in replied if _differs(reply)]
    if not differ:
        return None
    if draws(source, asked.function):
        given = (a for a in arguments(source, asked.function) if "noise" in a)
        return Finding("draws-itself", _draws_itself(next(given, "")))
    return Finding(
        "kept-between-calls",
        f"{capitalised(in_calls(len(differ), len(replied)))}, the same arguments gave "
        "two different results, so your function keeps a value between calls, such as "
        "a default argument T=np.eye(4), an array or list at the top of the file, or "
        "the last call's input. Create it in the function.",
    )


def _draws_itself(given: str) -> str:
    """Return that a function draws random numbers, and where these come from.

    Args:
        given: the argument that holds random numbers; "" without one.
    """
    remedy = "Draw the random numbers in main() and pass them as an argument"
    if given:
        remedy = f"Use only the random numbers in the argument `{given}`"
    return (
        "The same arguments gave two different results, because your function draws "
        f"random numbers itself. {remedy}, so that a run can be repeated."
    )


def shared_memory(replies: Sequence[Reply], copies: bool = True) -> Finding | None:
    """Return that right answers are not a function's own arrays, if so.

    Args:
        replies: to all questions.
        copies: whether an answer may not be (a part of) an argument itself.
    """
    shared = [name for reply in replies for name in reply.shares]
    if "another answer" in shared:
        return Finding(
            "one-array-for-all",
            "Your function returns the same array object in every call, so each call "
            "overwrites the previous result. Create a new array in the function.",
        )
    if shared and copies:
        return Finding(
            "shares-its-argument",
            f"Your function returns its argument {shared[0]} itself or a part of it, "
            "so a change of one also changes the other. Return a copy: "
            f"{shared[0]}.copy().",
        )
    return None


def _differs(reply: Reply) -> bool:
    if reply.kind or reply.again_error:  # stopped once, and not the other time
        return bool(reply.again_error) or reply.again is not None
    first, second = flat(reply.value), flat(reply.again)
    if first is None or second is None or first.shape != second.shape:
        return not (first is None and second is None)
    if first.tobytes() == second.tobytes():  # as nearly always
        return False
    scale = max(1.0, float(np.abs(first[np.isfinite(first)]).max(initial=0.0)))
    return not np.allclose(first, second, rtol=0.0, atol=SAME * scale, equal_nan=True)


def flat(answer: Any) -> Array | None:
    """Return all numbers of one answer, (n,); None where it is none."""
    if answer is None:
        return None
    try:
        return np.concatenate(list(_numbers(answer)))
    except (TypeError, ValueError):
        return None


def _numbers(answer: Any) -> Iterator[Array]:
    """Yield the numbers of each part; a text's are its letters, None's is NaN."""
    if isinstance(answer, tuple):
        for part in answer:
            yield from _numbers(part)
        return
    plain = list(map(ord, answer)) if isinstance(answer, str) else as_real(answer)
    yield np.asarray(plain, dtype=np.float64).ravel()
