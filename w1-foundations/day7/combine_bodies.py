"""7.8 `combine_bodies(m1, c1, I1, m2, c2, I2)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector, rounded
from robo47.lifting import combine_bodies

TEN = ("the mass", "x", "y", "z", "xx", "yy", "zz", "xy", "xz", "yz")

row = Row(Vector((10,), names=TEN))


@row.inputs
def _(rng):
    none = np.zeros((3, 3))
    two = np.array([2.0, 0.0, 0.0])
    yield 1.0, np.zeros(3), none, 1.0, two, none
    m1, m2 = rng.numbers(0.2, 3.0, 2, 8)
    c1, c2 = rng.numbers(-0.5, 0.5, 2, 8, 3)
    half = rng.numbers(-0.5, 0.5, 2, 8, 3, 3)
    I1, I2 = rounded(half @ np.swapaxes(half, -1, -2) + np.eye(3))
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


def whole(m1, c1, I1, m2, c2, I2, c, theorem=parallel_axes):
    """Return the answer with another centre, or another theorem."""
    return ten(m1 + m2, c, I1 + m1 * theorem(c1 - c) + I2 + m2 * theorem(c2 - c))


@row.wrongs
def _(m1, c1, I1, m2, c2, I2):
    """no-parallel-axes: the inertias are added as they are; each is about its own
      centre, and has to be moved to the common one first
    about-the-origin: the inertia is about the frame's origin; it belongs to the common
      centre => the answer about the origin
    only-the-second-moved: only the second body's inertia is moved; the first one's
      centre is not the common one either => the answer with only the second moved
    only-the-first-moved: only the first body's inertia is moved
    about-the-first-centre: the inertia is about the first body's centre; it belongs to
      the common one => the answer about the first centre
    distance-of-the-two: the distance between the two centres is used for both; each
      moves to the common centre => the answer with that distance twice
    mass-not-in-the-theorem: the theorem is m (d.d I - d d^T); here the mass is missing
    total-mass-for-each: in the theorem, both bodies have the mass of the whole; each
      has its own => the answer with m1 + m2 there
    masses-exchanged: in the theorem, each body has the mass of the other => the answer
      with m1 and m2 exchanged there
    inertia-of-one: the second body's own inertia I2 is missing => the answer without I2
    """
    m = m1 + m2
    c = centre(m1, c1, m2, c2)
    own = I1 + I2
    first, second = parallel_axes(c1 - c), parallel_axes(c2 - c)
    both = parallel_axes(c2 - c1)
    about = {
        "no-parallel-axes": own,
        "about-the-origin": own + m1 * parallel_axes(c1) + m2 * parallel_axes(c2),
        "only-the-second-moved": own + m2 * second,
        "only-the-first-moved": own + m1 * first,
        "about-the-first-centre": own + m2 * both,
        "distance-of-the-two": own + m * both,
        "mass-not-in-the-theorem": own + first + second,
        "total-mass-for-each": own + m * (first + second),
        "masses-exchanged": own + m2 * first + m1 * second,
        "inertia-of-one": I1 + m1 * first + m2 * second,
    }
    return {slug: ten(m, c, inertia) for slug, inertia in about.items()}


@row.wrongs
def _(m1, c1, I1, m2, c2, I2):
    """parallel-axes-sign: moving away from the centre of mass adds inertia; here it is
      taken off => the answer with a minus
    along-the-way-too: the term d.d I alone resists a turn about the line between the
      centres too; d d^T has to come off => the answer without d d^T
    only-the-dyad: d d^T alone is what comes off; d.d I is missing
    dyad-sign: d d^T has to come off, not to be added => the answer with + d d^T
    products-not-moved: the products of inertia are moved by nothing; d d^T has entries
      beside its diagonal, too => the answer with the diagonal of d d^T
    distance-not-squared: the theorem takes the distance squared => the answer with |d|
    """
    c = centre(m1, c1, m2, c2)
    theorems = {
        "parallel-axes-sign": lambda d: -parallel_axes(d),
        "along-the-way-too": lambda d: d @ d * np.eye(3),
        "only-the-dyad": lambda d: np.outer(d, d),
        "dyad-sign": lambda d: d @ d * np.eye(3) + np.outer(d, d),
        "products-not-moved": lambda d: d @ d * np.eye(3) - np.diag(d * d),
        "distance-not-squared": lambda d: np.sqrt(d @ d) * np.eye(3) - np.outer(d, d),
    }
    return {
        slug: whole(m1, c1, I1, m2, c2, I2, c, some) for slug, some in theorems.items()
    }


@row.wrongs
def _(m1, c1, I1, m2, c2, I2):
    """plain-mean: the common centre is half way; the heavier body counts for more
    weights-swapped: the centre is nearer to the lighter body: the masses are swapped
    not-divided-by-the-mass: the sum of m c is not divided by the mass
    first-centre-kept: the centre of mass stays that of the first body
    """
    centres = {
        "plain-mean": (c1 + c2) / 2,
        "weights-swapped": centre(m2, c1, m1, c2),
        "not-divided-by-the-mass": m1 * c1 + m2 * c2,
        "first-centre-kept": c1,
    }
    return {slug: whole(m1, c1, I1, m2, c2, I2, c) for slug, c in centres.items()}


@row.wrongs
def _(m1, c1, I1, m2, c2, I2):
    """by-rows: the six come row by row (xx, xy, xz, yy, yz, zz); the diagonal comes
      first => the answer with the six by rows
    xy-last: the last three are in the order yz, xz, xy; xy comes first
    products-negated: the last three have the other sign: here they are entries of the
      matrix => the answer with the signs of xy, xz, yz turned
    mass-of-the-first: the mass is that of the first body alone
    inertia-of-one: the first body's own inertia I1 is missing => the answer without I1
    """
    right = combine_bodies(m1, c1, I1, m2, c2, I2)
    return {
        "by-rows": right[[0, 1, 2, 3, 4, 7, 8, 5, 9, 6]],
        "xy-last": right[[0, 1, 2, 3, 4, 5, 6, 9, 8, 7]],
        "products-negated": right * [1, 1, 1, 1, 1, 1, 1, -1, -1, -1],
        "mass-of-the-first": np.append(m1, right[1:]),
        "inertia-of-one": combine_bodies(m1, c1, 0.0 * I1, m2, c2, I2),
    }


@row.right  # The reduced mass and the distance of the two, in a list.
def _(m1, c1, I1, m2, c2, I2):
    d = c2 - c1
    m = m1 + m2
    i = I1 + I2 + m1 * m2 / m * (np.dot(d, d) * np.eye(3) - d[:, None] * d[None, :])
    return [m, *(c1 + m2 / m * d), *np.diag(i), i[0, 1], i[0, 2], i[1, 2]]


@row.close("rounded")  # To six digits.
def _(m1, c1, I1, m2, c2, I2):
    return np.round(combine_bodies(m1, c1, I1, m2, c2, I2), 6)


row.at_least_0(m1="a mass", m2="a mass")


row.spans(  # as small, or as large, as in the lab
    c1=(lambda c1: 0.2 * c1,),
    I1=(lambda I1: 0.009 * I1,),
    m2=(0.08,),
    I2=(lambda I2: 2e-05 * I2,),
)
