"""What a grade consists of, and its form in the journal and on the wire."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from robo47.lesson.day import Day

ITEMS = ("figure", "definitions", "drawings", "checklist", "metrics", "commit")
# Names of what is only not there yet: nothing to explain again.
NO_MISTAKES = ("", "unwritten", "waits", "not-started")
UNGRADED = "ungraded"  # the status of a task that nobody could look at


@dataclass(frozen=True)
class Mark:
    """How a task or a deliverable stands.

    Attributes:
        id: "1.4", or "figure".
        status: passed, close, wrong, todo or ungraded.
        mistake: its name, "chain-reversed"; "" where nothing has one.
        message: in the student's words.
    """

    id: str
    status: str
    mistake: str = ""
    message: str = ""

    @property
    def passed(self) -> bool:
        """Whether nothing is left to do."""
        return self.status == "passed"

    @property
    def is_mistake(self) -> bool:
        """Whether something was written and is not right, or cannot be read."""
        return not self.passed and self.mistake not in NO_MISTAKES


@dataclass(frozen=True)
class Result:
    """One student's grade.

    Attributes:
        tasks: in the manifest's order.
        items: the deliverables, in the order of `ITEMS`.
        text: what `make check` would have told the student.
        error: why something could not be graded; "" where all was.
    """

    tasks: tuple[Mark, ...]
    items: tuple[Mark, ...]
    text: str = ""
    error: str = ""

    @property
    def stopped_at(self) -> Mark | None:
        """The first task that is not passed, or None."""
        return next((task for task in self.tasks if not task.passed), None)

    @property
    def first_mistake(self) -> Mark | None:
        """The first task with a mistake in it, or None."""
        return next((task for task in self.tasks if task.is_mistake), None)

    def to_json(self) -> dict[str, Any]:
        """Return it as plain data."""
        return asdict(self)


def from_json(data: Mapping[str, Any]) -> Result:
    """Return a result from plain data.

    Raises:
        KeyError, TypeError: it is no result.
    """
    return Result(
        tuple(Mark(**mark) for mark in data["tasks"]),
        tuple(Mark(**mark) for mark in data["items"]),
        data["text"],
        data["error"],
    )


def ungraded(day: Day, why: str) -> Result:
    """Return the result of a submission that could not be graded.

    Args:
        day: from the manifest.
        why: one sentence, for the student and the teacher.
    """
    return Result(
        tuple(Mark(task.id, UNGRADED) for task in day.tasks),
        tuple(Mark(name, UNGRADED) for name in ITEMS),
        f"Day {day.number}: {day.title}\n\nThis could not be graded: {why}\n",
        why,
    )
