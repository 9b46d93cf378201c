"""What the class as a whole shows: where people stop, which mistakes are common."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from robo47.grading.result import Mark
from robo47.grading.sheet import Graded
from robo47.lesson.day import Day


@dataclass(frozen=True)
class Diagnosis:
    """One mistake and who made it.

    Attributes:
        mistake: its name.
        task: the task in which most made it.
        example: what one of them was told.
        who: their names.
    """

    mistake: str
    task: str
    example: str
    who: tuple[str, ...]


@dataclass(frozen=True)
class Standing:
    """How many of the class stand where with one task or deliverable.

    Attributes:
        id: "1.4", or "figure".
        counts: number of students by status.
        stopped: students whose first open task this is.
    """

    id: str
    counts: Counter[str]
    stopped: int = 0


def state(graded: Graded) -> str:
    """Return where a student is: done, stuck, under way, not started or ungraded."""
    tasks = graded.result.tasks
    if any(task.status == "ungraded" for task in tasks):
        return "ungraded"
    if all(task.passed for task in tasks):
        return "done"
    if graded.result.first_mistake:
        return "stuck"
    return "under way" if any(task.passed for task in tasks) else "not started"


def tasks_standing(day: Day, class_: Sequence[Graded]) -> list[Standing]:
    """Return how the class stands with each task."""
    stops = Counter(
        mark.id for graded in class_ if (mark := graded.result.stopped_at) is not None
    )
    return [
        Standing(task.id, Counter(g.result.tasks[i].status for g in class_), n)
        for i, task in enumerate(day.tasks)
        for n in [stops[task.id]]
    ]


def items_standing(class_: Sequence[Graded]) -> list[Standing]:
    """Return how the class stands with each deliverable."""
    names = [item.id for item in class_[0].result.items] if class_ else []
    return [
        Standing(name, Counter(g.result.items[i].status for g in class_))
        for i, name in enumerate(names)
    ]


def diagnoses(day: Day, class_: Sequence[Graded]) -> list[Diagnosis]:
    """Return the mistakes of the class, the most common first.

    A mistake counts where it was made: in a task that builds on no other open one. It
    counts once per student.
    """
    made: dict[str, list[tuple[str, Mark]]] = {}
    for graded in class_:
        for name, mark in _roots(day, graded).items():
            made.setdefault(name, []).append((graded.student.name, mark))
    found = [
        Diagnosis(
            name,
            Counter(mark.id for _, mark in some).most_common(1)[0][0],
            some[0][1].message,
            tuple(who for who, _ in some),
        )
        for name, some in made.items()
    ]
    return sorted(found, key=lambda one: (-len(one.who), one.task, one.mistake))


def _roots(day: Day, graded: Graded) -> dict[str, Mark]:
    """Return a student's mistakes in tasks whose needs are all passed, by name."""
    marks = {mark.id: mark for mark in graded.result.tasks}
    roots: dict[str, Mark] = {}
    for task in day.tasks:
        mark = marks[task.id]
        if mark.is_mistake and all(marks[need].passed for need in task.needs):
            roots.setdefault(mark.mistake, mark)
    return roots
