"""The capstone of Week 2: the arm sees a cube, weighs it and carries it round a wall.

What `make capstone` and `make proof` ask of it stands in `robo47.attempt`. The arm
does not know where the cube is or what it weighs: the camera sees it (Day 10), the
joint moves go around table and wall (Days 11 and 12), the motors weigh it (Day 8), its
weight limits the speed of the carry (Day 7), and an observer watches it (Day 9).

`attempt` is given the functions to do it with, one per name in `USES`: the library's
(`library()`), a student's, or a mixture.

Units: metres, radians, seconds, kilograms, N m; poses `T_world_x` are (4, 4).
"""

from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from robo47 import (
    camera,
    capstone,
    distance,
    estimation,
    identification,
    planning,
    scenes,
)
from robo47.capstone.phases import CUBE_XY, GOAL_XY, YAW
from robo47.checks import Array
from robo47.delivery import result, scene
from robo47.delivery.phases import PHASES, Delivery, Options
from robo47.delivery.result import Result
from robo47.delivery.summary import HEAD as HEAD
from robo47.delivery.summary import film as film
from robo47.delivery.summary import row as row
from robo47.delivery.summary import summary as summary

NAME = "the delivery"
THING = "cube"
GOAL = "delivered: seen, weighed and put down within 10 mm, nothing touched"
MORAL = "Delivered is no proof: look at the grams, the clearance and the residual."
MASS = 0.15  # kg: at Week 1's speed it slips out of the hand
PUSH = 10.0  # N

# The functions that `attempt` calls besides Week 1's, by the day that teaches them.
MODULES = {
    8: identification,
    9: estimation,
    10: camera,
    11: distance,
    12: planning,
}
NEW = {
    8: ("identify_payload",),
    9: ("kinetic_energy_gradient", "momentum_observer_step", "contact_link"),
    10: ("camera_matrix", "back_project", "icp_step"),
    11: ("capsule_box_distance", "distal_radii", "conservative_advance"),
    12: ("rrt_connect", "shortcut"),
}
USES = {**capstone.USES, **NEW}


def library() -> SimpleNamespace:
    """Return the library's functions under the names that `attempt` calls."""
    fns = capstone.library()
    for day, names in NEW.items():
        for name in names:
            setattr(fns, name, getattr(MODULES[day], name))
    return fns


def deliver(
    fns: Any,
    cube_xy: ArrayLike,
    goal_xy: ArrayLike,
    yaw: float,
    options: Options | None = None,
) -> Result:
    """Deliver a cube whose pose and mass are not given to the arm.

    Args:
        fns: has an attribute for every name in `USES`.
        cube_xy, goal_xy: where the cube stands, and is to stand, metres, (2,).
        yaw: its rotation about z at the start, radians.
        options: changes of the usual attempt.

    Raises:
        ValueError: a wrong shape or number, or a place that is not on the table.
        Robo47Error: no cube is seen, or there is no way.
    """
    options = options or Options()
    goal_xy = scenes.on_table(goal_xy, "goal_xy")
    model = scene.table_with_wall(
        cube_xy, yaw, options.mass, friction=options.friction, wall=options.wall
    )
    task = Delivery(fns, model, goal_xy, options)
    for phase in PHASES:
        task.run(phase)
    return result.of(task)


def attempt(fns: Any, seed: int | None = None, **options: Any) -> Result:
    """Deliver the cube of `make capstone`, then again with a push; or a random one.

    Args:
        fns: as for `deliver`.
        seed: of the random task; None is always the same one.
        options: fields of `Options`.
    """
    if seed is not None:
        cube_xy, goal_xy, yaw, mass = random_task(seed)
        changed = Options(**{"mass": mass, **options})
        return deliver(fns, cube_xy, goal_xy, yaw, changed)
    found = deliver(fns, CUBE_XY, GOAL_XY, YAW, Options(**{"mass": MASS, **options}))
    if options:
        return found
    pushed = deliver(fns, CUBE_XY, GOAL_XY, YAW, Options(mass=MASS, push=PUSH))
    return found._replace(
        pushed=True, detection_ms=pushed.detection_ms, contact_link=pushed.link
    )


def random_task(seed: int) -> tuple[Array, Array, float, float]:
    """Return a random cube_xy, goal_xy, yaw and mass, one on each side of the wall.

    Args:
        seed: the same seed gives the same task.
    """
    rng = np.random.default_rng(seed)
    cube = rng.uniform((0.42, 0.16), (0.60, 0.30))
    goal = rng.uniform((0.42, -0.30), (0.60, -0.16))
    yaw = float(rng.uniform(-np.pi / 2, np.pi / 2))
    return cube, goal, yaw, float(rng.uniform(0.05, 0.15))


def ablations(fns: Any) -> dict[str, tuple[Any, dict[str, Any]]]:
    """Return what `attempt` is to be given to show what a mistake does, by name.

    Args:
        fns: right functions, as `library` returns them.

    Returns:
        {name: (functions, options)}; the first is right.
    """
    light = 0.08
    changed: dict[str, dict[str, Any]] = {
        "right": {"mass": MASS},
        "right, 80 g": {"mass": light},
        "told where the cube is": {"mass": light, "known_pose": True},
        "depths with 1 mm of noise": {"mass": light, "noise": 0.001},
        "seen 10 mm beside": {"mass": light, "offset": 0.01},
        "straight, no plan": {"mass": light, "planned": False},
        "planned without the hand": {"mass": light, "hand": False},
        "weighed for 0.4 s": {"mass": light, "weigh": 0.4},
        "not weighed": {"mass": light, "weigh": 0.0},
        "150 g, as fast as 80 g": {"mass": MASS, "speed": 0.6},
        "pushed by 10 N": {"mass": light, "push": PUSH},
        "slippery, friction 0.4": {"mass": light, "friction": 0.4},
    }
    return {name: (fns, options) for name, options in changed.items()}
