"""Day 5 in the inspector: the tab Control, the student's controllers in real time.

The arm is simulated with motors; the blue arm is the reference. The torques come from
the student's own functions at 250 Hz, as in the lab.
"""

from collections.abc import Callable

import numpy as np

from labkit.inspector import words
from labkit.inspector.own import Own
from labkit.inspector.page import Page
from labkit.inspector.tab import PLAYS, Tab
from robo47 import control, panda, references, scenes, simulate
from robo47.arm import Arm
from robo47.checks import Array
from robo47.panda import ARM_JOINTS, READY_Q

SWING, NUDGE, STOP = "swing", "0.1 rad off", "stop"
HZ, RATE = 25.0, 250.0  # pictures a second; torques a second, as in the lab
KP, KD = 100.0, 20.0  # of PD control alone, as in the lab
KI, CLAMP = 4000.0, 0.02  # 1/s3, rad s, as in the lab
SAME = 1e-6  # relative difference of two limits of omega
LEAST = 1e-3  # mrad, at the foot of the logarithmic axis
REACH = np.array([0.5, 0.4, 0.5, 0.4, 0.6, 0.5, 0.6])
E0 = 0.1 * np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0])
HUGE = 1e4  # N m; with more the simulator reports an instability
CHATTER = 0.2  # fraction of the torques at which a motor switches between its limits
UNITS = {
    **dict.fromkeys(("pd_torque", "gravity_pd", "computed_torque", "saturate"), "N m"),
    "pd_gains": "(1/s2 or 1/s)", "error_response": "of the first error",
    "max_stable_omega": "rad/s", "pid_step": "(rad/s2 or rad s)",
}  # fmt: skip
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
        self.law = computed
        self.omega = 20.0
        self.heavy = 0
        self.swing = False
        self.known = (0.0, 0)
        self.asked_of = 0  # the file whose max_stable_omega is shown
        self.kp_kd = np.zeros(2)
        self.limits = simulate.limits(self.models[0])[1]
        steps = simulate.steps_per_period(self.models[0], RATE)
        h = float(self.models[0].opt.timestep)
        self.breaks_at = float(control.max_stable_omega(h, steps))
        self.stiffest = np.nan  # the student's, of a step of 4 ms
        self.own = page.own(control, units=UNITS)
        self.ghost = page.draw.ghost("blue")
        page.choice("controller", list(LAWS), self.choose)
        page.slider("omega", 2, 300, 20, self.tune, unit="rad/s", step=1)
        page.tick("hang 1 kg on the hand", self.hang)
        page.buttons([SWING, NUDGE, STOP], self.press)
        self.clock, self.breaks = page.html(), page.html()
        curves = ["measured", "predicted"]
        self.plot = page.plot(curves, y="largest error (mrad)", least=LEAST)
        self.bars = page.bars(ARM_JOINTS, self.limits, "N m", "wanted torque")
        self.loop = page.animate(self.step, HZ, work=self.work)
        page.light("ee", {"ee"})
        page.legend({"the simulated arm": "grey", "the reference": "blue"})
        self.restart(READY_Q)

    def choose(self, name: str) -> None:
        """Take another controller, from now on."""
        self.law = LAWS[name]
        self.integral = np.zeros(7)

    def tune(self, omega: float) -> None:
        """Make the springs stiffer or softer, critically damped."""
        self.omega = omega
        self.say_stiffest(self.stiffest)

    def say_stiffest(self, stiffest: float) -> None:
        """Say from which omega on the loop breaks, by the student's function."""
        self.stiffest = stiffest
        right = float(control.max_stable_omega(1.0 / RATE))
        broken = self.omega > self.breaks_at and self.law not in (springs, with_gravity)
        wrong = abs(stiffest - right) > SAME * right
        says = (
            f"with a torque every 4 ms the loop is unstable from {int(self.breaks_at)} "
            f"rad/s on; your max_stable_omega(0.004) returns {stiffest:.0f}"
        )
        if wrong:
            says += f", and the library's returns {right:.0f}"
        kind = "bad" if broken or wrong else ""
        self.breaks.content = words.line(says, "stiffest", kind)

    def on_move(self, q: Array) -> None:
        """Ask from which omega on the loop breaks, once for a file."""
        if self.asked_of != self.own.version or not self.own.fresh():
            self.page.job(lambda: self.own.max_stable_omega(1.0 / RATE), self.heard)

    def heard(self, stiffest: Array) -> None:
        """Keep the student's stiffest omega."""
        self.asked_of = self.own.version
        self.say_stiffest(float(stiffest))

    def begin(self) -> None:
        """Let go 0.1 rad off."""
        self.press(NUDGE)
        self.loop.lasts = PLAYS

    def lost(self) -> None:
        """Show no torques and no error."""
        self.bars.clear()
        self.plot.clear()
        self.clock.content = self.breaks.content = ""

    def gains(self) -> Array:
        """Return the student's gains for omega, asked when it or the file changes."""
        key = self.omega, self.own.version
        if self.known != key:
            self.known, self.kp_kd = key, self.own.pd_gains(self.omega, 1.0)
        return self.kp_kd

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
        self.integral = np.zeros(7)
        self.since = 0
        self.asked: list[Array] = []
        self.plot.clear()
        self.show(reference(0.0, self.swing)[0])

    def work(self, seconds: float) -> None:
        """Simulate one frame's time; it waits for the student's torques."""
        model = self.models[self.heavy]
        simulate.run(model, self.data, self.torque, 1.0 / HZ, rate=RATE)
        self.predicted = np.nan
        if self.law is computed and not self.swing and not self.heavy:
            t = np.array([self.since / RATE])
            decay = self.own.error_response(t, self.omega, 1.0)
            self.predicted = 100.0 * float(decay[0])

    def torque(self, t: float, q: Array, qd: Array) -> Array:
        """Return the student's torque, and keep what it was before its limits."""
        ref = reference(self.since / RATE, self.swing)
        wanted = self.law(self.own, self.arm, q, qd, ref, self)
        given = self.own.saturate(wanted, self.limits)
        self.asked, self.since = [*self.asked[-49:], wanted], self.since + 1
        return np.clip(given, -HUGE, HUGE)

    def step(self, seconds: float) -> None:
        """Show what came of it."""
        t = self.since / RATE
        ref = reference(t, self.swing)
        measured = 1e3 * float(np.abs(ref[0] - self.data.qpos[:7]).max())
        self.bars.show(self.asked[-1])
        self.plot.add(t, [measured, self.predicted])
        chatter = self.chatter()
        off = words.digits(measured) if measured > LEAST else f"under {LEAST:g}"
        says = f"t = {t:.2f} s; largest error {off} mrad{chatter}"
        self.clock.content = words.line(says, "clock", "bad" if chatter else "")
        self.show(ref[0])

    def chatter(self) -> str:
        """Return which motor goes from limit to limit, and how often; "" for none."""
        some = np.array(self.asked)
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

    def show(self, wanted: Array) -> None:
        """Move the arm to where the simulation is, the ghost to the reference."""
        q = self.page.q
        q[:7] = self.data.qpos[:7]
        self.page.move(q)
        self.ghost.pose(self.page.links(wanted))


TABS = [Control]
