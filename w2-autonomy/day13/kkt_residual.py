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
    """gradient-only: your code returns the largest absolute entry of the gradient.
      Clamp x minus the gradient to the bounds and compare the result with x, because
      the component of the gradient for an entry at a bound need not be 0 at the
      minimiser
    no-abs-the-other-way: your code omits the absolute value of the differences, so it
      ignores entries that decrease. Take the absolute value of each difference first
    not-compared: your code returns the largest absolute entry of the clamped point.
      Return the largest absolute difference between x and the clamped point instead
    free-only: your code uses only the entries of x that are strictly between their
      bounds. Use all entries, because the negative gradient may move an entry at a
      bound into the box
    lower-only: your code clamps x minus the gradient only at the lower bounds. Clamp it
      at the upper bounds too
    upper-only: your code clamps x minus the gradient only at the upper bounds. Clamp it
      at the lower bounds too
    cost-gap: your code returns the absolute change in cost over the clamped step.
      Return the largest absolute change in an entry of x instead
    first-only: your code uses only the first entry of x. Use the entry that changes
      most instead
    last-only: your code uses only the last entry of x. Use the entry that changes most
      instead
    share-of-x: your code divides the residual by the largest absolute entry of x if
      this entry is above 1. Omit this division
    distance: your code returns the largest absolute difference between x and the
      minimiser. Compute the residual from the gradient at x instead
    newton-push: your code moves x by a Newton step. Move x by minus the gradient
      instead
    jacobi-push: your code divides the gradient by the diagonal of H. Move x by minus
      the gradient itself
    limits-swapped: your code swaps the lower and the upper bounds. Use `lo` as the
      lower bounds and `hi` as the upper bounds
    two-pushes: your code moves x by minus twice the gradient. Move x by minus the
      gradient itself
    half-a-push: your code moves x by minus half the gradient. Move x by minus the
      gradient itself
    unit-box: your code uses -1 and 1 as the bounds. Use the arguments `lo` and `hi`
      instead
    which-one: your code returns the index of the largest difference. Return the
      absolute difference itself
    clipped-for-the-difference: your code compares the clamped point with the clamped x.
      Compare the clamped point with x itself
    clipped-first: your code clamps x first, so the residual ignores the distance from x
      to the box. Use x itself
    slope-that-counts: your code returns the largest absolute entry of the gradient,
      excluding the entries that are held at a bound. Clamp x minus the gradient to both
      bounds, because this step can also move a free entry out of the box
    slope-that-counts 2: your code returns the largest absolute entry of the gradient,
      excluding the entries that are held at a bound. Clamp x minus the gradient to both
      bounds, because this step can also move a free entry out of the box
    signed-limit: your code returns the largest absolute entry of the gradient for the
      free entries only. Clamp x minus the gradient to both bounds for all entries,
      because an entry at a bound may move into the box
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
        "no-abs-the-other-way": (-d).max(),
        "not-compared": np.abs(np.clip(x - s, lo, hi)).max(),
        "free-only": np.abs(np.where(free, d, 0.0)).max(),
        "lower-only": np.abs(x - np.maximum(x - s, lo)).max(),
        "upper-only": np.abs(x - np.minimum(x - s, hi)).max(),
        "cost-gap": abs(x @ H @ x / 2 + f @ x - there @ H @ there / 2 - f @ there),
        "first-only": abs(d[0]),
        "last-only": abs(d[-1]),
        "share-of-x": np.abs(d).max() / max(1.0, np.abs(x).max()),
        "distance": np.abs(x - box_qp(H, f, lo, hi, x)).max(),
        "newton-push": by(np.linalg.solve(H, s)),
        "jacobi-push": by(s / np.diag(H)),
        "limits-swapped": np.abs(x - np.clip(x - s, hi, lo)).max(),
        "two-pushes": by(2 * s),
        "half-a-push": by(s / 2),
        "unit-box": np.abs(x - np.clip(x - s, -1, 1)).max(),
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
