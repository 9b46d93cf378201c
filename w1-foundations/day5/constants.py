"""What Day 5's numbers hang on: each constant turned by two, measured, explained."""

from functools import cache

import numpy as np

from labkit.lesson.constants import Numbers, between, same, times, turned
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47 import panda, references, scenes, simulate

LAB = lab_of(find_day(5))
DAY = LAB.day5_mujoco
READY, E0 = LAB.READY_Q, LAB.E0
GOAL = references.hold(READY)

numbers = Numbers(
    kp="KP: {} N m/rad",
    kd="KD: {} N m s/rad",
    gravity="gravity: × {}",
    wait="simulated: {} s",
    rate="RATE: {} Hz",
    step="time step: {} s",
    integrator="INTEGRATOR: {}",
    e0="E0, the first error: × {}",
    omega="omega: {} rad/s",
    reach="REACH: × {}",
    seconds="the swing takes {} s",
    damping="damping of the joints: × {}",
    mass="mass that nobody told: × {}",
    servo_kd="kd of the servos: × {}",
    start="its first error: × {}",
)


@cache
def bench(step=0.002, integrator=LAB.INTEGRATOR, gravity=1.0, damping=1.0, mass=0.0):
    """Return the arm with motors, and Day 4's library of it."""
    edit = (lambda spec: scenes.hang_kilogram(spec)) if mass else None
    model = DAY.motors(LAB.DRIVE, integrator, edit)
    if mass:
        model.body_mass[-1] *= mass
    model.opt.timestep = step
    model.opt.gravity[:] *= gravity
    model.dof_damping[:] *= damping
    return model, panda.arm(model)


@numbers.add(
    "joint 4 hangs low on springs by", "{:.3f} mrad",
    kp=between(0.45, 0.5, "half, and a little less: gravity's torque changes with q"),
    kd=same("nothing moves any more"),
    gravity=between(1.8, 2.2, "twice, but for how gravity's torque changes with q"),
    wait=same("nothing moves any more"),
    rate=same("a torque that is held and does not change is the same torque"),
    step=same("nothing moves any more", to=0.001),
    integrator=same("nothing moves any more", to="mjINT_EULER"),
)  # fmt: skip
def sag(kp=LAB.KP, kd=LAB.KD, gravity=1.0, wait=6.0, rate=LAB.RATE, step=0.002,
        integrator=LAB.INTEGRATOR):  # fmt: skip
    """Return how far joint 4 sags."""
    with turned(LAB, KP=kp, KD=kd):
        log = LAB.run(*bench(step, integrator, gravity), LAB.springs, GOAL, wait,
                      rate=rate)  # fmt: skip
    return 1e3 * (READY - log.q[-1])[3]


def decay(zeta, seconds, rate, step, omega, e0, gravity, law=None):
    """Return t and the error of each joint over its first one, (N, 7)."""
    model = bench(step, gravity=gravity)
    law = law or LAB.equal_springs(omega, zeta)
    log = LAB.run(*model, law, GOAL, seconds, READY - e0 * E0, rate)
    return log.t, (READY - log.q) / (e0 * E0)


@numbers.add(
    "zeta 1, after 0.3 s", "{:.3f} of e0",
    rate=between(1.005, 1.03, "half the way from 0.195 to the 0.199 of the formula"),
    omega=between(0.05, 0.12, "(1 + 6) exp(-6) for (1 + 3) exp(-3)"),
    e0=same("the error's equation is linear, however large the motion"),
    gravity=same("it is in the bias, and cancels"),
    step=between(0.995, 1.005, "the motors hold their torque just as long", to=0.001),
)  # fmt: skip
def decayed(rate=LAB.RATE, omega=10.0, e0=1.0, gravity=1.0, step=0.002):
    """Return the mean error of the joints after 0.3 s."""
    return decay(1.0, 0.3, rate, step, omega, e0, gravity)[1][-1].mean()


@numbers.add(
    "zeta 0.5: largest distance from the predicted curve", "{:.5f} of e0",
    rate=between(0.5, 0.6, "the held torque: half the period, about half of it"),
    omega=between(1.8, 2.3, "the same period is twice the part of a swing"),
    e0=times(1.0, "linear, but for the M that a held torque does not follow"),
    step=between(0.95, 1.05, "the motors hold their torque just as long", to=0.001),
)  # fmt: skip
def off_curve(rate=LAB.RATE, omega=10.0, e0=1.0, step=0.002):
    """Return how far the error is from its curve."""
    t, e = decay(0.5, 1.0, rate, step, omega, e0, 1.0)
    return np.abs(e.T - LAB.error_response(t, omega, 0.5)).max()


def swings(reach, seconds):
    """Return the swing: so far, out and back in so many seconds."""
    swing = references.raised_cosine(READY, reach * LAB.REACH)
    k = 2.0 / seconds
    order = k ** np.arange(3)  # of a time that runs k times as fast
    return lambda t: [x * f for x, f in zip(swing(k * t), order, strict=True)]


def follows(law, rate, reach, seconds, **how):
    """Return how far off the swing an arm is, in mrad."""
    swing = swings(reach, seconds)
    log = LAB.run(*bench(**how), law, swing, seconds, rate=rate)
    return LAB.tracking(log, swing).max()


