"""1.2 `Rz(theta)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Rotation, Row
from labkit.judge.answer_mistakes import OF_A_ROTATION
from labkit.judge.argument_mistakes import OF_AN_ANGLE
from robo47 import se3

from .panda_chain import BACKWARDS, NEAR

SMALL = (1e-3, -0.04, 0.09)
row = Row(Rotation(), near=NEAR, alike=[BACKWARDS])


@row.inputs
def angles(rng):
    """Return 0, a right angle, angles as in the lab and three random ones.

    Small and large angles are listed, because random angles rarely include them.
    """
    drawn = rng.numbers(-np.pi, np.pi, 3)
    return [
        (x,)
        for x in (0.0, np.pi / 2, -0.785, 2.356, -7.1, *SMALL, 20.3, *map(float, drawn))
    ]


def small_angle_formula(theta, below=0.1):
    """Return Rz where a small angle has a formula that only comes near."""
    if abs(theta) >= below:
        return se3.Rz(theta)
    return np.array([[1, -theta, 0], [theta, 1, 0], [0, 0, 1]])


@row.wrongs(hidden={"small-angle-formula": "the lab draws hardly any angle so small"})
def _(theta):
    """turns-backwards: your code rotates in the wrong direction. A positive angle
      should rotate the x axis towards the y axis
    sin-and-cos-swapped: the sine and the cosine are swapped in your matrix, so at
      `theta` = 0 the matrix already rotates by 90 degrees
    minus-missing: neither of your sines has a minus sign, so the matrix is in general
      not orthonormal. Exactly one of the two sines should have a minus sign
    minus-twice: both of your sines have a minus sign, so the matrix is in general not
      orthonormal. Exactly one of the two sines should have a minus sign
    reflection: a cosine in your matrix is negated instead of a sine, so the matrix is a
      reflection (det R = -1)
    small-angle-formula: if the angle is small, your matrix contains the angle instead
      of its sine and 1 instead of its cosine. Use the sine and the cosine for every
      angle
    z-lost: the last diagonal entry of your matrix is 0, so the matrix sets the z
      component of every point to 0. This entry should be 1
    """
    c, s = np.cos(theta), np.sin(theta)
    return {
        "turns-backwards": se3.Rz(-theta),
        "sin-and-cos-swapped": np.array([[s, -c, 0], [c, s, 0], [0, 0, 1]]),
        "minus-missing": np.array([[c, s, 0], [s, c, 0], [0, 0, 1]]),
        "minus-twice": np.array([[c, -s, 0], [-s, c, 0], [0, 0, 1]]),
        "reflection": np.array([[c, s, 0], [s, -c, 0], [0, 0, 1]]),
        "small-angle-formula": lambda: small_angle_formula(theta),
        "z-lost": np.array([[c, -s, 0], [s, c, 0], [0, 0, 0]]),
    }


for axis, about in (("x", se3.Rx), ("y", se3.Ry)):
    says = f"your code rotates about the {axis} axis instead of the z axis"
    row.wrong(f"turns-about-{axis}", says)(about)
    says = f"your code rotates about the -{axis} axis instead of the z axis"
    row.wrong(f"turns-about-{axis}", says)(lambda theta, about=about: about(-theta))


row.of_argument("theta", *OF_AN_ANGLE)
row.of_answer(OF_A_ROTATION)


@row.close("rounded")  # Rounded "to get rid of 6e-17".
def _(theta):
    return np.round(se3.Rz(theta), 5)


@row.wrong("slip-sign-lost")  # The sine from the cosine: sqrt forgets its sign.
def _(theta):
    c = np.cos(theta)
    s = np.sqrt(1 - c * c)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
