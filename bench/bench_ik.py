"""Inverse kinematics of random reachable targets: ours beside what people would pick.

Everyone starts at the ready pose, may start again at random, and has to bring the
Panda to the target to 1e-8 within its joint limits. How many it solved stands beside
its time; that is judged here, by MuJoCo's poses, whatever a rival says of itself.
"""

import importlib
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any
from unittest import mock

import numpy as np

from bench.timing import installed, microseconds, pinocchio, take_turns
from robo47 import jacobian, panda, se3, verify
from robo47.checks import Array
from robo47.fast.ik import REACHED
from robo47.fast.ik_many import Many
from robo47.fast.ik_one import One

N = 1000
FRAME = "site:attachment_site"
RESTARTS = 20
STEPS = 60  # of one try
SEED = 15


@dataclass
class Rival:
    """A way to solve inverse kinematics."""

    # Targets (n, 4, 4) to configurations (n, 7) and the steps that it took.
    solve: Callable[[Array], tuple[Array, int]]
    n: int = N  # how many targets it is given


def ours() -> Rival:
    """robo47.jacobian.solve_ik, one call."""
    model = panda.load("panda_nohand")
    S, M = panda.screws(model), panda.home_pose(model)
    steps = [0]
    look_many = Many.look
    look_one = One.look

    def count_many(many: Many) -> Array:
        steps[0] += many._q.shape[1]  # the walkers that have not ended
        return look_many(many)

    def count_one(one: One) -> float:
        steps[0] += 1
        return look_one(one)

    def solve(T: Array) -> tuple[Array, int]:
        steps[0] = 0
        with (
            mock.patch.object(Many, "look", count_many),
            mock.patch.object(One, "look", count_one),
        ):
            q = jacobian.solve_ik(S, M, T, panda.READY_Q, model.jnt_range)
        return q, steps[0]

    return Rival(solve)


def one_at_a_time() -> Rival:
    """Ours in a Python loop, as a script with one target calls it."""
    batch = ours().solve

    def solve(T: Array) -> tuple[Array, int]:
        found = [batch(goal[None]) for goal in T]
        return np.concatenate([q for q, _ in found]), sum(n for _, n in found)

    return Rival(solve, 50)


def toolbox() -> Rival:
    """Robotics Toolbox's C code, its own restarts; models.DH.Panda has the limits."""
    rtb = importlib.import_module("roboticstoolbox")
    ets = rtb.models.DH.Panda().ets()
    start = panda.READY_Q.copy()
    # Its Panda ends elsewhere: the same fixed pose at every q (0.103 m, 180 degrees).
    here = verify.mujoco_poses(panda.load("panda_nohand"), start[None])[FRAME][0]
    T_site_tip = se3.inverse(here) @ ets.eval(start)

    def solve(T: Array) -> tuple[Array, int]:
        # Its tolerance is on half of the squared error; everyone here stops at 1e-9.
        found = [ets.ik_LM(goal, q0=start, tol=0.5e-18) for goal in T @ T_site_tip]
        q = np.array([np.ravel(answer.q) for answer in found])
        return q, sum(answer.iterations for answer in found)

    return Rival(solve)


def pinocchio_loop() -> Rival:
    """The lesson's damped least squares in a Python loop over Pinocchio's C++."""
    pin, model, data, index = pinocchio()
    low, high = model.lowerPositionLimit, model.upperPositionLimit
    axes = pin.LOCAL_WORLD_ALIGNED
    none = np.eye(6)

    def one_try(goal: Any, q: Array) -> tuple[Array, float, int]:
        for step in range(1, STEPS + 1):  # noqa: B007 (returned below)
            J = pin.computeFrameJacobian(model, data, q, index, axes)
            here = data.oMf[index]
            turn = pin.log3(goal.rotation @ here.rotation.T)
            e = np.concatenate([goal.translation - here.translation, turn])
            ee = e @ e
            if ee < 1e-18:
                break
            A = J @ J.T + (0.5 * ee + 1e-6) * none
            q = np.clip(q + J.T @ np.linalg.solve(A, e), low, high)
        return q, ee, step

    def solve(T: Array) -> tuple[Array, int]:
        return _with_restarts(one_try, [pin.SE3(goal) for goal in T], low, high)

    return Rival(solve)


