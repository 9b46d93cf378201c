"""Sensitivity of Day 5's numbers: each constant is doubled, measured and explained."""

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
    reach="REACH, the amplitudes: × {}",
    seconds="duration of the motion: {} s",
    damping="damping of the joints: × {}",
    mass="mass that the model omits: × {}",
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
    "joint 4 hangs low under PD control by", "{:.3f} mrad",
    kp=between(0.45, 0.5, "a little less than half, because the gravity torque "
                          "changes with q"),
    kd=same("the arm is at rest"),
    gravity=between(1.8, 2.2, "about twice, because the gravity torque changes with q"),
    wait=same("the arm is at rest"),
    rate=same("the torque is constant, so holding it has no effect"),
    step=same("the arm is at rest", to=0.001),
    integrator=same("the arm is at rest", to="mjINT_EULER"),
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
    rate=between(1.005, 1.03, "half the difference from the formula's 0.199"),
    omega=between(0.05, 0.12, "(1 + 6) exp(-6) instead of (1 + 3) exp(-3)"),
    e0=same("the error dynamics are linear at any amplitude"),
    gravity=same("gravity is in the bias, and cancels"),
    step=between(0.995, 1.005, "the motors hold their torque for the same time", to=0.001),
)  # fmt: skip
def decayed(rate=LAB.RATE, omega=10.0, e0=1.0, gravity=1.0, step=0.002):
    """Return the mean error of the joints after 0.3 s."""
    return decay(1.0, 0.3, rate, step, omega, e0, gravity)[1][-1].mean()


@numbers.add(
    "zeta 0.5: largest distance from the predicted curve", "{:.5f} of e0",
    rate=between(0.5, 0.6, "the torque is held for half the time"),
    omega=between(1.8, 2.3, "the control period is twice as large a fraction of "
                            "an oscillation period"),
    e0=times(1.0, "the loop is nearly linear, but not exactly, because the held "
                  "torque does not follow the change of M"),
    step=between(0.95, 1.05, "the motors hold their torque for the same time", to=0.001),
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
    "gains outside M: distance from the predicted curve", "{:.3f} of e0",
    rate=between(0.95, 1.02, "the held torque causes only a small part of the error"),
    e0=between(0.8, 1.0, "M changes more in a larger motion, so this law is not linear"),
    omega=between(0.5, 2.0, "both gains grow, and the wrist stays overdamped"),
)  # fmt: skip
def outside(rate=LAB.RATE, e0=1.0, omega=LAB.OMEGA):
    """Return how far the public page's law is from its curve."""
    with turned(LAB, OMEGA=omega):
        t, e = decay(1.0, 0.5, rate, 0.002, omega, e0, 1.0, LAB.gains_outside)
    return np.abs(e.T - LAB.error_response(t, omega, 1.0)).max()


@numbers.add(
    "largest error of computed torque in step 4", "{:.2f} mrad",
    omega=between(0.45, 0.6, "the disturbance is the same, and kd is twice as large"),
    rate=between(0.95, 1.1, "the held torque causes the smaller part of the error"),
    step=between(0.5, 0.7, "the simulator's step causes the larger part", to=0.001),
    reach=between(1.8, 4.5, "twice the velocity and acceleration"),
    seconds=between(0.2, 0.6, "half the velocity, a quarter of the acceleration"),
    damping=between(0.9, 1.0, "the model includes the damping, but the "
                              "simulator's step uses M + hD, and this difference "
                              "remains"),
    gravity=between(1.0, 1.15, "gravity cancels at the start of a period, and "
                               "almost cancels at its end"),
    integrator=between(0.5, 0.8, "the error from the simulator's step vanishes, "
                                 "and the error from the held torque remains",
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
    "the same for the model at the measured state, without PD terms", "{:.2f} mrad",
    rate=between(0.4, 0.5, "half the period gives less than half the error"),
    gravity=between(1.05, 1.6, "without gravity it is 15, so gravity causes the smaller part"),
    reach=between(1.5, 4.5, "twice the velocity and acceleration"),
)  # fmt: skip
def unsprung(rate=LAB.RATE, gravity=1.0, reach=1.0):
    """Return the largest error without springs."""
    return follows(LAB.without_springs, rate, reach, 2.0, gravity=gravity)


@numbers.add(
    "the same for feedforward", "{:.0f} mrad",
    rate=between(0.3, 0.45, "the held torque causes the first small error, which then grows"),
    gravity=between(0.0, 0.01, "without gravity the upright arm is not unstable", to=0.0),
)  # fmt: skip
def fed(rate=LAB.RATE, gravity=1.0):
    """Return the largest error of a torque known beforehand."""
    return follows(LAB.feedforward, rate, 1.0, 2.0, gravity=gravity)


@numbers.add(
    "the same for the model file's servos", "{:.2f} mrad",
    servo_kd=between(1.7, 1.9, "the lag approaches kd / kp times the velocity, "
                               "but the velocity stays high for less than 0.2 s"),
    reach=times(2.0, "kd / kp times the velocity", within=0.1),
    seconds=times(0.5, "kd / kp times the velocity", within=0.1),
    step=times(1.0, "the lag does not depend on the step", to=0.001),
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
    omega=times(0.25, "the stiffness per unit inertia is omega²"),
    mass=times(2.0, "the error is proportional to the load"),
    wait=same("the arm is at rest"),
    rate=same("the torque is constant, so holding it has no effect"),
    damping=same("the arm is at rest"),
)  # fmt: skip
def under_load(omega=LAB.OMEGA, mass=1.0, wait=1.5, rate=LAB.RATE, damping=1.0):
    """Return how far joint 4 sags under the kilogram."""
    heavy, _ = bench(mass=mass, damping=damping)
    _, arm = bench(damping=damping)
    log = LAB.run(heavy, arm, LAB.equal_springs(omega), GOAL, wait, rate=rate)
    return 1e3 * (READY - log.q[-1])[3]


@numbers.add(
    "the loop is unstable from", "{:.0f} rad/s",
    rate=between(0.51, 0.54, "omega T is limited, so about half; slightly more, "
                             "because a period contains more steps (next row)",
                             to=125.0),
    step=between(1.0, 1.12, "omega T is 0.90 with 2 steps per period, 0.94 with 4",
                 to=0.001),
    damping=times(1.0, "the implicit step's hD is a thousandth of M", within=0.01),
    start=same("for such small errors the loop is linear"),
)  # fmt: skip
def breaks(rate=LAB.RATE, step=0.002, damping=1.0, start=1.0):
    """Return the omega from which a tiny error grows."""
    model, _ = bench(step, damping=damping)
    return DAY.breaking(model, LAB.equal_springs, rate, READY - start * 1e-8 * E0)
