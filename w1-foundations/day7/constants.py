"""Sensitivity of Day 7's numbers: each constant is doubled, measured and explained.

The pick's own numbers (0.92 mm, 0.64 mrad) are not among them: they depend on contacts,
which differ between versions of MuJoCo; the guide gives them wide limits instead.
"""

from functools import cache

import numpy as np

from labkit.lesson.constants import Numbers, between, same, times, turned
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of

LAB = lab_of(find_day(7))
DAY = LAB.day7_mujoco
READY, GOAL = LAB.READY_Q, LAB.GOAL_Q
LIFT = 1.232  # m/s², of the guide

numbers = Numbers(
    way="distance from ready to GOAL_Q: × {}",
    v="V_MAX: × {}",
    a="A_MAX: × {}",
    duration="duration of the motion: × {}",
    omega="OMEGA: {} rad/s",
    rate="RATE: {} Hz",
    grip="normal force of a finger: {} N",
    mu="friction coefficient mu: {}",
    lift="acceleration of the lift: {} m/s²",
    gravity="gravity: × {}",
)


@numbers.add(
    "shortest duration of the motion", "{:.4f} s",
    v=between(0.7, 0.95, "the acceleration limit of joint 2 then determines it"),
    a=same("the velocity limit of joint 7 determines it"),
    way=times(2.0, "twice the distance at the same velocity"),
)  # fmt: skip
def duration(v=1.0, a=1.0, way=1.0):
    """Return the shortest duration."""
    return LAB.quintic_duration(way * (GOAL - READY), v * LAB.V_MAX, a * LAB.A_MAX)


@numbers.add(
    "shortest duration for joint 2 alone", "{:.3f} s",
    v=between(0.9, 0.99, "its acceleration limit then determines it, 0.914 s"),
    a=same("its velocity limit determines it"),
    way=times(2.0, "twice the distance at the same velocity"),
)  # fmt: skip
def joint2(v=1.0, a=1.0, way=1.0):
    """Return joint 2's shortest duration."""
    dq = way * np.diag(GOAL - READY)[1]
    return LAB.quintic_duration(dq, v * LAB.V_MAX, a * LAB.A_MAX)


@cache
def profile(name, way=1.0, longer=1.0, omega=LAB.OMEGA, rate=LAB.RATE, v=1.0, a=1.0):
    """Return how one of the five time scalings is tracked, and its duration."""
    goal = READY + way * (GOAL - READY)
    limits = {"V_MAX": v * LAB.V_MAX, "A_MAX": a * LAB.A_MAX}
    with turned(LAB, GOAL_Q=goal, **limits):
        T = longer * LAB.quintic_duration(goal - READY, LAB.V_MAX, LAB.A_MAX)
        scaling, seconds = LAB.profiles(T)[name]
        return DAY.follow(scaling, seconds, READY, goal, omega, rate), seconds


@numbers.add(
    "the quintic's largest jerk", "{:.0f} rad/s³",
    rate=between(0.9, 1.1, "the polynomial determines it, not the control rate"),
    duration=between(0.1, 0.16, "the jerk is proportional to 1 / T³, so an eighth"),
    omega=between(0.9, 1.1, "the arm tracks the polynomial with either value"),
)  # fmt: skip
def jerk(rate=LAB.RATE, duration=1.0, omega=LAB.OMEGA):
    """Return it."""
    return profile("quintic", 1.0, duration, omega, rate)[0].jerk


@numbers.add(
    "the trapezoid's largest jerk", "{:.0f} rad/s³",
    rate=times(2.0, "the acceleration changes within one period, which is half as long",
               within=0.15),
    a=between(1.6, 2.2, "the discontinuity is twice as large"),
    omega=between(1.0, 1.3, "a stiffer arm responds more to the discontinuity"),
)  # fmt: skip
def corner(rate=LAB.RATE, a=1.0, omega=LAB.OMEGA):
    """Return it."""
    return profile("trapezoid", omega=omega, rate=rate, a=a)[0].jerk


@numbers.add(
    "the trapezoid's duration", "{:.3f} s",
    v=between(0.6, 0.95, "the acceleration in the ramps stays the same"),
    a=between(0.8, 0.95, "the highest velocity stays the same"),
)  # fmt: skip
def trapezoid(v=1.0, a=1.0):
    """Return it."""
    dq = np.abs(GOAL - READY)
    speed = np.min(v * LAB.V_MAX / dq)
    acceleration = np.min(a * LAB.A_MAX / dq)
    top = min(speed, np.sqrt(acceleration))
    return 1 / top + top / acceleration


@numbers.add(
    "largest joint error, quintic", "{:.2f} mrad",
    omega=between(0.4, 0.6, "each simulation step adds an error of ½ `qdd` dt² to q (dt: "
                  "time step); under feedback the error settles at a value "
                  "proportional to 1 / omega"),
    duration=between(0.15, 0.4, "a quarter of the acceleration"),
    rate=between(0.7, 1.1, "the time step of the simulator, which stays the same, "
                 "contributes most"),
)  # fmt: skip
def quintic_off(omega=LAB.OMEGA, duration=1.0, rate=LAB.RATE):
    """Return it."""
    return profile("quintic", 1.0, duration, omega, rate)[0].mrad


@numbers.add(
    "largest joint error, constant speed", "{:.2f} mrad",
    omega=between(0.9, 1.0, "the torque reaches its limit; without the limit the error "
                  "would be halved"),
    duration=between(0.4, 0.6, "the discontinuity of the velocity is half as large"),
    rate=between(0.9, 1.1, "the reference itself is discontinuous"),
)  # fmt: skip
def jump_off(omega=LAB.OMEGA, duration=1.0, rate=LAB.RATE):
    """Return it."""
    return profile("constant speed", 1.0, duration, omega, rate)[0].mrad


def lifted(grip, mu, lift, gravity):
    """Return the heaviest cube, kg."""
    with turned(LAB, GRAVITY=gravity * LAB.GRAVITY):
        return LAB.max_cube_mass(grip, mu, lift)


@numbers.add(
    "heaviest cube at rest", "{:.3f} kg",
    grip=times(2.0, "friction is at most mu times the normal force"),
    mu=times(2.0, "friction is at most mu times the normal force"),
    gravity=times(0.5, "friction balances a weight, not a mass"),
)  # fmt: skip
def at_rest(grip=0.9247, mu=1.0, gravity=1.0):
    """Return it."""
    return lifted(grip, mu, 0.0, gravity)


@numbers.add(
    "heaviest cube while the lift accelerates", "{:.3f} kg",
    grip=times(2.0, "friction is at most mu times the normal force"),
    lift=times((9.81 + LIFT) / (9.81 + 2 * LIFT),
               "each kilogram needs a force of g + a newtons"),
    gravity=times((9.81 + LIFT) / (19.62 + LIFT),
                  "each kilogram needs a force of g + a newtons"),
)  # fmt: skip
def lifting(grip=0.9247, lift=LIFT, gravity=1.0):
    """Return it."""
    return lifted(grip, 1.0, lift, gravity)
