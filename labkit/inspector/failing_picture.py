"""A picture of the call that failed, drawn without a window; see `failing`."""

import re
import textwrap
from dataclasses import replace

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from labkit.figures import client, overlay, portrait
from labkit.figures.scene import NOBODY, Camera, Ghost, Scene
from labkit.inspector.failing import COLOURS, MEANING, RADII, YOURS, Drawing
from robo47.checks import Array

SIZE = (1200, 800)
LARGE, SMALL = 24, 20  # pixels of letters
LETTERS, LINES = 105, 2  # small ones in a line, and lines
RIM, NEAR = 8, 4.2  # pixels around an axis; radii from the camera
AXIS = 0.2  # of the radius
LARGER = 800  # pixels of a point by a metre of its radius
REACH = 0.15 * np.vstack([np.eye(3), -np.eye(3)])  # metres around what is drawn


def picture_of(title: str, call: str, drawing: Drawing) -> Image.Image:
    """Return a picture of the call: the arm, what was given, both answers.

    Args:
        title: the task and its function.
        call: in a line, written below the title.
        drawing: what is drawn; without a configuration there is no arm.
    """
    scene, corners = _with_arm(drawing) if drawing.arms else _without(drawing)
    camera = scene.camera.stepped_back(np.vstack(corners), SIZE)
    seen = client.draw(replace(scene, camera=camera))
    layer = overlay.Layer((SIZE[0] * overlay.SMOOTH, SIZE[1] * overlay.SMOOTH))
    _draw(layer, camera, drawing)
    picture = layer.over(Image.fromarray(seen))
    pen = ImageDraw.Draw(picture)
    pen.text((36, 24), title, overlay.INK, ImageFont.load_default(LARGE))
    if len(call) > LINES * LETTERS:  # what it returned is at its end
        call = re.sub(r"\(.*\)", "(...)", call)
    text = "\n".join(textwrap.wrap(call, LETTERS))
    pen.text((36, 62), text, overlay.INK, ImageFont.load_default(SMALL))
    return picture


def _with_arm(drawing: Drawing) -> tuple[Scene, list[Array]]:
    """Return the arm with the others, and points that all is between."""
    first = drawing.arms[0].value if drawing.q is None else drawing.q
    q = portrait.with_fingers(first)
    here = portrait.link_frames(q)
    corners = [portrait.corners(here), *_around(drawing)]
    ghosts: tuple[Ghost, ...] = ()
    for arm in drawing.others:
        there = portrait.link_frames(portrait.with_fingers(arm.value))
        ghosts += portrait.ghosts(here, there, wrong=arm.whose == YOURS)
        corners += [portrait.corners(there)]
    return Scene(q, SIZE, portrait.FROM_THE_LEFT, ghosts), corners


def _without(drawing: Drawing) -> tuple[Scene, list[Array]]:
    """Return the room alone, near to what is drawn, and points that it is between."""
    middle, radius = drawing.ball
    x, y, z = map(float, middle)
    near = replace(portrait.FROM_THE_LEFT, lookat=(x, y, z), distance=NEAR * radius)
    return Scene(np.zeros(0), SIZE, near, robot=NOBODY), _around(drawing)


def _around(drawing: Drawing) -> list[Array]:
    """Return points around each frame and point."""
    places = [one.value[None, :3, 3] for one in drawing.frames]
    places += [one.value for one in drawing.points]
    return [(some[:, None] + REACH).reshape(-1, 3) for some in places]


def _draw(layer: overlay.Layer, camera: Camera, drawing: Drawing) -> None:
    """Draw frames, each with a rim in the colour of whose it is, names and a legend."""
    seen = {}
    size = overlay.AXIS if drawing.arms else max(overlay.AXIS, AXIS * drawing.ball[1])
    for one in drawing.frames:
        tips = one.value[:3, 3] + size * one.value[:3, :3].T
        ends = camera.project(np.vstack([one.value[:3, 3], tips]), layer.size)
        layer.triad(ends, COLOURS[one.whose], RIM)
        layer.letters(ends)
        # The name leads to the tip of x: the origins may be the same.
        seen[one.label] = ends[1:]
    for one in sorted(drawing.points, key=lambda one: -RADII[one.whose]):
        seen[one.label] = camera.project(one.value, layer.size)
        for x, y, _ in seen[one.label]:
            layer.dot((x, y), COLOURS[one.whose], LARGER * RADII[one.whose])
    if seen:
        layer.labels(seen)
    if drawing.frames:
        layer.legend()
    _legend(layer, drawing)


def _legend(layer: overlay.Layer, drawing: Drawing) -> None:
    """Say what the colours mean, at the lower right."""
    width, height = layer.size
    x, y = width - layer.text_height, height - 1.3 * layer.text_height
    for whose in reversed(dict.fromkeys(one.whose for one in drawing.all)):
        layer.text((x, y), MEANING[whose], "rm")
        x -= layer.font.getlength(MEANING[whose]) + 0.6 * layer.text_height
        layer.dot((x, y), COLOURS[whose], 9)
        x -= layer.text_height
