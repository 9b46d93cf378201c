"""The call of a task that failed, as a picture: its arguments, and both answers.

    make view TASK=1.2

What is drawn are configurations, poses and points, and rotations as frames at the
origin. The arm stands in the first configuration that is among the arguments. Metres,
radians; everything is drawn in one frame, whatever frame the task expresses it in.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from labkit.check.tasks import TaskResult
from labkit.inspector import words
from labkit.inspector.ghost import nearest_pose
from labkit.inspector.standing import Standing, named
from labkit.inspector.tab import Tab
from labkit.judge.kinds import Kind
from labkit.judge.mistake import Example, Finding
from labkit.judge.other_kinds import Points
from labkit.judge.results import places, split
from labkit.judge.rigid_kinds import Pose, Rotation
from labkit.judge.row import Row, row_of
from labkit.lesson.day import Day
from robo47 import se3
from robo47.checks import Array

if TYPE_CHECKING:
    from labkit.inspector.page import Page
    from labkit.inspector.scene import View

GIVEN, YOURS, EXPECTED = "given", "yours", "expected"
JOINTS = 7
# How the labs call positions, and what their docstrings say of these.
PLACES = re.compile(
    r"(p|pos|points?|centre|coms?|c\d?|o|t|[ab]\d|source|target)(_\w+)?"
)
IN_SPACE = re.compile(r"\bmetres\b|\bpoints?\b|\bcentres? of mass\b")
FARTHEST = 5.0  # metres; what is farther away is not drawn
AROUND = 0.3  # metres around what is drawn
MOST = 40  # points or poses of one argument
COLOURS = {GIVEN: (236, 239, 243), YOURS: (232, 64, 58), EXPECTED: (70, 145, 235)}
MEANING = {GIVEN: "an argument", YOURS: "YOUR answer", EXPECTED: "the expected answer"}
FROM, SHARE = (1.3, -1.7, 0.9), 0.8  # to the camera; of the picture's height
RADII = {GIVEN: 0.012, YOURS: 0.016, EXPECTED: 0.014}  # metres; none hides another
AXES = {GIVEN: 0.12, YOURS: 0.15, EXPECTED: 0.18}  # metres of a frame's axes
BESIDE = 0.07 * np.ones(3)  # metres from a frame's origin to its name, in its axes


class Thing(NamedTuple):
    """Something that is drawn."""

    name: str  # of the argument, or of a part of the answer
    whose: str  # GIVEN, YOURS or EXPECTED
    value: Array  # a configuration (7,), a pose (4, 4), points (n, 3)

    @property
    def label(self) -> str:
        """What is written beside it."""
        return self.name if self.whose == GIVEN else f"{self.whose}{self.name}"


@dataclass(frozen=True)
class Drawing:
    """What can be drawn of a call."""

    arms: tuple[Thing, ...] = ()
    frames: tuple[Thing, ...] = ()
    points: tuple[Thing, ...] = ()

    @property
    def all(self) -> tuple[Thing, ...]:
        """All of it; nothing where nothing can be drawn."""
        return (*self.arms, *self.frames, *self.points)

    @property
    def q(self) -> Array | None:
        """The configuration in which the arm stands, (7,), or None."""
        given = (arm.value for arm in self.arms if arm.whose == GIVEN)
        return next(given, None)

    @property
    def ball(self) -> tuple[Array, float]:
        """The middle and the radius of a ball around frames and points, metres."""
        places = [one.value[None, :3, 3] for one in self.frames]
        some = np.vstack([*places, *(one.value for one in self.points)])
        low, high = some.min(axis=0), some.max(axis=0)
        return (low + high) / 2, float(np.linalg.norm(high - low)) / 2 + AROUND

    @property
    def others(self) -> tuple[Thing, ...]:
        """The other configurations."""
        return tuple(arm for arm in self.arms if arm.value is not self.q)


def sentence_of(result: TaskResult, drawing: Drawing) -> str:
    """Return in one line why there is no picture, "" where there is one."""
    id, verdict = result.task.id, result.verdict
    if result.passed:
        day = id.partition(".")[0]
        return f"Task {id} passes, so none of its calls fails. See: make view DAY={day}"
    if verdict.example is None:
        says = f"Task {id} has no failing call yet. {verdict.message}".rstrip()
        other = verdict.follows
        return f"{says} See: make view TASK={other}" if other else says
    if not drawing.all:
        what = "The failing call has no configuration, pose or point to draw."
        read = f"To read it with what was measured: make check TASK={id} ARGS=--explain"
        return f"Task {id}: {what} {read}"
    return ""


def drawing_of(day: Day, result: TaskResult) -> Drawing:
    """Return what can be drawn of a task's failing call; nothing where there is none.

    Args:
        day: of the task.
        result: of its check.
    """
    example = result.verdict.example
    if example is None:
        return Drawing()
    row = row_of(day, example.question.function)
    given = dict(zip(row.arguments, example.question.args, strict=False))
    things = [*_given(row, given)]
    begun = any(_is_configuration(name, value) for name, value in given.items())
    things += _answers(row, example, begun)
    kept = [one for one in things if _near(one)]
    shapes = {"arms": (JOINTS,), "frames": (4, 4)}
    found = {
        kind: tuple(one for one in kept if one.value.shape == shape)
        for kind, shape in shapes.items()
    }
    points = tuple(one for one in kept if one.value.shape not in shapes.values())
    return Drawing(**found, points=points)


def _near(one: Thing) -> bool:
    """Return whether something is near enough to be drawn; a NaN is not."""
    if one.value.shape == (JOINTS,):
        return bool(np.abs(one.value).max() < 2 * np.pi)
    place = one.value[:3, 3] if one.value.shape == (4, 4) else one.value
    return bool(place.size and np.abs(place).max() < FARTHEST)


def _given(row: Row, given: dict[str, Any]) -> Iterator[Thing]:
    """Yield what can be drawn of the arguments."""
    for name, value in given.items():
        if not isinstance(value, np.ndarray) or value.dtype.kind not in "fiu":
            continue
        array = value.astype(float)
        pose = array.shape == (4, 4) and se3.is_pose(array)
        if pose or _is_configuration(name, value):
            yield Thing(name, GIVEN, array)
        elif array.shape == (3, 3) and se3.is_rotation(array):
            yield Thing(name, GIVEN, se3.make_T(array, np.zeros(3)))
        elif array.ndim == 3 and array.shape[1:] == (4, 4) and len(array) <= MOST:
            for k, T in enumerate(array):
                yield Thing(f"{name}[{k}]", GIVEN, T)
        elif array.shape[-1:] == (3,) and array.ndim <= 2 and _is_place(row, name):
            yield Thing(name, GIVEN, array.reshape(-1, 3)[:MOST])


def _is_configuration(name: str, value: Any) -> bool:
    """Return whether an argument is a configuration of the arm: q, q0 or q_start."""
    named = re.fullmatch(r"q(\d|_\w+)?", name)
    return bool(named) and np.shape(value) == (JOINTS,)


def _is_place(row: Row, name: str) -> bool:
    """Return whether an argument is a point, or points: by its name and the docstring.

    The names are those of the labs; a `target` may also be a configuration.
    """
    text = getattr(row.lab, row.function).__doc__ or ""
    return bool(PLACES.fullmatch(name)) and bool(IN_SPACE.search(text))


def _answers(row: Row, example: Example, begun: bool) -> Iterator[Thing]:
    """Yield what can be drawn of the student's answer and of the right one."""
    kinds, kind = row.ask.kinds, row.ask.kind
    mine = split(kind, example.returned)
    names = places(kind)
    for whose, parts in ((EXPECTED, example.right), (YOURS, mine)):
        if isinstance(parts, Finding):
            continue
        for name, one, part in zip(names, kinds, parts, strict=False):
            if (value := _drawn(one, part, begun)) is not None:
                yield Thing(name, whose, value)


