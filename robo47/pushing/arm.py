"""The arm of the push: Week 1's, with a spring from its tool to a moving set point.

Metres, radians, seconds, N m; poses `T_world_x` are (4, 4).
"""

from collections.abc import Callable
from typing import Any

import mujoco
import numpy as np

from robo47.capstone.arm import POSTURE, STIFFNESS, Arm, Law
from robo47.checks import Array
from robo47.pushing import scene

SetPoint = Callable[[float], tuple[Array, Array]]  # t to position and velocity, (2,)
DOWN = np.diag([1.0, -1.0, -1.0])  # orientation of a hand that points down


class PushingArm(Arm):
    """The seven joints with the hand; the tool is the sphere."""

    def __init__(self, fns: Any, model: mujoco.MjModel, forward: bool = True):
        """Read the model's numbers.

        Args:
            fns: has an attribute for every name of Week 1 in `robo47.pushing.USES`.
            model: of `scene.tray`.
            forward: True: the damper of the spring is given the set point's velocity.
        """
        super().__init__(fns, model)
        self.forward = forward

    def pose_at(self, xy: Array) -> Array:
        """Return the pose of the tool at a point of the plane, (2,)."""
        return self.fns.make_T(DOWN, scene.world(xy))

    def sphere(self, q: Array) -> Array:
        """Return the position of the sphere in the plane at a configuration, (2,)."""
        return np.asarray(self.end(q))[:2, 3] - scene.HOME

    def follow(self, set_point: SetPoint, posture: Array) -> Law:
        """Return a critically damped spring between the sphere and a moving set point.

        It keeps the largest distance of the sphere from its set point, metres.

        Args:
            set_point: position and velocity in the plane at a time.
            posture: configuration that the null space is pulled to, (7,).
        """

        def torque(t: float, q: Array, qd: Array) -> Array:
            fns = self.fns
            now = self.at(q, qd)
            xy, v = set_point(t)
            J = fns.site_jacobian(now.J_space, now.T[:3, 3])
            Lambda = fns.task_inertia(J, now.M)
            e = fns.pose_error(now.T, self.pose_at(xy))
            self.worst = max(self.worst, float(np.linalg.norm(e[3:5])))
            D = fns.critical_damping(STIFFNESS, Lambda)
            twist = np.zeros(6)
            twist[3:5] = v if self.forward else 0.0
            wrench = fns.impedance_wrench(e, twist - J @ qd, np.diag(STIFFNESS), D)
            Jdot_qd = fns.bias_acceleration(now.J_space, qd, now.T[:3, 3])
            still = fns.osc_torque(J, Lambda, now.bias, Jdot_qd, np.zeros(6))
            back = fns.pd_torque(posture - q, -qd, *POSTURE)
            tau_null = fns.nullspace_torque(J, now.M, Lambda, back)
            return fns.impedance_torque(J, wrench, still, self.damping, qd, tau_null)

        return torque
