"""12.8 `accel_range(a, b, g, limits, sd)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector
from robo47.planning import accel_range

from .where_on import of_a_range

row = Row(
    Vector((2,), "1/s^2", names=("the least", "the greatest")),
    at_edge=lambda a, b, g, limits, sd: bool(np.all(limits > 0)),
    unnamed=of_a_range,
)


@row.inputs
def _(rng):
    two, nothing = np.array([4.0, 5]), np.zeros(2)
    yield np.array([1.0, 2]), nothing, np.array([0.0, 1]), two, 0.0
    yield np.array([1.0, -2]), np.array([1.0, 0]), nothing, two, 2.0
    yield np.ones(2), nothing, np.array([0.0, 9]), np.array([4.0, 2]), 0.0
    yield np.array([1.0, 0]), nothing, np.array([0.0, 3]), two, 1.0  # it holds
    yield np.array([1.0, 0]), nothing, np.array([0.0, -6]), two, 1.0  # it cannot
    yield np.array([1.0, 0]), np.array([0.0, 3]), nothing, two, 2.0  # nor this
    yield nothing, nothing, np.array([1.0, -2]), two, 0.5
    for k in (2, 3, 7, 7, 7, 7, 7, 7, 7):
        a, b = rng.numbers(-3, 3, 2, k)
        limits = rng.numbers(4, 12, k)
        a = np.where(np.abs(a) < 0.1, 0.1, a)
        yield a, b, rng.numbers(-3, 3, k), limits, float(rng.numbers(0.3, 1.3))


def bounds(a, rest, limits):
    """Return both quotients of each joint that moves, sorted, (2, n)."""
    ends = (np.array([-limits, limits]) - rest)[:, a != 0] / a[a != 0]
    return np.sort(ends, axis=0)


def narrowed(low, high):
    """Return the range that all joints allow."""
    return np.array([low.max(initial=-np.inf), high.min(initial=np.inf)])


@row.wrongs
def _(a, b, g, limits, sd):
    """not-sorted: for a below 0 the two quotients change places: sort them
    sign-of-a-lost: a's sign is lost: it is divided by abs(a) alone
    sd-not-squared: b is multiplied with sd; it is sd^2
    speed-forgotten: b sd^2 is missing
    speed-sign: b sd^2 is added to the limits; what it takes is not left for a sdd
    gravity-forgotten: g is missing
    gravity-sign: g is added to the limits; what it takes is not left for a sdd
    rest-added: b sd^2 + g is added to the limits; what it takes is not left for a sdd
    rest-not-divided: b sd^2 + g is not divided by a
    one-sided: the lower end takes b sd^2 + g with the other sign: the range is not
      symmetric about 0
    size-of-rest: b sd^2 + g is taken off the limit on both sides; it helps on one
    widest: the widest range is taken, and not what all joints allow
    least-of-both: both ends are the smallest of their quotients
    first-joint-only: only the first joint is looked at
    first-joint-only 2: only the first joint that moves is looked at; each of them
      limits sdd
    last-joint-only: only the last joint is looked at, as by a loop that overwrites
    half-the-limit: only half of the limit is used
    not-divided: it is not divided by a
    times-a: it is multiplied by a; it is divided by it
    one-limit: a torque is kept between 0 and its limit; its limit goes both ways
    greatest-first: the two are in the other order: least, then greatest
    greatest-first 2: the two are in the other order wherever the torques of joints with
      a = 0 hold: least, then greatest
    none-sorted: where none is allowed the least is above the greatest; here they are
      sorted
    none-is-zero: where none is allowed this is (0, 0)
    none-is-zero 2: where a joint with a = 0 cannot hold this is (0, 0): that allows sdd
      0; (inf, -inf) allows nothing
    none-is-one: where none is allowed the least is lowered to the greatest; the least
      is above the greatest there
    zero-stops-all: a joint with a = 0 limits nothing if it holds
    zero-row-ignored: a joint with a = 0 that cannot hold its torque allows nothing:
      (inf, -inf)
    """
    pull = b * sd**2
    rest = pull + g
    right = accel_range(a, b, g, limits, sd)
    moves = a != 0
    held = not np.any(np.abs(rest[~moves]) > limits[~moves])
    none = np.array([np.inf, -np.inf])

    def of(rest, a=a, limits=limits):
        return narrowed(*bounds(a, rest, limits)) if held else none

    low, high = bounds(a, rest, limits)
    raw = (np.array([-limits, limits]) - rest)[:, moves] / a[moves]
    lone = (np.array([-limits, limits]) - rest)[:, moves]
    size = np.abs(a[moves])
    middle, width = rest[moves] / a[moves], limits[moves] / size
    left = (limits[moves] - np.abs(rest[moves])) / size
    one = np.arange(len(a)) == 0
    last = np.arange(len(a)) == len(a) - 1

    def only(some):
        return accel_range(a[some], b[some], g[some], limits[some], sd)

    table = {
        "not-sorted": narrowed(*raw),
        "sign-of-a-lost": of(rest, np.abs(a)),
        "sd-not-squared": accel_range(a, b / sd if sd else b, g, limits, sd),
        "speed-forgotten": accel_range(a, 0 * b, g, limits, sd),
        "speed-sign": accel_range(a, -b, g, limits, sd),
        "gravity-forgotten": accel_range(a, b, 0 * g, limits, sd),
        "gravity-sign": accel_range(a, b, -g, limits, sd),
        "rest-added": of(-rest),
        "rest-not-divided": narrowed(-width - rest[moves], width - rest[moves]),
        "one-sided": narrowed(middle - width, width - middle),
        "size-of-rest": narrowed(-left, left),
        "widest": np.array([low.min(initial=np.inf), high.max(initial=-np.inf)]),
        "least-of-both": np.array([low.min(initial=np.inf), high.min(initial=np.inf)]),
        "first-joint-only": only(one),
        "first-joint-only 2": np.append(low[:1], high[:1]) if moves.any() else right,
        "last-joint-only": only(last),
        "half-the-limit": of(rest, limits=limits / 2),
        "not-divided": narrowed(*np.sort(lone, axis=0)),
        "times-a": narrowed(*np.sort(lone * a[moves], axis=0)),
        "one-limit": narrowed(
            *np.sort(
                (np.array([0 * limits, limits]) - rest)[:, moves] / a[moves], axis=0
            )
        ),
        "greatest-first": right[::-1],
        "greatest-first 2": right[::-1],
        "none-sorted": np.sort(right),
        "none-is-zero": right if right[0] <= right[1] else np.zeros(2),
        "none-is-zero 2": right if held else np.zeros(2),
        "none-is-one": np.array([min(right), right[1]]),
        "zero-stops-all": right if moves.all() else none,
        "zero-row-ignored": narrowed(low, high),
    }
    decided = {
        "first-joint-only",
        "last-joint-only",
        "gravity-forgotten",
        "speed-forgotten",
        "greatest-first",
        "none-is-zero",
        "none-is-zero 2",
        "none-sorted",
        "zero-row-ignored",
    }  # by themselves, what a joint with a = 0 that cannot hold does
    for slug in table.keys() - decided:
        table[slug] = table[slug] if held else none
    return table


@row.wrong
def zero_divides(a, b, g, limits, sd):
    """a joint with a = 0 is divided by 0: it limits nothing, if it holds => without
    that case"""
    with np.errstate(all="ignore"):
        ends = np.sort((np.array([-limits, limits]) - b * sd**2 - g) / a, axis=0)
    return np.array([ends[0].max(), ends[1].min()])


@row.right  # Joint by joint.
def _(a, b, g, limits, sd):
    low, high = -np.inf, np.inf
    for i in range(len(a)):
        rest = b[i] * sd * sd + g[i]
        if a[i] == 0:
            if abs(rest) > limits[i]:
                return np.array([np.inf, -np.inf])
            continue
        ends = sorted([(limits[i] - rest) / a[i], (-limits[i] - rest) / a[i]])
        low, high = max(low, ends[0]), min(high, ends[1])
    return low, high


row.at_least_0(limits="of torques, both ways", sd="only its square is used")
