"""What Day 12 asks of MuJoCo: an arm beside a wall, under a roof, and its torques.

The arm is nine capsules (`robo47.shapes`), the wall and the roof are boxes. A checker
may forget some links: then it plans with an arm that is not there. Metres, radians.
"""

from collections.abc import Callable, Collection

import mujoco
import numpy as np

from robo47 import panda, se3, shapes
from robo47.checks import Array

WALL = (0.25, 0.95)  # m, from where to where it stands in x; it is 4 cm thick, at y = 0
HIGH = 0.5  # m
ROOF = 0.85  # m, its lower side
MARGIN = 0.005  # m: what is nearer counts as touching
FAR = 1.0  # m: mj_geomDistance looks no further, which costs less
# Where the arm's pen stands beside the wall, q1 apart: on its right and on its left.
BESIDE = np.array([0.0, 0.0, 0.0, -2.4, 0.0, 2.4, 0.785])
START = BESIDE - 0.7 * np.eye(7)[0]
GOAL = BESIDE + 0.7 * np.eye(7)[0]


class Wall:
    """The arm, a wall and a roof, and a checker of straight edges of joint angles."""

    def __init__(self, forget: Collection[int] = (), roof: float = ROOF) -> None:
        """Build the scene.

        Args:
            forget: links that the checker does not look at, 1 to 7.
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
        self.model.dof_damping[:] = 0.0  # the plan of a motion leaves it out
        self.data = mujoco.MjData(self.model)
        arm = shapes.Shape(self.model)
        self.reach = (
            arm.distal_radii
        )  # Day 11's: m, from each joint to the farthest behind it
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
        """Return whether the straight edge from a to b keeps `MARGIN`, where looked at.

        An edge is looked at once: who plans again with more samples asks it again.
        """
        key = a.tobytes() + b.tobytes()
        if key not in self._known:
            self._known[key] = self._looked_along(a, b - a)
        return self._known[key]

    def _looked_along(self, q: Array, dq: Array) -> bool:
        """Look at q + s dq where Day 11's `conservative_advance` says, from 0 to 1."""
        speed = np.abs(dq) @ self.reach  # no point moves further, m per s
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
        """Return the least distance of these pairs of shapes at q, m."""
        self.data.qpos[:] = q
        mujoco.mj_kinematics(self.model, self.data)  # fills geom_xpos and geom_xmat
        return min(
            mujoco.mj_geomDistance(self.model, self.data, a, b, FAR, None)
            for a, b in pairs
        )


def samples(model: mujoco.MjModel, n: int, seed: int) -> Array:
    """Return n configurations of the arm within its joints' ranges, (n, 7)."""
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
