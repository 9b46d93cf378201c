"""2.2 `exp_rotation(axis, theta)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Rotation, draw
from labkit.judge.row import Row
from robo47 import se3
from robo47.screws import skew

row = Row(Rotation())

I = np.eye(3)  # noqa: E741
Z, OBLIQUE = np.array([0.0, 0.0, 1.0]), np.array([0.0, 0.6, 0.8])


@row.inputs
def _(rng):
    """Return axes of length 1 and angles: the coordinate axes, then drawn ones.

    Some angles are small and one is beyond pi: the formula needs no case of its own.
    One angle comes with two axes, so that no cache can take it for the whole question.
    """
    axes = [Z, *np.eye(3), Z, *[OBLIQUE] * 3, *draw.units(rng, 6)]
    angles = [np.pi / 2, 0.5, -1.2, 2.5, 3.3, 1e-4, -5e-3, 0.5, 0.0]
    angles += map(float, draw.numbers(rng, -3, 3, 5))
    return zip(axes, angles, strict=True)


def formula(axis, one, first, second):
    """Return one I + first K + second K K."""
    K = skew(axis)
    return one * I + first * K + second * K @ K


def rodrigues(axis, theta):
    """Return the right formula; of an axis 0 too, as a slide has it."""
    return formula(axis, 1, np.sin(theta), 1 - np.cos(theta))


@row.wrong
def turns_backwards(axis, theta):
    """it turns the other way: the sine's term has the wrong sign => the rotation by
    -theta"""
    return formula(axis, 1, -np.sin(theta), 1 - np.cos(theta))


@row.wrong
def minus_square(axis, theta):
    """the last term is subtracted: lengths grow (det R is far from 1) => the formula
    with that minus"""
    return formula(axis, 1, np.sin(theta), np.cos(theta) - 1)


@row.wrong
def square_missing(axis, theta):
    """the term with K K is missing: I + sin K holds for tiny angles only => the formula
    without it"""
    return I + np.sin(theta) * skew(axis)


@row.wrong
def sine_term_missing(axis, theta):
    """the term with K itself is missing, so turning by theta and -theta is the same =>
    the formula without it"""
    return formula(axis, 1, 0, 1 - np.cos(theta))


@row.wrong
def identity_missing(axis, theta):
    """the identity is missing: at theta = 0 a rotation leaves everything as it is =>
    the formula without it"""
    return formula(axis, 0, np.sin(theta), 1 - np.cos(theta))


@row.wrong
def cosine_for_one_minus_cosine(axis, theta):
    """before K K stands the cosine; at theta = 0 that factor has to vanish => the
    formula with cos"""
    return formula(axis, 1, np.sin(theta), np.cos(theta))


@row.wrong
def one_minus_sine(axis, theta):
    """before K K stands 1 minus the sine; at theta = 0 that factor has to vanish => the
    formula with 1 - sin"""
    return formula(axis, 1, np.sin(theta), 1 - np.sin(theta))


@row.wrong
def sin_and_cos_swapped(axis, theta):
    """sine and cosine have changed places: at theta = 0 it already turns => the formula
    with the two swapped"""
    return formula(axis, 1, np.cos(theta), 1 - np.sin(theta))


@row.wrong
def coefficients_swapped(axis, theta):
    """the two factors have changed places: the sine belongs to K, 1 - cos to K K => the
    formula with the two swapped"""
    return formula(axis, 1, 1 - np.cos(theta), np.sin(theta))


@row.wrong
def squared_by_entries(axis, theta):
    """K * K squares each entry; K K is a product of matrices => the formula with K *
    K"""
    K = skew(axis)
    return I + np.sin(theta) * K + (1 - np.cos(theta)) * K**2


@row.wrong
def exp_by_entries(axis, theta):
    """np.exp works on each entry; the exponential of a matrix is a series of products
    => np.exp of [axis] theta"""
    return np.exp(skew(axis) * theta)


@row.wrong
def first_order_only(axis, theta):
    """this is I + theta K, the first two terms of the series: right for tiny angles =>
    I + theta K"""
    return I + theta * skew(axis)


@row.wrong
def second_order_only(axis, theta):
    """the series stops after the term with theta squared; it goes on for ever => the
    series cut there"""
    return formula(axis, 1, theta, theta**2 / 2)


@row.wrong
def bracket_of_a_dyad(axis, theta):
    """the last term is (1 - cos) times axis axis^T; that goes with cos I, not with I =>
    the formula with that term"""
    dyad = np.outer(axis, axis)
    return I + np.sin(theta) * skew(axis) + (1 - np.cos(theta)) * dyad


@row.wrong
def dyad_without_factor(axis, theta):
    """before axis axis^T the factor 1 - cos is missing: at theta = 0 it turns already
    => cos I + sin K + axis axis^T"""
    dyad = np.outer(axis, axis)
    return np.cos(theta) * I + np.sin(theta) * skew(axis) + dyad


@row.wrong
def cosine_before_identity(axis, theta):
    """before the identity stands the cosine; that goes with axis axis^T, and I itself
    with K K => the formula with cos I"""
    return formula(axis, np.cos(theta), np.sin(theta), 1 - np.cos(theta))


@row.wrong
def theta_for_sine(axis, theta):
    """before K stands theta; it has to be its sine => the formula with theta K"""
    return formula(axis, 1, theta, 1 - np.cos(theta))


@row.wrong
def always_about_z(axis, theta):
    """it turns about z, whatever the axis is => Rz(theta)"""
    return se3.Rz(theta)


@row.wrong
def radians_taken_for_degrees(axis, theta):
    """the angle is in radians already, and is converted from degrees once more => the
    rotation by pi / 180 times the angle"""
    return rodrigues(axis, np.deg2rad(theta))


@row.wrong
def degrees_into_cos(axis, theta):
    """sine and cosine are given degrees; they expect radians, as the angle comes => the
    rotation by 180 / pi times the angle"""
    return rodrigues(axis, np.rad2deg(theta))


@row.wrong
def half_angle(axis, theta):
    """it turns by half of the angle: that belongs to quaternions => the rotation by
    half of it"""
    return rodrigues(axis, theta / 2)


@row.wrong
def double_angle(axis, theta):
    """it turns by twice the angle; in a quaternion stand sine and cosine of half of it
    => the rotation by twice the angle"""
    return rodrigues(axis, 2 * theta)


@row.wrong
def sign_of_theta_lost(axis, theta):
    """theta and -theta turn the same way: the sign of theta is lost => the rotation by
    |theta|"""
    return rodrigues(axis, np.abs(theta))


for small in (1e-3, 1e-2):  # any bound between two angles that are asked does it

    @row.wrong(
        "small-angle-ignored",
        "a small angle is taken for 0; the formula is exact for small angles too, and "
        "needs no case of its own",
        "the right one with 0 for small angles",
        hidden="the lab draws hardly any angle so small",
    )
    def _(axis, theta, small=small):
        return I if abs(theta) < small else rodrigues(axis, theta)


# Of an axis of length 1 "made-unit" changes nothing; "p-cross-w" is the angle's sign.
row.reached_by("skew", "in [axis], ", but=["made-unit", "p-cross-w"])


@row.close("rounded-somewhere")  # The series to the sixteenth term.
def _(axis, theta):
    out, term = np.eye(3), np.eye(3)
    for k in range(1, 17):
        term = term @ skew(axis) * theta / k
        out = out + term
    return out
