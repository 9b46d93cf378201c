"""The sensitivity of Day 12's numbers: each constant doubled, measured and explained.

The lab's own functions and the library's `time_optimal_profile` compute everything.
"""

import numpy as np

from labkit.lesson.constants import Numbers, between, same, times
from labkit.lesson.lab_module import complete_lab
from robo47 import panda, simulate
from robo47 import planning as library

LAB = complete_lab(12)
DAY = LAB.day12_mujoco
ARM = panda.arm(DAY.Wall().model)
INVERSE = DAY.torque(DAY.Wall().model)  # without damping
_, LIMITS = simulate.limits(DAY.Wall().model)

numbers = Numbers(
    LAB, DAY,
    SEEDS="SEEDS, all of which find a path: {}",
    z="z of the interval: {}",
    inertia="M: {} kg m²",
    limit="limit: {} N m",
    way="the displacement: {} rad",
    gravity="the gravity torque: {} N m",
    POINTS="POINTS: {}",
    share="fraction of the torque: {}",
    speed="the velocity limits: × {}",
    weight="gravity: × {}",
    STEP="STEP: {} rad",
    ROOF="ROOF: {} m",
    MARGIN="MARGIN: {} m",
    first="the first of 60 seeds: {}",
    samples="samples: {}",
)


@numbers.add("lower bound for 60 of 60 trials", "{:.3f}",
    SEEDS=times(1.0309, "n / (n + z²): 120 / 123.84 instead of 60 / 63.84", to=120),
    z=between(0.7, 0.9, "the interval is wider: n / (n + 4 z²)"))
def least_share(z=1.96):
    n = LAB.SEEDS
    return LAB.wilson_interval(n, n)[0] if z == 1.96 else n / (n + z**2)


def alone(inertia=2.0, limit=8.0, way=1.0, gravity=0.0, points=LAB.POINTS):
    """Return the travel time of one joint, s."""
    one = np.ones((points + 1, 1))
    x = library.time_optimal_profile(
        inertia * way * one, 0.0 * one, gravity * one, [limit], 1e3 * one[:, 0]
    )
    return LAB.seconds(x)


@numbers.add("one joint over 1 rad", "{:.3f} s",
    inertia=times(2**0.5, "2 √(d M / limit)"),
    limit=times(0.5**0.5, "2 √(d M / limit)"),
    way=times(2**0.5, "2 √(d M / limit)"),
    POINTS=same("exact for an even number of steps: the acceleration then changes at a point of the path"))
def one_joint(inertia=2.0, limit=8.0, way=1.0):
    return alone(inertia, limit, way, 0.0, LAB.POINTS)


@numbers.add("one joint against gravity 4", "{:.3f} s",
    inertia=times(2**0.5, "both accelerations are half as large"),
    limit=times(0.6325, "accelerations 6 and 10 instead of 2 and 6: √(2/6 + 2/10) instead of √(2/2 + 2/6)"),
    way=times(2**0.5, "twice the displacement with the same accelerations"),
    gravity=times(1.309, "accelerations 1 and 7 instead of 2 and 6", to=6.0))
def heavy_joint(inertia=2.0, limit=8.0, way=1.0, gravity=4.0):
    return alone(inertia, limit, way, gravity)


@numbers.add("Day 7's motion with half of the torque", "{:.3f} s",
    share=between(0.8, 0.85, "more torque, but the velocity limits are the same"),
    speed=between(0.75, 0.95, "the velocity is at its limit at 71 % of the points"),
    weight=between(0.8, 0.9, "without gravity all of the torque accelerates the arm", to=0.0),
    POINTS=between(0.99, 1.01, "with shorter steps the path acceleration changes at slightly different points"))
def with_half(share=0.5, speed=1.0, weight=1.0):
    A, B, G, most = LAB.along(ARM, panda.READY_Q, LAB.TO, LAB.POINTS)
    x = library.time_optimal_profile(A, B, weight * G, share * LIMITS, speed**2 * most)
    return LAB.seconds(x)


@numbers.add("torque above its limit at the end of a step", "{:.1%}",
    POINTS=times(0.5, "the bounds change half as much in half a step"),
    share=between(0.8, 2.0, "the motion is slower, but the excess is of similar size", to=0.5))
def above(share=1.0):
    path = LAB.along(ARM, panda.READY_Q, LAB.TO, LAB.POINTS)
    most = share * LIMITS
    x = library.time_optimal_profile(*path[:3], most, path[3])
    at = LAB.torque_share(INVERSE, most, panda.READY_Q, LAB.TO, x, (0.5, 1.0))
    return at - 1.0


@numbers.add("paths over the wall, of 60, with 40 samples", "{:.0f}",
    STEP=between(1.3, 1.8, "a tree progresses further with each sample"),
    ROOF=between(1.4, 2.0, "the passage is wider", to=1.0),
    MARGIN=between(0.6, 1.0, "the passage is narrower"),
    first=between(0.7, 1.4, "other samples: with a probability of 95 % the second count lies between about 18 and 40", to=60),
    samples=between(1.5, 2.0, "twice as many samples"))
def found(first=0, samples=40):
    wall = DAY.Wall(roof=DAY.ROOF)
    count = 0
    for seed in range(first, first + 60):
        drawn = DAY.samples(wall.model, LAB.COUNTS[-1], seed)[:samples]
        count += len(LAB.rrt_connect(DAY.START, DAY.GOAL, wall, drawn, LAB.STEP)) > 0
    return count
