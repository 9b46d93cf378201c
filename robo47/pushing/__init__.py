"""The capstone of Week 3: the arm goes around a puck and pushes it home, twice.

`robo47.attempt` describes the interface for `make capstone` and `make proof`. A
diffusion policy learns from demonstrations in a plane (Days 15 to 17) and moves a
sphere in the Panda's hand. A camera, the eye, sees the puck through a glass tray (Day
19). The policy draws plans at random, which determines the side on which the sphere
goes around the puck (Day 17). The functions of Day 21 connect these plans with the arm.
After three seconds the simulation moves the puck aside, as a person could do.

`attempt` receives the functions that it calls, one per name in `USES`: the library's
(`library()`), a student's, or a mixture.

Units: metres, radians, seconds, kilograms, N m; positions in the plane are relative to
home.
"""

from collections.abc import Callable
from functools import lru_cache
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from robo47 import (
    capstone,
    checks,
    chunking,
    cloning,
    deploy,
    diffusion,
    pixels,
    simulate,
)
from robo47.checks import Array
from robo47.panda import READY_Q
from robo47.pushing import guard, result, scene, task
from robo47.pushing.arm import PushingArm
from robo47.pushing.guard import guard_scores as guard_scores
from robo47.pushing.league import league as league
from robo47.pushing.learning import policy as policy
from robo47.pushing.result import Result
from robo47.pushing.summary import HEAD as HEAD
from robo47.pushing.summary import film as film
from robo47.pushing.summary import row as row
from robo47.pushing.summary import summary as summary
from robo47.pushing.task import PUCK, Options, Push

NAME = "the push"
THING = "puck"
GOAL = "at home within 10 mm, although moved once"
MORAL = (
    "Each row has the worst numbers of three pucks. A puck at home proves little:\n"
    "compare the error of the camera (seen), the lag, and the guard's score (new)."
)
PUCKS = 3  # of each ablation
NEAREST, FARTHEST = 0.14, 0.17  # m from home, of a random puck
ASIDE = (0.25, 0.25)  # m, a puck that is out of the way
LAG_SECONDS = 1.0  # s, until a spring trails its set point steadily

# The functions that `attempt` calls, by the day that teaches them.
OF_WEEK_1 = {
    1: ("make_T", "link_T", "joint_T"),
    2: ("joint_screws", "fk_space"),
    3: ("space_jacobian", "site_jacobian", "pose_error", "solve_ik", "manipulability"),
    4: ("link_inertias", "mass_matrix", "bias_torque"),
    5: ("pd_gains", "computed_torque", "pd_torque", "saturate"),
    6: (
        "task_inertia", "bias_acceleration", "osc_torque", "nullspace_torque",
        "impedance_wrench", "critical_damping", "impedance_torque",
    ),
    7: ("quintic_duration", "joint_trajectory", "combine_bodies"),
}  # fmt: skip
MODULES = {
    15: cloning,
    16: chunking,
    17: diffusion,
    19: pixels,
    21: deploy,
}
NEW = {
    15: (
        "fit_scaler", "normalise", "denormalise", "mlp", "mse", "adam_step",
        "nearest_distance",
    ),
    16: ("action_chunks", "backprop"),
    17: ("cosine_schedule", "add_noise", "timesteps", "ddim_step", "ema"),
    19: ("gaussian_kernel", "conv2d", "spatial_softmax"),
    21: (
        "clamp_speed", "keep_inside", "plan_entry", "push_ahead", "conformal_limit",
        "alarm_at",
    ),
}  # fmt: skip
USES = {**OF_WEEK_1, **NEW}
LEAGUE = {16: ("masked_l1",), 21: ("compare_all",)}  # the league calls these as well


def library() -> SimpleNamespace:
    """Return the library's functions under the names that `attempt` calls."""
    fns = capstone.library()
    for day, names in [*NEW.items(), *LEAGUE.items()]:
        for name in names:
            setattr(fns, name, getattr(MODULES[day], name))
    return fns


def attempt(
    fns: Any, seed: int | None = None, pucks: int = 1, **options: Any
) -> Result:
    """Push the puck of `make capstone` home, or a random one.

    Args:
        fns: has an attribute for every name in `USES`.
        seed: of the random task and of its draws; None is always the same one.
        pucks: with more than one, those of the seeds 1, 2, ... follow, and the result
            has the worst number of all in each column.
        options: fields of `Options`.

    Raises:
        Robo47Error: solve_ik does not reach home.
    """
    if pucks > 1:
        seeds = [seed, *range(1, pucks)]
        return result.worst([attempt(fns, one, **options) for one in seeds])
    if seed is None:
        return push_home(fns, PUCK, **options)
    return push_home(fns, random_puck(seed), **{"draw": seed, **options})


