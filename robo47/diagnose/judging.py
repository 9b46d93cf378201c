"""The judge: from answers to a verdict, one look after another."""

from dataclasses import replace
from functools import cache
from types import ModuleType
from typing import Any

import numpy as np

from robo47.checks import Array
from robo47.diagnose import cases, close, form, parts, truth
from robo47.diagnose.compare import CLOSE, PASSED, apart, difference, matches
from robo47.diagnose.form import Finding
from robo47.diagnose.mistakes import OF_FUNCTION, Mistake
from robo47.diagnose.verdict import TASK_FUNCTIONS, Answer, Verdict

ON_THE_ARM = ("compose_fk", "link4_to_world")


def judge(task: str, answers: list[Answer]) -> Verdict:
    """Return what the answers to `calls(task)` show.

    Args:
        task: "1.1" to "1.8".
        answers: one per call, in order.

    Returns:
        The verdict; of a task with two functions that of the first which is not passed.

    Raises:
        ValueError: not one answer per call.
        KeyError: no such task.
    """
    names = TASK_FUNCTIONS[task]
    counts = [len(cases.arguments(name)) for name in names]
    if len(answers) != sum(counts):
        raise ValueError(
            f"{len(answers)} answers to {sum(counts)} calls of task {task}"
        )
    if error := form.unwritten(answers):
        return Verdict("todo", "unwritten", f"Not written yet: {_without_type(error)}")
    verdict = Verdict("passed", "", "")
    for name, count in zip(names, counts, strict=True):
        with np.errstate(all="ignore"):  # whatever the student's numbers lead to
            verdict = _judge(name, answers[:count])
        answers = answers[count:]
        if verdict.status != "passed":
            break
    if len(names) > 1 and verdict.message:
        return replace(verdict, message=f"{name}: {verdict.message}")
    return verdict


def _judge(function: str, answers: list[Answer]) -> Verdict:
    T = truth.right_answers(function)
    S = form.look(answers, T.shape[1:])
    if isinstance(S, Finding):
        return Verdict("wrong", *S)
    measured, off = _measured(function, S, T), difference(S, T).max()
    if off <= PASSED:
        return Verdict("passed", "", "", measured)
    if off <= close.SINGLE and form.single_precision(answers, S):
        says = f"Right, in float32: off by {off:.0e}. The labs use float64."
        return Verdict("passed", "", says, measured)
    if off <= CLOSE:
        return Verdict("close", *close.explain(function, S, T), measured)
    return Verdict("wrong", *_diagnose(function, S, T), measured)


def _measured(function: str, S: Array, T: Array) -> tuple[str, ...]:
    lines = parts.measured(S, T)
    return (*lines, _arm().measured(S, T)) if function in ON_THE_ARM else lines


def _diagnose(function: str, S: Array, T: Array) -> Finding:
    """Return the first of: a named mistake, one place in the arm, what is wrong."""
    arguments = truth.stacked_arguments(function)
    given = [in_words(args) for args in cases.arguments(function)]
    found = (
        parts.nothing_there(S)
        or redone(mistakes_of(function), arguments, S, T)
        or parts.not_finite(S, given)
        or parts.all_the_same(S, T)
        or close.rounded(S, T)
    )
    if found:
        return found
    if function in ON_THE_ARM:
        return _arm().diagnose(function, S, T, arguments[0], given)
    return parts.what_is_wrong(S, T, given)


@cache
def mistakes_of(function: str) -> list[Mistake]:
    """Return the named mistakes of a function, the more general first."""
    return (
        _arm().mistakes(function) if function in ON_THE_ARM else OF_FUNCTION[function]
    )


def _arm() -> ModuleType:
    """Return what needs the robot; MuJoCo's import is a student's 0.1 s, so late."""
    from robo47.diagnose import on_the_arm

    return on_the_arm


def redone(
    mistakes: list[Mistake], arguments: tuple[Array, ...], S: Array, T: Array
) -> Finding | None:
    """Return the first mistake that, made on purpose, gives the student's answers.

    Args:
        mistakes: the candidates.
        arguments: all calls' arguments stacked.
        S: the student's answers, (n, ...).
        T: the right ones.
    """
    for mistake in mistakes:
        again = mistake.redo(*arguments)
        if matches(S, again):
            says = mistake.says[0].upper() + mistake.says[1:]
            return Finding(
                mistake.slug,
                f"{says}. (Differs from the right answer by up to {apart(S, T)}, from "
                f"{mistake.redone} by {apart(S, again)}.)",
            )
    return None


def in_words(args: tuple[Any, ...]) -> str:
    """Return a call's input as a student can type it: angles and short vectors."""
    words = []
    for arg in args:
        if isinstance(arg, float):
            words.append(f"{arg:.3g}")
        elif isinstance(arg, np.ndarray) and arg.ndim == 1:
            words.append("(" + ", ".join(f"{x:.3g}" for x in arg) + ")")
    return " and ".join(words)


def _without_type(error: str) -> str:
    return error.partition(":")[2].strip() or "the task is still to do."
