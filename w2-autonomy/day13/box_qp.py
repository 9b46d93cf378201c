"""13.5 `box_qp(H, f, lo, hi, x)`: its questions and its mistakes."""

import itertools
from functools import partial

import numpy as np

from labkit.judge import Row, Vector
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47.optimal import box_qp

from .asked import ARM, boxed, problems

LAB = lab_of(find_day(13))  # for `first_limit`, which is given to the student
row = Row(Vector((None,)))


@row.inputs
def _(rng):
    one = np.ones(3)
    case = (np.array([[2.0, 1], [1, 2]]), np.array([-2.0, -10]), -one[:2], one[:2])
    H = np.array([[23.0, 15, 21], [15, 14, 13], [21, 13, 23]])
    circling = (H, np.array([9.0, -2, 6]), -one, one, np.array([0.0, 0, -1]))
    best = [
        (H, f, lo, hi, np.round(x + 0.7, 3)) for H, f, lo, hi, x in problems(rng, 4)
    ]
    # Steps by H's diagonal alone end at corners; short gradient steps converge.
    alike = 0.2 * np.eye(3) + 0.8
    wide = (alike, np.array([1.0, -2, 0.5]), -9 * one, 9 * one, np.zeros(3))
    flat = 0.05 * np.eye(2) + 0.95  # coordinate descent needs hundreds of sweeps
    long = (flat, np.array([1.0, -1]), -30 * one[:2], 30 * one[:2], np.zeros(2))
    found = [*best, *boxed(rng)]
    first = [(*case, np.zeros(2)), circling, wide, long, of_the_arm()]
    return [*first, *typed(), *found]


@row.spans
def _(rng):  # the damping of the lab, 0.005
    _, _, lo, hi, x = of_the_arm()
    J = np.round(ARM.at(np.array([0, 0, 0, -1.57, 0, 1.57, 0.8])).J_site, 3)
    H = J.T @ J + 0.005**2 * np.eye(7)
    yield H, -J.T @ np.array([0.01, 0.02, 0, 0.05, -0.03, 0.02]), lo, hi, x


def of_the_arm():
    """Return a problem as in 13.6 with a small damping: a large condition number."""
    J = np.array([
        [0.0, 0.6, 0.0, -0.7, 0.1, 0.9, 0.1],
        [0.0, 0.8, 0.0, -0.7, -0.6, 0.4, -0.9],
        [1.0, 0.0, 0.8, 0.1, 0.7, 0.0, -0.4],
        [0.1, 0.3, 0.1, 0.2, 0.0, 0.2, 0.0],
        [0.5, 0.0, 0.5, 0.0, 0.2, 0.0, 0.0],
        [0.0, -0.5, 0.0, 0.5, 0.0, 0.2, 0.0],
    ])  # fmt: skip
    H = J.T @ J + 0.05**2 * np.eye(7)
    f = np.array([-0.042, 1.203, -0.026, -0.814, -0.963, 0.377, -1.349])
    limit = np.array([1.8, 1.1, 1.4, 2.5, 2.0, 2.9, 1.3])
    return np.round(H, 6), f, -limit, limit, np.zeros(7)


