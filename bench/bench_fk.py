"""Forward kinematics of the Panda: ours beside the tools people would pick instead.

Each rival answers the same configurations for the same frame, the end effector of
`panda_nohand`, and is checked against MuJoCo before it is timed. Rivals that only take
one configuration at a time are called in a plain Python loop, doing nothing else.
"""

import importlib
from collections.abc import Callable
from dataclasses import dataclass

import mujoco
import numpy as np

from bench.timing import installed, microseconds, pinocchio, take_turns
from robo47 import kinematics, panda, screws, se3, verify
from robo47.checks import Array

N = 100_000
FRAME = "site:attachment_site"
SLOW_N = 300  # the textbook's own code needs 300 us for each
CHECKED = 200


@dataclass
class Rival:
    """A way to compute forward kinematics."""

    # Configurations (n, 7) to poses (n, 4, 4), for the check.
    solve: Callable[[Array], Array]
    time: Callable[[Array], object]  # the same work without collecting the answers
    n: int = N  # how many configurations are timed
    model: mujoco.MjModel | None = None  # of which robot; by default the Panda


def ours() -> Rival:
    """robo47.kinematics.fk, one call."""
    chain = kinematics.chain_to(panda.load("panda_nohand"), FRAME)
    fk = lambda q: kinematics.fk(chain, q)  # noqa: E731
    return Rival(fk, fk)


def plain_products() -> Rival:
    """The same chain as stacks of 4x4 matrices, multiplied one after the other."""
    chain = kinematics.chain_to(panda.load("panda_nohand"), FRAME)

    def solve(q: Array) -> Array:
        T = np.eye(4)
        for link in chain.links:
            T = T @ link.T_parent_link
            for joint in link.joints:
                turn = np.zeros((len(q), 4, 4))
                c, s = np.cos(q[:, joint.qpos_adr]), np.sin(q[:, joint.qpos_adr])
                turn[:, 0, 0] = c
                turn[:, 0, 1] = -s
                turn[:, 1, 0] = s
                turn[:, 1, 1] = c
                turn[:, 2, 2] = turn[:, 3, 3] = 1.0
                T = T @ turn
        return T @ chain.T_link_frame

    return Rival(solve, solve)


def mujoco_loop() -> Rival:
    """mj_kinematics, which computes every body, in a Python loop."""
    model = panda.load("panda_nohand")
    data = mujoco.MjData(model)

    def loop(q: Array) -> None:
        for row in q:
            data.qpos[:] = row
            mujoco.mj_kinematics(model, data)

    return Rival(lambda q: verify.mujoco_poses(model, q)[FRAME], loop)


def pinocchio_loop(*, frame: bool) -> Rival:
    """Pinocchio's C++ in a Python loop: joints only, or with the frame's placement."""
    pin, model, data, index = pinocchio()

    def loop(q: Array) -> None:
        if frame:
            for row in q:
                pin.forwardKinematics(model, data, row)
                pin.updateFramePlacement(model, data, index)
        else:
            for row in q:
                pin.forwardKinematics(model, data, row)

    def pose(row: Array) -> Array:
        pin.forwardKinematics(model, data, row)
        return pin.updateFramePlacement(model, data, index).homogeneous

    return Rival(lambda q: np.array([pose(row) for row in q]), loop)


def toolbox_batch() -> Rival:
    """Robotics Toolbox's C code over the batch; its Panda ends at the fingertips."""
    rtb = importlib.import_module("roboticstoolbox")
    ets = rtb.models.Panda().ets()
    T_tip_site = se3.make_T(np.diag([-1.0, -1.0, 1.0]), [0.0, 0.0, -0.1034])
    return Rival(lambda q: ets.eval(q) @ T_tip_site, ets.eval)


def textbook_loop() -> Rival:
    """FKinSpace of Modern Robotics: the product of exponentials, in a Python loop."""
    mr = importlib.import_module("modern_robotics")
    model = panda.load("panda_nohand")
    M = panda.home_pose(model)
    S = panda.screws(model).T
    solve = lambda q: np.array([mr.FKinSpace(M, S, row) for row in q])  # noqa: E731
    return Rival(solve, solve, SLOW_N)


def ours_by_screws() -> Rival:
    """robo47.screws.fk_space, one call: the textbook's formula as a batch."""
    model = panda.load("panda_nohand")
    S, M = panda.screws(model), panda.home_pose(model)
    fk = lambda q: screws.fk_space(S, M, q)  # noqa: E731
    return Rival(fk, fk)


def any_robot() -> Rival:
    """Ours on a Panda whose every axis is tilted, so that nothing can be folded."""
    model = tilted_panda()
    chain = kinematics.chain_to(model, FRAME)
    fk = lambda q: kinematics.fk(chain, q)  # noqa: E731
    return Rival(fk, fk, model=model)


def tilted_panda() -> mujoco.MjModel:
    """Return the Panda with random joint axes and anchors."""
    model = panda.load("panda_nohand")
    rng = np.random.default_rng(47)
    axes = rng.normal(size=model.jnt_axis.shape)
    model.jnt_axis[:] = axes / np.linalg.norm(axes, axis=1, keepdims=True)
    model.jnt_pos[:] = 0.1 * rng.normal(size=model.jnt_pos.shape)
    return model


RIVALS: dict[str, Callable[[], Rival]] = {
    "robo47 fk": ours,
    "robo47 fk_space, screws": ours_by_screws,
    "robo47 fk, any axes": any_robot,
    "MuJoCo mj_kinematics, loop": mujoco_loop,
    "Pinocchio, loop": lambda: pinocchio_loop(frame=False),
    "Pinocchio with the frame, loop": lambda: pinocchio_loop(frame=True),
    "Robotics Toolbox, C batch": toolbox_batch,
    "plain 4x4 products, NumPy": plain_products,
    "textbook FKinSpace, loop": textbook_loop,
}


def run(rounds: int = 7, n: int = N) -> dict:
    """Check every rival against MuJoCo, then time them all, taking turns.

    Args:
        rounds: timed calls of each.
        n: configurations, for those that can take many.

    Returns:
        {"n", "rows": {name: {"us", "low", "high", "error"}}, "left_out": {name: why}}.
    """
    arm = panda.load("panda_nohand")
    q = verify.random_q(arm, n, seed=47)
    rivals, left_out = installed(RIVALS)
    errors = {}
    for name, rival in rivals.items():
        truth = verify.mujoco_poses(rival.model or arm, q[:CHECKED])[FRAME]
        errors[name] = float(np.abs(rival.solve(q[:CHECKED]) - truth).max())
    used = {name: q[: min(rival.n, n)] for name, rival in rivals.items()}
    timed = take_turns(
        {name: lambda r=r, q=used[name]: r.time(q) for name, r in rivals.items()},
        rounds,
    )
    rows = {
        name: {**microseconds(t, len(used[name])), "error": errors[name]}
        for name, t in timed.items()
    }
    return {"n": n, "rows": rows, "left_out": left_out}
