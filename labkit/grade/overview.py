"""Overview of the class: where people stop, which mistakes are common."""

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from labkit.grade.result import Mark, Result
from labkit.grade.sheet import Graded
from labkit.grade.similar import Group
from labkit.lesson.day import Day


@dataclass(frozen=True)
class Course:
    """What a page is about.

    Attributes:
        day: from the manifest.
        class_: everybody, in the order to show them.
        alike: similar submissions, by folder.
        reference: what commit times count to, seconds since 1970.
        deadline: whether that is the deadline.
        seed: of the fresh inputs.
    """

    day: Day
    class_: Sequence[Graded]
    alike: Sequence[Group]
    reference: int
    deadline: bool
    seed: int = 0


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
        stopped: students whose first open task this is, though their file loads and
            they have begun.
    """

    id: str
    counts: Counter[str]
    stopped: int = 0


def state(graded: Graded) -> str:
    """Return where a student is, in a word or three; the page lists them so."""
    tasks = graded.result.tasks
    if any(task.status == "ungraded" for task in tasks):
        return "ungraded"
    if all(task.passed for task in tasks):
        return "done"
    if graded.result.does_not_load:
        return "does not load"
    if graded.result.first_mistake:
        return "stuck"
    return "under way" if any(task.passed for task in tasks) else "not started"


def standings(
    class_: Sequence[Graded], marks_of: Callable[[Result], Sequence[Mark]]
) -> list[Standing]:
    """Return how the class stands with each task, or each deliverable.

    Args:
        class_: everybody.
        marks_of: what to return of a result: its tasks or its items.
    """
    stops = Counter(
        mark.id
        for graded in class_
        if state(graded) in ("stuck", "under way")
        if (mark := graded.result.stopped_at) is not None
    )
    counts: dict[str, Counter[str]] = {}
    for graded in class_:
        for mark in marks_of(graded.result):
            counts.setdefault(mark.id, Counter())[shown_status(graded, mark)] += 1
    return [Standing(id, count, stops[id]) for id, count in counts.items()]


def shown_status(graded: Graded, mark: Mark) -> str:
    """Return a mark's status; a file that does not load has one of its own."""
    broken = mark.mistake == "does-not-load" and graded.result.does_not_load
    return "does not load" if broken else mark.status


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
        mark = marks.get(task.id)
        if mark is None or not mark.is_mistake or graded.result.does_not_load:
            continue
        if all(marks[need].passed for need in task.needs if need in marks):
            roots.setdefault(mark.mistake, mark)
    return roots
