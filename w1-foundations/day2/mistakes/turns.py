"""Mistakes in task 2.2 `exp_rotation(axis, theta)`."""

import numpy as np

from labkit.judge.mistake import Mistake, lifted
from robo47 import se3
from robo47.checks import Array

from .brackets import OF_A_UNIT_VECTOR, outer
from .moves import rotation, sine, skew, versine, without


def _entry_by_entry(axis: Array, theta: Array) -> Array:
    return np.exp(skew(axis) * theta[..., None, None])


SMALL = (1e-3, 1e-2)  # radians: any bound between two angles that are asked does it


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
            + versine(theta)[..., None, None] * outer(axis)
        ),
        "the formula with that term",
    ),
    Mistake(
        "dyad-without-factor",
        "before axis axis^T the factor 1 - cos is missing: at theta = 0 it turns "
        "already",
        lambda axis, theta: (
            rotation(axis, theta) + np.cos(theta)[..., None, None] * outer(axis)
        ),
        "cos I + sin K + axis axis^T",
    ),
    Mistake(
        "cosine-before-identity",
        "before the identity stands the cosine; that goes with axis axis^T, and I "
        "itself with K K",
        lambda axis, theta: (
            rotation(axis, theta) - versine(theta)[..., None, None] * np.eye(3)
        ),
        "the formula with cos I",
    ),
    Mistake(
        "theta-for-sine",
        "before K stands theta; it has to be its sine",
        lambda axis, theta: rotation(axis, theta, first=np.positive),
        "the formula with theta K",
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
    Mistake(
        "double-angle",
        "it turns by twice the angle; in a quaternion stand sine and cosine of half of "
        "it",
        lambda axis, theta: rotation(axis, 2 * theta),
        "the rotation by twice the angle",
    ),
    Mistake(
        "sign-of-theta-lost",
        "theta and -theta turn the same way: the sign of theta is lost",
        lambda axis, theta: rotation(axis, np.abs(theta)),
        "the rotation by |theta|",
    ),
    *(
        Mistake(
            "small-angle-ignored",
            "a small angle is taken for 0; the formula is exact for small angles too, "
            "and needs no case of its own",
            lambda axis, theta, small=small: rotation(
                axis, np.where(np.abs(theta) < small, 0.0, theta)
            ),
            "the right one with 0 for small angles",
        )
        for small in SMALL
    ),
    *lifted(
        without(OF_A_UNIT_VECTOR, "p-cross-w"),  # the angle's sign
        "in [axis], ",
        lambda redo: lambda axis, theta: rotation(axis, theta, bracket=redo),
    ),
]
