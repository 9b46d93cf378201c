"""The sensitivity of Day 3's numbers: each constant doubled, measured and explained.

The errors of the plain pseudo-inverse out of reach are not among the numbers, because
they depend on the step, as the guide explains.
"""

from functools import cache

import numpy as np

from labkit.lesson.constants import Numbers, between, same, times, turned
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47 import panda, verify
from robo47.screws import fk_space

LAB = lab_of(find_day(3))
DAY = LAB.day3_mujoco
READY = LAB.READY_Q
MODEL = panda.load("panda_nohand")

numbers = Numbers(
    metre="the unit of length, all lengths of the arm: × {}",
    units="units of length in a metre: {}",
    force="the hand pushes with {} N",
    base="angle of joint 1: {} rad",
    seed="SEED: {}",
    n="configurations: {}",
    targets="FAR, targets: {}",
    limits="joint limits: {} times as wide",
    damping="DAMPING: {}",
    gain="GAIN: {} 1/s",
    dt="DT: {} s",
    lap="LAP: {} s",
    radius="radius: {} m",
)


@cache
def arm(metre=1.0):
    """Return screws and home pose, of an arm whose lengths are scaled by `metre`."""
    model = panda.load("panda_nohand")
    model.body_pos[:] *= metre
    model.site_pos[:] *= metre
    return panda.screws(model), panda.home_pose(model)


def site(q, metre=1.0):
    """Return J_site at q."""
    screws, M = arm(metre)
    p = fk_space(screws, M, q)[:3, 3]
    return LAB.site_jacobian(LAB.space_jacobian(screws, q), p)


@numbers.add(
    "joint 2's torque, pushing down with 10 N", "{:.2f} N m",
    force=times(2.0, "the torque is the force times the lever arm"),
    metre=times(2.0, "the torque is the force times the lever arm"),
    base=same("joint 1 rotates the hand and the axis of joint 2 together", to=1.0),
)  # fmt: skip
def pushing(force=10.0, metre=1.0, base=0.0):
    """Return it."""
    q = READY + base * np.eye(7)[0]
    screws, M = arm(metre)
    p = fk_space(screws, M, q)[:3, 3]
    J = LAB.space_jacobian(screws, q)
    return LAB.joint_torques(J, p, force / 10 * LAB.DOWN)[1]


@numbers.add(
    "manipulability in millimetres, divided by manipulability in metres", "{:.0e}",
    units=times(8.0, "three rows of J scale with the unit, so the product scales with its cube", to=2000.0),
    seed=same("the ratio is the same in every configuration", to=48),
)  # fmt: skip
def scaled(units=1000.0, seed=LAB.SEED):
    """Return the ratio at a random configuration."""
    J = site(verify.random_q(MODEL, 1, seed)[0])
    rows = np.repeat([1.0, units], 3)[:, None]
    return LAB.manipulability(rows * J) / LAB.manipulability(J)


@numbers.add(
    "pairs of configurations whose smallest singular values change their order", "{:.0f} %",
    units=between(1.02, 1.5, "the lengths gain more weight relative to the radians", to=20.0),
    seed=between(0.8, 1.25, "another seed gives other configurations", to=48),
    n=between(0.8, 1.25, "the sample contains more configurations"),
)  # fmt: skip
def swapped(units=10.0, seed=LAB.SEED, n=300):
    """Return how many of all pairs of configurations."""
    J = np.array([site(q) for q in verify.random_q(MODEL, n, seed)])
    rows = np.repeat([1.0, units], 3)[:, None]
    least = [np.linalg.svd(x, compute_uv=False)[:, -1] for x in (J, rows * J)]
    i, j = np.triu_indices(n, 1)
    before, after = (np.sign(x[i] - x[j]) for x in least)
    return 100 * np.mean(before != after)


@numbers.add(
    "far targets that are reached from ready, of 20", "{:.0f}",
    seed=between(0.7, 1.4, "another seed gives other targets", to=48),
    limits=between(1.0, 1.5, "many local minima are at a joint limit"),
)  # fmt: skip
def from_ready(seed=LAB.SEED, limits=1.0):
    """Return how many."""
    goals = fk_space(*arm(), verify.random_q(MODEL, LAB.TRIALS, seed)[: LAB.FAR])
    wide = MODEL.jnt_range.mean(axis=1, keepdims=True)
    wide = wide + limits * (MODEL.jnt_range - wide)
    found = [LAB.solve_ik(*arm(), T, READY, wide) for T in goals]
    return np.sum(DAY.miss(arm(), np.array(found), goals) < 1e-6)


