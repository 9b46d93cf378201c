"""Day 5 in the inspector: the tab Control, the student's controllers in real time.

The arm is simulated with motors; the blue arm is the reference. The torques come from
the student's own functions at 250 Hz, as in the lab.
"""

from collections.abc import Callable

import numpy as np

from labkit.inspector import declared as ui
from labkit.inspector import words
from labkit.inspector.own import Own
from robo47 import control, panda, references, scenes, simulate
from robo47.arm import Arm
from robo47.checks import Array
from robo47.panda import ARM_JOINTS, READY_Q

SWING, NUDGE, STOP = "swing", "0.1 rad off", "stop"
RATE = 250.0  # torques a second, as in the lab
KP, KD = 100.0, 20.0  # of PD control alone, as in the lab
KI, CLAMP = 4000.0, 0.02  # 1/s3, rad s, as in the lab
LEAST = 1e-3  # mrad, at the foot of the logarithmic axis
REACH = np.array([0.5, 0.4, 0.5, 0.4, 0.6, 0.5, 0.6])
E0 = 0.1 * np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0])
HUGE = 1e4  # N m; with more the simulator reports an instability
CHATTER = 0.2  # fraction of the torques at which a motor switches between its limits
Law = Callable[..., Array]


def springs(own: Own, arm: Arm, q: Array, qd: Array, ref: tuple, tab) -> Array:
    """Return the torque of PD control alone."""
    return own.pd_torque(ref[0] - q, ref[1] - qd, KP, KD)


def with_gravity(own: Own, arm: Arm, q: Array, qd: Array, ref: tuple, tab) -> Array:
    """Return the torque of PD control with gravity compensation."""
    g = arm.at(q).gravity_torque
    return own.gravity_pd(ref[0] - q, ref[1] - qd, KP, KD, g)


def computed(own: Own, arm: Arm, q: Array, qd: Array, ref: tuple, tab) -> Array:
    """Return computed torque with a wanted omega, critically damped."""
    now = arm.at(q)
    e = ref[0] - q
    ed = ref[1] - qd
    known = now.M, now.bias(qd), arm.damping, qd
    return own.computed_torque(*known, e, ed, ref[2], *tab.gains())


def outside(own: Own, arm: Arm, q: Array, qd: Array, ref: tuple, tab) -> Array:
    """Return the public page's torque, with the gains outside M."""
    model = computed(own, arm, q, qd, (q, qd, ref[2]), tab)
    return model + own.pd_torque(ref[0] - q, ref[1] - qd, *tab.gains())


def with_integral(own: Own, arm: Arm, q: Array, qd: Array, ref: tuple, tab) -> Array:
    """Return computed torque whose acceleration comes from PID."""
    now = arm.at(q)
    e = ref[0] - q
    ed = ref[1] - qd
    given = e, ed, tab.integral, *tab.gains(), KI, 1.0 / RATE, CLAMP
    acc, tab.integral = own.pid_step(*given)
    known = (now.M, now.bias(qd), arm.damping, qd)
    none = np.zeros(7)
    return own.computed_torque(*known, none, none, ref[2] + acc, 0.0, 0.0)


LAWS: dict[str, Law] = {
    "computed torque": computed,
    "with an integral (PID)": with_integral,
    "gains outside M": outside,
    "PD and gravity": with_gravity,
    "PD": springs,
}


def reference(t: float, swing: bool) -> tuple[Array, Array, Array]:
    """Return position, velocity and acceleration of the ghost: ready, or the swing."""
    made = references.raised_cosine(READY_Q, REACH) if swing else None
    return (made or references.hold(READY_Q))(t)


def loaded(edit=None):
    """Return the arm with motors, with an edit of its scene."""
    return panda.load("panda_nohand", drive="torque", edit=edit)


