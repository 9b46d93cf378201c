"""The sensitivity of Day 3's numbers: each constant doubled, measured and explained.

The errors of the plain pseudo-inverse out of reach are not among the numbers, because
they depend on the step, as the guide explains.
"""

from functools import cache

import numpy as np

from labkit.lesson.constants import Numbers, altered, between, same, times
from labkit.lesson.lab_module import complete_lab
from robo47 import panda, verify
from robo47.screws import fk_space

LAB = complete_lab(3)
DAY = LAB.day3_mujoco
READY = LAB.READY_Q
MODEL = panda.load("panda_nohand")

numbers = Numbers(
    LAB, DAY,
    metre="the unit of length, all lengths of the arm: × {}",
    units="units of length in a metre: {}",
    force="the hand pushes with {} N",
    base="angle of joint 1: {} rad",
    SEED="SEED: {}",
    n="configurations: {}",
    targets="FAR, targets: {}",
    limits="joint limits: {} times as wide",
    DAMPING="DAMPING: {}",
    GAIN="GAIN: {} 1/s",
    DT="DT: {} s",
    LAP="LAP: {} s",
    RADIUS="radius: {} m",
)


@cache
def arm(metre=1.0):
    """Return screws and home pose, of an arm whose lengths are scaled by `metre`."""
    model = altered(panda.load("panda_nohand"), metre)
    return panda.screws(model), panda.home_pose(model)


def site(q, metre=1.0):
    """Return J_site at q."""
    screws, M = arm(metre)
    p = fk_space(screws, M, q)[:3, 3]
    return LAB.site_jacobian(LAB.space_jacobian(screws, q), p)


@numbers.add("joint 2's torque, pushing down with 10 N", "{:.2f} N m",
    force=times(2.0, "the torque is the force times the lever arm"),
    metre=times(2.0, "the torque is the force times the lever arm"),
    base=same("joint 1 rotates the hand and the axis of joint 2 together", to=1.0))
def pushing(force=10.0, metre=1.0, base=0.0):
    q = READY + base * np.eye(7)[0]
    screws, M = arm(metre)
    p = fk_space(screws, M, q)[:3, 3]
    J = LAB.space_jacobian(screws, q)
    return LAB.joint_torques(J, p, force / 10 * LAB.DOWN)[1]


@numbers.add("manipulability in millimetres, divided by manipulability in metres", "{:.0e}",
    units=times(8.0, "three rows of J scale with the unit, so the product scales with its cube", to=2000.0),
    SEED=same("the ratio is the same in every configuration", to=48))
def scaled(units=1000.0):
    J = site(verify.random_q(MODEL, 1, LAB.SEED)[0])
    rows = np.repeat([1.0, units], 3)[:, None]
    return LAB.manipulability(rows * J) / LAB.manipulability(J)


@numbers.add("pairs of configurations whose smallest singular values change their order", "{:.0f} %",
    units=between(1.02, 1.5, "the lengths gain more weight relative to the radians", to=20.0),
    SEED=between(0.8, 1.25, "another seed gives other configurations", to=48),
    n=between(0.8, 1.25, "the sample contains more configurations"))
def swapped(units=10.0, n=300):
    J = np.array([site(q) for q in verify.random_q(MODEL, n, LAB.SEED)])
    rows = np.repeat([1.0, units], 3)[:, None]
    least = [np.linalg.svd(x, compute_uv=False)[:, -1] for x in (J, rows * J)]
    i, j = np.triu_indices(n, 1)
    before, after = (np.sign(x[i] - x[j]) for x in least)
    return 100 * np.mean(before != after)


@numbers.add("far targets that are reached from ready, of 20", "{:.0f}",
    SEED=between(0.7, 1.4, "another seed gives other targets", to=48),
    limits=between(1.0, 1.5, "many local minima are at a joint limit"))
def from_ready(limits=1.0):
    goals = fk_space(*arm(), verify.random_q(MODEL, LAB.TRIALS, LAB.SEED)[: LAB.FAR])
    wide = MODEL.jnt_range.mean(axis=1, keepdims=True)
    wide = wide + limits * (MODEL.jnt_range - wide)
    found = [LAB.solve_ik(*arm(), T, READY, wide) for T in goals]
    return np.sum(DAY.miss(arm(), np.array(found), goals) < 1e-6)


@numbers.cached
def drawn(radius, damping):
    """Return the result of draw_circle: errors in mm, joint speeds, angles."""
    seconds = np.arange(0.0, DAY.LAP, LAB.DT)
    path, q = DAY.circle(arm(), MODEL.jnt_range, radius, seconds)
    return LAB.draw_circle(arm(), path, q, damping)


@numbers.add("largest error on the larger circle, with damping", "{:.2f} mm",
    DAMPING=between(1.1, 2.5, "the largest error is now at the bottom, which is in reach"),
    GAIN=between(0.9, 1.1, "a higher gain reduces only the lag, not the distance between the workspace and a target out of reach"),
    DT=between(0.95, 1.05, "the damping and the geometry cause the error, not the step"),
    LAP=between(0.85, 1.0, "the hand lags less, and the part out of reach does not change"),
    RADIUS=between(0.2, 0.5, "the whole circle is in reach", to=0.36))
def off():
    return drawn(LAB.RADIUS, LAB.DAMPING)[0].max()


@numbers.add("largest error at the bottom of this circle, with damping", "{:.1f} mm",
    DAMPING=between(2.0, 4.5, "the error grows with the square of the damping, by a factor of up to four"),
    GAIN=between(0.4, 0.9, "an error is corrected twice as fast"),
    DT=between(0.9, 1.1, "the error is caused by the damping, not by the step"))
def bottom():
    off = drawn(LAB.RADIUS, LAB.DAMPING)[0]
    return off[len(off) // 2 :].max()


@numbers.add("fastest joint on this circle, as a fraction of its limit", "{:.4f}",
    LAP=between(0.4, 0.7, "the hand moves at half the speed"),
    DAMPING=between(0.5, 1.0, "damping makes the steps shorter"),
    DT=between(0.95, 1.05, "a step is twice as long and takes twice the time"))
def fastest():
    speeds = drawn(LAB.RADIUS, LAB.DAMPING)[1]
    return (speeds / LAB.SPEED).max()


@numbers.add("largest error on the smaller circle, without damping", "{:.1f} mm",
    DT=between(1.7, 4.5, "a step follows the tangent, and the circle curves away from it"),
    GAIN=between(0.4, 0.7, "an error is corrected twice as fast"),
    LAP=between(0.2, 0.6, "each step is half as long"))
def plain():
    return drawn(LAB.EASY, 0.0)[0].max()


@numbers.add("largest error on the smaller circle, with damping", "{:.1f} mm",
    DAMPING=between(2.0, 4.5, "the error grows with the square of the damping, by a factor of up to four"),
    DT=between(0.9, 1.1, "the error is caused by the damping, not by the step"),
    GAIN=between(0.4, 0.9, "an error is corrected twice as fast"))
def damped():
    return drawn(LAB.EASY, LAB.DAMPING)[0].max()
