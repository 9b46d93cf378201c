"""Day 13 in the inspector: the tab Best.

Three arms draw Day 3's circle within the joints' limits: one by Day 3's step, clamped;
one by the student's `qp_ik`; one by the library's. Bars show the velocities that the
student's step requests, and the multiplier of each limit, by the student's
`bound_multipliers`.
"""

from typing import Any, NamedTuple

import numpy as np

from labkit.inspector import declared as ui
from labkit.inspector.draw import joined
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47 import optimal, panda
from robo47.checks import Array
from robo47.jacobian import dls_step, pose_error

import day13_mujoco

LAB = lab_of(find_day(13))  # its circle, steps and limits
TIMES = np.arange(0.0, day13_mujoco.LAP, LAB.DT)
START = np.zeros((2, 3))
FARTHEST = 10.0  # rad: an arm that turned further is not drawn
NAMES = {"clamped": "Day 3's step, clamped", "yours": "yours", "right": "the library's"}


class Asked(NamedTuple):
    """The arguments of an arm's next step."""

    J: Array  # (6, 7)
    e: Array  # (6,)
    low: Array  # rad, (7,)
    high: Array


class Pen:
    """An arm that draws the circle, step by step."""

    def __init__(self, arm: Any, q: Array) -> None:
        """Stand at the circle's start."""
        self.arm, self.q, self.now = arm, q, arm.at(q)
        self.path = [self.now.T_world_ee[:3, 3]]
        self.off = [0.0]  # mm

    def go(self, dq: Array, T_now: Array) -> None:
        """Take a step from a position that should be T_now's."""
        self.off.append(1000 * float(np.linalg.norm(T_now[:3, 3] - self.path[-1])))
        self.q = np.clip(self.q + dq, -FARTHEST, FARTHEST)
        self.now = self.arm.at(self.q)
        self.path.append(self.now.T_world_ee[:3, 3])


