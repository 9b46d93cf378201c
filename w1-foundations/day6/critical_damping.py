"""6.6 `critical_damping(K, Lambda)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Symmetric

from .states import model, states

row = Row(Symmetric((6, 6), scale=10.0))


def root(A):
    """Return the square root of a symmetric matrix."""
    values, vectors = np.linalg.eigh(A)
    return (vectors * np.sqrt(values)) @ vectors.T


@row.inputs
def _(rng):
    drawn = [(rng.numbers(10, 500, 6), model(now)[2]) for now in states(rng)]
    K, Lambda = drawn[0]
    light = (K, 0.004 * Lambda)
    stiff = (np.round(20.0 * K, 2), Lambda)
    slack = np.array([0.01, 0.2, 30.0, 0.5, 400.0, 0.02]), Lambda  # hardly any spring
    return [(np.full(6, 4.0), np.eye(6)), light, stiff, slack, *drawn]


def total(root_L, root_k):
    """Return the two products of the roots, in both orders."""
    return root_L * root_k + root_k[:, None] * root_L


def by_modes(K, L):
    """Critical in every mode: another D that does not ring."""
    low = np.linalg.cholesky(L)
    back = np.linalg.inv(low)
    k, W = np.linalg.eigh(back @ np.diag(K) @ back.T)
    Q = low @ W
    return 2.0 * Q @ np.diag(np.sqrt(k)) @ Q.T


@row.wrongs
def _(K, Lambda):
    """Lambda-ignored: your code returns 2 sqrt(K), which is the critical damping of a
      unit mass. Use the argument `Lambda` as well
    another-design: your result is another critically damped design, in which each mode
      of Lambda and K is damped separately. Multiply sqrt(Lambda) and sqrt(K) in both
      orders, and return the sum of the two products
    diagonal-only: your code uses only the diagonal of Lambda, as in 2 sqrt(k m) for
      each axis. Use the matrix square root of Lambda instead, because Lambda couples
      the axes
    one-order-only: your result is twice the same product of sqrt(Lambda) and sqrt(K).
      Add the products in both orders, so that the result is symmetric
    half-of-it: your code uses only one of the two products of sqrt(Lambda) and sqrt(K).
      Add the product with the factors in the opposite order
    factor-two: your result has an extra factor of 2. For scalars k and m, the sum of
      the two products is already 2 sqrt(k m)
    factor-two-missing: your result is the mean of the two products of sqrt(Lambda) and
      sqrt(K). Return the sum of the two products instead
    root-on-both-sides: your result is 2 sqrt(Lambda) sqrt(K) sqrt(Lambda), so it is
      proportional to the mass. The result should be proportional to the square root of
      the mass
    root-of-the-product: each entry of your result is twice the square root of the
      absolute value of the entry of diag(K) Lambda. Use the matrix square root of
      Lambda instead
    cholesky: your result contains a Cholesky factor L, which satisfies L L^T = Lambda.
      Use the matrix square root X instead, which satisfies X X = Lambda
    """
    k = np.sqrt(K)
    half = root(Lambda)
    low = np.linalg.cholesky(Lambda) * k
    return {
        "cholesky": low + low.T,
        "Lambda-ignored": np.diag(2.0 * k),
        "another-design": by_modes(K, Lambda),
        "diagonal-only": np.diag(2.0 * np.sqrt(K * np.diag(Lambda))),
        "one-order-only": 2.0 * half * k,
        "half-of-it": half * k,
        "factor-two": 2.0 * total(half, k),
        "factor-two-missing": 0.5 * total(half, k),
        "root-on-both-sides": 2.0 * half * k @ half,
        "root-of-the-product": 2.0 * np.sqrt(np.abs(np.diag(K) @ Lambda)),
    }


@row.wrongs
def _(K, Lambda):
    """entries-square-rooted: your result contains the square root of each entry of
      Lambda. Use the matrix square root X instead, which satisfies X X = Lambda
    eigenvectors-transposed: your square root of Lambda is V^T diag(sqrt(values)) V. It
      should be V diag(sqrt(values)) V^T, where the columns of V are the eigenvectors
    eigenvalues-not-rooted-back: your square root of Lambda is diag(sqrt(values)), which
      is expressed in the basis of the eigenvectors. Transform this matrix back with V,
      the matrix whose columns are the eigenvectors
    cholesky: your result contains a Cholesky factor L, which satisfies L L^T = Lambda.
      Use the matrix square root X instead, which satisfies X X = Lambda
    entries-square-rooted 2: your result contains the square root of the absolute value
      of each entry of Lambda. Use the matrix square root X instead, which satisfies X X
      = Lambda
    eigenvectors-transposed 2: your square root of Lambda is V diag(sqrt(values)) V. It
      should be V diag(sqrt(values)) V^T, where the columns of V are the eigenvectors
    """
    values, V = np.linalg.eigh(Lambda)
    roots = {
        "entries-square-rooted": np.sqrt(Lambda),
        "eigenvectors-transposed": V.T @ np.diag(np.sqrt(values)) @ V,
        "eigenvalues-not-rooted-back": np.diag(np.sqrt(values)),
        "cholesky": np.linalg.cholesky(Lambda),
        "entries-square-rooted 2": np.sqrt(np.abs(Lambda)),
        "eigenvectors-transposed 2": V @ np.diag(np.sqrt(values)) @ V,
    }
    return {slug: total(one, np.sqrt(K)) for slug, one in roots.items()}


@row.right  # The root by Newton's iteration (Denman and Beavers).
def _(K, Lambda):
    Y = Lambda.copy()
    Z = np.eye(6)
    for _ in range(40):
        Y, Z = (Y + np.linalg.inv(Z)) / 2, (Z + np.linalg.inv(Y)) / 2
    k = np.diag(np.sqrt(K))
    return Y @ k + k @ Y


row.at_least_0(K="a stiffness")


row.spans(  # as small, or as large, as in the lab
    Lambda=(lambda Lambda: 3 * Lambda,),
)
