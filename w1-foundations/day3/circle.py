"""The tab Circle of Day 3: two arms draw one circle, one of them without damping.

The slider turns the radius. With 0.36 m both arms draw the same circle; the top of one
of 0.38 m is out of reach, and there the plain pseudo-inverse asks for more speed than
there is.
Both go by the student's own `pose_error` and `dls_step`.
"""

import numpy as np

from labkit.inspector import words
from labkit.inspector.page import Page
from labkit.inspector.tab import Tab
from robo47 import jacobian, panda
from robo47.arm import Arm
from robo47.checks import Array

CENTRE = np.array([0.28, -0.06, 0.55])
START_Q = np.array([0.5, -1.3, 0.0, -2.4, -0.5, 1.7, 1.2])
SPEED = np.array([2.175] * 4 + [2.61] * 3)  # rad/s, of the seven joints
LAP, DT, GAIN = 6.0, 0.02, 10.0  # seconds, seconds, 1/s: as in the lab
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


def on_the_circle(radius: float, time: float) -> Array:
    """Return where the hand should be, (4, 4): upright circle, the tool down."""
    phi, T = 2 * np.pi * time / LAP, np.diag([-1.0, 1.0, -1.0, 1.0])
    T[:3, 3] = CENTRE + radius * np.array([0.0, np.cos(phi), np.sin(phi)])
    return T


class Circle(Tab):
    """A circle that leaves the reach, with damping and without."""

    title = "Circle"
    wide = True
    camera = ((2.1, -0.9, 0.75), (0.2, 0.35, 0.5))

    def __init__(self, page: Page) -> None:
        """Draw the circle and both arms at its start; nothing runs yet."""
        super().__init__(page)
        self.arm = panda.arm(page.model)
        self.limits = page.model.jnt_range[:7]
        self.own = page.own(jacobian)
        page.slider("radius", 0.3, 0.4, RADIUS, self.turn, unit="m", step=0.005)
        page.buttons([DRAW, AGAIN], self.press)
        self.numbers = page.html()
        title = "fastest joint so far, in parts of its limit"
        self.bars = page.bars(NAMES, 1.0, "", title, "up")
        self.loop = page.animate(self.step, 1 / DT, work=self.draw)
        page.hide_arm()
        page.legend({"damped": "blue", "without damping": "red", "the circle": "grey"})
        self.ghosts = [page.draw.ghost(colour) for colour in ("blue", "red")]
        start = np.zeros((2, 3))
        self.goal = page.draw.curve(start, "grey", 2.0)
        self.lines = [page.draw.curve(start, colour) for colour in ("blue", "red")]
        self.turn(RADIUS)

    def turn(self, radius: float) -> None:
        """Choose the radius, in metres; both arms go to the circle's start."""
        self.loop.stop()
        self.radius, self.steps = radius, 0
        T = on_the_circle(radius, 0.0)
        S, M = self.arm.screws, self.arm.M_home  # the start is the library's
        q = jacobian.solve_ik(S, M, T, START_Q, self.limits)
        self.pens = [Pen(self.arm, q, damping) for damping in (DAMPING, 0.0)]
        times = np.linspace(0.0, LAP, 121)
        self.goal.points = _segments([on_the_circle(radius, t)[:3, 3] for t in times])
        self.show()

    def press(self, name: str) -> None:
        """Start or stop drawing, or go back to the start."""
        if name == AGAIN or self.steps >= round(LAP / DT) - 1:
            self.turn(self.radius)
        if name == DRAW:
            (self.loop.stop if self.loop.running else self.loop.start)()

    def step(self, seconds: float) -> bool:
        """Show both arms; after a lap there is no more."""
        self.show()
        return self.steps < round(LAP / DT) - 1

    def draw(self, seconds: float = 0.0) -> None:
        """Move both arms by DT, by the student's own functions."""
        now, pens = self.steps * DT, self.pens
        T_now = on_the_circle(self.radius, now)
        T_next = on_the_circle(self.radius, now + DT)
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
            line.points = _segments([*pen.path[:1], *pen.path])
        self.bars.show([max(pen.rate) for pen in self.pens])
        told = "; ".join(
            f"{name} {pen.off[-1]:.1f} mm off, at most {max(pen.off):.1f}"
            for name, pen in zip(NAMES, self.pens, strict=True)
        )
        says = f"radius {self.radius:g} m, {self.steps * DT:.1f} s: {told}"
        self.numbers.content = words.line(says, "circle")


def _segments(points: list[Array]) -> Array:
    p = np.array(points, dtype=np.float32)
    return np.stack([p[:-1], p[1:]], axis=1)
