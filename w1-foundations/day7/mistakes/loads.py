"""Mistakes in task 7.8 `carry(m1, c1, I1, m2, c2, I2)`."""

from collections.abc import Callable

import numpy as np

from labkit.judge.mistake import Mistake, each
from robo47.checks import Array


def _moved(
    mass: Callable[[float, float], float] = lambda m1, m2: m1 + m2,
    centre: Callable[..., Array] = lambda m1, c1, m2, c2: (
        (m1 * c1 + m2 * c2) / (m1 + m2)
    ),
    far: Callable[[Array, Array, Array], tuple[Array, Array]] = lambda c1, c2, c: (
        c1 - c,
        c2 - c,
    ),
    steiner: Callable[[Array], Array] = lambda d: d @ d * np.eye(3) - np.outer(d, d),
    heavy: Callable[[float, float], tuple[float, float]] = lambda m1, m2: (m1, m2),
    own: Callable[[Array, Array], Array] = np.add,
    rows: tuple[int, ...] = (0, 1, 2, 0, 0, 1),
    columns: tuple[int, ...] = (0, 1, 2, 1, 2, 2),
    signs: tuple[float, ...] = (1.0,) * 6,
) -> Callable[..., Array]:
    def one(m1: float, c1: Array, I1: Array, m2: float, c2: Array, I2: Array) -> Array:
        c = centre(m1, c1, m2, c2)
        d1, d2 = far(c1, c2, c)
        w1, w2 = heavy(m1, m2)
        both = own(I1, I2) + w1 * steiner(d1) + w2 * steiner(d2)
        six = both[list(rows), list(columns)] * signs
        return np.concatenate([[mass(m1, m2)], c, six])

    return each(one)


CARRY = [
    Mistake(
        "no-parallel-axes",
        "the inertias are added as they are; each is about its own centre, and has to "
        "be moved to the common one first",
        _moved(steiner=lambda d: np.zeros((3, 3))),
        "the answer without parallel axes",
    ),
    Mistake(
        "about-the-origin",
        "the inertia is about the frame's origin; it belongs to the common centre",
        _moved(far=lambda c1, c2, c: (c1, c2)),
        "the answer about the origin",
    ),
    Mistake(
        "only-the-second-moved",
        "only the second body's inertia is moved; the first one's centre is not the "
        "common one either",
        _moved(far=lambda c1, c2, c: (0 * c1, c2 - c)),
        "the answer with only the second moved",
    ),
    Mistake(
        "only-the-first-moved",
        "only the first body's inertia is moved",
        _moved(far=lambda c1, c2, c: (c1 - c, 0 * c2)),
        "the answer with only the first moved",
    ),
    Mistake(
        "about-the-first-centre",
        "the inertia is about the first body's centre; it belongs to the common one",
        _moved(far=lambda c1, c2, c: (0 * c1, c2 - c1)),
        "the answer about the first centre",
    ),
    Mistake(
        "distance-of-the-two",
        "the distance between the two centres is used for both; each moves to the "
        "common centre",
        _moved(far=lambda c1, c2, c: (c2 - c1, c2 - c1)),
        "the answer with that distance twice",
    ),
    Mistake(
        "parallel-axes-sign",
        "moving away from the centre of mass adds inertia; here it is taken off",
        _moved(steiner=lambda d: np.outer(d, d) - d @ d * np.eye(3)),
        "the answer with a minus",
    ),
    Mistake(
        "along-the-way-too",
        "the term d.d I alone resists a turn about the line between the centres too; "
        "d d^T has to come off",
        _moved(steiner=lambda d: d @ d * np.eye(3)),
        "the answer without d d^T",
    ),
    Mistake(
        "only-the-dyad",
        "d d^T alone is what comes off; d.d I is missing",
        _moved(steiner=lambda d: np.outer(d, d)),
        "the answer with d d^T",
    ),
    Mistake(
        "dyad-sign",
        "d d^T has to come off, not to be added",
        _moved(steiner=lambda d: d @ d * np.eye(3) + np.outer(d, d)),
        "the answer with + d d^T",
    ),
    Mistake(
        "distance-not-squared",
        "the theorem takes the distance squared",
        _moved(steiner=lambda d: np.linalg.norm(d) * np.eye(3) - np.outer(d, d)),
        "the answer with |d|",
    ),
    Mistake(
        "mass-not-in-the-theorem",
        "the theorem is m (d.d I - d d^T); here the mass is missing",
        _moved(heavy=lambda m1, m2: (1.0, 1.0)),
        "the answer without the masses there",
    ),
    Mistake(
        "total-mass-for-each",
        "in the theorem, both bodies have the mass of the whole; each has its own",
        _moved(heavy=lambda m1, m2: (m1 + m2, m1 + m2)),
        "the answer with m1 + m2 there",
    ),
    Mistake(
        "masses-exchanged",
        "in the theorem, each body has the mass of the other",
        _moved(heavy=lambda m1, m2: (m2, m1)),
        "the answer with m1 and m2 exchanged there",
    ),
    Mistake(
        "inertia-of-one",
        "the second body's own inertia I2 is missing",
        _moved(own=lambda I1, I2: I1),
        "the answer without I2",
    ),
    Mistake(
        "inertia-of-one",
        "the first body's own inertia I1 is missing",
        _moved(own=lambda I1, I2: I2),
        "the answer without I1",
    ),
    Mistake(
        "plain-mean",
        "the common centre is half way; the heavier body counts for more",
        _moved(centre=lambda m1, c1, m2, c2: (c1 + c2) / 2),
        "the answer with the plain mean",
    ),
    Mistake(
        "weights-swapped",
        "the centre is nearer to the lighter body: the masses are swapped",
        _moved(centre=lambda m1, c1, m2, c2: (m2 * c1 + m1 * c2) / (m1 + m2)),
        "the answer with the masses swapped",
    ),
    Mistake(
        "not-divided-by-the-mass",
        "the sum of m c is not divided by the mass",
        _moved(centre=lambda m1, c1, m2, c2: m1 * c1 + m2 * c2),
        "the answer with the sum of m c",
    ),
    Mistake(
        "first-centre-kept",
        "the centre of mass stays that of the first body",
        _moved(centre=lambda m1, c1, m2, c2: c1),
        "the answer with the first centre",
    ),
    Mistake(
        "by-rows",
        "the six come row by row (xx, xy, xz, yy, yz, zz); the diagonal comes first",
        _moved(rows=(0, 0, 0, 1, 1, 2), columns=(0, 1, 2, 1, 2, 2)),
        "the answer with the six by rows",
    ),
    Mistake(
        "xy-last",
        "the last three are in the order yz, xz, xy; xy comes first",
        _moved(rows=(0, 1, 2, 1, 0, 0), columns=(0, 1, 2, 2, 2, 1)),
        "the answer with yz, xz, xy",
    ),
    Mistake(
        "products-negated",
        "the last three have the other sign: here they are entries of the matrix",
        _moved(signs=(1.0, 1.0, 1.0, -1.0, -1.0, -1.0)),
        "the answer with the signs of xy, xz, yz turned",
    ),
    Mistake(
        "mass-of-the-first",
        "the mass is that of the first body alone",
        _moved(mass=lambda m1, m2: m1),
        "the answer with the first mass",
    ),
]
