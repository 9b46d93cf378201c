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
    """Lambda-ignored: Lambda is not used: 2 sqrt(K) is for a mass of 1 kg on each
      spring => diag(2 sqrt(K))
    another-design: this does not ring either: you take Lambda and K to axes in which
      both are diagonal. Here the damping is the sum of two products of the roots of
      Lambda and K => that other design
    diagonal-only: this is 2 sqrt(k m) for each axis alone; Lambda couples the axes =>
      the right one with Lambda's diagonal
    one-order-only: the product of the two roots is taken in one order, twice; with both
      orders, once each, it is symmetric => 2 sqrt(Lambda) sqrt(K)
    half-of-it: the product of the two roots is there in one order only => sqrt(Lambda)
      sqrt(K)
    factor-two: there is a 2 too many: the two orders are the 2 already
    factor-two-missing: half of it is missing: the two orders are added, not averaged
    K-not-rooted: K is used as it is; its square root belongs there
    root-on-both-sides: the root of K stands between two roots of Lambda: that grows
      with the mass, where a damping grows with its root => 2 sqrt(Lambda) sqrt(K)
      sqrt(Lambda)
    root-of-the-product: this is 2 sqrt(K Lambda), entry by entry => 2 sqrt(abs(K
      Lambda))
    one-order-only 2: the product of the two roots is taken in one order, twice; with
      both orders, once each, it is symmetric => 2 sqrt(K) sqrt(Lambda)
    cholesky: a Cholesky factor is no square root: it is L L^T, not L L, that is Lambda
      => L sqrt(K) + sqrt(K) L^T
    entries-square-rooted: np.sqrt takes the root of every entry of Lambda, NaN where it
      is negative; the root of a matrix is the one that, times itself, is the matrix =>
      the right one with np.sqrt(Lambda)
    no-roots: the square roots are missing: this grows with K, where a damping grows
      with its root => Lambda K + K Lambda
    """
    k = np.sqrt(K)
    half = root(Lambda)
    entries = np.sqrt(Lambda)
    low = np.linalg.cholesky(Lambda) * k
    return {
        "one-order-only 2": 2.0 * k[:, None] * half,
        "cholesky": low + low.T,
        "entries-square-rooted": entries @ np.diag(k) + np.diag(k) @ entries,
        "Lambda-ignored": np.diag(2.0 * k),
        "another-design": by_modes(K, Lambda),
        "diagonal-only": np.diag(2.0 * np.sqrt(K * np.diag(Lambda))),
        "one-order-only": 2.0 * half * k,
        "half-of-it": half * k,
        "factor-two": 2.0 * total(half, k),
        "factor-two-missing": 0.5 * total(half, k),
        "K-not-rooted": total(half, K),
        "root-on-both-sides": 2.0 * half * k @ half,
        "root-of-the-product": 2.0 * np.sqrt(np.abs(np.diag(K) @ Lambda)),
        "no-roots": total(Lambda, K),
    }


@row.wrongs
def _(K, Lambda):
    """Lambda-not-rooted: Lambda is used as it is; its square root belongs there
    entries-square-rooted: np.sqrt takes the root of every entry of Lambda; the root of
      a matrix is the one that, times itself, is the matrix
    eigenvectors-transposed: the eigenvectors are transposed: those of eigh are the
      columns, so the root is V diag V^T => the right one with V^T diag V
    eigenvalues-not-rooted-back: the root is left in the eigenvectors' axes:
      diag(sqrt(values)) has to be turned back => the right one with diag(sqrt(values))
    cholesky: a Cholesky factor is no square root: it is L L^T, not L L, that is Lambda
    root-of-inverse: the root is that of Lambda's inverse
    entries-square-rooted 2: the root is taken of the size of every entry of Lambda; the
      root of a matrix is the one that, times itself, is the matrix => the right one
      with np.sqrt(abs(Lambda))
    eigenvectors-transposed 2: the last transpose is missing: the root is V diag V^T
    """
    values, V = np.linalg.eigh(Lambda)
    roots = {
        "Lambda-not-rooted": Lambda,
        "entries-square-rooted": np.sqrt(Lambda),
        "eigenvectors-transposed": V.T @ np.diag(np.sqrt(values)) @ V,
        "eigenvalues-not-rooted-back": np.diag(np.sqrt(values)),
        "cholesky": np.linalg.cholesky(Lambda),
        "root-of-inverse": np.linalg.inv(root(Lambda)),
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