def typed():
    """Return cases that random problems rarely contain."""
    # The second entry is held at its upper bound and would leave it by 3e-5.
    H = np.array([[0.89, -0.26, 0.78], [-0.26, 0.89, -0.37], [0.78, -0.37, 1.21]])
    f = np.array([1.9, -0.40597, -2.2])
    lo, hi = np.array([-2.3, -0.1, 0.0]), np.array([-1.8, 0.2, 1.0])
    hardly = (H, f, lo, hi, lo.copy())
    # Two entries are held; the one with the larger gradient is to be released.
    H = np.array([[0.45, -0.7], [-0.7, 2.2]])
    lo, hi = np.array([-2.4, -0.4]), np.array([-1.3, 0.3])
    steeper = (H, np.array([-1.5, 0.8]), lo, hi, np.array([-1.4, 0.8]))
    # The same, after more iterations.
    H = np.array([
        [1.78, 0.36, 0.49, -0.49],
        [0.36, 2.19, 0.6, 1.43],
        [0.49, 0.6, 0.59, 0.29],
        [-0.49, 1.43, 0.29, 1.85],
    ])  # fmt: skip
    lo, hi = np.array([-1.5, -1.2, -1.2, -2.3]), np.array([-1.1, -0.2, -0.4, -1.9])
    start = np.array([2.0, -1.5, -1.5, 0.4])
    later = (H, np.array([-3.9, -1.6, -3.3, -1.4]), lo, hi, start)
    # The start is outside: below one bound and above another.
    H = np.array([[2.08, -0.52], [-0.52, 1.34]])
    lo, hi = np.array([-1.0, -1.2]), np.array([-0.2, -0.8])
    outside = (H, np.array([2.9, 1.0]), lo, hi, np.array([-3.0, 2.1]))
    # Ten iterations are too few for this problem.
    H = np.array([
        [1.47, 1.46, -0.51, 0.81, 0.08],
        [1.46, 2.27, 0.0, 1.31, -0.6],
        [-0.51, 0.0, 1.94, -0.03, -1.75],
        [0.81, 1.31, -0.03, 1.88, 0.23],
        [0.08, -0.6, -1.75, 0.23, 2.79],
    ])  # fmt: skip
    lo = np.array([-1.3, -1.6, -2.4, -0.8, -2.4])
    hi = np.array([-0.8, -1.3, -0.9, -0.5, -1.0])
    often = (H, np.array([2.0, 2.4, 2.9, -1.2, 1.7]), lo, hi, lo.copy())
    # Clamped and solved again, another entry is beyond a bound: solve the rest again.
    H = np.array([
        [2.1, 0.7, -2.8, 2.7],
        [0.7, 0.9, -1.8, 0.5],
        [-2.8, -1.8, 5.5, -4.1],
        [2.7, 0.5, -4.1, 7.6],
    ])  # fmt: skip
    one = np.ones(4)
    again = (H, np.array([-0.1, -2.2, 1.7, 1.8]), -one, one, 0 * one)
    return [hardly, steeper, later, outside, often, again]


def newton(H, f, lo, hi, x, n=50, frees="pushed", full=False):
    """Return x after Newton steps on the free entries, each clamped."""
    x = np.clip(x, lo, hi)
    for _ in range(n):
        slope = H @ x + f
        below, above = x <= lo, x >= hi
        held = (below & (slope > 0)) | (above & (slope < 0))
        if frees == "wrong":
            held = (below & (slope < 0)) | (above & (slope > 0))
        if frees == "never":
            held = below | above
        free = ~held
        step = np.zeros(len(x))
        if full:
            step = np.where(free, np.linalg.solve(H, -slope), 0.0)
        else:
            step[free] = np.linalg.solve(H[np.ix_(free, free)], -slope[free])
        x = np.clip(x + step, lo, hi)
    return x


def slid(H, f, lo, hi, x, n, by):
    """Return x after n gradient steps, each clamped."""
    x = np.clip(x, lo, hi)
    for _ in range(n):
        x = np.clip(x - by * (H @ x + f), lo, hi)
    return x


def solved_once_more(H, f, lo, hi, x):
    """Return the clamped minimiser, its free entries solved again and clamped."""
    x = np.clip(np.linalg.solve(H, -f), lo, hi)
    free = (x > lo) & (x < hi)
    right = -(H @ x + f)[free]
    x[free] += np.linalg.solve(H[np.ix_(free, free)], right)
    return np.clip(x, lo, hi)


def clipped_for_good(H, f, lo, hi, x):
    """Return the clamped minimiser, solved again while others meet a bound."""
    x = np.array(x, float)
    free = np.ones(len(x), bool)
    while free.any():
        right = -(f + H[:, ~free] @ x[~free])[free]
        x[free] = np.linalg.solve(H[np.ix_(free, free)], right)
        met = (x < lo) | (x > hi)
        x = np.clip(x, lo, hi)
        if not met.any():
            break
        free &= ~met
    return x


