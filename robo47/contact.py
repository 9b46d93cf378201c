"""Reference motions of a hand in contact: pushed, pressing on a table, circling.

The motions to follow and what MuJoCo says of the hand; no controller. Twists,
accelerations and errors are (angular; linear), wrenches (moment; force), in world axes.
Metres, radians, newtons, seconds.
"""

import math
from collections.abc import Callable

import mujoco
import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks, jacobian, panda, scenes, simulate
from robo47.arm import Arm
from robo47.checks import Array
from robo47.panda import READY_Q
from robo47.verify.oracle import SITE, mujoco_site_jacobian

SPEED_UP = 1.0  # s, in which the hand gathers speed on its circle
STEP = 3e-4  # s, of the differences of J: leaves 1e-11


def circle(
    t: float, T_start: ArrayLike, radius: float, turn: float
) -> tuple[Array, Array, Array]:
    """Return where a hand should be that sets off from rest on an upright circle.

    The circle is in the plane of y and z, above the start. The speed grows as a raised
    cosine for one second, then it stays.

    Args:
        t: seconds since the start.
        T_start: pose of the hand at t = 0, (4, 4).
        radius: metres.
        turn: seconds for one turn at full speed.

    Returns:
        Its pose, (4, 4), twist, (6,), and acceleration, (6,).
    """
    w = 2.0 * np.pi / turn
    u = min(t / SPEED_UP, 1.0)
    ease = u / 2.0 - np.sin(np.pi * u) / (2.0 * np.pi)
    angle = w * (SPEED_UP * ease + max(t - SPEED_UP, 0.0))
    speed = w * (1.0 - np.cos(np.pi * u)) / 2.0
    gain = w * np.pi * np.sin(np.pi * u) / (2.0 * SPEED_UP)
    c, s = radius * np.cos(angle), radius * np.sin(angle)
    T = np.array(T_start, dtype=np.float64)
    V = np.zeros(6)
    A = np.zeros(6)
    T[1:3, 3] += s, radius - c
    V[4:] = speed * c, speed * s
    A[4:] = gain * c - speed**2 * s, gain * s + speed**2 * c
    return T, V, A


def small_pose_error(T: Array, T_goal: Array) -> Array:
    """Return `jacobian.pose_error` for a loop: unchecked, and 20 times as fast.

    For rotations by less than 90 degrees, whose sine tells the angle.

    Args:
        T: pose, (4, 4).
        T_goal: where it should be, (4, 4).

    Returns:
        Rotation vector and translation to the goal, in world axes, (6,).
    """
    E = T_goal[:3, :3] @ T[:3, :3].T
    x, y, z = E[2, 1] - E[1, 2], E[0, 2] - E[2, 0], E[1, 0] - E[0, 1]
    sine = 0.5 * math.sqrt(x * x + y * y + z * z)
    half = 0.5 * math.asin(min(sine, 1.0)) / sine if sine > 0.0 else 0.5
    dx, dy, dz = T_goal[:3, 3] - T[:3, 3]
    return np.array([half * x, half * y, half * z, dx, dy, dz])


def above_table(model: mujoco.MjModel, gap: float) -> Array:
    """Return a configuration with the tip over `scenes.PRESS_XY`, pointing down.

    Args:
        model: of `scenes.press_table`.
        gap: between tip and table in metres; negative is deeper than the table.

    Returns:
        q, radians, (7,).
    """
    arm = panda.arm(model)
    T = arm.at(READY_Q).T_world_ee.copy()
    T[:3, 3] = *scenes.PRESS_XY, scenes.TOUCH + gap
    ranges, _ = simulate.limits(model)
    return jacobian.solve_ik(arm.screws, arm.M_home, T, READY_Q, ranges)


def press(
    controller: Callable[[Arm, Array], simulate.Controller],
    *,
    drive: str = "torque",
    change: Callable[[mujoco.MjModel], None] | None = None,
    seconds: float = 2.0,
    rate: float = simulate.RATE,
) -> Array:
    """Return how hard the tip presses on the table, from 10 mm above it on.

    Args:
        controller: from the arm and the configuration it starts at to a controller.
        drive: "torque", or "servo" for the stiff position drives.
        change: is given the model first, to write other gains or limits into it.
        seconds: how long.
        rate: of the controller in Hz.

    Returns:
        Newtons after each time step, (N,): a peak may be over before a control
        period is.
    """
    model = scenes.press_table(drive=drive)
    if change is not None:
        change(model)
    q = above_table(model, 0.01)
    law = controller(panda.arm(model), q)

    data = simulate.start(model, q)
    felt = []

    def look(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        felt.append(scenes.contact_force(model, data, "tip", "table_top"))

    # A push is called before every step: it sees the force of the step before.
    simulate.run(model, data, law, seconds, rate=rate, push=look)
    look(model, data)
    return np.array(felt[1:])


def mujoco_site_bias(model: mujoco.MjModel, q: ArrayLike, qd: ArrayLike) -> Array:
    """Return the rate of MuJoCo's site Jacobian times qd, from differences of it.

    MuJoCo's own mj_jacDot is not used: in 3.3.0 its linear rows are wrong.

    Args:
        model: the arm without a hand.
        q: configuration in radians, (7,).
        qd: joint velocities in rad/s, one number or (7,).

    Returns:
        The hand's acceleration at qdd = 0 in rad/s2 and m/s2, (6,), to about 1e-11.
    """
    q = checks.array(q, "q", (7,))
    qd = np.broadcast_to(checks.per_joint(qd, "qd", q), 7)
    J = mujoco_site_jacobian(model, q + np.outer(STEP * np.array([-2, -1, 1, 2]), qd))
    return (J[0] - 8.0 * J[1] + 8.0 * J[2] - J[3]) @ qd / (12.0 * STEP)


def mujoco_push(
    model: mujoco.MjModel,
    q: ArrayLike,
    qd: ArrayLike,
    tau: ArrayLike,
    wrench: ArrayLike,
) -> tuple[Array, Array]:
    """Return how MuJoCo's arm accelerates under torques and a push at its hand.

    Args:
        model: the arm without a hand.
        q: configuration in radians, (7,).
        qd: joint velocities in rad/s, one number or (7,).
        tau: torques on the joints in N m, on top of motors that do nothing, (7,).
        wrench: (moment; force) at the site, by mj_applyFT, in N m and N, (6,).

    Returns:
        Accelerations of the joints, rad/s2, (7,), and of the hand, (6,).
    """
    data = simulate.start(model, q, qd)
    data.qfrc_applied[:] = checks.array(tau, "tau", (7,))
    simulate.push_at(SITE, wrench)(model, data)
    mujoco.mj_forward(model, data)  # fills qacc
    J = mujoco_site_jacobian(model, data.qpos)
    return data.qacc, J @ data.qacc + mujoco_site_bias(model, data.qpos, data.qvel)
