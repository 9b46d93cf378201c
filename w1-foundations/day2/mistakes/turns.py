"""Mistakes in tasks 2.1 `skew(w)` and 2.2 `exp_rotation(axis, theta)`."""

import numpy as np

from robo47 import se3
from robo47.checks import Array
from robo47.diagnose.mistake import Mistake, lifted

from .moves import from_rows, rotation, sine, skew, versine, without


def _outer(w: Array) -> Array:
    return w[..., :, None] * w[..., None, :]


def _unit(w: Array) -> Array:
    return w / np.linalg.norm(w, axis=-1, keepdims=True)


SKEW = [
    Mistake(
        "p-cross-w",
        "this does p x w: every sign is the other way round (the matrix is transposed)",
        lambda w: -skew(w),
        "the right one with its signs reversed",
    ),
    Mistake(
        "no-minus",
        "there is no minus: [w] is its own negative transposed, not its own transpose",
        from_rows(lambda x, y, z: [[0, z, y], [z, 0, x], [y, x, 0]]),
        "the right one with every sign a plus",
    ),
    *(
        Mistake(
            "pair-of-signs",
            f"the two entries with {letter} have each other's sign",
            lambda w, flip=flip: skew(w * flip),
            f"the right one with {letter} negated",
        )
        for letter, flip in (("x", [-1, 1, 1]), ("y", [1, -1, 1]), ("z", [1, 1, -1]))
    ),
    *(
        Mistake(
            "letters-swapped",
            f"{a} and {b} have changed places",
            lambda w, order=order: skew(w[..., order]),
            "the right one with the two swapped",
        )
        for a, b, order in (
            ("x", "z", [2, 1, 0]),
            ("x", "y", [1, 0, 2]),
            ("y", "z", [0, 2, 1]),
        )
    ),
    *(
        Mistake(
            "letters-swapped",
            f"{a} and {b} have changed places, and all signs are reversed",
            lambda w, order=order: -skew(w[..., order]),
            "the right one with both",
        )
        for a, b, order in (
            ("x", "z", [2, 1, 0]),
            ("x", "y", [1, 0, 2]),
            ("y", "z", [0, 2, 1]),
        )
    ),
    Mistake(
        "half-empty",
        "only the upper right half is filled; the lower left one is its negative",
        lambda w: np.triu(skew(w)),
        "the right one without its lower half",
    ),
    Mistake(
        "half-empty",
        "only the lower left half is filled; the upper right one is its negative",
        lambda w: np.tril(skew(w)),
        "the right one without its upper half",
    ),
    Mistake(
        "outer-product",
        "this is w times w transposed, which does a projection, not a cross product",
        _outer,
        "that product",
    ),
    Mistake(
        "on-the-diagonal",
        "w stands on the diagonal; w x p has no part of w along w",
        lambda w: _outer(w) * np.eye(3) / np.where(w == 0, 1, w)[..., None],
        "the diagonal matrix",
    ),
    Mistake(
        "made-unit",
        "w is divided by its length first; the cross product is as long as w says",
        lambda w: skew(_unit(w)),
        "the right one of w / |w|",
    ),
]


OF_A_UNIT_VECTOR = without(SKEW, "made-unit")  # which changes nothing


def _entry_by_entry(axis: Array, theta: Array) -> Array:
    return np.exp(skew(axis) * theta[..., None, None])


