"""A student's grade, and its form in the journal and on the wire."""

import functools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from labkit.handin.deliverables import item_names
from labkit.lesson.day import Day

FAULT = "this machine failed ({}); the same command tries again"
UNGRADED = "ungraded"  # the status of a task that nobody could look at
MOST_TEXT = 200_000  # bytes of all texts of a result; what we tell has half
STATUSES = ("passed", "close", "wrong", "todo", UNGRADED)
ELSEWHERE = "elsewhere"  # the script is there, but not in its place
# Names of what is only not there yet: nothing to explain again.
NO_MISTAKES = (
    *("", "unwritten", "waits", "inherited", "borrowed", "not-started"),
    ELSEWHERE,
)


@dataclass(frozen=True)
class Mark:
    """The result of a task or a deliverable."""

    id: str  # "1.4", or "figure"
    status: str  # one of STATUSES
    mistake: str = ""  # its name, "chain-reversed"; "" where nothing has one
    message: str = ""  # the message, addressed to the student

    @property
    def passed(self) -> bool:
        """Nothing is left to do."""
        return self.status == "passed"

    @property
    def shown(self) -> str:
        """The status; a task of a file that does not load has one of its own."""
        return "does not load" if self.mistake == "does-not-load" else self.status

    @property
    def is_mistake(self) -> bool:
        """The student wrote something that is wrong or cannot be read."""
        return not self.passed and self.mistake not in NO_MISTAKES


@dataclass(frozen=True)
class Result:
    """One student's grade for one day."""

    tasks: tuple[Mark, ...]  # those that count, in the manifest's order
    items: tuple[Mark, ...]  # the deliverables
    text: str = ""  # the text that `make check` would have printed
    error: str = ""  # why something could not be graded; "" where all was
    # Requests of the code that were refused, though its answers may be right.
    refused: tuple[str, ...] = ()
    kit: str = ""  # version of the kit that gave it; "" where nothing was graded
    seed: int = 0  # the seed of its fresh inputs

    @property
    def stopped_at(self) -> Mark | None:
        """The first task that is not passed, or None."""
        return next((task for task in self.tasks if not task.passed), None)

    @property
    def first_mistake(self) -> Mark | None:
        """The first task with a mistake in it, or None."""
        return next((task for task in self.tasks if task.is_mistake), None)

    @property
    def score(self) -> tuple[int, int]:
        """The numbers of tasks and of deliverables that pass, to compare results."""
        return sum(m.passed for m in self.tasks), sum(m.passed for m in self.items)

    @property
    def is_elsewhere(self) -> bool:
        """The script was found in a place where it does not count."""
        return any(task.mistake == ELSEWHERE for task in self.tasks)

    @property
    def does_not_load(self) -> bool:
        """There is a file that Python or the grader cannot read."""
        return any(task.mistake == "does-not-load" for task in self.tasks)


@functools.lru_cache(4096)  # a class has few different marks, and holds each once
def _one(mark: Mark) -> Mark:
    """Return the mark that was there first of all that are equal."""
    return mark


def from_json(data: Mapping[str, Any], day: Day) -> Result:
    """Return a result from plain data.

    Raises:
        ValueError, KeyError, TypeError: it is no result of that day.
    """
    result = Result(
        tuple(Mark(**mark) for mark in data["tasks"]),
        tuple(Mark(**mark) for mark in data["items"]),
        data["text"],
        data["error"],
        tuple(data["refused"]),
        data["kit"],
        data["seed"],
    )
    marks = (*result.tasks, *result.items)
    if [mark.id for mark in marks] != [*counted(day), *item_names(day)]:
        raise ValueError("other tasks than the day's")
    texts = [result.text, result.error, result.kit, *result.refused]
    texts += [text for mark in marks for text in (mark.mistake, mark.message)]
    if not all(isinstance(text, str) for text in texts):
        raise TypeError("no text")
    if len("\n".join(texts).encode()) > MOST_TEXT:  # a lone surrogate is no text
        raise ValueError("far too much text")
    if type(result.seed) is not int:
        raise TypeError("no seed")
    if not all(mark.status in STATUSES for mark in marks):
        raise ValueError("no status")
    tasks, items = (tuple(map(_one, some)) for some in (result.tasks, result.items))
    return replace(result, tasks=tasks, items=items)


def counted(day: Day) -> Sequence[str]:
    """Return the ids of the tasks that a grade counts: none that is optional."""
    return [task.id for task in day.tasks if not task.optional]


def ungraded(day: Day, why: str) -> Result:
    """Return the result of a submission that could not be graded.

    Args:
        day: from the manifest.
        why: one sentence, for the student and the teacher.
    """
    return Result(
        tuple(Mark(id, UNGRADED) for id in counted(day)),
        tuple(Mark(name, UNGRADED) for name in item_names(day)),
        f"Day {day.number}: {day.title}\n\nThis could not be graded: {why}\n",
        why,
    )


def kept_busy(day: Day, why: str) -> Result:
    """Return the result of a submission that nobody could look at to its end.

    Args:
        day: from the manifest.
        why: as for `ungraded`; it is the submission's fault, so it counts.
    """
    says = f"the check of this file was stopped: {why}"
    bare = ungraded(day, says)
    tasks = (Mark(id, "wrong", "too-slow", says) for id in counted(day))
    items = (Mark(name, "todo") for name in item_names(day))
    return replace(bare, tasks=tuple(tasks), items=tuple(items))
