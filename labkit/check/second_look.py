"""Second looks at a wrong function: whose fault it is, and when it is right."""

import re
from collections.abc import Callable, Iterable, Sequence
from itertools import chain
from typing import Any

from labkit.base.exchange import Question
from labkit.judge.ask import Asked, as_plain
from labkit.judge.mistake import InTurn
from labkit.judge.right_when import (
    QUESTIONS,
    Call,
    conclude,
    doublings,
    experiments,
    not_doubled,
)
from labkit.lesson import folder
from labkit.lesson.day import Day, Task
from labkit.lesson.starter import function_lines, read_script
from labkit.sandbox.sandbox import Session


def kits_functions(day: Day, tasks: Iterable[Task]) -> str:
    """Return code that puts functions of the complete lab below a file.

    The whole lab comes with it, so nothing that is answered then may pass.

    Args:
        day: whose complete lab it is; "" is returned where it is not there.
        tasks: whose functions.
    """
    names = [name for task in tasks for name in task.functions]
    if not names or not day.source.is_file():
        return ""
    text = folder.without_kit(read_script(day.source))
    lines = [f"_kits = {{'__name__': 'kits_lab'}}; exec({text!r}, _kits)"]
    lines += [f"{name} = _kits[{name!r}]" for name in names]
    return "\n\n" + "\n".join(lines) + "\n"


def kits_own(day: Day, tasks: Iterable[Task]) -> str:
    """Return code that puts the kit's own functions of some tasks below a file.

    No other function of the kit comes with them: what the file's own ask of these may
    pass, and they could call whatever is there.

    Args:
        day: whose complete lab has them; "" is returned where it is not there.
        tasks: that a file borrows.
    """
    names = [name for task in tasks for name in task.functions]
    if not names or not day.source.is_file():
        return ""
    text = read_script(day.source)
    own = "\n".join(chain.from_iterable(function_lines(text, n)[2] for n in names))
    return f"\n\nexec({own!r}, globals())\n"


def old_names(day: Day, text: str) -> str:
    """Return code that gives functions the names that the manifest has for them now.

    Args:
        day: from its manifest.
        text: a student's file, begun with an older one.
    """
    there = set(re.findall(r"^def (\w+)\(", text, re.MULTILINE))
    names = [pair for task in day.tasks for pair in task.renamed]
    lines = [
        f"{now} = {was}" for was, now in names if was in there and now not in there
    ]
    return "\n\n" + "\n".join(lines) + "\n" if lines else ""


def right_when(
    asked: Asked, wrong: Sequence[int], names: Sequence[str], session: Session
) -> str:
    """Return with which argument neutral a wrong function is right, or "".

    Args:
        asked: what it was asked.
        wrong: the places of the main questions that it answered wrongly.
        names: of its arguments.
        session: with its file loaded.
    """
    mains = [asked.main[i].question for i in wrong][-QUESTIONS:]
    calls = [question.args for question in mains]
    tried, twice = experiments(calls, names), doublings(calls, names)

    def answers(some: Sequence[Call]) -> list[Any]:
        questions = [Question(mains[0].task, asked.function, call) for call in some]
        came = session.ask(questions)
        return [None if reply.kind else reply.value for reply in came]

    given, doubled = ([answers(one.calls) for one in some] for some in (tried, twice))
    ask, near = asked.ask, asked.ask.near
    assert isinstance(ask.truth, InTurn)
    truth = _of_one(ask.truth)
    others = [_of_one(m.redo) for m in ask.named if isinstance(m.redo, InTurn)]
    says = conclude(tried, given, truth, near, others)
    more = not_doubled(twice, answers(calls), doubled, calls, truth, near)
    return f"{says} {more}".strip()


def _of_one(function: InTurn) -> Callable[..., Any]:
    """Return a function of one question's arguments."""
    return lambda *args: function.function(*map(as_plain, args))
