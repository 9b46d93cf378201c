"""What the page is about."""

from collections.abc import Sequence
from dataclasses import dataclass

from robo47.grading.sheet import Graded
from robo47.grading.similar import Group
from robo47.lesson.day import Day


@dataclass(frozen=True)
class Course:
    """What the page is about.

    Attributes:
        day: from the manifest.
        class_: everybody, in the order to show them.
        alike: similar submissions, by folder.
        reference: what commit times count to, seconds since 1970.
        deadline: whether that is the deadline.
    """

    day: Day
    class_: Sequence[Graded]
    alike: Sequence[Group]
    reference: int
    deadline: bool