def _drawn(kind: Kind, part: Any, begun: bool) -> Array | None:
    """Return an answer as a configuration, a pose or points; None where it is none.

    Args:
        kind: of the answer.
        part: the answer, of whatever shape.
        begun: whether a configuration is among the arguments: else angles are a step.
    """
    try:
        array = np.asarray(part, dtype=float)
    except (TypeError, ValueError):
        return None
    if not array.size or not np.isfinite(array).all() or not kind.fits(array.shape):
        return None
    if isinstance(kind, Pose):
        return nearest_pose(array)
    if isinstance(kind, Rotation):
        return nearest_pose(se3_like(array))
    if isinstance(kind, Points) or (kind.unit == "m" and kind.shape[-1:] == (3,)):
        return array.reshape(-1, 3)[:MOST]
    if kind.unit == "rad" and array.shape == (JOINTS,) and begun:
        return array
    return None


def se3_like(R: Array) -> Array:
    """Return [[R, 0], [0, 1]] of any matrix, (3, 3), rotation or not."""
    T = np.eye(4)
    T[:3, :3] = R
    return T


def failing_tab(day: Day, result: TaskResult) -> type[Tab]:
    """Return a tab that shows a task's failing call, anew after every check."""
    about: dict[str, Any] = {"title": named(result), "day": day, "result": result}
    drawing = drawing_of(day, result)
    if drawing.q is None and (drawing.frames or drawing.points):
        about["camera"] = _view(*drawing.ball)
    return type("OfTheTask", (FailingCall,), about)