def swept(H, f, lo, hi, x, n):
    """Return x after n sweeps of coordinate descent."""
    x = np.clip(x, lo, hi).astype(float)
    for _ in range(n):
        for i in range(len(x)):
            x[i] = np.clip(x[i] - (H[i] @ x + f[i]) / H[i, i], lo[i], hi[i])
    return x


def guessed(
    H, f, lo, hi, x, *, rounds=100, enough=1e-12, lets_go="most", way=None,
    high=0.0,
):  # fmt: skip
    """Return x of the lab's own method, with other parts.

    Args:
        H, f, lo, hi, x: as the function has them.
        rounds: how many are made at most.
        enough: by how much a held entry may still move at the end.
        lets_go: "most" lets the one go that leaves most; "all" all; "steepest" the one
            with the largest slope.
        way: the step of the free entries, of x and which they are.
        high: is added to the upper limits on the way.
    """
    x = np.clip(x, lo, hi)
    held = lo == hi
    for _ in range(rounds):
        free = ~held
        slope = H @ x + f
        step = np.zeros(len(x))
        if way is None:
            step[free] = np.linalg.solve(H[np.ix_(free, free)], -slope[free])
        else:
            step[free] = way(x, free)
        x, met = LAB.first_limit(x, step, lo, hi + high)
        if met is not None:
            held[met] = True
            continue
        slope = H @ x + f
        leaves = np.abs(x - np.clip(x - slope, lo, hi))
        if leaves.max() < enough:
            break
        if lets_go == "all":
            held = lo == hi
        else:
            sizes = np.abs(np.where(held, slope, 0.0))
            held[np.argmax(leaves if lets_go == "most" else sizes)] = False
    return x


def held_for_good(H, f, lo, hi, x, own=True, from_start=False):
    """Return x where an entry that met a bound is never released."""
    x = np.clip(x, lo, hi)
    held = (x <= lo) | (x >= hi) if from_start else lo == hi
    for _ in range(len(x) + 1):
        free = ~held
        right = -(H @ x + f)[free] if own else -f[free]
        step = np.zeros(len(x))
        step[free] = np.linalg.solve(H[np.ix_(free, free)], right)
        if not own:
            step[free] -= x[free]
        room = np.where(step > 0, hi - x, lo - x)
        share = np.divide(room, step, out=np.full_like(x, np.inf), where=step != 0)
        met = np.argmin(share)
        x = np.clip(x + min(share[met], 1.0) * step, lo, hi)
        if share[met] >= 1:
            break
        held[met] = True
    return x


