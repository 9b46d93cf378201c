"""12.8 `path_accel_bounds(a, b, c, limits, sd)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector
from robo47.planning import path_accel_bounds

row = Row(
    Vector((2,), "1/s^2", names=("the lower bound", "the upper bound")),
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
    "joints with a = 0 within their torque limits": (
        lambda a, *more: bool(np.any(a == 0)) and not stuck(a, *more)
    ),
    "a joint with a = 0 beyond its torque limit": stuck,
})  # fmt: skip
row.cases({
    "paths on which every a is positive": lambda a, *_: bool(np.all(a > 0)),
    "paths on which every a is negative": lambda a, *_: bool(np.all(a < 0)),
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
            rng.choice([-1.0, 0.0, 1], k),
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
    for share in (0.9, 1.1):  # of its limit, with which a joint holds still
        b, c = rng.numbers(-3, 3, 2, 3)
        limits, sd = rng.numbers(4, 12, 3), float(rng.numbers(0.3, 2))
        c[0] = share * limits[0] - b[0] * sd**2
        yield np.array([0.0, *rng.numbers(0.1, 3, 2)]), b, c, limits, sd
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
    """not-sorted: in your code, the lower and the upper bound of a joint with a
      negative `a` are swapped. Sort the two quotients of each joint
    speed-forgotten: your code omits the term `b * sd**2`. Subtract it from both torque
      limits
    speed-sign: your code adds `b * sd**2` to the torque limits. Subtract `b * sd**2`
      from both limits instead
    gravity-forgotten: your code omits the term `c`. Subtract it from both torque limits
    gravity-sign: your code adds `c` to the torque limits. Subtract `c` from both limits
      instead
    rest-added: your code adds `b * sd**2 + c` to the torque limits. Subtract `b * sd**2
      + c` from both limits instead
    rest-not-divided: your code divides the torque limits by `a`, but not `b * sd**2 +
      c`. Divide both by `a`
    one-sided: for the lower bound of each joint, your code adds `b * sd**2 + c` to the
      torque limit. Subtract this term for both bounds
    size-of-rest: your code reduces both torque limits by `abs(b * sd**2 + c)`. Subtract
      `b * sd**2 + c` with its sign from both limits instead
    widest: your code returns the smallest lower bound and the largest upper bound of
      the joints. Return the largest lower bound and the smallest upper bound instead
    least-of-both: your code uses the minimum of the joints' lower bounds as the lower
      bound. Use their maximum instead
    first-joint-only: your code uses only the first joint. Use all joints, because every
      joint can limit sdd
    first-joint-only 2: your code uses only the first joint with a nonzero `a`. Use all
      joints, because every joint can limit sdd
    last-joint-only: your code uses only the last joint. Use all joints, because every
      joint can limit sdd. In a loop, keep the bounds of the earlier joints
    half-the-limit: your code uses only half of each torque limit. Use the whole limit
    not-divided: your code returns torques. Divide the torques by `a`
    times-a: your code multiplies the torques by `a`. Divide the torques by `a` instead
    one-limit: your code permits torques from 0 to the limit. Permit torques from
      `-limit` to `limit` instead
    greatest-first: your code returns the upper bound first. Return the lower bound
      first
    greatest-first 2: your code returns the upper bound first, unless a joint with `a` =
      0 exceeds its limit. Return the lower bound first
    none-sorted: your code sorts the bounds if no sdd is permitted. Leave the lower
      bound above the upper bound
    none-sorted 2: your code swaps the bounds if the joints permit no common sdd. Return
      them unswapped, because a lower bound above the upper bound means that no sdd is
      permitted
    none-is-zero: your code returns (0, 0) if no sdd is permitted, although this result
      permits sdd = 0. Return the computed bounds, or (inf, -inf) if a joint with `a` =
      0 exceeds its limit
    none-is-zero 2: your code returns (0, 0) if a joint with `a` = 0 exceeds its limit,
      although this result permits sdd = 0. Return (inf, -inf) instead
    none-is-one: your code reduces the lower bound to the upper bound if the joints
      permit no common sdd. Return the bounds unchanged, with the lower bound above the
      upper bound
    zero-stops-all: your code returns an empty interval for a joint with `a` = 0 within
      its torque limit. Skip such a joint, because it does not limit sdd
    zero-row-ignored: your code ignores a joint with `a` = 0 that exceeds its torque
      limit. Return (inf, -inf) in this case, because no sdd is permitted
    gravity-not-divided: your code subtracts `c` after the division by `a`. Subtract it
      before the division, because `c` is a torque
    speed-not-divided: your code subtracts `b * sd**2` after the division by `a`.
      Subtract it before the division, because `b * sd**2` is a torque
    negative-left-out: your code ignores joints with a negative `a`. Include them,
      because every joint with a nonzero `a` limits sdd
    largest-limit: your code uses the largest torque limit for every joint. Use each
      joint's own limit instead
    smallest-limit: your code uses the smallest torque limit for every joint. Use each
      joint's own limit instead
    last-joint-greatest: your code returns the upper bound of the last joint with a
      nonzero `a` as the upper bound. Take the minimum over all joints instead
    last-joint-least: your code returns the lower bound of the last joint with a nonzero
      `a` as the lower bound. Take the maximum over all joints instead
    mean-of-joints: your code averages the bounds of the joints. Take the maximum of the
      lower bounds and the minimum of the upper bounds instead
    sum-of-joints: your code adds the bounds of the joints. Take the maximum of the
      lower bounds and the minimum of the upper bounds instead
    from-zero: your lower bound is never below 0, and your upper bound is never above 0.
      Use only the bounds of the joints. In a loop, start with -inf and inf
    last-joint-only 2: your code returns the bounds of the last joint with a nonzero
      `a`. Return the largest lower bound and the smallest upper bound of all joints. In
      a loop, keep the bounds of the earlier joints
    never-narrowed: your bounds are -inf and inf, unless a joint with `a` = 0 exceeds
      its limit. Return the largest lower bound and the smallest upper bound of the
      joints
    zero-kept-in: your code extends the interval so that it contains 0. Return the
      bounds themselves, because sdd = 0 is not always permitted
    six-joints: your code uses only the first six joints. Use all joints, because the
      arm can have any number of joints
    first-left-out: your code skips the first joint. Use all joints, because every joint
      can limit sdd
    none-is-zero 3: your code returns (0, 0) if the joints permit no common sdd,
      although this result permits sdd = 0. Return the bounds unchanged, with the lower
      bound above the upper bound
    none-is-infinite: your code returns (inf, -inf) if the joints permit no common sdd.
      Return the computed bounds instead, because (inf, -inf) is reserved for a joint
      with `a` = 0 beyond its limit
    no-mover-is-none: your code returns (inf, -inf) if every `a` is 0 and every torque
      is within its limit. Return (-inf, inf), because any sdd is permitted
    held-by-gravity-alone: for a joint with `a` = 0, your code compares only `c` with
      the limit. Compare `b * sd**2 + c` with the limit instead
    held-by-speed-alone: for a joint with `a` = 0, your code compares only `b * sd**2`
      with the limit. Compare `b * sd**2 + c` with the limit instead
    held-with-sign: for a joint with `a` = 0, your code compares the signed torque with
      the limit. Compare the absolute value instead, because the limit also applies to
      negative torques
    all-have-to-hold: for joints with a nonzero `a`, your code also compares `b * sd**2
      + c` with the limit. Make this comparison only for joints with `a` = 0
    any-that-holds: your code accepts the speed if at least one joint with `a` = 0 is
      within its limit. Accept the speed only if all joints with `a` = 0 are within
      their limits
    small-is-zero: your code treats a small `a` as 0. Compare `a` with 0 exactly,
      because a joint with a small `a` still limits sdd
    small-is-zero 2: your code treats a small `a` as 0. Compare `a` with 0 exactly,
      because a joint with a small `a` still limits sdd
    small-is-zero 3: your code treats a small `a` as 0. Compare `a` with 0 exactly,
      because a joint with a small `a` still limits sdd
    held-below-its-limit: your code returns (inf, -inf) if the torque of a joint with
      `a` = 0 equals its limit. Skip such a joint, because its torque does not exceed
      the limit
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
        "last-joint-only 2": np.append(low[-1:], high[-1:])
        if moves.any() and held
        else right,
        "never-narrowed": np.array([-np.inf, np.inf]) if held else none,
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
    """your code divides by 0 for a joint with `a` = 0. Skip such a joint if its torque
    is within its limit, and return (inf, -inf) otherwise"""
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
