"""Mistakes in task 4.1 `spatial_inertia(m, c, I)`."""

from collections.abc import Callable

import numpy as np

from labkit.judge.matrices import transposed
from labkit.judge.mistake import Mistake
from robo47.checks import Array
from robo47.screws import skew


def _blocks(
    top: Callable[..., Array] = lambda m, C, own: own + m * C @ transposed(C),
    right: Callable[..., Array] = lambda m, C: m * C,
    left: Callable[..., Array] = lambda m, C: m * transposed(C),
    mass: Callable[..., Array] = lambda m: m * np.eye(3),
) -> Callable[..., Array]:
    """Return spatial_inertia of many bodies, made of other blocks."""

    def redo(m: Array, c: Array, I: Array) -> Array:  # noqa: E741
        m, C = np.asarray(m)[..., None, None], skew(c)
        G = np.empty((*C.shape[:-2], 6, 6))
        G[..., :3, :3], G[..., :3, 3:] = top(m, C, I), right(m, C)
        G[..., 3:, :3], G[..., 3:, 3:] = left(m, C), mass(m)
        return G

    return redo


def _squared(C: Array) -> Array:
    """Return c c^T from [c]: [c]^T [c] = |c|^2 - c c^T."""
    CC = transposed(C) @ C
    return 0.5 * np.trace(CC, axis1=-2, axis2=-1)[..., None, None] * np.eye(3) - CC


def _other_signs(I: Array) -> Array:  # noqa: E741
    """Return I with its products of inertia, off the diagonal, negated."""
    return (2.0 * np.eye(3) - 1.0) * I


RIGHT = _blocks()
CORNERS_SWAPPED = _blocks(
    right=lambda m, C: m * transposed(C), left=lambda m, C: m * C
)  # fmt: skip
HALVES_SWAPPED = "the blocks are in the order (v; omega); omega comes first, as in J"

SPATIAL_INERTIA = [
    Mistake(
        "about-the-centre-of-mass",
        "c is not used: all of it is about the centre of mass. About the origin three "
        "of the four blocks hold c",
        _blocks(lambda m, C, own: own + 0 * C, lambda m, C: 0 * C, lambda m, C: 0 * C),
        "the matrix with I and m on its diagonal and nothing else",
    ),
    Mistake(
        "parallel-axis-forgotten",
        "the top left block is about the centre of mass still: what the distance to "
        "the origin adds is missing",
        _blocks(top=lambda m, C, own: own),
        "the matrix with I alone there",
    ),
    Mistake(
        "parallel-axis-sign",
        "in the top left block the distance makes the body lighter to turn: [c] [c] is "
        "the negative of [c] [c]^T",
        _blocks(top=lambda m, C, own: own + m * C @ C),
        "the matrix with I + m [c] [c]",
    ),
    Mistake(
        "outer-product-for-skew",
        "the top left block has c c^T in place of [c] [c]^T: a mass is hard to turn "
        "about the axes that it is far from",
        _blocks(top=lambda m, C, own: own + m * _squared(C)),
        "the matrix with I + m c c^T",
    ),
    Mistake(
        "distance-in-all-directions",
        "the top left block has |c|^2 for all three axes; a distance along an axis "
        "does not count for that axis",
        _blocks(top=lambda m, C, own: own + m * (C @ transposed(C) + _squared(C))),
        "the matrix with I + m |c|^2",
    ),
    Mistake(
        "distance-counts-twice",
        "the top left block adds m [c] [c]^T twice; the 1/2 of the energy does not "
        "stand in the matrix, so it needs no 2",
        _blocks(top=lambda m, C, own: own + 2 * m * C @ transposed(C)),
        "the matrix with I + 2 m [c] [c]^T",
    ),
    Mistake(
        "entry-by-entry",
        "the top left block multiplies [c] and [c]^T entry by entry, with *; the "
        "product of two matrices is @",
        _blocks(top=lambda m, C, own: own + m * C * transposed(C)),
        "the matrix with * there",
    ),
    Mistake(
        "mass-forgotten-in-the-parallel-axis",
        "the top left block adds [c] [c]^T without the mass",
        _blocks(top=lambda m, C, own: own + C @ transposed(C)),
        "the matrix without m there",
    ),
    Mistake(
        "own-inertia-forgotten",
        "the body's own inertia I is missing: this is a point mass",
        _blocks(top=lambda m, C, own: m * C @ transposed(C)),
        "that of a point mass",
    ),
    Mistake(
        "products-of-inertia-sign",
        "the entries of I off its diagonal have the wrong sign; I is the matrix that "
        "it has to be, and is added as it is",
        _blocks(top=lambda m, C, own: _other_signs(own) + m * C @ transposed(C)),
        "the matrix with those signs",
    ),
    Mistake(
        "diagonal-of-I",
        "only the diagonal of I is used; the other entries are 0 along a body's own "
        "axes, and these are the world's",
        _blocks(top=lambda m, C, own: own * np.eye(3) + m * C @ transposed(C)),
        "the matrix with the rest of I as 0",
    ),
    Mistake(
        "corners-alike",
        "both corners are the same; one has to be the transpose of the other, else the "
        "matrix is not symmetric",
        _blocks(left=lambda m, C: m * C),
        "the matrix with m [c] twice",
    ),
    Mistake(
        "corners-alike",
        "both corners are the same; one has to be the transpose of the other, else the "
        "matrix is not symmetric",
        _blocks(right=lambda m, C: m * transposed(C)),
        "the matrix with m [c]^T twice",
    ),
    Mistake(
        "corners-swapped",
        "the two corners have changed places. It is still symmetric and positive "
        "definite, but its angular momentum points the wrong way",
        CORNERS_SWAPPED,
        "the matrix with [c] and [c]^T swapped",
    ),
    Mistake(
        "corners-empty",
        "the two corners are empty: they tie the turning to the moving, and vanish "
        "only about the centre of mass",
        _blocks(right=lambda m, C: 0 * C, left=lambda m, C: 0 * C),
        "the matrix with 0 there",
    ),
    Mistake(
        "one-corner-empty",
        "the lower left corner is empty; the matrix is symmetric, so what stands in "
        "the upper right one says what belongs there",
        _blocks(left=lambda m, C: 0 * C),
        "the matrix with 0 there",
    ),
    Mistake(
        "one-corner-empty",
        "the upper right corner is empty; the matrix is symmetric, so what stands in "
        "the lower left one says what belongs there",
        _blocks(right=lambda m, C: 0 * C),
        "the matrix with 0 there",
    ),
    Mistake(
        "mass-forgotten-in-the-corners",
        "the two corners have [c] without the mass",
        _blocks(right=lambda m, C: C, left=lambda m, C: transposed(C)),
        "the matrix without m there",
    ),
    Mistake(
        "mass-forgotten-below",
        "the lower right block is the identity, without the mass",
        _blocks(mass=lambda m: np.eye(3) + 0 * m),
        "the matrix with 1 for m there",
    ),
    Mistake(
        "mass-everywhere",
        "the lower right block has the mass in all nine entries; it belongs on the "
        "diagonal",
        _blocks(mass=lambda m: np.ones((3, 3)) * m),
        "the matrix with m in all of them",
    ),
    Mistake(
        "blocks-v-omega",
        HALVES_SWAPPED,
        lambda *body: np.roll(RIGHT(*body), (3, 3), axis=(-2, -1)),
        "the right one with its halves swapped",
    ),
]
