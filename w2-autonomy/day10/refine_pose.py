"""10.6 `refine_pose(K, T_guess, points, pixels)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Pose, Row
from robo47.camera import moved, project, projection_jacobian, refine_pose
from robo47.screws import skew

from .projection_jacobian import by_point, by_twist
from .seen import guesses

row = Row(Pose())


@row.inputs
def _(rng):
    some = guesses(rng)
    K, T, points, _ = some[0]
    exact = (K, T, points, project(K, T, points))
    return [exact, *some, *guesses(rng, 2, far=2.5)]


def least_squares(J, off):
    """Return the twist that explains the pixels' errors best."""
    return np.linalg.lstsq(J.reshape(-1, 6), off.ravel(), rcond=None)[0]


def mixed(J, off):
    """Return what least squares give where u and v are stacked in two ways."""
    return least_squares(np.concatenate([J[:, 0], J[:, 1]]), off)


def apart(T, xi):
    """Return T with R turned and t moved, each alone."""
    T = T.copy()
    T[:3, :3] = moved(np.eye(4), np.append(xi[:3], np.zeros(3)))[:3, :3] @ T[:3, :3]
    T[:3, 3] += xi[3:]
    return T


def first_order(T, xi):
    """Return T + [xi] T."""
    W = np.zeros((4, 4))
    W[:3, :3] = skew(xi[:3])
    W[:3, 3] = xi[3:]
    return T + W @ T


def on_the_right(T, xi):
    """Return T moved in its own axes."""
    return T @ moved(np.eye(4), xi)


def steps(K, T, points, pixels, *, n=10, solve=least_squares, move=moved, held=False):
    """Return T after steps that may be wrong; NaN where they run away."""
    J = None
    for _ in range(n):
        p = points @ T[:3, :3].T + T[:3, 3]
        off = pixels - (p @ K.T)[:, :2] / p[:, 2:]
        if J is None or not held:
            J = slopes(K, p)
        T = move(T, solve(J, off))
    return T


def slopes(K, p):
    """Return 10.4's J, also of points behind the camera, where wrong steps may lead."""
    return by_point(K, p) @ by_twist(p)


@row.wrongs
def _(K, T_guess, points, pixels):
    """one-step: this is the pose after one step; ten were asked for
    J-of-the-guess: the Jacobian is that of the guess in all steps; it changes with the
      pose => with J at the guess alone
    guess-returned: this is the guess itself
    body-twist: each step stands on T's right; J's twists are in the camera's axes, so
      the exponential stands on the left => T exp([xi])
    first-order: each step is T + [xi] T, and R no rotation any more => (1 + [xi]) T
    gradient: each step is J^T r, the steepest way, and no least squares => with J^T r
    residual-sign: the error is predicted less seen, so each step goes the wrong way
      => with -r
    rows-mixed: J has all u above all v, but the error has u and v in turn
      => with J's rows in another order
    two-steps: it stops after two steps; ten were asked for
    inverse: this is the camera seen from the thing, T's inverse
    """
    given = (K, T_guess, points, pixels)
    right = refine_pose(*given)
    return {
        "one-step": steps(*given, n=1),
        "J-of-the-guess": steps(*given, held=True),
        "guess-returned": T_guess,
        "body-twist": steps(*given, move=on_the_right),
        "first-order": steps(*given, move=first_order),
        "gradient": steps(*given, solve=lambda J, r: J.reshape(-1, 6).T @ r.ravel()),
        "residual-sign": steps(*given, solve=lambda J, r: -least_squares(J, r)),
        "rows-mixed": steps(*given, solve=mixed),
        "two-steps": steps(*given, n=2),
        "inverse": np.linalg.inv(right),
    }


row.at_least_0(K="f and the centre are")
row.same("first T_guess = np.clip(T_guess, -1, 1)", "it is near enough to end there")
row.same(
    "J = projection_jacobian(K, p_cam).reshape(-1, 6) => "
    "J = projection_jacobian(K, p_cam).reshape(-2, 6)",
    "NumPy takes any size below 0 for what is left",
)


@row.close("rounded-somewhere")  # Wrong steps, that still end where nothing is left.
def _(K, T_guess, points, pixels):
    return steps(K, T_guess, points, pixels, move=apart)


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
