"""State of an arm at one configuration, computed in as few NumPy calls as it takes.

All links go through each call together. Two habits make the calls few:

- What is linear in something, as [p] is in p, is one product with a constant matrix.
- A link's mass, centre of mass and inertia travel as its pseudo-inertia, the integral
  of r r^T over its mass with r = (x, y, z, 1). A pose T takes it to T P T^T (Wensing,
  Kim and Slotine, "Linear matrix inequalities for physically consistent inertial
  parameter identification", 2018). Where the acceleration of each point is W r, the
  force on a body and its moment stand in W P.

Conventions as in `robo47.dynamics`.
"""

from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from robo47 import screws
from robo47.checks import Array
from robo47.fast.vectors import times

# Linear maps, for rows of numbers: p @ SKEW is [p], V @ HAT is [V], row by row.
SKEW = screws.skew(np.eye(3)).reshape(3, 9)
HAT = np.zeros((6, 16))
_hats = HAT.reshape(6, 4, 4)
_hats[:3, :3, :3] = screws.skew(np.eye(3))
_hats[3:, :3, 3] = np.eye(3)
# (f r^T) @ WRENCH is (r x f; f), for f and r of four numbers.
WRENCH = np.zeros((16, 6))
_pairs = WRENCH.reshape(4, 4, 6)
_pairs[:3, :3, :3] = -SKEW.reshape(3, 3, 3).swapaxes(0, 2)
_pairs[:3, 3, 3:] = np.eye(3)
EYE = np.eye(6)


def pseudo_inertias(masses: Array, coms: Array, inertias: Array) -> Array:
    """Return the integral of r r^T, r = (x, y, z, 1), over the mass of each body.

    Args:
        masses: kg, (n,).
        coms: centres of mass, metres, (n, 3).
        inertias: about the centres of mass, kg m^2, (n, 3, 3).

    Returns:
        Pseudo-inertias about the frames' origins, (n, 4, 4).
    """
    P = np.zeros((len(masses), 4, 4))
    half = 0.5 * np.trace(inertias, axis1=1, axis2=2)[:, None, None] * np.eye(3)
    spread = masses[:, None, None] * coms[:, :, None] * coms[:, None, :]
    P[:, :3, :3] = half - inertias + spread
    P[:, :3, 3] = P[:, 3, :3] = masses[:, None] * coms
    P[:, 3, 3] = masses
    return P


def as_one(masses: Array, coms: Array, inertias: Array) -> tuple[float, Array, Array]:
    """Return (mass, centre (3,), inertia about it (3, 3)) of bodies, given as above."""
    P = pseudo_inertias(masses, coms, inertias).sum(axis=0)
    mass = float(P[3, 3])
    com = P[:3, 3] / (mass or 1.0)  # nothing weighs nothing
    spread = P[:3, :3] - mass * np.outer(com, com)
    return mass, com, np.trace(spread) * np.eye(3) - spread


def _spatial_map() -> Array:
    """Return the map from pseudo-inertia, (16,), to 6x6 inertia, (36,)."""
    P = np.eye(16).reshape(16, 4, 4)
    G = np.zeros((16, 6, 6))
    traces = np.trace(P[:, :3, :3], axis1=1, axis2=2)
    G[:, :3, :3] = traces[:, None, None] * np.eye(3) - P[:, :3, :3]
    G[:, :3, 3:] = screws.skew(P[:, :3, 3])
    G[:, 3:, :3] = np.swapaxes(G[:, :3, 3:], 1, 2)
    G[:, 3:, 3:] = P[:, 3, 3, None, None] * np.eye(3)
    return G.reshape(16, 36)


SPATIAL = _spatial_map()


class Constants:
    """The constants of a `robo47.arm.Arm`, which do not depend on q."""

    def __init__(self, arm: Any) -> None:
        n = len(arm.masses)
        S = np.zeros((n, 4, 4))
        S[:, :3, :3] = screws.skew(arm.screws[:, :3])
        S[:, :3, 3] = arm.screws[:, 3:]
        S2 = S @ S
        S3 = S @ S @ S
        # The factors of 1, q, cos q and sin q, (n, 4, 16), in e^[S]q =
        # 1 + [S] q + [S]^2 (1 - cos q) + [S]^3 (q - sin q) (Modern Robotics, eq. 3.85).
        powers = np.stack([np.eye(4) + S2, S + S3, -S2, -S3], axis=1)
        self.powers = powers.reshape(n, 4, 16)
        self.ones = np.ones(n)
        self.pairs = arm.screws.reshape(n, 2, 3).copy()  # omega and v of each joint
        P = pseudo_inertias(arm.masses, arm.coms, arm.inertias)
        # The pseudo-inertias of the links at q = 0 about the world's origin, (n, 4, 4).
        self.pseudo = arm.T_zero @ P @ np.swapaxes(arm.T_zero, -1, -2)
        self.before = np.tri(n)  # before @ x sums x outwards
        self.after = self.before.T.copy()  # after @ x sums x inwards, from the tip
        self.twice = 2 * self.before - np.eye(n)  # 2 below the diagonal, 1 on it
        self.lower = self.before.astype(bool)
        self.armature = np.diag(arm.armature)
        # The acceleration of a base that feels like gravity, and it as a matrix, (16,).
        self.A_base = np.concatenate([np.zeros(3), -arm.gravity])
        self.W_base = self.A_base @ HAT
        self.M_home = arm.M_home
        self.T_zero = arm.T_zero
        self.coms = arm.coms


