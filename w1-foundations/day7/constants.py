"""Sensitivity of Day 7's numbers: each constant is doubled, measured and explained.

The pick's own numbers (0.92 mm, 0.64 mrad) are not among them: they depend on contacts,
which differ between versions of MuJoCo; the guide gives them wide limits instead.
"""

import numpy as np

from labkit.lesson.constants import Numbers, between, same, times
from labkit.lesson.lab_module import complete_lab

LAB = complete_lab(7)
DAY = LAB.day7_mujoco
READY, GOAL = LAB.READY_Q, LAB.GOAL_Q
LIFT = 1.232  # m/s², of the guide

numbers = Numbers(
    LAB, DAY,
    way="distance from ready to GOAL_Q: × {}",
    V_MAX="V_MAX: × {}",
    A_MAX="A_MAX: × {}",
    duration="duration of the motion: × {}",
    OMEGA="OMEGA: {} rad/s",
    RATE="RATE: {} Hz",
    grip="normal force of a finger: {} N",
    mu="friction coefficient mu: {}",
    lift="acceleration of the lift: {} m/s²",
    GRAVITY="gravity: × {}",
)


@numbers.add("shortest duration of the motion", "{:.4f} s",
    V_MAX=between(0.7, 0.95, "the acceleration limit of joint 2 then determines it"),
    A_MAX=same("the velocity limit of joint 7 determines it"),
    way=times(2.0, "twice the distance at the same velocity"))
def duration(way=1.0):
    return LAB.quintic_duration(way * (GOAL - READY), LAB.V_MAX, LAB.A_MAX)


@numbers.add("shortest duration for joint 2 alone", "{:.3f} s",
    V_MAX=between(0.9, 0.99, "its acceleration limit then determines it, 0.914 s"),
    A_MAX=same("its velocity limit determines it"),
    way=times(2.0, "twice the distance at the same velocity"))
def joint2(way=1.0):
    return LAB.quintic_duration(way * np.diag(GOAL - READY)[1], LAB.V_MAX, LAB.A_MAX)


@numbers.cached
def profile(name, longer=1.0):
    """Return how one of the five time scalings is tracked."""
    T = longer * LAB.quintic_duration(GOAL - READY, LAB.V_MAX, LAB.A_MAX)
    scaling, seconds = LAB.profiles(T)[name]
    return DAY.follow(scaling, seconds, READY, GOAL, LAB.OMEGA, LAB.RATE)


@numbers.add("the quintic's largest jerk", "{:.0f} rad/s³",
    RATE=between(0.9, 1.1, "the polynomial determines it, not the control rate"),
    duration=between(0.1, 0.16, "the jerk is proportional to 1 / T³, so an eighth"),
    OMEGA=between(0.9, 1.1, "the arm tracks the polynomial with either value"))
def jerk(duration=1.0):
    return profile("quintic", duration).jerk


@numbers.add("the trapezoid's largest jerk", "{:.0f} rad/s³",
    RATE=times(2.0, "the acceleration changes within one period, which is half as long", within=0.15),
    A_MAX=between(1.6, 2.2, "the discontinuity is twice as large"),
    OMEGA=between(1.0, 1.3, "a stiffer arm responds more to the discontinuity"))
def corner():
    return profile("trapezoid").jerk


@numbers.add("the trapezoid's duration", "{:.3f} s",
    V_MAX=between(0.6, 0.95, "the acceleration in the ramps stays the same"),
    A_MAX=between(0.8, 0.95, "the highest velocity stays the same"))
def trapezoid():
    dq = np.abs(GOAL - READY)
    speed, acceleration = np.min(LAB.V_MAX / dq), np.min(LAB.A_MAX / dq)
    top = min(speed, np.sqrt(acceleration))
    return 1 / top + top / acceleration


@numbers.add("largest joint error, quintic", "{:.2f} mrad",
    OMEGA=between(0.4, 0.6, "each simulation step adds an error of ½ `qdd` dt² to q (dt: time step); under feedback the error settles at a value proportional to 1 / omega"),
    duration=between(0.15, 0.4, "a quarter of the acceleration"),
    RATE=between(0.7, 1.1, "the time step of the simulator, which stays the same, contributes most"))
def quintic_off(duration=1.0):
    return profile("quintic", duration).mrad


@numbers.add("largest joint error, constant speed", "{:.2f} mrad",
    OMEGA=between(0.9, 1.0, "the torque reaches its limit; without the limit the error would be halved"),
    duration=between(0.4, 0.6, "the discontinuity of the velocity is half as large"),
    RATE=between(0.9, 1.1, "the reference itself is discontinuous"))
def jump_off(duration=1.0):
    return profile("constant speed", duration).mrad


@numbers.add("heaviest cube at rest", "{:.3f} kg",
    grip=times(2.0, "friction is at most mu times the normal force"),
    mu=times(2.0, "friction is at most mu times the normal force"),
    GRAVITY=times(0.5, "friction balances a weight, not a mass"))
def at_rest(grip=0.9247, mu=1.0):
    return LAB.max_cube_mass(grip, mu, 0.0)


@numbers.add("heaviest cube while the lift accelerates", "{:.3f} kg",
    grip=times(2.0, "friction is at most mu times the normal force"),
    lift=times((9.81 + LIFT) / (9.81 + 2 * LIFT), "each kilogram needs a force of g + a newtons"),
    GRAVITY=times((9.81 + LIFT) / (19.62 + LIFT), "each kilogram needs a force of g + a newtons"))
def lifting(grip=0.9247, lift=LIFT):
    return LAB.max_cube_mass(grip, 1.0, lift)
