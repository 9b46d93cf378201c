"""Day 46: a toy day that shows an author all that a day can have.

make day46                  runs this
"""

import kit  # noqa: F401 (goes on in the kit's own Python)
import numpy as np

from robo47 import cli, panda, se3
from robo47.lesson.lab import Lab

SEED, TRIALS = 46, 200


def angle_between(a: np.ndarray, b: np.ndarray) -> float:
    """Return the angle between two vectors, (3,) each, in radians.

    Of (1, 0, 0) and (0, 2, 0) it is pi / 2.
    """
    # region 46.1
    return np.arctan2(np.linalg.norm(np.cross(a, b)), a @ b)
    # endregion 46.1


def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return a x b, (3,). (1, 0, 0) x (0, 1, 0) is (0, 0, 1)."""
    # region 46.2
    return np.array(
        [
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        ]
    )
    # endregion 46.2


def spin(omega: np.ndarray) -> np.ndarray:
    """Return diag([omega], [omega]), (6, 6): it turns both halves of a twist."""
    # region 46.3
    K = np.array([cross(omega, axis) for axis in np.eye(3)]).T
    out = np.zeros((6, 6))
    out[:3, :3] = out[3:, 3:] = K
    return out
    # endregion 46.3


def bracket(V: np.ndarray) -> np.ndarray:
    """Return [V], (4, 4), of a twist (omega; v): no pose, its bottom row is 0."""
    # region 46.4
    out = np.zeros((4, 4))
    out[:3, :3] = spin(V[:3])[:3, :3]
    out[:3, 3] = V[3:]
    return out
    # endregion 46.4


def polar(x: float, y: float) -> tuple[float, float]:
    """Return how far (x, y) is, in metres, and in which direction, in radians."""
    # region 46.5
    return np.hypot(x, y), np.arctan2(y, x)
    # endregion 46.5


def normal(v: np.ndarray) -> np.ndarray:
    """Return any unit vector, (3,), at a right angle to v."""
    # region 46.6
    other = np.eye(3)[np.argmin(np.abs(v))]
    n = np.cross(v, other)
    return n / np.linalg.norm(n)
    # endregion 46.6


def seen_from(T_world_hand: np.ndarray, p_world: np.ndarray) -> np.ndarray:
    """Return a point of the world, (3,), in the hand's coordinates."""
    # region 46.7
    return (se3.inverse(T_world_hand) @ np.append(p_world, 1.0))[:3]
    # endregion 46.7


def fingers(model) -> float:
    """Return how many joints of a model move along a line."""
    # region 46.8
    return float(sum(model.jnt_type[j] == 2 for j in range(model.njnt)))
    # endregion 46.8


def main() -> int:
    """Run the lab."""
    lab = Lab(__file__, __doc__)
    rng = np.random.default_rng(SEED)
    a, b = rng.normal(size=(2, TRIALS, 3))
    lab.step("1. Against NumPy")
    ours = np.array([cross(x, y) for x, y in zip(a, b, strict=True)])
    errors = np.abs(ours - np.cross(a, b)).max(axis=1)
    lab.record("toy_cross", errors, seed=SEED)
    lab.step("2. At right angles")
    right = [
        abs(angle_between(normal(x), x) - np.pi / 2) < 1e-9
        and np.allclose(spin(x)[3:, 3:] @ y, np.cross(x, y))
        and np.allclose(bracket(np.append(x, y))[:3, 3], y)
        for x, y in zip(a, b, strict=True)
    ]
    lab.record("toy_right_share", np.mean(right), seed=SEED)
    r, phi = polar(3.0, 4.0)
    lab.check("polar", [r - 5.0, phi - np.arctan2(4.0, 3.0)])
    T = se3.make_T(se3.Rz(1.0), [1.0, 2.0, 3.0])
    lab.check("seen from itself, the hand is at 0", seen_from(T, T[:3, 3]))
    lab.check("fingers", fingers(panda.load("panda")) - 2)
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