class Best(ui.Declared):
    """A circle that leaves the workspace, drawn within limits by three methods."""

    title = "Best"
    library = optimal
    functions = {"qp_ik": "rad", "bound_multipliers": "m2/rad"}
    camera = ((2.1, -0.9, 0.75), (0.2, 0.35, 0.5))
    arm_hidden = True
    hz = 1 / LAB.DT

    radius = ui.slider("radius", 0.3, 0.4, LAB.RADIUS, "m", 0.005, then="restart")
    damping = ui.slider("damping", 0.002, 0.05, LAB.DAMPING, "", 0.001, then="restart")
    turn = ui.slider("weight of the rotation", 0.01, 1.0, 1.0, "", then="restart")
    share = ui.slider(
        "fraction of the velocity limit", 0.3, 1.0, 1.0, "", 0.05, then="restart"
    )
    does = ui.buttons("draw", "from the start", then="press")
    speeds = ui.panel.bars(
        panda.ARM_JOINTS, 1.0, "",
        "velocity that your step requests, as a fraction of the limit", "up",
    )  # fmt: skip
    costs = ui.panel.bars(
        panda.ARM_JOINTS, 0.2, "", "your bound_multipliers, the largest so far, mm2 "
        "per mrad (marks: the library's); below 0: an upper limit", "signed",
    )  # fmt: skip
    clamped = ui.scene.ghost("red", 0.5, legend="Day 3's dls_step, clamped")
    yours = ui.scene.ghost("blue", 0.9, legend="your qp_ik")
    best = ui.scene.ghost("grey", 0.35, legend="the library's qp_ik")
    goal = ui.scene.curve(START, "orange", 2.0, legend="the circle")
    line_clamped = ui.scene.curve(START, "red")
    line_yours = ui.scene.curve(START, "blue")
    line_best = ui.scene.curve(START, "grey")

    def prepare(self) -> None:
        self.arm = panda.arm(self.page.model)
        self.restart()

    def restart(self) -> None:
        self.loop.stop()
        self.steps = 0
        self.circle, q = day13_mujoco.circle(self.page.model, self.radius, TIMES)
        self.pens = {name: Pen(self.arm, q) for name in NAMES}
        self.speed, self.price, self.reached = np.zeros((3, 7))
        self.last: tuple[Array, ...] = ()  # the next arguments of bound_multipliers
        points = self.circle[:, :3, 3]
        self.goal.points = joined([*points, points[0]])
        self.frame()

    def press(self) -> None:
        """Start or stop drawing, or go back to the start."""
        if self.does != "draw" or self.steps >= len(TIMES) - 1:
            self.restart()
        if self.does == "draw":
            self.loop.toggle()

    def asked(self, pen: Pen) -> Asked:
        """Return the arguments of an arm's step, now."""
        T_now, T_next = self.circle[self.steps : self.steps + 2]
        back = pose_error(pen.now.T_world_ee, T_now)
        e = pose_error(T_now, T_next) + LAB.DT * LAB.GAIN * back
        most = self.share * LAB.SPEED * LAB.DT
        low, high = self.page.model.jnt_range[:7].T - pen.q
        # An arm that was led beyond its range may come back as fast as it can.
        low, high = np.clip(low, -most, most), np.clip(high, -most, most)
        return Asked(pen.now.J_site, e, low, high)

    def advance(self, seconds: float = 0.0) -> None:
        weights = np.repeat([self.turn, 1.0], 3)
        clamped, own, best = (self.asked(pen) for pen in self.pens.values())
        asked = ("qp_ik", own.J, own.e, weights, self.damping, own.low, own.high)
        H = own.J.T @ (weights[:, None] * own.J) + self.damping**2 * np.eye(7)
        g = -own.J.T @ (weights * own.e)
        dq, prices = self.own.many(
            asked, ("bound_multipliers", *(self.last or pressed(H, g)))
        )
        if self.last:  # m^2 per rad are 1,000 mm^2 per mrad; box_qp has half a square
            self.price = larger(self.price, 2_000 * prices)
            right = optimal.bound_multipliers(*self.last)
            self.reached = larger(self.reached, 2_000 * right)
        self.last = (H, g, own.low, own.high, dq)
        step = optimal.qp_ik(best.J, best.e, weights, self.damping, *best[2:])
        plain = np.clip(dls_step(clamped.J, clamped.e, self.damping), *clamped[2:])
        T_now = self.circle[self.steps]
        for pen, one in zip(self.pens.values(), (plain, dq, step), strict=True):
            pen.go(one, T_now)
        self.speed = np.abs(dq) / (LAB.SPEED * LAB.DT * self.share)
        self.steps += 1

    def frame(self, seconds: float = 0.0) -> bool:
        ghosts = self.clamped, self.yours, self.best
        lines = self.line_clamped, self.line_yours, self.line_best
        for pen, ghost, line in zip(self.pens.values(), ghosts, lines, strict=True):
            ghost.pose(self.page.links(pen.q))
            line.points = joined([*pen.path[:1], *pen.path])
        self.speeds.show(self.speed)
        self.costs.show(self.price, self.reached)
        return self.steps < len(TIMES) - 1

    def says(self, *_):
        yield f"{self.steps * LAB.DT:.1f} s of {day13_mujoco.LAP:.0f} s", None
        for name, pen in self.pens.items():
            says = f"{NAMES[name]}: error {pen.off[-1]:.1f} mm, at most "
            of = "qp_ik" if name == "yours" and self.steps > 1 else None
            yield f"{says}{max(pen.off):.1f} mm", of


def pressed(H: Array, g: Array) -> tuple[Array, ...]:
    """Return the first arguments of bound_multipliers: limits at half the free step.

    On the path no limit may be active for seconds; all multipliers are 0 until then.
    """
    most = np.abs(np.linalg.solve(H, g)) / 2.0
    dq = optimal.box_qp(H, g, -most, most, np.zeros(len(g)))
    return H, g, -most, most, dq


def larger(one: Array, other: Array) -> Array:
    """Return of each pair the number that is farther from 0, (n,)."""
    return np.where(np.abs(other) > np.abs(one), other, one)


TABS = [Best]
