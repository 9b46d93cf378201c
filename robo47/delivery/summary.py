"""The summary and the film of a delivery.

Units: metres and seconds, in sentences millimetres, grams and milliseconds.
"""

from robo47 import depth_camera
from robo47.attempt import Block, Film, Summary, film_of
from robo47.capstone.phases import CUBE_XY, YAW
from robo47.capstone.summary import TABLE, cube_block, phase_lines
from robo47.checks import Array
from robo47.delivery import scene
from robo47.delivery.contact_monitor import THRESHOLD
from robo47.delivery.result import Result

HEAD = f"""
{"":26}{"seen":>7}{"weighed":>9}{"speed":>7}{"clear":>8}{"felt":>7}{"place":>8}
{"":26}{"mm":>7}{"g":>9}{"of max":>7}{"mm":>8}{"N m":>7}{"mm":>8}"""
# beginnings of the phases that are pictured
MOMENTS = ("close", "weigh", "put down", "leave")
WALL = (0.45, 0.55, 0.70, 1.0)
EYE = (0.15, 0.15, 0.18, 1.0)


def row(name: str, result: Result) -> str:
    """Return one line of the table; the place only where it went home."""
    line = f"{name:26}{result.seen_mm:7.1f}{result.grams:z9.1f}{result.speed:7.1f}"
    line += f"{result.clearance_mm:8.1f}{result.residual:7.2f}"
    return line + ("   stops" if result.stopped else f"{result.place_mm:8.1f}")


def summary(result: Result) -> Summary:
    """Return the summary of a result."""
    after = [f"the planner asked for {result.queries:,} distances"]
    if result.stopped:
        after.append(f"it stopped: {result.stopped}")
    if result.pushed:
        felt = f"link {result.contact_link} feels it after {result.detection_ms:.0f} ms"
        felt = felt if result.detection_ms > 0.0 else "nothing is felt"
        after.append(f"pushed by 10 N in a second carry: {felt}")
    came = "The arm locates a cube at an unknown place, weighs it and puts it down"
    return Summary(
        before=phase_lines(result.phases, result.seconds),
        after=after,
        number=f"{result.grams:.1f} g",
        of="the mass of the cube, measured by the arm's motors",
        came=f"{came} behind a wall, {result.place_mm:.1f} mm from its target."
        if not result.stopped
        else f"The arm stops: {result.stopped}.",
        way=f"It keeps {result.clearance_mm:.0f} mm from the wall and the table. The"
        f" weight of the cube limits its speed to {result.speed:.1f} of the maximum.",
        figures=figures(result),
    )


def figures(result: Result) -> list[tuple[str, str, str]]:
    """Return the measured quantities: (name, value with its unit, limit)."""
    known = 1e3 * result.mass
    found = [
        (
            "error of the cube's estimated position",
            f"{result.seen_mm:.1f} mm",
            "under 3 mm",
        ),
        ("estimated mass", f"{result.grams:z.1f} g", f"{known:.0f} ± 1 g"),
        (
            "clearance of the path that was driven",
            f"{result.clearance_mm:.1f} mm",
            "over 0 mm",
        ),
        ("speed of the carry, as a fraction of the limits", f"{result.speed:.1f}", ""),
        (
            "external torque estimated in the carry",
            f"{result.residual:.2f} N m",
            f"under {THRESHOLD} N m",
        ),
    ]
    if not result.stopped:
        place = f"{result.place_mm:.1f} mm"
        found.append(("error of the final position", place, "under 10 mm"))
    if result.pushed:
        after = "a push of 10 N in a second carry, detected after"
        felt = result.detection_ms > 0.0
        value = f"{result.detection_ms:.0f} ms" if felt else "not detected"
        found.append((after, value, "detected"))
    return found


def film(result: Result) -> Film:
    """Return the film of a delivery of the cube of `make capstone`."""
    return film_of(
        result,
        moments=MOMENTS,
        blocks=_blocks,
        model=lambda: scene.table_with_wall(CUBE_XY, YAW, result.mass, meshes=True),
    )


def _blocks(qpos: Array) -> list[Block]:
    """Return the table, the wall, the eye and the cube in a configuration, (16,)."""
    still = zip(scene.boxes(), (TABLE, WALL), strict=True)
    return [
        *[Block(T, tuple(half), colour) for (T, half), colour in still],
        Block(depth_camera.look_at(scene.EYE_AT, scene.EYE_TO), scene.EYE_HALF, EYE),
        cube_block(qpos),
    ]
