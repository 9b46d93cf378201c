"""Day 13 in the inspector: the tab Best.

Three arms draw Day 3's circle within the joints' limits: one by Day 3's step, clipped;
one by the student's `qp_ik`; one, grey, by the library's. Bars show the speeds that the
student's step asks for, and what each limit costs, by the student's
`bound_multipliers`.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from labkit.inspector import words
from labkit.inspector.draw import joined
from labkit.inspector.page import Page
from labkit.inspector.tab import Tab
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47 import optimal, panda
from robo47.checks import Array
from robo47.jacobian import dls_step, pose_error

import day13_mujoco

LAB = lab_of(find_day(13))  # its circle, steps and limits
TIMES = np.arange(0.0, day13_mujoco.LAP, LAB.DT)
JOINTS = tuple(f"joint{i}" for i in range(1, 8))
COLOURS = {"clipped": "red", "yours": "blue", "the library's": "grey"}
DRAW, AGAIN = "draw", "from the start"
FARTHEST = 10.0  # rad: an arm that turned further is not drawn
SMALL = 0.01  # mm: what one calls the same on a screen


class Asked(NamedTuple):
    """What an arm's next step is asked with."""

    J: Array  # (6, 7)
    e: Array  # (6,)
    low: Array  # rad, (7,)
    high: Array


class Pen:
    """An arm that draws the circle, step by step."""

    def __init__(self, arm: Any, q: Array) -> None:
        """Stand at the circle's start."""
        self.arm = arm
        self.q = q
        self.now = arm.at(q)
        self.path = [self.now.T_world_ee[:3, 3]]
        self.off = [0.0]

    def go(self, dq: Array, T_now: Array) -> None:
        """Take a step, having been where T_now should be."""
        self.off.append(1000 * float(np.linalg.norm(T_now[:3, 3] - self.path[-1])))
        self.q = np.clip(self.q + dq, -FARTHEST, FARTHEST)
        self.now = self.arm.at(self.q)
        self.path.append(self.now.T_world_ee[:3, 3])


