"""Mistakes in task 2.4 `exp_screw(S, theta)`: a rotation and a travel."""

import numpy as np

from labkit.judge.finished import of_a_pose
from labkit.judge.mistake import Mistake, applied, lifted
from robo47.checks import Array

from .brackets import OF_A_UNIT_VECTOR
from .moves import motion, rotation, skew, travel, without
from .travels import TRAVEL
from .turns import EXP_ROTATION


def _swapped(S: Array) -> Array:
    return np.roll(S, 3, axis=-1)


def _by_entries(S: Array, theta: Array) -> Array:
    bracket = np.zeros((*S.shape[:-1], 4, 4))
    bracket[..., :3, :3] = skew(S[..., :3])
    bracket[..., :3, 3] = S[..., 3:]
    return np.exp(bracket * theta[..., None, None])


_OWN = [
    Mistake(
        "twist-order",
        "the halves are read as (v; omega); omega comes first",
        lambda S, theta: motion(_swapped(S), theta),
        "the motion with the halves swapped",
    ),
    *TRAVEL,
    Mistake(
        "exp-by-entries",
        "np.exp works on each entry; the exponential of a matrix is a series of "
        "products",
        _by_entries,
        "np.exp of [S] theta",
    ),
]

_OF_THE_ANGLE = [
    Mistake(
        "turns-backwards",
        "it moves the other way, by -theta",
        lambda S, theta: motion(S, -theta),
        "the motion by -theta",
    ),
    Mistake(
        "radians-taken-for-degrees",
        "the angle is in radians already, and is converted from degrees once more",
        lambda S, theta: motion(S, np.deg2rad(theta)),
        "the motion by pi / 180 times the angle",
    ),
    Mistake(
        "degrees-into-cos",
        "the angle comes in radians, and is used as degrees",
        lambda S, theta: motion(S, np.rad2deg(theta)),
        "the motion by 180 / pi times the angle",
    ),
]

EXP_SCREW = [
    *_OWN,
    *_OF_THE_ANGLE,
    *lifted(
        OF_A_UNIT_VECTOR,
        "in [omega], ",
        lambda redo: (
            lambda S, theta: motion(
                S,
                theta,
                lambda axis, x: rotation(axis, x, bracket=redo),
                lambda S, x: travel(S, x, bracket=redo),
            )
        ),
    ),
    *lifted(
        without(EXP_ROTATION, "small-angle-ignored"),
        "in the rotation, ",
        lambda redo: lambda S, theta: motion(S, theta, turn=redo),
    ),
    # The other two are the angle's sign.
    *applied(without(of_a_pose(), "R-transposed", "inverse-returned"), motion),
]

# What shows in an arm of plain hinges too, and what is no mistake in all of q.
_NOT_OF_AN_ARM = (
    "pitch",
    "slide",
    "small",
    "sign-of-the-point",
    "theta-wrapped",
    "hinge-at",
)
OF_A_HINGE = [m for m in EXP_SCREW if not m.slug.startswith(_NOT_OF_AN_ARM)]
OF_THE_FORMULA = [m for m in OF_A_HINGE if m not in _OF_THE_ANGLE]
