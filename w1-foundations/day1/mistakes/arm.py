"""The Panda's product in factors, so that one of them can be replaced by a mistake.

    T_world_ee = L1 @ J1 @ L2 @ J2 @ ... @ L7 @ J7 @ L8

L_k is where link k sits on the one before it (L8: the flange's `attachment`), J_k what
joint k adds. link0 sits on the world's origin and is left out.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from itertools import chain

import mujoco
import numpy as np

from labkit.judge.chain import product
from robo47 import panda
from robo47.checks import Array

from .factors import link, turn

Factor = Callable[..., Array]
LINKS = tuple(f"link{k}" for k in range(1, 8))
LAST_OFFSET = "attachment"


@dataclass(frozen=True)
class Arm:
    """The chain to a frame.

    Attributes:
        names: of the bodies, from link1 outwards, m of them.
        pos: where each sits on the one before it, metres, (m, 3).
        quat: and how it is turned, as the file writes it, (m, 4).
        joints: how many of the bodies turn, the first ones.
    """

    names: tuple[str, ...]
    pos: Array
    quat: Array
    joints: int

    @property
    def joint_names(self) -> tuple[str, ...]:
        """Return the names of the joints."""
        return tuple(f"joint{k + 1}" for k in range(self.joints))

    @property
    def end(self) -> str:
        """Return what the last body is called in a sentence."""
        return "the end effector" if self.names[-1] == LAST_OFFSET else self.names[-1]

    def steps(
        self, q: Array, link: Factor = link, turn: Factor = turn
    ) -> list[list[Array]]:
        """Return [L1, J1], [L2, J2], ... at configurations q, (n, 7).

        Args:
            q: joint angles.
            link: in place of the right factor from (pos, quat).
            turn: in place of the right factor from one joint's angles, (n,).

        Returns:
            Per body its factors, L_k (4, 4) and J_k (n, 4, 4); no J where none turns.
        """
        offsets = link(self.pos, self.quat)
        return [
            [L, turn(q[:, k])] if k < self.joints else [L]
            for k, L in enumerate(offsets)
        ]

    def fk(self, q: Array, **replaced: Factor) -> Array:
        """Return the product of the factors, (n, 4, 4)."""
        return product(chain.from_iterable(self.steps(q, **replaced)), len(q))

    def upto(self, k: int) -> "Arm":
        """Return the chain of the first k bodies."""
        return Arm(self.names[:k], self.pos[:k], self.quat[:k], min(k, self.joints))


@cache
def model() -> mujoco.MjModel:
    """Return the Panda that everything here is judged on."""
    return panda.load("panda_nohand")


@cache
def base() -> tuple[Array, Array]:
    """Return link0's inertial frame and its turn alone, (4, 4) each."""
    body = model().body("link0")
    return link(body.ipos, body.iquat), link(np.zeros(3), body.iquat)


@cache
def inertial_frames() -> "Arm":
    """Return the arm with each body's inertial frame (ipos, iquat) for its own."""
    bodies = [model().body(name) for name in whole().names]
    return Arm(
        whole().names,
        np.array([body.ipos for body in bodies]),
        np.array([body.iquat for body in bodies]),
        joints=len(LINKS),
    )


@cache
def whole() -> Arm:
    """Return the chain from the world to the end effector."""
    names = (*LINKS, LAST_OFFSET)
    bodies = [model().body(name) for name in names]
    return Arm(
        names,
        np.array([body.pos for body in bodies]),
        np.array([_as_written(body.quat) for body in bodies]),
        joints=len(LINKS),
    )


def _as_written(quat: Array) -> Array:
    """Return a compiled (unit) quaternion as model files write it: (1, -1, 0, 0).

    Somebody who types the numbers off the file meets these.
    """
    scaled = quat / np.abs(quat).max()
    whole = np.round(scaled)
    return whole if np.allclose(scaled, whole) else quat
