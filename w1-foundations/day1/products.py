"""Ways to multiply the Panda's factors wrongly: their order, and where frames sit."""

import numpy as np

from labkit.judge.matrices import pose, split
from robo47 import se3

from .panda_chain import PATH, fk, link, product, steps, turn

WRONG = []  # (slug, words, what to call it), and compose_fk written so


def wrong(*said):
    """Take a way to write compose_fk; as `Row.wrong`."""
    return lambda code: WRONG.append((said, code))


# The order of the factors.

REVERSED = (
    "the product runs in the wrong order: the world's end belongs on the left, each "
    "further factor to the right of what is there"
)


@wrong(
    "joint-before-link",
    "each joint turns before its link's offset; the offset leads to the joint, so it "
    "comes first",
    "the product with each pair swapped",
)
def _(model, q, path=PATH):
    return product(J @ L for L, J in steps(model, q, path))


@wrong("chain-reversed", REVERSED, "the product in reverse")
def _(model, q, path=PATH):
    return product(J @ L for L, J in steps(model, q, path[::-1]))


@wrong("chain-reversed", REVERSED, "the product in reverse")
def _(model, q, path=PATH):
    return product(L @ J for L, J in steps(model, q, path[::-1]))


@wrong(
    "links-on-the-left",
    "the links' factors are put to the left of what is there, the joints' to the "
    "right; both belong to the right",
    "the product in that order",
)
def _(model, q, path=PATH):
    T = np.eye(4)
    for L, J in steps(model, q, path):
        T = L @ T @ J
    return T


@wrong(
    "joints-on-the-left",
    "the joints' factors are put to the left of what is there, the links' to the "
    "right; both belong to the right",
    "the product in that order",
)
def _(model, q, path=PATH):
    T = np.eye(4)
    for L, J in steps(model, q, path):
        T = J @ T @ L
    return T


@wrong(
    "multiplied-by-entries",
    "the factors are multiplied entry by entry, not as matrices",
    "the product by entries",
)
def _(model, q, path=PATH):
    T = np.eye(4)
    for L, J in steps(model, q, path):
        T = T * L * J
    return T


# Where the frames sit on each other.


@wrong(
    "last-step-in-the-world",
    "the step to attachment is added along the world's axes; it belongs to those of "
    "the body before it",
    "the right one with that step in the world",
)
def _(model, q, path=PATH):
    R, t = split(fk(model, q, path[:-1]))
    R_last, t_last = split(link(model, path[-1][0]))
    return pose(R @ R_last, t + t_last)


@wrong(
    "last-step-on-the-left",
    "the step to attachment is multiplied on the left, so it moves the whole arm; it "
    "belongs on the right",
    "the product with that step on the left",
)
def _(model, q, path=PATH):
    return link(model, path[-1][0]) @ fk(model, q, path[:-1])


@wrong(
    "inertial-frames",
    "each body's ipos and iquat are used, where its mass is; pos and quat say where "
    "the body is",
    "the product of those frames",
)
def _(model, q, path=PATH):
    T = np.eye(4)
    for name, joint in path:
        body = model.body(name)
        L = pose(se3.quat_to_R(body.iquat), body.ipos)
        T = T @ L @ turn(model, q, joint)
    return T


@wrong(
    "inertial-turns",
    "each body's iquat is used, which turns its inertia; quat turns the body",
    "the product with iquat",
)
def _(model, q, path=PATH):
    T = np.eye(4)
    for name, joint in path:
        body = model.body(name)
        L = pose(se3.quat_to_R(body.iquat), body.pos)
        T = T @ L @ turn(model, q, joint)
    return T


@wrong(
    "local-taken-for-world",
    "the pos and quat of attachment in the file are taken for its pose in the world; "
    "they only lead there from its parent",
    "the numbers in the file",
)
def _(model, q, path=PATH):
    return link(model, path[-1][0])


@wrong(
    "offsets-summed",
    "R is right, but the offsets are added as they stand in the file; each is told in "
    "its parent's turned axes",
    "the right one with a plain sum",
)
def _(model, q, path=PATH):
    R, _ = split(fk(model, q, path))
    return pose(R, sum(model.body(name).pos for name, _ in path))


@wrong(
    "offset-turned-too-late",
    "R is right, but each offset is turned by the joint that comes after it",
    "the right one with R turned first",
)
def _(model, q, path=PATH):
    R, t = np.eye(3), np.zeros(3)
    for L, J in steps(model, q, path):
        R = R @ L[:3, :3] @ J[:3, :3]
        t = t + R @ L[:3, 3]
    return pose(R, t)


@wrong(
    "turns-in-reverse",
    "the turns are multiplied in the wrong order: a new one belongs to the right of "
    "what is there",
    "the right one with each turn on the left",
)
def _(model, q, path=PATH):
    R, t = np.eye(3), np.zeros(3)
    for L, J in steps(model, q, path):
        t = t + R @ L[:3, 3]
        R = L[:3, :3] @ J[:3, :3] @ R
    return pose(R, t)


@wrong(
    "point-with-w-0",
    "R is right, but attachment's offset is only turned, not moved: with a 0 as fourth "
    "entry a point is a direction",
    "the right one with that 0",
)
def _(model, q, path=PATH):
    R, t = split(fk(model, q, path))
    return pose(R, t - fk(model, q, path[:-1])[:3, 3])
