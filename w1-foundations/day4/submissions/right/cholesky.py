# tasks 4.8 4.9: passed
# Cholesky factors: M = L L^T, energy is half of |L^T qd|^2.
import numpy as np


def forward_dynamics(M, bias, damping, qd, tau):
    L = np.linalg.cholesky(M)
    y = np.linalg.solve(L, tau - bias - damping * qd)
    return np.linalg.solve(L.T, y)


def energy(M, qd, masses, coms_world, g):
    values, axes = np.linalg.eigh(M)
    kinetic = 0.5 * values @ (axes.T @ qd) ** 2
    weight = masses @ coms_world  # total mass times the arm's centre of mass
    return kinetic, -g @ weight
