"""Day 5 in the inspector: the tab Control, a controller at work in real time.

The arm is simulated with motors; the ghost is the reference. The controllers are the
library's (`robo47.control`), at 500 Hz: the student's own run with `make run DAY=5`.
"""

from collections.abc import Callable

import mujoco
import numpy as np

from labkit.inspector.page import Page
from labkit.inspector.tab import Tab
from robo47 import control, kinematics, panda, references, scenes, simulate
from robo47.arm import Arm
from robo47.checks import Array
from robo47.panda import READY_Q

SWING, NUDGE, STOP = "swing", "0.1 rad off", "stop"
HZ, SHOWN = 25.0, 2  # frames a second; a point of the plot every so many frames
KP, KD = 100.0, 20.0  # of the plain springs, as in the lab
REACH = np.array([0.5, 0.4, 0.5, 0.4, 0.6, 0.5, 0.6])
E0 = 0.1 * np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0])
JOINTS = [f"joint{i}" for i in range(1, 8)]
Law = Callable[..., Array]


def springs(arm: Arm, q: Array, qd: Array, ref: tuple, omega: float) -> Array:
    """Give the torque of plain springs."""
    return control.pd_torque(ref[0] - q, ref[1] - qd, KP, KD)


def with_gravity(arm: Arm, q: Array, qd: Array, ref: tuple, omega: float) -> Array:
    """Give the torque of springs that do not sag."""
    g = arm.at(q).gravity_torque
    return control.gravity_pd(ref[0] - q, ref[1] - qd, KP, KD, g)


def computed(arm: Arm, q: Array, qd: Array, ref: tuple, omega: float) -> Array:
    """Give computed torque of a wanted omega, critically damped."""
    now, e, ed = arm.at(q), ref[0] - q, ref[1] - qd
    M, bias, gains = now.M, now.bias(qd), control.gains(omega, 1.0)
    return control.computed_torque(M, bias, arm.damping, qd, e, ed, ref[2], *gains)


def outside(arm: Arm, q: Array, qd: Array, ref: tuple, omega: float) -> Array:
    """Give the public page's torque, its gains outside M."""
    feedforward = computed(arm, q, qd, (q, qd, ref[2]), omega)
    kp, kd = control.gains(omega, 1.0)
    return feedforward + control.pd_torque(ref[0] - q, ref[1] - qd, kp, kd)


LAWS: dict[str, Law] = {
    "computed torque": computed,
    "gains outside M": outside,
    "springs and gravity": with_gravity,
    "springs": springs,
}


def reference(t: float, swing: bool) -> tuple[Array, Array, Array]:
    """Return position, velocity and acceleration of the ghost: ready, or the swing."""
    made = references.raised_cosine(READY_Q, REACH) if swing else None
    return (made or references.hold(READY_Q))(t)


class Control(Tab):
    """The reference as a ghost, the error as it comes, the torques against limits."""

    title = "Control"
    wide = True

    def __init__(self, page: Page) -> None:
        """Stand at ready, computed torque, omega 20."""
        super().__init__(page)
        self.models = [
            panda.load("panda_nohand", drive="torque", edit=edit)
            for edit in (None, scenes.hang_kilogram)
        ]
        self.arm = panda.arm(self.models[0])  # the model never knows of the load
        self.law, self.omega, self.heavy, self.swing = computed, 20.0, 0, False
        self.limits = simulate.limits(self.models[0])[1]
        self.stiffest = float(control.stiffest_omega(self.models[0].opt.timestep))
        self.ghost = page.draw.ghost("blue")
        page.choice("controller (the library's)", list(LAWS), self.choose)
        says = f"omega; a loop of 2 ms breaks at {self.stiffest:.0f}"
        page.slider(says, 2, 500, 20, self.tune, unit="rad/s", step=1)
        page.tick("hang 1 kg on it; the model is not told", self.hang)
        page.buttons([SWING, NUDGE, STOP], self.press)
        self.plot = page.plot(["measured", "predicted"], y="largest error (mrad)")
        self.bars = page.bars(JOINTS, self.limits, "Nm", "torque")
        self.loop = page.animate(self.step, HZ)
        self.restart(READY_Q)

    def choose(self, name: str) -> None:
        """Take another controller, from now on."""
        self.law = LAWS[name]

    def tune(self, omega: float) -> None:
        """Make the springs stiffer or softer, critically damped."""
        self.omega = omega
        broken = omega > self.stiffest
        self.page.say("over the limit: the error grows at each step" if broken else "",
                      "bad" if broken else "")  # fmt: skip

    def hang(self, heavy: bool) -> None:
        """Add 1 kg or take it off, and go on from where the arm is."""
        self.heavy = int(heavy)
        q, qd = self.data.qpos[:7], self.data.qvel[:7]
        self.data = simulate.start(self.models[self.heavy], q, qd)

    def press(self, name: str) -> None:
        """Start one of the two runs, or stop."""
        self.loop.stop()
        if name == STOP:
            return
        self.swing = name == SWING
        self.restart(READY_Q if self.swing else READY_Q - E0)
        self.loop.start()

    def restart(self, q: Array) -> None:
        """Put the arm at rest somewhere, time at 0, the plot empty."""
        self.data = simulate.start(self.models[self.heavy], q)
        self.since = self.frames = 0
        self.plot.clear()
        self.show(reference(0.0, self.swing)[0])

    def step(self, seconds: float) -> None:
        """Simulate one frame's time, one control period per time step."""
        model = self.models[self.heavy]
        for _ in range(round(1.0 / HZ / model.opt.timestep)):
            ref = reference(self.since * model.opt.timestep, self.swing)
            q, qd = self.data.qpos[:7].copy(), self.data.qvel[:7].copy()
            wanted = self.law(self.arm, q, qd, ref, self.omega)
            self.data.ctrl[:7] = control.saturate(wanted, self.limits)
            mujoco.mj_step(model, self.data)
            self.since += 1
        self.frames += 1
        t = self.since * model.opt.timestep
        ref = reference(t, self.swing)
        self.bars.show(wanted)
        if self.frames % SHOWN == 0:
            self.plot.add(t, self.errors(t, ref[0]))
        self.show(ref[0])

    def errors(self, t: float, wanted: Array) -> list[float]:
        """Return the largest error now and the predicted one, in mrad."""
        measured = 1e3 * float(np.abs(wanted - self.data.qpos[:7]).max())
        decay = control.error_response(t, self.omega, 1.0)
        return [measured, 0.0 if self.swing else 100.0 * float(decay)]

    def show(self, wanted: Array) -> None:
        """Move the arm to where the simulation is, the ghost to the reference."""
        q = self.page.q
        q[:7] = self.data.qpos[:7]
        self.page.move(q)
        q[:7] = wanted
        poses = kinematics.fk_all(self.page.model, q)
        bodies = [name for name in poses if name.startswith("body:")]
        self.ghost.pose({name.removeprefix("body:"): poses[name] for name in bodies})


TABS = [Control]
