"""The scene of Day 12 in MuJoCo: an arm at a wall under a roof, and its torques.

The arm consists of nine capsules (`robo47.shapes`), the wall and the roof are boxes. A
collision checker may omit some links, to show what happens then. Metres, radians.
"""

from collections.abc import Callable, Collection

import mujoco
import numpy as np

from robo47 import panda, se3, shapes
from robo47.checks import Array

WALL = (0.25, 0.95)  # m, its extent in x; it is 4 cm thick, at y = 0
HIGH = 0.5  # m, the height of the wall
ROOF = 0.85  # m, height of its lower side
MARGIN = 0.005  # m: a smaller distance is a collision
FAR = 1.0  # m: the largest distance that mj_geomDistance computes, which saves time
# Start and goal differ in joint 1: the pen is on the right or left of the wall.
BESIDE = np.array([0.0, 0.0, 0.0, -2.4, 0.0, 2.4, 0.785])
START = BESIDE - 0.7 * np.eye(7)[0]
GOAL = BESIDE + 0.7 * np.eye(7)[0]


class Wall:
    """The arm, a wall and a roof, and the arm's collision checker."""

    def __init__(self, forget: Collection[int] = (), roof: float = ROOF) -> None:
        """Build the scene.

        Args:
            forget: links that the collision checker omits, 1 to 7.
            roof: height of the roof's lower side, m.
        """
        high = HIGH / 2.0
        middle = se3.make_T(np.eye(3), (np.mean(WALL), 0.0, high))
        above = se3.make_T(np.eye(3), (0.0, 0.0, roof + 0.02))
        half = (np.diff(WALL)[0] / 2.0, 0.02, high)
        self.boxes = [(middle, half), (above, (1.2, 1.2, 0.02))]

        def edit(spec: mujoco.MjSpec) -> None:
            shapes.add_arm(spec)
            shapes.World.of(boxes=self.boxes).add_to(spec)

        self.model = panda.load("panda_nohand", edit=edit)
        self.model.dof_damping[:] = 0.0  # the plan of a motion neglects it
        self.data = mujoco.MjData(self.model)
        arm = shapes.Shape(self.model)
        # Day 11's: largest distance from each joint axis to any distal point, m.
        self.reach = arm.distal_radii
        geoms = [(self.model.geom(f"arm{i}").id, one.link)
                 for i, one in enumerate(arm.capsules)]  # fmt: skip
        around = [self.model.geom(f"world{i}").id for i in range(len(self.boxes))]
        self.pairs = [(a, b) for a, _ in geoms for b in around]
        # Links 1 and 2 end 0.22 m from the base's axis and 0.56 m above the ground.
        looked = [a for a, link in geoms if link > 2 and link not in forget]
        self.seen = [(a, b) for a in looked for b in around]
        self.looks = 0
        self._known: dict[bytes, bool] = {}

    def edge_free(self, a: Array, b: Array) -> bool:
        """Return whether the straight edge from a to b is collision-free.

        Each edge is tested once and its result kept, because a plan with more samples
        tests the same edges again.
        """
        key = a.tobytes() + b.tobytes()
        if key not in self._known:
            self._known[key] = self._looked_along(a, b - a)
        return self._known[key]

    def _looked_along(self, q: Array, dq: Array) -> bool:
        """Test q + s dq for s from 0 to 1 by Day 11's conservative advancement."""
        speed = np.abs(dq) @ self.reach  # bound on any point's speed, m per unit of s
        s = 0.0
        while True:
            self.looks += 1
            distance = self.apart(q + s * dq, self.seen)
            if distance <= MARGIN:
                return False
            if s >= 1.0:
                return True
            s = min(1.0, s + distance / speed) if speed > 0.0 else 1.0

    def apart(self, q: Array, pairs: list[tuple[int, int]]) -> float:
        """Return the minimum distance of these pairs of shapes at q, m."""
        self.data.qpos[:] = q
        mujoco.mj_kinematics(self.model, self.data)  # fills geom_xpos and geom_xmat
        return min(
            mujoco.mj_geomDistance(self.model, self.data, a, b, FAR, None)
            for a, b in pairs
        )


def samples(model: mujoco.MjModel, n: int, seed: int) -> Array:
    """Return n random configurations within the joints' ranges, (n, 7), rad."""
    low, high = model.jnt_range.T
    return np.random.default_rng(seed).uniform(low, high, (n, 7))


def torque(model: mujoco.MjModel) -> Callable[[Array, Array, Array], Array]:
    """Return MuJoCo's inverse dynamics: (q, qd, qdd) to N m, (7,)."""
    data = mujoco.MjData(model)

    def needed(q: Array, qd: Array, qdd: Array) -> Array:
        data.qpos[:] = q
        data.qvel[:] = qd
        data.qacc[:] = qdd
        mujoco.mj_inverse(model, data)  # fills qfrc_inverse
        return data.qfrc_inverse.copy()

    return needed
