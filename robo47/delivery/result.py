"""The result of a delivery.

Units: metres, radians, seconds, kilograms, N m; in names millimetres and grams.
"""

from typing import Any, NamedTuple

import numpy as np

from robo47.checks import Array
from robo47.delivery import scene
from robo47.delivery.phases import Delivery
from robo47.shapes import Shape, World, capsules_of

NEAREST = 5  # instants of the way at which `capsule_box_distance` has the last word


class Result(NamedTuple):
    """The result of a delivery."""

    place_mm: float  # distance of the cube's centre from its goal, at the end
    seen_mm: float  # distance of the perceived cube from the true one
    grams: float  # the measured mass
    mass: float  # the true mass, kg, which nobody was told
    speed: float  # speed while carrying, as a share of the joints' limits
    clearance_mm: float  # least, of the way that was driven
    residual: float  # largest torque that nobody commanded, of any joint, N m
    link: int  # the first link whose contact was detected; 0: none
    contact_link: int  # the same of a second run, in which somebody pushes
    detection_ms: float  # the delay between a push and its detection; nan without one
    stopped: str  # why it did not go on; "" where it did
    seconds: float  # the duration of the task in the simulation
    queries: int  # the number of distance queries of the planner
    phases: list[tuple[str, float]]  # (name, when it began in seconds), in order
    t: Array  # time of each control instant, seconds, (N,)
    qpos: Array  # everything's configuration then, (N, nq): for pictures and replays
    pushed: bool = False  # somebody pushed, in this run or in the second one

    @property
    def failed(self) -> bool:
        """The cube is not delivered, or an important number is off."""
        good = (
            not self.stopped
            and self.place_mm < 10.0
            and self.seen_mm < 3.0
            and abs(self.grams - 1e3 * self.mass) < 1.0
            and self.clearance_mm > 0.0
            and (self.detection_ms > 0.0 or not self.pushed)
        )
        return not good


def of(task: Delivery) -> Result:
    """Return the result of a task, as far as it went."""
    return Result(
        **task.log(),
        seen_mm=1e3 * float(np.linalg.norm((task.perceived - task.true_pose)[:3, 3])),
        grams=1e3 * task.measured_mass,
        mass=task.options.mass,
        speed=task.carry_speed,
        clearance_mm=1e3 * clearance(task),
        residual=task.monitor.worst,
        link=task.monitor.link,
        contact_link=task.monitor.link if task.options.push else 0,
        detection_ms=1e3 * (task.detected_at - task.pushed_at),
        stopped=task.stopped,
        queries=task.planner.queries,
        pushed=bool(task.options.push),
    )


def clearance(task: Delivery) -> float:
    """Return the smallest distance of the whole arm from table and wall, metres.

    Of every control instant of the joint moves, as they were driven. The library finds
    the nearest instants, `capsule_box_distance` of the functions says how near they
    are.
    """
    shape = Shape(task.model, capsules_of(task.model))
    world = World.of(boxes=scene.boxes(task.options.wall))
    q = np.concatenate(task.driven)
    apart = shape.distances(q, world).reshape(len(q), -1)
    nearest = np.argsort(apart.min(axis=1), kind="stable")[:NEAREST]
    return min(_nearest(task.fns, shape, world, q[i], apart[i]) for i in nearest)


def _nearest(fns: Any, shape: Shape, world: World, q: Array, apart: Array) -> float:
    """Return `capsule_box_distance` of the pair that is nearest at q, metres."""
    capsule, thing = divmod(int(np.argmin(apart)), len(world.boxes))
    a0, a1 = shape.ends(q)[capsule]
    box = world.boxes[thing], world.half[thing]
    return float(fns.capsule_box_distance(a0, a1, shape.radii[capsule], *box))