def mink_loop() -> Rival:
    """mink: a quadratic program in each step, with the limits in it."""
    mink = importlib.import_module("mink")
    model = panda.load("panda_nohand")
    configuration = mink.Configuration(model)
    task = mink.FrameTask("attachment_site", "site", 1.0, 1.0, lm_damping=1e-3)
    limits = [mink.ConfigurationLimit(model)]

    def one_try(goal: Any, q: Array) -> tuple[Array, float, int]:
        task.set_target(goal)
        configuration.update(q)
        for step in range(1, STEPS + 1):  # noqa: B007 (returned below)
            e = task.compute_error(configuration)
            ee = float(e @ e)
            if ee < 1e-18:
                break
            v = mink.solve_ik(configuration, [task], 1.0, "daqp", 1e-9, limits=limits)
            configuration.integrate_inplace(v, 1.0)
        return configuration.q.copy(), ee, step

    def solve(T: Array) -> tuple[Array, int]:
        goals = [mink.SE3.from_matrix(goal) for goal in T]
        return _with_restarts(one_try, goals, *model.jnt_range.T)

    return Rival(solve, 50)


def _with_restarts(
    one_try: Callable[[Any, Array], tuple[Array, float, int]],
    goals: list[Any],
    low: Array,
    high: Array,
) -> tuple[Array, int]:
    """Return the best q for every goal, and the steps of all tries together."""
    rng = np.random.default_rng(SEED)
    found = []
    steps = 0
    for goal in goals:
        best, least = panda.READY_Q, np.inf
        for k in range(1 + RESTARTS):
            start = rng.uniform(low, high) if k else panda.READY_Q.copy()
            q, ee, taken = one_try(goal, start)
            steps += taken
            if ee < least:
                best, least = q, ee
            if least < 1e-18:
                break
        found.append(best)
    return np.array(found), steps


RIVALS: dict[str, Callable[[], Rival]] = {
    "robo47 solve_ik": ours,
    "robo47 solve_ik, in a loop": one_at_a_time,
    "Robotics Toolbox ik_LM, C": toolbox,
    "Pinocchio, damped steps in a loop": pinocchio_loop,
    "mink, in a loop": mink_loop,
}


def judge(rival: Rival, T: Array) -> dict[str, float]:
    """Return what a rival's answers are worth, by MuJoCo's poses."""
    model = panda.load("panda_nohand")
    q, steps = rival.solve(T)
    metres, radians = se3.pose_distance(verify.mujoco_poses(model, q)[FRAME], T)
    there = np.hypot(metres, radians) < REACHED
    inside = ((q >= model.jnt_range[:, 0]) & (q <= model.jnt_range[:, 1])).all(axis=1)
    return {
        "targets": len(T),
        "solved": int((there & inside).sum()),
        "within": int(inside.sum()),
        "steps": steps / len(T),
    }


def run(rounds: int = 5, n: int = N) -> dict[str, Any]:
    """Judge every rival's answers, then time them all, taking turns.

    Args:
        rounds: timed calls of each.
        n: targets, for those that are fast enough.

    Returns:
        {"n", "rows": {name: {"us", "low", "high", "targets", "solved", "within",
        "steps"}}, "left_out": {name: why}}.
    """
    model = panda.load("panda_nohand")
    T = verify.mujoco_poses(model, verify.random_q(model, n, SEED))[FRAME]
    rivals, left_out = installed(RIVALS)
    used = {name: T[: rival.n] for name, rival in rivals.items()}
    rows = {name: judge(rival, used[name]) for name, rival in rivals.items()}
    timed = take_turns(
        {name: lambda r=r, T=used[name]: r.solve(T) for name, r in rivals.items()},
        rounds,
    )
    for name, t in timed.items():
        rows[name] |= microseconds(t, len(used[name]))
    return {"n": n, "rows": rows, "left_out": left_out}
