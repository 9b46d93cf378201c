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
    way="the way from ready to GOAL_Q: × {}",
    v="V_MAX: × {}",
    a="A_MAX: × {}",
    duration="the move takes {} times as long",
    omega="OMEGA: {} rad/s",
    rate="RATE: {} Hz",
    grip="a finger presses with {} N",
    mu="friction mu: {}",
    lift="the lift speeds up with {} m/s²",
    gravity="gravity: × {}",
)


@numbers.add(
    "seconds that the move takes", "{:.4f} s",
    v=between(0.7, 0.95, "joint 2 is then the slowest, by its acceleration"),
    a=same("joint 7 is the slowest, by its speed"),
    way=times(2.0, "twice the distance at the same speed"),
)  # fmt: skip
def duration(v=1.0, a=1.0, way=1.0):
    """Return the shortest duration."""
    return LAB.quintic_duration(way * (GOAL - READY), v * LAB.V_MAX, a * LAB.A_MAX)


@numbers.add(
    "seconds that joint 2 needs alone", "{:.3f} s",
    v=between(0.9, 0.99, "then its acceleration decides, 0.914 s"),
    a=same("its speed decides"),
    way=times(2.0, "twice the distance at the same speed"),
)  # fmt: skip
def joint2(v=1.0, a=1.0, way=1.0):
    """Return joint 2's shortest duration."""
    dq = way * np.diag(GOAL - READY)[1]
    return LAB.quintic_duration(dq, v * LAB.V_MAX, a * LAB.A_MAX)


@cache
def profile(name, way=1.0, longer=1.0, omega=LAB.OMEGA, rate=LAB.RATE, v=1.0, a=1.0):
    """Return how one of the five profiles is followed, and how long it takes."""
    goal = READY + way * (GOAL - READY)
    limits = {"V_MAX": v * LAB.V_MAX, "A_MAX": a * LAB.A_MAX}
    with turned(LAB, GOAL_Q=goal, **limits):
        T = longer * LAB.quintic_duration(goal - READY, LAB.V_MAX, LAB.A_MAX)
        scaling, seconds = LAB.profiles(T)[name]
        return DAY.follow(scaling, seconds, READY, goal, omega, rate), seconds


@numbers.add(
    "the quintic's largest jerk", "{:.0f} rad/s³",
    rate=between(0.9, 1.1, "the curve determines it, not the control rate"),
    duration=between(0.1, 0.16, "jerk is distance over time cubed, so an eighth"),
    omega=between(0.9, 1.1, "the arm follows the curve with either"),
)  # fmt: skip
def jerk(rate=LAB.RATE, duration=1.0, omega=LAB.OMEGA):
    """Return it."""
    return profile("quintic", 1.0, duration, omega, rate)[0].jerk


@numbers.add(
    "the trapezoid's largest jerk", "{:.0f} rad/s³",
    rate=times(2.0, "a discontinuity has no finite jerk; it takes one period",
               within=0.15),
    a=between(1.6, 2.2, "the discontinuity is twice as large"),
    omega=between(1.0, 1.3, "a stiffer arm responds more to the discontinuity"),
)  # fmt: skip
def corner(rate=LAB.RATE, a=1.0, omega=LAB.OMEGA):
    """Return it."""
    return profile("trapezoid", omega=omega, rate=rate, a=a)[0].jerk


@numbers.add(
    "the trapezoid's duration", "{:.3f} s",
    v=between(0.6, 0.95, "the ramps keep their acceleration"),
    a=between(0.8, 0.95, "the top speed stays the same"),
)  # fmt: skip
def trapezoid(v=1.0, a=1.0):
    """Return it."""
    dq = np.abs(GOAL - READY)
    speed = np.min(v * LAB.V_MAX / dq)
    acceleration = np.min(a * LAB.A_MAX / dq)
    top = min(speed, np.sqrt(acceleration))
    return 1 / top + top / acceleration


@numbers.add(
    "the quintic is followed within", "{:.2f} mrad",
    omega=between(0.4, 0.6, "the disturbance is the same, and kd is twice as large"),
    duration=between(0.15, 0.4, "half the speed, a quarter of the acceleration"),
    rate=between(0.7, 1.1, "the held torque and the simulator's step contribute"),
)  # fmt: skip
def quintic_off(omega=LAB.OMEGA, duration=1.0, rate=LAB.RATE):
    """Return it."""
    return profile("quintic", 1.0, duration, omega, rate)[0].mrad


@numbers.add(
    "constant speed is followed within", "{:.2f} mrad",
    omega=between(0.9, 1.0, "half the error would need more torque than the limit"),
    duration=between(0.4, 0.6, "the discontinuity is half as large"),
    rate=between(0.9, 1.1, "the discontinuity is in the reference"),
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
    grip=times(2.0, "friction is mu times the normal force"),
    mu=times(2.0, "friction is mu times the normal force"),
    gravity=times(0.5, "friction balances a weight, not a mass"),
)  # fmt: skip
def at_rest(grip=0.9247, mu=1.0, gravity=1.0):
    """Return it."""
    return lifted(grip, mu, 0.0, gravity)


@numbers.add(
    "heaviest cube while the lift speeds up", "{:.3f} kg",
    grip=times(2.0, "friction is mu times the normal force"),
    lift=times((9.81 + LIFT) / (9.81 + 2 * LIFT), "a kilogram needs the force g + a"),
    gravity=times((9.81 + LIFT) / (19.62 + LIFT), "a kilogram needs the force g + a"),
)  # fmt: skip
def lifting(grip=0.9247, lift=LIFT, gravity=1.0):
    """Return it."""
    return lifted(grip, 1.0, lift, gravity)
