"""Ways to multiply the Panda's factors wrongly: their order, and where frames sit.

Each is `compose_fk` with its words as below `Row.wrong`, or `Row.wrongs`.
"""

import numpy as np

from labkit.judge.matrices import pose, split
from robo47 import se3

from .panda_chain import PATH, fk, link, product, steps, turn

# The order of the factors.


def in_order(model, q, path=PATH):
    """joint-before-link: each joint turns before its link's offset; the offset leads to
      the joint, so it comes first => the product with each pair swapped
    chain-reversed: the product runs in the wrong order: the world's end belongs on the
      left, each further factor to the right of what is there => the product in reverse
    links-on-the-left: the links' factors are put to the left of what is there, the
      joints' to the right; both belong to the right => the product in that order
    joints-on-the-left: the joints' factors are put to the left of what is there, the
      links' to the right; both belong to the right => the product in that order
    multiplied-by-entries: the factors are multiplied entry by entry, not as matrices =>
      the product by entries
    """
    pairs = steps(model, q, path)
    links, joints = zip(*pairs, strict=True)
    return {
        "joint-before-link": lambda: product(J @ L for L, J in pairs),
        "chain-reversed": lambda: product(J @ L for L, J in pairs[::-1]),
        "links-on-the-left": lambda: product([*links[::-1], *joints]),
        "joints-on-the-left": lambda: product([*joints[::-1], *links]),
        "multiplied-by-entries": lambda: np.eye(4) * np.prod(pairs, axis=(0, 1)),
    }


def chain_reversed(model, q, path=PATH):
    """the product runs in the wrong order: the world's end belongs on the left, each
    further factor to the right of what is there => the product in reverse"""
    return product(L @ J for L, J in steps(model, q, path[::-1]))


# Where the frames sit on each other.


def on_each_other(model, q, path=PATH):
    """last-step-in-the-world: the step to attachment is added along the world's axes;
      it belongs to those of the body before it => the right one with that step in
      the world
    last-step-on-the-left: the step to attachment is multiplied on the left, so it moves
      the whole arm; it belongs on the right => the product with that step on the left
    local-taken-for-world: the pos and quat of attachment in the file are taken for its
      pose in the world; they only lead there from its parent => the numbers in the file
    offsets-summed: R is right, but the offsets are added as they stand in the file;
      each is told in its parent's turned axes => the right one with a plain sum
    point-with-w-0: R is right, but attachment's offset is only turned, not moved: with
      a 0 as fourth entry a point is a direction => the right one with that 0
    inertial-frames: each body's ipos and iquat are used, where its mass is; pos and
      quat say where the body is => the product of those frames
    inertial-turns: each body's iquat is used, which turns its inertia; quat turns the
      body => the product with iquat
    """
    before = fk(model, q, path[:-1])
    last = link(model, path[-1][0])
    R, t = split(fk(model, q, path))
    return {
        "last-step-in-the-world": pose(
            before[:3, :3] @ last[:3, :3], before[:3, 3] + last[:3, 3]
        ),
        "last-step-on-the-left": last @ before,
        "local-taken-for-world": last,
        "offsets-summed": lambda: pose(
            R, sum(model.body(name).pos for name, _ in path)
        ),
        "point-with-w-0": pose(R, t - before[:3, 3]),
        "inertial-frames": lambda: inertial(model, q, path, "ipos"),
        "inertial-turns": lambda: inertial(model, q, path, "pos"),
    }


def inertial(model, q, path, place):
    """Return the product with iquat for quat, and what place says for pos."""
    T = np.eye(4)
    for name, joint in path:
        body = model.body(name)
        T = (
            T
            @ pose(se3.quat_to_R(body.iquat), getattr(body, place))
            @ turn(model, q, joint)
        )
    return T


def offset_turned_too_late(model, q, path=PATH):
    """R is right, but each offset is turned by the joint that comes after it => the
    right one with R turned first"""
    R, t = np.eye(3), np.zeros(3)
    for L, J in steps(model, q, path):
        R = R @ L[:3, :3] @ J[:3, :3]
        t = t + R @ L[:3, 3]
    return pose(R, t)


def turns_in_reverse(model, q, path=PATH):
    """the turns are multiplied in the wrong order: a new one belongs to the right of
    what is there => the right one with each turn on the left"""
    R, t = np.eye(3), np.zeros(3)
    for L, J in steps(model, q, path):
        t = t + R @ L[:3, 3]
        R = L[:3, :3] @ J[:3, :3] @ R
    return pose(R, t)
