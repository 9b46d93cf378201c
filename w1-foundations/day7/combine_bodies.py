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
    """Return the inertia of a point of 1 kg at d: the parallel-axis theorem."""
    return d @ d * np.eye(3) - np.outer(d, d)


def ten(m, c, inertia):
    """Return mass, centre of mass and inertia as one vector, (10,)."""
    return np.array([m, *c, *inertia[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]])


def whole(m1, c1, I1, m2, c2, I2, c, theorem=parallel_axes):
    """Return the answer with another centre or another parallel-axis theorem."""
    return ten(m1 + m2, c, I1 + m1 * theorem(c1 - c) + I2 + m2 * theorem(c2 - c))


@row.wrongs
def _(m1, c1, I1, m2, c2, I2):
    """no-parallel-axes: your code adds I1 and I2 unchanged. First move both inertias to
      the common centre of mass, because each inertia is given about its own body's
      centre of mass
    about-the-origin: your code returns the inertia about the origin of the frame.
      Return the inertia about the common centre of mass instead
    only-the-second-moved: your code moves only I2 to the common centre of mass. Move I1
      as well, because c1 also differs from the common centre of mass
    only-the-first-moved: your code moves only I1 to the common centre of mass. Move I2
      as well, because c2 also differs from the common centre of mass
    about-the-first-centre: your code returns the inertia about the first body's centre
      of mass. Return the inertia about the common centre of mass instead
    distance-of-the-two: your code uses the distance between c1 and c2 in the
      parallel-axis theorem. Use the distance of each centre of mass from the common
      centre of mass instead
    mass-not-in-the-theorem: your code omits the mass from the parallel-axis theorem.
      For a body with mass m and offset d from the common centre of mass, the theorem
      adds m ((d . d) E - d d^T), where E is the identity matrix
    total-mass-for-each: your code uses the total mass for each body in the
      parallel-axis theorem. Use the mass of the body whose inertia is moved instead
    """
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
        "distance-of-the-two": own + (m1 + m2) * both,
        "mass-not-in-the-theorem": own + first + second,
        "total-mass-for-each": own + (m1 + m2) * (first + second),
    }
    return {slug: ten(m1 + m2, c, inertia) for slug, inertia in about.items()}


@row.wrongs
def _(m1, c1, I1, m2, c2, I2):
    """products-not-moved: your code applies the parallel-axis theorem only to the
      diagonal of each inertia matrix. Subtract the off-diagonal entries of m d d^T as
      well, where d is the body's offset from the common centre of mass
    distance-not-squared: your code uses the distance itself in the parallel-axis
      theorem. Use the squared distance d . d instead
    """
    c = centre(m1, c1, m2, c2)
    theorems = {
        "products-not-moved": lambda d: d @ d * np.eye(3) - np.diag(d * d),
        "distance-not-squared": lambda d: np.sqrt(d @ d) * np.eye(3) - np.outer(d, d),
    }
    return {
        slug: whole(m1, c1, I1, m2, c2, I2, c, some) for slug, some in theorems.items()
    }


@row.wrongs
def _(m1, c1, I1, m2, c2, I2):
    """plain-mean: your code uses the midpoint of c1 and c2 as the common centre of
      mass. Weight c1 by m1 and c2 by m2 instead
    not-divided-by-the-mass: your code does not divide m1 c1 + m2 c2 by the total mass.
      The common centre of mass should be the weighted mean of c1 and c2
    first-centre-kept: your code uses c1 as the common centre of mass. Use the mean of
      c1 and c2 instead, weighted by m1 and m2
    """
    centres = {
        "plain-mean": (c1 + c2) / 2,
        "not-divided-by-the-mass": m1 * c1 + m2 * c2,
        "first-centre-kept": c1,
    }
    return {slug: whole(m1, c1, I1, m2, c2, I2, c) for slug, c in centres.items()}


@row.wrongs
def _(m1, c1, I1, m2, c2, I2):
    """by-rows: your code returns the entries of the inertia in the order xx, xy, xz,
      yy, yz, zz. The order should be xx, yy, zz, xy, xz, yz
    xy-last: your code returns the last three entries in the order yz, xz, xy. The order
      should be xy, xz, yz
    products-negated: your code returns xy, xz and yz with the wrong sign. Return the
      entries of the inertia matrix unchanged, because the entry xy is already the sum
      of `-m x y`
    mass-of-the-first: your code returns the mass of the first body only. Return the
      total mass m1 + m2 instead
    """
    right = combine_bodies(m1, c1, I1, m2, c2, I2)
    return {
        "by-rows": right[[0, 1, 2, 3, 4, 7, 8, 5, 9, 6]],
        "xy-last": right[[0, 1, 2, 3, 4, 5, 6, 9, 8, 7]],
        "products-negated": right * [1, 1, 1, 1, 1, 1, 1, -1, -1, -1],
        "mass-of-the-first": np.append(m1, right[1:]),
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


row.at_least_0(m1="a mass is not negative", m2="a mass is not negative")


row.spans(  # as small, or as large, as in the lab
    c1=(lambda c1: 0.2 * c1,),
    I1=(lambda I1: 0.009 * I1,),
    m2=(0.08,),
    I2=(lambda I2: 2e-05 * I2,),
)
