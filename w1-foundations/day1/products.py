"""Ways to multiply the Panda's factors wrongly: their order, and where frames sit.

Each is `compose_fk` with its words as below `Row.wrong`, or `Row.wrongs`.
"""

import numpy as np

from labkit.judge.matrices import pose, split
from robo47 import se3

from .panda_chain import PATH, fk, link, product, steps, turn

# The order of the factors.


def in_order(model, q, path=PATH):
    """joint-before-link: each joint's transform comes before the transform of its link.
      It should come after it, because the link's offset leads to the joint => the
      product with each pair swapped
    chain-reversed: the product is in the reverse order; each further factor belongs on
      the right of the product so far => the product in reverse order
    links-on-the-left: the links' factors are multiplied on the left and the joints' on
      the right; both belong on the right => the product in that order
    joints-on-the-left: the joints' factors are multiplied on the left and the links' on
      the right; both belong on the right => the product in that order
    multiplied-by-entries: the factors are multiplied entry by entry; use the matrix
      product => the product by entries
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
    """the product is in the reverse order; each further factor belongs on the right of
    the product so far => the product in reverse order"""
    return product(L @ J for L, J in steps(model, q, path[::-1]))


# Where the frames sit on each other.


def on_each_other(model, q, path=PATH):
    """last-step-in-the-world: the offset of attachment is added along the world's axes;
      this offset is expressed in the frame of the previous body => the correct result
      with that offset in the world frame
    last-step-on-the-left: the factor of attachment is multiplied on the left, so it
      moves the whole arm; multiply it on the right => the product with that factor on
      the left
    local-taken-for-world: the pos and quat of attachment in the file are used as its
      pose in the world; pos and quat are relative to the parent => the pose in the file
    offsets-summed: the rotation is correct, but the offsets are added as they are in
      the file. Each offset is expressed in the rotated frame of its parent => the
      correct rotation with a plain sum
    point-with-w-0: the rotation is correct, but attachment's offset is only rotated and
      the translation before it is lost: a point needs 1, not 0, as its fourth entry =>
      the correct result with that 0
    inertial-frames: ipos and iquat are used, which give the frame of a body's inertia;
      pos and quat give the frame of the body => the product of those frames
    inertial-turns: iquat is used, the orientation of a body's inertia; quat is the
      orientation of the body => the product with iquat
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
    """the rotation is correct, but each offset is rotated by the joint that comes after
    it => the correct result with R updated first"""
    R, t = np.eye(3), np.zeros(3)
    for L, J in steps(model, q, path):
        R = R @ L[:3, :3] @ J[:3, :3]
        t = t + R @ L[:3, 3]
    return pose(R, t)


def turns_in_reverse(model, q, path=PATH):
    """the rotations are multiplied in the wrong order; each new one belongs on the
    right => the correct result with each rotation on the left"""
    R, t = np.eye(3), np.zeros(3)
    for L, J in steps(model, q, path):
        t = t + R @ L[:3, 3]
        R = L[:3, :3] @ J[:3, :3] @ R
    return pose(R, t)
