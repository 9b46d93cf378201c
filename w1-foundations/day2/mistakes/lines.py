"""Mistakes in tasks 2.3 `screw_axis(axis, point)` and 2.5 `joint_screws(T_zero)`."""

from collections.abc import Callable

import numpy as np

from labkit.judge.matrices import rigid_inverse, times, transposed
from labkit.judge.mistake import Mistake, lifted
from robo47.checks import Array


def screw(axis: Array, point: Array) -> Array:
    """Return (omega; v), (..., 6), of a hinge."""
    return _halves(axis, np.cross(point, axis))


def _halves(first: Array, second: Array) -> Array:
    return np.concatenate([first, second], axis=-1)


def _divided(S: Array) -> Array:
    return S / np.linalg.norm(S, axis=-1, keepdims=True)


SCREW_AXIS = [
    Mistake(
        "moment-sign",
        "omega is right, but v has the wrong sign: it is the velocity of the origin as "
        "seen from the axis, and the arrow from your point to the origin is -point",
        lambda axis, point: _halves(axis, np.cross(axis, point)),
        "the right one with v = +omega x point",
    ),
    Mistake(
        "moment-is-point",
        "v is the point itself; it has to be a velocity, which depends on omega too",
        _halves,
        "(omega; point)",
    ),
    Mistake(
        "moment-is-minus-point",
        "v is minus the point; it has to be a velocity, which depends on omega too",
        lambda axis, point: _halves(axis, -point),
        "(omega; -point)",
    ),
    Mistake(
        "moment-forgotten",
        "v is 0, so the axis goes through the origin, wherever the point is",
        lambda axis, point: _halves(axis, 0.0 * point),
        "(omega; 0)",
    ),
    Mistake(
        "twist-order",
        "the two halves are swapped: omega comes first, then v",
        lambda axis, point: _halves(np.cross(point, axis), axis),
        "(v; omega)",
    ),
    Mistake(
        "twist-order-and-sign",
        "two things: the halves are swapped, omega comes first; and v has the wrong "
        "sign",
        lambda axis, point: _halves(np.cross(axis, point), axis),
        "(omega x point; omega)",
    ),
    Mistake(
        "product-by-entries",
        "v is omega times the point entry by entry; a cross product mixes the entries",
        lambda axis, point: _halves(axis, -axis * point),
        "(omega; -omega * point)",
    ),
    Mistake(
        "product-by-entries",
        "v is omega times the point entry by entry; a cross product mixes the entries",
        lambda axis, point: _halves(axis, axis * point),
        "(omega; omega * point)",
    ),
    Mistake(
        "divided-by-its-length",
        "all six numbers are divided by their length; omega alone is of length 1, and "
        "it comes so",
        lambda axis, point: _divided(screw(axis, point)),
        "the right one so divided",
    ),
    Mistake(
        "axis-reversed",
        "the whole screw is negated: it turns about the same line, the other way",
        lambda axis, point: -screw(axis, point),
        "the screw of -axis",
    ),
    Mistake(
        "omega-reversed",
        "v is right, but omega is -axis",
        lambda axis, point: _halves(-axis, np.cross(point, axis)),
        "the right one with omega negated",
    ),
]


def _lines(
    axis: Callable[[Array], Array] = lambda T: T[..., :3, 2],
    point: Callable[[Array], Array] = lambda T: T[..., :3, 3],
) -> Callable[[Array], Array]:
    """Return joint_screws with an axis and a point taken from elsewhere."""
    return lambda T: screw(axis(T), point(T))


def _local(T: Array) -> Array:
    """Return each link's pose on the one before; the first one's on the world."""
    before = np.concatenate([np.broadcast_to(np.eye(4), T[:, :1].shape), T[:, :-1]], 1)
    return rigid_inverse(before) @ T


def _multiplied(T: Array) -> Array:
    out = [T[:, 0]]
    for k in range(1, T.shape[1]):
        out.append(out[-1] @ T[:, k])
    return np.stack(out, axis=1)


def _wrapped(T: Array) -> Array:
    """Return the points of the links before; the first joint's is the last link's."""
    return np.roll(T[..., :3, 3], 1, axis=-2)


def _repeated(T: Array) -> Array:
    """Return the points of the links before; the first joint's is its own."""
    return np.concatenate([T[:, :1, :3, 3], T[:, :-1, :3, 3]], axis=1)


def _from_the_world(T: Array) -> Array:
    """Return the points of the links before; the first joint's is the world's 0."""
    return np.concatenate([0.0 * T[:, :1, :3, 3], T[:, :-1, :3, 3]], axis=1)


JOINT_SCREWS = [
    Mistake(
        "axis-row-not-column",
        "the axis is taken from a row of R; what the link's z looks like from the "
        "world stands in a column",
        _lines(axis=lambda T: T[..., 2, :3]),
        "the answer with the third row",
    ),
    Mistake(
        "axis-local-z",
        "the axis is (0, 0, 1) for every joint: that is z in the link's own frame; the "
        "screw needs it seen from the world",
        _lines(axis=lambda T: np.broadcast_to([0.0, 0.0, 1.0], T[..., :3, 3].shape)),
        "the answer with (0, 0, 1)",
    ),
    Mistake(
        "axis-x-column",
        "the axis is the links' x; the Panda's joints turn about their z",
        _lines(axis=lambda T: T[..., :3, 0]),
        "the answer with x",
    ),
    Mistake(
        "axis-y-column",
        "the axis is the links' y; the Panda's joints turn about their z",
        _lines(axis=lambda T: T[..., :3, 1]),
        "the answer with y",
    ),
    Mistake(
        "point-is-local-pos",
        "the point is each link's place on the one before, in that one's axes, as the "
        "file has it; the screw needs it seen from the world",
        _lines(point=lambda T: _local(T)[..., :3, 3]),
        "the answer with those points",
    ),
    Mistake(
        "all-local",
        "axis and point are each link's on the one before; the screw needs both seen "
        "from the world",
        lambda T: _lines()(_local(T)),
        "the answer from those poses",
    ),
    Mistake(
        "poses-multiplied",
        "the poses are multiplied along the arm; they are in the world already",
        lambda T: _lines()(_multiplied(T)),
        "the answer from those products",
    ),
    Mistake(
        "point-turned-back",
        "the point is turned back into the link's axes; it is in the world already",
        _lines(point=lambda T: times(transposed(T[..., :3, :3]), T[..., :3, 3])),
        "the answer with R^T p",
    ),
    Mistake(
        "next-links-point",
        "each joint's point is the next link's origin, which need not be on its axis",
        _lines(point=lambda T: np.roll(T[..., :3, 3], -1, axis=-2)),
        "the answer with those points",
    ),
    *(
        Mistake(
            "previous-links-point",
            "each joint's point is the origin of the link before, which need not be on "
            "its axis",
            _lines(point=before),
            "the answer with those points",
        )
        for before in (_repeated, _wrapped, _from_the_world)
    ),
    Mistake(
        "first-link-for-all",
        "every screw is the first joint's: the index never moves on",
        lambda T: np.repeat(_lines()(T)[:, :1], T.shape[1], axis=1),
        "the first screw, seven times",
    ),
    Mistake(
        "last-joint-first",
        "the screws are right, but in the reverse order: joint1's comes first",
        lambda T: _lines()(T)[:, ::-1],
        "the right answer in reverse",
    ),
    *lifted(
        SCREW_AXIS,
        "in every screw, ",
        lambda redo: lambda T: redo(T[..., :3, 2], T[..., :3, 3]),
    ),
]
