"""11.6 `aabb_overlap(box_a, box_b)`: its questions and its mistakes."""

from itertools import product

import numpy as np

from labkit.judge import Mask, Row, rounded

row = Row(Mask())


def beside(rng, gaps):
    """Return two boxes, the second beyond the first by gaps on each axis, (3,)."""
    gaps = np.array(gaps, dtype=np.float64)
    low, sizes, others = rng.numbers(-1, 1, 3), *rng.numbers(0.5, 1.5, 2, 3)
    start = rounded(np.where(gaps > 0, low + sizes + gaps, low - gaps))
    box_a = rounded(np.array([low, low + sizes]))
    return box_a, rounded(np.array([start, start + others]))


@row.inputs
def _(rng):
    unit = np.array([(0.0, 0, 0), (1, 1, 1)])
    x, y, z = np.eye(3)
    big = np.array([(-2.0, -2, -2), (3, 3, 3)])
    bar = np.array([(-1.0, 0.25, 0.25), (2, 0.75, 0.75)])  # along x, through a unit
    post = np.array([(0.25, 0.5, -1.0), (0.75, 0.7, 2)])
    under = np.array([(-1, -1, 0.2), (0.5, 0.5, 0.5)])  # its greatest corner in a unit
    first = [(unit, unit + x), (unit, unit + y + z), (unit, unit + 1.001 * y),
             (unit + x + y + z, unit), (unit, big), (big, unit),
             (bar, post), (post, bar), (bar, unit), (bar, post + 2 * z),
             (unit, under), (under, unit),
             (unit, unit + x - 2 * y), (unit + x - 1.2 * y, unit), (unit, unit + 5 * z),
             (unit, unit + 1.5 * y + x), (unit, unit - 3 * x - 2 * y),
             (unit, unit + 1.3 * x - 1.4 * z),
             (unit, unit), (unit, unit + 0.75 * (x + y - z))]  # fmt: skip
    drawn = []
    for gaps in ((0.2, 0, 0), (0, 0.2, 0), (0, 0, 0.2), (0.2, 0.3, 0), (0.1, 0.1, 0.2),
                 (0, 0.3, 0.2), (-0.2, -0.1, -0.3), (-0.1, -0.2, -0.1),
                 (0, -0.1, -0.2)):  # fmt: skip
        box_a, box_b = beside(rng, gaps)
        drawn += [(box_a, box_b), (box_b, box_a)]
    return [*first, *drawn]


def apart(box_a, box_b):
    """Return on which axes two boxes are apart, (3,)."""
    return (box_a[0] > box_b[1]) | (box_b[0] > box_a[1])


def holds(box_a, box_b):
    """Return whether one box contains the other."""
    pairs = (box_a, box_b), (box_b, box_a)
    return any(np.all(a[0] <= b[0]) and np.all(b[1] <= a[1]) for a, b in pairs)


def touch(box_a, box_b):
    """Return whether two boxes only touch."""
    low, high = np.maximum(box_a[0], box_b[0]), np.minimum(box_a[1], box_b[1])
    return bool(np.all(low <= high) and np.any(low == high))


def crossing(box_a, box_b):
    """Return whether two boxes overlap, and neither contains the other."""
    out = np.any(apart(box_a, box_b)) or touch(box_a, box_b) or holds(box_a, box_b)
    return not out


def alone(axis):
    """Return the case of boxes that are apart on one axis alone."""
    return lambda box_a, box_b: apart(box_a, box_b).tolist() == np.eye(3)[axis].tolist()


def side(sign):
    """Return the case of boxes that are apart, box_b on one side of box_a."""

    def of(box_a, box_b):
        out = apart(box_a, box_b)
        above = box_b[0] > box_a[1]
        return bool(out.any() and np.all((above == (sign > 0))[out]))

    return of


