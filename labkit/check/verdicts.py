"""From a task's questions and replies to its verdict."""

import tokenize
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from labkit.check.source_hints import arguments, unfinished
from labkit.judge.ask import Asked
from labkit.judge.exchange import Reply, replies
from labkit.judge.judge import judge
from labkit.judge.mistake import Verdict
from labkit.judge.problems import no_answer, refusal
from labkit.lesson.day import Task


def verdict_of(task: Task, asked: Sequence[Asked], source: str) -> Verdict:
    """Return the verdict on a task; of several functions that of the first wrong one.

    Args:
        task: as in the manifest.
        asked: the questions to each of its functions, with their replies.
        source: the student's file.
    """
    verdict = Verdict("passed")
    for one in asked:
        verdict = _of_function(task, one, source)
        if len(asked) > 1 and verdict.message and not verdict.follows:
            verdict = replace(verdict, message=f"{one.function}: {verdict.message}")
        if verdict.status != "passed":
            break
    return verdict


def _of_function(task: Task, asked: Asked, source: str) -> Verdict:
    function = asked.function
    for reply in replies([*asked.main, *asked.fresh]):
        if early := no_answer(reply, function, task.id):
            slip = early.mistake == "unwritten" and unfinished(source, function)
            return Verdict("todo", "raise-left-in", slip) if slip else early
    verdict = judge(asked, source, arguments(source, function))
    came = replies(asked.exchanges)
    if verdict.mistake == "nothing-returned":
        verdict = _nothing_returned(function, came, source, verdict)
    if verdict.status != "passed":
        refused = [what for reply in came for what in reply.refused]
        if refused:
            return refusal(refused[0], None)
    return _changed_arguments(function, came, verdict)


def not_utf8(script: Path) -> str:
    """Return one line on a file that Python cannot read as text, or ""."""
    try:
        with tokenize.open(script) as file:
            file.read()
    except (SyntaxError, UnicodeDecodeError):
        return f"{script.name} is not in UTF-8. Save it as UTF-8 in your editor."
    return ""


def _nothing_returned(
    function: str, came: Sequence[Reply], source: str, verdict: Verdict
) -> Verdict:
    if slip := unfinished(source, function):
        return replace(verdict, message=slip)
    if any(reply.printed for reply in came):
        says = f"{verdict.message} Does it print the result instead of returning it?"
        return replace(verdict, message=says)
    return verdict


def _changed_arguments(
    function: str, came: Sequence[Reply], verdict: Verdict
) -> Verdict:
    """Return the verdict with the arguments that the function left changed."""
    changed = [name for reply in came for name in reply.changed]
    if not changed or verdict.status == "todo":
        return verdict
    name = changed[0]
    if verdict.mistake == "shares-its-argument":  # a copy at the end would not help
        says = f"{function} works in its argument {name} itself and returns it, so its "
        says += f"caller's numbers change. Begin with a copy: {name} = {name}.copy()"
        return replace(verdict, message=f"{says}.")
    says = f"{function} changed its argument {name}, which its caller still needs"
    says += f"; work on a copy: {name} = {name}.copy()" if name.isidentifier() else ""
    if verdict.status != "passed":
        return replace(verdict, message=f"{verdict.message} Besides, {says}.")
    says = f"The numbers are right, but {says}."
    return Verdict("wrong", "argument-changed", says, verdict.measured)
