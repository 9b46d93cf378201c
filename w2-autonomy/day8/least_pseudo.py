"""8.9 `least_pseudo(phi)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Scalar
from labkit.judge.row import Row
from robo47.identification import inertia_of

from .states import bodies

row = Row(Scalar(called="the eigenvalue"))
POINT = np.array([2.0, 2, 4, 6, 26, 20, 10, -4, -6, -12])  # 2 kg at (1, 2, 3)


@row.inputs
def _(rng):
    case = np.array([1.0, 0, 0, 0, 1, 1, 3, 0, 0, 0])
    return [(case,), (POINT,), *((phi,) for phi in bodies(rng))]


def pseudo(phi, spread=lambda I: np.trace(I) / 2 * np.eye(3) - I, h=1.0):  # noqa: E741
    """Return the matrix, with another upper left, or h times a factor."""
    P = np.zeros((4, 4))
    P[:3, :3] = spread(inertia_of(phi)[:3, :3])
    P[:3, 3] = P[3, :3] = h * phi[1:4]
    P[3, 3] = phi[0]
    return P


def least(matrix):
    """Return the least eigenvalue."""
    return np.linalg.eigvalsh(matrix)[0]


@row.wrong
def only_the_inertia(phi):
    """this is the least eigenvalue of I; a body also needs Ixx + Iyy >= Izz, and m c =>
    that of I"""
    return least(inertia_of(phi)[:3, :3])


@row.wrong
def inertia_not_turned_round(phi):
    """I stands at the upper left itself; the sum of m r r^T is tr(I)/2 1 - I => with I
    there"""
    return least(pseudo(phi, spread=lambda I: I))  # noqa: E741


@row.wrong
def trace_not_halved(phi):
    """the trace is not halved: r.r is counted twice in it => with tr(I) 1 - I"""
    return least(pseudo(phi, spread=lambda I: np.trace(I) * np.eye(3) - I))  # noqa: E741


@row.wrong
def centre_for_first_moment(phi):
    """c stands there for h = m c => with h / m"""
    return least(pseudo(phi, h=1.0 / phi[0]))


@row.wrong
def singular_value(phi):
    """this is the least singular value, which is never below 0; the sign is what is
    asked for => the least singular value"""
    return np.linalg.svd(pseudo(phi), compute_uv=False)[-1]


@row.wrong
def largest(phi):
    """this is the largest eigenvalue => the largest"""
    return np.linalg.eigvalsh(pseudo(phi))[-1]


@row.right  # From the general eigenvalues.
def _(phi):
    return np.linalg.eigvals(pseudo(phi)).real.min()
