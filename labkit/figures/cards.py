"""Small pictures of the days, which are recognised in a row of fourteen.

    lines = cards.line(points, cards.SKY)
    card(cards.arm(q, boxes=lines), "0.8 mm")    # 168 x 126 pixels, four in a row

Dark, so that they stand on a light page and on a dark one; few shapes, all of them
thick; one number or none, and no other letter.
"""

from collections.abc import Callable, Sequence
from itertools import pairwise

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike
from PIL import Image, ImageDraw

from labkit.figures import chart, client, fonts, portrait
from labkit.figures.portrait import link_frames, with_fingers
from labkit.figures.scene import Box, Camera, Ghost, Scene
from robo47 import se3
from robo47.errors import Robo47Error
from robo47.panda.files import panda_folder, remedy

TINY = (168, 126)  # pixels: four beside each other in a README, two on a phone
SIZE = (672, 504)  # pixels, as it is drawn
NUMBER = 104  # pixels of a number's letters, as it is drawn
PAPER, PALE = "#1b1f24", (240, 243, 246)
Paint = tuple[float, float, float, float]  # red, green, blue, opacity, 0 to 1
RED, GREEN, BLUE = (0.95, 0.26, 0.21, 1), (0.25, 0.8, 0.4, 1), (0.3, 0.5, 1, 1)
ORANGE, SKY, WOOD = (1, 0.6, 0.1, 1), (0.35, 0.75, 0.95, 1), (0.62, 0.5, 0.36, 1)
HEAD, WIDE, STEPS = 9.0, 4.0, 10  # an arrow's head: long, wide, and of so many pieces
WHOLE = Camera((0.18, 0.0, 0.42), 2.0)  # the arm at ready, from its right


def arm(
    q: ArrayLike,
    camera: Camera = WHOLE,
    boxes: Sequence[Box] = (),
    ghosts: tuple[Ghost, ...] = (),
) -> Image.Image:
    """Return the Panda in the dark room, at q (7,) or (9,), with boxes beside it."""
    scene = Scene(with_fingers(q), SIZE, camera, ghosts, boxes=tuple(boxes))
    return Image.fromarray(client.draw(scene))


def bare(
    q: ArrayLike, camera: Camera = WHOLE, boxes: Sequence[Box] = ()
) -> Image.Image:
    """Return the Panda without a hand in the dark room, at q (7,), with boxes."""
    folder = panda_folder()
    if folder is None:
        raise Robo47Error(f"there is no Panda with meshes here: {remedy()}")
    robot = str(folder / "panda_nohand.xml")
    scene = Scene(np.asarray(q), SIZE, camera, boxes=tuple(boxes), robot=robot)
    return Image.fromarray(client.draw(scene))


def elsewhere(q: ArrayLike, other: ArrayLike) -> tuple[Ghost, ...]:
    """Return the blue ghost of the arm at another configuration than q, (7,) both."""
    here, there = (link_frames(with_fingers(x)) for x in (q, other))
    return portrait.ghosts(here, there)


def rod(start: ArrayLike, end: ArrayLike, colour: Paint, thick: float = 0.008) -> Box:
    """Return a rod between two points, metres; `thick` is half its width."""
    a, b = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
    length = float(np.linalg.norm(b - a))
    z = (b - a) / max(length, 1e-12)
    x = np.cross(z, np.eye(3)[np.abs(z).argmin()])
    x /= np.linalg.norm(x)
    R = np.column_stack([x, np.cross(z, x), z])
    return Box(se3.make_T(R, (a + b) / 2), (thick, thick, length / 2 + thick), colour)


def line(points: ArrayLike, colour: Paint, thick: float = 0.008) -> list[Box]:
    """Return rods along points, (n, 3), metres."""
    pairs = pairwise(np.asarray(points, dtype=float))
    return [rod(a, b, colour, thick) for a, b in pairs]


def arrow(
    start: ArrayLike, end: ArrayLike, colour: Paint, thick: float = 0.012
) -> list[Box]:
    """Return an arrow whose head grows narrower in steps, in place of a cone."""
    a, b = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
    head = HEAD * thick * (b - a) / np.linalg.norm(b - a)
    shares = np.linspace(1.0, 0.0, STEPS + 1)
    tip = [
        rod(b - far * head, b - near * head, colour, WIDE * far * thick)
        for far, near in pairwise(shares)
    ]
    return [rod(a, b - head, colour, thick), *tip]


def triad(T: np.ndarray, length: float, thick: float = 0.01) -> list[Box]:
    """Return a frame's axes: x red, y green, z blue; T is (4, 4), metres."""
    ends = T[:3, 3] + length * T[:3, :3].T
    return [
        rod(T[:3, 3], end, colour, thick)
        for end, colour in zip(ends, (RED, GREEN, BLUE), strict=True)
    ]


def curves(draw: Callable[[Axes], None]) -> Image.Image:
    """Return what is drawn on dark axes without ticks: thick lines, and no words."""
    with matplotlib.rc_context({**chart.STYLE, "lines.linewidth": 9.0}):
        figure = Figure(figsize=(SIZE[0] / 100, SIZE[1] / 100), dpi=100)
        figure.set_facecolor(PAPER)
        axes = figure.subplots()
        axes.set_facecolor(PAPER)
        draw(axes)
        axes.set_axis_off()
        return chart.image_of(figure)


def card(picture: Image.Image, number: str = "") -> Image.Image:
    """Return a picture small, with a number in its lower left corner."""
    large = picture.resize(SIZE, Image.Resampling.LANCZOS)
    if number:
        font = fonts.font(NUMBER, "Bold")
        wide = font.getlength(number)
        font = fonts.font(min(NUMBER, NUMBER * 0.92 * SIZE[0] / wide), "Bold")
        ImageDraw.Draw(large).text(
            (24, SIZE[1] - 20), number, PALE, font, "ls",
            stroke_width=12, stroke_fill=PAPER,
        )  # fmt: skip
    return large.resize(TINY, Image.Resampling.LANCZOS)