class Control(ui.Declared):
    """The reference as a ghost, the error as it comes, the torques against limits."""

    title = "Control"
    library = control
    functions = {
        **dict.fromkeys(("pd_torque", "gravity_pd", "computed_torque"), "N m"),
        "saturate": "N m", "pd_gains": "(1/s2 or 1/s)", "max_stable_omega": "rad/s",
        "error_response": "of the first error", "pid_step": "(rad/s2 or rad s)",
    }  # fmt: skip
    hz = 25.0

    controller = ui.choice("controller", LAWS, then="choose")
    omega = ui.slider("omega", 2, 300, 20.0, "rad/s", 1, then="tell")
    heavy = ui.tick("hang 1 kg on the hand", then="hang")
    does = ui.buttons(SWING, NUDGE, STOP, then="press")
    plot = ui.panel.plot(
        ["measured", "predicted"], y="largest error (mrad)", least=LEAST
    )
    bars = ui.panel.bars(
        ARM_JOINTS, simulate.limits(loaded())[1], "N m", "wanted torque"
    )
    ghost = ui.scene.ghost("blue", legend="the reference")

    def prepare(self) -> None:
        self.models = [loaded(), loaded(scenes.hang_kilogram)]
        self.arm = panda.arm(self.models[0])  # the model never knows of the load
        self.known, self.kp_kd = (0.0, 0), np.zeros(2)
        self.limits = simulate.limits(self.models[0])[1]
        steps = simulate.steps_per_period(self.models[0], RATE)
        h = float(self.models[0].opt.timestep)
        self.breaks_at = float(control.max_stable_omega(h, steps))
        self.settle(READY_Q)

    def choose(self) -> None:
        """Take another controller, from now on."""
        self.integral = np.zeros(7)

    def hang(self) -> None:
        """Add 1 kg or take it off, and go on from where the arm is."""
        q, qd = self.data.qpos[:7], self.data.qvel[:7]
        self.data = simulate.start(self.models[self.heavy], q, qd)

    def press(self) -> None:
        """Start one of the two runs, or stop."""
        self.loop.stop()
        if self.does != STOP:
            self.settle(READY_Q if self.does == SWING else READY_Q - E0)
            self.loop.start()

    def restart(self) -> None:
        """Let go 0.1 rad off."""
        self.does = NUDGE
        self.settle(READY_Q - E0)

    def settle(self, q: Array) -> None:
        """Put the arm at rest somewhere, time at 0, the plot empty."""
        self.data = simulate.start(self.models[self.heavy], q)
        self.integral = np.zeros(7)
        self.since = 0
        self.wanted: list[Array] = []
        self.plot.clear()
        self.move()

    def on_move(self, q: Array) -> None:
        if not self.loop.running:
            self.request()

    def ask(self, fns, at) -> float:
        """Return from which omega on the loop breaks."""
        return float(fns.max_stable_omega(1.0 / RATE))

    def gains(self) -> Array:
        """Return the student's gains for omega, asked when it or the file changes."""
        key = self.omega, self.own.version
        if self.known != key:
            self.known, self.kp_kd = key, self.own.pd_gains(self.omega, 1.0)
        return self.kp_kd

    def advance(self, seconds: float) -> None:
        model, law = self.models[self.heavy], LAWS[self.controller]
        simulate.run(model, self.data, self.torque, 1.0 / self.hz, rate=RATE)
        self.predicted = np.nan
        if law is computed and self.does != SWING and not self.heavy:
            t = np.array([self.since / RATE])
            decay = self.own.error_response(t, self.omega, 1.0)
            self.predicted = 100.0 * float(decay[0])

    def torque(self, t: float, q: Array, qd: Array) -> Array:
        """Return the student's torque, and keep what it was before its limits."""
        ref = reference(self.since / RATE, self.does == SWING)
        wanted = LAWS[self.controller](self.own, self.arm, q, qd, ref, self)
        given = self.own.saturate(wanted, self.limits)
        self.wanted, self.since = [*self.wanted[-49:], wanted], self.since + 1
        return np.clip(given, -HUGE, HUGE)

    def frame(self, seconds: float) -> None:
        self.bars.show(self.wanted[-1])
        self.plot.add(self.since / RATE, [self.measured(), self.predicted])
        self.move()

    def move(self) -> None:
        """Move the arm to where the simulation is, the ghost to the reference."""
        q = self.page.q
        q[:7] = self.data.qpos[:7]
        self.page.move(q)
        wanted = reference(self.since / RATE, self.does == SWING)[0]
        self.ghost.pose(self.page.links(wanted))

    def measured(self) -> float:
        """Return the largest error now, mrad."""
        wanted = reference(self.since / RATE, self.does == SWING)[0]
        return 1e3 * float(np.abs(wanted - self.data.qpos[:7]).max())

    def says(self, stiffest: float, right: float):
        if self.wanted:
            chatter, off = self.chatter(), self.measured()
            told = words.digits(off) if off > LEAST else f"under {LEAST:g}"
            says = f"t = {self.since / RATE:.2f} s; largest error {told} mrad{chatter}"
            yield says, False if chatter else None
        returns = f"your max_stable_omega(0.004) returns {stiffest:.0f} rad/s"
        returns += f" (the library's {right:.0f})" if stiffest != right else ""
        laws = (springs, with_gravity)
        over = self.omega > self.breaks_at and LAWS[self.controller] not in laws
        yield (
            f"With a torque every 4 ms the loop is unstable from {int(self.breaks_at)} "
            f"rad/s on; {returns}.", False if over else "max_stable_omega",
        )  # fmt: skip

    def chatter(self) -> str:
        """Return which motor goes from limit to limit, and how often; "" for none."""
        some = np.array(self.wanted)
        over = np.abs(some) >= self.limits
        flips = (np.sign(some[1:]) != np.sign(some[:-1])) & over[1:] & over[:-1]
        worst = int(flips.sum(axis=0).argmax())
        count = int(flips[:, worst].sum())
        if count < CHATTER * len(some):
            return ""
        return (
            f". The loop CHATTERS: {ARM_JOINTS[worst]} switched between its limits "
            f"{count} times in the last {len(some)} torques"
        )


TABS = [Control]