@cache
def drawn(radius, damping, gain, dt, lap, metre=1.0):
    """Return the result of draw_circle: errors in mm, joint speeds, angles."""
    with turned(DAY, LAP=lap):
        times_ = np.arange(0.0, lap, dt)
        path, q = DAY.circle(arm(metre), MODEL.jnt_range, radius, times_)
    with turned(LAB, DT=dt, GAIN=gain):
        return LAB.draw_circle(arm(metre), path, q, damping)


@numbers.add(
    "largest error on the larger circle, with damping", "{:.2f} mm",
    damping=between(1.1, 2.5, "the largest error is now at the bottom, which is in reach"),
    gain=between(0.9, 1.1, "a higher gain reduces only the lag, not the distance between the workspace and a target out of reach"),
    dt=between(0.95, 1.05, "the damping and the geometry cause the error, not the step"),
    lap=between(0.85, 1.0, "the hand lags less, and the part out of reach does not change"),
    radius=between(0.2, 0.5, "the whole circle is in reach", to=0.36),
)  # fmt: skip
def off(damping=LAB.DAMPING, gain=LAB.GAIN, dt=LAB.DT, lap=DAY.LAP, radius=LAB.RADIUS):
    """Return the worst."""
    return drawn(radius, damping, gain, dt, lap)[0].max()


@numbers.add(
    "largest error at the bottom of this circle, with damping", "{:.1f} mm",
    damping=between(2.0, 4.5, "the error grows with the square of the damping, by a factor of up to four"),
    gain=between(0.4, 0.9, "an error is corrected twice as fast"),
    dt=between(0.9, 1.1, "the error is caused by the damping, not by the step"),
)  # fmt: skip
def bottom(damping=LAB.DAMPING, gain=LAB.GAIN, dt=LAB.DT):
    """Return the worst of the second half, all of it in reach."""
    off = drawn(LAB.RADIUS, damping, gain, dt, DAY.LAP)[0]
    return off[len(off) // 2 :].max()


@numbers.add(
    "fastest joint on this circle, as a fraction of its limit", "{:.4f}",
    lap=between(0.4, 0.7, "the hand moves at half the speed"),
    damping=between(0.5, 1.0, "damping makes the steps shorter"),
    dt=between(0.95, 1.05, "a step is twice as long and takes twice the time"),
)  # fmt: skip
def fastest(lap=DAY.LAP, damping=LAB.DAMPING, dt=LAB.DT):
    """Return the largest fraction of a joint's speed limit."""
    speeds = drawn(LAB.RADIUS, damping, LAB.GAIN, dt, lap)[1]
    return (speeds / LAB.SPEED).max()


@numbers.add(
    "largest error on the smaller circle, without damping", "{:.1f} mm",
    dt=between(1.7, 4.5, "a step follows the tangent, and the circle curves away from it"),
    gain=between(0.4, 0.7, "an error is corrected twice as fast"),
    lap=between(0.2, 0.6, "each step is half as long"),
)  # fmt: skip
def plain(dt=LAB.DT, gain=LAB.GAIN, lap=DAY.LAP):
    """Return the worst."""
    return drawn(LAB.EASY, 0.0, gain, dt, lap)[0].max()


@numbers.add(
    "largest error on the smaller circle, with damping", "{:.1f} mm",
    damping=between(2.0, 4.5, "the error grows with the square of the damping, by a factor of up to four"),
    dt=between(0.9, 1.1, "the error is caused by the damping, not by the step"),
    gain=between(0.4, 0.9, "an error is corrected twice as fast"),
)  # fmt: skip
def damped(damping=LAB.DAMPING, dt=LAB.DT, gain=LAB.GAIN):
    """Return the worst."""
    return drawn(LAB.EASY, damping, gain, dt, DAY.LAP)[0].max()
