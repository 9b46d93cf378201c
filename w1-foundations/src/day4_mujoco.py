"""MuJoCo's links, and random motions of the arm that functions of dynamics are asked.

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
    mujoco_acceleration,
    mujoco_mass_matrix,
    mujoco_step,
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
    M: Array  # MuJoCo's mass matrices, (n, 7, 7)


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
    M = mujoco_mass_matrix(model, q)
    return Motions(q, qd, qdd, J, T, coms, links, armature, damping, g, M)


def momenta(spatial_inertia: Function, n: int, rng: np.random.Generator) -> Array:
    """Return G V of n random clouds of points minus their momenta, (n, 6).

    A momentum (angular; linear) is added up point by point; G is given the cloud's
    mass, centre and inertia.
    """
    clouds = [(rng.uniform(-1, 1, (8, 3)), rng.uniform(0.1, 1, 8)) for _ in range(n)]
    off = []
    for (points, weights), V in zip(clouds, rng.normal(size=(n, 6)), strict=True):
        c = weights @ points / weights.sum()
        d = points - c
        inertia = np.eye(3) * (weights @ d**2).sum() - (weights * d.T) @ d
        p = weights[:, None] * (V[3:] + np.cross(V[:3], points))
        momentum = np.concatenate([np.cross(points, p).sum(0), p.sum(0)])
        off.append(spatial_inertia(weights.sum(), c, inertia) @ V - momentum)
    return np.array(off)


def crosses(ad: Function, n: int, rng: np.random.Generator) -> Array:
    """Return ad(V) W of n random twists minus the cross products, (n, 6)."""
    V, W = rng.normal(size=(2, n, 6))
    (w, v), (w2, v2) = np.split(V, 2, axis=1), np.split(W, 2, axis=1)
    truth = np.hstack([np.cross(w, w2), np.cross(v, w2) + np.cross(w, v2)])
    return (each(ad, V) @ W[..., None])[..., 0] - truth


def mujoco_inertias(
    model: mujoco.MjModel, q: Array, spatial_inertia: Function
) -> list[Array]:
    """Return spatial_inertia of link1 to link7 from where MuJoCo says they are."""
    data = mujoco.MjData(model)
    G = []
    data.qpos[:] = q
    mujoco.mj_kinematics(model, data)  # fills xipos, ximat: centre and principal axes
    for i in [model.body(f"link{n}").id for n in range(1, 8)]:
        R = data.ximat[i].reshape(3, 3)
        c = data.xipos[i]
        inertia = R @ np.diag(model.body_inertia[i]) @ R.T
        G.append(spatial_inertia(model.body_mass[i], c, inertia))
    return G


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
    link_inertias: Function, mass_matrix: Function, at: Motions
) -> dict[str, tuple[float, float, float]]:
    """Return what mistakes do to the mass matrices.

    Returns:
        {what is wrong: (off by, asymmetric by, least eigenvalue)}.
    """
    found = {}
    bodies = zip(at.T, *at.links, strict=True)
    bad = [wrong_on_purpose(link_inertias, *x) for x in bodies]
    for what in bad[0]:
        own = each(mass_matrix, at.J, np.array([one[what] for one in bad]), at.armature)
        skewed = np.abs(own - np.swapaxes(own, 1, 2)).max()
        least = np.linalg.eigvalsh(own).min()
        found[what] = float(np.abs(own - at.M).max()), float(skewed), float(least)
    return found


def library_masses(model: mujoco.MjModel, n: int, seed: int) -> Array:
    """Return the library's mass matrices of many q minus MuJoCo's, (n, 7, 7)."""
    q = random_q(model, n, seed)
    return dynamics.mass_matrix(panda.arm(model), q) - mujoco_mass_matrix(model, q)


def forwards(
    model: mujoco.MjModel, at: Motions, M: Array, bias: Array, own: Function
) -> tuple[Array, Array]:
    """Return forward_dynamics minus MuJoCo's qdd, and its next qd minus MuJoCo's.

    Args:
        model: of the arm, with motors.
        at, M, bias: motions, and mass matrices and bias torques there.
        own: the lab's forward_dynamics.
    """
    rng = np.random.default_rng(len(M))
    h = model.opt.timestep
    tau = simulate.limits(model)[1] * rng.uniform(-0.5, 0.5, at.q.shape)
    off = each(own, M, bias, at.damping, at.qd, tau)
    off = off - mujoco_acceleration(model, at.q, at.qd, tau)
    slower = M + h * np.diag(at.damping[0])  # implicitfast brakes at its step's end
    after = at.qd + h * each(own, slower, bias, at.damping, at.qd, tau)
    return off, after - mujoco_step(model, at.q, at.qd, tau)


def mujoco_energies(model: mujoco.MjModel, q: Array, qd: Array) -> Array:
    """Return MuJoCo's kinetic and potential energy of link1 to link7, J, (n, 2)."""
    model.opt.enableflags |= mujoco.mjtEnableBit.mjENBL_ENERGY  # else they stay 0
    link0 = model.body("link0")  # never moves, but MuJoCo counts its weight
    still = -link0.mass[0] * model.opt.gravity @ link0.ipos
    states = zip(q, qd, strict=True)
    found = np.array([simulate.start(model, *state).energy for state in states])
    return found[:, ::-1] - [0.0, still]


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
    data = simulate.start(model, READY_Q)
    mujoco.mj_step(model, data, round(1.0 / timestep))
    q = np.array([data.qpos, READY_Q])
    qd = np.array([data.qvel, np.zeros(7)])
    return -float(np.diff(mujoco_energies(model, q, qd).sum(axis=1))[0])
