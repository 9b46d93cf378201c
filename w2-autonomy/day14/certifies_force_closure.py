"""14.4 `certifies_force_closure(W, weights)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Mask, Row
from robo47.grasp import BALANCE, RANK

from .touched import AROUND, around, inwards, on_top, pushes, three

K = 4  # edges of each cone


def sure(W, weights):
    """Return whether an answer depends on no rounding."""
    s = np.linalg.svd(W, compute_uv=False)
    all_of_it = np.abs(W) @ np.abs(weights)
    left = np.abs(W @ weights)
    near = (left > 1e-3 * BALANCE * all_of_it) & (left < 1e3 * BALANCE * all_of_it)
    return bool(s[0] > 0 and not near.any() and np.abs(s[-1] / s[0] / RANK - 1) > 0.9)


row = Row(Mask(), at_edge=sure)


def line(mu):
    """Return the wrenches of two opposite contacts: no moment about their line."""
    return pushes(AROUND[2:], inwards(AROUND[2:]), mu, K)


@row.inputs
def _(rng):
    W = around(0.5, K)
    ones = np.ones(W.shape[1])
    beside = ones.copy()
    beside[0] += 1e-5
    ahead = W[:, :K].mean(axis=1)
    top = on_top(0.5, K)
    # A certificate, in any unit, with any weights that balance.
    yield W, ones
    yield 1e-4 * W, ones
    yield 1e5 * W, 1e3 * ones
    yield 1e-11 * around(0.4, K, 0.3), 5.0 * ones
    yield around(0.3, 5, 0.7, three()), np.ones(15)
    yield 1e5 * around(0.8, K, 0.7, three()), 900 * np.ones(12)
    yield W, np.repeat([1.0, 1, 3, 3], K)
    yield W, 1e-4 * ones
    yield np.round(100 * W), ones  # integers, whose sum is exactly 0
    # No certificate.
    yield line(0.5), np.ones(8)
    yield 1e9 * line(0.7), np.ones(8)
    nearly = line(0.5)
    nearly[1] = 1e-12 * np.tile([1.0, -1], 4)
    yield nearly, np.ones(8)
    beside_it = AROUND[2:] + np.array([0.01, 0.0, 0.02])  # ranks 3 and 3
    yield pushes(beside_it, inwards(AROUND[2:]), 0.5, K), np.ones(8)
    yield line(0.0), np.ones(8)
    yield top, np.ones(12)
    yield top, np.repeat([1.0, 1, 2], K)
    yield 1e-4 * on_top(0.9, 5), np.ones(15)
    yield W, -ones
    yield W, 0 * ones
    yield np.column_stack([W, ahead]), np.append(ones, 0.0)
    yield np.column_stack([W, ahead, ahead]), np.append(ones, [0.5, -0.5])
    for unit in (1e-4, 1.0, 1e5):
        yield unit * W, beside
    sums = W.sum(axis=0)
    mixed = ones.copy()  # the sum of all rows is 0
    mixed[1] += 0.5 * sums[6]
    mixed[6] -= 0.5 * sums[1]
    yield W, mixed
    raised = AROUND + np.outer([1, 0, 0, 0], [0, 0, 0.01])
    yield pushes(raised, inwards(AROUND), 0.5, K), ones
    # One row is in a far smaller unit: the remainder is a thousandth of it.
    small = np.hstack([np.eye(6), -np.eye(6)]) * np.r_[1e-7, np.ones(5)][:, None]
    uneven = np.r_[1.001, np.ones(11)]
    yield small, np.ones(12)
    yield small, uneven
    yield small, 1e-10 * uneven
    # Columns of other norms: the same cones, and weights that compensate.
    for i in range(4):
        size = rng.numbers(0.3, 3, 16)
        yield W / size, size
        if i % 2:
            yield around(0.5, K, float(rng.numbers(0.1, 0.6))), rng.numbers(0.5, 2, 16)
            yield line(0.5) / size[:8], size[:8]


IN_ONE_UNIT = "all rows and weights of the lab are of similar size"


@row.wrongs(
    hidden={"balance-of-all": IN_ONE_UNIT, "balance-without-weights": IN_ONE_UNIT}
)
def _(W, weights):
    """rank-only: your code tests only the rank. Test the weights and W w = 0 too,
      because the rank can be 6 even if all fingers press on one face
    balance-only: your code does not test the rank. Test that the rank is 6, because two
      fingers whose forces balance do not prevent a rotation about the line through the
      two contacts
    balance-and-rank-5: your code accepts rank 5. Require rank 6, because a wrench has
      six components
    zero-weights-do: your code accepts a weight of 0. Require every weight to be above 0
    zero-weights-do 2: your code accepts a weight of 0. Require every weight to be above
      0
    sign-forgotten: your code accepts weights below 0. Require every weight to be above
      0, because a finger cannot pull
    some-weight-above-0: your code accepts the weights if at least one weight is above
      0. Require every weight to be above 0
    balance-forgotten: your code does not test the condition W w = 0. Test this
      condition too, because the wrenches must balance
    balance-absolute: your code uses an absolute tolerance for W w, as in `np.allclose(W
      @ weights, 0)`. For each row, use 1e-9 times the sum of |W_ij w_j| in that row, so
      that the result does not depend on the units
    balance-roughly: your tolerance for W w is too large, for example 1e-4 times the sum
      of |W_ij w_j|. Use 1e-9 times this sum instead
    balance-of-all: your code uses one tolerance for all rows of W w. Compare each row
      with 1e-9 times its own sum of |W_ij w_j| instead
    first-row-only: your code tests only the first row of W w. Test all six rows
    balance-without-weights: your tolerance for each row of W w does not depend on the
      weights. For each row, use 1e-9 times the sum of |W_ij w_j| in that row instead
    rank-absolute: your code uses an absolute limit for the rank, such as 1e-9 for the
      singular values. Compare the singular values with 1e-9 times the largest one, so
      that the result does not depend on the units
    determinant: your code tests the rank with det(W W^T) or with another value that
      depends on the units. Compare the singular values with 1e-9 times the largest one
    nothing-may-be-left: your tolerance for W w is 0 or too small. Use 1e-9 times the
      sum of |W_ij w_j| in each row, because rounding can leave about 1e-16 of this sum
      even if the wrenches balance
    rank-by-rounding: your tolerance for the rank is too small, as NumPy's default
      tolerance is. Use 1e-9 times the largest singular value
    weights-not-used: your code tests the unweighted sum of the columns of W. Test W w
      instead
    forces-only: your code tests only the forces in W w. Test the moments too, because
      both must balance
    moments-only: your code tests only the moments in W w. Test the forces too, because
      both must balance
    sum-of-all: your code tests only the sum of all components of W w, so positive and
      negative components can cancel. Test each component separately
    always-true: your code always returns True. Test the rank, the weights and W w
    always-false: your code always returns False. Test the rank, the weights and W w
    """
    s = np.linalg.svd(W, compute_uv=False)
    rank = np.sum(s > RANK * s[0])
    full = rank == 6
    left = np.abs(W @ weights)
    all_of_it = np.abs(W) @ np.abs(weights)
    holds = left <= BALANCE * all_of_it
    balanced = holds.all()
    above = np.all(weights > 0)
    plain = np.abs(W.sum(axis=1)) <= BALANCE * np.abs(W).sum(axis=1)
    return {
        "rank-only": bool(full),
        "balance-only": bool(balanced and above),
        "balance-and-rank-5": bool(rank >= 5 and balanced and above),
        "zero-weights-do": bool(full and balanced and np.all(weights >= 0)),
        "zero-weights-do 2": bool(
            full and balanced and np.all(weights >= 0) and np.any(weights > 0)
        ),
        "sign-forgotten": bool(full and balanced),
        "some-weight-above-0": bool(full and balanced and np.any(weights > 0)),
        "balance-forgotten": bool(full and above),
        "balance-absolute": bool(full and above and np.all(left <= 1e-8)),
        "first-row-only": bool(full and above and holds[0]),
        "balance-roughly": bool(full and above and np.all(left <= 1e-4 * all_of_it)),
        "balance-of-all": bool(
            full
            and above
            and np.linalg.norm(left) <= BALANCE * np.linalg.norm(all_of_it)
        ),
        "balance-without-weights": bool(
            full and above and np.all(left <= BALANCE * np.abs(W).max(axis=1))
        ),
        "rank-absolute": bool(len(s) == 6 and s[-1] > 1e-9 and balanced and above),
        "determinant": bool(np.linalg.det(W @ W.T) >= 1e-9 and balanced and above),
        "nothing-may-be-left": bool(full and above and np.all(left == 0)),
        "rank-by-rounding": bool(np.linalg.matrix_rank(W) == 6 and balanced and above),
        "weights-not-used": bool(full and above and plain.all()),
        "forces-only": bool(full and above and holds[3:].all()),
        "moments-only": bool(full and above and holds[:3].all()),
        "sum-of-all": bool(
            full and above and abs((W @ weights).sum()) <= BALANCE * all_of_it.sum()
        ),
        "always-true": True,
        "always-false": False,
    }


row.at_least_0(answer="True or False")
row.same(
    "all_of_it = np.abs(W) @ np.abs(weights) => all_of_it = np.abs(W) @ weights",
    "with a weight below 0 the result is False anyway",
)
row.same(
    "first weights = np.maximum(weights, 0)", "a weight of 0 is no certificate either"
)
row.same(
    "if np.linalg.matrix_rank(W, rtol=1e-09) < 6: => "
    "if np.linalg.matrix_rank(W, rtol=2e-09) < 6:",
    "the singular values are rounding, or far above it",
)
_LEFT = "return bool(np.all(weights > 0) and np.all(left <= {}))"
for _more in ("0.5 * (1e-09 * all_of_it)", "10.0 * (1e-09 * all_of_it)",
              "2e-09 * all_of_it"):  # fmt: skip
    row.same(
        f"{_LEFT.format('1e-09 * all_of_it')} => {_LEFT.format(_more)}",
        "the remainder is rounding, or far above it",
    )


@row.right  # W is scaled first; the terms of each row are summed.
def _(W, weights):
    s = np.linalg.svd(W / np.abs(W).max())[1]
    if len(s) < 6 or s[5] <= 1e-9 * s[0] or min(weights) <= 0:
        return False
    terms = W * weights
    return all(abs(t.sum()) <= 1e-9 * abs(t).sum() for t in terms)


@row.right  # With Day 8's rank.
def _(W, weights):
    from robo47.identification import rank_and_condition

    rank, _ = rank_and_condition(W, 1e-9)
    left = np.abs(W @ weights) <= 1e-9 * (np.abs(W) @ np.abs(weights))
    return np.bool_(rank == 6 and left.all() and (weights > 0).all())
