"""2.2 `exp_rotation(axis, theta)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Rotation, Row
from labkit.judge.argument_mistakes import OF_AN_ANGLE, SIGN_LOST, SMALL_LEFT_OUT
from robo47 import se3
from robo47.screws import exp_rotation, skew

# A slide, which asks for it too, has no axis.
row = Row(Rotation(), truth=lambda n, x: exp_rotation(n, x) if n.any() else np.eye(3))

I = np.eye(3)  # noqa: E741
Z, OBLIQUE = np.array([0.0, 0.0, 1.0]), np.array([0.0, 0.6, 0.8])


@row.inputs
def _(rng):
    """Return axes of length 1 and angles: the coordinate axes, then drawn ones.

    Some angles are small and one is beyond pi: the formula needs no case of its own.
    One angle comes with two axes, so that no cache can take it for the whole question.
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
    """turns-backwards: it turns the other way: the sine's term has the wrong sign =>
      the rotation by -theta
    minus-square: the last term is subtracted: lengths grow (det R is far from 1)
    square-missing: the term with K K is missing: I + sin K holds for tiny angles only
    sine-term-missing: the term with K itself is missing, so turning by theta and -theta
      is the same => the formula without it
    identity-missing: the identity is missing: at theta = 0 a rotation leaves everything
      as it is => the formula without it
    cosine-for-one-minus-cosine: before K K stands the cosine; at theta = 0 that factor
      has to vanish => the formula with cos
    one-minus-sine: before K K stands 1 minus the sine; at theta = 0 that factor has to
      vanish => the formula with 1 - sin
    sin-and-cos-swapped: sine and cosine have changed places: at theta = 0 it already
      turns => the formula with the two swapped
    coefficients-swapped: the two factors have changed places: the sine belongs to K, 1
      - cos to K K => the formula with the two swapped
    first-order-only: this is I + theta K, the first two terms of the series: right for
      tiny angles => I + theta K
    second-order-only: the series stops after the term with theta squared; it goes on
      for ever => the series cut there
    cosine-before-identity: before the identity stands the cosine; that goes with axis
      axis^T, and I itself with K K => the formula with cos I
    theta-for-sine: before K stands theta; it has to be its sine
    half-angle-not-squared: before K K stands 2 sin(theta / 2); 1 - cos is twice the
      square of that sine => the formula with 2 sin(theta / 2)
    half-angle-without-2: before K K stands the square of sin(theta / 2); 1 - cos is
      twice that => the formula without the 2
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
        "theta-for-sine": (1, theta, 1 - c),
        "half-angle-not-squared": (1, s, 2 * np.sin(theta / 2)),
        "half-angle-without-2": (1, s, np.sin(theta / 2) ** 2),
    }
    return {slug: partial(formula, axis, *f) for slug, f in factors.items()}


@row.wrongs
def _(axis, theta):
    """squared-by-entries: K * K squares each entry; K K is a product of matrices
    exp-by-entries: np.exp works on each entry; the exponential of a matrix is a series
      of products => np.exp of [axis] theta
    bracket-of-a-dyad: the last term is (1 - cos) times axis axis^T; that goes with cos
      I, not with I => the formula with that term
    dyad-without-factor: before axis axis^T the factor 1 - cos is missing: at theta = 0
      it turns already => cos I + sin K + axis axis^T
    always-about-z: it turns about z, whatever the axis is => Rz(theta)
    theta-in-the-bracket: theta is in [axis] already, and sine and cosine take it once
      more; K is made of the axis alone => the formula with [axis theta]
    """
    K = skew(axis)
    dyad = np.outer(axis, axis)
    c, s = np.cos(theta), np.sin(theta)
    return {
        "squared-by-entries": I + s * K + (1 - c) * K**2,
        "exp-by-entries": np.exp(K * theta),
        "bracket-of-a-dyad": I + s * K + (1 - c) * dyad,
        "dyad-without-factor": c * I + s * K + dyad,
        "always-about-z": lambda: se3.Rz(theta),
        "theta-in-the-bracket": I + theta * s * K + theta**2 * (1 - c) * K @ K,
    }


row.of_argument("theta", *OF_AN_ANGLE, SIGN_LOST, *SMALL_LEFT_OUT)

# Of an axis of length 1 "made-unit" changes nothing; "p-cross-w" is the angle's sign.
row.reached_by("skew", "in [axis], ", but=["made-unit", "p-cross-w"])


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