class Best(Tab):
    """A circle that leaves the reach, drawn within limits, three ways."""

    title = "Best"
    wide = True
    camera = ((2.1, -0.9, 0.75), (0.2, 0.35, 0.5))

    def __init__(self, page: Page) -> None:
        """Draw the circle and the arms at its start; nothing runs yet."""
        super().__init__(page)
        self.arm = panda.arm(page.model)
        self.own = page.own(
            optimal, units={"qp_ik": "rad", "bound_multipliers": "m2/rad"}
        )
        self.set: dict[str, float] = {
            "damping": LAB.DAMPING, "turn": 1.0, "share": 1.0, "radius": LAB.RADIUS,
        }  # fmt: skip
        self.slider("radius", 0.3, 0.4, "radius", 0.005, "m")
        self.slider("damping", 0.002, 0.05, "damping", 0.001)
        self.slider("a turn weighs", 0.01, 1.0, "turn", 0.01)
        self.slider("share of the speed", 0.3, 1.0, "share", 0.05)
        page.buttons([DRAW, AGAIN], self.press)
        self.numbers = page.html()
        title = "what your step asks, in parts of the speed limit"
        self.speeds = page.bars(JOINTS, 1.0, "", title, "up")
        title = (
            "your bound_multipliers, the most so far, the library's as marks, "
            "mm2 per mrad; below 0: an upper limit"
        )
        self.costs = page.bars(JOINTS, 0.2, "", title, "signed")
        self.loop = page.animate(self.step, 1 / LAB.DT, work=self.draw)
        page.hide_arm()
        named = {f"{name}, {'dls_step' if name == 'clipped' else 'qp_ik'}": colour
                 for name, colour in COLOURS.items()}  # fmt: skip
        page.legend(named)
        self.ghosts = [page.draw.ghost(colour) for colour in COLOURS.values()]
        start = np.zeros((2, 3))
        self.goal = page.draw.curve(start, "orange", 2.0)
        self.lines = [page.draw.curve(start, colour) for colour in COLOURS.values()]
        self.again()

    def begin(self) -> None:
        """Draw a lap from the start."""
        self.again()
        self.loop.start()

    def slider(
        self,
        text: str,
        low: float,
        high: float,
        name: str,
        step: float,
        unit: str = "",
    ) -> None:
        """Add a slider of one of the settings."""
        to = self.sets(name)
        self.page.slider(text, low, high, self.set[name], to, unit=unit, step=step)

    def sets(self, name: str) -> Callable[[float], None]:
        """Return what a slider does: all arms go back to the start."""

        def to(value: float) -> None:
            self.set[name] = value
            self.again()

        return to

    def again(self) -> None:
        """Put all arms at the circle's start."""
        self.loop.stop()
        self.steps = 0
        of = self.page.model, self.set["radius"], TIMES
        self.circle, q = day13_mujoco.circle(*of)
        self.pens = {name: Pen(self.arm, q) for name in COLOURS}
        self.speed, self.price, self.right = np.zeros((3, 7))
        self.last: tuple[Array, ...] = ()  # what bound_multipliers is asked next
        points = self.circle[:, :3, 3]
        self.goal.points = joined([*points, points[0]])
        self.show()

    def press(self, name: str) -> None:
        """Start or stop drawing, or go back to the start."""
        if name == AGAIN or self.steps >= len(TIMES) - 1:
            self.again()
        if name == DRAW:
            self.loop.toggle()

    def step(self, seconds: float) -> bool:
        """Show all arms; after a lap there is no more."""
        self.show()
        return self.steps < len(TIMES) - 1

    def asked(self, pen: Pen) -> Asked:
        """Return what a step of an arm is asked with, now."""
        T_now, T_next = self.circle[self.steps : self.steps + 2]
        back = pose_error(pen.now.T_world_ee, T_now)
        e = pose_error(T_now, T_next) + LAB.DT * LAB.GAIN * back
        most = self.set["share"] * LAB.SPEED * LAB.DT
        low, high = self.page.model.jnt_range[:7].T - pen.q
        # An arm that was led beyond its range may come back as fast as it can.
        low, high = np.clip(low, -most, most), np.clip(high, -most, most)
        return Asked(pen.now.J_site, e, low, high)

    def draw(self, seconds: float = 0.0) -> None:
        """Move all arms by a step; the middle one by the student's own functions."""
        weights = np.repeat([self.set["turn"], 1.0], 3)
        damping = self.set["damping"]
        clipped, own, best = (self.asked(pen) for pen in self.pens.values())
        asked = ("qp_ik", own.J, own.e, weights, damping, own.low, own.high)
        H = own.J.T @ (weights[:, None] * own.J) + damping**2 * np.eye(7)
        g = -own.J.T @ (weights * own.e)
        dq, prices = self.own.many(  # at once: one way there
            asked, ("bound_multipliers", *(self.last or pressed(H, g)))
        )
        if self.last:  # m^2 per rad are 1,000 mm^2 per mrad; box_qp has half a square
            self.price = larger(self.price, 2_000 * prices)
            right = optimal.bound_multipliers(*self.last)
            self.right = larger(self.right, 2_000 * right)
        self.last = (H, g, own.low, own.high, dq)
        step = optimal.qp_ik(best.J, best.e, weights, damping, best.low, best.high)
        plain = np.clip(dls_step(clipped.J, clipped.e, damping), *clipped[2:])
        T_now = self.circle[self.steps]
        for pen, one in zip(self.pens.values(), (plain, dq, step), strict=True):
            pen.go(one, T_now)
        self.speed = np.abs(dq) / (LAB.SPEED * LAB.DT * self.set["share"])
        self.steps += 1

    def show(self) -> None:
        """Draw the arms and their lines, and say how far off each has been."""
        rows = zip(self.pens.values(), self.ghosts, self.lines, strict=True)
        for pen, ghost, line in rows:
            ghost.pose(self.page.links(pen.q))
            line.points = joined([*pen.path[:1], *pen.path])
        self.speeds.show(self.speed)
        self.costs.show(self.price, self.right)
        apart = max(self.pens["yours"].off) - max(self.pens["the library's"].off)
        kind = "bad" if abs(apart) > SMALL else "good"
        kinds = {"yours": kind if self.steps > 1 else ""}  # off is seen a step later
        self.numbers.content = words.line(
            f"{self.steps * LAB.DT:.1f} s of {day13_mujoco.LAP:.0f}", "time"
        ) + "".join(
            words.line(
                f"{name}: {pen.off[-1]:.1f} mm off, at most {max(pen.off):.1f}",
                name.split()[-1],
                kinds.get(name, ""),
            )
            for name, pen in self.pens.items()
        )

    def lost(self) -> None:
        """Show no numbers where the student's functions gave none."""
        self.numbers.content = ""
        self.speeds.clear()
        self.costs.clear()


def pressed(H: Array, g: Array) -> tuple[Array, ...]:
    """Return what bound_multipliers gets first: limits at half the free step, (7,).

    On the way no limit may press for seconds, and all prices are 0 until then.
    """
    most = np.abs(np.linalg.solve(H, g)) / 2.0
    dq = optimal.box_qp(H, g, -most, most, np.zeros(len(g)))
    return H, g, -most, most, dq


def larger(one: Array, other: Array) -> Array:
    """Return of each pair the number that is farther from 0, (n,)."""
    return np.where(np.abs(other) > np.abs(one), other, one)


TABS = [Best]
