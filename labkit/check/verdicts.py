"""From a task's replies to its verdict: what never was an answer, then the judge."""

import re
import tokenize
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from labkit.check.source_hints import arguments, unfinished
from labkit.judge.answers import ONLY_NUMPY
from labkit.judge.exchange import Reply
from labkit.judge.judging import judge
from labkit.judge.mistake import Verdict
from labkit.judge.rounds import Round
from labkit.lesson.day import Task
from robo47.paths import ROOT

IN_MAIN = 'Keep it below `if __name__ == "__main__":`, or in main().'


def verdict_of(
    task: Task, asked: Sequence[Round], replies: Sequence[Reply], source: str
) -> Verdict:
    """Return the verdict on a task; of several functions that of the first wrong one.

    Args:
        task: as in the manifest.
        asked: the questions to each of its functions.
        replies: to all of them, in order.
        source: the student's file.
    """
    verdict, at = Verdict("passed"), 0
    for one in asked:
        own = replies[at : at + len(one.questions)]
        at += len(own)
        verdict = _of_function(task, one, own, source)
        if len(asked) > 1 and verdict.message and not verdict.follows:
            verdict = replace(verdict, message=f"{one.function}: {verdict.message}")
        if verdict.status != "passed":
            break
    return verdict


def why_not_loaded(script: Path, reply: Reply) -> str:
    """Return one line on a file that Python could not load.

    Args:
        script: the student's file.
        reply: what loading it gave.
    """
    where = f"{script.name}, line {reply.line}" if reply.line else script.name
    if reply.kind == "SystemExit":
        return f"{where}: it ends Python while being loaded. {IN_MAIN}"
    if reply.kind == "RefusedError" and reply.refused:
        return f"{where}: while being loaded it wants to {reply.refused[0]}. {IN_MAIN}"
    if reply.kind == "EOFError":
        return f"{where}: while being loaded it asks for input. {IN_MAIN}"
    if reply.kind == "stopped":
        return f"{where}: while being loaded, {reply.error}. {IN_MAIN}"
    why = f"{where}: {reply.kind}: {reply.error}".rstrip(": ")
    if reply.kind == "ModuleNotFoundError":
        why += f".{ONLY_NUMPY} Import others in the function that uses them."
    elif reply.kind == "SyntaxError" and _line_of(script, reply).startswith("<<<<<<<"):
        why += ". This is the mark of a merge that git could not finish: keep one side."
    return why


def not_utf8(script: Path) -> str:
    """Return one line on a file that Python cannot read as text, or ""."""
    try:
        with tokenize.open(script) as file:
            file.read()
    except (SyntaxError, UnicodeDecodeError):
        return f"{script.name} is not in UTF-8. Save it as UTF-8 in your editor."
    return ""


def _line_of(script: Path, reply: Reply) -> str:
    lines = script.read_text("utf-8", errors="replace").splitlines()
    return lines[reply.line - 1] if reply.line and reply.line <= len(lines) else ""


def _of_function(
    task: Task, asked: Round, replies: Sequence[Reply], source: str
) -> Verdict:
    for reply in replies[: len(asked.main) + len(asked.fresh)]:
        if early := _early(task, asked.function, reply, source):
            return early
    verdict = judge(asked, replies, source, arguments(source, asked.function))
    if verdict.mistake == "nothing-returned":
        verdict = _nothing_returned(asked.function, replies, source, verdict)
    if verdict.status != "passed":
        refused = [what for reply in replies for what in reply.refused]
        if refused:
            return _refusal(refused[0], None)
    return _changed_arguments(asked.function, replies, verdict)


def _early(task: Task, function: str, reply: Reply, source: str) -> Verdict | None:
    """Return the verdict on a reply that never was an answer."""
    if reply.kind == "stopped":
        return Verdict("wrong", "stopped", f"{function} did not return: {reply.error}.")
    if reply.kind == "unsendable":
        return Verdict("wrong", "not-an-array", f"{function}: {reply.error}.")
    if reply.kind == "missing":
        says = (
            f"The file has no function {function}. To put its gap back: "
            f"make start RESET={task.id}."
        )
        return Verdict("wrong", "missing", says)
    if reply.kind == "waits":
        stopped = reply.error.removeprefix("task ")
        says = f"Not asked: it builds on task {stopped}, which did not return."
        return Verdict("todo", "waits", says, follows=stopped)
    if reply.kind == "BdbQuit":
        says = f"It stops in the debugger (line {reply.line}): take breakpoint() out."
        return Verdict("wrong", "breakpoint", says)
    if reply.kind == "RefusedError":
        return _refusal(reply.refused[0] if reply.refused else "", reply.line)
    if reply.kind == "NotImplementedError":
        named = re.search(r"task (\d+\.\d+)", reply.error)
        if named and named[1] != task.id:
            says = f"Waits for task {named[1]}, which it calls and which is to do."
            return Verdict("todo", "waits", says, follows=named[1])
        if slip := unfinished(source, function):
            return Verdict("todo", "raise-left-in", slip)
        says = f"Not written yet: {reply.error or 'the task is still to do.'}"
        return Verdict("todo", "unwritten", says)
    return None


def _nothing_returned(
    function: str, replies: Sequence[Reply], source: str, verdict: Verdict
) -> Verdict:
    if slip := unfinished(source, function):
        return replace(verdict, message=slip)
    if any(reply.printed for reply in replies):
        says = f"{verdict.message} Does it print the result instead of returning it?"
        return replace(verdict, message=says)
    return verdict


def _refusal(what: str, line: int | None) -> Verdict:
    """Return the verdict on code that wanted more than its arguments."""
    where = f" (line {line})" if line else ""
    for root in (str(ROOT), ROOT.as_posix()):
        what = what.replace(root + "/", "").replace(root + "\\", "")
    if what.startswith("call "):
        says = (
            f"It wants to {what}{where}. Here the point is to work the answer out "
            "yourself; MuJoCo is the judge."
        )
        return Verdict("wrong", "not-by-hand", says)
    says = f"It wants to {what}{where}. A task needs nothing but its arguments."
    return Verdict("wrong", "refused", says)


def _changed_arguments(
    function: str, replies: Sequence[Reply], verdict: Verdict
) -> Verdict:
    """Return the verdict with the arguments that the function left changed."""
    changed = [name for reply in replies for name in reply.changed]
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
