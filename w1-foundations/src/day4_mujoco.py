"""Inputs of Day 4's functions: random bodies and motions, mistakes, a free swing.

The MuJoCo calls with which the lab compares its results are in the lab. The free swing
of MuJoCo's own arm is here.

Spatial inertias are 6x6 about the world's origin, (angular; linear), expressed in the
world frame. SI units.
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
    """The ready configuration and n - 1 random ones, each with a random motion."""

    q: Array  # joint angles, rad, (n, 7)
    qd: Array  # joint velocities, rad/s, (n, 7)
    qdd: Array  # joint accelerations, rad/s^2, (n, 7)
    J: Array  # space Jacobians, (n, 6, 7)
    T: Array  # poses of link1 to link7, (n, 7, 4, 4)
    coms: Array  # their centres of mass in the world frame, (n, 7, 3)
    links: list[Array]  # masses, centres, inertias in the links' frames, each n times
    armature: Array  # of the arm, kg m^2, n times
    damping: Array  # of the joints, N m s/rad, n times
    g: Array  # acceleration of gravity, m/s^2, n times


def motions(
    model: mujoco.MjModel, n: int, seed: int, fastest: float, hardest: float
) -> Motions:
    """Return n motions with random velocities and accelerations.

    Args:
        model: of the arm.
        n: how many configurations, the ready configuration included.
        seed: of the random numbers.
        fastest: largest joint velocity, rad/s.
        hardest: largest joint acceleration, rad/s^2.
    """
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
    """Bodies of eight point masses each, with random twists."""

    m: Array  # masses, kg, (n,)
    c: Array  # centres of mass, m, (n, 3)
    inertia: Array  # about the centres of mass, kg m^2, (n, 3, 3)
    V: Array  # twists (omega; v), (n, 6)
    momentum: Array  # (angular; linear), the sum over the points, (n, 6)


def clouds(n: int, rng: np.random.Generator) -> Clouds:
    """Return n random bodies and the momenta of their points, added up."""
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
    """The effect of a mistake on the mass matrices, in the worst configuration."""

    off: float  # largest difference from MuJoCo's M, kg m^2
    asymmetric: float  # largest entry of M - M^T, kg m^2
    least: float  # smallest eigenvalue, kg m^2


def wrong_on_purpose(
    link_inertias: Function, T: Array, masses: Array, coms: Array, inertias: Array
) -> dict[str, Array]:
    """Return {mistake: the spatial inertias of the links with it, (7, 6, 6)}.

    Args:
        link_inertias: the lab's function.
        T: poses of the links, (7, 4, 4).
        masses: kg, (7,).
        coms: centres of mass in the links' frames, m, (7, 3).
        inertias: about them in the links' frames, kg m^2, (7, 3, 3).
    """
    G = link_inertias(T, masses, coms, inertias)
    R = T[:, :3, :3]
    R_T = np.swapaxes(R, 1, 2)
    flip = np.diag([1.0, 1.0, 1.0, -1.0, -1.0, -1.0])
    no_lever = G.copy()
    no_lever[:, :3, :3] = R @ inertias @ R_T
    c_still = (R_T @ coms[..., None])[..., 0]
    inertias_still = R_T @ inertias @ R
    return {
        "none": G,
        "m [c] with the wrong sign": flip @ G @ flip,
        "m [c] [c]^T omitted": no_lever,
        "c not rotated": link_inertias(T, masses, c_still, inertias),
        "I not rotated": link_inertias(T, masses, coms, inertias_still),
    }


def wrong_masses(
    link_inertias: Function, mass_matrix: Function, at: Motions, truth: Array
) -> dict[str, Wrong]:
    """Return {mistake: its effect on M}; truth, (n, 7, 7), is MuJoCo's M."""
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
    """Return the library's mass matrices at configurations q, kg m^2, (n, 7, 7)."""
    return dynamics.mass_matrix(panda.arm(model), q)


def swing(integrator: str, timestep: float, start: Array = READY_Q) -> float:
    """Return the energy, J, that MuJoCo's arm gains in a free swing of 1 s.

    The arm has no motor torque, no damping and no joint limits, so its energy should
    stay constant.

    Args:
        integrator: the end of its name in `mujoco.mjtIntegrator`.
        timestep: of the simulation, s.
        start: joint angles from which the arm is released at rest, rad, (7,).
    """
    model = panda.load("panda_nohand", drive="torque")
    model.opt.timestep = timestep
    model.dof_damping[:] = 0.0
    model.jnt_limited[:] = 0
    model.opt.integrator = getattr(mujoco.mjtIntegrator, f"mjINT_{integrator}")
    model.opt.enableflags |= (
        mujoco.mjtEnableBit.mjENBL_ENERGY
    )  # energy is off by default
    data = simulate.start(model, start)  # its mj_forward fills energy
    before = data.energy.sum()
    mujoco.mj_step(model, data, round(1.0 / timestep))
    mujoco.mj_forward(model, data)  # energy of the new state; mj_step has the old one
    return float(data.energy.sum() - before)
