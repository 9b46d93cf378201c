"""The references of Day 3's lab: known rotations, targets, and a circle to draw.

The Jacobian and the torques of a push are compared with MuJoCo's own calls, which are
in the lab. MuJoCo has no inverse kinematics. A solver is therefore judged by the final
pose of the hand, and for a target out of reach by the best of the library's hundreds of
starts.

A solver takes screws, (7, 6), home pose, (4, 4), T_goal, (4, 4), start, (7,), and joint
limits, (7, 2), and returns joint angles, (7,). `arm` is the first two. The circle is in
the y-z plane, and the tool always points down. The whole circle of radius 0.36 m is in
reach; the top of a circle of 0.38 m is not. Metres, radians.
"""

from typing import NamedTuple

import numpy as np

from robo47 import jacobian, screws
from robo47.checks import Array
from robo47.fast.ik import REACHED
from robo47.jacobian import solve_ik
from robo47.screws import fk_space
from robo47.verify import each
from robo47.verify.answers import Function

CENTRE = np.array([0.28, -0.06, 0.55])
LAP = 6.0  # seconds
# From this configuration the elbow meets no joint limit along the circle.
_START_Q = np.array([0.5, -1.3, 0.0, -2.4, -0.5, 1.7, 1.2])

NEAR, FAR = 0.3, 2.0  # radians from the start; metres from the base, out of reach
ENOUGH = 3  # failures, after which no more targets are tried


class Turns(NamedTuple):
    """Rotations whose logarithms are known."""

    R: Array  # rotation matrices, (n, 3, 3)
    logs: Array  # axis times angle, (n, 3)


def turns(n: int, seed: int) -> Turns:
    """Return n rotations, some within 1e-9 rad of 0 or pi, and one by exactly pi.

    Args:
        n: how many; 13 at least.
        seed: of the others.
    """
    rng = np.random.default_rng(seed)
    axes = rng.normal(size=(n, 3))
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    angles = np.pi * rng.uniform(size=n)
    angles[:12] = [0.0, 1e-9, 1e-5, *(np.pi - 10.0 ** -np.arange(1, 10))]
    axes[12] = [0.0, 1.0, 0.0]
    angles[12] = np.pi
    R = screws.exp_rotation(axes, angles)
    R[12] = np.round(R[12])  # exactly pi: both signs are the same rotation
    return Turns(R, angles[:, None] * axes)


def moved(T: Array, e: Array) -> Array:
    """Return poses, (n, 4, 4), rotated and moved by world pose errors, (n, 6)."""
    there = T.copy()
    angle = np.linalg.norm(e[:, :3], axis=1)
    turned = angle > 0  # not where it is NaN
    axes = e[turned, :3] / angle[turned, None]
    there[turned, :3, :3] = screws.exp_rotation(axes, angle[turned]) @ T[turned, :3, :3]
    there[:, :3, 3] += e[:, 3:]
    return there


class Ends(NamedTuple):
    """The results of a solver.

    Attributes:
        missed: fraction of the near targets that it misses.
        out_of_reach: errors divided by the smallest possible errors, (4,).
        beyond: the largest angle beyond a joint limit, radians.
    """

    missed: float
    out_of_reach: Array
    beyond: float


def ends_of(
    solve: Function, arm: tuple[Array, Array], limits: Array, q: Array, seed: int
) -> Ends:
    """Return the results of a solver for near targets, and for some out of reach.

    Args:
        solve: the solver.
        arm: screws and home pose.
        limits: of the joints.
        q: configurations, (n, 7); the starts are nearer to the middle of the limits.
        seed: of the targets.
    """
    rng = np.random.default_rng(seed)
    middle = limits.mean(axis=1)
    starts = middle + 0.7 * (q - middle)
    near = np.clip(starts + rng.uniform(-NEAR, NEAR, q.shape), *limits.T)
    goals = fk_space(*arm, near)
    found = each(lambda T, q: solve(*arm, T, q, limits), goals, starts)
    out = goals[:4].copy()
    out[:, :3, 3] *= FAR / np.linalg.norm(out[:, :3, 3], axis=1)[:, None]
    far = each(lambda T, q: solve(*arm, T, q, limits), out, starts[:4])
    best = jacobian.solve_ik(*arm, out, starts[:4], limits)  # hundreds of starts each
    return Ends(
        float(np.mean(miss(arm, found, goals) > REACHED)),
        miss(arm, far, out) / miss(arm, best, out),
        beyond(limits, np.vstack([found, far])),
    )


def tries(
    solve: Function,
    arm: tuple[Array, Array],
    limits: Array,
    goals: Array,
    q: Array,
    most: int,
    seed: int,
) -> Array:
    """Return the number of the start that reaches each target, (n,); 0 if none does.

    After three failures no more targets are tried.

    Args:
        solve: the solver.
        arm: screws and home pose.
        limits: of the joints.
        goals: targets, (n, 4, 4).
        q: the first start, (7,); the others are random within the limits.
        most: starts of one target.
        seed: of the other starts.
    """
    rng = np.random.default_rng(seed)
    at: list[int] = []
    low, high = limits.T
    for goal in goals:
        if at.count(0) == ENOUGH:
            break
        starts = [q, *rng.uniform(low, high, (most - 1, len(q)))]
        found = (solve(*arm, goal, start, limits) for start in starts)
        ends = (miss(arm, q, goal) < REACHED for q in found)
        at.append(next((i for i, there in enumerate(ends, 1) if there), 0))
    return np.array(at)


def miss(arm: tuple[Array, Array], q: Array, goal: Array) -> Array:
    """Return the norms of the pose errors at q, (..., 7), radians and metres together.

    The norm is infinite if q contains NaN or infinity.
    """
    if not np.isfinite(q).all():
        return np.full(np.shape(q)[:-1], np.inf)
    return np.linalg.norm(jacobian.pose_error(fk_space(*arm, q), goal), axis=-1)


def beyond(limits: Array, q: Array) -> float:
    """Return the largest angle of q, (..., 7), beyond a joint limit, radians."""
    return float(np.maximum(limits[:, 0] - q, q - limits[:, 1]).max().clip(0.0))


def circle(
    arm: tuple[Array, Array], limits: Array, radius: float, times: Array
) -> tuple[Array, Array]:
    """Return the poses of the hand on the circle, and joint angles at the first one.

    Args:
        arm: screws, (7, 6), and home pose, (4, 4).
        limits: of the joints, (7, 2).
        radius: of the circle.
        times: in seconds, (n,); a lap takes LAP.

    Returns:
        Poses, (n, 4, 4), and q, (7,), by the library, so that every lab starts alike.
    """
    phi = 2 * np.pi * np.asarray(times) / LAP
    T = np.tile(np.diag([-1.0, 1.0, -1.0, 1.0]), (len(phi), 1, 1))
    T[:, :3, 3] = CENTRE
    T[:, 1, 3] += radius * np.cos(phi)
    T[:, 2, 3] += radius * np.sin(phi)
    return T, solve_ik(*arm, T[0], _START_Q, limits)


def least_miss(arm: tuple[Array, Array], limits: Array, path: Array, q: Array) -> Array:
    """Return the smallest possible position error at each pose, mm, (n,).

    It is 0 within the workspace.

    Args:
        arm: screws, (7, 6), and home pose, (4, 4).
        limits: of the joints, (7, 2).
        path: poses, (n, 4, 4), each tried from hundreds of starts.
        q: the first of these, (7,).
    """
    best = fk_space(*arm, solve_ik(*arm, path, q, limits))
    return 1000 * np.linalg.norm(best[:, :3, 3] - path[:, :3, 3], axis=1)