INSIDE = {
    "boxes of which one contains the other": lambda a, b: (
        holds(a, b) and not touch(a, b)
    ),
    "boxes that overlap without containing each other": crossing,
    "boxes that only touch": touch,
}
row.cases({
    "boxes that are apart along one axis": lambda a, b: int(apart(a, b).sum()) == 1,
    "boxes that are apart along two axes": lambda a, b: int(apart(a, b).sum()) == 2,
    "boxes that are apart along three axes": lambda a, b: bool(apart(a, b).all()),
    **INSIDE,
})  # fmt: skip
row.cases({
    "boxes that are apart along x alone": alone(0),
    "boxes that are apart along y alone": alone(1),
    "boxes that are apart along z alone": alone(2),
    "boxes that are apart along several axes": lambda a, b: int(apart(a, b).sum()) > 1,
    **INSIDE,
})  # fmt: skip
row.cases({
    "boxes that are apart, with box_b on the positive side": side(1),
    "boxes that are apart, with box_b on the negative side": side(-1),
    **INSIDE,
})  # fmt: skip


@row.rare
def _(rng):
    for out in product((False, True), repeat=3):  # apart on these axes
        low, sizes, more = rng.integers(-8, 8, 3), *rng.integers(2, 9, (2, 3))
        box_a = np.array([low, low + sizes]) / 4
        one, sides = int(rng.choice([-1, 1])), rng.choice([-1, 1], 3)
        gap = np.where(out, rng.integers(1, 4, 3), -1 - rng.integers(0, 2, 3))
        for sign in (one * np.ones(3), sides):  # on one side, or on either
            start = np.where(sign > 0, low + sizes + gap, low - more - gap)
            yield box_a, np.array([start, start + more]) / 4
    start = low + sizes * (np.arange(3) == rng.integers(3))
    yield box_a, np.array([start, start + more]) / 4  # it touches
    for a, b in ((box_a, 1.0), (box_a + 0.25, 2.0)):
        inner = np.array([a[0] - b / 8, a[1] + b / 8])
        yield inner, a
        yield a, inner


