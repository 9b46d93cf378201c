"""The summary and the film of a push. Metres and seconds, in sentences millimetres."""

from functools import lru_cache

import mujoco
import numpy as np

from robo47 import push, se3
from robo47.attempt import Block, Film, Summary, film_of
from robo47.capstone.summary import phase_lines
from robo47.checks import Array
from robo47.pushing import guard, scene, task
from robo47.pushing.result import LAG_MM, SEEN_MM, Result
from robo47.pushing.task import HOME_MM

HEAD = f"""
{"":24}{"place":>7}{"time":>7}{"side":>7}{"seen":>7}{"lag":>7}{"new":>7}{"home":>9}
{"":24}{"mm":>7}{"s":>7}{"":7}{"mm":>7}{"mm":>7}"""
MOMENTS = ("push", "moved aside", "push again", "home")
DRAWN = ("tray", "mark", "eye", "stick", "sphere", "puck")  # geoms besides the arm
KINDS = {
    mujoco.mjtGeom.mjGEOM_BOX: "box",
    mujoco.mjtGeom.mjGEOM_CYLINDER: "cylinder",
    mujoco.mjtGeom.mjGEOM_CAPSULE: "capsule",
    mujoco.mjtGeom.mjGEOM_SPHERE: "sphere",
}


def row(name: str, result: Result) -> str:
    """Return one line of the table; of several pucks it has the worst numbers."""
    side = "left" if result.left else "right"
    since = "-" if np.isnan(result.time) else f"{result.time:.1f}"
    home = "yes" if result.home else "stops" if result.stopped else "no"
    if result.homes:
        home = f"{sum(result.homes)} of {len(result.homes)}"
    return (
        f"{name:24}{result.place_mm:7.0f}{since:>7}{side:>7}{result.seen_mm:7.1f}"
        f"{result.lag_mm:7.1f}{result.new:7.2f}{home:>9}"
    )


def summary(result: Result) -> Summary:
    """Return the summary of a result."""
    after = []
    if result.moved:
        after.append(
            f"the simulation moved the puck by {1e3 * guard.MOVED:.0f} mm after"
            f" {guard.BEFORE * push.TICK:.0f} s"
        )
    after.append(f"the guard's limit is {result.limit:.2f}")
    if result.stopped:
        after.append(f"it stopped: {result.stopped}")
    side = "left" if result.left else "right"
    return Summary(
        before=phase_lines(result.phases, result.seconds),
        after=after,
        number=f"{result.place_mm:.0f} mm",
        of="the distance of the puck from home",
        came="The arm goes around a puck on a random side, pushes it home, and does so"
        " again after the simulation has moved the puck. The puck ends"
        f" {result.place_mm:.0f} mm from home; the limit is 10 mm."
        if not result.stopped
        else f"The arm stops: {result.stopped}.",
        way=f"It goes around the puck on the {side}. The camera is at most"
        f" {result.seen_mm:.1f} mm off, and the sphere at most {result.lag_mm:.1f} mm"
        " from its set point. The test had one simulator, one puck, and one"
        " displacement of the puck.",
        figures=figures(result),
    )


def figures(result: Result) -> list[tuple[str, str, str]]:
    """Return the measured quantities: (name, value with its unit, limit)."""
    found = [
        (
            "largest error of the camera",
            f"{result.seen_mm:.1f} mm",
            f"under {SEEN_MM:.0f} mm",
        ),
        (
            "largest distance of the sphere from its set point",
            f"{result.lag_mm:.1f} mm",
            f"under {LAG_MM:.0f} mm",
        ),
        (
            "largest distance of an observation from the demonstrations",
            f"{result.new:.2f} standard deviations",
            f"an alarm above {result.limit:.2f}, at three consecutive ticks",
        ),
    ]
    if not np.isnan(result.time):
        found.append(("time until the puck stays home", f"{result.time:.1f} s", ""))
    if not result.stopped:
        place = f"{result.place_mm:.0f} mm"
        found.append(("error of the final position", place, f"under {HOME_MM:.0f} mm"))
    return found


def film(result: Result) -> Film:
    """Return the film of a push."""
    begun = {name for name, _ in result.phases}
    return film_of(
        result,
        moments=tuple(name for name in MOMENTS if name in begun),
        blocks=_blocks,
        model=lambda: scene.tray(task.PUCK, meshes=True),
    )


@lru_cache(1)
def _world() -> tuple[mujoco.MjModel, mujoco.MjData]:
    model = scene.tray(task.PUCK)
    return model, mujoco.MjData(model)


def _blocks(qpos: Array) -> list[Block]:
    """Return everything beside the robot in a configuration, (11,)."""
    model, data = _world()
    data.qpos[:] = qpos
    mujoco.mj_kinematics(model, data)
    found = []
    for name in DRAWN:
        geom, at = model.geom(name), data.geom(name)
        T = se3.make_T(at.xmat.reshape(3, 3), at.xpos)
        kind = KINDS[mujoco.mjtGeom(int(geom.type[0]))]
        found.append(Block(T, tuple(geom.size), tuple(geom.rgba), kind))
    return found
