"""13.6 `qp_ik(J, e, weights, damping, dq_lo, dq_hi)`: its questions, its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Row, Vector
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47.optimal import box_qp

from .asked import ARM

LAB = lab_of(find_day(13))  # its `box_qp` does not refuse limits that are swapped
row = Row(Vector((7,), "rad", names=tuple(f"joint{i}" for i in range(1, 8))))
HALF = np.roll(np.arange(6), 3)


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
    # Clipped and solved anew, one more is beyond; the rest is to be solved once more.
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
            low[3] = high[3] = 0  # a joint that stays
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
    """Return the best step with weights and a damping already squared."""
    right = weights if right is None else right
    H = J.T @ (weights[:, None] * J) + damp * np.eye(7)
    return box(H, -J.T @ (right * e), lo, hi, np.zeros(7))


@row.wrongs(hidden={"stands-still-allowed": "no joint of the lab is beyond its range"})
def _(J, e, weights, damping, dq_lo, dq_hi):
    """clip-after: Day 3's step, clipped; where one joint is held the others should take
      over => with the limits after the step
    scaled-back: all joints are slowed by one factor until each is within its limits;
      that gives up what the others could still do
    not-limited: the limits are left out
    lower-only: only the lower limits are kept
    upper-only: only the upper limits are kept
    limits-mirrored: the lower limit is taken to be minus the upper one => with -dq_hi
    limits-mirrored 2: the lower limit is taken to be minus the upper one, also where
      that is above it => with -dq_hi
    limits-mirrored 3: the upper limit is taken to be minus the lower one => with -dq_lo
    limits-swapped: the lower and the upper limit are swapped
    limits-1: the limits are taken to be -1 and 1
    damping-not-squared: the damping is added as it is; it is squared => with damping
      for its square
    damping-halved: the damping is halved; both parts of the cost have the same half
      => with damping^2 / 2
    damping-doubled: the damping is doubled; both parts of the cost have the same half
      => with 2 damping^2
    J-W-J-doubled: J^T W J is doubled, and J^T W e is not: both have the same half =>
      with 2 J^T W J
    weights-squared: the weights are squared: they stand in the cost as they are => with
      W^2
    weights-rooted: the weights are rooted: they stand in the cost as they are => with
      their roots
    weights-forgotten: the weights are missing => with weights 1
    weights-in-H-only: the weights are missing before e => with J^T e
    weights-in-g-only: the weights are missing in H => with J^T J
    weights-swapped: the weights of turns and translations are swapped: omega is above
      => with the weights' halves swapped
    weights-inverted: a weight is divided by; it multiplies => with 1 / weights
    e-halves-swapped: e's halves are swapped: omega is above => with e's halves swapped
    error-sign: the step goes away from the goal: g is -J^T W e => with +J^T W e
    e-halved: the step is half of it: H and g have the same half => with e / 2
    e-doubled: the step is twice of it: H and g have the same half => with 2 e
    clipped-twice: Day 3's step is clipped, what is left of e is tried once more and
      clipped again; joints that are held should be left out of it
    mean-weight-in-g: before e stands the mean of the weights; each row has its own
    first-weight: all rows have the first one's weight
    clip-after 2: Day 3's step, without weights, clipped; where one joint is held the
      others should take over
    damping-cubed: the damping is to the third power; it is squared
    damping-weighted: the mean weight multiplies the damping, too
    stands-still-allowed: the limits are widened until they have 0 between them; a joint
      beyond its range has to come back => with 0 within all limits
    translation-only: only the translation is looked at
    rotation-only: only the rotation is looked at
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
        "damping-not-squared": partial(solved, J, e, weights, damping, lo, hi),
        "damping-halved": partial(solved, J, e, weights, d / 2, lo, hi),
        "damping-doubled": partial(solved, J, e, weights, 2 * d, lo, hi),
        "J-W-J-doubled": partial(solved, J, e / 2, weights, d / 2, lo, hi),
        "weights-squared": partial(solved, J, e, weights**2, d, lo, hi),
        "weights-rooted": partial(solved, J, e, np.sqrt(weights), d, lo, hi),
        "weights-forgotten": partial(solved, J, e, np.ones(6), d, lo, hi),
        "weights-in-H-only": partial(solved, *given, lo, hi, np.ones(6)),
        "weights-in-g-only": partial(solved, J, e, np.ones(6), d, lo, hi, weights),
        "weights-swapped": partial(solved, J, e, weights[HALF], d, lo, hi),
        "weights-inverted": partial(solved, J, e, 1 / weights, d, lo, hi),
        "e-halves-swapped": partial(solved, J, e[HALF], weights, d, lo, hi),
        "error-sign": partial(solved, J, -e, weights, d, lo, hi),
        "e-halved": partial(solved, J, e / 2, weights, d, lo, hi),
        "e-doubled": partial(solved, J, 2 * e, weights, d, lo, hi),
        "mean-weight-in-g": partial(
            solved, *given, lo, hi, 0 * weights + weights.mean()
        ),
        "first-weight": partial(solved, J, e, 0 * weights + weights[0], d, lo, hi),
        "clip-after 2": lambda: np.clip(solved(J, e, np.ones(6), d, -far, far), lo, hi),
        "damping-cubed": partial(solved, J, e, weights, damping**3, lo, hi),
        "damping-weighted": partial(solved, J, e, weights, weights.mean() * d, lo, hi),
        "stands-still-allowed": partial(
            solved, *given, np.minimum(lo, 0), np.maximum(hi, 0)
        ),
        "translation-only": partial(solved, J, e, weights * down, d, lo, hi),
        "rotation-only": partial(solved, J, e, weights * (1 - down), d, lo, hi),
    }


# What is left out is named above: a start at 0 makes it one thing with these.
SAME = ("clip-the-optimum", "no-limits", "full-hessian", "g-sign", "half-missing")
# What no question of seven joints shows, from 0.
UNSEEN = ("all-let-go", "few-rounds", "start-not-clipped", "steepest-let-go",
          "stops-too-early", "upper-limits-passed")  # fmt: skip
row.reached_by("box_qp", but=(*SAME, *UNSEEN, "lower-only", "upper-only"))
row.at_least_0(weights="a weight is", damping="it is squared")


@row.right  # Seven more rows, and each joint best in its turn.
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
)  # A weight below 0.1 is none.
def _(J, e, weights, damping, dq_lo, dq_hi):
    return solved(J, e, np.where(weights < 0.1, 0.0, weights), damping**2, dq_lo, dq_hi)


row.spans(  # as small, or as large, as in the lab
    e=(lambda e: 0.007 * e,),
    dq_lo=(lambda dq_lo: 0.1 * dq_lo,),
    dq_hi=(lambda dq_hi: 0.3 * dq_hi,),
)
