"""A picture of the call that failed, drawn without a window; see `failing`."""

import textwrap

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from labkit.figures import overlay, portrait
from labkit.figures.client import draw
from labkit.figures.scene import Box, Ghost, Scene
from labkit.inspector.failing import COLOURS, RADII, YOURS, Drawing, Thing
from robo47 import panda, se3
from robo47.checks import Array

SIZE = (1200, 800)
LARGE, SMALL = 24, 20  # pixels of letters
LETTERS = 105  # small ones in a line
REACH = 0.15 * np.vstack([np.eye(3), -np.eye(3)])  # metres around what is drawn


def picture_of(title: str, call: str, drawing: Drawing) -> Image.Image:
    """Return a picture of the call: the arm, what was given, both answers.

    Args:
        title: the task and its function.
        call: in a line, written below the title.
        drawing: what is drawn; the arm is at ready where it has no configuration.
    """
    q = portrait.with_fingers(panda.READY_Q if drawing.q is None else drawing.q)
    here = portrait.link_frames(q)
    corners = [portrait.corners(here)]
    ghosts: tuple[Ghost, ...] = ()
    for arm in drawing.others:
        there = portrait.link_frames(portrait.with_fingers(arm.value))
        ghosts += portrait.ghosts(here, there, wrong=arm.whose == YOURS)
        corners += [portrait.corners(there)]
    frames = {one.label: one.value for one in drawing.frames}
    points = {one.label: one.value for one in drawing.points}
    places = [*(T[None, :3, 3] for T in frames.values()), *points.values()]
    corners += [(p[:, None] + REACH).reshape(-1, 3) for p in places]
    camera = portrait.FROM_THE_LEFT.stepped_back(np.vstack(corners), SIZE)
    boxes = tuple(_box(one, p) for one in drawing.points for p in one.value)
    seen = Image.fromarray(draw(Scene(q, SIZE, camera, ghosts, boxes=boxes)))
    picture = overlay.draw_frames(seen, camera, frames, points)
    pen = ImageDraw.Draw(picture)
    pen.text((36, 24), title, overlay.INK, ImageFont.load_default(LARGE))
    text = "\n".join(textwrap.wrap(call, LETTERS))
    pen.text((36, 62), text, overlay.LEADER, ImageFont.load_default(SMALL))
    return picture


def _box(one: Thing, point: Array) -> Box:
    """Return a point as a small cube in the colour of whose it is."""
    r, g, b = (value / 255 for value in COLOURS[one.whose])
    side = RADII[one.whose]
    return Box(se3.make_T(np.eye(3), point), (side, side, side), (r, g, b, 1.0))
