"""What Day 14's numbers hang on: each constant turned by two, measured, explained."""

import numpy as np

from labkit.lesson.constants import Numbers, between, same, times, turned
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of

LAB = lab_of(find_day(14))
DAY = LAB.day14_mujoco

numbers = Numbers(
    mu="friction: {}",
    squeeze="newtons per pad: {}",
    seconds="SLOW, in which it is lifted: {} s",
    lift="how far it is lifted: {} m",
    steps="steps of the simulation in 10 ms: {}",
    soft="time constant of the contacts: × {}",
    size="how far the contacts are apart: × {}",
    edges="edges of each cone: {}",
    within="either way: {}",
    cubes="cubes: {}",
    seed="seed of the cubes: {}",
)


def scene(steps, soft):
    """Return a hand with other steps and contacts."""
    with turned(DAY, STEP=0.01 / steps, GRIP_TIME=soft * DAY.GRIP_TIME):
        return DAY.hand()


@numbers.add(
    "the heaviest cube, mu 0.3, 2 N", "{:.0f} g",
    mu=times(2.0, "m = 2 mu F / g"),
    squeeze=times(2.0, "m = 2 mu F / g"),
    seconds=between(1.0, 1.02, "its acceleration, 6 h / T², is a quarter"),
    lift=between(0.96, 1.0, "its acceleration, 6 h / T², is twice as large"),
    steps=between(0.99, 1.01, "shorter steps: the same forces, to a gram"),
    soft=between(0.99, 1.01, "friction holds it, not stiffness: the same, to a gram"),
)  # fmt: skip
def heaviest(
    mu=0.3, squeeze=2.0, seconds=LAB.SLOW, lift=LAB.TARGET, steps=DAY.TICK,
    soft=1.0,
):  # fmt: skip
    """Return how many grams are held."""
    step = 0.01 / steps
    with turned(DAY, STEP=step, TICK=steps), turned(LAB, SLOW=seconds, TARGET=lift):
        return LAB.heaviest(*scene(steps, soft), mu, squeeze)


@numbers.add(
    "the rank of two opposite contacts", "{:.0f}",
    mu=same("no friction at a point turns a cube about the line through two"),
    size=same("nor does a longer line"),
    edges=same("more edges of the same cones lie in the same five directions"),
)  # fmt: skip
def rank_of_two(mu=0.5, size=1.0, edges=LAB.EDGES):
    """Return of how many directions two contacts know."""
    places = size * np.array(LAB.GRASPS["two, opposite"])
    with turned(LAB, EDGES=edges, GRASPS={"two": places}):
        return np.linalg.matrix_rank(LAB.wrenches("two", mu))


@numbers.add(
    "cubes for a rate of a half, to 0.05 either way", "{:.0f}",
    within=between(0.24, 0.26, "n = 1.96² / 4 / 0.05², less 4"),
)  # fmt: skip
def needed(within=0.05):
    """Return how many cubes."""
    return LAB.needed(within)


@numbers.add(
    "the lower end where all 60 are held", "{:.3f}",
    cubes=between(1.02, 1.04, "n / (n + 1.96²): half as much is missing"),
)  # fmt: skip
def low_end(cubes=LAB.TESTED):
    """Return what 60 of 60 says at least."""
    return LAB.success_rate(np.ones(cubes, bool))[1]


@numbers.add(
    "slippery cubes that theta alone drops", "{:.0f} of 60",
    squeeze=between(0.3, 0.5, "twice the squeeze holds twice the mass"),
    mu=between(0.3, 0.5, "and so does twice the friction"),
    seed=between(0.75, 1.3, "other cubes of the same kind", to=14),
)  # fmt: skip
def dropped(squeeze=1.6, mu=1.0, seed=LAB.CUBES_SEED):
    """Return how many cubes are heavier than 2 mu F / g."""
    with turned(LAB, CUBES_SEED=seed):
        cubes, _ = LAB.unseen(LAB.SLIPPERY)
    return sum(one.mass > 2 * mu * one.mu * squeeze / LAB.G for one in cubes)
