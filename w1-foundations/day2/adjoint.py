"""2.7 `adjoint(T)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, draw
from labkit.judge.row import Row
from robo47 import se3
from robo47.screws import adjoint, skew

row = Row(Matrix((6, 6)))

O, I = np.zeros((3, 3)), np.eye(3)  # noqa: E741


@row.inputs
def _(rng):
    yield (se3.make_T(np.eye(3), [1.0, 0.0, 0.0]),)
    yield from ((T,) for T in draw.poses(rng, 8))


def blocks(T, made):
    """Return the matrix of blocks that are made of R and [p]."""
    return np.block(made(T[:3, :3], skew(T[:3, 3])))


@row.wrong
def of_the_inverse(T):
    """this is the adjoint of the inverse pose: it takes twists the other way => Ad of
    the inverse"""
    return adjoint(se3.inverse(T))


@row.wrong
def block_top_right(T):
    """[p] R stands top right; that is for twists (v; omega), and for wrenches. Here v
    is the lower half, and it is v that the distance changes => the right one with that
    block moved"""
    return blocks(T, lambda R, P: [[R, P @ R], [O, R]])


@row.wrong
def factors_swapped(T):
    """the lower left block is R [p]; the lever arm is told in the outer frame, so it
    acts after R => the right one with R [p]"""
    return blocks(T, lambda R, P: [[R, O], [R @ P, R]])


@row.wrong
def no_lever_arm(T):
    """the lower left block is 0: v is only turned, but a spin moves a far origin => the
    right one without that block"""
    return blocks(T, lambda R, P: [[R, O], [O, R]])


@row.wrong
def lever_arm_not_turned(T):
    """the lower left block is [p] alone; omega has to be turned before => the right one
    with [p]"""
    return blocks(T, lambda R, P: [[R, O], [P, R]])


@row.wrong
def lever_arm_sign(T):
    """the lower left block has the wrong sign => the right one with -[p] R"""
    return blocks(T, lambda R, P: [[R, O], [-P @ R, R]])


@row.wrong
def on_both_sides(T):
    """[p] R stands in both corners; omega does not depend on where the origin is => the
    right one with it top right too"""
    return blocks(T, lambda R, P: [[R, P @ R], [P @ R, R]])


@row.wrong
def block_by_entries(T):
    """the lower left block is [p] * R, entry by entry; it is a product of matrices =>
    the right one with [p] * R"""
    return blocks(T, lambda R, P: [[R, O], [P * R, R]])


@row.wrong
def last_block_identity(T):
    """the lower right block is the identity; v has to be turned by R too => the right
    one with I there"""
    return blocks(T, lambda R, P: [[R, O], [P @ R, I]])


@row.wrong
def last_block_zero(T):
    """the blocks are R, [p] and 0: the lower right one has to be R, and the lower left
    one [p] R => the right one with those blocks"""
    return blocks(T, lambda R, P: [[R, O], [P, O]])


@row.wrong
def lever_arm_turned_twice(T):
    """the lower left block is R [p] R; p is told in the outer frame already, so [p] R
    is all => the right one with R [p] R"""
    return blocks(T, lambda R, P: [[R, O], [R @ P @ R, R]])


@row.wrong
def point_turned_back(T):
    """in [p], p is turned back by R^T; it is told in the outer frame, and [p] R is too
    => the right one with [R^T p] R"""
    R, p = T[:3, :3], T[:3, 3]
    return np.block([[R, O], [skew(R.T @ p) @ R, R]])


@row.wrong
def R_turned_back(T):
    """R is transposed in every block: twists come out turned the other way => the right
    one with R^T"""
    return blocks(T, lambda R, P: [[R.T, O], [P @ R.T, R.T]])


@row.wrong
def transposed(T):
    """the matrix is transposed: that one is for wrenches => its transpose"""
    return adjoint(T).T


row.reached_by("skew", "in [p], ", but=["p-cross-w"])  # the lever arm's sign
