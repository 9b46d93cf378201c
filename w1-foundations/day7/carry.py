"""7.8 `carry(m1, c1, I1, m2, c2, I2)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Vector, draw
from labkit.judge.row import Row
from robo47.trajectory import carry

TEN = ("the mass", "x", "y", "z", "xx", "yy", "zz", "xy", "xz", "yz")

row = Row(Vector((10,), names=TEN))


@row.inputs
def _(rng):
    none, two = np.zeros((3, 3)), np.array([2.0, 0.0, 0.0])
    yield 1.0, np.zeros(3), none, 1.0, two, none
    m1, m2 = draw.numbers(rng, 0.2, 3.0, 2, 8)
    c1, c2 = draw.numbers(rng, -0.5, 0.5, 2, 8, 3)
    half = draw.numbers(rng, -0.5, 0.5, 2, 8, 3, 3)
    I1, I2 = draw.rounded(half @ np.swapaxes(half, -1, -2) + np.eye(3))
    yield from zip(m1.tolist(), c1, I1, m2.tolist(), c2, I2, strict=True)


def centre(m1, c1, m2, c2):
    """Return the common centre of mass."""
    return (m1 * c1 + m2 * c2) / (m1 + m2)


def parallel_axes(d):
    """Return the inertia of 1 kg that is d away: the parallel-axis theorem."""
    return d @ d * np.eye(3) - np.outer(d, d)


def ten(m, c, inertia):
    """Return the answer's ten numbers."""
    return np.array([m, *c, *inertia[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]])


def about(c, m1, c1, I1, m2, c2, I2):
    """Return the answer with another centre."""
    return ten(
        m1 + m2, c, I1 + m1 * parallel_axes(c1 - c) + I2 + m2 * parallel_axes(c2 - c)
    )


def by_theorem(theorem, m1, c1, I1, m2, c2, I2):
    """Return the answer with another theorem instead of `parallel_axes`."""
    c = centre(m1, c1, m2, c2)
    return ten(m1 + m2, c, I1 + m1 * theorem(c1 - c) + I2 + m2 * theorem(c2 - c))


@row.wrong
def no_parallel_axes(m1, c1, I1, m2, c2, I2):
    """the inertias are added as they are; each is about its own centre, and has to be
    moved to the common one first => the answer without parallel axes"""
    return ten(m1 + m2, centre(m1, c1, m2, c2), I1 + I2)


@row.wrong
def about_the_origin(m1, c1, I1, m2, c2, I2):
    """the inertia is about the frame's origin; it belongs to the common centre => the
    answer about the origin"""
    m, c = m1 + m2, centre(m1, c1, m2, c2)
    return ten(m, c, I1 + m1 * parallel_axes(c1) + I2 + m2 * parallel_axes(c2))


@row.wrong
def only_the_second_moved(m1, c1, I1, m2, c2, I2):
    """only the second body's inertia is moved; the first one's centre is not the common
    one either => the answer with only the second moved"""
    m, c = m1 + m2, centre(m1, c1, m2, c2)
    return ten(m, c, I1 + I2 + m2 * parallel_axes(c2 - c))


@row.wrong
def only_the_first_moved(m1, c1, I1, m2, c2, I2):
    """only the first body's inertia is moved => the answer with only the first moved"""
    m, c = m1 + m2, centre(m1, c1, m2, c2)
    return ten(m, c, I1 + m1 * parallel_axes(c1 - c) + I2)


@row.wrong
def about_the_first_centre(m1, c1, I1, m2, c2, I2):
    """the inertia is about the first body's centre; it belongs to the common one => the
    answer about the first centre"""
    m, c = m1 + m2, centre(m1, c1, m2, c2)
    return ten(m, c, I1 + I2 + m2 * parallel_axes(c2 - c1))


@row.wrong
def distance_of_the_two(m1, c1, I1, m2, c2, I2):
    """the distance between the two centres is used for both; each moves to the common
    centre => the answer with that distance twice"""
    m, c = m1 + m2, centre(m1, c1, m2, c2)
    return ten(m, c, I1 + I2 + m * parallel_axes(c2 - c1))


@row.wrong
def parallel_axes_sign(m1, c1, I1, m2, c2, I2):
    """moving away from the centre of mass adds inertia; here it is taken off => the
    answer with a minus"""
    return by_theorem(lambda d: -parallel_axes(d), m1, c1, I1, m2, c2, I2)


@row.wrong
def along_the_way_too(m1, c1, I1, m2, c2, I2):
    """the term d.d I alone resists a turn about the line between the centres too; d d^T
    has to come off => the answer without d d^T"""
    return by_theorem(lambda d: d @ d * np.eye(3), m1, c1, I1, m2, c2, I2)


@row.wrong
def only_the_dyad(m1, c1, I1, m2, c2, I2):
    """d d^T alone is what comes off; d.d I is missing => the answer with d d^T"""
    return by_theorem(lambda d: np.outer(d, d), m1, c1, I1, m2, c2, I2)


