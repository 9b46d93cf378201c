"""Day 9 in the inspector: the tab Feel.

Drag the handle to pull at a link of an arm that holds still. The student's own momentum
observer estimates the external torque: seven bars next to J^T F, and a sphere marks the
contact link that it names. The arm is simulated; the observer runs at 100 Hz.
"""

from functools import partial

import mujoco
import numpy as np

from labkit.inspector import words
from labkit.inspector.draw import joined
from labkit.inspector.page import Page
from labkit.inspector.robot import Robot
from labkit.inspector.tab import PLAYS, Tab
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47 import estimation, panda, simulate
from robo47.checks import Array

import day9_mujoco

LAB = lab_of(find_day(9))  # its gain and threshold
RATE, HZ = 100.0, 25.0  # of the observer, and of the page
PULL = 100.0  # N per metre of distance to the handle
FULL, MOST = 12.0, 999.0  # N m, the end of a bar, and the largest number shown
UNITS = {"kinetic_energy_gradient": "N m", "momentum_observer_step": "(N m or N m s)"}
AGAIN, LET_GO, DOWN = "start / stop", "let go", "10 N down"
PLACES = [day9_mujoco.FLANGE, *[f"link{i}" for i in range(7, 0, -1)]]
ARM_JOINTS = [f"joint{i}" for i in range(1, 8)]

dressed = partial(panda.load, "panda_nohand", meshes=True, drive="torque")


class Feel(Tab):
    """Push any link; the arm names the contact link."""

    title = "Feel"
    wide = True

    def __init__(self, page: Page) -> None:
        """Hold the arm at its configuration, without a force."""
        super().__init__(page)
        self.model = panda.load("panda_nohand", drive="torque")
        self.arm = panda.arm(self.model)
        self.place = PLACES[0]
        self.force = np.zeros(3)
        self.gain, self.threshold = LAB.GAIN, LAB.THRESHOLD
        self.goal_q = page.q[:7].copy()
        self.own = page.own(estimation, units=UNITS)
        self.again()
        page.choice("pull at", PLACES, self.pull_at)
        page.buttons([AGAIN, DOWN, LET_GO], self.press)
        gain = partial(setattr, self, "gain")
        page.slider("gain", 5, 100, self.gain, gain, unit="1/s", step=5)
        least = partial(setattr, self, "threshold")
        page.slider("threshold", 0.1, 5, self.threshold, least, unit="N m", step=0.1)
        self.numbers = page.html()
        title = "residual; marks: J^T F of your pull"
        self.bars = page.bars(ARM_JOINTS, FULL, "N m", title, "both")
        self.loop = page.animate(lambda seconds: self.show(), HZ, work=self.step)
        self.drawn = Robot(page, self.model, dressed)
        self.arrow = page.draw.arrows(np.zeros((1, 2, 3)), "red", 0.008)
        self.named = page.draw.sphere(np.zeros(3), 0.09, "orange", 0.5)
        self.target = page.draw.target(page.pose("ee"), self.drag)
        page.legend({"your pull": "red", "the contact link": "orange"})
        self.show()

    def again(self) -> None:
        """Put the arm at its goal, with a residual of zero."""
        self.data = simulate.start(self.model, self.goal_q)
        self.residual = np.zeros(7)
        self.integral = np.zeros(7)  # p of an arm at rest
        self.link = 0
        self.before: tuple[Array, ...] | None = None

    def begin(self) -> None:
        """Pull downwards with 10 N at an arm whose residual is zero."""
        self.loop.stop()
        self.again()
        self.press(DOWN)
        self.loop.lasts = PLAYS

    def lost(self) -> None:
        """Clear the residual, and name no link."""
        self.bars.clear()
        self.named.visible = False
        self.numbers.content = ""

    def pull_at(self, place: str) -> None:
        """Choose the point that the handle pulls at."""
        self.place = place
        self.press(LET_GO)

    def drag(self, T: Array) -> None:
        """Pull towards the handle."""
        self.force = PULL * (T[:3, 3] - self.point())
        self.loop.start()
        self.show()

    def press(self, name: str) -> None:
        """Start, stop, pull downwards, or let go."""
        if name == AGAIN:
            self.loop.toggle()
            return
        self.force = np.zeros(3)
        if name == DOWN:
            self.force[2] = -10.0
            self.loop.start()
        T = np.eye(4)
        T[:3, 3] = self.point() + self.force / PULL
        self.target.place(T)
        self.show()

    def on_move(self, q: Array) -> None:
        """Take the page's configuration as the goal."""
        self.goal_q = q[:7].copy()
        if not self.loop.running:
            self.again()
        self.show()

    def point(self) -> Array:
        """Return the point at which the handle pulls, m, (3,)."""
        data = mujoco.MjData(self.model)
        data.qpos[:] = self.data.qpos
        mujoco.mj_kinematics(self.model, data)
        if self.place == day9_mujoco.FLANGE:
            return data.site(self.place).xpos.copy()
        return data.body(self.place).xipos.copy()

    def step(self, seconds: float) -> None:
        """Simulate the time of one picture; it waits for the student's observer."""
        push = day9_mujoco.push(self.place, self.force, 0.0)
        simulate.run(self.model, self.data, self.law, 1.0 / HZ, rate=RATE, push=push)

    def law(self, t: float, q: Array, qd: Array) -> Array:
        """Hold the arm, and run the observer."""
        now = self.arm.at(q)
        if self.before is not None:
            known = (*self.before, self.gain, 1.0 / RATE)
            given = self.residual, self.integral, now.M @ qd
            self.residual, self.integral = self.own.momentum_observer_step(
                *given, *known
            )
        limit = np.full(7, self.threshold)
        slope, self.link = self.own.many(
            ("kinetic_energy_gradient", now.J_space, now.G, qd),
            ("contact_link", self.residual, limit),
        )
        hold = day9_mujoco.tracking(self.arm, day9_mujoco.hold(self.goal_q))
        tau = hold(t, q, qd)
        self.before = tau, slope, now.gravity_torque, self.arm.damping, qd
        return tau

    def show(self) -> None:
        """Draw the arm, the pull and the contact link, and show the residual."""
        q = self.data.qpos[:7].copy()
        self.drawn.show(self.data.qpos)
        at = self.point()
        self.arrow.visible = bool(self.force.any())
        if self.force.any():
            self.arrow.points = joined([at, at + self.force / PULL])
        truth = LAB.mujoco_external_torque(self.model, q, self.place, self.force)
        self.bars.show(np.clip(self.residual, -MOST, MOST), truth)
        link = int(self.link)
        self.named.visible = 1 <= link <= 7
        if self.named.visible:
            self.named.position = self.arm.at(q).coms_world[link - 1]
        newton = ", ".join(f"{x:z.1f}" for x in self.force)
        says = f"contact on link {link}" if link else "no contact"
        self.numbers.content = words.line(
            f"You pull at {self.place} with ({newton}) N: {says}.", "feel"
        )


TABS = [Feel]
