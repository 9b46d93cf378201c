"""Mistakes in tasks 2.6 and 2.8 that are made in q, before the product."""

import numpy as np

from labkit.judge.mistake import Mistake

from .moves import Function


def in_the_angles(fk: Function, at_zero: str) -> list[Mistake]:
    """Return what can be wrong with the angles, in either form of the product.

    Args:
        fk: the right product, of screws, M and q.
        at_zero: what the pose at q = 0 is called.
    """

    def with_q(change: Function) -> Function:
        return lambda S, M, q: fk(S, M, change(q))

    def shifted(by: int) -> Mistake:
        return Mistake(
            "off-by-one-joint",
            "each joint is given its neighbour's angle: q is indexed one off",
            with_q(lambda q: np.roll(q, by, axis=1)),
            "the pose with q shifted by one",
        )

    return [
        Mistake(
            "joints-left-out",
            f"nothing moves: whatever q is, your pose is {at_zero}",
            with_q(np.zeros_like),
            "the pose at q = 0",
        ),
        Mistake(
            "all-backwards",
            "every joint turns the other way, by -q",
            with_q(np.negative),
            "the pose at -q",
        ),
        Mistake(
            "sign-of-q-lost",
            "the sign of q is lost: a negative angle turns the positive way",
            with_q(np.abs),
            "the pose at |q|",
        ),
        Mistake(
            "negative-angles-left-out",
            "joints with a negative angle do not move",
            with_q(lambda q: np.maximum(q, 0.0)),
            "the pose with 0 for each of them",
        ),
        Mistake(
            "angles-added-up",
            "each joint is given the sum of all angles up to its own; its exponential "
            "needs its own alone, since the product carries the others",
            with_q(lambda q: np.cumsum(q, axis=1)),
            "the pose with those sums",
        ),
        Mistake(
            "radians-taken-for-degrees",
            "q is in radians already, and is converted from degrees once more",
            with_q(np.deg2rad),
            "the pose at pi / 180 times q",
        ),
        Mistake(
            "degrees",
            "q comes in radians, and is used as degrees",
            with_q(np.rad2deg),
            "the pose at 180 / pi times q",
        ),
        shifted(1),
        shifted(-1),
        Mistake(
            "first-angle-for-all",
            "every joint is given the first angle, q[0]: the index never moves on",
            with_q(lambda q: np.repeat(q[:, :1], q.shape[1], axis=1)),
            "the pose with q[0] everywhere",
        ),
        Mistake(
            "q-backwards",
            "q is read backwards: joint1 gets the last angle",
            with_q(lambda q: q[:, ::-1]),
            "the pose with q backwards",
        ),
    ]
