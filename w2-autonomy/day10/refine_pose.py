"""10.6 `refine_pose(K, T_guess, points, pixels)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Pose, Row
from robo47.camera import moved, project, projection_jacobian, refine_pose

from .seen import guesses

row = Row(Pose())


@row.inputs
def _(rng):
    some = guesses(rng)
    K, T, points, _ = some[0]
    return [(K, T, points, project(K, T, points)), *some]


def steps(K, T, points, pixels, *, n=10, solve=np.linalg.lstsq, move=moved, held=False):
    """Return T after steps that may be wrong."""
    J = None
    for _ in range(n):
        off = (pixels - project(K, T, points)).ravel()
        if J is None or not held:
            p = points @ T[:3, :3].T + T[:3, 3]
            J = projection_jacobian(K, p).reshape(-1, 6)
        T = move(T, np.linalg.lstsq(J, off, rcond=None)[0])
    return T


@row.wrongs
def _(K, T_guess, points, pixels):
    """one-step: this is the pose after one step; ten were asked for
    J-of-the-guess: the Jacobian is that of the guess in all steps; it changes with the
      pose => with J at the guess alone
    guess-returned: this is the guess itself
    inverse: this is the camera seen from the thing, T's inverse
    """
    right = refine_pose(K, T_guess, points, pixels)
    return {
        "one-step": steps(K, T_guess, points, pixels, n=1),
        "J-of-the-guess": steps(K, T_guess, points, pixels, held=True),
        "guess-returned": T_guess,
        "inverse": np.linalg.inv(right),
    }


@row.right  # Normal equations, and a point at a time.
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
        T = moved(T, np.linalg.solve(H, g))
    return T
