"""What Day 13 asks of MuJoCo: an arm that is held, one that reaches, and a circle.

A state is x = (q - q0, qd), (14,), radians and rad/s; u is the torque, N m, that is
added to what holds q0. The calls that the lab is compared with are in the lab.
"""

import mujoco
import numpy as np

from robo47 import panda, simulate
from robo47.checks import Array
from robo47.jacobian import solve_ik

CENTRE = np.array([0.28, -0.06, 0.55])  # m, of Day 3's circle
LAP = 6.0  # s
# From here the elbow meets no joint limit on the way.
START_Q = np.array([0.5, -1.3, 0.0, -2.4, -0.5, 1.7, 1.2])
SUBSTEPS = 5  # of the simulator, in a step of a motion: 10 ms
EFFORT = 1e-3  # what a motion costs a step, per (N m)^2, ...
BRISK = 1e-2  # ... per (rad/s)^2, ...
FAR = 1_000.0  # ... and at its end, per rad^2 from the goal ...
FAST = 10.0  # ... and per (rad/s)^2; half of all that


def arm() -> mujoco.MjModel:
    """Return the Panda with motors that take torques."""
    return panda.load("panda_nohand", drive="torque")


def on_a_wall() -> mujoco.MjModel:
    """Return a Panda that is mounted at an angle, with other damping in each joint."""
    model = arm()
    model.opt.gravity[:] = (6.0, -2.0, -7.0)
    model.dof_damping[:] = np.linspace(0.5, 3.0, 7)
    return model


def at(
    model: mujoco.MjModel, q0: Array, x: Array, u: Array | float = 0.0
) -> mujoco.MjData:
    """Return the simulator at a state, with what holds q0 and u as its torques."""
    data = simulate.start(model, q0)  # its mj_forward fills qfrc_bias
    data.ctrl[:] = data.qfrc_bias + u
    data.qpos[:] = q0 + x[:7]
    data.qvel[:] = x[7:]
    return data


class Reach:
    """The arm at q0, its inputs, and what they cost: a motion of T steps.

    A step costs half of EFFORT |u|^2 + BRISK |qd|^2, the end half of FAR |q - goal|^2 +
    FAST |qd|^2.
    """

    def __init__(self, model: mujoco.MjModel, q0: Array, goal: Array) -> None:
        """Know where it starts and where it should end, (7,) each."""
        self.model = model
        self.q0 = q0
        self.goal = np.append(goal - q0, np.zeros(7))
        self.hold = simulate.start(model, q0).qfrc_bias.copy()
        self.lxx = BRISK * np.diag(np.repeat([0.0, 1.0], 7))
        self.luu = EFFORT * np.eye(7)
        self.Vxx = np.diag(np.repeat([FAR, FAST], 7))

    def rolled(self, u: Array, x: Array, k: Array, K: Array) -> tuple[Array, Array]:
        """Return states, (T + 1, 14), and inputs, (T, 7): u + k + K (what x is off)."""
        data = at(self.model, self.q0, x[0])
        states, inputs = [x[0]], []
        for before, known, more, gain in zip(x[:-1], u, k, K, strict=True):
            inputs.append(known + more + gain @ (states[-1] - before))
            data.ctrl[:] = self.hold + inputs[-1]
            mujoco.mj_step(self.model, data, SUBSTEPS)
            states.append(np.append(data.qpos - self.q0, data.qvel))
        return np.array(states), np.array(inputs)

    def cost(self, x: Array, u: Array) -> float:
        """Return what a motion costs."""
        steps = np.sum(x[:-1] @ self.lxx * x[:-1]) + np.sum(u @ self.luu * u)
        end = x[-1] - self.goal
        return float(0.5 * (steps + end @ self.Vxx @ end))

    def slopes(self, x: Array, u: Array) -> tuple[Array, Array]:
        """Return fx, (T, 14, 14), and fu, (T, 14, 7), of the steps of a motion."""
        fx, fu = [], []
        A, B = np.zeros((14, 14)), np.zeros((14, 7))
        for now, torque in zip(x[:-1], u, strict=True):
            data = at(self.model, self.q0, now)
            data.ctrl[:] = self.hold + torque
            mujoco.mjd_transitionFD(self.model, data, 1e-6, True, A, B, None, None)
            powers = [np.linalg.matrix_power(A, n) for n in range(SUBSTEPS + 1)]
            fx.append(powers[-1])  # of one substep, taken for all five
            fu.append(sum(powers[:-1]) @ B)
        return np.array(fx), np.array(fu)

    def expanded(self, x: Array, u: Array) -> tuple[Array, ...]:
        """Return what `ilqr_backward` takes, from fx to Vxx."""
        n = len(u)
        lx = x[:-1] @ self.lxx
        Vx = self.Vxx @ (x[-1] - self.goal)
        second = (np.tile(one, (n, 1, 1)) for one in (self.lxx, self.luu))
        lux = np.zeros((n, 7, 14))  # no cost of a step has u times x in it
        return *self.slopes(x, u), lx, u @ self.luu, *second, lux, Vx, self.Vxx


def circle(model: mujoco.MjModel, radius: float, times: Array) -> tuple[Array, Array]:
    """Return where the hand should be, (n, 4, 4), and joint angles at the first, (7,).

    Day 3's circle: in the y-z plane, the tool points down all the way.
    """
    phi = 2 * np.pi * np.asarray(times) / LAP
    T = np.tile(np.diag([-1.0, 1.0, -1.0, 1.0]), (len(phi), 1, 1))
    T[:, :3, 3] = CENTRE
    T[:, 1, 3] += radius * np.cos(phi)
    T[:, 2, 3] += radius * np.sin(phi)
    screws = panda.screws(model)
    q = solve_ik(screws, panda.home_pose(model), T[0], START_Q, model.jnt_range)
    return T, q