@row.wrong
def dyad_sign(m1, c1, I1, m2, c2, I2):
    """d d^T has to come off, not to be added => the answer with + d d^T"""
    return by_theorem(
        lambda d: d @ d * np.eye(3) + np.outer(d, d), m1, c1, I1, m2, c2, I2
    )


@row.wrong
def distance_not_squared(m1, c1, I1, m2, c2, I2):
    """the theorem takes the distance squared => the answer with |d|"""
    return by_theorem(
        lambda d: np.linalg.norm(d) * np.eye(3) - np.outer(d, d), m1, c1, I1, m2, c2, I2
    )


@row.wrong
def mass_not_in_the_theorem(m1, c1, I1, m2, c2, I2):
    """the theorem is m (d.d I - d d^T); here the mass is missing => the answer without
    the masses there"""
    m, c = m1 + m2, centre(m1, c1, m2, c2)
    return ten(m, c, I1 + parallel_axes(c1 - c) + I2 + parallel_axes(c2 - c))


@row.wrong
def total_mass_for_each(m1, c1, I1, m2, c2, I2):
    """in the theorem, both bodies have the mass of the whole; each has its own => the
    answer with m1 + m2 there"""
    m, c = m1 + m2, centre(m1, c1, m2, c2)
    return ten(m, c, I1 + m * parallel_axes(c1 - c) + I2 + m * parallel_axes(c2 - c))


@row.wrong
def masses_exchanged(m1, c1, I1, m2, c2, I2):
    """in the theorem, each body has the mass of the other => the answer with m1 and m2
    exchanged there"""
    m, c = m1 + m2, centre(m1, c1, m2, c2)
    return ten(m, c, I1 + m2 * parallel_axes(c1 - c) + I2 + m1 * parallel_axes(c2 - c))


@row.wrong
def inertia_of_one(m1, c1, I1, m2, c2, I2):
    """the second body's own inertia I2 is missing => the answer without I2"""
    return carry(m1, c1, I1, m2, c2, 0.0 * I2)


@row.wrong
def inertia_of_one(m1, c1, I1, m2, c2, I2):
    """the first body's own inertia I1 is missing => the answer without I1"""
    return carry(m1, c1, 0.0 * I1, m2, c2, I2)


@row.wrong
def plain_mean(m1, c1, I1, m2, c2, I2):
    """the common centre is half way; the heavier body counts for more => the answer
    with the plain mean"""
    return about((c1 + c2) / 2, m1, c1, I1, m2, c2, I2)


@row.wrong
def weights_swapped(m1, c1, I1, m2, c2, I2):
    """the centre is nearer to the lighter body: the masses are swapped => the answer
    with the masses swapped"""
    return about(centre(m2, c1, m1, c2), m1, c1, I1, m2, c2, I2)


@row.wrong
def not_divided_by_the_mass(m1, c1, I1, m2, c2, I2):
    """the sum of m c is not divided by the mass => the answer with the sum of m c"""
    return about(m1 * c1 + m2 * c2, m1, c1, I1, m2, c2, I2)


@row.wrong
def first_centre_kept(m1, c1, I1, m2, c2, I2):
    """the centre of mass stays that of the first body => the answer with the first
    centre"""
    return about(c1, m1, c1, I1, m2, c2, I2)


@row.wrong
def by_rows(m1, c1, I1, m2, c2, I2):
    """the six come row by row (xx, xy, xz, yy, yz, zz); the diagonal comes first => the
    answer with the six by rows"""
    return carry(m1, c1, I1, m2, c2, I2)[[0, 1, 2, 3, 4, 7, 8, 5, 9, 6]]


@row.wrong
def xy_last(m1, c1, I1, m2, c2, I2):
    """the last three are in the order yz, xz, xy; xy comes first => the answer with yz,
    xz, xy"""
    return carry(m1, c1, I1, m2, c2, I2)[[0, 1, 2, 3, 4, 5, 6, 9, 8, 7]]


@row.wrong
def products_negated(m1, c1, I1, m2, c2, I2):
    """the last three have the other sign: here they are entries of the matrix => the
    answer with the signs of xy, xz, yz turned"""
    return carry(m1, c1, I1, m2, c2, I2) * [1, 1, 1, 1, 1, 1, 1, -1, -1, -1]


@row.wrong
def mass_of_the_first(m1, c1, I1, m2, c2, I2):
    """the mass is that of the first body alone => the answer with the first mass"""
    return np.append(m1, carry(m1, c1, I1, m2, c2, I2)[1:])


@row.right  # The reduced mass and the distance of the two, in a list.
def _(m1, c1, I1, m2, c2, I2):
    d, m = c2 - c1, m1 + m2
    i = I1 + I2 + m1 * m2 / m * (np.dot(d, d) * np.eye(3) - d[:, None] * d[None, :])
    return [m, *(c1 + m2 / m * d), *np.diag(i), i[0, 1], i[0, 2], i[1, 2]]


@row.close("rounded")  # To six digits.
def _(m1, c1, I1, m2, c2, I2):
    return np.round(carry(m1, c1, I1, m2, c2, I2), 6)
