"""Replies that are no answer: what each kind of them means, in the checker's words."""

import re
from pathlib import Path

from labkit.judge.exchange import Reply
from labkit.judge.mistake import Verdict
from robo47.paths import ROOT

ONLY_NUMPY = " The checker has NumPy, the kit and Python's own modules alone."
IN_MAIN = 'Keep it below `if __name__ == "__main__":`, or in main().'


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
            says = f"{function} did not return: {reply.error}."
            return Verdict("wrong", "stopped", says)
        case "unsendable":
            return Verdict("wrong", "not-an-array", f"{function}: {reply.error}.")
        case "missing":
            says = f"The file has no function {function}."
            says += f" To put its gap back: make start RESET={task}." if task else ""
            return Verdict("wrong", "missing", says)
        case "waits":
            stopped = reply.error.removeprefix("task ")
            says = f"Not asked: it builds on task {stopped}, which did not return."
            return Verdict("todo", "waits", says, follows=stopped)
        case "BdbQuit":
            says = f"It stops in the debugger (line {reply.line}): take breakpoint()"
            return Verdict("wrong", "breakpoint", f"{says} out.")
        case "RefusedError":
            return refusal(reply.refused[0] if reply.refused else "", reply.line)
        case "NotImplementedError":
            named = re.search(r"task (\d+\.\d+)", reply.error)
            if named and named[1] != task:
                says = f"Waits for task {named[1]}, which it calls and which is to do."
                return Verdict("todo", "waits", says, follows=named[1])
            says = f"Not written yet: {reply.error or 'the task is still to do.'}"
            return Verdict("todo", "unwritten", says)
    return None


def stops_with(reply: Reply, often: str = "") -> str:
    """Return an exception of the student's own in a sentence.

    Args:
        reply: whose kind is the exception's name.
        often: in how many calls, as words; "" for one call.
    """
    where = f" (line {reply.line}" if reply.line else ""
    if callers := [f"line {line}" for line in reply.callers]:
        where += f", called from {', from '.join(callers)}"
    where += ")" if where else ""
    text = f"{reply.kind}: {reply.error}".rstrip().removesuffix(":")
    why = ONLY_NUMPY if reply.kind == "ModuleNotFoundError" else ""
    return f"It stops with {text}{where}{often}.{why}"


def refusal(what: str, line: int | None) -> Verdict:
    """Return the verdict on code that wanted more than its arguments.

    Args:
        what: it wanted: "read notes.txt".
        line: of the student's file, where it is known.
    """
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


def not_loaded(script: Path, reply: Reply) -> str:
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


def _line_of(script: Path, reply: Reply) -> str:
    lines = script.read_text("utf-8", errors="replace").splitlines()
    return lines[reply.line - 1] if reply.line and reply.line <= len(lines) else ""
