"""The sensitivity of Day 18's numbers: each constant doubled, measured, explained."""

from labkit.lesson.constants import Numbers, between, same, times
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of

LAB = lab_of(find_day(18))
DAY = LAB.day15_mujoco

numbers = Numbers(
    sideways="sideways error: {} mm/s",
    steps="actions: {}",
    mass="mass of the puck: {} kg",
    far="distance from home: {} m",
    starts="starts of each test: {}",
    gap="gap: {} starts",
    win="probability of a win: {}",
    lose="probability of a loss: {}",
    level="level: {}",
    policies="policies: {}",
    rate="success rate: {}",
    wait="actions of standing still: {}",
    demos="demonstrations: {}",
)


@numbers.add(
    "lateral error with the gain 1", "{:.2f} mm",
    sideways=times(2.0, "the recursion is linear", within=0.03),
    steps=between(3.5, 5.5, "a is above 1: (a^48 - 1) / (a^24 - 1) is 4.9"),
    mass=between(0.85, 0.95, "the delay is mass / damping"),
    far=between(0.99, 1.0, "home is so far away that the line hardly rotates"),
)  # fmt: skip
def lateral(sideways=1.0, steps=LAB.STEPS, mass=DAY.MASS, far=LAB.FAR):
    """Return how far the pusher is from the line, mm."""
    before = LAB.FAR, LAB.SIDEWAYS
    LAB.FAR, LAB.SIDEWAYS = far, sideways / 1e3
    try:
        return 1e3 * LAB.measured_error(1.0, round(steps), mass)
    finally:
        LAB.FAR, LAB.SIDEWAYS = before


@numbers.add(
    "two tests of one policy that differ by 5 starts or more", "{:.2f}",
    rate=between(0.0, 1.5, "the standard deviation is sqrt(n p (1 - p))", to=0.9),
    starts=between(1.4, 1.8, "the standard deviation grows with sqrt(n)"),
    gap=between(0.0, 0.15, "10 starts are 2.2 standard deviations of the difference"),
)  # fmt: skip
def luck(rate=0.695, starts=50, gap=5):
    """Return the probability of such a difference."""
    return LAB.gap_by_luck(rate, starts, gap)


@numbers.add(
    "power of the sign test", "{:.2f}",
    win=between(1.3, 1.6, "more starts differ, and more of them are wins"),
    lose=between(0.4, 0.6, "the split is less uneven"),
    starts=between(1.3, 1.6, "twice as many starts that differ"),
    level=between(1.05, 1.3, "smaller differences are reported"),
)  # fmt: skip
def power(win=0.24, lose=0.05, starts=50, level=0.05):
    """Return the power."""
    return LAB.paired_power(win, lose, starts, level)


@numbers.add(
    "the best of six tests", "{:.2f}",
    rate=between(1.1, 1.2, "the standard deviation is smaller near 1", to=0.9),
    starts=between(0.93, 0.98, "the excess shrinks with sqrt(n)"),
    policies=between(1.02, 1.07, "the largest of more numbers"),
)  # fmt: skip
def best(rate=0.695, starts=20, policies=6):
    """Return the expected rate of the best."""
    return LAB.best_of(rate, starts, policies)


@numbers.add(
    "weight of the rows in which the pusher stands still", "{:.2f}",
    wait=times(1.2, "240 of 300 rows of a slow episode, not 120 of 180"),
    demos=same("half of the episodes are slow"),
)  # fmt: skip
def still(wait=LAB.WAIT, demos=LAB.DAWDLERS):
    """Return the fraction of the total weight, with equal weights of episodes."""
    before = LAB.WAIT, LAB.DAWDLERS
    LAB.WAIT, LAB.DAWDLERS = round(wait), round(demos)
    try:
        weight = LAB.episode_weights(LAB.dawdling()[2])
    finally:
        LAB.WAIT, LAB.DAWDLERS = before
    return weight[: round(wait) * (round(demos) // 2)].sum() / weight.sum()
