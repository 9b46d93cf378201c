"""Mistakes in task 2.4 `exp_screw(S, theta)` whose rotation is right: the travel."""

import numpy as np

from labkit.judge.matrices import pose, times
from labkit.judge.mistake import Mistake
from robo47.checks import Array

from .moves import Function, motion, rest, rotation, travel, versine
from .turns import SMALL


def _with(**changed: Function) -> Function:
    """Return exp_screw with another travel."""
    return lambda S, theta: motion(S, theta, go=lambda S, x: travel(S, x, **changed))


def _along_a_line(S: Array, theta: Array) -> Array:
    return pose(rotation(S[..., :3], theta), theta[..., None] * S[..., 3:])


def _turned(S: Array, theta: Array) -> Array:
    R = rotation(S[..., :3], theta)
    return pose(R, times(R, travel(S, theta)))


def _around_the_axis(
    S: Array, theta: Array, along: Function = np.zeros_like, side: float = 1.0
) -> Array:
    """Return (I - R) (omega x v), and what is along the axis."""
    omega, v = S[..., :3], S[..., 3:]
    R = rotation(omega, theta)
    slides = ~omega.any(axis=-1)[..., None]
    point = side * times(np.eye(3) - R, np.cross(omega, v))
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


def _over_theta(S: Array, theta: Array) -> Array:
    """Return the motion whose travel is divided by theta; none at theta = 0."""
    by = np.where(theta == 0, 1.0, theta)[..., None]
    return pose(rotation(S[..., :3], theta), travel(S, theta) / by)


def _not_when_small(S: Array, theta: Array, small: float) -> Array:
    return motion(S, np.where(np.abs(theta) < small, 0.0, theta))


TRAVEL = [
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
        "travel-over-theta",
        "R is right, but in the translation theta is missing: the whole of it is "
        "divided by theta",
        _over_theta,
        "the right one with t / theta",
    ),
    Mistake(
        "travel-K-for-KK",
        "R is right, but in the last term of the translation stands K, not K K",
        _with(first=lambda x: versine(x) + rest(x), second=np.zeros_like),
        "the right one with K there",
    ),
    Mistake(
        "sign-of-the-point",
        "R is right, but the point on the axis has the wrong sign: it is omega x v, "
        "and (I - R) stands before it",
        lambda S, theta: _around_the_axis(S, theta, np.positive, -1.0),
        "the right one with that sign",
    ),
    Mistake(
        "hinge-at-the-origin-forgotten",
        "right unless v is 0; with v = 0 it does not move at all, but such a screw "
        "turns about a line through the origin",
        lambda S, theta: motion(S, theta * S[..., 3:].any(axis=-1)),
        "the right one with I where v is 0",
    ),
    Mistake(
        "theta-wrapped",
        "right for theta from -pi to pi; theta is brought into that range, but what "
        "moves along the axis has no such period",
        lambda S, theta: motion(S, (theta + np.pi) % (2 * np.pi) - np.pi),
        "the motion by that angle",
    ),
    *(
        Mistake(
            "small-angle-ignored",
            "a small theta is taken for 0; the formula is exact for small ones too, "
            "and needs no case of its own",
            lambda S, theta, small=small: _not_when_small(S, theta, small),
            "the right one with 0 for small theta",
        )
        for small in SMALL
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