def _view(middle: Array, radius: float) -> "View":
    """Return from where to look at a ball, so that it is left of the panel."""
    from labkit.inspector.scene import BESIDE, FOV

    distance = radius / np.tan(FOV / 2) / SHARE
    back = np.array(FROM) / np.linalg.norm(FROM)
    right = np.cross([0.0, 0.0, 1.0], back)
    right /= np.linalg.norm(right)
    aim = middle + 2 * distance * np.tan(FOV / 2) * BESIDE * right
    return tuple(aim + distance * back), tuple(aim)


class FailingCall(Tab):
    """What is wrong at one call: its arguments, the student's answer, the right one."""

    wide = True
    solid = False  # a frame may be inside of a link
    day: Day
    result: TaskResult

    def __init__(self, page: "Page") -> None:
        super().__init__(page)
        self.text = page.html()
        self.sketch: Any = None
        self.ghosts = {whose: page.draw.ghost(c) for whose, c in COLOURS.items()}
        page.light(None, ())
        if drawing_of(self.day, self.result).q is None:
            page.hide_arm()
        self.show(self.result)

    def judged(self, standing: Standing) -> None:
        """Show the same task's call of the newest check, or that it is at work."""
        self.text.content = words.line(standing.sentence, "call", standing.kind)
        for result in standing.tasks:
            if result.task.id == self.result.task.id:
                self.show(result)

    def show(self, result: TaskResult) -> None:
        """Draw the call, and write it."""
        drawing = drawing_of(self.day, result)
        why = sentence_of(result, drawing)
        kind = "good" if result.passed else "quiet" if why else "bad"
        text = words.line(why or result.verdict.call, "call", kind)
        if (matrices := result.verdict.compared) and not result.passed:
            text += words.matrix("yours", matrices.returned, "yours", matrices.wrong)
            text += words.matrix("expected", matrices.expected, "expected")
        self.text.content = text
        if drawing.q is not None:
            whole = self.page.q
            whole[:JOINTS] = drawing.q
            self.page.move(whole)
        for whose, ghost in self.ghosts.items():
            others = [one.value for one in drawing.others if one.whose == whose]
            ghost.pose(self.page.links(others[0]) if others else {})
        self.draw(drawing)

    def draw(self, drawing: Drawing) -> None:
        """Draw the frames and the points in place of those before, each by its name."""
        if self.sketch is not None:
            self.sketch.clear()
        self.sketch = sketch = self.page.draw.part()
        drawn = {one.whose for one in drawing.all}
        legend = {MEANING[w]: colour for w, colour in COLOURS.items() if w in drawn}
        self.page.legend(legend)
        words_at: list[tuple[str, Array]] = []
        for one in drawing.frames:
            origin, radius = one.value[:3, 3], RADII[one.whose]
            ends = origin + AXES[one.whose] * one.value[:3, :3].T
            arrows = np.stack([np.broadcast_to(origin, ends.shape), ends], axis=1)
            sketch.arrows(arrows, COLOURS[one.whose], 0.4 * radius)
            sketch.sphere(origin, radius, COLOURS[one.whose])
            words_at += zip("xyz", ends, strict=True)
            words_at += [(one.label, origin + one.value[:3, :3] @ BESIDE)]
        for one in drawing.points:
            for point in one.value:
                sketch.sphere(point, RADII[one.whose], COLOURS[one.whose])
            words_at += [(one.label, one.value[0] + BESIDE)]
        if words_at:
            texts, places = zip(*words_at, strict=True)
            sketch.labels(texts).show(np.array(places))
