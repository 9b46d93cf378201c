"""The summary and the film of a pick.

Units: metres and seconds, in sentences millimetres and milliradians.
"""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from robo47 import scenes, se3
from robo47.attempt import Block, Film, Summary, film_of
from robo47.capstone.phases import CUBE_XY, YAW, Result
from robo47.checks import Array

HEAD = f"""
{"":26}{"place":>8}{"joints":>9}{"line":>8}{"time":>7}{"torque":>8}{"speed":>7}
{"":26}{"mm":>8}{"mrad":>9}{"mm":>8}{"s":>7}{"of max":>8}{"of max":>7}"""
MOMENTS = ("close", "carry", "open")  # phases whose beginnings a picture shows
TABLE = (0.80, 0.74, 0.66, 1.0)
CUBE = (0.85, 0.35, 0.10, 1.0)
ARM = 9  # numbers of qpos: seven joints and two fingers; the cube's seven follow


def row(name: str, result: Result) -> str:
    """Return one line of the table."""
    return (
        f"{name:26}{result.place_mm:8.1f}{result.joint_mrad:9.2f}{result.line_mm:8.1f}"
        f"{result.seconds:7.1f}{result.torque:8.2f}{result.speed:7.2f}"
    )


def summary(result: Result) -> Summary:
    """Return the summary of a result."""
    lift = [
        f"lifted {1000 * result.lift:.0f} mm; this grip can lift, as predicted,",
        f"  {result.heaviest:.3f} kg; the cube has {scenes.CUBE_MASS:.3f} kg",
    ]
    return Summary(
        before=phase_lines(result.phases, result.seconds),
        after=lift,
        number=f"{result.place_mm:.1f} mm",
        of="the distance of the cube from its target",
        came=f"The arm picks the cube up and puts it down {result.place_mm:.1f} mm from"
        " its target; the limit is 10 mm.",
        way=f"The largest error of a joint is {result.joint_mrad:.2f} mrad. The hand"
        f" is at most {result.line_mm:.1f} mm from its straight lines.",
    )


def phase_lines(phases: Sequence[tuple[str, float]], seconds: float) -> list[str]:
    """Return a line per phase: when it begins and how long it takes.

    Args:
        phases: (name, when it began in seconds), in order.
        seconds: when the last one ended.
    """
    width = max(9, *(len(name) for name, _ in phases))
    return [
        f"  {begins:5.2f} s  {name:{width}} {ends - begins:5.2f} s"
        for (name, begins), (_, ends) in pairwise([*phases, ("", seconds)])
    ]


def film(result: Result) -> Film:
    """Return the film of a pick of the cube of `make capstone`."""
    return film_of(
        result,
        moments=MOMENTS,
        blocks=_blocks,
        model=lambda: scenes.table_top(CUBE_XY, YAW, meshes=True),
    )


def _blocks(qpos: Array) -> list[Block]:
    """Return the table and the cube in a configuration, (16,)."""
    table = se3.make_T(np.eye(3), [*scenes.TABLE_CENTRE, scenes.TABLE_HEIGHT / 2])
    half = (*scenes.TABLE_HALF, scenes.TABLE_HEIGHT / 2)
    return [Block(table, half, TABLE), cube_block(qpos)]


def cube_block(qpos: Array) -> Block:
    """Return the cube in a configuration, (16,)."""
    cube = se3.make_T(se3.quat_to_R(qpos[ARM + 3 : ARM + 7]), qpos[ARM : ARM + 3])
    return Block(cube, (scenes.CUBE_HALF,) * 3, CUBE)
