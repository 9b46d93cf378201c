"""6.6 `critical_damping(K, Lambda)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Symmetric, draw
from labkit.judge.row import Row

from .states import (
    model,
    states,
)

row = Row(Symmetric((6, 6), scale=10.0))


def root(A):
    """Return the square root of a symmetric matrix."""
    values, vectors = np.linalg.eigh(A)
    return (vectors * np.sqrt(values)) @ vectors.T


@row.inputs
def _(rng):
    drawn = [(draw.numbers(rng, 10, 500, 6), model(now)[2]) for now in states(rng)]
    K, Lambda = drawn[0]
    light, stiff = (K, 0.004 * Lambda), (np.round(20.0 * K, 2), Lambda)
    slack = np.array([0.0, 0.2, 30.0, 0.5, 400.0, 0.0]), Lambda  # hardly any spring
    return [(np.full(6, 4.0), np.eye(6)), light, stiff, slack, *drawn]


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


@row.wrong
def Lambda_ignored(K, Lambda):
    """Lambda is not used: 2 sqrt(K) is for a mass of 1 kg on each spring => diag(2
    sqrt(K))"""
    return np.diag(2.0 * np.sqrt(K))


@row.wrong
def another_design(K, Lambda):
    """this does not ring either: you take Lambda and K to axes in which both are
    diagonal. Here the damping is the sum of two products of the roots of Lambda and K
    => that other design"""
    return _by_modes(K, Lambda)


@row.wrong
def entries_square_rooted(K, Lambda):
    """np.sqrt takes the root of every entry of Lambda; the root of a matrix is the one
    that, times itself, is the matrix => the right one with np.sqrt(Lambda)"""
    return _sum(np.sqrt(Lambda), np.sqrt(K))


@row.wrong
def entries_square_rooted(K, Lambda):
    """np.sqrt takes the root of every entry of Lambda, NaN where it is negative; the
    root of a matrix is the one that, times itself, is the matrix => the right one with
    np.sqrt(Lambda)"""
    return np.sqrt(Lambda) @ np.diag(np.sqrt(K)) + np.diag(np.sqrt(K)) @ np.sqrt(Lambda)


@row.wrong
def entries_square_rooted(K, Lambda):
    """the root is taken of the size of every entry of Lambda; the root of a matrix is
    the one that, times itself, is the matrix => the right one with
    np.sqrt(abs(Lambda))"""
    return _sum(np.sqrt(np.abs(Lambda)), np.sqrt(K))


@row.wrong
def diagonal_only(K, Lambda):
    """this is 2 sqrt(k m) for each axis alone; Lambda couples the axes => the right one
    with Lambda's diagonal"""
    return np.diag(2.0 * np.sqrt(K * np.diag(Lambda)))


@row.wrong
def one_order_only(K, Lambda):
    """the product of the two roots is taken in one order, twice; with both orders, once
    each, it is symmetric => 2 sqrt(Lambda) sqrt(K)"""
    return 2.0 * root(Lambda) @ np.diag(np.sqrt(K))


@row.wrong
def one_order_only(K, Lambda):
    """the product of the two roots is taken in one order, twice; with both orders, once
    each, it is symmetric => 2 sqrt(K) sqrt(Lambda)"""
    return 2.0 * np.diag(np.sqrt(K)) @ root(Lambda)


@row.wrong
def half_of_it(K, Lambda):
    """the product of the two roots is there in one order only => sqrt(Lambda)
    sqrt(K)"""
    return root(Lambda) @ np.diag(np.sqrt(K))


@row.wrong
def factor_two(K, Lambda):
    """there is a 2 too many: the two orders are the 2 already => twice the right one"""
    return 2.0 * _sum(root(Lambda), np.sqrt(K))


@row.wrong
def factor_two_missing(K, Lambda):
    """half of it is missing: the two orders are added, not averaged => half of the
    right one"""
    return 0.5 * _sum(root(Lambda), np.sqrt(K))


@row.wrong
def K_not_rooted(K, Lambda):
    """K is used as it is; its square root belongs there => the right one with K for its
    root"""
    return _sum(root(Lambda), K)


@row.wrong
def Lambda_not_rooted(K, Lambda):
    """Lambda is used as it is; its square root belongs there => the right one with
    Lambda for its root"""
    return _sum(Lambda, np.sqrt(K))


@row.wrong
def eigenvectors_transposed(K, Lambda):
    """the eigenvectors are transposed: those of eigh are the columns, so the root is V
    diag V^T => the right one with V^T diag V"""
    return _sum(_turned(Lambda), np.sqrt(K))


@row.wrong
def eigenvectors_transposed(K, Lambda):
    """the last transpose is missing: the root is V diag V^T => the right one with V
    diag V"""
    values, V = np.linalg.eigh(Lambda)
    return _sum(V @ np.diag(np.sqrt(values)) @ V, np.sqrt(K))


@row.wrong
def eigenvalues_not_rooted_back(K, Lambda):
    """the root is left in the eigenvectors' axes: diag(sqrt(values)) has to be turned
    back => the right one with diag(sqrt(values))"""
    return _sum(np.diag(np.sqrt(np.linalg.eigvalsh(Lambda))), np.sqrt(K))


@row.wrong
def cholesky(K, Lambda):
    """a Cholesky factor is no square root: it is L L^T, not L L, that is Lambda => the
    right one with the Cholesky factor"""
    return _sum(np.linalg.cholesky(Lambda), np.sqrt(K))


@row.wrong
def cholesky(K, Lambda):
    """a Cholesky factor is no square root: it is L L^T, not L L, that is Lambda => L
    sqrt(K) + sqrt(K) L^T"""
    half = np.linalg.cholesky(Lambda) * np.sqrt(K)
    return half + half.T


@row.wrong
def root_of_inverse(K, Lambda):
    """the root is that of Lambda's inverse => the right one with the inverse root"""
    return _sum(np.linalg.inv(root(Lambda)), np.sqrt(K))


@row.wrong
def root_of_the_product(K, Lambda):
    """this is 2 sqrt(K Lambda), entry by entry => 2 sqrt(abs(K Lambda))"""
    return 2.0 * np.sqrt(np.abs(np.diag(K) @ Lambda))


@row.wrong
def no_roots(K, Lambda):
    """the square roots are missing: this grows with K, where a damping grows with its
    root => Lambda K + K Lambda"""
    return Lambda @ np.diag(K) + np.diag(K) @ Lambda


@row.right  # The root by Newton's iteration (Denman and Beavers).
def _(K, Lambda):
    Y, Z = Lambda.copy(), np.eye(6)
    for _ in range(40):
        Y, Z = (Y + np.linalg.inv(Z)) / 2, (Z + np.linalg.inv(Y)) / 2
    k = np.diag(np.sqrt(K))
    return Y @ k + k @ Y


@row.right  # The root by an SVD.
def _(K, Lambda):
    U, s, _ = np.linalg.svd(Lambda)
    root = U @ np.diag(np.sqrt(s)) @ U.T
    k = np.sqrt(K)
    return root * k + root * k[:, None]