@row.wrongs(hidden={"stops-too-early": "no held entry of the lab moves so little"})
def _(H, f, lo, hi, x):
    """clip-the-optimum: your code clamps the unconstrained minimiser to the bounds.
      Solve again for the other entries, because their optimal values can change if one
      entry is held at a bound
    no-limits: your code returns the unconstrained minimiser -H^-1 f. Return the
      minimiser within the bounds instead
    scaled-back: your code stops at the first bound on the way to the unconstrained
      minimiser. Hold the entry at this bound, and continue with the other entries
    solved-once-more: your code clamps the unconstrained minimiser and solves for the
      free entries only once. This is not enough, because the new solution may violate
      the bound of another entry, or a held entry may have to be released
    clipped-for-good: your code never releases an entry that it has clamped. Release a
      held entry if its component of the negative gradient points into the box
    held-for-good: your code never releases an entry that is held at a bound, or it
      releases the wrong entry. Release a held entry if its component of the negative
      gradient points into the box
    held-for-good 2: your code holds every entry that is at a bound at the start or
      meets one, and never releases it. Release a held entry if its component of the
      negative gradient points into the box
    steepest-let-go: your code releases the held entry with the largest absolute
      gradient. Release the entry that the clamped step of task 13.4 moves most
    all-let-go: your code releases all held entries in the same iteration, so they can
      return to the same bounds. Release only the entry that would move most
    stops-too-early: your code stops although a held entry would still move by up to
      1e-4. Use a smaller tolerance
    few-rounds: your code stops after ten iterations, which is not enough for some
      problems. Continue until no held entry has to be released
    upper-limits-passed: your code takes steps that violate the upper bounds. End each
      step at the first bound that it meets
    held-by-place: your code holds every entry that is at a bound. Release a held entry
      if its component of the negative gradient points into the box
    frees-the-wrong-ones: your code holds the wrong entries. Hold an entry at a bound
      only if its component of the negative gradient points out of the box
    held-left-out: when your code solves for the free entries, the right-hand side omits
      the contribution of the held entries. Include it, because the gradient of the free
      entries also depends on the held entries
    held-left-out 2: when your code solves for the free entries, the right-hand side
      omits the contribution of the held entries. Include it, because the gradient of
      the free entries also depends on the held entries
    one-step: your code takes only one clamped Newton step. Solve again for the other
      entries, because their optimal values can change if one entry is held at a bound
    full-hessian: your code uses the whole matrix H for each step. Omit the rows and
      columns of the held entries, because these entries do not move
    whole-steps: your code clamps the full Newton step of the free entries, so x can
      alternate between two points. End the step at the first bound, or halve the step
      until the cost falls
    diagonal-hessian: your code divides the gradient by the diagonal of H. Solve with
      the submatrix of H for the free entries instead
    gradient-steps: your code stops after 100 clamped gradient steps, which are too few
      for some problems. Repeat the steps until x no longer changes
    gradient-steps 2: your code takes clamped gradient steps with a fixed step size of
      0.1. With this step size, the iteration does not converge for every H. Use the
      reciprocal of the largest eigenvalue of H instead, and repeat the steps until x no
      longer changes
    diagonal-hessian 2: your code divides the gradient by the diagonal of H. Solve with
      the submatrix of H for the free entries instead
    gradient-steps 3: your code stops after 1,000 clamped gradient steps, which are too
      few if the condition number of H is large. Solve for the free entries instead
    one-gradient-step: your code takes only one clamped gradient step. Divide the
      gradient by the largest eigenvalue of H and repeat the steps until x no longer
      changes, or solve for the free entries
    steps-too-long: your code takes clamped gradient steps with the step size 1, which
      may not converge. Divide the gradient by the largest eigenvalue of H, and repeat
      the steps until x no longer changes
    few-sweeps: your code stops after 100 sweeps of coordinate descent, which are too
      few for some problems. Repeat the sweeps until x no longer changes
    one-sweep: your code makes only one sweep of coordinate descent. Repeat the sweeps,
      because a change of a later entry can change the optimal values of the earlier
      entries
    lower-only: your code applies only the lower bounds. Apply the upper bounds too
    upper-only: your code applies only the upper bounds. Apply the lower bounds too
    start-returned: your code returns the start point, clamped to the bounds. Return the
      minimiser within the bounds instead
    """
    given = (H, f, lo, hi, x)
    free = np.linalg.solve(H, -f)
    far = 1e6 * np.ones(len(x))
    short = 1 / np.linalg.eigvalsh(H)[-1]

    def solve(of, right):
        return np.linalg.solve(H[np.ix_(of, of)], right)

    start = np.clip(x, lo, hi)
    way = free - start
    room = np.where(way > 0, hi - start, lo - start)
    share = np.divide(room, way, out=np.ones(len(x)), where=way != 0)
    return {
        "clip-the-optimum": np.clip(free, lo, hi),
        "no-limits": free,
        "scaled-back": start + min(1.0, share.min()) * way,
        "solved-once-more": partial(solved_once_more, *given),
        "clipped-for-good": partial(clipped_for_good, *given),
        "held-for-good": partial(held_for_good, *given),
        "held-for-good 2": partial(held_for_good, *given, from_start=True),
        "steepest-let-go": partial(guessed, *given, lets_go="steepest"),
        "all-let-go": partial(guessed, *given, lets_go="all"),
        "stops-too-early": partial(guessed, *given, enough=1e-4),
        "few-rounds": partial(guessed, *given, rounds=10),
        "upper-limits-passed": partial(guessed, *given, high=np.inf),
        "held-by-place": partial(newton, *given, frees="never"),
        "frees-the-wrong-ones": partial(newton, *given, frees="wrong"),
        "held-left-out": partial(held_for_good, *given, own=False),
        "held-left-out 2": partial(
            guessed, *given, way=lambda x, free: solve(free, -f[free]) - x[free]
        ),
        "one-step": partial(newton, *given, n=1),
        "full-hessian": partial(newton, *given, full=True),
        "whole-steps": partial(newton, *given),
        "diagonal-hessian": partial(slid, *given, 100, 1 / np.diag(H)),
        "gradient-steps 2": partial(slid, *given, 1_000, 0.1),
        "diagonal-hessian 2": partial(
            guessed, *given, way=lambda x, free: -(H @ x + f)[free] / np.diag(H)[free]
        ),
        "gradient-steps": partial(slid, *given, 100, short),
        "gradient-steps 3": partial(slid, *given, 1_000, short),
        "one-gradient-step": np.clip(x - (H @ x + f), lo, hi),
        "steps-too-long": partial(slid, *given, 100, 1.0),
        "few-sweeps": partial(swept, *given, 100),
        "one-sweep": partial(swept, *given, 1),
        "lower-only": partial(box_qp, H, f, lo, far, x),
        "upper-only": partial(box_qp, H, f, -far, hi, x),
        "start-returned": start,
    }


