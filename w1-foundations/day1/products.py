"""Ways to multiply the Panda's factors wrongly: their order, and where frames sit.

Each is `compose_fk` with its words as below `Row.wrong`, or `Row.wrongs`.
"""

import numpy as np

from labkit.judge.matrices import pose, split
from robo47 import se3

from .panda_chain import PATH, fk, link, product, steps, turn

# The order of the factors.


def in_order(model, q, path=PATH):
    """joint-before-link: your code puts each joint's transform on the left of the
      link's transform. The link's transform belongs on the left, because the joint
      rotates the link about the link's own z axis
    chain-reversed: your pose is the product of the transforms in the reverse order. The
      transforms nearest to the base belong on the left
    links-on-the-left: your code puts each link's transform on the left of the product
      and each joint's transform on the right. Put both transforms on the right
    joints-on-the-left: your code puts each joint's transform on the left of the product
      and each link's transform on the right. Put both transforms on the right
    multiplied-by-entries: your code multiplies the transforms entry by entry. Use the
      matrix product instead
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
    """your pose is the product of the transforms in the reverse order. The transforms
    nearest to the base belong on the left"""
    return product(L @ J for L, J in steps(model, q, path[::-1]))


# Where the frames sit on each other.


def on_each_other(model, q, path=PATH):
    """last-step-in-the-world: your code adds the offset of `attachment` along the world
      axes. Rotate this offset first, because it is expressed in the frame of the
      previous body
    last-step-on-the-left: your code puts the transform of `attachment` on the left of
      the product, so this transform moves the whole arm. Put the transform on the right
      instead
    local-taken-for-world: your result is only the transform of `attachment` relative to
      its parent body. Multiply the transforms of the whole chain
    offsets-summed: your rotation is correct, but your translation is the sum of the
      offsets in the file without their rotations. Rotate each offset first, because it
      is expressed in the frame of its parent body
    point-with-w-0: your rotation is correct, but your translation is only the rotated
      offset of `attachment`. Add the position of the previous body as well. In
      homogeneous coordinates, a matrix product adds this position only if the fourth
      coordinate of the offset is 1
    inertial-frames: your code uses `ipos` and `iquat`, which describe a body's inertial
      frame. Use `pos` and `quat` instead, which describe the body frame
    inertial-turns: your code uses `iquat`, which is the orientation of a body's
      inertial frame. Use `quat` instead, which is the orientation of the body frame
    """
    before = fk(model, q, path[:-1])
    last = link(model, path[-1][0])
    R, t = split(fk(model, q, path))
    return {
        "last-step-in-the-world": pose(
            before[:3, :3] @ last[:3, :3], before[:3, 3] + last[:3, 3]
        ),
        "last-step-on-the-left": last @ turn(model, q, path[-1][1]) @ before,
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
    """your rotation is correct, but each offset in your translation is rotated by the
    rotation of its own body. Use the rotation of the previous body instead, because the
    offset is expressed in that body's frame"""
    R, t = np.eye(3), np.zeros(3)
    for L, J in steps(model, q, path):
        R = R @ L[:3, :3] @ J[:3, :3]
        t = t + R @ L[:3, 3]
    return pose(R, t)


def turns_in_reverse(model, q, path=PATH):
    """your rotation is the product of the rotations in the reverse order. The rotations
    nearest to the base belong on the left"""
    R, t = np.eye(3), np.zeros(3)
    for L, J in steps(model, q, path):
        t = t + R @ L[:3, 3]
        R = L[:3, :3] @ J[:3, :3] @ R
    return pose(R, t)
