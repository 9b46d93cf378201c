"""Mistakes in tasks 6.5 `spring_wrench` and 6.6 `critical_damping`."""

import numpy as np

from . import named, root

SPRING_WRENCH = [
    named(
        "spring-sign",
        "the spring pushes the hand away: e points to the target, so pull along it",
        lambda e, V, K, D: -K @ e + D @ V,
        "-K e + D V_err",
    ),
    named(
        "damper-sign",
        "the damper drives the hand on: V_err is the target's twist minus the hand's, "
        "so it is added",
        lambda e, V, K, D: K @ e - D @ V,
        "K e - D V_err",
    ),
    named(
        "damper-forgotten",
        "the damper is missing: the hand never comes to rest",
        lambda e, V, K, D: K @ e,
        "K e",
    ),
    named(
        "spring-forgotten",
        "the spring is missing: the hand stays wherever it is pushed",
        lambda e, V, K, D: D @ V,
        "D V_err",
    ),
    named(
        "spring-and-damper-swapped",
        "K and D have changed places",
        lambda e, V, K, D: D @ e + K @ V,
        "D e + K V_err",
    ),
    named(
        "diagonal-of-D",
        "only the diagonal of D is used; the six directions are coupled",
        lambda e, V, K, D: K @ e + np.diag(D) * V,
        "the right one with D's diagonal",
    ),
    named(
        "halves-swapped",
        "the halves of the answer are (force; moment); the moment comes first",
        lambda e, V, K, D: np.roll(K @ e + D @ V, 3),
        "the right one with its halves swapped",
    ),
    named(
        "millimetres",
        "the error is put into millimetres; here everything is in metres",
        lambda e, V, K, D: K @ (e * [1, 1, 1, 1000, 1000, 1000]) + D @ V,
        "the right one with e in mm",
    ),
    named(
        "half-a-spring",
        "the spring has a factor 1/2: that is its energy's, not its force's",
        lambda e, V, K, D: 0.5 * K @ e + D @ V,
        "the right one with K e / 2",
    ),
]

CRITICAL_DAMPING = [
    named(
        "Lambda-ignored",
        "Lambda is not used: 2 sqrt(K) is for a mass of 1 kg on each spring",
        lambda K, L: np.diag(2.0 * np.sqrt(K)),
        "diag(2 sqrt(K))",
    ),
    named(
        "another-design",
        "this does not ring either: you take Lambda and K to axes in which both are "
        "diagonal. Here the damping is the sum of two products of the roots of Lambda "
        "and K",
        lambda K, L: _by_modes(K, L),
        "that other design",
    ),
    named(
        "entries-square-rooted",
        "np.sqrt takes the root of every entry of Lambda; the root of a matrix is the "
        "one that, times itself, is the matrix",
        lambda K, L: _sum(np.sqrt(L), np.sqrt(K)),
        "the right one with np.sqrt(Lambda)",
    ),
    named(
        "entries-square-rooted",
        "np.sqrt takes the root of every entry of Lambda, NaN where it is negative; "
        "the root of a matrix is the one that, times itself, is the matrix",
        lambda K, L: (
            np.sqrt(L) @ np.diag(np.sqrt(K)) + np.diag(np.sqrt(K)) @ np.sqrt(L)
        ),
        "the right one with np.sqrt(Lambda)",
    ),
    named(
        "entries-square-rooted",
        "the root is taken of the size of every entry of Lambda; the root of a matrix "
        "is the one that, times itself, is the matrix",
        lambda K, L: _sum(np.sqrt(np.abs(L)), np.sqrt(K)),
        "the right one with np.sqrt(abs(Lambda))",
    ),
    named(
        "diagonal-only",
        "this is 2 sqrt(k m) for each axis alone; Lambda couples the axes",
        lambda K, L: np.diag(2.0 * np.sqrt(K * np.diag(L))),
        "the right one with Lambda's diagonal",
    ),
    named(
        "one-order-only",
        "the product of the two roots is taken in one order, twice; with both orders, "
        "once each, it is symmetric",
        lambda K, L: 2.0 * root(L) @ np.diag(np.sqrt(K)),
        "2 sqrt(Lambda) sqrt(K)",
    ),
    named(
        "one-order-only",
        "the product of the two roots is taken in one order, twice; with both orders, "
        "once each, it is symmetric",
        lambda K, L: 2.0 * np.diag(np.sqrt(K)) @ root(L),
        "2 sqrt(K) sqrt(Lambda)",
    ),
    named(
        "half-of-it",
        "the product of the two roots is there in one order only",
        lambda K, L: root(L) @ np.diag(np.sqrt(K)),
        "sqrt(Lambda) sqrt(K)",
    ),
    named(
        "factor-two",
        "there is a 2 too many: the two orders are the 2 already",
        lambda K, L: 2.0 * _sum(root(L), np.sqrt(K)),
        "twice the right one",
    ),
    named(
        "factor-two-missing",
        "half of it is missing: the two orders are added, not averaged",
        lambda K, L: 0.5 * _sum(root(L), np.sqrt(K)),
        "half of the right one",
    ),
    named(
        "K-not-rooted",
        "K is used as it is; its square root belongs there",
        lambda K, L: _sum(root(L), K),
        "the right one with K for its root",
    ),
    named(
        "Lambda-not-rooted",
        "Lambda is used as it is; its square root belongs there",
        lambda K, L: _sum(L, np.sqrt(K)),
        "the right one with Lambda for its root",
    ),
    named(
        "eigenvectors-transposed",
        "the eigenvectors are transposed: those of eigh are the columns, so the root "
        "is V diag V^T",
        lambda K, L: _sum(_turned(L), np.sqrt(K)),
        "the right one with V^T diag V",
    ),
    named(
        "eigenvalues-not-rooted-back",
        "the root is left in the eigenvectors' axes: diag(sqrt(values)) has to be "
        "turned back",
        lambda K, L: _sum(np.diag(np.sqrt(np.linalg.eigvalsh(L))), np.sqrt(K)),
        "the right one with diag(sqrt(values))",
    ),
    named(
        "cholesky",
        "a Cholesky factor is no square root: it is L L^T, not L L, that is Lambda",
        lambda K, L: _sum(np.linalg.cholesky(L), np.sqrt(K)),
        "the right one with the Cholesky factor",
    ),
    named(
        "root-of-inverse",
        "the root is that of Lambda's inverse",
        lambda K, L: _sum(np.linalg.inv(root(L)), np.sqrt(K)),
        "the right one with the inverse root",
    ),
    named(
        "root-of-the-product",
        "this is 2 sqrt(K Lambda), entry by entry",
        lambda K, L: 2.0 * np.sqrt(np.abs(np.diag(K) @ L)),
        "2 sqrt(abs(K Lambda))",
    ),
]


def _sum(root_L, root_k):
    return root_L * root_k + root_k[:, None] * root_L


def _by_modes(K, L):
    """Critical in every mode: another D that does not ring."""
    low = np.linalg.cholesky(L)
    back = np.linalg.inv(low)
    k, W = np.linalg.eigh(back @ np.diag(K) @ back.T)
    Q = low @ W
    return 2.0 * Q @ np.diag(np.sqrt(k)) @ Q.T


def _turned(L):
    values, V = np.linalg.eigh(L)
    return V.T @ np.diag(np.sqrt(values)) @ V
