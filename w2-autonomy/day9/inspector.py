"""Day 9 in the inspector: the tab Feel.

Drag the handle to pull at a link of an arm that holds still. The student's own momentum
observer estimates the external torque: seven bars next to J^T F, and a sphere marks the
contact link that it names. The arm is simulated; the observer runs at 100 Hz.
"""

from functools import cache, partial

import mujoco
import numpy as np

from labkit.inspector import declared as ui
from labkit.inspector.draw import joined
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47 import estimation, panda, simulate
from robo47.checks import Array

import day9_mujoco

LAB = lab_of(find_day(9))  # its gain and threshold
RATE = 100.0  # of the observer
PULL = 100.0  # N per metre of distance to the handle
FULL, MOST = 12.0, 999.0  # N m, the end of a bar, and the largest number shown
PLACES = [day9_mujoco.FLANGE, *[f"link{i}" for i in range(7, 0, -1)]]

bare = cache(partial(panda.load, "panda_nohand", drive="torque"))
dressed = partial(panda.load, "panda_nohand", meshes=True, drive="torque")


class Feel(ui.Declared):
    """Push any link; the arm names the contact link."""

    title = "Feel"
    library = estimation
    functions = {
        "kinetic_energy_gradient": "N m", "momentum_observer_step": "(N m or N m s)",
        "contact_link": "",
    }  # fmt: skip
    hz = 25.0

    place = ui.choice("pull at", PLACES, then="let_go")
    does = ui.buttons("start / stop", "let go", "10 N down", then="press")
    gain = ui.slider("gain", 5, 100, LAB.GAIN, "1/s", 5, then="frame")
    threshold = ui.slider("threshold", 0.1, 5, LAB.THRESHOLD, "N m", 0.1, then="frame")
    bars = ui.panel.bars(
        panda.ARM_JOINTS, FULL, "N m", "residual; marks: J^T F of your pull"
    )
    drawn = ui.panel.robot(bare, dressed)
    arrow = ui.scene.arrows(ui.NOWHERE, "red", 0.008, legend="your pull")
    named = ui.yours.sphere(np.zeros(3), 0.09, "orange", 0.5, legend="the contact link")
    target = ui.handle("drag")

    def prepare(self) -> None:
        self.model, self.arm = bare(), panda.arm(bare())
        self.goal_q = self.page.q[:7].copy()
        self.rest()

    def rest(self) -> None:
        """Put the arm at its goal, with a residual of zero and no pull."""
        self.data = simulate.start(self.model, self.goal_q)
        self.force, self.residual = np.zeros(3), np.zeros(7)
        self.integral, self.link = np.zeros(7), 0  # p of an arm at rest
        self.before: tuple[Array, ...] | None = None

    def restart(self) -> None:
        self.rest()
        self.pull(np.array([0.0, 0.0, -10.0]))

    def pull(self, force: Array) -> None:
        """Pull with a force, N, (3,)."""
        self.force = force
        T = np.eye(4)
        T[:3, 3] = self.point() + force / PULL
        self.target.place(T)
        self.frame()

    def drag(self, T: Array) -> None:
        """Pull towards the handle."""
        self.force = PULL * (T[:3, 3] - self.point())
        self.loop.start()

    def let_go(self) -> None:
        """Pull no more."""
        self.pull(np.zeros(3))

    def press(self) -> None:
        """Do what the buttons say."""
        if self.does == "start / stop":
            self.loop.toggle()
        elif self.does == "let go":
            self.let_go()
        else:
            self.pull(np.array([0.0, 0.0, -10.0]))
            self.loop.start()

    def on_move(self, q: Array) -> None:
        self.goal_q = q[:7].copy()
        if not self.loop.running:
            self.rest()
            self.frame()

    def point(self) -> Array:
        """Return the point at which the handle pulls, m, (3,)."""
        data = mujoco.MjData(self.model)
        data.qpos[:] = self.data.qpos
        mujoco.mj_kinematics(self.model, data)
        if self.place == day9_mujoco.FLANGE:
            return data.site(self.place).xpos.copy()
        return data.body(self.place).xipos.copy()

    def advance(self, seconds: float) -> None:
        push = day9_mujoco.push(self.place, self.force, 0.0)
        given = (self.model, self.data, self.law, 1.0 / self.hz)
        simulate.run(*given, rate=RATE, push=push)

    def law(self, t: float, q: Array, qd: Array) -> Array:
        """Hold the arm, and run the observer."""
        now = self.arm.at(q)
        if self.before is not None:
            known = (*self.before, self.gain, 1.0 / RATE)
            given = self.residual, self.integral, now.M @ qd
            self.residual, self.integral = self.own.momentum_observer_step(
                *given, *known
            )
        slope, self.link = self.own.many(
            ("kinetic_energy_gradient", now.J_space, now.G, qd),
            ("contact_link", self.residual, np.full(7, self.threshold)),
        )
        hold = day9_mujoco.tracking(self.arm, day9_mujoco.hold(self.goal_q))
        tau = hold(t, q, qd)
        self.before = tau, slope, now.gravity_torque, self.arm.damping, qd
        return tau

    def frame(self, seconds: float = 0.0) -> None:
        q, at = self.data.qpos[:7].copy(), self.point()
        self.drawn.show(self.data.qpos)
        self.arrow.visible = bool(self.force.any())
        self.arrow.points = joined([at, at + self.force / PULL])
        truth = LAB.mujoco_external_torque(self.model, q, self.place, self.force)
        self.bars.show(np.clip(self.residual, -MOST, MOST), truth)
        self.named.visible = 1 <= self.link <= 7
        if self.named.visible:
            self.named.position = self.arm.at(q).coms_world[int(self.link) - 1]

    def says(self, *_):
        newton = ", ".join(f"{x:z.1f}" for x in self.force)
        names = f"contact on link {int(self.link)}" if self.link else "no contact"
        says = f"You pull at {self.place} with ({newton}) N. Your functions: {names}."
        yield says, " ".join(self.functions) if self.before else None


TABS = [Feel]
