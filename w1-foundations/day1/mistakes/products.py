"""Mistakes in tasks 1.6 `compose_fk` and 1.8 `link4_to_world`: a product of factors.

`redo` takes the joint angles, (n, 7), and returns (n, 4, 4). A mistake in one link or
one joint only is not listed here: `places` finds which one.
"""

from functools import reduce

import numpy as np

from labkit.judge.chain import product
from labkit.judge.finished import of_a_pose
from labkit.judge.mistake import Mistake, applied, lifted
from robo47.checks import Array
from robo47.panda import READY_Q

from .arm import Arm
from .factors import JOINT_T, LINK_T
from .offsets import in_the_offsets

# Of the Panda's links, turned by 0 or 90 degrees, these two mistakes make
# the same matrix. Task 1.4 tells them apart.
_ALIKE_ON_THE_PANDA = ("factor-two-missing", "divided-by-length-squared")


def of_a_product(arm: Arm) -> list[Mistake]:
    """Return the named mistakes in the product of an arm's factors."""
    return [
        *_in_the_order(arm),
        *_in_the_angles(arm),
        *in_the_offsets(arm),
        *applied(of_a_pose(f"maps the world to {arm.end}"), arm.fk),
        *lifted(
            (m for m in LINK_T if m.slug not in _ALIKE_ON_THE_PANDA),
            "in every link's factor, ",
            lambda redo: lambda q: arm.fk(q, link=redo),
        ),
        *lifted(
            JOINT_T,
            "in every joint's factor, ",
            lambda redo: lambda q: arm.fk(q, turn=redo),
        ),
    ]


def _in_the_order(arm: Arm) -> list[Mistake]:
    def pairs_swapped(q: Array) -> Array:
        return product([f for step in arm.steps(q) for f in step[::-1]], len(q))

    def reversed_steps(q: Array) -> Array:
        return product([f for step in arm.steps(q)[::-1] for f in step], len(q))

    def reversed_factors(q: Array) -> Array:
        factors = [f for step in arm.steps(q) for f in step]
        return product(factors[::-1], len(q))

    def links_left(q: Array) -> Array:
        steps = arm.steps(q)
        left, right = [s[0] for s in steps[::-1]], [f for s in steps for f in s[1:]]
        return product(left + right, len(q))

    def joints_left(q: Array) -> Array:
        steps = arm.steps(q)
        left, right = [f for s in steps[::-1] for f in s[1:]], [s[0] for s in steps]
        return product(left + right, len(q))

    def by_entries(q: Array) -> Array:
        factors = [f for step in arm.steps(q) for f in step]
        return reduce(np.multiply, factors, np.eye(4)) + np.zeros((len(q), 4, 4))

    says = (
        "the product runs in the wrong order: the world's end belongs on the left, "
        "each further factor to the right of what is there"
    )
    return [
        Mistake(
            "joint-before-link",
            "each joint turns before its link's offset; the offset leads to the joint, "
            "so it comes first",
            pairs_swapped,
            "the product with each pair swapped",
        ),
        Mistake("chain-reversed", says, reversed_factors, "the product in reverse"),
        Mistake("chain-reversed", says, reversed_steps, "the product in reverse"),
        Mistake(
            "links-on-the-left",
            "the links' factors are put to the left of what is there, the joints' to "
            "the right; both belong to the right",
            links_left,
            "the product in that order",
        ),
        Mistake(
            "joints-on-the-left",
            "the joints' factors are put to the left of what is there, the links' to "
            "the right; both belong to the right",
            joints_left,
            "the product in that order",
        ),
        Mistake(
            "multiplied-by-entries",
            "the factors are multiplied entry by entry, not as matrices",
            by_entries,
            "the product by entries",
        ),
    ]


def _in_the_angles(arm: Arm) -> list[Mistake]:
    def shifted(columns: list[int]) -> Mistake:
        """Give joint k the angle in this column; column 7 holds zeros."""
        return Mistake(
            "off-by-one-joint",
            "each joint is given its neighbour's angle: q is indexed one off",
            lambda q: arm.fk(np.insert(q, 7, 0.0, axis=1)[:, columns]),
            "the pose with q shifted by one",
        )

    return [
        Mistake(
            "joints-left-out",
            "the links are right, but no joint turns: whatever q is, your pose is the "
            "one at q = 0",
            lambda q: arm.fk(np.zeros_like(q)),
            "the pose at q = 0",
        ),
        Mistake(
            "home-whatever-q",
            "whatever q is, your pose is the one at home",
            lambda q: arm.fk(np.broadcast_to(READY_Q, q.shape)),
            "the pose at home",
        ),
        shifted([6, 0, 1, 2, 3, 4, 5]),
        shifted([7, 0, 1, 2, 3, 4, 5]),
        shifted([1, 2, 3, 4, 5, 6, 0]),
        shifted([1, 2, 3, 4, 5, 6, 7]),
        Mistake(
            "first-angle-for-all",
            "every joint is given the first angle, q[0]: the index never moves on",
            lambda q: arm.fk(np.repeat(q[:, :1], 7, axis=1)),
            "the pose with q[0] everywhere",
        ),
        Mistake(
            "ready-subtracted",
            "the ready pose's angles are subtracted; each joint turns by q itself",
            lambda q: arm.fk(q - READY_Q),
            "the pose at q minus those angles",
        ),
        *(
            Mistake(
                "two-joints-swapped",
                f"joint{i + 1} and joint{k + 1} are given each other's angle",
                lambda q, i=i, k=k: arm.fk(q[:, _swapped(i, k)]),
                "the pose with the two swapped",
            )
            for i in range(7)
            for k in range(i + 1, 7)
        ),
        Mistake(
            "joints-in-reverse",
            "q is read backwards: joint1 gets the last angle",
            lambda q: arm.fk(q[:, ::-1]),
            "the pose with q backwards",
        ),
    ]


def _swapped(i: int, k: int) -> list[int]:
    order = list(range(7))
    order[i], order[k] = k, i
    return order
