"""The capstone in pictures: the arm, the table and the cube, still or moving."""

from pathlib import Path

import numpy as np
from PIL import Image

from labkit.figures import client
from labkit.figures.clip import Caption, drawn, kind_of, save_clip
from labkit.figures.scene import Box, Camera, Scene
from robo47 import scenes, se3
from robo47.capstone.phases import Result
from robo47.checks import Array
from robo47.errors import Robo47Error
from robo47.paths import shown

CLIP_SIZE, PICTURE_SIZE, FRAMES = (420, 340), (1200, 800), 60
CAMERA = Camera(
    lookat=(0.33, 0.0, 0.36),
    distance=2.3,
    azimuth=np.radians(215.0),
    elevation=np.radians(-18.0),
)
ARM = 9  # numbers of qpos: seven joints and two fingers; the cube's seven follow
TABLE, CUBE = (0.80, 0.74, 0.66, 1.0), (0.85, 0.35, 0.10, 1.0)
MOMENTS = ("descend", "lift", "put down")  # whose ends a picture shows


def clip(result: Result, path: Path) -> str:
    """Write a film of a pick, .gif or .webp; return a line about it."""
    kind_of(path)
    rows = np.linspace(0, len(result.qpos) - 1, FRAMES).astype(int)
    shots = (
        (_scene(result.qpos[row], CLIP_SIZE, fast=True), phase(result, row))
        for row in rows
    )
    size = save_clip(drawn(shots), path, seconds=result.seconds)
    return f"{shown(path.absolute())}  {size / 1e3:.0f} kB"


def picture(result: Result, path: Path) -> str:
    """Write a PNG: the arm where it grasps, lifts and puts down; say so in a line."""
    whole = [client.draw(_scene(qpos, PICTURE_SIZE)) for qpos in moments(result)]
    quarter = PICTURE_SIZE[0] // 4
    middles = [part[:, quarter:-quarter] for part in whole]
    sheet = Image.fromarray(np.hstack(middles))
    try:
        sheet.save(path, "PNG")
    except (OSError, ValueError) as error:
        raise Robo47Error(f"cannot write {shown(path.absolute())}: {error}") from None
    return f"{shown(path.absolute())}  {sheet.width} x {sheet.height}"


def phase(result: Result, row: int) -> Caption:
    """Return what the arm does at an instant, and when that is."""
    t = float(result.t[row])
    name = [name for name, begins in result.phases if begins <= t][-1]
    return f"{name}, {t:.1f} s", None


def moments(result: Result) -> list[Array]:
    """Return everything's configuration at the ends of three phases, (16,) each."""
    names = [name for name, _ in result.phases]
    ends = [begins for _, begins in result.phases[1:]] + [result.seconds]
    times = [ends[names.index(name)] for name in MOMENTS]
    return [result.qpos[min(int(np.searchsorted(result.t, t)), len(result.t) - 1)]
            for t in times]  # fmt: skip


def _scene(qpos: Array, size: tuple[int, int], fast: bool = False) -> Scene:
    """Return one configuration of arm and cube, (16,)."""
    table = se3.make_T(np.eye(3), [*scenes.TABLE_CENTRE, scenes.TABLE_HEIGHT / 2])
    cube = se3.make_T(se3.quat_to_R(qpos[ARM + 3 : ARM + 7]), qpos[ARM : ARM + 3])
    boxes = (
        Box(table, (*scenes.TABLE_HALF, scenes.TABLE_HEIGHT / 2), TABLE),
        Box(cube, (scenes.CUBE_HALF,) * 3, CUBE),
    )
    return Scene(qpos[:ARM], size, CAMERA, fast=fast, boxes=boxes)
