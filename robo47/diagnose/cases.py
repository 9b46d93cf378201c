"""The questions of each task: seeded inputs, the tutorial's and beyond."""

from functools import cache

import numpy as np

from robo47 import se3
from robo47.checks import Array
from robo47.diagnose.verdict import MODEL, TASK_FUNCTIONS, Call

SEED = 47
BASE = 2  # row of `configurations`: the next seven turn one joint of it each
# The handout's home_q. `panda` has it too, but importing that loads MuJoCo.
READY_Q = (0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785)


def calls(task: str) -> list[Call]:
    """Return what to ask the student's functions, the same at every call.

    Args:
        task: "1.1" to "1.8".

    Returns:
        Calls with arguments of their own: a runner may let student code change them.

    Raises:
        KeyError: no such task.
    """
    names = TASK_FUNCTIONS[task]
    return [Call(name, args) for name in names for args in arguments(name)]


def arguments(function: str) -> list[tuple]:
    """Return the arguments of every call of a function, fresh copies.

    Args:
        function: as in `TASK_FUNCTIONS`.
    """
    rng = np.random.default_rng(SEED)
    return _MAKE[function](rng)


def _rotations(rng: np.random.Generator, n: int) -> Array:
    return se3.quat_to_R(rng.normal(size=(n, 4)))


def _poses(rng: np.random.Generator, n: int) -> Array:
    return se3.make_T(_rotations(rng, n), rng.uniform(-1, 1, (n, 3)))


def _make_T(rng: np.random.Generator) -> list[tuple]:
    plain = [(np.eye(3), np.array([1.0, 2.0, 3.0]))]
    return plain + list(
        zip(_rotations(rng, 5), rng.uniform(-2, 2, (5, 3)), strict=True)
    )


def _angles(rng: np.random.Generator) -> list[tuple]:
    return [(theta,) for theta in (0.0, np.pi / 2, -0.785, 2.356, -7.1)] + [
        (float(theta),) for theta in rng.uniform(-np.pi, np.pi, 3)
    ]


def _inverse(rng: np.random.Generator) -> list[tuple]:
    move = np.eye(4)
    move[0, 3] = 1.0
    return [(move,)] + [(T,) for T in _poses(rng, 5)]


def _quaternions(rng: np.random.Generator) -> Array:
    """As in model files, unit ones, and ones of any length; some with w < 0."""
    written = [[1, 0, 0, 0], [1, 1, 0, 0], [1, -1, 0, 0], [0.3826834, 0, 0, 0.9238795]]
    q = rng.normal(size=(6, 4))
    q[:3] /= np.linalg.norm(q[:3], axis=1, keepdims=True)
    q[[1, 4], 0] = -np.abs(q[[1, 4], 0])
    return np.vstack([np.array(written, dtype=np.float64), q])


def _quat_to_R(rng: np.random.Generator) -> list[tuple]:
    return [(quat,) for quat in _quaternions(rng)]


def _link_T(rng: np.random.Generator) -> list[tuple]:
    quats = _quaternions(rng)
    return list(zip(rng.uniform(-1, 1, (len(quats), 3)), quats, strict=True))


def _predict_order(rng: np.random.Generator) -> list[tuple]:
    return list(zip(_poses(rng, 6), _poses(rng, 6), strict=True))


def _fk(rng: np.random.Generator) -> list[tuple]:
    return [(MODEL, q) for q in configurations().copy()]


@cache
def configurations() -> Array:
    """Return joint angles for tasks 1.6 and 1.8, (14, 7).

    Zero and the handout's home; a random one (row BASE) and seven more, each of which
    differs from it in one joint; random ones. All but zero are within the limits.
    """
    from robo47 import panda, verify  # MuJoCo takes its time: only where it is needed

    q = verify.random_q(panda.load("panda_nohand"), 12, SEED)
    base = np.tile(q[0], (7, 1))
    np.fill_diagonal(base, q.diagonal(-1))
    return np.vstack([np.zeros(7), READY_Q, q[0], base, q[8:]])


_MAKE = {
    "make_T": _make_T,
    "Rz": _angles,
    "inverse": _inverse,
    "quat_to_R": _quat_to_R,
    "link_T": _link_T,
    "joint_T": _angles,
    "compose_fk": _fk,
    "predict_order": _predict_order,
    "link4_to_world": _fk,
}
