"""The tab Circle of Day 3: two arms draw one circle, one of them without damping.

The slider changes the radius. With 0.36 m both arms draw the same circle; the top of a
circle of 0.38 m is out of reach, and there the plain pseudo-inverse exceeds the joints'
speed limits. Both use the student's own `pose_error` and `dls_step`.
"""

import numpy as np

from labkit.inspector import words
from labkit.inspector.draw import joined
from labkit.inspector.page import Page
from labkit.inspector.tab import Tab
from robo47 import jacobian, panda
from robo47.arm import Arm
from robo47.checks import Array

import day3_mujoco

SPEED = np.array([2.175] * 4 + [2.61] * 3)  # rad/s, of the seven joints
DT, GAIN = 0.02, 10.0  # seconds, 1/s: as in the lab
TIMES = np.arange(0.0, day3_mujoco.LAP, DT)
DAMPING, RADIUS = 0.05, 0.38
DRAW, AGAIN = "draw", "from the start"
NAMES = ("damped", "plain")


class Pen:
    """An arm that draws the circle, step by step."""

    def __init__(self, arm: Arm, q: Array, damping: float) -> None:
        """Stand at the circle's start.

        Args:
            arm: whose hand draws.
            q: where it starts, radians, (7,).
            damping: of every step; 0 is the plain pseudo-inverse.
        """
        self.arm, self.q, self.damping = arm, q, damping
        self.now = arm.at(q)
        self.path = [self.now.T_world_ee[:3, 3]]
        self.off, self.rate = [0.0], [0.0]

    def go(self, q_dot: Array, T_goal: Array) -> None:
        """Go on by DT, having been where T_goal should be, (4, 4)."""
        p = self.now.T_world_ee[:3, 3]
        self.off.append(1000 * float(np.linalg.norm(T_goal[:3, 3] - p)))
        self.rate.append(float((np.abs(q_dot) / SPEED).max()))
        self.q = self.q + DT * q_dot
        self.now = self.arm.at(self.q)
        self.path.append(self.now.T_world_ee[:3, 3])


class Circle(Tab):
    """A circle that leaves the workspace, with damping and without."""

    title = "Circle"
    wide = True
    camera = ((2.1, -0.9, 0.75), (0.2, 0.35, 0.5))

    def __init__(self, page: Page) -> None:
        """Draw the circle and both arms at its start; nothing runs yet."""
        super().__init__(page)
        self.arm = panda.arm(page.model)
        self.limits = page.model.jnt_range[:7]
        units = {"pose_error": "(rad or m)", "dls_step": "rad/s"}
        self.own = page.own(jacobian, units=units)
        page.slider("radius", 0.3, 0.4, RADIUS, self.turn, unit="m", step=0.005)
        page.buttons([DRAW, AGAIN], self.press)
        self.numbers = page.html()
        title = "fastest joint so far, as a fraction of its limit"
        self.bars = page.bars(NAMES, 1.0, "", title, "up")
        self.loop = page.animate(self.step, 1 / DT, work=self.draw)
        page.hide_arm()
        page.legend({"damped": "blue", "without damping": "red", "the circle": "grey"})
        self.ghosts = [page.draw.ghost(colour) for colour in ("blue", "red")]
        start = np.zeros((2, 3))
        self.goal = page.draw.curve(start, "grey", 2.0)
        self.lines = [page.draw.curve(start, colour) for colour in ("blue", "red")]
        self.turn(RADIUS)

    def begin(self) -> None:
        """Draw a lap from the start."""
        self.press(AGAIN)
        self.loop.start()

    def lost(self) -> None:
        """Show no numbers: the arms stand where they were."""
        self.numbers.content = ""
        self.bars.clear()

    def turn(self, radius: float) -> None:
        """Choose the radius, in metres; both arms go to the circle's start."""
        self.loop.stop()
        self.radius = radius
        self.steps = 0
        arm = (self.arm.screws, self.arm.M_home)
        # the start is the library's
        self.circle, q = day3_mujoco.circle(arm, self.limits, radius, TIMES)
        self.pens = [Pen(self.arm, q, damping) for damping in (DAMPING, 0.0)]
        points = self.circle[:, :3, 3]
        self.goal.points = joined([*points, points[0]])
        self.show()

    def press(self, name: str) -> None:
        """Start or stop drawing, or go back to the start."""
        if name == AGAIN or self.steps >= len(TIMES) - 1:
            self.turn(self.radius)
        if name == DRAW:
            self.loop.toggle()

    def step(self, seconds: float) -> bool:
        """Show both arms; after a lap there is no more."""
        self.show()
        return self.steps < len(TIMES) - 1

    def draw(self, seconds: float = 0.0) -> None:
        """Move both arms by DT, by the student's own functions."""
        pens = self.pens
        T_now, T_next = self.circle[self.steps : self.steps + 2]
        along, *back = self.own.many(
            ("pose_error", T_now, T_next),
            *(("pose_error", pen.now.T_world_ee, T_now) for pen in pens),
        )
        wanted = [along / DT + GAIN * e for e in back]
        steps = self.own.many(*(
            ("dls_step", pen.now.J_site, e, pen.damping)
            for pen, e in zip(pens, wanted, strict=True)
        ))  # fmt: skip
        for pen, q_dot in zip(pens, steps, strict=True):
            pen.go(q_dot, T_now)
        self.steps += 1

    def show(self) -> None:
        """Draw both arms and their lines, and say how far off each has been."""
        for pen, ghost, line in zip(self.pens, self.ghosts, self.lines, strict=True):
            ghost.pose(self.page.links(pen.q))
            line.points = joined([*pen.path[:1], *pen.path])
        self.bars.show([max(pen.rate) for pen in self.pens])
        told = "; ".join(
            f"{name} {pen.off[-1]:.1f} mm off, largest {max(pen.off):.1f}"
            for name, pen in zip(NAMES, self.pens, strict=True)
        )
        says = f"radius {self.radius:g} m, {self.steps * DT:.1f} s: {told}"
        self.numbers.content = words.line(says, "circle")
