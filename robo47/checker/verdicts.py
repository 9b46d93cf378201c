"""What a task's replies show, before and after the judge's own word."""

import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from robo47 import diagnose
from robo47.checker import variant
from robo47.checker.replies import Model, Question, Reply
from robo47.diagnose import Answer, Verdict
from robo47.paths import ROOT
from robo47.week import Task

Exchange = tuple[Question, Reply]


def verdict_of(task: Task, own: Sequence[Exchange]) -> Verdict:
    """Return the verdict on a task.

    Args:
        task: as in the manifest.
        own: its questions and replies: the judge's first, then `variant`'s.
    """
    for question, reply in own:
        if early := _without_judge(task, question, reply):
            return early
    count = len(diagnose.calls(task.id))
    verdict = diagnose.judge(task.id, [_answer(reply) for _, reply in own[:count]])
    if verdict.status == "passed":
        verdict = _second_look(task, own, own[count:], verdict)
    elif refused := [what for _, reply in own for what in reply.refused]:
        return _refusal(refused[0], None)
    return _side_effects(own, verdict)


def why_not_loaded(script: Path, reply: Reply) -> str:
    """Return one line on a file that Python could not load.

    Args:
        script: the student's file.
        reply: what loading it gave.
    """
    where = f"{script.name}, line {reply.line}" if reply.line else script.name
    if reply.kind == "SystemExit":
        return (
            f"{where}: it ends Python while being loaded. Keep sys.exit below "
            '`if __name__ == "__main__":`.'
        )
    if reply.kind == "RefusedError" and reply.refused:
        return f"{where}: while being loaded it wants to {reply.refused[0]}."
    if reply.kind == "stopped":
        return f"{where}: while being loaded, {reply.error}."
    return f"{where}: {reply.kind}: {reply.error}"


def _without_judge(task: Task, question: Question, reply: Reply) -> Verdict | None:
    """Return the verdict on a reply that never was an answer."""
    function = question.function
    if reply.kind == "stopped":
        return Verdict("wrong", "stopped", f"{function} did not return: {reply.error}.")
    if reply.kind == "waits":
        return Verdict(
            "todo", "waits", f"Waits for {reply.error}, which did not return."
        )
    if reply.kind == "unsendable":
        return Verdict("wrong", "not-an-array", f"{function}: {reply.error}.")
    if reply.kind == "missing":
        says = (
            f"The file has no function {function}. To put its gap back: "
            f"make start RESET={task.id}"
        )
        return Verdict("wrong", "missing", says)
    if reply.kind == "RefusedError":
        return _refusal(reply.refused[0] if reply.refused else "", reply.line)
    if reply.kind == "NotImplementedError":
        named = re.search(r"task (\d+\.\d+)", reply.error)
        if named and named[1] != task.id:
            says = f"Waits for task {named[1]}, which it calls and which is to do."
            return Verdict("todo", "waits", says)
    return None


def _answer(reply: Reply) -> Answer:
    if not reply.kind:
        return Answer(reply.value)
    where = f" (line {reply.line}" if reply.line else ""
    if callers := [f"line {line}" for line in reply.callers]:
        where += f", called from {', from '.join(callers)}"
    where += ")" if where else ""
    return Answer(None, f"{reply.kind}: {reply.error}{where}")


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


def _side_effects(own: Sequence[Exchange], verdict: Verdict) -> Verdict:
    """Return the verdict with what the functions did beside returning something."""
    if verdict.mistake == "nothing-returned" and any(reply.printed for _, reply in own):
        says = f"{verdict.message} Does it print the result instead of returning it?"
        return replace(verdict, message=says)
    changed = [(asked.function, name) for asked, r in own for name in r.changed]
    if not changed or verdict.status == "todo":
        return verdict
    function, name = changed[0]
    says = f"{function} changed its argument {name}, which its caller still needs"
    says += f"; work on a copy: {name} = {name}.copy()" if name.isidentifier() else ""
    if verdict.status != "passed":
        return replace(verdict, message=f"{verdict.message} Besides, {says}.")
    says = f"The numbers are right, but {says}."
    return Verdict("wrong", "argument-changed", says, verdict.measured)


def _second_look(
    task: Task, own: Sequence[Exchange], extra: Sequence[Exchange], passed: Verdict
) -> Verdict:
    """Return the verdict on right answers: how did they come about?"""
    known, longer = (_fresh_error(extra, which) for which in (0, 1))
    if known > variant.AGREES:
        says = (
            "Right at the angles that are always asked, but off by "
            f"{known:.3g} at fresh ones: the answers are not computed from q."
        )
        return Verdict("wrong", "looked-up", says, passed.measured)
    if _ignores_path(extra):
        says = (
            "Right for the whole arm, but it does not look at path: asked for the path "
            "to link4, it goes on to the end effector all the same."
        )
        return Verdict("wrong", "path-ignored", says, passed.measured)
    if longer > variant.AGREES:
        says = (
            "Right for this Panda. On one with longer links it would not be: it does "
            "not take every pos from the model that it is given."
        )
        return replace(passed, message=f"{passed.message} {says}".strip())
    return passed


def _ignores_path(extra: Sequence[Exchange]) -> bool:
    """Return whether a shorter path gave the very pose that the whole one gives.

    An error does not count: a chain of one's own may take no path at all.
    """
    whole, short = (
        [
            r.value
            for q, r in extra
            if q.args[0] == Model(0) and (len(q.args) > 2) == given
        ]
        for given in (False, True)
    )
    if not short or not isinstance(short[0], np.ndarray):
        return False
    return short[0].shape == (4, 4) and np.allclose(short[0], whole[0], atol=1e-9)


def _fresh_error(extra: Sequence[Exchange], which: int) -> float:
    """Return how far a chain is off at fresh angles on one Panda; 0 if never asked."""
    fresh = [
        (question, reply)
        for question, reply in extra
        if question.args[0] == Model(which) and len(question.args) == 2
    ]
    if not fresh:
        return 0.0
    q = np.array([question.args[1] for question, _ in fresh])
    values = [reply.value for _, reply in fresh]
    return variant.worst_error(which, fresh[0][0].function, q, values)