EARLY = "an entry that would move by less is at the minimiser"
ANYWHERE = "the minimiser is the same from any start"
row.same(
    "for _ in range(100): => for _ in range(200):", "five entries need ten iterations"
)
row.same("if leaves.max() < 1e-12: => if leaves.max() < 0.5 * 1e-12:", EARLY)
row.same("if leaves.max() < 1e-12: => if leaves.max() < 10.0 * 1e-12:", EARLY)
row.same("if leaves.max() < 1e-12: => if leaves.max() < 2e-12:", EARLY)
row.same("first x = np.abs(x)", ANYWHERE)
row.same("first x = np.maximum(x, 0)", ANYWHERE)
row.same("first x = np.clip(x, -1, 1)", ANYWHERE)


@row.right  # All 3^n active sets.
def _(H, f, lo, hi, x):
    best = None
    least = np.inf
    for where in itertools.product((-1, 0, 1), repeat=len(f)):
        side = np.array(where)
        there = np.where(side < 0, lo, hi).astype(float)
        free = side == 0
        right = -(f + H[:, ~free] @ there[~free])[free]
        there[free] = np.linalg.solve(H[np.ix_(free, free)], right)
        cost = there @ H @ there / 2 + f @ there
        inside = np.all(there >= lo - 1e-12) and np.all(there <= hi + 1e-12)
        if inside and cost < least:
            best = there
            least = cost
    return best


# Two thousand sweeps of coordinate descent.
@row.wrong("not-at-every-size", hidden="the boxes of the lab are not so flat")
def _(H, f, lo, hi, x):
    x = np.clip(x, lo, hi).astype(float)
    for _ in range(2_000):
        before = x.copy()
        for i in range(len(x)):
            there = x[i] - (H[i] @ x + f[i]) / H[i, i]
            x[i] = min(max(there, lo[i]), hi[i])
        if np.array_equal(before, x):
            break
    return x


@row.right  # Gradient steps of 1 over the largest eigenvalue.
def _(H, f, lo, hi, x):
    x = np.clip(x, lo, hi)
    short = 1 / np.linalg.eigvalsh(H)[-1]
    for _ in range(12_000):
        before = x
        x = np.clip(x - short * (H @ x + f), lo, hi)
        if np.array_equal(before, x):
            break
    return x


row.spans(  # as small, or as large, as in the lab
    H=(lambda H: 0.1 * H,),
    f=(lambda f: 0.001 * f,),
    hi=(lambda hi: 0.05 * hi,),
)
