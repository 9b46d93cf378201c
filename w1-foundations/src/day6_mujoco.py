"""Day 6's simulations in MuJoCo: random states, a table to press on, a circle.

Twists, accelerations and errors are (angular; linear), wrenches (moment; force),
expressed in the world frame at the hand's site. Metres, radians, newtons, seconds.
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import ArrayLike

from robo47 import jacobian, panda, scenes, simulate, task_space
from robo47.arm import Arm
from robo47.checks import Array
from robo47.fast.arm_state import ArmState
from robo47.panda import READY_Q
from robo47.verify import mujoco_site_jacobian, random_q

SITE = "attachment_site"  # end of the arm without a gripper
SPEED_UP = 1.0  # s, duration of the acceleration on the circle


class State(NamedTuple):
    """A random state of the arm, and random inputs for the functions of the day."""

    now: ArmState  # the arm at its configuration
    qd: Array  # joint velocities in rad/s, (7,)
    torque: Array  # joint torques, N m, (7,)
    wrench: Array  # wrench at the hand, (6,)
    acc: Array  # wanted acceleration of the hand, (6,)
    e: Array  # pose error of the hand, (6,)


class Motion(NamedTuple):
    """The reference of the hand at an instant."""

    T: Array  # its pose, (4, 4)
    V: Array  # its twist, (6,)
    A: Array  # its acceleration, (6,)


def states(model: mujoco.MjModel, n: int, seed: int, sigma: float) -> list[State]:
    """Return up to n states where J's smallest singular value is over sigma."""
    arm = panda.arm(model)
    rng = np.random.default_rng(seed)
    q = random_q(model, 2 * n, seed)
    found = []
    least = np.linalg.svd(mujoco_site_jacobian(model, q), compute_uv=False)[:, -1]
    for one in q[least > sigma][:n]:
        qd, torque = rng.uniform(-1, 1, (2, 7)) * [[1], [10]]
        found.append(State(arm.at(one), qd, torque, *rng.uniform(-10, 10, (3, 6))))
    return found


def arguments(at: Sequence[State]) -> dict[str, tuple[Array, ...]]:
    """Return {function: arguments}, (n, ...) each, for those that MuJoCo lacks."""
    rng = np.random.default_rng(len(at))
    n = len(at)
    J = np.array([s.now.J_site for s in at])
    M = np.array([s.now.M for s in at])
    torque = np.array([s.torque for s in at])
    V_err = np.array([s.wrench for s in at])
    e = np.array([s.e for s in at])
    Lambda = task_space.task_inertia(J, M)
    K, D = rng.normal(size=(2, n, 6, 6))
    force, k, height = rng.uniform([-10, 290, -10], [10, 310, 10], (n, 3)).T
    return {
        "nullspace_torque": (J, M, Lambda, torque),
        "impedance_wrench": (e, V_err, K + np.swapaxes(K, 1, 2), D),
        "critical_damping": (rng.uniform(30, 400, (n, 6)), Lambda),
        "set_point_for_force": (force, k, height),
        "hybrid_wrench": (e, V_err, K + np.swapaxes(K, 1, 2), D, force),
    }


def rest_after(
    model: mujoco.MjModel, law: simulate.Controller, wrench: Array, rate: float
) -> Array:
    """Return the displacement of the hand from READY_Q after three seconds, (6,).

    Args:
        model: of the arm, with motors.
        law: the controller.
        wrench: at the hand during all of the time, (6,).
        rate: of the controller, Hz.
    """
    push = simulate.push_at(SITE, wrench)
    start = simulate.start(model, READY_Q)
    run = simulate.run(model, start, law, 3.0, rate=rate, push=push)
    T, T_end = (panda.arm(model).at(q).T_world_ee for q in (READY_Q, run.q[-1]))
    return jacobian.pose_error(T, T_end)


def released(
    model: mujoco.MjModel, law: simulate.Controller, e: ArrayLike, size: float
) -> Array:
    """Return the component of the hand's error along e over time, from 1 on, (n,).

    Args:
        model: of the arm, with motors.
        law: the controller, whose target is the pose at `READY_Q`.
        e: direction of the first error, (6,).
        size: the first error is size times e, rad and m; the hand starts at rest.
    """
    arm = panda.arm(model)
    goal = arm.at(READY_Q).T_world_ee
    e = np.asarray(e, dtype=np.float64)

    def error(q: Array) -> Array:
        return jacobian.pose_error(arm.at(q).T_world_ee, goal)

    q = READY_Q
    for _ in range(50):
        q = q + np.linalg.pinv(arm.at(q).J_site) @ (error(q) - size * e)
    run = simulate.run(model, simulate.start(model, q), law, 3.0)
    return np.array([error(q) for q in run.q]) @ e / (size * e @ e)


def circle(t: float, T_start: ArrayLike, radius: float, turn: float) -> Motion:
    """Return the reference of the hand on a vertical circle that starts at rest.

    The circle is in a plane parallel to y and z; the start is its lowest point. The
    speed grows as a raised cosine for one second and is constant afterwards.

    Args:
        t: time since the start, s.
        T_start: pose of the hand at t = 0, (4, 4).
        radius: metres.
        turn: time of one revolution at full speed, s.
    """
    w = 2.0 * np.pi / turn
    u = min(t / SPEED_UP, 1.0)
    ease = u / 2.0 - np.sin(np.pi * u) / (2.0 * np.pi)
    angle = w * (SPEED_UP * ease + max(t - SPEED_UP, 0.0))
    speed = w * (1.0 - np.cos(np.pi * u)) / 2.0
    gain = w * np.pi * np.sin(np.pi * u) / (2.0 * SPEED_UP)
    c = radius * np.cos(angle)
    s = radius * np.sin(angle)
    T = np.array(T_start, dtype=np.float64)
    V = np.zeros(6)
    A = np.zeros(6)
    T[1:3, 3] += s, radius - c
    V[4:] = speed * c, speed * s
    A[4:] = gain * c - speed**2 * s, gain * s + speed**2 * c
    return Motion(T, V, A)


def off_circle(
    model: mujoco.MjModel, law: simulate.Controller, radius: float, turn: float
) -> Array:
    """Return the distances of the hand from its reference on the circle, m, (n,)."""
    run = simulate.run(model, simulate.start(model, READY_Q), law, turn + 0.5)
    arm = panda.arm(model)
    T = [arm.at(q).T_world_ee for q in run.q]
    goal = [circle(t, T[0], radius, turn).T for t in run.t]
    return np.linalg.norm(np.subtract(goal, T)[:, :3, 3], axis=1)


def above_table(model: mujoco.MjModel, gap: float) -> Array:
    """Return a configuration with the tip over `scenes.PRESS_XY`, pointing down.

    Args:
        model: of `scenes.press_table`.
        gap: between tip and table, m; negative below the table's surface.

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
    """Return the normal force on the table over time, from 10 mm above it on.

    Args:
        controller: maps the arm and its first configuration to a controller.
        drive: "torque", or "servo" for the stiff position drives.
        change: a function that changes gains or limits of the model before the run.
        seconds: duration of the simulation.
        rate: of the controller, Hz.

    Returns:
        The force after each time step, N, (N,): a peak may be shorter than a control
        period.
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

    # A push is called before each step, so it reads the force of the previous step.
    simulate.run(model, data, law, seconds, rate=rate, push=look)
    look(model, data)
    return np.array(felt[1:])
