"""Sensitivity of Day 5's numbers: each constant is doubled, measured and explained."""

from functools import cache

import numpy as np

from labkit.lesson.constants import Numbers, altered, between, same, times
from labkit.lesson.lab_module import complete_lab
from robo47 import panda, references, scenes, simulate

LAB = complete_lab(5)
DAY = LAB.day5_mujoco
READY, E0 = LAB.READY_Q, LAB.E0
GOAL = references.hold(READY)

numbers = Numbers(
    LAB, DAY,
    KP="KP: {} N m/rad",
    KD="KD: {} N m s/rad",
    gravity="gravity: × {}",
    wait="simulated: {} s",
    RATE="RATE: {} Hz",
    step="time step: {} s",
    INTEGRATOR="INTEGRATOR: {}",
    e0="E0, the first error: × {}",
    omega="omega: {} rad/s",
    OMEGA="omega: {} rad/s",
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
    altered(model, damping=damping, gravity=gravity, step=step)
    return model, panda.arm(model)


@numbers.add("joint 4 hangs low under PD control by", "{:.3f} mrad",
    KP=between(0.45, 0.5, "a little less than half, because the gravity torque changes with q"),
    KD=same("the arm is at rest"),
    gravity=between(1.8, 2.2, "about twice, because the gravity torque changes with q"),
    wait=same("the arm is at rest"),
    RATE=same("the torque is constant, so holding it has no effect"),
    step=same("the arm is at rest", to=0.001),
    INTEGRATOR=same("the arm is at rest", to="mjINT_EULER"))
def sag(gravity=1.0, wait=6.0, step=0.002):
    log = LAB.run(*bench(step, LAB.INTEGRATOR, gravity), LAB.springs, GOAL, wait, rate=LAB.RATE)
    return 1e3 * (READY - log.q[-1])[3]


def decay(zeta, seconds, step, omega, e0, gravity, law=None):
    """Return t and the error of each joint over its first one, (N, 7)."""
    model = bench(step, gravity=gravity)
    law = law or LAB.equal_springs(omega, zeta)
    log = LAB.run(*model, law, GOAL, seconds, READY - e0 * E0, LAB.RATE)
    return log.t, (READY - log.q) / (e0 * E0)


@numbers.add("zeta 1, after 0.3 s", "{:.3f} of e0",
    RATE=between(1.005, 1.03, "half the difference from the formula's 0.199"),
    omega=between(0.05, 0.12, "(1 + 6) exp(-6) instead of (1 + 3) exp(-3)"),
    e0=same("the error dynamics are linear at any amplitude"),
    gravity=same("gravity is in the bias, and cancels"),
    step=between(0.995, 1.005, "the motors hold their torque for the same time", to=0.001))
def decayed(omega=10.0, e0=1.0, gravity=1.0, step=0.002):
    return decay(1.0, 0.3, step, omega, e0, gravity)[1][-1].mean()


@numbers.add("zeta 0.5: largest distance from the predicted curve", "{:.5f} of e0",
    RATE=between(0.5, 0.6, "the torque is held for half the time"),
    omega=between(1.8, 2.3, "the control period is twice as large a fraction of an oscillation period"),
    e0=times(1.0, "the loop is nearly linear, but not exactly, because the held torque does not follow the change of M"),
    step=between(0.95, 1.05, "the motors hold their torque for the same time", to=0.001))
def off_curve(omega=10.0, e0=1.0, step=0.002):
    t, e = decay(0.5, 1.0, step, omega, e0, 1.0)
    return np.abs(e.T - LAB.error_response(t, omega, 0.5)).max()


def swings(reach, seconds):
    """Return the swing: so far, out and back in so many seconds."""
    swing = references.raised_cosine(READY, reach * LAB.REACH)
    k = 2.0 / seconds
    order = k ** np.arange(3)  # of a time that runs k times as fast
    return lambda t: [x * f for x, f in zip(swing(k * t), order, strict=True)]


def follows(law, reach, seconds, **how):
    """Return how far off the swing an arm is, in mrad."""
    swing = swings(reach, seconds)
    log = LAB.run(*bench(**how), law, swing, seconds, rate=LAB.RATE)
    return LAB.tracking(log, swing).max()


@numbers.add("gains outside M: distance from the predicted curve", "{:.3f} of e0",
    RATE=between(0.95, 1.02, "the held torque causes only a small part of the error"),
    e0=between(0.8, 1.0, "M changes more in a larger motion, so this law is not linear"),
    OMEGA=between(0.5, 2.0, "both gains grow, and the wrist stays overdamped"))
def outside(e0=1.0):
    t, e = decay(1.0, 0.5, 0.002, LAB.OMEGA, e0, 1.0, LAB.gains_outside)
    return np.abs(e.T - LAB.error_response(t, LAB.OMEGA, 1.0)).max()


@numbers.add("largest error of computed torque in step 4", "{:.2f} mrad",
    OMEGA=between(0.45, 0.6, "the disturbance is the same, and kd is twice as large"),
    RATE=between(0.95, 1.1, "the held torque causes the smaller part of the error"),
    step=between(0.5, 0.7, "the simulator's step causes the larger part", to=0.001),
    reach=between(1.8, 4.5, "twice the velocity and acceleration"),
    seconds=between(0.2, 0.6, "half the velocity, a quarter of the acceleration"),
    damping=between(0.9, 1.0, "the model includes the damping, but the simulator's step uses M + hD, and this difference remains"),
    gravity=between(1.0, 1.15, "gravity cancels at the start of a period, and almost cancels at its end"),
    INTEGRATOR=between(0.5, 0.8, "the error from the simulator's step vanishes, and the error from the held torque remains", to="mjINT_RK4"))
def tracks(reach=1.0, seconds=2.0, damping=1.0, gravity=1.0, step=0.002):
    how = {
        "damping": damping,
        "gravity": gravity,
        "integrator": LAB.INTEGRATOR,
        "step": step,
    }
    return follows(LAB.equal_springs(LAB.OMEGA), reach, seconds, **how)


@numbers.add("the same for the model at the measured state, without PD terms", "{:.2f} mrad",
    RATE=between(0.4, 0.5, "half the period gives less than half the error"),
    gravity=between(1.05, 1.6, "without gravity it is 15, so gravity causes the smaller part"),
    reach=between(1.5, 4.5, "twice the velocity and acceleration"))
def unsprung(gravity=1.0, reach=1.0):
    return follows(LAB.without_springs, reach, 2.0, gravity=gravity)


@numbers.add("the same for feedforward", "{:.0f} mrad",
    RATE=between(0.3, 0.45, "the held torque causes the first small error, which then grows"),
    gravity=between(0.0, 0.01, "without gravity the upright arm is not unstable", to=0.0))
def fed(gravity=1.0):
    return follows(LAB.feedforward, 1.0, 2.0, gravity=gravity)


@numbers.add("the same for the model file's servos", "{:.2f} mrad",
    servo_kd=between(1.7, 1.9, "the lag approaches kd / kp times the velocity, but the velocity stays high for less than 0.2 s"),
    reach=times(2.0, "kd / kp times the velocity", within=0.1),
    seconds=times(0.5, "kd / kp times the velocity", within=0.1),
    step=times(1.0, "the lag does not depend on the step", to=0.001))
def servos(servo_kd=1.0, reach=1.0, seconds=2.0, step=0.002):
    model = panda.load("panda_nohand")
    model.opt.timestep = step
    model.actuator_biasprm[:, 2] *= servo_kd
    swing = swings(reach, seconds)
    data = simulate.start(model, READY)
    log = simulate.run(model, data, lambda t, q, qd: swing(t)[0], seconds)
    return LAB.tracking(log, swing).max()


@numbers.add("joint 4 hangs low under 1 kg by", "{:.3f} mrad",
    OMEGA=times(0.25, "the stiffness per unit inertia is omega²"),
    mass=times(2.0, "the error is proportional to the load"),
    wait=same("the arm is at rest"),
    RATE=same("the torque is constant, so holding it has no effect"),
    damping=same("the arm is at rest"))
def under_load(mass=1.0, wait=1.5, damping=1.0):
    heavy, _ = bench(mass=mass, damping=damping)
    _, arm = bench(damping=damping)
    log = LAB.run(heavy, arm, LAB.equal_springs(LAB.OMEGA), GOAL, wait, rate=LAB.RATE)
    return 1e3 * (READY - log.q[-1])[3]


@numbers.add("the loop is unstable from", "{:.0f} rad/s",
    RATE=between(0.51, 0.54, "omega T is limited, so about half; slightly more, because a period contains more steps (next row)", to=125.0),
    step=between(1.0, 1.12, "omega T is 0.90 with 2 steps per period, 0.94 with 4", to=0.001),
    damping=times(1.0, "the implicit step's hD is a thousandth of M", within=0.01),
    start=same("for such small errors the loop is linear"))
def breaks(step=0.002, damping=1.0, start=1.0):
    model, _ = bench(step, damping=damping)
    return DAY.breaking(model, LAB.equal_springs, LAB.RATE, READY - start * 1e-8 * E0)