@row.wrongs(hidden={"nearly-touching": "no two boxes are hardly apart in a run"})
def _(box_a, box_b):
    """any-for-all: your code reports an overlap if the intervals overlap on at least
      one axis. Two boxes overlap only if their intervals overlap on all three axes
    one-direction: your code reports an overlap even if `box_b` lies entirely on the
      positive side of `box_a`. Test both sides on each axis, because a gap on either
      side separates the boxes
    one-direction 2: your code reports an overlap even if `box_b` lies entirely on the
      negative side of `box_a`. Test both sides on each axis, because a gap on either
      side separates the boxes
    touching-left-out: your code reports boxes that only touch as separate. Boxes that
      touch also overlap, so equal faces do not separate them
    touching-left-out 2: your code reports boxes as separate if an upper face of `box_a`
      touches a lower face of `box_b`. Boxes that touch also overlap, so equal faces do
      not separate them
    touching-left-out 3: your code reports boxes as separate if a lower face of `box_a`
      touches an upper face of `box_b`. Boxes that touch also overlap, so equal faces do
      not separate them
    negated: your code negates the result. Return True if the boxes overlap
    first-axis-only: your code compares only x. Two boxes overlap only if their
      intervals overlap on all three axes
    two-axes-only: your code does not compare z. Two boxes overlap only if their
      intervals overlap on all three axes
    contained: your code requires one box to contain the other. Compare the intervals on
      each axis instead, because boxes can also overlap partially
    contained 2: your code requires `box_a` to contain `box_b`. Compare the intervals on
      each axis instead, because boxes can also overlap partially
    contained 3: your code requires `box_b` to contain `box_a`. Compare the intervals on
      each axis instead, because boxes can also overlap partially
    a-corner-inside: your code requires the lower or the upper corner of `box_b` to lie
      in `box_a`. Compare the intervals on each axis instead, because two boxes can
      overlap even if both of these corners lie outside `box_a`
    a-corner-inside 2: your code requires the lower corner of `box_b` to lie in `box_a`.
      Compare the intervals on each axis instead, because two boxes can overlap even if
      this corner lies outside `box_a`
    a-corner-inside 3: your code requires the upper corner of `box_b` to lie in `box_a`.
      Compare the intervals on each axis instead, because two boxes can overlap even if
      this corner lies outside `box_a`
    middles-inside: your code requires the centre of `box_a` to lie in `box_b`. Compare
      the intervals on each axis instead, because two boxes can overlap even if this
      centre lies outside `box_b`
    middles-inside 2: your code requires the centre of one box to lie in the other box.
      Compare the intervals on each axis instead, because two boxes can overlap even if
      neither centre lies in the other box
    half-of-one: your code reports an overlap only if the centre of `box_b` lies in
      `box_a`. On each axis, the distance between the centres can be as large as the sum
      of the half extents of both boxes
    corners-only: your code tests whether a corner of one box lies in the other box.
      Compare the intervals on each axis instead, because two boxes can overlap even if
      no corner of either box lies in the other
    corners-only 2: your code tests whether a corner of `box_b` lies in `box_a`. Compare
      the intervals on each axis instead, because two boxes can overlap even if no
      corner of `box_b` lies in `box_a`
    corners-only 3: your code tests only the lower and the upper corner of each box.
      Compare the intervals on each axis instead, because two boxes can overlap even if
      none of these corners lies in the other box
    corners-only 4: your code tests only the lower corner of each box. Compare the
      intervals on each axis instead, because two boxes can overlap even if neither
      lower corner lies in the other box
    balls: your code treats the boxes as spheres, because it compares only the distance
      between the centres with a sum of radii. Compare the intervals on each axis
      instead
    balls 2: your code treats the boxes as spheres, because it compares only the
      distance between the centres with a sum of radii. Compare the intervals on each
      axis instead
    balls 3: your code treats the boxes as spheres, because it compares only the
      distance between the centres with a sum of radii. Compare the intervals on each
      axis instead
    sides-not-halved: your code treats both boxes as twice as large as they are. On each
      axis, the distance between the centres must be at most half of the sum of the side
      lengths
    sides-in-quarters: your code treats both boxes as half as large as they are. On each
      axis, the distance between the centres can be as large as half of the sum of the
      side lengths
    or-for-and: your code reports boxes as separate only if `box_b` lies on the positive
      side of `box_a` on one axis and on the negative side on another. A gap on one axis
      already separates the boxes
    two-axes-enough: your code reports an overlap if the intervals overlap on at least
      two axes. Two boxes overlap only if their intervals overlap on all three axes
    other-axes: your code does not compare y. Two boxes overlap only if their intervals
      overlap on all three axes
    other-axes 2: your code does not compare x. Two boxes overlap only if their
      intervals overlap on all three axes
    other-axes 3: your code compares only y. Two boxes overlap only if their intervals
      overlap on all three axes
    other-axes 4: your code compares only z. Two boxes overlap only if their intervals
      overlap on all three axes
    volume: your code tests whether the product of the three overlaps is above 0. Test
      whether each of the three overlaps is at least 0
    volume 2: your code tests whether the product of the three overlaps is at least 0.
      Test each overlap separately, because two negative overlaps have a positive
      product
    sum-of-overlaps: your code tests only the sum of the overlaps along the three axes.
      Test each overlap separately, because each overlap must be at least 0
    nearly-touching: your code reports an overlap for boxes with a small gap. Omit the
      tolerance, because boxes with a gap do not overlap
    always: your code always returns True. Compare the intervals on all three axes
    never: your code always returns False. Compare the intervals on all three axes
    """
    low, high = box_a[0] <= box_b[1], box_b[0] <= box_a[1]
    both = low & high

    def inside(p, X):
        return bool(np.all((X[0] <= p) & (p <= X[1])))

    holds = (box_a[0] <= box_b[0]) & (box_b[1] <= box_a[1])
    held = (box_b[0] <= box_a[0]) & (box_a[1] <= box_b[1])
    share = np.minimum(box_a[1], box_b[1]) - np.maximum(box_a[0], box_b[0])
    apart = np.abs(box_a.mean(axis=0) - box_b.mean(axis=0))
    sides = box_a[1] - box_a[0], box_b[1] - box_b[0]

    def corners(X, Y):
        ends = (np.where(which, Y[1], Y[0]) for which in np.ndindex(2, 2, 2))
        return any(inside(corner, X) for corner in ends)

    def two():
        return [inside(c, X) for X, Y in ((box_a, box_b), (box_b, box_a)) for c in Y]

    def balls(of):
        return bool(np.linalg.norm(apart) <= (of(sides[0]) + of(sides[1])) / 2)

    return {
        "corners-only": lambda: corners(box_a, box_b) or corners(box_b, box_a),
        "corners-only 2": lambda: corners(box_a, box_b),
        "corners-only 3": lambda: any(two()),
        "corners-only 4": lambda: two()[0] or two()[2],
        "balls": lambda: balls(np.linalg.norm),
        "balls 2": lambda: balls(np.min),
        "balls 3": lambda: balls(np.max),
        "sides-not-halved": lambda: bool(np.all(apart <= sides[0] + sides[1])),
        "sides-in-quarters": lambda: bool(np.all(apart <= (sides[0] + sides[1]) / 4)),
        "or-for-and": lambda: bool(low.all() or high.all()),
        "two-axes-enough": lambda: bool(both.sum() >= 2),
        "other-axes": lambda: bool(both[[0, 2]].all()),
        "other-axes 2": lambda: bool(both[1:].all()),
        "other-axes 3": lambda: bool(both[1]),
        "other-axes 4": lambda: bool(both[2]),
        "volume": lambda: bool(np.prod(share) > 0),
        "volume 2": lambda: bool(np.prod(share) >= 0),
        "sum-of-overlaps": lambda: bool(share.sum() >= 0),
        "a-corner-inside 3": lambda: inside(box_b[1], box_a),
        "nearly-touching": lambda: bool(share.min() >= -0.01),
        "any-for-all": lambda: bool(both.any()),
        "one-direction": lambda: bool(low.all()),
        "one-direction 2": lambda: bool(high.all()),
        "touching-left-out": lambda: bool(
            np.all((box_a[0] < box_b[1]) & (box_b[0] < box_a[1]))
        ),
        "touching-left-out 2": lambda: bool(low.all() and np.all(box_b[0] < box_a[1])),
        "touching-left-out 3": lambda: bool(high.all() and np.all(box_a[0] < box_b[1])),
        "negated": lambda: not both.all(),
        "first-axis-only": lambda: bool(both[0]),
        "two-axes-only": lambda: bool(both[:2].all()),
        "contained": lambda: bool(holds.all() or held.all()),
        "contained 2": lambda: bool(holds.all()),
        "contained 3": lambda: bool(held.all()),
        "a-corner-inside": lambda: inside(box_b[0], box_a) or inside(box_b[1], box_a),
        "a-corner-inside 2": lambda: inside(box_b[0], box_a),
        "middles-inside": lambda: inside(box_a.mean(axis=0), box_b),
        "middles-inside 2": lambda: (
            inside(box_a.mean(axis=0), box_b) or inside(box_b.mean(axis=0), box_a)
        ),
        "half-of-one": lambda: bool(
            np.all(
                np.abs(box_a.mean(axis=0) - box_b.mean(axis=0))
                <= (box_a[1] - box_a[0]) / 2
            )
        ),
        "always": True,
        "never": False,
    }


@row.right  # By what they have in common.
def _(box_a, box_b):
    least = np.minimum(box_a[1], box_b[1]) - np.maximum(box_a[0], box_b[0])
    return bool(least.min() >= 0)


@row.right  # By middles and half sides: rounded, where they only touch.
def _(box_a, box_b):
    return not any(
        box_a[1][i] < box_b[0][i] or box_b[1][i] < box_a[0][i] for i in range(3)
    )


row.at_least_0(answer="yes or no")