EXP_ROTATION = [
    Mistake(
        "turns-backwards",
        "it turns the other way: the sine's term has the wrong sign",
        lambda axis, theta: rotation(axis, -theta),
        "the rotation by -theta",
    ),
    Mistake(
        "minus-square",
        "the last term is subtracted: lengths grow (det R is far from 1)",
        lambda axis, theta: rotation(axis, theta, second=lambda x: -versine(x)),
        "the formula with that minus",
    ),
    Mistake(
        "square-missing",
        "the term with K K is missing: I + sin K holds for tiny angles only",
        lambda axis, theta: rotation(axis, theta, second=np.zeros_like),
        "the formula without it",
    ),
    Mistake(
        "sine-term-missing",
        "the term with K itself is missing, so turning by theta and -theta is the same",
        lambda axis, theta: rotation(axis, theta, first=np.zeros_like),
        "the formula without it",
    ),
    Mistake(
        "identity-missing",
        "the identity is missing: at theta = 0 a rotation leaves everything as it is",
        lambda axis, theta: rotation(axis, theta) - np.eye(3),
        "the formula without it",
    ),
    Mistake(
        "cosine-for-one-minus-cosine",
        "before K K stands the cosine; at theta = 0 that factor has to vanish",
        lambda axis, theta: rotation(axis, theta, second=np.cos),
        "the formula with cos",
    ),
    Mistake(
        "one-minus-sine",
        "before K K stands 1 minus the sine; at theta = 0 that factor has to vanish",
        lambda axis, theta: rotation(axis, theta, second=lambda x: 1.0 - np.sin(x)),
        "the formula with 1 - sin",
    ),
    Mistake(
        "sin-and-cos-swapped",
        "sine and cosine have changed places: at theta = 0 it already turns",
        lambda axis, theta: rotation(axis, theta, np.cos, lambda x: 1.0 - np.sin(x)),
        "the formula with the two swapped",
    ),
    Mistake(
        "coefficients-swapped",
        "the two factors have changed places: the sine belongs to K, 1 - cos to K K",
        lambda axis, theta: rotation(axis, theta, versine, sine),
        "the formula with the two swapped",
    ),
    Mistake(
        "squared-by-entries",
        "K * K squares each entry; K K is a product of matrices",
        lambda axis, theta: rotation(axis, theta, square=np.multiply),
        "the formula with K * K",
    ),
    Mistake(
        "exp-by-entries",
        "np.exp works on each entry; the exponential of a matrix is a series of "
        "products",
        _entry_by_entry,
        "np.exp of [axis] theta",
    ),
    Mistake(
        "first-order-only",
        "this is I + theta K, the first two terms of the series: right for tiny angles",
        lambda axis, theta: rotation(axis, theta, np.positive, np.zeros_like),
        "I + theta K",
    ),
    Mistake(
        "second-order-only",
        "the series stops after the term with theta squared; it goes on for ever",
        lambda axis, theta: rotation(axis, theta, np.positive, lambda x: x * x / 2),
        "the series cut there",
    ),
    Mistake(
        "bracket-of-a-dyad",
        "the last term is (1 - cos) times axis axis^T; that goes with cos I, not with "
        "I",
        lambda axis, theta: (
            rotation(axis, theta, second=np.zeros_like)
            + versine(theta)[..., None, None] * _outer(axis)
        ),
        "the formula with that term",
    ),
    Mistake(
        "always-about-z",
        "it turns about z, whatever the axis is",
        lambda axis, theta: se3.Rz(theta),
        "Rz(theta)",
    ),
    Mistake(
        "radians-taken-for-degrees",
        "the angle is in radians already, and is converted from degrees once more",
        lambda axis, theta: rotation(axis, np.deg2rad(theta)),
        "the rotation by pi / 180 times the angle",
    ),
    Mistake(
        "degrees-into-cos",
        "sine and cosine are given degrees; they expect radians, as the angle comes",
        lambda axis, theta: rotation(axis, np.rad2deg(theta)),
        "the rotation by 180 / pi times the angle",
    ),
    Mistake(
        "half-angle",
        "it turns by half of the angle: that belongs to quaternions",
        lambda axis, theta: rotation(axis, theta / 2),
        "the rotation by half of it",
    ),
    *lifted(
        without(OF_A_UNIT_VECTOR, "p-cross-w"),  # the angle's sign
        "in [axis], ",
        lambda redo: lambda axis, theta: rotation(axis, theta, bracket=redo),
    ),
]
