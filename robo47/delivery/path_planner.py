"""Paths around the wall: joint moves whose every leg is checked before it is driven.

The planner is Days 11 and 12's: distances of all capsules at once are the library's,
since thousands are asked, everything else is `fns`'. Metres, radians.
"""

from typing import Any

import mujoco
import numpy as np

from robo47 import scenes, simulate
from robo47.checks import Array
from robo47.delivery import scene
from robo47.errors import Robo47Error
from robo47.shapes import Capsule, Shape, World, capsules_of

MARGIN = 0.008  # m, that a planned way keeps from everything
STEP = 0.6  # rad, the longest edge of a tree
SAMPLES = 400  # the planner gives up after these
CUTS = 60  # shortcuts that are tried
SEED = 12  # the seed of samples and shortcuts
LEAST = 1e-3  # share of an edge between two looks: at a touch the step is 0
LOOKS = 2000  # queries at one edge; more means that no progress is made
INSIDE = {  # the advice for an end of a path in collision
    "start": "The way before led into it: are conservative_advance (task 11.8) and"
    " rrt_connect (task 12.4) right?",
    "goal": "Is the cube where it was seen: are camera_matrix (task 10.1), back_project"
    " (task 10.3) and icp_step (task 10.9) right?",
}


class PathPlanner:
    """A planner for the arm among the table and the wall.

    Attributes:
        queries: the number of distance queries.
    """

    def __init__(
        self, fns: Any, model: mujoco.MjModel, *, wall: bool = True, hand: bool = True
    ):
        """Read the arm's shapes.

        Args:
            fns: has `distal_radii`, `conservative_advance`, `rrt_connect` and
                `shortcut`.
            model: the scene.
            wall: whether there is one.
            hand: False: the hand is forgotten.
        """
        self.fns = fns
        self.world = World.of(boxes=scene.boxes(wall))
        body = model.body("hand")
        T = fns.link_T(body.pos.copy(), body.quat.copy())  # T_link7_hand
        at = tuple(T[:3, :3] @ np.array(scenes.TCP) + T[:3, 3])
        cube = Capsule(7, at, at, np.sqrt(3.0) * scenes.CUBE_HALF)
        known = [one for one in capsules_of(model) if hand or one.link < 7]
        self.shape = Shape(model, [*known, cube] if hand else known)
        self.reach = fns.distal_radii(*self.shape.lengths)
        self.limits, _ = simulate.limits(model)
        self.rng = np.random.default_rng(SEED)
        self.queries = 0

    def edge_free(self, a: Array, b: Array) -> bool:
        """Return whether the straight path from a to b keeps its margin, (7,) each.

        Raises:
            Robo47Error: conservative_advance does not get on.
        """
        s = 0.0
        for _ in range(LOOKS):
            self.queries += 1
            free = float(self.shape.clearance(a + s * (b - a), self.world)) - MARGIN
            if free <= 0.0:
                return False
            if s >= 1.0:
                return True
            ahead = float(self.fns.conservative_advance(s, free, b - a, self.reach))
            s = min(1.0, max(ahead, s + LEAST))
        raise Robo47Error(
            f"after {LOOKS} looks conservative_advance (task 11.8) is at {s:.3g}"
        )

    def find(self, a: Array, b: Array) -> Array:
        """Return waypoints from a to b whose every segment is collision-free, (m, 7).

        Raises:
            Robo47Error: one of the ends is not free, or no way was found.
        """
        for name, q in (("start", a), ("goal", b)):
            apart = float(self.shape.clearance(q, self.world))
            if apart <= -MARGIN:
                raise Robo47Error(
                    f"no way: the {name} is {-1e3 * apart:.0f} mm inside table or wall."
                    f" {INSIDE[name]}"
                )
            if apart <= MARGIN:
                raise Robo47Error(
                    f"no way: the {name} is {1e3 * apart:.0f} mm from table or wall;"
                    f" {1e3 * MARGIN:.0f} mm are needed. Choose a place further away."
                )
        if self.edge_free(a, b):
            return np.array([a, b])
        low, high = self.limits.T
        samples = self.rng.uniform(low, high, (SAMPLES, 7))
        path = self.fns.rrt_connect(a, b, self, samples, STEP)
        if len(path) < 2:
            raise Robo47Error(
                f"no way: rrt_connect (task 12.4) found none with {SAMPLES} samples"
            )
        return self.fns.shortcut(path, self, self.rng.random((CUTS, 2)))
