"""3.8 `manipulability(J)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Scalar

from .jacobians import OrNaN, near_singular, of_another_size

# Rank 5: row 6 is the sum of two. Rounding makes the determinant of J J^T, and the
# product of its eigenvalues, a bit less than 0 (with four ways to compute it).
_ROWS = """
-1 3 0 -3 3 3 0  -1 -2 2 -3 -3 3 0  -1 1 -3 1 -1 2 -1
-2 0 -1 1 1 -3 -3  0 2 1 -1 1 -2 -1  -1 0 3 -4 -2 1 -1
3 -3 1 1 -1 2 -1  -1 2 0 0 0 2 0  0 -3 3 0 -3 -2 2
0 -2 -3 2 -1 -1 -3  0 2 3 3 -2 2 -1  3 -5 -2 3 -2 1 -4
2 -1 2 1 0 -2 2  -1 2 2 -3 3 0 -1  3 -3 0 -1 -1 2 -1
-3 2 -1 -1 3 -2 -2  1 1 3 1 1 3 -3  -4 4 1 -4 6 -2 -3
"""
SINGULAR = np.array(_ROWS.split(), dtype=float).reshape(3, 6, 7) / 8.0


class Number(OrNaN, Scalar):
    """A number, or NaN."""


row = Row(Number(), tolerance=1e-6, held_out=[of_another_size()])


@row.inputs
def _(rng):
    first = np.hstack([np.diag([1.0, 2.0, 3.0, 1.0, 1.0, 1.0]), np.zeros((6, 1))])
    return [(J,) for J in (first, *SINGULAR, *near_singular(rng))]


def values(J):
    """Return the singular values."""
    return np.linalg.svd(J, compute_uv=False)


@row.wrongs
def _(J):
    """no-square-root: your result is det(J J^T), which is the product of the squared
      singular values. Return the square root of this determinant instead
    other-product: your result is 0 up to rounding, like the determinant of the 7x7
      matrix J^T J, which is always singular. Use J J^T or the six singular values of J
      instead
    largest-singular-value: your code returns the largest singular value of J. The
      result should be the product of all six singular values
    trace: your result is the square root of the trace of J J^T, which is the sum of the
      eigenvalues. The result should be the square root of the determinant, which is the
      product of the eigenvalues
    inverse-condition: your code returns the smallest singular value divided by the
      largest. The result should be the product of all six singular values
    square-part: your code uses only the first six columns of J. Use all seven columns
    position-only: your code uses only the three rows of v in J. Use all six rows
    zeros-left-out: your code leaves singular values of 0 out of the product. Include
      these values, because the product should be 0 if any singular value is 0
    """
    JJ = J @ J.T
    s = values(J)
    return {
        "no-square-root": np.linalg.det(JJ),
        "other-product": np.sqrt(abs(np.linalg.det(J.T @ J))),
        "largest-singular-value": s[0],
        "trace": np.sqrt(np.trace(JJ)),
        "inverse-condition": s[-1] / s[0],
        "square-part": abs(np.linalg.det(J[:, :6])),
        "position-only": values(J[3:]).prod(),
        "zeros-left-out": s[s > 1e-9].prod(),
    }


for determinant in (np.linalg.det, lambda A: np.prod(np.linalg.eigvalsh(A))):
    row.wrong(
        "nan-at-a-singularity",
        "your result is NaN for some singular J, because rounding makes det(J J^T) "
        "slightly negative. Clamp the determinant to at least 0 before you take the "
        "square root",
        hidden="rounding at q = 0 differs",
    )(lambda J, determinant=determinant: np.sqrt(determinant(J @ J.T)))


# det(J J^T) is no less than 0 but for its rounding, so either way is right: 6e-10 off.
@row.right
def _(J):
    return np.sqrt(max(np.linalg.det(J @ J.T), 0.0))


@row.right
def _(J):
    return np.sqrt(abs(np.linalg.det(J @ J.T)))


row.at_least_0(answer="a product of singular values")
row.same(
    "return (np.linalg.svd(J, compute_uv=False).prod()).astype(np.float32)",
    "it is below 0.2: float32's last digit is below what passes",
)
