"""Jacobians of the Panda that Day 3 asks about, and what its rows share."""

from functools import cache

import numpy as np

from labkit.judge import HeldOut, rounded
from labkit.judge.kinds import Kind
from robo47 import jacobian, panda, screws
from robo47.checks import Array

JOINTS = tuple(f"joint{i}" for i in range(1, 8))
UNIT = np.hstack([np.eye(6), np.zeros((6, 1))])  # a Jacobian of unit columns

PLANE = np.array(
    [[2.0, 0.0, 0.0], [0.0, 3.0, 0.0]]
)  # an arm of three joints in a plane


def of_another_size(*rest: Array) -> HeldOut:
    """Return the questions of a Jacobian with another number of rows and columns."""
    return HeldOut(
        "six-rows-only",
        "Your result is correct for 6x7 Jacobians, but not for the 2x3 Jacobian in the "
        "docstring. Take the dimensions from `J.shape`.",
        lambda rng: [(PLANE, *rest), (PLANE + 0.5, *rest)],
    )


class OrNaN(Kind):
    """An answer that may have NaN in it: how far off are the others?"""

    def apart(self, S: Array, T: Array) -> str:  # noqa: D102
        fine = np.isfinite(S).reshape(len(S), -1).all(axis=1)
        if fine.all() or not fine.any():
            return super().apart(S, T)
        return f"{super().apart(S[fine], T[fine])} in the calls without NaN"


@cache
def arm() -> tuple[Array, Array, Array]:
    """Return the Panda's screws, M and joint limits."""
    model = panda.load("panda_nohand")
    return panda.screws(model), panda.home_pose(model), model.jnt_range.copy()


def site_jacobians(q: Array) -> Array:
    """Return J_site of the Panda's hand, rounded so that it can be typed."""
    S, M, _ = arm()
    p = screws.fk_space(S, M, q)[:, :3, 3]
    return rounded(jacobian.site_jacobian(jacobian.space_jacobian(S, q), p))


def near_singular(rng) -> Array:
    """Return Jacobians of all sorts, (9, 6, 7): two are singular, nearly."""
    q = rng.configurations(9)
    q[1] = np.zeros(7)
    q[2] = [0.0, 0.3, 0.0, -0.08, 0.0, 0.4, 0.2]
    return site_jacobians(q)
