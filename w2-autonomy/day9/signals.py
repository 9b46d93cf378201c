"""Inputs of Day 9's checks: signals, estimates, and states of the Panda in motion."""

import numpy as np

from robo47 import panda

JOINTS = tuple(f"joint{i}" for i in range(1, 8))
DT = 0.002


def signals(rng, n=6):
    """Return signals of several lengths, rad, each with a sampling period."""
    found = []
    for k in range(n):
        size = [5, 8, 20][k % 3]
        found.append((rng.numbers(-2, 2, size), float(rng.numbers(0.05, 0.5))))
    return found


def covariance(rng, n, low=0.2):
    """Return a covariance (n, n) that is well conditioned."""
    left = rng.numbers(-1, 1, n, n)
    return np.round(left @ left.T + low * np.eye(n), 3)


def believed(rng, sizes=((2, 1), (2, 2), (3, 1), (3, 2), (4, 2), (2, 1), (3, 3))):
    """Return x, P, z, H and R of Kalman updates of several sizes."""
    found = []
    for n, m in sizes:
        x, z = rng.numbers(-2, 2, n), rng.numbers(-2, 2, m)
        H = rng.numbers(-1, 1, m, n)
        R = covariance(rng, m, 0.5)
        found.append((x, covariance(rng, n), z, H, R))
    return found


def moving(rng, n=6):
    """Return J_space, G and qd of the Panda."""
    arm = panda.arm(panda.load("panda_nohand"))
    found = []
    for q in rng.configurations(n):
        now = arm.at(q)
        found.append((now.J_space, now.G, rng.numbers(-2, 2, 7)))
    return found
