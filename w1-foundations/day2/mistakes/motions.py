"""Mistakes in task 2.4 `exp_screw(S, theta)`: a rotation and a travel."""

import numpy as np

from robo47.checks import Array
from robo47.diagnose.finished import of_a_pose
from robo47.diagnose.matrices import pose, times
from robo47.diagnose.mistake import Mistake, applied, lifted

from .moves import Function, motion, rest, rotation, skew, travel, versine, without
from .turns import EXP_ROTATION, OF_A_UNIT_VECTOR


def _swapped(S: Array) -> Array:
    return np.roll(S, 3, axis=-1)


def _with(**changed: Function) -> Function:
    """Return exp_screw with another travel."""
    return lambda S, theta: motion(S, theta, go=lambda S, x: travel(S, x, **changed))


def _along_a_line(S: Array, theta: Array) -> Array:
    return pose(rotation(S[..., :3], theta), theta[..., None] * S[..., 3:])


def _turned(S: Array, theta: Array) -> Array:
    R = rotation(S[..., :3], theta)
    return pose(R, times(R, travel(S, theta)))


def _around_the_axis(S: Array, theta: Array, along: Function = np.zeros_like) -> Array:
    """Return (I - R) (omega x v), and what is along the axis."""
    omega, v = S[..., :3], S[..., 3:]
    R = rotation(omega, theta)
    slides = ~omega.any(axis=-1)[..., None]
    point = times(np.eye(3) - R, np.cross(omega, v))
    pitch = np.sum(omega * v, axis=-1, keepdims=True) * omega
    t = point + along(theta)[..., None] * pitch + slides * theta[..., None] * v
    return pose(R, t)


def _always_turns(S: Array, theta: Array) -> Array:
    """Return the motion with nothing for a slide."""
    T = motion(S, theta)
    return np.where(S[..., :3].any(axis=-1)[..., None, None], T, np.eye(4))


def _slides_by_v(S: Array, theta: Array) -> Array:
    slides = ~S[..., :3].any(axis=-1)
    return motion(S, np.where(slides, 1.0, theta))


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
    Mistake(
        "identity-for-theta",
        "R is right, but the translation starts with I v, not with theta: at theta = 0 "
        "it moves already",
        _with(zeroth=np.ones_like),
        "the right one with I in place of theta I",
    ),
    Mistake(
        "exp-coefficients-swapped",
        "R is right, but in the translation the two factors have changed places",
        _with(first=rest, second=versine),
        "the right one with the two swapped",
    ),
    Mistake(
        "as-in-the-rotation",
        "R is right, but the translation uses R's own factors, sin and 1 - cos; it "
        "needs their integrals",
        _with(first=np.sin, second=versine),
        "the right one with those factors",
    ),
    Mistake(
        "R-times-v",
        "R is right, but the translation is R v: a velocity has to be summed up on "
        "the way",
        lambda S, theta: pose(
            rotation(S[..., :3], theta), times(rotation(S[..., :3], theta), S[..., 3:])
        ),
        "the right one with R v",
    ),
    Mistake(
        "R-times-theta-v",
        "R is right, but the translation is theta R v: the direction of v turns on the "
        "way, it is not turned all the way from the start",
        lambda S, theta: pose(
            rotation(S[..., :3], theta),
            theta[..., None] * times(rotation(S[..., :3], theta), S[..., 3:]),
        ),
        "the right one with theta R v",
    ),
    Mistake(
        "travel-sign-of-K",
        "R is right, but in the translation the term with K has the wrong sign",
        _with(first=lambda x: -versine(x)),
        "the right one with that sign",
    ),
    Mistake(
        "travel-sign-of-KK",
        "R is right, but in the translation the term with K K has the wrong sign",
        _with(second=lambda x: -rest(x)),
        "the right one with that sign",
    ),
    Mistake(
        "travel-without-K",
        "R is right, but in the translation the term with K is missing",
        _with(first=np.zeros_like),
        "the right one without it",
    ),
    Mistake(
        "travel-without-KK",
        "R is right, but in the translation the term with K K is missing",
        _with(second=np.zeros_like),
        "the right one without it",
    ),
    Mistake(
        "travel-on-a-line",
        "R is right, but the translation is theta v, a straight line; a screw's path "
        "bends",
        _along_a_line,
        "the right one with theta v",
    ),
    Mistake(
        "travel-is-v",
        "R is right, but the translation is v itself, whatever theta is",
        lambda S, theta: pose(rotation(S[..., :3], theta), S[..., 3:]),
        "the right one with v",
    ),
    Mistake(
        "travel-turned",
        "R is right, but the translation is turned by R once more",
        _turned,
        "the right one with R t",
    ),
    Mistake(
        "pitch-forgotten",
        "right for plain hinges and slides; a screw that turns and moves along its "
        "axis loses the part along it",
        _around_the_axis,
        "the right one without that part",
    ),
    Mistake(
        "pitch-without-theta",
        "right for plain hinges and slides; what moves along the axis has to grow with "
        "theta",
        lambda S, theta: _around_the_axis(S, theta, np.ones_like),
        "the right one with that part constant",
    ),
    Mistake(
        "slide-forgotten",
        "right where it turns; with omega = 0 it does not move at all, but it slides",
        _always_turns,
        "the right one with I for slides",
    ),
    Mistake(
        "slide-without-theta",
        "right where it turns; with omega = 0 it slides by v, not by theta v",
        _slides_by_v,
        "the right one with v for slides",
    ),
    Mistake(
        "exp-by-entries",
        "np.exp works on each entry; the exponential of a matrix is a series of "
        "products",
        _by_entries,
        "np.exp of [S] theta",
    ),
    Mistake(
        "moment-used-as-point",
        "v is taken for a point on the axis; it is the velocity of the origin",
        lambda S, theta: pose(
            rotation(S[..., :3], theta),
            S[..., 3:] - times(rotation(S[..., :3], theta), S[..., 3:]),
        ),
        "the turn about the line through v",
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
        EXP_ROTATION,
        "in the rotation, ",
        lambda redo: lambda S, theta: motion(S, theta, turn=redo),
    ),
    # The other two are the angle's sign.
    *applied(without(of_a_pose(), "R-transposed", "inverse-returned"), motion),
]

# What shows in an arm of plain hinges too, and what is no mistake in all of q.
OF_A_HINGE = [m for m in EXP_SCREW if m.slug.split("-")[0] not in ("pitch", "slide")]
OF_THE_FORMULA = [m for m in OF_A_HINGE if m not in _OF_THE_ANGLE]
