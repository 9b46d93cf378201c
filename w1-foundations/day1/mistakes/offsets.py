"""Mistakes in tasks 1.6 and 1.8 that are in where the frames sit on each other.

`redo` takes the joint angles, (n, 7), and returns (n, 4, 4).
"""

from dataclasses import replace

import numpy as np

from labkit.judge.chain import product
from labkit.judge.matrices import pose, split, times
from labkit.judge.mistake import Mistake
from robo47.checks import Array

from .arm import Arm, base, inertial_frames
from .factors import link


def in_the_offsets(arm: Arm) -> list[Mistake]:
    """Return the named mistakes in an arm's offsets, base and end."""
    last, parent = arm.names[-1], arm.upto(len(arm.names) - 1)

    def local(q: Array) -> Array:
        return np.broadcast_to(arm.steps(q)[-1][0], (len(q), 4, 4))

    def offsets_summed(q: Array) -> Array:
        return pose(split(arm.fk(q))[0], arm.pos.sum(axis=0))

    step = link(arm.pos[-1:], arm.quat[-1:])[0]

    def added_in_the_world(q: Array) -> Array:
        R, t = split(parent.fk(q))
        return pose(R @ split(step)[0], t + split(step)[1])

    def multiplied_on_the_left(q: Array) -> Array:
        return step @ parent.fk(q)

    def inertial(q: Array) -> Array:
        return base()[0] @ inertial_frames().upto(len(arm.names)).fk(q)

    def inertial_turns(q: Array) -> Array:
        frames = inertial_frames().upto(len(arm.names))
        return base()[1] @ replace(frames, pos=arm.pos).fk(q)

    def point_with_w_0(q: Array) -> Array:
        R, t = split(arm.fk(q))
        return pose(R, t - split(parent.fk(q))[1])

    return [
        Mistake(
            "last-step-in-the-world",
            f"the step to {last} is added along the world's axes; it belongs to those "
            "of the body before it",
            added_in_the_world,
            "the right one with that step in the world",
        ),
        Mistake(
            "last-step-on-the-left",
            f"the step to {last} is multiplied on the left, so it moves the whole arm; "
            "it belongs on the right",
            multiplied_on_the_left,
            "the product with that step on the left",
        ),
        Mistake(
            "inertial-frames",
            "each body's ipos and iquat are used, where its mass is; pos and quat say "
            "where the body is",
            inertial,
            "the product of those frames",
        ),
        Mistake(
            "inertial-turns",
            "each body's iquat is used, which turns its inertia; quat turns the body",
            inertial_turns,
            "the product with iquat",
        ),
        Mistake(
            "local-taken-for-world",
            f"the pos and quat of {last} in the file are taken for its pose in the "
            "world; they only lead there from its parent",
            local,
            "the numbers in the file",
        ),
        Mistake(
            "offsets-summed",
            "R is right, but the offsets are added as they stand in the file; each is "
            "told in its parent's turned axes",
            offsets_summed,
            "the right one with a plain sum",
        ),
        Mistake(
            "offset-turned-too-late",
            "R is right, but each offset is turned by the joint that comes after it",
            lambda q: _walk(arm, q, late=True),
            "the right one with R turned first",
        ),
        Mistake(
            "turns-in-reverse",
            "the turns are multiplied in the wrong order: a new one belongs to the "
            "right of what is there",
            lambda q: _walk(arm, q, left=True),
            "the right one with each turn on the left",
        ),
        Mistake(
            "point-with-w-0",
            f"R is right, but {last}'s offset is only turned, not moved: with a 0 as "
            "fourth entry a point is a direction",
            point_with_w_0,
            "the right one with that 0",
        ),
    ]


def _walk(arm: Arm, q: Array, late: bool = False, left: bool = False) -> Array:
    """Return the pose from R and t kept apart, with one of two mistakes.

    Args:
        arm: the chain.
        q: joint angles, (n, 7).
        late: turn R by the whole step before the step's offset is added.
        left: multiply each step's turn on the left.
    """
    R, t = np.broadcast_to(np.eye(3), (len(q), 3, 3)), np.zeros((len(q), 3))
    for step, p in zip(arm.steps(q), arm.pos, strict=True):
        turn = split(product(step, len(q)))[0]
        after = turn @ R if left else R @ turn
        t = t + times(after if late else R, p)
        R = after
    return pose(R, t)
