"""2.2 `exp_rotation(axis, theta)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Rotation, Row
from labkit.judge.argument_mistakes import OF_AN_ANGLE
from robo47 import se3
from robo47.screws import exp_rotation, skew

# A slide, which asks for it too, has no axis.
row = Row(Rotation(), truth=lambda n, x: exp_rotation(n, x) if n.any() else np.eye(3))

I = np.eye(3)  # noqa: E741
Z, OBLIQUE = np.array([0.0, 0.0, 1.0]), np.array([0.0, 0.6, 0.8])


@row.inputs
def _(rng):
    """Return unit axes and angles: the coordinate axes, then random ones.

    Some angles are small and one is beyond pi, because the formula holds for all. One
    angle comes with two axes, so that a cache of angles is detected.
    """
    axes = [Z, *np.eye(3), Z, *[OBLIQUE] * 7, Z, *rng.units(6)]
    angles = [np.pi / 2, 0.5, -1.2, 2.5, 3.3, 1e-4, 3e-7, -5e-3, 0.05, 0.099, 0.5, 9.5]
    angles += [-20.3, 0.0]
    angles += map(float, rng.numbers(-3, 3, 5))
    return zip(axes, angles, strict=True)


def formula(axis, one, first, second):
    """Return one I + first K + second K K."""
    K = skew(axis)
    return one * I + first * K + second * K @ K


def rodrigues(axis, theta):
    """Return the right formula; of an axis 0 too, as a slide has it."""
    return formula(axis, 1, np.sin(theta), 1 - np.cos(theta))


@row.wrongs
def _(axis, theta):
    """turns-backwards: your code rotates in the wrong direction. The correct rotation
      follows the right-hand rule about the axis
    minus-square: the K^2 term of your matrix has the wrong sign, so the matrix is in
      general not orthonormal
    square-missing: your code omits the K^2 term. Without this term, the matrix is
      orthonormal only to first order in theta
    sine-term-missing: your code omits the term sin(theta) K, so the matrices for
      theta and -theta are equal
    identity-missing: your matrix is the correct matrix minus the identity matrix. The
      result at theta = 0 should be the identity matrix
    cosine-for-one-minus-cosine: the coefficient of K^2 in your matrix is cos(theta)
      instead of 1 - cos(theta). If your formula contains axis axis^T, cos(theta) and 1
      - cos(theta) are swapped
    one-minus-sine: your matrix contains sin(theta) instead of cos(theta), so the matrix
      is not the identity at theta = 0
    sin-and-cos-swapped: the sine and the cosine are swapped in your matrix, so the
      matrix is not the identity at theta = 0
    coefficients-swapped: the coefficients of K and K^2 are swapped in your matrix. The
      coefficient of K should be sin(theta), and the coefficient of K^2 should be 1 -
      cos(theta)
    first-order-only: your matrix is I + theta K, which is accurate only for small
      angles. Use the closed form with the sine and the cosine
    second-order-only: your matrix contains only the terms up to theta^2, so the matrix
      is accurate only for small angles. Use the closed form with the sine and the
      cosine
    cosine-before-identity: your matrix contains cos(theta) I instead of I. The factor
      cos(theta) is needed only if the formula contains axis axis^T instead of K^2
    half-angle-not-squared: the coefficient of K^2 in your matrix is 2 sin(theta / 2).
      The coefficient should be 1 - cos(theta), which equals 2 sin(theta / 2)^2
    """
    c, s = np.cos(theta), np.sin(theta)
    factors = {
        "turns-backwards": (1, -s, 1 - c),
        "minus-square": (1, s, c - 1),
        "square-missing": (1, s, 0),
        "sine-term-missing": (1, 0, 1 - c),
        "identity-missing": (0, s, 1 - c),
        "cosine-for-one-minus-cosine": (1, s, c),
        "one-minus-sine": (1, s, 1 - s),
        "sin-and-cos-swapped": (1, c, 1 - s),
        "coefficients-swapped": (1, 1 - c, s),
        "first-order-only": (1, theta, 0),
        "second-order-only": (1, theta, theta**2 / 2),
        "cosine-before-identity": (c, s, 1 - c),
        "half-angle-not-squared": (1, s, 2 * np.sin(theta / 2)),
    }
    return {slug: partial(formula, axis, *f) for slug, f in factors.items()}


@row.wrongs
def _(axis, theta):
    """exp-by-entries: your matrix is the exponential of each entry, as `np.exp` returns
      it. Use the matrix exponential instead, which is a series of matrix powers
    bracket-of-a-dyad: your matrix contains both axis axis^T and I without the factor
      cos(theta). Either multiply I by cos(theta), or use K^2 instead of axis axis^T
    dyad-without-factor: your code omits the factor 1 - cos(theta) in front of axis
      axis^T, so the matrix is not the identity at theta = 0
    dyad-missing: your code omits the term (1 - cos(theta)) axis axis^T. This term is
      needed because a rotation does not change vectors along the axis
    always-about-z: your code rotates about z for every axis. Use the given axis instead
    parallel-part-shortened: your matrix multiplies the component along the axis by
      cos(theta). Multiply the component perpendicular to the axis instead, because a
      rotation does not change vectors along the axis
    """
    K = skew(axis)
    dyad = np.outer(axis, axis)
    c, s = np.cos(theta), np.sin(theta)
    return {
        "exp-by-entries": np.exp(K * theta),
        "bracket-of-a-dyad": I + s * K + (1 - c) * dyad,
        "dyad-without-factor": c * I + s * K + dyad,
        "dyad-missing": c * I + s * K,
        "always-about-z": lambda: se3.Rz(theta),
        "parallel-part-shortened": I + s * K + (c - 1) * dyad,
    }


@row.right  # By the unit quaternion, entry by entry.
def _(axis, theta):
    w = np.cos(theta / 2)  # the scalar part of the quaternion
    x, y, z = np.sin(theta / 2) * axis  # the vector part of the quaternion
    return np.array(
        [
            [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
        ]
    )


row.of_argument("theta", *OF_AN_ANGLE)

# Without the sign of the angle.
row.reached_by(
    "skew",
    "in the skew-symmetric matrix [axis], ",
    but=["p-cross-w"],
    called={"w_": "axis_", " w ": " axis "},
)


@row.close("rounded-somewhere")  # Public code: below a millionth there is no turn.
def _(axis, theta):
    return rodrigues(axis, theta if abs(theta) >= 1e-6 else 0.0)


@row.close("rounded-somewhere")  # The series to the sixteenth term, within +-pi.
def _(axis, theta):
    theta = np.remainder(theta + np.pi, 2.0 * np.pi) - np.pi
    out, term = np.eye(3), np.eye(3)
    for k in range(1, 17):
        term = term @ skew(axis) * theta / k
        out = out + term
    return out


row.spans(  # as small, or as large, as in the lab
    theta=(200.0,),
)
