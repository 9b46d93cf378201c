"""What Day 4 asks its functions: random bodies and motions, mistakes, a free swing.

The calls that the lab is held against stand in the lab; MuJoCo's own swing is here.

Inertias are 6x6 about the world's origin, (angular; linear), in world axes. SI units.
"""

from typing import NamedTuple

import mujoco
import numpy as np

from robo47 import panda, simulate
from robo47.checks import Array
from robo47.fast import dynamics
from robo47.panda import READY_Q
from robo47.verify.answers import Function, each
from robo47.verify.oracle import (
    random_q,
)


class Motions(NamedTuple):
    """The arm, ready and then at n - 1 random configurations, each with a motion."""

    q: Array  # configurations, (n, 7)
    qd: Array  # their speeds
    qdd: Array  # and accelerations
    J: Array  # space Jacobians, (n, 6, 7)
    T: Array  # poses of link1 to link7, (n, 7, 4, 4)
    coms: Array  # their centres of mass in the world, (n, 7, 3)
    links: list[Array]  # masses, centres, inertias in the links' own axes, each n times
    armature: Array  # of the arm, n times
    damping: Array  # likewise
    g: Array  # likewise


def motions(
    model: mujoco.MjModel, n: int, seed: int, fastest: float, hardest: float
) -> Motions:
    """Return n motions with speeds and accelerations up to these."""
    arm = panda.arm(model)
    rng = np.random.default_rng(seed)
    q = np.vstack([READY_Q, random_q(model, n - 1, seed)])
    qd, qdd = (rng.uniform(-limit, limit, q.shape) for limit in (fastest, hardest))
    now = [arm.at(x) for x in q]
    fixed = *panda.inertias(model), arm.armature, arm.damping, arm.gravity
    *links, armature, damping, g = (np.array([x] * n) for x in fixed)
    J, T = np.array([x.J_space for x in now]), np.array([x.T_links for x in now])
    coms = np.array([x.coms_world for x in now])
    return Motions(q, qd, qdd, J, T, coms, links, armature, damping, g)


class Clouds(NamedTuple):
    """Bodies of eight points each, that turn and move."""

    m: Array  # masses, kg, (n,)
    c: Array  # centres of mass, (n, 3)
    inertia: Array  # about the centres, (n, 3, 3)
    V: Array  # twists, (n, 6)
    momentum: Array  # (angular; linear), added up point by point, (n, 6)


def clouds(n: int, rng: np.random.Generator) -> Clouds:
    """Return n random clouds of points."""
    bodies = [(rng.uniform(-1, 1, (8, 3)), rng.uniform(0.1, 1, 8)) for _ in range(n)]
    twists = rng.normal(size=(n, 6))
    rows = []
    for (points, weights), V in zip(bodies, twists, strict=True):
        c = weights @ points / weights.sum()
        d = points - c
        inertia = np.eye(3) * (weights @ d**2).sum() - (weights * d.T) @ d
        p = weights[:, None] * (V[3:] + np.cross(V[:3], points))
        momentum = np.concatenate([np.cross(points, p).sum(0), p.sum(0)])
        rows.append((weights.sum(), c, inertia, V, momentum))
    return Clouds(*(np.array(column) for column in zip(*rows, strict=True)))


class Wrong(NamedTuple):
    """What a mistake does to the mass matrices, at worst."""

    off: float  # from MuJoCo's
    asymmetric: float
    least: float  # eigenvalue


def wrong_on_purpose(
    link_inertias: Function, T: Array, masses: Array, coms: Array, inertias: Array
) -> dict[str, Array]:
    """Return {what is wrong: every link's 6x6 inertia, given something wrong}."""
    G = link_inertias(T, masses, coms, inertias)
    R = T[:, :3, :3]
    R_T = np.swapaxes(R, 1, 2)
    flip = np.diag([1.0, 1.0, 1.0, -1.0, -1.0, -1.0])
    no_lever = G.copy()
    no_lever[:, :3, :3] = R @ inertias @ R_T
    c_still = (R_T @ coms[..., None])[..., 0]
    inertias_still = R_T @ inertias @ R
    return {
        "nothing": G,
        "m [c] with the wrong sign": flip @ G @ flip,
        "m [c] [c]^T forgotten": no_lever,
        "c not turned": link_inertias(T, masses, c_still, inertias),
        "I not turned": link_inertias(T, masses, coms, inertias_still),
    }


def wrong_masses(
    link_inertias: Function, mass_matrix: Function, at: Motions, truth: Array
) -> dict[str, Wrong]:
    """Return {what is wrong: what it does}; truth, (n, 7, 7), is MuJoCo's."""
    found = {}
    bodies = zip(at.T, *at.links, strict=True)
    bad = [wrong_on_purpose(link_inertias, *x) for x in bodies]
    for what in bad[0]:
        own = each(mass_matrix, at.J, np.array([one[what] for one in bad]), at.armature)
        skewed = np.abs(own - np.swapaxes(own, 1, 2)).max()
        least = np.linalg.eigvalsh(own).min()
        off = np.abs(own - truth).max()
        found[what] = Wrong(float(off), float(skewed), float(least))
    return found


def library_masses(model: mujoco.MjModel, q: Array) -> Array:
    """Return the library's mass matrices of configurations q, (n, 7, 7)."""
    return dynamics.mass_matrix(panda.arm(model), q)


def swing(integrator: str, timestep: float) -> float:
    """Return the energy, J, that MuJoCo's arm gains in a free swing of 1 s.

    Args:
        integrator: the end of its name in `mujoco.mjtIntegrator`.
        timestep: in seconds. There is no motor, no friction and no joint limit.
    """
    model = panda.load("panda_nohand", drive="torque")
    model.opt.timestep = timestep
    model.dof_damping[:] = 0.0
    model.jnt_limited[:] = 0
    model.opt.integrator = getattr(mujoco.mjtIntegrator, f"mjINT_{integrator}")
    model.opt.enableflags |= mujoco.mjtEnableBit.mjENBL_ENERGY  # else energy stays 0
    data = simulate.start(model, READY_Q)  # its mj_forward fills energy
    before = data.energy.sum()
    mujoco.mj_step(model, data, round(1.0 / timestep))
    mujoco.mj_forward(model, data)  # mj_step leaves the energy of the step before
    return float(data.energy.sum() - before)
