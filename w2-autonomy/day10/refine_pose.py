"""10.6 `refine_pose(K, T_guess, points, pixels)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Pose, Row
from robo47.camera import apply_twist, project, projection_jacobian
from robo47.screws import skew

from .projection_jacobian import by_point, by_twist
from .seen import OBLONG, guesses

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
    """Return the twist that explains the pixels' errors best."""
    return np.linalg.lstsq(J.reshape(-1, 6), off.ravel(), rcond=None)[0]


def mixed(J, off):
    """Return what least squares give where u and v are stacked in two ways."""
    return least_squares(np.concatenate([J[:, 0], J[:, 1]]), off)


def mixed_off(J, off):
    """Return what they give where it is the error that has all u before all v."""
    return least_squares(J, off.T)


def downhill(J, off):
    """Return J^T r."""
    return J.reshape(-1, 6).T @ off.ravel()


def apart(T, xi):
    """Return T with R turned and t moved, each alone."""
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
    """Return T moved in its own axes."""
    return T @ apply_twist(np.eye(4), xi)


def placed(T, points):
    """Return points of the thing in the camera's axes."""
    return points @ T[:3, :3].T + T[:3, 3]


def steps(
    K, T_guess, points, pixels, *, n=10, solve=least_squares, move=apply_twist,
    held=False, sign=1.0, at=placed, stale=False,
    since=lambda T, guess: T, told=lambda T: T,
):  # fmt: skip
    """Return T after steps that may be wrong; NaN where they run away."""
    T = T_guess
    J = off = None
    for _ in range(n):
        p = placed(T, points)
        if off is None or not stale:
            off = pixels - (p @ K.T)[:, :2] / p[:, 2:]
        if J is None or not held:
            J = slopes(K, at(T, points))
        T = move(since(T, T_guess), sign * solve(J, off))
    return told(T)


def slopes(K, p):
    """Return 10.4's J, also of points behind the camera, where wrong steps may lead."""
    return by_point(K, p) @ by_twist(p)


for slug, says, redone, other in (
    ("one-step", "this is the pose after one step; ten were asked for", "one step",
     {"n": 1}),
    ("two-steps", "it stops after two steps; ten were asked for", "two steps",
     {"n": 2}),
    ("three-steps", "it stops after three steps; ten were asked for", "three steps",
     {"n": 3}),
    ("J-of-the-guess", "the Jacobian is that of the guess in all steps; it changes "
     "with the pose", "with J at the guess alone", {"held": True}),
    ("J-of-the-thing", "the Jacobian is taken at the points in the thing's own axes; "
     "it needs them in the camera's, moved by T", "with J at `points`",
     {"at": lambda T, points: points}),
    ("J-not-moved", "the Jacobian is taken at points that are turned, but not moved, "
     "by T", "with J at R p", {"at": lambda T, points: points @ T[:3, :3].T}),
    ("error-of-the-guess", "the error is that of the guess in all steps; each step "
     "needs what is left", "with the guess's error", {"stale": True}),
    ("twist-halves-swapped", "the step is taken for (v; omega); J's columns have omega "
     "first", "with its halves swapped",
     {"move": lambda T, xi: apply_twist(T, np.roll(xi, 3))}),
    ("body-twist", "each step stands on T's right; J's twists are in the camera's "
     "axes, so the exponential stands on the left", "T exp([xi])",
     {"move": on_the_right}),
    ("first-order", "each step is T + [xi] T, and R no rotation any more",
     "(1 + [xi]) T", {"move": first_order}),
    ("gradient", "each step is J^T r, the steepest way, and no least squares",
     "with J^T r", {"solve": downhill}),
    ("each-from-the-guess", "each step moves the guess; it moves the pose that the "
     "last step gave", "with the guess moved",
     {"since": lambda T, guess: guess}),
    ("inverse", "this is the camera seen from the thing, T's inverse", "its inverse",
     {"told": np.linalg.inv}),
    ("half-steps", "each step is halved: after ten a thousandth of the way is left",
     "with xi / 2", {"sign": 0.5}),
    ("residual-sign", "the error is predicted less seen, so each step goes the wrong "
     "way", "with -r", {"sign": -1.0}),
    ("rows-mixed", "J has all u above all v, but the error has u and v in turn",
     "with J's rows in another order", {"solve": mixed}),
    ("error-mixed", "the error has all u above all v, but J has u and v in turn",
     "with the error in another order", {"solve": mixed_off}),
):  # fmt: skip
    row.wrong(slug, says, redone)(partial(steps, **other))


@row.wrongs
def _(K, T_guess, points, pixels):
    """guess-returned: this is the guess itself"""
    return {"guess-returned": T_guess}


for i, slug, its in (
    (0, "fx-in-both-rows", "v has fx; its focal length is fy, K[1, 1]"),
    (1, "fy-in-both-rows", "u has fy; its focal length is fx, K[0, 0]"),
):

    @row.wrong(
        slug,
        f"the row of {its}",
        f"the right answer with K[{i}, {i}] twice",
        hidden="the lab's camera has fx = fy",
    )
    def _(K, T_guess, points, pixels, i=i):
        here = K.copy()
        here[0, 0] = here[1, 1] = K[i, i]
        return steps(here, T_guess, points, pixels)


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
