"""What the toy day's functions are asked: one row each, of every kind there is."""

import numpy as np

from labkit.judge import Ask, Finding, Matrix, Mistake, Robot, Scalar, Vector, draw
from robo47 import se3

HAND = Robot("panda")


def _pairs(rng):
    first = [(np.array([1.0, 0.0, 0.0]), np.array([0.0, 2.0, 0.0]))]
    return first + list(zip(*draw.numbers(rng, -1, 1, 2, 5, 3), strict=True))


def _vectors(rng, n=3):
    return [(v,) for v in draw.numbers(rng, -1, 1, 6, n)]


def _skew(w):
    x, y, z = np.moveaxis(w, -1, 0)
    o = np.zeros_like(x)
    return np.moveaxis(np.array([[o, -z, y], [z, o, -x], [-y, x, o]]), (0, 1), (-2, -1))


def _spin(w, second=_skew):
    out = np.zeros((len(w), 6, 6))
    out[:, :3, :3], out[:, 3:, 3:] = _skew(w), second(w)
    return out


def _bracket(V):
    out = np.zeros((len(V), 4, 4))
    out[:, :3, :3], out[:, :3, 3] = _skew(V[:, :3]), V[:, 3:]
    return out


def _angle(a, b):
    return np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), np.sum(a * b, axis=1))


def _is_normal(v, n):
    if abs(np.linalg.norm(n) - 1.0) > 1e-9:
        return Finding("not-unit", f"Its length is {np.linalg.norm(n):.3g}, not 1.")
    if abs(n @ v) > 1e-9:
        return Finding("not-normal", "It is not at a right angle to v.")
    return None


QUESTIONS = {
    "angle_between": Ask(
        _pairs,
        Scalar(unit="rad"),
        truth=_angle,
        mistakes=[
            Mistake(
                "in-degrees",
                "the angle is in degrees; here it is in radians",
                lambda a, b: np.rad2deg(_angle(a, b)),
                "the angle in degrees",
            )
        ],
    ),
    "cross": Ask(
        _pairs,
        Vector((3,)),
        truth=np.cross,
        mistakes=[
            Mistake(
                "b-cross-a",
                "the two factors are swapped: this is b x a",
                lambda a, b: np.cross(b, a),
                "b x a",
            )
        ],
    ),
    "spin": Ask(
        _vectors,
        Matrix((6, 6)),
        truth=_spin,
        mistakes=[
            Mistake(
                "second-half-empty",
                "the lower right block is empty; v turns too",
                lambda w: _spin(w, second=lambda w: 0.0 * _skew(w)),
                "the matrix with that block 0",
            )
        ],
    ),
    "bracket": Ask(lambda rng: _vectors(rng, 6), Matrix((4, 4)), truth=_bracket),
    "polar": Ask(
        lambda rng: [tuple(map(float, v)) for v in draw.numbers(rng, -1, 1, 6, 2)],
        (
            Scalar(unit="m", called="the distance"),
            Scalar(unit="rad", called="the angle"),
        ),
        truth=lambda x, y: (np.hypot(x, y), np.arctan2(y, x)),
        mistakes=[
            Mistake(
                "arctan-of-the-ratio",
                "the angle is arctan(y / x), which knows two quadrants only",
                lambda x, y: (np.hypot(x, y), np.arctan(y / x)),
                "the answer with arctan(y / x)",
            )
        ],
    ),
    "normal": Ask(_vectors, Vector((3,)), accept=_is_normal),
    "seen_from": Ask(
        lambda rng: [(T, draw.numbers(rng, -1, 1, 3)) for T in draw.poses(rng, 6)],
        Vector((3,), "m"),
        truth=lambda T, p: (
            se3.inverse(T) @ np.append(p, np.ones((len(p), 1)), 1)[..., None]
        )[:, :3, 0],
        mistakes=[
            Mistake(
                "not-undone",
                "T is used as it is; it maps the hand to the world, and you want back",
                lambda T, p: (T @ np.append(p, np.ones((len(p), 1)), 1)[..., None])[
                    :, :3, 0
                ],
                "T p",
            )
        ],
    ),
    "fingers": Ask(
        lambda rng: [(HAND,)], Scalar(), truth=lambda model: np.array([2.0]), fresh=0
    ),
}
