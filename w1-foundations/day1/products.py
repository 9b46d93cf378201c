"""Ways to multiply the Panda's factors wrongly: their order, and where frames sit.

Each is `compose_fk` with its words as below `Row.wrong`, or `Row.wrongs`.
"""

import numpy as np

from labkit.judge.matrices import pose, split
from robo47 import se3

from .panda_chain import PATH, fk, link, product, steps, turn

# The order of the factors.


def in_order(model, q, path=PATH):
    """joint-before-link: your code applies each joint's transform before the transform
      of its link. It should come after it, because the link's offset leads to the joint
    chain-reversed: your product is in the reverse order. Each further transform belongs
      on the right of the product so far
    links-on-the-left: your code multiplies the links' transforms on the left and the
      joints' on the right. Both belong on the right
    joints-on-the-left: your code multiplies the joints' transforms on the left and the
      links' on the right. Both belong on the right
    multiplied-by-entries: your code multiplies the transforms entry by entry. Use the
      matrix product
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
    """your product is in the reverse order. Each further transform belongs on the right
    of the product so far"""
    return product(L @ J for L, J in steps(model, q, path[::-1]))


# Where the frames sit on each other.


def on_each_other(model, q, path=PATH):
    """last-step-in-the-world: your code adds the offset of attachment along the world's
      axes, but this offset is expressed in the frame of the previous body
    last-step-on-the-left: your code multiplies the transform of attachment on the left,
      so it moves the whole arm. Multiply it on the right
    local-taken-for-world: your code uses the pos and quat of attachment as its pose in
      the world, but pos and quat in the file are relative to the parent
    offsets-summed: your rotation is correct, but your code adds the offsets as they are
      in the file. Each offset is expressed in the rotated frame of its parent
    point-with-w-0: your rotation is correct, but your code only rotates attachment's
      offset and loses the translation before it. A point needs 1, not 0, as its fourth
      entry
    inertial-frames: your code uses ipos and iquat, which give the frame of a body's
      inertia. Use pos and quat, which give the frame of the body
    inertial-turns: your code uses iquat, the orientation of a body's inertia. Use quat,
      the orientation of the body
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
    """your rotation is correct, but your code rotates each offset by the joint that
    comes after it"""
    R, t = np.eye(3), np.zeros(3)
    for L, J in steps(model, q, path):
        R = R @ L[:3, :3] @ J[:3, :3]
        t = t + R @ L[:3, 3]
    return pose(R, t)


def turns_in_reverse(model, q, path=PATH):
    """your code multiplies the rotations in the wrong order. Each new rotation belongs
    on the right"""
    R, t = np.eye(3), np.zeros(3)
    for L, J in steps(model, q, path):
        t = t + R @ L[:3, 3]
        R = L[:3, :3] @ J[:3, :3] @ R
    return pose(R, t)
