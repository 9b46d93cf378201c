"""Dynamics of the Panda: ours beside the tools people would pick instead.

Three questions for many configurations (mass matrix, torque of a motion, Jacobian of
the end), each asked of our batch, of MuJoCo and of Pinocchio in plain Python loops that
keep no answers; and what a control loop asks, one configuration at a time, of `Arm`.
Every rival is checked against MuJoCo's own answers before it is timed.
"""

from collections.abc import Callable, Iterable
from typing import NamedTuple

import mujoco
import numpy as np

from bench.timing import installed, microseconds, pinocchio, take_turns
from robo47 import kinematics, panda, verify
from robo47.checks import Array
from robo47.fast import dynamics
from robo47.fast.jacobians import jacobians

N = 100_000
ONE = 2_000  # configurations for what is asked one at a time
CHECKED = 200
SITE = "attachment_site"
QUESTIONS = ("mass matrix", "inverse dynamics", "site Jacobian")


class Motion(NamedTuple):
    """Configurations, velocities and accelerations, each (n, 7)."""

    q: Array
    qd: Array
    qdd: Array


class Rival(NamedTuple):
    """A way to answer the questions."""

    # Question and motion to the answers, for the check.
    solve: Callable[[str, Motion], Array]
    # The same work without collecting the answers.
    time: Callable[[str, Motion], object]


def ours() -> Rival:
    """robo47.fast, one call."""
    arm = panda.arm(_model())
    calls: dict[str, Callable[[Motion], Array]] = {
        "mass matrix": lambda m: dynamics.mass_matrix(arm, m.q),
        "inverse dynamics": lambda m: dynamics.inverse_dynamics(arm, *m),
        "site Jacobian": lambda m: jacobians(arm.screws, arm.M_home, m.q, True),
    }
    answer = lambda question, m: calls[question](m)  # noqa: E731
    return Rival(answer, answer)


def one_by_one(
    asking: Iterable[Callable[..., object]], reading: Iterable[Callable[[], Array]]
) -> Rival:
    """Return a rival that is asked each of QUESTIONS of one (q, qd, qdd) at a time."""
    asks = dict(zip(QUESTIONS, asking, strict=True))
    read = dict(zip(QUESTIONS, reading, strict=True))

    def time(question: str, motion: Motion) -> None:
        ask = asks[question]
        for q, qd, qdd in zip(*motion, strict=True):
            ask(q, qd, qdd)

    def solve(question: str, motion: Motion) -> Array:
        answers = []
        for row in zip(*motion, strict=True):
            asks[question](*row)
            answers.append(read[question]().copy())
        return np.array(answers)

    return Rival(solve, time)


def mujoco_loop() -> Rival:
    """Only what each question needs: no collisions, no constraints."""
    model = _model()
    data = mujoco.MjData(model)
    site = model.site(SITE).id
    J = np.zeros((6, 7))
    tau = np.zeros(7)

    def places(q: Array) -> None:
        data.qpos[:] = q
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)

    def mass_matrix(q: Array, qd: Array, qdd: Array) -> None:
        places(q)
        mujoco.mj_crb(model, data)

    def inverse_dynamics(q: Array, qd: Array, qdd: Array) -> None:
        places(q)
        data.qvel[:] = qd
        data.qacc[:] = qdd
        mujoco.mj_comVel(model, data)
        mujoco.mj_rne(model, data, 1, tau)

    def site_jacobian(q: Array, qd: Array, qdd: Array) -> None:
        places(q)
        mujoco.mj_jacSite(model, data, J[3:], J[:3], site)

    def read_M() -> Array:
        M = np.empty((7, 7))
        for column, unit in zip(M, np.eye(7), strict=True):
            mujoco.mj_mulM(model, data, column, unit)
        return M

    return one_by_one(
        (mass_matrix, inverse_dynamics, site_jacobian),
        (read_M, lambda: tau, lambda: J),
    )


