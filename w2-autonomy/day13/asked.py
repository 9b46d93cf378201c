"""The inputs of Day 13: arms, quadratic programs with bounds, motions with costs."""

import numpy as np

from robo47 import panda

ARM = panda.arm(panda.load("panda_nohand"))


def definite(rng, n, low=0.5):
    """Return a symmetric matrix, (n, n), with eigenvalues from low to about n."""
    C = rng.numbers(-1, 1, n, n)
    return np.round(C @ C.T + low * np.eye(n), 3)


def symmetric(rng, n, size):
    """Return a symmetric matrix, (n, n), of either sign."""
    C = rng.numbers(-size, size, n, n)
    return np.round((C + C.T) / 2, 3)


def hinges(rng, n=6):
    """Return J_space, masses, centres and gravity of arms of several joints."""
    found = []
    for k, q in enumerate(rng.configurations(n)):
        J = np.round(ARM.at(q).J_space, 3)
        coms = np.round(ARM.at(q).coms_world, 3)
        g = np.array([0.0, 0.0, -9.81])
        if k % 2:  # random centres, and gravity in any direction
            coms = rng.numbers(-1, 1, 7, 3)
            g = rng.numbers(-9, 9, 3)
        found.append((J, rng.numbers(0.5, 4, 7), coms, g))
    return found


def problem(rng, n, held):
    """Return H, f, lo, hi and the minimiser x with a given active set.

    held (n,) is -1 for an entry at its lower bound, 1 at its upper one and 0 for a free
    entry. The gradient at x is chosen, and f follows from it.
    """
    H = definite(rng, n)
    x = np.round(rng.numbers(-1, 1, n), 1)
    price = rng.numbers(0.5, 3, n) * -np.sign(held)
    price[0] = price[0] / 10_000  # a held entry that is nearly released
    lo = np.where(held < 0, x, np.round(x - rng.numbers(0.3, 1, n), 3))
    hi = np.where(held > 0, x, np.round(x + rng.numbers(0.3, 1, n), 3))
    return H, np.round(price - H @ x, 6), lo, hi, x


def problems(rng, n=8):
    """Return such problems with two to five entries and various active sets."""
    found = []
    for k in range(n):
        size = [3, 2, 4, 5][k % 4]
        held = np.resize([-1, 0, 1, 0, 1], size) if k % 3 else np.zeros(size, int)
        found.append(problem(rng, size, held if k % 2 else -held))
    return found


def boxed(rng, n=10):
    """Return H, f, lo, hi and a start: at a corner, inside, or outside."""
    found = []
    for k in range(n):
        size = [3, 4, 5, 5][k % 4]
        lo = rng.numbers(-2.5, 0, size)
        hi = np.round(lo + rng.numbers(0.2, 1.5, size), 3)
        if k == 1:
            hi[0] = lo[0]  # an entry that is fixed
        if k == 5:  # no bound is active
            lo, hi = lo - 30, hi + 30
        start = [rng.numbers(-3, 3, size), lo, np.zeros(size), hi][k % 4]
        g = rng.numbers(-4, 4, size)
        found.append((definite(rng, size, 0.2), g, lo, hi, start.copy()))
    return found


def steps(rng, n=6):
    """Return P, A, B, Q and R of several sizes; no matrix is diagonal."""
    found = []
    for k in range(n):
        size, inputs = [(2, 1), (3, 2), (4, 2), (2, 2)][k % 4]
        A = rng.numbers(-1.5, 1.5, size, size)
        B = rng.numbers(-1, 1, size, inputs)
        P, Q = definite(rng, size), definite(rng, size)
        found.append((P, A, B, Q, definite(rng, inputs)))
    return found


def motions(rng, n=6):
    """Return the arguments of `ilqr_backward` for motions of three to five steps."""
    found = []
    for k in range(n):
        T, size, inputs = [(3, 2, 1), (4, 3, 2), (5, 2, 2), (3, 4, 2)][k % 4]
        both = np.array([definite(rng, size + inputs) for _ in range(T)])
        found.append((
            rng.numbers(-1, 1, T, size, size), rng.numbers(-1, 1, T, size, inputs),
            rng.numbers(-1, 1, T, size), rng.numbers(-1, 1, T, inputs),
            both[:, :size, :size], both[:, size:, size:], both[:, size:, :size],
            rng.numbers(-1, 1, size), definite(rng, size),
            float([0.5, 0.0, 2.0][k % 3]),
        ))  # fmt: skip
    return found
