"""Inputs of Day 8: bodies, states of the Panda, and regressors with known values."""

import numpy as np

from robo47 import identification, panda, se3

WRENCH = ("moment x", "moment y", "moment z", "force x", "force y", "force z")
NUMBERS = ("m", "m cx", "m cy", "m cz", "Ixx", "Iyy", "Izz", "Ixy", "Ixz", "Iyz")
DOWN = np.array([0.0, 0.0, -9.81])
SWAP = [3, 4, 5, 0, 1, 2]
CUT = 0.004  # rtol of the questions; smaller singular values still have digits


def bodies(rng, n=8):
    """Return ten parameters each, without zeros; most of them belong to no body."""
    phi = rng.numbers(-2, 2, n, 10)
    phi[:, 0] = rng.numbers(1, 4, n)
    return phi


def real_bodies(rng, n=4):
    """Return ten parameters each of real bodies: twelve points with masses."""
    found = []
    for _ in range(n):
        points = rng.numbers(-1, 1, 12, 3)
        masses = rng.numbers(0.2, 1, 12)
        P = points.T * masses @ points
        about = np.trace(P) * np.eye(3) - P
        i, j = np.transpose([(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)])
        phi = np.hstack([masses.sum(), masses @ points, about[i, j]])
        found.append(np.round(phi, 6))
    return found


def moving(rng, n=6):
    """Return J, T_links, qd, qdd and g of the Panda in motion."""
    arm = panda.arm(panda.load("panda_nohand"))
    found = []
    for q in rng.configurations(n):
        now = arm.at(q)
        qd, qdd = rng.numbers(-2, 2, 2, 7)
        found.append((now.J_space, now.T_links, qd, 5.0 * qdd, DOWN))
    return found


def regressors(rng, n=6, rows=20):
    """Return matrices, (rows, 6), with two singular values below CUT, of three sizes.

    CUT is a factor of six or more from the singular values on either side; its square
    root is not.
    """
    found = []
    for size in np.resize([1.0, 300.0, 0.002], n):
        s = size * rng.uniform(0.9, 1.1, 6) * [2.0, 1.2, 0.6, 0.06, 5e-4, 2e-4]
        U = np.linalg.qr(rng.normal(size=(rows, 6)))[0]
        V = np.linalg.qr(rng.normal(size=(6, 6)))[0]
        found.append(U * s @ V.T)
    return found


def uneven(rng, fifth, rows=20):
    """Return a matrix, (rows, 6), with five singular values above CUT, the fifth just.

    CUT times their norm is 6.3, and CUT times their sum is 10.9.
    """
    s = np.array([1000.0, 900.0, 800.0, 40.0, fifth, 0.1])
    U = np.linalg.qr(rng.normal(size=(rows, 6)))[0]
    V = np.linalg.qr(rng.normal(size=(6, 6)))[0]
    return U * s @ V.T


def spread(rng, n=4, rows=20):
    """Return matrices, (rows, 6), with any singular values that are not near CUT.

    Another limit sooner or later keeps another number of them.
    """
    found = []
    for _ in range(n):
        s = np.append(1.0, 10.0 ** rng.uniform(-3, 0, 5))
        s = np.where(np.abs(np.log(s / CUT)) < 0.2, 1.5 * s, s)
        U = np.linalg.qr(rng.normal(size=(rows, 6)))[0]
        V = np.linalg.qr(rng.normal(size=(6, 6)))[0]
        found.append(100.0 * U * np.sort(s)[::-1] @ V.T)
    return found


def stairs(rng, rows=20):
    """Return a matrix, (rows, 6), with singular values between usual wrong limits.

    Four are above CUT; the root of CUT and CUT times rows keep other numbers.
    """
    s = 100.0 * np.array([1.0, 0.07, 0.056, 0.006, 0.003, 0.001])
    U = np.linalg.qr(rng.normal(size=(rows, 6)))[0]
    V = np.linalg.qr(rng.normal(size=(6, 6)))[0]
    return U * s @ V.T


def steep(rng, rows=20):
    """Return a matrix, (rows, 6), with two singular values above CUT.

    Three are above CUT times the one before, until one is not.
    """
    s = 100.0 * np.array([1.0, 0.05, 2.5e-3, 5e-6, 2e-6, 1e-6])
    U = np.linalg.qr(rng.normal(size=(rows, 6)))[0]
    V = np.linalg.qr(rng.normal(size=(6, 6)))[0]
    return U * s @ V.T


def hidden(rng, rows=40):
    """Return a matrix, (rows, 6), of rank 4 but for rounding."""
    return rng.normal(size=(rows, 4)) @ rng.normal(size=(4, 6))


def alike(rng, k=3, turn=2e-3):
    """Return poses that differ by a small rotation of the hand, and a known payload.

    Only the rotation determines a part of m c, so its singular value is small.
    """
    R = se3.quat_to_R(rng.normal(size=4))
    turns = se3.quat_to_R(np.insert(turn * rng.normal(size=(k, 3)), 0, 1.0, axis=1))
    J = rng.numbers(-1, 1, k, 6, 7)
    load = rng.numbers(1, 2, 4)
    rows = identification.load_regressor(J, R @ turns, DOWN)
    return J, R @ turns, rows @ load, DOWN


def hands(rng, n=6, k=5):
    """Return J_site, R_site, extra and g of k poses; gravity has any direction."""
    found = []
    for i in range(n):
        J = rng.numbers(-1, 1, k, 6, 7)
        R = se3.quat_to_R(rng.normal(size=(k, 4)))
        extra = rng.numbers(-20, 20, k, 7)
        found.append((J, R, extra, rng.numbers(-10, 10, 3) if i % 2 else DOWN))
    return found