@numbers.add(
    "gains outside M miss their curve by", "{:.3f} of e0",
    rate=between(0.95, 1.02, "the held torque is the least of it"),
    e0=between(0.8, 1.0, "a larger motion meets other M: this law is not linear"),
    omega=between(0.5, 2.0, "springs and dampers grow: the wrist stays overdamped"),
)  # fmt: skip
def outside(rate=LAB.RATE, e0=1.0, omega=LAB.OMEGA):
    """Return how far the public page's law is from its curve."""
    with turned(LAB, OMEGA=omega):
        t, e = decay(1.0, 0.5, rate, 0.002, omega, e0, 1.0, LAB.gains_outside)
    return np.abs(e.T - LAB.error_response(t, omega, 1.0)).max()


@numbers.add(
    "computed torque follows the swing within", "{:.2f} mrad",
    omega=between(0.45, 0.6, "what disturbs it stays, and kd is twice as large"),
    rate=between(0.95, 1.1, "the held torque is the smaller part of it"),
    step=between(0.5, 0.7, "the simulator's step is the larger part", to=0.001),
    reach=between(1.8, 4.5, "twice the speed and acceleration"),
    seconds=between(0.2, 0.6, "half of the speed, a quarter of the acceleration"),
    damping=between(0.9, 1.0, "the model has it; the step's M + hD for M is left"),
    gravity=between(1.0, 1.15, "it cancels when the torque is asked, and nearly so a "
                    "period later"),
    integrator=between(0.5, 0.8, "the step's part is gone, the held torque's is left",
                       to="mjINT_RK4"),
)  # fmt: skip
def tracks(omega=LAB.OMEGA, rate=LAB.RATE, reach=1.0, seconds=2.0, damping=1.0,
           gravity=1.0, integrator=LAB.INTEGRATOR, step=0.002):  # fmt: skip
    """Return the largest error of computed torque."""
    how = {
        "damping": damping,
        "gravity": gravity,
        "integrator": integrator,
        "step": step,
    }
    return follows(LAB.equal_springs(omega), rate, reach, seconds, **how)


@numbers.add(
    "the model asked where the arm is, without springs", "{:.2f} mrad",
    rate=between(0.4, 0.5, "the held torque: half of its period, less than half of it"),
    gravity=between(1.05, 1.6, "without any it is 15: most is not gravity's"),
    reach=between(1.5, 4.5, "twice the speed and acceleration"),
)  # fmt: skip
def unsprung(rate=LAB.RATE, gravity=1.0, reach=1.0):
    """Return the largest error without springs."""
    return follows(LAB.without_springs, rate, reach, 2.0, gravity=gravity)


@numbers.add(
    "feedforward", "{:.0f} mrad",
    rate=between(0.3, 0.45, "its first small error is the held torque's, and grows"),
    gravity=between(0.0, 0.01, "nothing pulls an arm away that stands up", to=0.0),
)  # fmt: skip
def fed(rate=LAB.RATE, gravity=1.0):
    """Return the largest error of a torque known beforehand."""
    return follows(LAB.feedforward, rate, 1.0, 2.0, gravity=gravity)


@numbers.add(
    "the model file's servos lag by", "{:.2f} mrad",
    servo_kd=between(1.7, 1.9, "kd / kp times the speed, which lasts for no 0.2 s"),
    reach=times(2.0, "kd / kp times the speed", within=0.1),
    seconds=times(0.5, "kd / kp times the speed", within=0.1),
    step=times(1.0, "a lag does not depend on the step", to=0.001),
)  # fmt: skip
def servos(servo_kd=1.0, reach=1.0, seconds=2.0, step=0.002):
    """Return how far the servos are off the swing."""
    model = panda.load("panda_nohand")
    model.opt.timestep = step
    model.actuator_biasprm[:, 2] *= servo_kd
    swing = swings(reach, seconds)
    data = simulate.start(model, READY)
    log = simulate.run(model, data, lambda t, q, qd: swing(t)[0], seconds)
    return LAB.tracking(log, swing).max()


@numbers.add(
    "joint 4 hangs low under 1 kg by", "{:.3f} mrad",
    omega=times(0.25, "a spring of unit inertia holds omega² per rad"),
    mass=times(2.0, "the same share of twice the load"),
    wait=same("nothing moves any more"),
    rate=same("a torque that is held and does not change is the same torque"),
    damping=same("nothing moves any more"),
)  # fmt: skip
def under_load(omega=LAB.OMEGA, mass=1.0, wait=1.5, rate=LAB.RATE, damping=1.0):
    """Return how far joint 4 sags under the kilogram."""
    heavy, _ = bench(mass=mass, damping=damping)
    _, arm = bench(damping=damping)
    log = LAB.run(heavy, arm, LAB.equal_springs(omega), GOAL, wait, rate=rate)
    return 1e3 * (READY - log.q[-1])[3]


@numbers.add(
    "the loop breaks at", "{:.0f} rad/s",
    rate=between(0.51, 0.54, "half, since omega T is the limit; a little more, by the "
                 "next row", to=125.0),
    step=between(1.0, 1.12, "omega T is 0.90 with two steps a period, 0.94 with four",
                 to=0.001),
    damping=times(1.0, "the implicit step's M + hD for M is a thousandth", within=0.01),
    start=same("so near it is linear"),
)  # fmt: skip
def breaks(rate=LAB.RATE, step=0.002, damping=1.0, start=1.0):
    """Return the omega from which a tiny error grows."""
    model, _ = bench(step, damping=damping)
    return DAY.breaking(model, LAB.equal_springs, rate, READY - start * 1e-8 * E0)
