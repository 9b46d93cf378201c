"""12.8 `path_accel_bounds(a, b, c, limits, sd)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector
from robo47.planning import path_accel_bounds

row = Row(
    Vector((2,), "1/s^2", names=("the least", "the greatest")),
    at_edge=lambda a, b, c, limits, sd: bool(np.all(limits > 0)),
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
    # The first joint holds, with all of its torque; the others limit sdd.
    four = np.full(3, 4.0)
    yield np.array([0.0, 1, 2]), 0 * four, np.array([4.0, 0, 1]), four, 0.0
    # A joint that moves need not hold still.
    yield np.array([2.0, 1]), 0 * two, np.array([9.0, 0]), np.array([4.0, 40]), 0.0
    # Of two joints with a = 0 one alone holds.
    yield np.array([0.0, 0, 1]), 0 * four, np.array([3.0, 6, 0]), four, 0.7
    # Hardly a torque is left to a joint that hardly moves.
    yield np.array([0.02, 1, 1]), 0 * four, np.array([3.99, 0, 0]), four, 0.0
    for small in (5e-3, 5e-4, 5e-6):
        yield np.array([small, 1]), 0 * two, np.array([4 - small, 0]), two, 0.0
    for k in (2, 3, 7, 7, 7, 7, 7, 7, 7):
        a, b = rng.numbers(-3, 3, 2, k)
        limits = rng.numbers(4, 12, k)
        a = np.where(np.abs(a) < 0.1, 0.1, a)
        yield a, b, rng.numbers(-3, 3, k), limits, float(rng.numbers(0.3, 1.3))


def stuck(a, b, c, limits, sd):
    """Return whether a joint with a = 0 cannot hold its torque."""
    return bool(np.any((a == 0) & (np.abs(b * sd**2 + c) > limits)))


row.cases({
    "paths on which every joint moves (no a is 0)": lambda a, *_: bool(np.all(a != 0)),
    "a joint with a = 0 that holds its torque": (
        lambda a, *more: bool(np.any(a == 0)) and not stuck(a, *more)
    ),
    "a joint with a = 0 that cannot hold its torque": stuck,
})  # fmt: skip
row.cases({
    "paths on which every a is above 0": lambda a, *_: bool(np.all(a > 0)),
    "paths on which every a is below 0": lambda a, *_: bool(np.all(a < 0)),
    "paths with values of a of both signs": (
        lambda a, *_: bool(np.any(a > 0) and np.any(a < 0) and np.all(a != 0))
    ),
    "paths on which some a is 0": lambda a, *_: bool(np.any(a == 0)),
})  # fmt: skip
row.cases({
    "arms with equal torque limits": lambda a, b, c, limits, sd: np.ptp(limits) == 0,
    "arms with different torque limits": lambda a, b, c, limits, sd: (
        np.ptp(limits) > 0
    ),
})  # fmt: skip


@row.rare
def _(rng):
    for k in (1, 3):
        for sign in (
            1.0,
            -1.0,
            rng.choice([-1.0, 1.0], k),
            0.0,
            rng.choice([0.0, 1], k),
        ):
            for least in (0.0, -2.0, -7.0):  # of the size of a, as a power of ten
                a = (
                    sign
                    * np.abs(rng.numbers(0.1, 3, k))
                    * 10.0 ** rng.uniform(least, 0)
                )
                b, c = 0.1 * rng.numbers(-3, 3, 2, k)
                limits = rng.numbers(4, 12, k)
                limits = np.full(k, limits[0]) if rng.integers(2) else limits
                yield a, b, c, limits, float(rng.numbers(0.1, 1.3))
    yield (
        np.array([0.0, *rng.numbers(0.1, 3, 2)]),
        0 * limits,
        limits + 9.0,
        limits,
        0.1,
    )


def bounds(a, rest, limits):
    """Return both quotients of each joint that moves, sorted, (2, n)."""
    ends = (np.array([-limits, limits]) - rest)[:, a != 0] / a[a != 0]
    return np.sort(ends, axis=0)


def narrowed(low, high):
    """Return the range that all joints allow."""
    return np.array([low.max(initial=-np.inf), high.min(initial=np.inf)])


def _of_the_ends(a, pull, c, limits, right):
    """Return mistakes of the table in what is divided, and how ends are gathered."""
    rest, n = pull + c, len(a)
    none = np.array([np.inf, -np.inf])
    moves = a != 0
    low, high = bounds(a, rest, limits)
    parts = c[moves], pull[moves]
    late = [narrowed(*(bounds(a, rest - x, limits) - y))
            for x, y in zip((c, pull), parts, strict=True)]  # fmt: skip
    up, some, empty = a > 0, moves.any(), right[0] > right[1]
    six, after = np.arange(n) < 6, np.arange(n) > 0

    def of(kept, most=limits):
        return path_accel_bounds(a[kept], pull[kept], c[kept], most[kept], 1.0)

    return {
        "gravity-not-divided": late[0],
        "speed-not-divided": late[1],
        "negative-left-out": of(up | ~moves),
        "largest-limit": narrowed(*bounds(a, rest, 0 * limits + limits.max())),
        "smallest-limit": narrowed(*bounds(a, rest, 0 * limits + limits.min())),
        "last-joint-greatest": np.array([right[0], high[-1]]) if some else right,
        "last-joint-least": np.array([low[-1], right[1]]) if some else right,
        "mean-of-joints": np.array([low.mean(), high.mean()]) if some else right,
        "sum-of-joints": np.array([low.sum(), high.sum()]) if some else right,
        "from-zero": np.array([max(right[0], 0.0), min(right[1], 0.0)]),
        "zero-kept-in": np.array([min(right[0], 0.0), max(right[1], 0.0)]),
        "six-joints": of(six),
        "first-left-out": of(after),
        "none-is-zero 3": np.zeros(2) if empty and np.isfinite(right).all() else right,
        "none-is-infinite": none if empty else right,
        "no-mover-is-none": right if some else none,
    }


def _of_holding(rest, pull, c, limits, moves, free):
    """Return mistakes of the table in whether joints with a = 0 hold.

    Args:
        rest, pull, c, limits: torques.
        moves: which joints do.
        free: the range of these.
    """
    none = np.array([np.inf, -np.inf])
    still = ~moves
    over = np.abs(rest) > limits

    def unless(stuck):
        return none if stuck else free

    return {
        "held-by-gravity-alone": unless((np.abs(c) > limits)[still].any()),
        "held-by-speed-alone": unless((np.abs(pull) > limits)[still].any()),
        "held-with-sign": unless((rest > limits)[still].any()),
        "all-have-to-hold": unless(over.any()),
        "any-that-holds": unless(still.any() and over[still].all()),
        "held-below-its-limit": unless((np.abs(rest) >= limits)[still].any()),
    }


@row.wrongs
def _(a, b, c, limits, sd):
    """not-sorted: for a below 0 the two quotients change places: sort them
    sign-of-a-lost: a's sign is lost: it is divided by abs(a) alone
    sd-not-squared: b is multiplied with sd; it is sd^2
    speed-forgotten: b sd^2 is missing
    speed-sign: b sd^2 is added to the limits; what it takes is not left for a sdd
    gravity-forgotten: c is missing
    gravity-sign: c is added to the limits; what it takes is not left for a sdd
    rest-added: b sd^2 + c is added to the limits; what it takes is not left for a sdd
    rest-not-divided: b sd^2 + c is not divided by a
    one-sided: the lower end takes b sd^2 + c with the other sign: the range is not
      symmetric about 0
    size-of-rest: b sd^2 + c is taken off the limit on both sides; it helps on one
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
    none-sorted 2: where the joints allow no common sdd the least is above the greatest;
      here they are sorted
    none-is-zero: where none is allowed this is (0, 0)
    none-is-zero 2: where a joint with a = 0 cannot hold this is (0, 0): that allows sdd
      0; (inf, -inf) allows nothing
    none-is-one: where none is allowed the least is lowered to the greatest; the least
      is above the greatest there
    zero-stops-all: a joint with a = 0 limits nothing if it holds
    zero-row-ignored: a joint with a = 0 that cannot hold its torque allows nothing:
      (inf, -inf)
    gravity-not-divided: c is taken off after the division by a; it is a torque: take it
      off first
    speed-not-divided: b sd^2 is taken off after the division by a; it is a torque: take
      it off first
    negative-left-out: joints with a below 0 limit nothing; each that moves does
    largest-limit: all joints are given the largest limit; each has its own
    smallest-limit: all joints are given the smallest limit; each has its own
    last-joint-greatest: the greatest sdd is that of the last joint alone; the smallest
      of all joints belongs there
    last-joint-least: the least sdd is that of the last joint alone; the largest of all
      joints belongs there
    mean-of-joints: the ends are means over the joints; what all allow is the largest
      least and the smallest greatest
    sum-of-joints: the ends are sums over the joints; what all allow is the largest
      least and the smallest greatest
    from-zero: the search for both ends begins with 0: the least begins with -inf, the
      greatest with inf
    zero-kept-in: the range is widened until it holds 0: sdd 0 need not be allowed
    six-joints: only the first six joints are looked at; a may have any number of them
    first-left-out: the first joint is not looked at
    none-is-zero 3: where the joints allow no common sdd this is (0, 0): that allows
      sdd 0; the least stays above the greatest
    none-is-infinite: where the joints allow no common sdd this is (inf, -inf); that is
      for a joint with a = 0 that cannot hold: their own ends are asked for
    no-mover-is-none: where no joint moves, and all hold, this is (inf, -inf), which
      allows none; any sdd is allowed: (-inf, inf)
    held-by-gravity-alone: whether a joint with a = 0 holds is asked of c alone; b sd^2
      counts as well
    held-by-speed-alone: whether a joint with a = 0 holds is asked of b sd^2 alone; c
      counts as well
    held-with-sign: whether a joint with a = 0 holds is asked without the size of its
      torque: below 0 it has a limit, too
    all-have-to-hold: a joint that moves is asked to hold still as well: for it the
      range says what it allows
    any-that-holds: with several joints with a = 0 it is enough that one holds; each has
      to
    small-is-zero: an a that is small is taken for 0; it limits sdd all the more where
      hardly a torque is left => with |a| below 0.01
    small-is-zero 2: an a that is small is taken for 0; it limits sdd all the more where
      hardly a torque is left => with |a| below 0.001
    small-is-zero 3: an a that is small is taken for 0; it limits sdd all the more where
      hardly a torque is left => with |a| below 1e-5
    held-below-its-limit: a joint with a = 0 that takes all of its torque still holds
    """
    pull = b * sd**2
    rest = pull + c
    right = path_accel_bounds(a, b, c, limits, sd)
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
        return path_accel_bounds(a[some], b[some], c[some], limits[some], sd)

    def only_above(least):
        return path_accel_bounds(np.where(np.abs(a) < least, 0.0, a), b, c, limits, sd)

    table = {
        "not-sorted": narrowed(*raw),
        "sign-of-a-lost": of(rest, np.abs(a)),
        "sd-not-squared": path_accel_bounds(a, b / sd if sd else b, c, limits, sd),
        "speed-forgotten": path_accel_bounds(a, 0 * b, c, limits, sd),
        "speed-sign": path_accel_bounds(a, -b, c, limits, sd),
        "gravity-forgotten": path_accel_bounds(a, b, 0 * c, limits, sd),
        "gravity-sign": path_accel_bounds(a, b, -c, limits, sd),
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
        "small-is-zero": only_above(1e-2),
        "small-is-zero 2": only_above(1e-3),
        "small-is-zero 3": only_above(1e-5),
        "times-a": narrowed(*np.sort(lone * a[moves], axis=0)),
        "one-limit": narrowed(
            *np.sort(
                (np.array([0 * limits, limits]) - rest)[:, moves] / a[moves], axis=0
            )
        ),
        "greatest-first": right[::-1],
        "greatest-first 2": right[::-1],
        "none-sorted": np.sort(right),
        "none-sorted 2": np.sort(right) if held else right,
        "none-is-zero": right if right[0] <= right[1] else np.zeros(2),
        "none-is-zero 2": right if held else np.zeros(2),
        "none-is-one": np.array([min(right), right[1]]),
        "zero-stops-all": right if moves.all() else none,
        "zero-row-ignored": narrowed(low, high),
        **_of_the_ends(a, pull, c, limits, right),
        **_of_holding(rest, pull, c, limits, moves, narrowed(low, high)),
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
        "six-joints",
        "first-left-out",
        *_of_holding(rest, pull, c, limits, moves, right),
    }  # by themselves, what a joint with a = 0 that cannot hold does
    for slug in table.keys() - decided:
        table[slug] = table[slug] if held else none
    return table


@row.wrong
def zero_divides(a, b, c, limits, sd):
    """a joint with a = 0 is divided by 0: it limits nothing, if it holds => without
    that case"""
    with np.errstate(all="ignore"):
        ends = np.sort((np.array([-limits, limits]) - b * sd**2 - c) / a, axis=0)
    return np.array([ends[0].max(), ends[1].min()])


@row.right  # Joint by joint.
def _(a, b, c, limits, sd):
    low, high = -np.inf, np.inf
    for i in range(len(a)):
        rest = b[i] * sd * sd + c[i]
        if a[i] == 0:
            if abs(rest) > limits[i]:
                return np.array([np.inf, -np.inf])
            continue
        ends = sorted([(limits[i] - rest) / a[i], (-limits[i] - rest) / a[i]])
        low, high = max(low, ends[0]), min(high, ends[1])
    return low, high


row.at_least_0(limits="of torques, both ways", sd="only its square is used")


row.spans(  # as small, or as large, as in the lab
    a=(lambda a: 0.2 * a,),
    b=(
        lambda b: 0.02 * b,
        lambda b: 7 * b,
    ),
    c=(lambda c: 10 * c,),
    sd=(10.0,),
)
