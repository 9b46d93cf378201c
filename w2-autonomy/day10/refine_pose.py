"""10.6 `refine_pose(K, T_guess, points, pixels)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Pose, Row
from robo47.camera import apply_twist, project, projection_jacobian
from robo47.screws import skew

from .projection_jacobian import by_point, by_twist
from .seen import OBLONG, guesses, one_focal_length

row = Row(Pose())


@row.inputs
def _(rng):
    some = guesses(rng)
    K, T, points, _ = some[0]
    exact = (K, T, points, project(K, T, points))
    there = apply_twist(T, np.array([0.1, -0.05, 0.1, 0.02, 0.01, -0.02]))
    oblong = (OBLONG, T, points, project(OBLONG, there, points))
    return [exact, oblong, *some, *guesses(rng, 2, far=2.5)]


@row.spans
def _(rng):  # a small cube, far away, seen exactly: ten full steps find it
    K = np.array([[72.0, 0, 53], [0, 72, 30], [0, 0, 1]])
    cube = 0.02 * np.array(
        [[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    )
    T = np.eye(4)
    for z, turn in ((0.8, 0.1), (1.6, -0.1)):
        T[:3, 3] = 0.1, -0.05, z
        guess = apply_twist(T, np.array([0, 0, 0, 0.01, 0.01, 0.02]))
        guess[:3, :3] = apply_twist(T, turn * np.ones(6))[:3, :3]
        yield K, guess, cube, project(K, T, cube)


def least_squares(J, off):
    """Return the least-squares solution for the twist."""
    return np.linalg.lstsq(J.reshape(-1, 6), off.ravel(), rcond=None)[0]


def mixed(J, off):
    """Return the solution where J has all u before all v."""
    return least_squares(np.concatenate([J[:, 0], J[:, 1]]), off)


def mixed_off(J, off):
    """Return the solution where the errors have all u before all v."""
    return least_squares(J, off.T)


def downhill(J, off):
    """Return J^T r."""
    return J.reshape(-1, 6).T @ off.ravel()


def apart(T, xi):
    """Return T with R rotated and v added to t."""
    T = T.copy()
    T[:3, :3] = (
        apply_twist(np.eye(4), np.append(xi[:3], np.zeros(3)))[:3, :3] @ T[:3, :3]
    )
    T[:3, 3] += xi[3:]
    return T


def first_order(T, xi):
    """Return T + [xi] T."""
    W = np.zeros((4, 4))
    W[:3, :3] = skew(xi[:3])
    W[:3, 3] = xi[3:]
    return T + W @ T


def on_the_right(T, xi):
    """Return T exp([xi])."""
    return T @ apply_twist(np.eye(4), xi)


def steps(
    K, T_guess, points, pixels, *, n=10, solve=least_squares, move=apply_twist,
    held=False, factor=1.0, since=lambda T, guess: T,
):  # fmt: skip
    """Return T after steps that may be wrong; NaN where they diverge."""
    T = T_guess
    J = None
    for _ in range(n):
        p = points @ T[:3, :3].T + T[:3, 3]
        off = pixels - (p @ K.T)[:, :2] / p[:, 2:]
        if J is None or not held:  # wrong steps may lead behind the camera
            J = by_point(K, p) @ by_twist(p)
        T = move(since(T, T_guess), factor * solve(J, off))
    return T


for slug, says, other in (
    ("three-steps",
     "your code returns the pose after three steps. Return the pose after ten steps "
     "instead", {"n": 3}),
    ("J-of-the-guess",
     "your code uses the Jacobian at the guess in every step. Evaluate the Jacobian "
     "at the current pose instead", {"held": True}),
    ("twist-halves-swapped",
     "your code treats the step as (v; omega). The step is (omega; v), because the "
     "columns of J begin with omega",
     {"move": lambda T, xi: apply_twist(T, np.roll(xi, 3))}),
    ("body-twist",
     "your code multiplies T by the exponential of each step from the right. Multiply "
     "T from the left instead, because J is the Jacobian for twists expressed in the "
     "camera frame",
     {"move": on_the_right}),
    ("first-order",
     "your code uses I + [xi] instead of exp([xi]), so R need not remain a rotation. "
     "Use the matrix exponential",
     {"move": first_order}),
    ("gradient",
     "your code uses J^T r as the step, where r is the reprojection error. Use the "
     "least-squares solution of J xi = r instead, which is the Gauss-Newton step",
     {"solve": downhill}),
    ("each-from-the-guess",
     "your code applies each step to the guess. Apply each step to the pose after the "
     "previous step instead",
                            {"since": lambda T, guess: guess}),
    ("half-steps",
     "your code halves each step, so about a thousandth of the error remains after "
     "ten steps. Use the whole step instead", {"factor": 0.5}),
    ("rows-mixed",
     "in your result, the rows of J have all u before all v, but the errors are "
     "ordered point by point. Use the same order for both",
     {"solve": mixed}),
    ("error-mixed",
     "in your result, the errors have all u before all v, but the rows of J are "
     "ordered point by point. Use the same order for both",
     {"solve": mixed_off}),
):  # fmt: skip
    row.wrong(slug, says)(partial(steps, **other))


@row.wrongs
def _(K, T_guess, points, pixels):
    """guess-returned: your code returns the guess itself. Take ten steps from it"""
    return {"guess-returned": T_guess}


one_focal_length(row, steps)


row.at_least_0(K="f and the principal point are")
row.same(
    "first T_guess = np.clip(T_guess, -1, 1)", "ten steps converge from there as well"
)
row.same(
    "J = projection_jacobian(K, p_cam).reshape(-1, 6) => "
    "J = projection_jacobian(K, p_cam).reshape(-2, 6)",
    "NumPy infers any negative size",
)


@row.close("rounded-somewhere")  # Wrong steps that still converge.
def _(K, T_guess, points, pixels):
    return steps(K, T_guess, points, pixels, move=apart)


@row.right  # The normal equations, one point after the other.
def _(K, T_guess, points, pixels):
    T = T_guess.copy()
    for _ in range(10):
        H = np.zeros((6, 6))
        g = np.zeros(6)
        for p, seen in zip(points, pixels, strict=True):
            here = (T[:3, :3] @ p + T[:3, 3])[None]
            J = projection_jacobian(K, here)[0]
            off = seen - project(K, T, p[None])[0]
            H, g = H + J.T @ J, g + J.T @ off
        T = apply_twist(T, np.linalg.solve(H, g))
    return T


@row.wrong(
    "not-at-every-size", hidden="the numbers of the lab stay within its limits"
)  # Levenberg's damping, and never less.
def _(K, T_guess, points, pixels):
    def damped(J, off):
        J = J.reshape(-1, 6)
        return np.linalg.solve(J.T @ J + 10.0 * np.eye(6), J.T @ off.ravel())

    return steps(K, T_guess, points, pixels, solve=damped)
