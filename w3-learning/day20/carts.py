"""Linear systems with a cost and a policy as questions: no two sizes equal."""

import numpy as np


def problems(rng):
    """Yield K, std, A, B, Q, R, S and T; the docstring's cases come first."""
    one = np.ones((1, 1))
    for std in (0.0, 1.0):
        yield 0.5 * one, std, one, one, one, one, one, 2
    for k, m, std, T in (
        (2, 1, 0.5, 3),
        (2, 2, 0.8, 1),
        (3, 2, 0.0, 4),
        (1, 1, 1.5, 4),
        (3, 1, 0.6, 5),
        (2, 2, 0.7, 3),
    ):
        yield problem(rng, k, m, std, T)


def problem(rng, k, m, std, T):
    """Return one random problem with k states and m inputs."""
    A = (0.7 * np.eye(k) + rng.numbers(-0.3, 0.3, k, k)).round(4)
    B = rng.numbers(-1, 1, k, m)
    Q, R, S = (positive(rng, size) for size in (k, m, k))
    return rng.numbers(-0.5, 0.6, m, k), std, A, B, Q, R, S, T


def positive(rng, n):
    """Return a symmetric, positive definite matrix."""
    root = rng.numbers(-0.5, 0.5, n, n)
    return (np.eye(n) + root + root.T).round(4) if n > 1 else rng.numbers(0.5, 2, 1, 1)


def moments(K, std, A, B, S, T, noise=True, to_state=None):
    """Return E[x x^T] before each of T steps, and after the last.

    The noise reaches the state by `to_state`, by default B.
    """
    M = A - B @ K
    by = B if to_state is None else to_state
    out = [S]
    for _ in range(T):
        out.append(M @ out[-1] @ M.T + noise * std**2 * by @ by.T)
    return out


def shared_noise(K, std, A, B, S, T):
    """Return E[x x^T] before each of T steps if all inputs have the same noise."""
    one = B.sum(axis=1, keepdims=True)
    return moments(K, std, A, B, S, T, to_state=one)[:-1]


def cart(rng):
    """Return Day 13's cart, with a gain as large as the lab's."""
    A, B = np.array([[1.0, 0.1], [0, 1]]), np.array([[0.005], [0.1]])
    Q, R, S = np.diag([1.0, 0.1]), np.array([[0.1]]), np.diag([1.0, 0.5])
    return rng.numbers(1, 3, 1, 2), 0.5, A, B, Q, R, S, 30


def of_sizes(size):
    """Return problems as large, or as small, as `size` times the usual ones."""

    def yields(rng):
        K, std, A, B, Q, R, S, T = problem(rng, 2, 1, 0.5, 4)
        return K, std * size**0.5, A, B, Q, R, size * S, T

    return yields
