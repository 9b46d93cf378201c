"""11.6 `overlaps(A, B)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Mask, Row, rounded

from . import where_boxes

row = Row(Mask(), unnamed=where_boxes.both)


def beside(rng, gaps):
    """Return two boxes, the second beyond the first by gaps on each axis, (3,)."""
    gaps = np.array(gaps, dtype=np.float64)
    low, sizes, others = rng.numbers(-1, 1, 3), *rng.numbers(0.5, 1.5, 2, 3)
    start = rounded(np.where(gaps > 0, low + sizes + gaps, low - gaps))
    A = rounded(np.array([low, low + sizes]))
    return A, rounded(np.array([start, start + others]))


@row.inputs
def _(rng):
    unit = np.array([(0.0, 0, 0), (1, 1, 1)])
    x, y, z = np.eye(3)
    big = np.array([(-2.0, -2, -2), (3, 3, 3)])
    bar = np.array([(-1.0, 0.25, 0.25), (2, 0.75, 0.75)])  # along x, through a unit
    post = np.array([(0.25, 0.5, -1.0), (0.75, 0.7, 2)])
    first = [(unit, unit + x), (unit, unit + y + z), (unit, unit + 1.001 * y),
             (unit + x + y + z, unit), (unit, big), (big, unit),
             (bar, post), (post, bar), (bar, unit), (bar, post + 2 * z),
             (unit, unit), (unit, unit + 0.75 * (x + y - z))]  # fmt: skip
    drawn = []
    for gaps in ((0.2, 0, 0), (0, 0.2, 0), (0, 0, 0.2), (0.2, 0.3, 0), (0.1, 0.1, 0.2),
                 (0, 0.3, 0.2), (-0.2, -0.1, -0.3), (-0.1, -0.2, -0.1),
                 (0, -0.1, -0.2)):  # fmt: skip
        A, B = beside(rng, gaps)
        drawn += [(A, B), (B, A)]
    return [*first, *drawn]


@row.wrongs
def _(A, B):
    """any-for-all: one axis is enough for it; boxes overlap only where they do on all
      three => any for all
    one-direction: only one of the two comparisons is made: B may lie below A as well as
      above => A[0] <= B[1] alone
    one-direction 2: only one of the two comparisons is made: B may lie above A as well
      as below => B[0] <= A[1] alone
    touching-left-out: what only touches counts as apart; it is to overlap => with <
    touching-left-out 2: what only touches counts as apart on one side; it is to overlap
      => with one <
    touching-left-out 3: what only touches counts as apart on one side; it is to overlap
      => with the other <
    negated: it is the other way round: True is for those that overlap
    first-axis-only: only x is compared
    two-axes-only: z is not compared
    contained: A has to lie inside B, or B in A; it is enough to overlap
    contained 2: B has to lie inside A; it is enough to overlap
    contained 3: A has to lie inside B; it is enough to overlap
    a-corner-inside: B's least or greatest corner has to lie in A; boxes may cross
      without
    a-corner-inside 2: B's least corner has to lie in A; it may lie below A's
    middles-inside: A's middle has to lie in B
    middles-inside 2: one box's middle has to lie in the other; boxes overlap by less
    half-of-one: the middles may be as far apart as half of A; half of B counts, too
    always: it is always True
    never: it is always False
    """
    low, high = A[0] <= B[1], B[0] <= A[1]
    both = low & high

    def inside(p, X):
        return bool(np.all((X[0] <= p) & (p <= X[1])))

    holds = (A[0] <= B[0]) & (B[1] <= A[1])
    held = (B[0] <= A[0]) & (A[1] <= B[1])
    return {
        "any-for-all": bool(both.any()),
        "one-direction": bool(low.all()),
        "one-direction 2": bool(high.all()),
        "touching-left-out": bool(np.all((A[0] < B[1]) & (B[0] < A[1]))),
        "touching-left-out 2": bool(low.all() and np.all(B[0] < A[1])),
        "touching-left-out 3": bool(high.all() and np.all(A[0] < B[1])),
        "negated": not both.all(),
        "first-axis-only": bool(both[0]),
        "two-axes-only": bool(both[:2].all()),
        "contained": bool(holds.all() or held.all()),
        "contained 2": bool(holds.all()),
        "contained 3": bool(held.all()),
        "a-corner-inside": inside(B[0], A) or inside(B[1], A),
        "a-corner-inside 2": inside(B[0], A),
        "middles-inside": inside(A.mean(axis=0), B),
        "middles-inside 2": inside(A.mean(axis=0), B) or inside(B.mean(axis=0), A),
        "half-of-one": bool(
            np.all(np.abs(A.mean(axis=0) - B.mean(axis=0)) <= (A[1] - A[0]) / 2)
        ),
        "always": True,
        "never": False,
    }


@row.right  # By what they have in common.
def _(A, B):
    least = np.minimum(A[1], B[1]) - np.maximum(A[0], B[0])
    return bool(least.min() >= 0)


@row.right  # By middles and half sides: rounded, where they only touch.
def _(A, B):
    return not any(A[1][i] < B[0][i] or B[1][i] < A[0][i] for i in range(3))


row.at_least_0(answer="yes or no")
