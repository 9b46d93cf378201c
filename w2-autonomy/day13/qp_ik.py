"""13.6 `qp_ik(J, e, weights, damping, dq_lo, dq_hi)`: its questions, its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Row, Vector
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47.optimal import box_qp

from .asked import ARM

LAB = lab_of(find_day(13))  # its `box_qp` accepts bounds that are swapped
row = Row(Vector((7,), "rad", names=tuple(f"joint{i}" for i in range(1, 8))))


@row.inputs
def _(rng):
    J = np.zeros((6, 7))
    J[3, :2] = J[4, 2] = 1
    e = np.array([0, 0, 0, 1, 0.5, 0])
    one = np.ones(6)
    wide = 9 * np.ones(7)
    tight = wide.copy()
    tight[0] = 0.3
    cases = [(J, e, one, 0.1, -limit, limit) for limit in (wide, tight)]
    # Clamped and solved again, another entry is beyond a bound: solve the rest again.
    J = np.zeros((6, 7))
    J[0, :4] = 1.4, 0.5, -1.9, 1.9
    J[1, 1:4] = 0.8, -1.1, -0.5
    J[2, 2:4] = 0.8, -1.3
    J[3, 3] = 1.5
    e = np.array([0.1, 2.7, 1.8, 1.1, 0, 0])
    cases.append((J, e, one, 0.1, -np.ones(7), np.ones(7)))
    drawn = []
    for k, q in enumerate(rng.configurations(8)):
        J = np.round(ARM.at(q).J_site, 3)
        low, high = rng.numbers(0.05, 0.6, 2, 7)  # dq_lo is -low
        if k % 4 == 1:
            low, high = low + 30, high + 30
        if k == 2:
            low[3] = high[3] = 0  # a joint that is fixed
        if k == 3:  # joints beyond their range come back
            low[1], high[4] = -0.03, -0.2
            low[4] = 2
        weights = one if k % 4 == 0 else rng.numbers(0.2, 2, 6)
        damping = [0.1, 0.5, 0.3][k % 3]
        drawn.append((J, rng.numbers(-1, 1, 6), weights, damping, -low, high))
    return [*cases, *drawn]


row.spans(
    damping=(0.005, 5.0),
    weights=(lambda w: np.where(np.arange(6) < 3, 0.01, 1.0), lambda w: 100.0 * w),
)


def solved(J, e, weights, damp, lo, hi, right=None, box=box_qp):
    """Return the optimal step; the damping is already squared."""
    right = weights if right is None else right
    H = J.T @ (weights[:, None] * J) + damp * np.eye(7)
    return box(H, -J.T @ (right * e), lo, hi, np.zeros(7))


@row.wrongs(hidden={"stands-still-allowed": "no joint of the lab is beyond its range"})
def _(J, e, weights, damping, dq_lo, dq_hi):
    """clip-after: your code clamps the unconstrained minimiser to the bounds. Solve the
      quadratic program with bounds instead, so that the other joints compensate for a
      joint at its bound
    scaled-back: your code scales the whole step by one factor to satisfy the bounds.
      Solve the quadratic program with bounds instead, so that the other joints
      compensate for a joint at its bound
    not-limited: your code omits the bounds `dq_lo` and `dq_hi`. Solve the quadratic
      program with these bounds
    lower-only: your code applies only the lower bounds. Apply the upper bounds too
    upper-only: your code applies only the upper bounds. Apply the lower bounds too
    limits-mirrored: your code uses `-dq_hi` as the lower bounds. Use `dq_lo` instead
    limits-mirrored 2: your code uses `-dq_hi` as the lower bounds. Use `dq_lo` instead
    limits-mirrored 3: your code uses `-dq_lo` as the upper bounds. Use `dq_hi` instead
    limits-swapped: your code swaps the lower and the upper bounds. Pass `dq_lo` first
      and `dq_hi` second
    limits-1: your code uses -1 and 1 as the bounds. Use `dq_lo` and `dq_hi` instead
    clipped-twice: your code clamps the unconstrained minimiser and then a second step
      for the remaining error. Solve the quadratic program instead, because the second
      step also relies on joints that are already at a bound
    mean-weight-in-g: your code uses the mean of the weights in f = -J^T W e. Multiply
      each entry of e by its own weight instead
    clip-after 2: your code clamps Day 3's damped step (computed without the weights) to
      the bounds. Solve the quadratic program with bounds instead, so that the other
      joints compensate for a joint at its bound
    damping-weighted: your code multiplies the damping term by the mean of the weights.
      Omit this factor, because the weights apply only to the error
    stands-still-allowed: your code widens the bounds until they contain 0. Keep the
      bounds, because a joint beyond its range should move back into its range
    translation-only: your code uses only the translation part of the error. Use all six
      components
    rotation-only: your code uses only the rotation part of the error. Use all six
      components
    """
    d = damping**2
    lo, hi = dq_lo, dq_hi
    given = (J, e, weights, d)
    far = 1e6 * np.ones(7)
    free = solved(*given, -far, far)
    limit = np.where(free > 0, hi, lo)
    share = np.divide(limit, free, out=np.ones(7), where=np.abs(free) > 1e-12)
    once = np.clip(free, lo, hi)
    again = once + solved(J, e - J @ once, weights, d, -far, far)
    down = np.array([0.0, 0, 0, 1, 1, 1])
    return {
        "clip-after": np.clip(free, lo, hi),
        "clipped-twice": np.clip(again, lo, hi),
        "scaled-back": free * min(1.0, share.min()),
        "not-limited": free,
        "lower-only": partial(solved, *given, lo, far),
        "upper-only": partial(solved, *given, -far, hi),
        "limits-mirrored": partial(solved, *given, -np.abs(hi), np.abs(hi)),
        "limits-mirrored 2": partial(solved, *given, -hi, hi, box=LAB.box_qp),
        "limits-mirrored 3": partial(solved, *given, -np.abs(lo), np.abs(lo)),
        "limits-swapped": partial(solved, *given, hi, lo, box=LAB.box_qp),
        "limits-1": partial(solved, *given, -np.ones(7), np.ones(7)),
        "mean-weight-in-g": partial(
            solved, *given, lo, hi, 0 * weights + weights.mean()
        ),
        "clip-after 2": lambda: np.clip(solved(J, e, np.ones(6), d, -far, far), lo, hi),
        "damping-weighted": partial(solved, J, e, weights, weights.mean() * d, lo, hi),
        "stands-still-allowed": partial(
            solved, *given, np.minimum(lo, 0), np.maximum(hi, 0)
        ),
        "translation-only": partial(solved, J, e, weights * down, d, lo, hi),
        "rotation-only": partial(solved, J, e, weights * (1 - down), d, lo, hi),
    }


# These are named above: with the start at 0 they give the same numbers.
SAME = ("clip-the-optimum", "no-limits", "full-hessian")
# No question of seven joints shows these, from 0.
UNSEEN = ("all-let-go", "few-rounds", "steepest-let-go", "stops-too-early",
          "upper-limits-passed")  # fmt: skip
row.reached_by("box_qp", but=(*SAME, *UNSEEN, "lower-only", "upper-only"))
row.at_least_0(weights="a weight is", damping="it is squared")


@row.right  # The damping as seven more rows.
def _(J, e, weights, damping, dq_lo, dq_hi):
    root = np.sqrt(weights)
    rows = np.vstack([root[:, None] * J, damping * np.eye(7)])
    right = np.concatenate([root * e, np.zeros(7)])
    H, g = rows.T @ rows, -rows.T @ right
    return box_qp(H, g, dq_lo, dq_hi, np.clip(np.linalg.solve(H, -g), dq_lo, dq_hi))


@row.wrong("not-at-every-size")  # The damping is 0.05 at least.
def _(J, e, weights, damping, dq_lo, dq_hi):
    return solved(J, e, weights, max(damping, 0.05) ** 2, dq_lo, dq_hi)


@row.wrong(
    "not-at-every-size", hidden="the numbers of the lab stay within its limits"
)  # A weight below 0.1 is 0.
def _(J, e, weights, damping, dq_lo, dq_hi):
    return solved(J, e, np.where(weights < 0.1, 0.0, weights), damping**2, dq_lo, dq_hi)


row.spans(  # as small, or as large, as in the lab
    e=(lambda e: 0.007 * e,),
    dq_lo=(lambda dq_lo: 0.1 * dq_lo,),
    dq_hi=(lambda dq_hi: 0.3 * dq_hi,),
)
