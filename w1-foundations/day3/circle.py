"""The tab Circle of Day 3: two arms draw one circle, one of them without damping.

The slider changes the radius. With 0.36 m both arms draw the same circle; the top of a
circle of 0.38 m is out of reach, and there the plain pseudo-inverse exceeds the joints'
speed limits. Both use the student's own `pose_error` and `dls_step`.
"""

import numpy as np

from labkit.inspector import declared as ui
from labkit.inspector.draw import joined
from robo47 import jacobian, panda
from robo47.arm import Arm
from robo47.checks import Array

import day3_mujoco

SPEED = np.array([2.175] * 4 + [2.61] * 3)  # rad/s, of the seven joints
DT, GAIN = 0.02, 10.0  # seconds, 1/s: as in the lab
TIMES = np.arange(0.0, day3_mujoco.LAP, DT)
DAMPING, RADIUS = 0.05, 0.38
START = np.zeros((2, 3))
NAMES = ("damped", "plain")


class Pen:
    """An arm that draws the circle, step by step."""

    def __init__(self, arm: Arm, q: Array, damping: float) -> None:
        """Stand at the circle's start; a damping of 0 is the plain pseudo-inverse."""
        self.arm, self.q, self.damping = arm, q, damping
        self.now = arm.at(q)
        self.path = [self.now.T_world_ee[:3, 3]]
        self.off, self.rate = [0.0], [0.0]  # mm; of the speed limits

    def go(self, q_dot: Array, T_goal: Array) -> None:
        """Go on by DT, having been where T_goal should be, (4, 4)."""
        p = self.now.T_world_ee[:3, 3]
        self.off.append(1000 * float(np.linalg.norm(T_goal[:3, 3] - p)))
        self.rate.append(float((np.abs(q_dot) / SPEED).max()))
        self.q = self.q + DT * q_dot
        self.now = self.arm.at(self.q)
        self.path.append(self.now.T_world_ee[:3, 3])


class Circle(ui.Declared):
    """A circle that leaves the workspace, with damping and without."""

    title = "Circle"
    camera = ((2.1, -0.9, 0.75), (0.2, 0.35, 0.5))
    library = jacobian
    functions = {"pose_error": "(rad or m)", "dls_step": "rad/s"}
    arm_hidden = True
    hz = 1 / DT

    radius = ui.slider("radius", 0.3, 0.4, RADIUS, "m", 0.005, then="restart")
    does = ui.buttons("draw", "from the start", then="press")
    bars = ui.panel.bars(
        NAMES, 1.0, "", "fastest joint so far, as a fraction of its limit", "up"
    )
    damped = ui.scene.ghost("blue", 0.9, legend="your dls_step, damped")
    plain = ui.scene.ghost("red", legend="without damping")
    goal = ui.scene.curve(START, "grey", 2.0, legend="the circle")
    line_damped = ui.scene.curve(START, "blue")
    line_plain = ui.scene.curve(START, "red")

    def prepare(self) -> None:
        self.arm = panda.arm(self.page.model)
        self.restart()

    def restart(self) -> None:
        self.loop.stop()
        self.steps = 0
        limits = self.page.model.jnt_range[:7]
        arm = (self.arm.screws, self.arm.M_home)
        # the start is the library's
        self.circle, q = day3_mujoco.circle(arm, limits, self.radius, TIMES)
        self.pens = [Pen(self.arm, q, damping) for damping in (DAMPING, 0.0)]
        points = self.circle[:, :3, 3]
        self.goal.points = joined([*points, points[0]])
        self.frame()

    def press(self) -> None:
        """Start or stop drawing, or go back to the start."""
        if self.does != "draw" or self.steps >= len(TIMES) - 1:
            self.restart()
        if self.does == "draw":
            self.loop.toggle()

    def advance(self, seconds: float = 0.0) -> None:
        T_now, T_next = self.circle[self.steps : self.steps + 2]
        along, *back = self.own.many(
            ("pose_error", T_now, T_next),
            *(("pose_error", pen.now.T_world_ee, T_now) for pen in self.pens),
        )
        steps = self.own.many(*(
            ("dls_step", pen.now.J_site, along / DT + GAIN * e, pen.damping)
            for pen, e in zip(self.pens, back, strict=True)
        ))  # fmt: skip
        for pen, q_dot in zip(self.pens, steps, strict=True):
            pen.go(q_dot, T_now)
        self.steps += 1

    def frame(self, seconds: float = 0.0) -> bool:
        ghosts, lines = (self.damped, self.plain), (self.line_damped, self.line_plain)
        for pen, ghost, line in zip(self.pens, ghosts, lines, strict=True):
            ghost.pose(self.page.links(pen.q))
            line.points = joined([*pen.path[:1], *pen.path])
        self.bars.show([max(pen.rate) for pen in self.pens])
        return self.steps < len(TIMES) - 1

    def says(self, *_):
        yield f"radius {self.radius:g} m, {self.steps * DT:.1f} s", None
        of = "pose_error dls_step" if self.steps else None
        for name, pen in zip(NAMES, self.pens, strict=True):
            off = f"error {pen.off[-1]:.1f} mm, at most {max(pen.off):.1f} mm"
            yield f"{name}: {off}", of
