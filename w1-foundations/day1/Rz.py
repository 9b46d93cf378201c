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


@row.wrong(
    "turns-backwards",
    "it turns the wrong way: a positive angle takes x towards -y",
    "Rz(-theta)",
)
def _(theta):
    return se3.Rz(-theta)


@row.wrong(
    "radians-taken-for-degrees",
    "the angle is in radians already, and is converted from degrees once more",
    "the turn by pi / 180 times the angle",
)
def _(theta):
    return se3.Rz(np.deg2rad(theta))


@row.wrong(
    "degrees-into-cos",
    "cos and sin are given degrees; they expect radians, as the angle comes",
    "the turn by 180 / pi times the angle",
)
def _(theta):
    return se3.Rz(np.rad2deg(theta))


@row.wrong("turns-about-x", "this turns about x, not about z", "that turn about x")
def _(theta):
    return se3.Rx(theta)


@row.wrong("turns-about-y", "this turns about y, not about z", "that turn about y")
def _(theta):
    return se3.Ry(theta)


@row.wrong("turns-about-x", "this turns about x, and backwards", "that turn about x")
def _(theta):
    return se3.Rx(-theta)


@row.wrong("turns-about-y", "this turns about y, and backwards", "that turn about y")
def _(theta):
    return se3.Ry(-theta)


@row.wrong(
    "sin-and-cos-swapped",
    "sin and cos have changed places: at 0 it already turns",
    "the right one with the two swapped",
)
def _(theta):
    c, s = np.sin(theta), np.cos(theta)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


@row.wrong(
    "minus-missing",
    "one of the two sines needs a minus: as it is, lengths change (R R^T is not I)",
    "the right one without that minus",
)
def _(theta):
    c, s = np.cos(theta), np.sin(theta)
    return np.array([[c, s, 0], [s, c, 0], [0, 0, 1]])


@row.wrong(
    "minus-twice",
    "only one of the two sines has a minus: as it is, lengths change",
    "the right one with both negated",
)
def _(theta):
    c, s = np.cos(theta), np.sin(theta)
    return np.array([[c, -s, 0], [-s, c, 0], [0, 0, 1]])


@row.wrong(
    "reflection",
    "a cosine has a minus that belongs to a sine: this mirrors (det R = -1)",
    "the right one with that sign",
)
def _(theta):
    c, s = np.cos(theta), np.sin(theta)
    return np.array([[c, s, 0], [s, -c, 0], [0, 0, 1]])


@row.wrong(
    "z-lost",
    "whatever is along z disappears: the last entry is 0, so det R = 0",
    "the right one with a 0 there",
)
def _(theta):
    c, s = np.cos(theta), np.sin(theta)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 0]])


@row.wrong("half-angle", "it turns by half of the angle", "the turn by half of it")
def _(theta):
    return se3.Rz(theta / 2)


@row.wrong("double-angle", "it turns by twice the angle", "the turn by twice as much")
def _(theta):
    return se3.Rz(2 * theta)


for decimals in range(4):
    row.wrong(
        "angle-rounded",
        f"the angle is rounded to {decimals} decimals before it is used",
        "the turn by the rounded angle",
    )(lambda theta, decimals=decimals: se3.Rz(round(float(theta), decimals)))

row.of_answer(OF_A_ROTATION)


@row.right  # A turn of the plane is a product with exp(i theta).
def _(theta):
    x = np.exp(1j * theta)
    y = 1j * x
    return np.array([[x.real, y.real, 0], [x.imag, y.imag, 0], [0, 0, 1]])


@row.close("rounded-somewhere")  # To degrees and back with two different pis.
def _(theta):
    return se3.Rz(np.deg2rad(theta * 180 / 3.14159))


@row.close("rounded")  # Rounded "to get rid of 6e-17".
def _(theta):
    return np.round(se3.Rz(theta), 5)


@row.close("float32")  # All in float32: right to seven digits.
def _(theta):
    c, s = np.float32(np.cos(theta)), np.float32(np.sin(theta))
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]], dtype=np.float32)


@row.wrong("few-entries-off")  # The sine from the cosine: sqrt forgets its sign.
def _(theta):
    c = np.cos(theta)
    s = np.sqrt(1 - c * c)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
