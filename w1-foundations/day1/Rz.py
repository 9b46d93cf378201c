"""1.2 `Rz(theta)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Rotation, Row
from labkit.judge.answer_mistakes import OF_A_ROTATION
from labkit.judge.argument_mistakes import OF_AN_ANGLE, ROUNDED
from robo47 import se3

from .panda_chain import BACKWARDS, NEAR

SMALL = (1e-3, -0.04, 0.09)
row = Row(Rotation(), near=NEAR, alike=[BACKWARDS])


@row.inputs
def angles(rng):
    """Return no turn, a right angle, some as in the lab and three drawn ones.

    Small ones and large ones stand there on purpose: nobody draws them every time.
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
    """turns-backwards: it turns the wrong way: a positive angle takes x towards -y =>
      Rz(-theta)
    sin-and-cos-swapped: sin and cos have changed places: at 0 it already turns
    minus-missing: one of the two sines needs a minus: as it is, lengths change (R R^T
      is not I) => the right one without that minus
    minus-twice: only one of the two sines has a minus: as it is, lengths change
    reflection: a cosine has a minus that belongs to a sine: this mirrors (det R = -1)
    small-angle-formula: a small theta has a formula of its own, sin theta = theta and
      cos theta = 1, which is not exact; the sine and cosine are
    z-lost: whatever is along z disappears: the last entry is 0, so det R = 0 => the
      right one with a 0 there
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
    says = f"this turns about {axis}, not about z"
    row.wrong(f"turns-about-{axis}", says, f"that turn about {axis}")(about)
    says = f"this turns about {axis}, and backwards"
    row.wrong(f"turns-about-{axis}", says, f"that turn about {axis}")(
        lambda theta, about=about: about(-theta)
    )


row.of_argument("theta", *OF_AN_ANGLE, *ROUNDED)
row.of_answer(OF_A_ROTATION)


@row.close("rounded")  # Rounded "to get rid of 6e-17".
def _(theta):
    return np.round(se3.Rz(theta), 5)


@row.wrong("slip-sign-lost")  # The sine from the cosine: sqrt forgets its sign.
def _(theta):
    c = np.cos(theta)
    s = np.sqrt(1 - c * c)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