def pinocchio_loop() -> Rival:
    """Pinocchio's C++; it takes the armature into rnea, and writes v before omega."""
    pin, model, data, frame = pinocchio()
    without = model.copy()
    without.armature = np.zeros(7)
    world = pin.LOCAL_WORLD_ALIGNED
    J = np.zeros((6, 7))

    def site_jacobian(q: Array, qd: Array, qdd: Array) -> None:
        J[:] = pin.computeFrameJacobian(model, data, q, frame, world)

    def read_M() -> Array:
        upper = np.triu(data.M)
        return upper + np.triu(upper, 1).T

    return one_by_one(
        (
            lambda q, qd, qdd: pin.crba(model, data, q),
            lambda q, qd, qdd: pin.rnea(without, data, q, qd, qdd),
            site_jacobian,
        ),
        (read_M, lambda: data.tau, lambda: J[[3, 4, 5, 0, 1, 2]]),
    )


RIVALS: dict[str, Callable[[], Rival]] = {
    "robo47 batch": ours,
    "MuJoCo, loop": mujoco_loop,
    "Pinocchio, loop": pinocchio_loop,
}


def truths(motion: Motion) -> dict[str, Array]:
    """Return MuJoCo's answers, each by the kit's oracle."""
    model = _model()
    q, qd, qdd = motion
    tau = verify.mujoco_inverse_dynamics(model, q, qd, qdd)
    return {
        "mass matrix": verify.mujoco_mass_matrix(model, q),
        "inverse dynamics": tau - model.dof_armature * qdd - model.dof_damping * qd,
        "site Jacobian": verify.mujoco_site_jacobian(model, q),
    }


def run(rounds: int = 7, n: int = N) -> dict:
    """Check every rival against MuJoCo, then time them all, taking turns.

    Args:
        rounds: timed calls of each.
        n: configurations.

    Returns:
        {"n", "questions": {question: {rival: {"us", "low", "high", "error"}}},
        "one": {what: microseconds}, "left_out": {rival: why}}; errors are relative.
    """
    motion = _motion(n)
    few = Motion(*(part[:CHECKED] for part in motion))
    truth = truths(few)
    rivals, left_out = installed(RIVALS)

    def error(name: str, question: str) -> float:
        off = np.abs(rivals[name].solve(question, few) - truth[question]).max()
        return float(off / np.abs(truth[question]).max())

    questions = {}
    for question in QUESTIONS:
        asked = {
            name: lambda r=rival, x=question: r.time(x, motion)
            for name, rival in rivals.items()
        }
        questions[question] = {
            name: {**microseconds(t, n), "error": error(name, question)}
            for name, t in take_turns(asked, rounds).items()
        }
    one = one_at_a_time(rounds)
    return {"n": n, "questions": questions, "one": one, "left_out": left_out}


def one_at_a_time(rounds: int = 7) -> dict[str, float]:
    """Return microseconds for what a control loop asks of one configuration."""
    model = _model()
    arm = panda.arm(model)
    data = mujoco.MjData(model)
    chain = kinematics.chain_to(model, SITE)
    motion = _motion(ONE)

    def all_at_once() -> None:
        for q, qd, _ in zip(*motion, strict=True):
            now = arm.at(q)
            _ = now.T_world_ee, now.J_site, now.M, now.bias(qd)

    def fk() -> None:
        for q in motion.q:
            kinematics.fk(chain, q)

    def step() -> None:
        for _ in range(ONE):
            mujoco.mj_step(model, data)

    whats = {"Arm: pose, J, M, bias": all_at_once, "kinematics.fk": fk, "mj_step": step}
    timed = take_turns(whats, rounds)
    return {what: t["low"] / ONE * 1e6 for what, t in timed.items()}


def _motion(n: int) -> Motion:
    rng = np.random.default_rng(47)
    q = verify.random_q(_model(), n, seed=47)
    return Motion(q, rng.uniform(-2, 2, q.shape), rng.uniform(-10, 10, q.shape))


def _model() -> mujoco.MjModel:
    return panda.load("panda_nohand", drive="torque")
