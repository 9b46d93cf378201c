"""1.2 `Rz(theta)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Rotation, draw
from labkit.judge.finished import OF_A_ROTATION
from labkit.judge.row import Row
from robo47 import se3

from .panda_chain import BACKWARDS, NEAR

row = Row(Rotation(), near=NEAR, alike=[BACKWARDS])


@row.inputs
def angles(rng):
    """Return no turn, a right angle, some as in the lab and three drawn ones."""
    drawn = draw.numbers(rng, -np.pi, np.pi, 3)
    return [(x,) for x in (0.0, np.pi / 2, -0.785, 2.356, -7.1, *map(float, drawn))]


@row.wrong
def turns_backwards(theta):
    """it turns the wrong way: a positive angle takes x towards -y => Rz(-theta)"""
    return se3.Rz(-theta)


@row.wrong
def radians_taken_for_degrees(theta):
    """the angle is in radians already, and is converted from degrees once more => the
    turn by pi / 180 times the angle"""
    return se3.Rz(np.deg2rad(theta))


@row.wrong
def degrees_into_cos(theta):
    """cos and sin are given degrees; they expect radians, as the angle comes => the
    turn by 180 / pi times the angle"""
    return se3.Rz(np.rad2deg(theta))


for axis, about in (("x", se3.Rx), ("y", se3.Ry)):
    says = f"this turns about {axis}, not about z"
    row.wrong(f"turns-about-{axis}", says, f"that turn about {axis}")(about)
    says = f"this turns about {axis}, and backwards"
    row.wrong(f"turns-about-{axis}", says, f"that turn about {axis}")(
        lambda theta, about=about: about(-theta)
    )


@row.wrong
def sin_and_cos_swapped(theta):
    """sin and cos have changed places: at 0 it already turns => the right one with the
    two swapped"""
    c, s = np.sin(theta), np.cos(theta)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


@row.wrong
def minus_missing(theta):
    """one of the two sines needs a minus: as it is, lengths change (R R^T is not I) =>
    the right one without that minus"""
    c, s = np.cos(theta), np.sin(theta)
    return np.array([[c, s, 0], [s, c, 0], [0, 0, 1]])


@row.wrong
def minus_twice(theta):
    """only one of the two sines has a minus: as it is, lengths change => the right one
    with both negated"""
    c, s = np.cos(theta), np.sin(theta)
    return np.array([[c, -s, 0], [-s, c, 0], [0, 0, 1]])


@row.wrong
def reflection(theta):
    """a cosine has a minus that belongs to a sine: this mirrors (det R = -1) => the
    right one with that sign"""
    c, s = np.cos(theta), np.sin(theta)
    return np.array([[c, s, 0], [s, -c, 0], [0, 0, 1]])


@row.wrong
def z_lost(theta):
    """whatever is along z disappears: the last entry is 0, so det R = 0 => the right
    one with a 0 there"""
    c, s = np.cos(theta), np.sin(theta)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 0]])


@row.wrong
def half_angle(theta):
    """it turns by half of the angle => the turn by half of it"""
    return se3.Rz(theta / 2)


@row.wrong
def double_angle(theta):
    """it turns by twice the angle => the turn by twice as much"""
    return se3.Rz(2 * theta)


for decimals in range(4):
    row.wrong(
        "angle-rounded",
        f"the angle is rounded to {decimals} decimals before it is used",
        "the turn by the rounded angle",
    )(lambda theta, decimals=decimals: se3.Rz(round(float(theta), decimals)))

row.of_answer(OF_A_ROTATION)


@row.close("rounded")  # Rounded "to get rid of 6e-17".
def _(theta):
    return np.round(se3.Rz(theta), 5)


@row.wrong("few-entries-off")  # The sine from the cosine: sqrt forgets its sign.
def _(theta):
    c = np.cos(theta)
    s = np.sqrt(1 - c * c)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
