"""13.4 `kkt_residual(H, f, lo, hi, x)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Scalar
from robo47.optimal import box_qp

from .asked import boxed, problems

row = Row(Scalar())


@row.inputs
def _(rng):
    H = np.array([[2.0, 1], [1, 2]])
    f = np.array([-2.0, -10])
    one = np.ones(2)
    cases = [(H, f, -one, one, np.array(x)) for x in ([0.5, 1.0], [-1.0, 1], [0.0, 0])]
    inside = [(*one[:4], np.round((one[2] + one[3]) / 2, 3)) for one in boxed(rng)[:4]]
    clipped = [
        (*one[:4], np.clip(np.linalg.solve(one[0], -one[1]).round(3), *one[2:4]))
        for one in boxed(rng)[:4]
    ]
    return [*cases, *inside, *clipped, *problems(rng, 4), *boxed(rng)]


@row.spans
def _(rng):
    H, f, one = np.array([[2.0, 1], [1, 2]]), np.array([-2.0, -10]), np.ones(2)
    for off in (1e-7, 1e-9):
        yield H, f, -one, one, np.array([0.5 + off, 1.0])
    yield H, 1e6 * f, -1e7 * one, 1e7 * one, 1e6 * one


def clipped_first(H, f, lo, hi, x):
    """Return the residual of the nearest point of the box."""
    x = np.clip(x, lo, hi)
    return np.abs(x - np.clip(x - (H @ x + f), lo, hi)).max()


@row.wrongs
def _(H, f, lo, hi, x):
    """gradient-only: that is the largest slope; where a limit holds x, a slope is no
      fault => the largest of |H x + f|
    box-only: that is how far x is outside the box: it is 0 for every x inside => the
      largest of |x - clip(x)|
    g-forgotten: f is missing in the slope => with H x for the slope
    H-forgotten: H is missing in the slope => with f for the slope
    slope-sign: x is pushed uphill: the slope is subtracted => with clip(x + slope)
    slope-halved: the slope of x . H x / 2 is H x, without the half => with H x / 2 + f
    slope-doubled: the cost has a half before x . H x, so its slope has no 2 => with 2 H
      x + f
    norm: the differences are squared and added; the largest is asked => their length
    summed: the differences are added; the largest is asked => the sum of their sizes
    mean: that is their mean; the largest is asked => the mean of their sizes
    no-abs: the largest difference, but with its sign: one that is below 0 does not show
      => the largest of x - clip(x - slope)
    no-abs-the-other-way: the largest difference, but with its sign: one that is above 0
      does not show => the largest of clip(x - slope) - x
    least: that is the smallest of the differences
    clip-the-slope: the slope is clipped to the box; it is x that has limits => the
      largest of |clip(slope)|
    not-compared: that is where x comes back; how far from x is asked => the largest of
      |clip(x - slope)|
    free-only: only entries between their limits count; one at a limit that wants away
      is not best => the largest slope of the free ones
    lower-only: only the lower limit clips
    upper-only: only the upper limit clips
    clip-the-push: the push is clipped to the box; it is where it leads that has limits
      => the largest of |clip(-slope)|
    cost-gap: that is how much the cost falls by a push; how far x moves is asked
    first-only: only the first difference is looked at
    last-only: only the last difference is looked at
    share-of-x: it is divided by the largest entry of x, where that is above 1
    squares-summed: the squares of the differences are added; the largest difference is
      asked
    squared: the largest difference is squared
    distance: that is how far the best point is; the residual needs no solution => the
      largest distance to the best point
    newton-push: x is pushed by Newton's step; it is pushed by its slope => with H^-1
      times the slope
    jacobi-push: x is pushed by its slope over H's diagonal; it is pushed by its slope
    limits-swapped: the lower and the upper limit are swapped
    two-pushes: x is pushed by twice its slope
    half-a-push: x is pushed by half of its slope
    pushed-from-0: minus the slope is clipped, and x is not added to it: x is pushed,
      not 0 => with clip(-slope)
    unit-box: the box is taken for -1 to 1
    diagonal-of-H: of H only the diagonal is used in the slope => with H's diagonal
    which-one: that is which difference is largest; how large it is is asked => its
      index
    clipped-for-the-difference: it is the clipped x that the pushed one is compared
      with; x itself is
    clipped-first: x is clipped first, so what is outside counts for nothing => with
      clip(x) for x
    slope-that-counts: that is the largest slope that no limit holds; it is not clipped,
      and how far x may still go does not limit it
    slope-that-counts 2: that is the largest slope that no limit holds; it is not
      clipped, and how far x may still go does not limit it => with none where both
      limits are one
    signed-limit: which limit an entry is pushed to is left out: at either one slopes
      count for nothing => the slope, 0 at the limits
    """
    s = H @ x + f
    d = x - np.clip(x - s, lo, hi)
    there = x - d
    free = (x > lo) & (x < hi)
    stays = ((x <= lo) & (s > 0)) | ((x >= hi) & (s < 0))
    counted = np.where(
        x <= lo, np.minimum(s, 0), np.where(x >= hi, np.maximum(s, 0), s)
    )

    def by(slope):
        return np.abs(x - np.clip(x - slope, lo, hi)).max()

    return {
        "gradient-only": np.abs(s).max(),
        "box-only": np.abs(x - np.clip(x, lo, hi)).max(),
        "g-forgotten": by(H @ x),
        "H-forgotten": by(f),
        "slope-sign": by(-s),
        "slope-halved": by(H @ x / 2 + f),
        "slope-doubled": by(2 * H @ x + f),
        "norm": np.linalg.norm(d),
        "summed": np.abs(d).sum(),
        "mean": np.abs(d).mean(),
        "no-abs": d.max(),
        "no-abs-the-other-way": (-d).max(),
        "least": np.abs(d).min(),
        "clip-the-slope": np.abs(np.clip(s, lo, hi)).max(),
        "not-compared": np.abs(np.clip(x - s, lo, hi)).max(),
        "free-only": np.abs(np.where(free, d, 0.0)).max(),
        "lower-only": np.abs(x - np.maximum(x - s, lo)).max(),
        "upper-only": np.abs(x - np.minimum(x - s, hi)).max(),
        "clip-the-push": np.abs(np.clip(-s, lo, hi)).max(),
        "cost-gap": abs(x @ H @ x / 2 + f @ x - there @ H @ there / 2 - f @ there),
        "first-only": abs(d[0]),
        "last-only": abs(d[-1]),
        "share-of-x": np.abs(d).max() / max(1.0, np.abs(x).max()),
        "squares-summed": np.sum(d**2),
        "squared": np.abs(d).max() ** 2,
        "distance": np.abs(x - box_qp(H, f, lo, hi, x)).max(),
        "newton-push": by(np.linalg.solve(H, s)),
        "jacobi-push": by(s / np.diag(H)),
        "limits-swapped": np.abs(x - np.clip(x - s, hi, lo)).max(),
        "two-pushes": by(2 * s),
        "half-a-push": by(s / 2),
        "pushed-from-0": np.abs(x - np.clip(-s, lo, hi)).max(),
        "unit-box": np.abs(x - np.clip(x - s, -1, 1)).max(),
        "diagonal-of-H": by(np.diag(H) * x + f),
        "which-one": float(np.abs(d).argmax()),
        "clipped-for-the-difference": np.abs(np.clip(x, lo, hi) - x + d).max(),
        "clipped-first": clipped_first(H, f, lo, hi, x),
        "slope-that-counts": np.abs(counted).max(),
        "slope-that-counts 2": np.abs(np.where(stays, 0.0, s)).max(),
        "signed-limit": np.abs(np.where(free, s, 0.0)).max(),
    }


row.at_least_0(answer="a size")


@row.right  # An entry at a time.
def _(H, f, lo, hi, x):
    worst = 0.0
    for i in range(len(x)):
        there = x[i] - H[i] @ x - f[i]
        there = min(max(there, lo[i]), hi[i])
        worst = max(worst, abs(there - x[i]))
    return worst


@row.wrong(
    "not-at-every-size", hidden="the numbers of the lab stay within its limits"
)  # Under a millionth it is 0.
def _(H, f, lo, hi, x):
    found = np.abs(x - np.clip(x - (H @ x + f), lo, hi)).max()
    return found if found >= 1e-6 else 0.0


row.spans(  # as small, or as large, as in the lab
    H=(lambda H: 10 * H,),
)
