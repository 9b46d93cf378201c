"""The arm of the capstone: its numbers from the model, its formulas from `fns`.

`fns` holds the functions of the week by name (`robo47.capstone.USES`), each for one
configuration. Whatever is a formula of the lessons is called from there; this module
reads the model, keeps what was measured and puts the calls in order.

Units: metres, radians, seconds, kilograms, N m; poses `T_world_x` are (4, 4).
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import mujoco
import numpy as np

from robo47 import panda, simulate
from robo47.arm import GRAVITY
from robo47.checks import Array
from robo47.errors import Robo47Error
from robo47.fast.vectors import times
from robo47.panda.reading import joint_ids

Law = Callable[[float, Array, Array], Array]  # (t, q, qd) to torques, (7,)

OMEGA = 20.0  # rad/s, of computed torque; 100 Hz allows no more than about 60
STIFFNESS = np.array([30.0, 30.0, 30.0, 600.0, 600.0, 600.0])  # N m/rad, N/m
POSTURE = (10.0, 4.0)  # N m/rad, N m s/rad: how firmly the elbow is held in lines
REST = (100.0, 10.0)  # N m/rad, N m s/rad: the springs that hold the arm at the end
REACHED = 1e-4  # m and rad: an answer of solve_ik further off than this is none


class State(NamedTuple):
    """The kinematics and dynamics at one configuration and velocity."""

    T: Array  # T_world_tcp
    J_space: Array
    G: Array
    M: Array
    bias: Array


class Arm:
    """The seven joints with the hand, and what it holds, as one chain of links.

    `worst` is the largest error that its laws have kept.
    """

    def __init__(self, fns: Any, model: mujoco.MjModel):
        """Read the model's numbers; `fns` turns them into screws and inertias."""
        self.fns = fns
        bodies = model.jnt_bodyid[joint_ids(model)]
        frames = [(model.body_pos[b], model.body_quat[b]) for b in bodies]
        self.T_parent_link = [fns.link_T(p.copy(), quat.copy()) for p, quat in frames]
        body = model.body("hand")
        T_link7_hand = fns.link_T(body.pos.copy(), body.quat.copy())
        T_hand_tcp = fns.make_T(np.eye(3), model.site("tcp").pos.copy())
        T_zero = self.links(np.zeros(7))
        self.screws = fns.joint_screws(T_zero)
        self.M_tcp = T_zero[6] @ (T_link7_hand @ T_hand_tcp)
        self.limits, self.tau_max = simulate.limits(model)
        dofs = simulate.addresses(model)[1]
        self.armature = model.dof_armature[dofs].copy()
        self.damping = model.dof_damping[dofs].copy()
        hand = panda.hand_inertia(model, opening=0.04)
        self.empty = panda.inertias(model).carrying(fns.combine_bodies, *hand)
        self.inertias = self.empty
        self.worst = 0.0
        self.gains = [float(k) for k in fns.pd_gains(OMEGA, 1.0)]

    def links(self, q: Array) -> Array:
        """Return T_world_link of the seven links, (7, 4, 4)."""
        poses = []
        T = np.eye(4)
        for T_parent_link, angle in zip(self.T_parent_link, q, strict=True):
            T = T @ T_parent_link @ self.fns.joint_T(float(angle))
            poses.append(T)
        return np.array(poses)

    def end(self, q: Array) -> Array:
        """Return T_world_tcp, (4, 4)."""
        return self.fns.fk_space(self.screws, self.M_tcp, q)

    def at(self, q: Array, qd: Array) -> State:
        """Return the state at q and qd."""
        fns = self.fns
        T_links = self.links(q)
        J_space = fns.space_jacobian(self.screws, q)
        G = fns.link_inertias(T_links, *self.inertias)
        M = fns.mass_matrix(J_space, G, self.armature)
        bias = fns.bias_torque(J_space, G, qd, GRAVITY)
        return State(self.end(q), J_space, G, M, bias)

    def gravity(self, q: Array) -> Array:
        """Return the torque that holds the arm at q, (7,)."""
        T_links = self.links(q)
        masses, coms, _ = self.inertias
        coms_world = times(T_links[:, :3, :3], coms) + T_links[:, :3, 3]
        J_space = self.fns.space_jacobian(self.screws, q)
        return self.fns.gravity_torque(J_space, masses, coms_world, GRAVITY)

    def waypoint(self, T_goal: Array, q: Array) -> tuple[Array, float]:
        """Return q at which the tool is at T_goal, and its manipulability.

        Raises:
            Robo47Error: solve_ik found none.
        """
        fns = self.fns
        answer = fns.solve_ik(self.screws, self.M_tcp, T_goal, q, self.limits)
        T = self.end(answer)
        off = float(np.abs(fns.pose_error(T, T_goal)).max())
        if not off < REACHED:
            raise Robo47Error(
                f"no way point: solve_ik ends {off:.3g} (m or rad) from the pose at"
                f" {np.round(T_goal[:3, 3], 3).tolist()}. Choose a place nearer to"
                " (0.5, 0), or check solve_ik (task 3.6)."
            )
        J = fns.site_jacobian(fns.space_jacobian(self.screws, answer), T[:3, 3])
        return answer, float(fns.manipulability(J))

    def hold(self, mass: float, half: float, T_world_cube: Array, q: Array) -> Array:
        """Count a cube as part of the hand; return T_tcp_cube, (4, 4)."""
        T_link7_world = self.fns.inverse(self.links(q)[6])
        com = (T_link7_world @ T_world_cube)[:3, 3]
        I_cube = mass * (2.0 * half) ** 2 / 6.0 * np.eye(3)
        self.inertias = self.empty.carrying(self.fns.combine_bodies, mass, com, I_cube)
        return self.fns.inverse(self.end(q)) @ T_world_cube

    def release(self) -> None:
        """Count the hand as empty again."""
        self.inertias = self.empty

    def move(self, q0: Array, q1: Array, T: float) -> Law:
        """Return computed torque along a quintic from the measured q0 to q1, T seconds.

        It keeps the worst error of any joint, radians.
        """

        def torque(t: float, q: Array, qd: Array) -> Array:
            fns = self.fns
            now = self.at(q, qd)
            q_ref, qd_ref, qdd_ref = fns.joint_trajectory(q0, q1, t, T)
            e, ed = q_ref - q, qd_ref - qd
            self.worst = max(self.worst, float(np.abs(e).max()))
            known = now.M, now.bias, self.damping, qd
            return fns.computed_torque(*known, e, ed, qdd_ref, *self.gains)

        return torque

    def line(self, T0: Array, T1: Array, T: float, posture: Array) -> Law:
        """Return a spring between the hand and a point that goes straight to T1.

        It keeps the hand's worst distance from that point, metres.

        Args:
            T0, T1: poses of the point at the start and after T seconds, (4, 4).
            T: seconds.
            posture: where the null space pulls the joints, (7,).
        """
        # The twist of the point per unit of s: the turn's axis does not change.
        way = self.fns.pose_error(T0, T1)

        def torque(t: float, q: Array, qd: Array) -> Array:
            fns = self.fns
            now = self.at(q, qd)
            s, sd, sdd = fns.quintic_scaling(t, T)
            J = fns.site_jacobian(now.J_space, now.T[:3, 3])
            Lambda = fns.task_inertia(J, now.M)
            e = fns.pose_error(now.T, fns.interpolate_pose(T0, T1, float(s)))
            self.worst = max(self.worst, float(np.linalg.norm(e[3:])))
            D = fns.critical_damping(STIFFNESS, Lambda)
            wrench = fns.impedance_wrench(e, sd * way - J @ qd, np.diag(STIFFNESS), D)
            Jdot_qd = fns.bias_acceleration(now.J_space, qd, now.T[:3, 3])
            # The torque of the motion itself takes the place of the bias.
            forward = fns.osc_torque(J, Lambda, now.bias, Jdot_qd, sdd * way)
            back = fns.pd_torque(posture - q, -qd, *POSTURE)
            tau_null = fns.nullspace_torque(J, now.M, Lambda, back)
            return fns.impedance_torque(J, wrench, forward, self.damping, qd, tau_null)

        return torque

    def rest(self, q0: Array) -> Law:
        """Return springs in the joints that hold the arm at q0."""
        return lambda t, q, qd: self.fns.gravity_pd(q0 - q, -qd, *REST, self.gravity(q))
