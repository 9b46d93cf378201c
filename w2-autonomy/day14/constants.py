"""The sensitivity of Day 14's numbers: each constant doubled, measured, explained."""

import numpy as np

from labkit.lesson.constants import Numbers, between, same, times, turned
from labkit.lesson.lab_module import complete_lab

LAB = complete_lab(14)
DAY = LAB.day14_mujoco

numbers = Numbers(
    LAB, DAY,
    mu="friction: {}",
    squeeze="grip force: {} N per pad",
    SLOW="SLOW, the duration of the lift: {} s",
    TARGET="height of the lift: {} m",
    TICK="steps of the simulation in 10 ms: {}",
    soft="time constant of the contacts: × {}",
    size="distance of the contacts: × {}",
    EDGES="edges of each friction cone: {}",
    within="half-width of the interval: {}",
    TESTED="cubes: {}",
    CUBES_SEED="seed of the cubes: {}",
)


@numbers.add("heaviest cube, mu 0.3, 2 N per pad", "{:.0f} g",
    mu=times(2.0, "m = 2 mu F / g"),
    squeeze=times(2.0, "m = 2 mu F / g"),
    SLOW=between(1.0, 1.02, "2 mu F / (g + 6 h / T²): the acceleration is a quarter"),
    TARGET=between(0.96, 1.0, "2 mu F / (g + 6 h / T²): the acceleration doubles"),
    TICK=between(0.99, 1.01, "shorter steps change the mass by only 1 g"),
    soft=between(0.99, 1.01, "the mass depends on the friction, not on the stiffness of the contacts"))
def heaviest(mu=0.3, squeeze=2.0, soft=1.0):
    with turned(DAY, STEP=0.01 / DAY.TICK, GRIP_TIME=soft * DAY.GRIP_TIME):
        return LAB.heaviest(*DAY.hand(), mu, squeeze)


@numbers.add("rank of two opposite contacts", "{:.0f}",
    mu=same("friction at a point has no moment about the line through both contacts"),
    size=same("contacts that are further apart produce no such moment either"),
    EDGES=same("more edges of the same cones span the same five dimensions"))
def rank_of_two(mu=0.5, size=1.0):
    places = size * np.array(LAB.GRASPS["two, opposite"])
    with turned(LAB, GRASPS={"two": places}):
        return np.linalg.matrix_rank(LAB.wrenches("two", mu))


@numbers.add("cubes for a rate of 0.5 to within 0.05", "{:.0f}",
    within=between(0.24, 0.26, "n = 1.96² / 4 / 0.05² - 1.96²"))
def needed(within=0.05):
    return LAB.needed(within)


@numbers.add("lower endpoint of the interval, 60 of 60 held", "{:.3f}",
    TESTED=between(1.02, 1.04, "n / (n + 1.96²): the distance to 1 halves"))
def low_end():
    return LAB.success_rate(np.ones(LAB.TESTED, bool))[1]


@numbers.add("slippery cubes that are too heavy on paper", "{:.0f} of 60",
    squeeze=between(0.3, 0.5, "twice the grip force holds twice the mass"),
    mu=between(0.3, 0.5, "twice the friction holds twice the mass"),
    CUBES_SEED=between(0.75, 1.3, "other cubes of the same distribution", to=14))
def dropped(squeeze=1.6, mu=1.0):
    cubes, _ = LAB.unseen(LAB.SLIPPERY)
    return sum(one.mass > 2 * mu * one.mu * squeeze / LAB.G for one in cubes)
