"""Day 21 in the inspector: the tab Push.

The policy that the kit has trained drives the pusher; its plans arrive late. The
student's `plan_entry` picks the actions, `push_ahead` predicts the state for which a
plan is drawn, and `conformal_limit` and `alarm_at` watch. A slider moves the puck after
two seconds, as a person could do, another one shifts the camera.
"""

from functools import cache
from typing import Any, NamedTuple

import numpy as np

from labkit.inspector import declared as ui
from labkit.inspector.draw import joined
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47 import deploy, push, pushing
from robo47.checks import Array
from robo47.pushing import guard

LAB = lab_of(find_day(21))
CIRCLE = np.linspace(0, 2 * np.pi, 40)
RING = np.column_stack([np.cos(CIRCLE), np.sin(CIRCLE), 0 * CIRCLE])
UP = 0.02  # m, the height of the puck; the plans are drawn above it
MOVED_AT = 20  # ticks
AWAY = 0.18  # m from home to the puck
WAYS = ("the predicted state", "the first row", "the row for now")
HOWS = dict(zip(WAYS, ("ahead", "first", "indexed"), strict=True))


class Pushed(NamedTuple):
    """An episode, the plan of each tick, and what the guard says of it."""

    seen: Array  # m, (T + 1, 4)
    plans: Array  # m, paths of the current plan, (T, K, 2)
    scores: Array  # (T + 1,)
    limit: float
    alarm: int


@cache
def usual() -> Array:
    """Train the policy by the library's functions, and return scores; four seconds."""
    return pushing.guard_scores(pushing.library())


def above(points: Array) -> Array:
    """Return points of the plane above the puck, (n, 3)."""
    return np.column_stack([points, np.full(len(points), 1.1 * UP)])


class Driver(LAB.Late):
    """The lab's late policy for one puck, with the functions of a file."""

    def __init__(self, fns: Any, ticks: int, how: str, shift: Array) -> None:
        """Begin at rest; `shift` is the error of each observation, m, (4,)."""
        super().__init__(pushing.policy(pushing.library()), 1, ticks, how)
        self.fns, self.shift = fns, shift
        self.plans: list[Array] = []

    def entry(self, tick: int) -> Array:
        """Return the action of the current plan for a tick, (1, 2)."""
        action = self.fns.plan_entry(self.plan, self.drawn, tick)
        limited = np.clip(np.asarray(action, float), -push.FASTEST, push.FASTEST)
        return limited.reshape(1, 2)

    def ahead(self, seen: Array, known: Array) -> Array:
        """Return the predicted observation, (4,)."""
        given = seen, known, push.TICK, LAB.PARTS, push.R
        return np.asarray(self.fns.push_ahead(*given), float)

    def __call__(self, seen: Array) -> Array:
        """Return the action of this tick, (1, 2)."""
        action = super().__call__(seen + self.shift)
        path = push.TICK * np.cumsum(self.plan.reshape(-1, 2), axis=0)
        self.plans.append(seen[0, :2] + path)
        return action


class Push(ui.Played):
    """A puck that is moved in mid-push, late plans, a wrong camera and a guard."""

    title = "Push"
    library = deploy
    functions = {"plan_entry": "m/s", "push_ahead": "m", "conformal_limit": "",
                 "alarm_at": ""}  # fmt: skip
    arm_hidden = True
    camera = ((0.0, -0.45, 0.6), (0.0, 0.0, 0.0))

    angle = ui.slider("puck: direction", -3.1, 3.1, 2.3)
    moved = ui.slider("puck moved after 2 s", -80, 80, 60, "mm", 5)
    late = ui.slider("delay", 0, 3, 3, "ticks", 1)
    way = ui.choice("late plans use", WAYS)
    camera_off = ui.slider("camera shifted by", -40, 40, 0, "mm", 5)
    bars = ui.panel.bars(
        ["largest score"], 1.5, "", "novelty of the observations", "both"
    )
    home = ui.scene.curve(push.HOME * RING, "green", legend="home")
    best = ui.scene.lines(ui.NOWHERE, "white", legend="the pusher by the library")
    beads = ui.yours.lines(ui.NOWHERE, "purple", legend="the current plan")
    puck = ui.yours.disc(push.PUCK, UP, "orange", 0.6, legend="puck")
    pusher = ui.yours.disc(push.PUSHER, 3 * UP, "grey", legend="pusher")

    def ask(self, fns, at) -> Pushed:
        shift = np.array([0.0, 0.0, at.camera_off / 1000, 0.0])
        drive = Driver(fns, int(at.late), HOWS[at.way], shift)
        away = np.array([np.cos(at.angle), np.sin(at.angle)])
        start = np.array([[0.0, 0.0, *(AWAY * away)]])
        world = push.scene()
        first = push.run(*world, start, drive, MOVED_AT).observation[0]
        x, y = away
        then = first[-1:] + np.array([0, 0, -y, x]) * at.moved / 1000
        rest = push.run(*world, then, drive, push.STEPS - MOVED_AT).observation[0]
        seen = np.concatenate([first[:-1], rest])
        scores = guard.novelty(pushing.library(), seen + shift)
        limit = float(fns.conformal_limit(usual(), LAB.SHARE))
        alarm = int(fns.alarm_at(scores, limit, LAB.IN_A_ROW))
        return Pushed(seen, np.array(drive.plans[1:]), scores, limit, alarm)

    def show(self, yours: Pushed, right: Pushed) -> None:
        self.seen = yours
        self.best.points = joined(above(right.seen[:, :2]))
        self.bars.show([yours.scores.max()], [right.limit])
        self.play()

    def frame(self, seconds: float) -> bool:
        last = len(self.seen.plans) - 1
        k = min(int(seconds / push.TICK), last)
        now = self.seen.seen[k]
        self.pusher.position = np.array([*now[:2], 1.5 * UP])
        self.puck.position = np.array([*now[2:], UP / 2])
        self.beads.points = joined(above(self.seen.plans[k]))
        return k < last

    def says(self, yours: Pushed, right: Pushed):
        off = 1000 * np.linalg.norm(yours.seen[-1, 2:])
        says = f"The puck ends {off:.0f} mm from home."
        yield says, "plan_entry push_ahead"
        alarm = "no alarm"
        if yours.alarm >= 0:
            alarm = f"an alarm at {yours.alarm * push.TICK:.1f} s"
        says = f"The guard raises {alarm} (limit {yours.limit:.2f})."
        yield says, "conformal_limit alarm_at"
        yield "The policy was trained with the library's functions.", None


TABS = [Push]