def push_home(fns: Any, puck: ArrayLike, **options: Any) -> Result:
    """Push a puck home from a position in the plane, metres, (2,)."""
    done = Push(fns, np.array(puck), _limit(fns), Options(**options))
    done.approach()
    done.push()
    return result.of(done)


def random_puck(seed: int) -> Array:
    """Return the position of a random puck in the plane, metres, (2,).

    Args:
        seed: the same seed gives the same position.
    """
    rng = np.random.default_rng(seed)
    angle, far = rng.uniform(-np.pi, np.pi), rng.uniform(NEAREST, FARTHEST)
    return far * np.array([np.cos(angle), np.sin(angle)])


def lag(fns: Any, direction: ArrayLike, speed: float, forward: bool = True) -> float:
    """Return how far the sphere trails its set point in the simulation, metres.

    The set point moves at a constant speed for one second, and its distance ahead of
    the sphere is measured when it reaches home.

    Args:
        fns: has the functions of Week 1 in `USES`.
        direction: a vector in the plane, (2,); its norm has no effect.
        speed: m/s.
        forward: True: the spring's damper is given the set point's velocity.
    """
    along = checks.unit(checks.array(direction, "direction", (2,)), "direction")
    v = speed * along
    model = scene.tray(ASIDE)
    arm = PushingArm(fns, model, forward)
    q, _ = arm.waypoint(arm.pose_at(-LAG_SECONDS * v), READY_Q)
    law = arm.follow(lambda t: ((t - LAG_SECONDS) * v, v), q)

    def controller(t: float, q: Array, qd: Array) -> Array:
        return np.asarray(fns.saturate(law(t, q, qd), arm.tau_max))

    world = model, simulate.start(model, q)
    run = simulate.run(*world, controller, LAG_SECONDS, rate=task.RATE)
    return float(-arm.sphere(run.q[-1]) @ along)


def inertia(fns: Any, direction: ArrayLike) -> float:
    """Return the task-space inertia of the sphere at home in a direction, kg.

    Args:
        fns: has the functions of Week 1 in `USES`.
        direction: a vector in the plane, (2,); its norm has no effect.
    """
    along = checks.unit(checks.array(direction, "direction", (2,)), "direction")
    arm = PushingArm(fns, scene.tray(ASIDE))
    q, _ = arm.waypoint(arm.pose_at(np.zeros(2)), READY_Q)
    now = arm.at(q, np.zeros(7))
    J = fns.site_jacobian(now.J_space, now.T[:3, 3])
    Lambda = np.asarray(fns.task_inertia(J, now.M))[3:5, 3:5]
    return float(along @ Lambda @ along)


def ablations(fns: Any) -> dict[str, tuple[Any, dict[str, Any]]]:
    """Return what `attempt` is to be given to show what a mistake does, by name.

    Args:
        fns: right functions, as `library` returns them.

    Returns:
        {name: (functions, options)}; the first is right.
    """

    def no_noise(x: Array, eps: Array, abar: float, prev: float) -> Array:
        clean = fns.ddim_step(x, eps, abar, 1.0)
        return np.asarray(np.sqrt(prev) * clean)

    changed: dict[str, dict[str, Any]] = {
        "right": {},
        "another draw": {"draw": 101},
        "puck's position given": {"known_puck": True},
        "camera 10 mm off": {"offset": 0.01},
        "camera 30 mm off": {"offset": 0.03},
        "no blur in the camera": {"blur": False},
        "one denoising step": {"denoising": 1},
        "whole plans of 8": {"executed": 8},
        "plans 0.3 s late": {"late": 3},
        "late, not predicted": {"late": 3, "ahead": False},
        "no feedforward velocity": {"forward": False},
        "a puck of 400 g": {"mass": 0.4},
        "damping of 2 N s/m": {"damping": 2.0},
    }
    forgets = SimpleNamespace(**{**vars(fns), "ddim_step": no_noise})
    found = {name: (fns, options) for name, options in changed.items()}
    found["noise not put back"] = forgets, {}
    return {
        name: (some, {"pucks": PUCKS, **options})
        for name, (some, options) in found.items()
    }


def _limit(fns: Any) -> float:
    """Return the limit of the guard; it is computed once for the functions."""
    names = [name for some in [*NEW.values(), *LEAGUE.values()] for name in some]
    return _kept_limit(tuple(names), *(getattr(fns, name) for name in names))


@lru_cache(8)
def _kept_limit(names: tuple[str, ...], *functions: Callable[..., Any]) -> float:
    return guard.limit(SimpleNamespace(**dict(zip(names, functions, strict=True))))
