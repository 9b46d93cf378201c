"""The capstone of Week 1: the arm picks a cube up and puts it down.

What `make capstone` and `make proof` ask of it stands in `robo47.attempt`.

`pick` is given the functions to do it with, one per name in `USES`: the library's
(`library()`), a student's, or a mixture. To see what a mistake does
to the arm replaces one function. The robot's numbers are read from the model; every
formula is one of those functions. The phases stand in `robo47.capstone.phases`: joint
moves are computed torque, straight lines and grips a spring at the hand with the elbow
held back.

Units: metres, radians, seconds, N m; poses `T_world_x` are (4, 4).
"""

from collections.abc import Mapping
from types import SimpleNamespace
from typing import Any

import mujoco
import numpy as np
from numpy.typing import ArrayLike

from robo47 import (
    checks,
    control,
    dynamics,
    jacobian,
    lifting,
    scenes,
    screws,
    se3,
    simulate,
    task_space,
    trajectory,
)  # fmt: skip
from robo47.capstone.phases import CUBE_XY, GOAL_XY, PHASES, YAW, Result, Task
from robo47.capstone.summary import HEAD as HEAD
from robo47.capstone.summary import film as film
from robo47.capstone.summary import row as row
from robo47.capstone.summary import summary as summary
from robo47.checks import Array
from robo47.errors import Robo47Error

NAME = "the pick"
THING = "cube"
GOAL = "placed within 10 mm"
MORAL = "A placed cube is no proof: compare the errors of the joints and of the line."
RATE = 100.0  # Hz, of the controller; 50 is coarse, 500 the most
SPEED = 0.6  # share of the joints' limits of speed and acceleration

# The functions that `pick` calls, by the day that teaches them.
USES = {
    1: ("make_T", "inverse", "link_T", "joint_T"),
    2: ("joint_screws", "fk_space"),
    3: ("space_jacobian", "site_jacobian", "pose_error", "solve_ik", "manipulability"),
    4: ("link_inertias", "mass_matrix", "bias_torque", "gravity_torque"),
    5: ("pd_gains", "computed_torque", "pd_torque", "gravity_pd", "saturate"),
    6: (
        "task_inertia", "bias_acceleration", "osc_torque", "nullspace_torque",
        "impedance_wrench", "critical_damping", "impedance_torque",
        "set_point_for_force",
    ),
    7: (
        "grasp_pose", "quintic_scaling", "quintic_duration", "joint_trajectory",
        "interpolate_pose", "combine_bodies", "max_cube_mass",
    ),
}  # fmt: skip


def library() -> SimpleNamespace:
    """Return the library's functions under the names that `pick` calls."""
    fns = SimpleNamespace(make_T=se3.make_T, inverse=se3.inverse)
    fns.link_T = lambda pos, quat: se3.make_T(se3.quat_to_R(quat), pos)
    fns.joint_T = _joint_T
    modules = (screws, jacobian, dynamics, control, task_space, trajectory)
    for day, module in enumerate(modules, start=2):
        for name in USES[day]:
            setattr(fns, name, getattr(module, name))
    return fns


def with_own(own: Mapping[str, Any]) -> SimpleNamespace:
    """Return the library's functions of Days 1 to 6, and a lab's own of Day 7.

    Args:
        own: functions by name: a lab's globals(). While `max_cube_mass`, a side quest,
            is still to do, the library's is taken.
    """
    fns = library()
    for name in USES[7]:
        setattr(fns, name, own[name])
    try:
        fns.max_cube_mass(1.0, 1.0, 0.0)
    except NotImplementedError:
        fns.max_cube_mass = lifting.max_cube_mass
    return fns


def _joint_T(q: float) -> Array:
    """Return a rotation by q about z, (4, 4), unchecked: it is called 5,000 times."""
    T = np.eye(4)
    c = np.cos(q)
    s = np.sin(q)
    T[0, 0] = c
    T[0, 1] = -s
    T[1, 0] = s
    T[1, 1] = c
    return T


def pick(
    fns: Any,
    cube_xy: ArrayLike = CUBE_XY,
    goal_xy: ArrayLike = GOAL_XY,
    yaw: float = YAW,
    *,
    model: mujoco.MjModel | None = None,
    speed: float = SPEED,
    rate: float = RATE,
    watch: simulate.Watcher | None = None,
) -> Result:
    """Pick the cube up, put it down elsewhere, go home.

    Args:
        fns: has an attribute for every name in `USES`, taking one configuration.
        cube_xy, goal_xy: where the cube stands, and is to stand, metres, (2,).
        yaw: its rotation about z at the start, radians.
        model: a scene of `robo47.scenes.table_top` instead of the plain one; it
            must have been made with the same cube_xy and yaw.
        speed: of joint moves, as a fraction of the limits.
        rate: of the controller, Hz.
        watch: as in `simulate.run`: called after every control period.

    Returns:
        What came of it; a dropped cube is a result, not an error.

    Raises:
        ValueError: a wrong shape or number, or a place that is not on the table.
        Robo47Error: a function is missing, or the arm cannot reach a place.
    """
    missing = [n for names in USES.values() for n in names if not hasattr(fns, n)]
    if missing:
        raise Robo47Error(
            f"the capstone calls {', '.join(missing)}, which was not given to it."
            " Start from robo47.capstone.library() and replace what is yours."
        )
    goal_xy = scenes.on_table(goal_xy, "goal_xy")
    model = scenes.table_top(cube_xy, yaw) if model is None else model
    task = Task(fns, model, goal_xy, float(checks.positive(speed, "speed")), watch)
    for phase in PHASES:
        task.run(phase, rate)
    return task.result()


def attempt(fns: Any, seed: int | None = None, **options: Any) -> Result:
    """Pick the cube up from where `make capstone` has it, or a random one.

    Args:
        fns: as for `pick`.
        seed: of the random task; None is always the same one.
        options: further ones of `pick`.
    """
    where = () if seed is None else random_task(seed)
    return pick(fns, *where, **options)


def random_task(seed: int) -> tuple[Array, Array, float]:
    """Return a random cube_xy, goal_xy and yaw, all within reach.

    Args:
        seed: the same seed gives the same task.
    """
    rng = np.random.default_rng(seed)
    cube = rng.uniform([0.38, 0.05], [0.6, 0.3])
    goal = rng.uniform([0.4, -0.3], [0.6, -0.05])
    return cube, goal, float(rng.uniform(-np.pi / 2, np.pi / 2))


def ablations(fns: Any) -> dict[str, tuple[SimpleNamespace, dict[str, float]]]:
    """Return what `attempt` is to be given to show what a mistake does, by name.

    Args:
        fns: right functions, as `library` returns them.

    Returns:
        {name: (functions, options)}; the first is right.
    """

    def but(
        speed: float = SPEED, **changed: Any
    ) -> tuple[SimpleNamespace, dict[str, float]]:
        return SimpleNamespace(**{**vars(fns), **changed}), {"speed": speed}

    return {
        "right": but(),
        "gravity forgotten": but(
            bias_torque=lambda J, G, qd, g: fns.bias_torque(J, G, qd, 0.0 * g)
        ),
        "armature forgotten": but(
            mass_matrix=lambda J, G, armature: fns.mass_matrix(J, G, 0.0 * armature)
        ),
        "the hand forgotten": but(
            combine_bodies=lambda m1, c1, I1, *_: fns.combine_bodies(
                m1, c1, I1, 0.0, c1, 0.0 * I1
            )
        ),
        "at the speed limits": but(1.0),
        "at 1.5 of the speed limits": but(1.5),
    }