class ArmState:
    """An arm at one configuration. Each quantity is computed when first asked for.

    The arrays are kept and handed out again: copy one before you write to it.

    Attributes:
        q: the configuration, rad, (n,).
    """

    def __init__(self, constants: Constants, q: Array) -> None:
        """Compute the links' poses; use `Arm.at`, which checks q."""
        self.q = q
        self._c = constants
        n = len(q)
        numbers = np.array((constants.ones, q, np.cos(q), np.sin(q)))
        moved = (numbers.T[:, None] @ constants.powers).reshape(n, 4, 4)
        step = 1  # products of two neighbours, then of four, then of eight
        while step < n:
            moved[step:] = moved[:-step] @ moved[step:]
            step *= 2
        self._moved = moved  # e^[S1]q1 ... e^[Si]qi of each link i

    @cached_property
    def T_links(self) -> Array:
        """`T_world_link` of each link, (n, 4, 4)."""
        return self._moved @ self._c.T_zero

    @cached_property
    def T_world_ee(self) -> Array:
        """Pose of the arm's end, (4, 4)."""
        return self._moved[-1] @ self._c.M_home

    @cached_property
    def coms_world(self) -> Array:
        """Centres of mass in the world, metres, (n, 3)."""
        T = self.T_links
        return times(T[:, :3, :3], self._c.coms) + T[:, :3, 3]

    @cached_property
    def _S(self) -> Array:
        """The joints' screws where they are now, (n, 6): the rows of J_space^T."""
        n = len(self.q)
        R = self._moved[:, :3, :3]
        p = self._moved[:, :3, 3]
        S = (self._c.pairs @ R.swapaxes(1, 2)).reshape(n, 6)
        S[:, 3:] += ((p @ SKEW).reshape(n, 3, 3) @ S[:, :3, None])[:, :, 0]
        return S

    @cached_property
    def J_space(self) -> Array:
        """Space Jacobian, (6, n)."""
        return self._S.T

    @cached_property
    def J_site(self) -> Array:
        """Jacobian of the arm's end: (omega; v of its origin) in world axes, (6, n)."""
        to_end = EYE.copy()
        to_end[:3, 3:] = (self.T_world_ee[:3, 3] @ SKEW).reshape(3, 3)
        return (self._S @ to_end).T

    @cached_property
    def G(self) -> Array:
        """Inertias of the links about the world's origin, (n, 6, 6)."""
        n = len(self.q)
        return (self._P.reshape(n, 16) @ SPATIAL).reshape(n, 6, 6)

    @cached_property
    def _P(self) -> Array:
        """Pseudo-inertias of the links about the world's origin, (n, 4, 4)."""
        return self._moved @ self._c.pseudo @ self._moved.swapaxes(1, 2)

    @cached_property
    def _momenta(self) -> Array:
        """The momentum of each link and all after it at joint speed 1, (n, 6)."""
        n = len(self.q)
        carried = (self._c.after @ self._P.reshape(n, 16) @ SPATIAL).reshape(n, 6, 6)
        return (carried @ self._S[:, :, None])[:, :, 0]

    @cached_property
    def M(self) -> Array:
        """Mass matrix with the armature, kg m^2, (n, n)."""
        half = self._momenta @ self._S.T
        M = np.where(self._c.lower, half, half.T)
        M += self._c.armature
        return M

    @cached_property
    def gravity_torque(self) -> Array:
        """Torque that holds the arm still, N m, (n,)."""
        return self._momenta @ self._c.A_base

    def bias(self, qd: ArrayLike) -> Array:
        """Return the torque of Coriolis, centrifugal and gravity forces.

        Recursive Newton-Euler, as `robo47.dynamics.inverse_dynamics` with qdd = 0.

        Args:
            qd: joint velocities, rad/s, (n,).

        Returns:
            Torque, N m, (n,).
        """
        n = len(self.q)
        W = (self._motion(qd) + self._c.W_base).reshape(n, 4, 4)
        F = (W @ self._P).reshape(n, 16) @ WRENCH
        return np.vecdot(self._S, self._c.after @ F)

    def bias_acceleration(self, qd: ArrayLike) -> Array:
        """Return the acceleration of the arm's end at qdd = 0: J_site's rate times qd.

        Args:
            qd: joint velocities, rad/s, (n,).

        Returns:
            (angular; of the point) in world axes, rad/s^2 and m/s^2, (6,).
        """
        W = self._motion(qd)[-1].reshape(4, 4)
        turn = 0.5 * (W - W.T)  # [omega]^2 is symmetric: [alpha] is left
        alpha = [turn[2, 1], turn[0, 2], turn[1, 0]]
        return np.concatenate([alpha, W[:3] @ self.T_world_ee[:, 3]])

    def _motion(self, qd: ArrayLike) -> Array:
        """Return W = [A] + [V]^2 of every link at qdd = 0, (n, 16): r'' = W r.

        Each joint adds (2 V + X) X, with V the links' before it and X = [S] qd its own.
        """
        n = len(self.q)
        qd = np.asarray(qd, dtype=np.float64)
        if qd.shape != (n,):
            raise ValueError(f"qd has shape {qd.shape}; expected ({n},)")
        X = (self._S * qd[:, None]) @ HAT
        W = (self._c.twice @ X).reshape(n, 4, 4) @ X.reshape(n, 4, 4)
        return self._c.before @ W.reshape(n, 16)
