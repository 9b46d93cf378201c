"""4.1 `spatial_inertia(m, c, inertia)`: its questions and its mistakes."""
# ruff: noqa: E741 (I is what the field calls an inertia)

import numpy as np

from labkit.judge import draw
from labkit.judge.row import Row
from robo47.dynamics import spatial_inertia
from robo47.screws import skew

from .states import SIX, solids

row = Row(SIX)
ONE, NONE = np.eye(3), np.zeros((3, 3))


def blocks(m, c, I, made):
    """Return the matrix of blocks that are made of [c] and the right top left one."""
    C = skew(c)
    return np.block(made(C, I + m * C @ C.T))


@row.inputs
def _(rng):
    point = (2.0, np.array([0.0, 0.0, 1.0]), np.zeros((3, 3)))
    masses, coms = draw.numbers(rng, 0.2, 5, 9), draw.numbers(rng, -1, 1, 9, 3)
    return [point, *zip(map(float, masses), coms, solids(rng, 9))]


for slug, says, redone, top in (
    (
        "parallel-axis-forgotten",
        "the top left block is about the centre of mass still: what the distance to "
        "the origin adds is missing",
        "the matrix with I alone there",
        lambda m, c, C, I: I,
    ),
    (
        "parallel-axis-sign",
        "in the top left block the distance makes the body lighter to turn: [c] [c] is "
        "the negative of [c] [c]^T",
        "the matrix with I + m [c] [c]",
        lambda m, c, C, I: I + m * C @ C,
    ),
    (
        "outer-product-for-skew",
        "the top left block has c c^T instead of [c] [c]^T: a mass is hard to turn "
        "about the axes that it is far from",
        "the matrix with I + m c c^T",
        lambda m, c, C, I: I + m * np.outer(c, c),
    ),
    (
        "distance-in-all-directions",
        "the top left block has |c|^2 for all three axes; a distance along an axis "
        "does not count for that axis",
        "the matrix with I + m |c|^2",
        lambda m, c, C, I: I + m * c @ c * ONE,
    ),
    (
        "distance-counts-twice",
        "the top left block adds m [c] [c]^T twice; the 1/2 of the energy does not "
        "stand in the matrix, so it needs no 2",
        "the matrix with I + 2 m [c] [c]^T",
        lambda m, c, C, I: I + 2 * m * C @ C.T,
    ),
    (
        "entry-by-entry",
        "the top left block multiplies [c] and [c]^T entry by entry, with *; the "
        "product of two matrices is @",
        "the matrix with * there",
        lambda m, c, C, I: I + m * C * C.T,
    ),
    (
        "mass-forgotten-in-the-parallel-axis",
        "the top left block adds [c] [c]^T without the mass",
        "the matrix without m there",
        lambda m, c, C, I: I + C @ C.T,
    ),
):

    @row.wrong(slug, says, redone)
    def _(m, c, I, top=top):
        C = skew(c)
        return np.block([[top(m, c, C, I), m * C], [m * C.T, m * ONE]])


@row.wrong
def about_the_centre_of_mass(m, c, I):
    """c is not used: all of it is about the centre of mass. About the origin three of
    the four blocks hold c => the matrix with I and m on its diagonal and nothing
    else"""
    return np.block([[I, NONE], [NONE, m * ONE]])


@row.wrong
def own_inertia_forgotten(m, c, I):
    """the body's own inertia I is missing: this is a point mass => that of a point
    mass"""
    return spatial_inertia(m, c, NONE)


@row.wrong
def products_of_inertia_sign(m, c, I):
    """the entries of I off its diagonal have the wrong sign; I is the matrix that it
    has to be, and is added as it is => the matrix with those signs"""
    return spatial_inertia(m, c, 2 * np.diag(np.diag(I)) - I)


@row.wrong
def diagonal_of_I(m, c, I):
    """only the diagonal of I is used; the other entries are 0 along a body's own axes,
    and these are the world's => the matrix with the rest of I as 0"""
    return spatial_inertia(m, c, np.diag(np.diag(I)))


@row.wrong
def corners_alike(m, c, I):
    """both corners are the same; one has to be the transpose of the other, else the
    matrix is not symmetric => the matrix with m [c] twice"""
    return blocks(m, c, I, lambda C, A: [[A, m * C], [m * C, m * ONE]])


@row.wrong
def corners_alike(m, c, I):
    """both corners are the same; one has to be the transpose of the other, else the
    matrix is not symmetric => the matrix with m [c]^T twice"""
    return blocks(m, c, I, lambda C, A: [[A, m * C.T], [m * C.T, m * ONE]])


@row.wrong
def corners_swapped(m, c, I):
    """the two corners have changed places. It is still symmetric and positive definite,
    but its angular momentum points the wrong way => the matrix with [c] and [c]^T
    swapped"""
    return blocks(m, c, I, lambda C, A: [[A, m * C.T], [m * C, m * ONE]])


@row.wrong
def corners_empty(m, c, I):
    """the two corners are empty: they tie the turning to the moving, and vanish only
    about the centre of mass => the matrix with 0 there"""
    return blocks(m, c, I, lambda C, A: [[A, NONE], [NONE, m * ONE]])


@row.wrong
def one_corner_empty(m, c, I):
    """the lower left corner is empty; the matrix is symmetric, so what stands in the
    upper right one says what belongs there => the matrix with 0 there"""
    return blocks(m, c, I, lambda C, A: [[A, m * C], [NONE, m * ONE]])


@row.wrong
def one_corner_empty(m, c, I):
    """the upper right corner is empty; the matrix is symmetric, so what stands in the
    lower left one says what belongs there => the matrix with 0 there"""
    return blocks(m, c, I, lambda C, A: [[A, NONE], [m * C.T, m * ONE]])


@row.wrong
def mass_forgotten_in_the_corners(m, c, I):
    """the two corners have [c] without the mass => the matrix without m there"""
    return blocks(m, c, I, lambda C, A: [[A, C], [C.T, m * ONE]])


@row.wrong
def mass_forgotten_below(m, c, I):
    """the lower right block is the identity, without the mass => the matrix with 1 for
    m there"""
    return blocks(m, c, I, lambda C, A: [[A, m * C], [m * C.T, ONE]])


@row.wrong
def mass_everywhere(m, c, I):
    """the lower right block has the mass in all nine entries; it belongs on the
    diagonal => the matrix with m in all of them"""
    return blocks(m, c, I, lambda C, A: [[A, m * C], [m * C.T, m * np.ones((3, 3))]])


@row.wrong
def blocks_v_omega(m, c, I):
    """the blocks are in the order (v; omega); omega comes first, as in J => the right
    one with its halves swapped"""
    return blocks(m, c, I, lambda C, A: [[m * ONE, m * C.T], [m * C, A]])
