"""Ways to multiply the Panda's factors wrongly: their order, and where frames sit."""

import numpy as np

from labkit.judge.matrices import pose, split
from robo47 import se3

from .panda_chain import PATH, fk, link, product, steps, turn

WRONG = []  # compose_fk written so, each with its words as below `Row.wrong`


def wrong(code):
    """Take a way to write compose_fk."""
    WRONG.append(code)
    return code


# The order of the factors.


@wrong
def joint_before_link(model, q, path=PATH):
    """each joint turns before its link's offset; the offset leads to the joint, so it
    comes first => the product with each pair swapped"""
    return product(J @ L for L, J in steps(model, q, path))


@wrong
def chain_reversed(model, q, path=PATH):
    """the product runs in the wrong order: the world's end belongs on the left, each
    further factor to the right of what is there => the product in reverse"""
    return product(J @ L for L, J in steps(model, q, path[::-1]))


@wrong
def chain_reversed(model, q, path=PATH):
    """the product runs in the wrong order: the world's end belongs on the left, each
    further factor to the right of what is there => the product in reverse"""
    return product(L @ J for L, J in steps(model, q, path[::-1]))


@wrong
def links_on_the_left(model, q, path=PATH):
    """the links' factors are put to the left of what is there, the joints' to the
    right; both belong to the right => the product in that order"""
    T = np.eye(4)
    for L, J in steps(model, q, path):
        T = L @ T @ J
    return T


@wrong
def joints_on_the_left(model, q, path=PATH):
    """the joints' factors are put to the left of what is there, the links' to the
    right; both belong to the right => the product in that order"""
    T = np.eye(4)
    for L, J in steps(model, q, path):
        T = J @ T @ L
    return T


@wrong
def multiplied_by_entries(model, q, path=PATH):
    """the factors are multiplied entry by entry, not as matrices => the product by
    entries"""
    T = np.eye(4)
    for L, J in steps(model, q, path):
        T = T * L * J
    return T


# Where the frames sit on each other.


@wrong
def last_step_in_the_world(model, q, path=PATH):
    """the step to attachment is added along the world's axes; it belongs to those of
    the body before it => the right one with that step in the world"""
    R, t = split(fk(model, q, path[:-1]))
    R_last, t_last = split(link(model, path[-1][0]))
    return pose(R @ R_last, t + t_last)


@wrong
def last_step_on_the_left(model, q, path=PATH):
    """the step to attachment is multiplied on the left, so it moves the whole arm; it
    belongs on the right => the product with that step on the left"""
    return link(model, path[-1][0]) @ fk(model, q, path[:-1])


def inertial(model, q, path, place):
    """Return the product with iquat for quat, and another pos."""
    T = np.eye(4)
    for name, joint in path:
        body = model.body(name)
        T = T @ pose(se3.quat_to_R(body.iquat), place(body)) @ turn(model, q, joint)
    return T


@wrong
def inertial_frames(model, q, path=PATH):
    """each body's ipos and iquat are used, where its mass is; pos and quat say where
    the body is => the product of those frames"""
    return inertial(model, q, path, lambda body: body.ipos)


@wrong
def inertial_turns(model, q, path=PATH):
    """each body's iquat is used, which turns its inertia; quat turns the body => the
    product with iquat"""
    return inertial(model, q, path, lambda body: body.pos)


@wrong
def local_taken_for_world(model, q, path=PATH):
    """the pos and quat of attachment in the file are taken for its pose in the world;
    they only lead there from its parent => the numbers in the file"""
    return link(model, path[-1][0])


@wrong
def offsets_summed(model, q, path=PATH):
    """R is right, but the offsets are added as they stand in the file; each is told in
    its parent's turned axes => the right one with a plain sum"""
    R, _ = split(fk(model, q, path))
    return pose(R, sum(model.body(name).pos for name, _ in path))


@wrong
def offset_turned_too_late(model, q, path=PATH):
    """R is right, but each offset is turned by the joint that comes after it => the
    right one with R turned first"""
    R, t = np.eye(3), np.zeros(3)
    for L, J in steps(model, q, path):
        R = R @ L[:3, :3] @ J[:3, :3]
        t = t + R @ L[:3, 3]
    return pose(R, t)


@wrong
def turns_in_reverse(model, q, path=PATH):
    """the turns are multiplied in the wrong order: a new one belongs to the right of
    what is there => the right one with each turn on the left"""
    R, t = np.eye(3), np.zeros(3)
    for L, J in steps(model, q, path):
        t = t + R @ L[:3, 3]
        R = L[:3, :3] @ J[:3, :3] @ R
    return pose(R, t)


@wrong
def point_with_w_0(model, q, path=PATH):
    """R is right, but attachment's offset is only turned, not moved: with a 0 as fourth
    entry a point is a direction => the right one with that 0"""
    R, t = split(fk(model, q, path))
    return pose(R, t - fk(model, q, path[:-1])[:3, 3])
