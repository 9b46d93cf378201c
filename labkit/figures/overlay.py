"""Frames drawn over a picture: a red, green and blue triad each, and their names.

A triad is x red, y green, z blue. It is drawn where the camera sees its pose, in front
of everything: a link's frame sits inside the link, where nobody would see it.
"""

from collections.abc import Mapping

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from labkit.figures.scene import Camera
from robo47.checks import Array

X, Y, Z = (255, 94, 87), (70, 201, 98), (96, 156, 255)  # the axes' colours
INK, LEADER, HALO = (240, 243, 246), (152, 163, 174), (27, 31, 36)  # the room is dark
SMOOTH = 3  # lines are drawn this many times larger, then shrunk: no jagged edges
AXIS = 0.115  # metres
SECOND = 0.7  # the length of a second frame at the same place, as a fraction

Pixel = tuple[float, float]


def draw_frames(
    picture: Image.Image, camera: Camera, frames: Mapping[str, Array]
) -> Image.Image:
    """Return a camera's picture with frames, {name: (4, 4)}, named at its sides."""
    size = picture.width * SMOOTH, picture.height * SMOOTH
    layer = Layer(size)
    seen = {}
    for (name, T), length in zip(frames.items(), axis_lengths(frames), strict=True):
        origin = T[:3, 3]
        tips = T[:3, 3] + length * T[:3, :3].T
        seen[name] = camera.project(np.vstack([origin, tips]), size)
        layer.triad(seen[name])
    # Labels are drawn over the triads, since a leader ends at an origin.
    layer.labels(seen)
    first, *_, last = [*seen.values()] * 2
    for ends in (first, last):
        layer.letters(ends)
    layer.legend()
    return layer.over(picture)


def axis_lengths(frames: Mapping[str, Array]) -> list[float]:
    """Return how long to draw each frame's axes: shorter where another sits already."""
    origins = np.array([T[:3, 3] for T in frames.values()])
    return [
        AXIS * SECOND ** int((np.linalg.norm(origins[:i] - p, axis=1) < 1e-3).sum())
        for i, p in enumerate(origins)
    ]


def spread(wanted: Array, gap: float) -> Array:
    """Return increasing numbers at least `gap` apart, near increasing ones, (n,)."""
    # Without their gaps the numbers only have to increase: average where they do not,
    # by the max-min formula of isotonic regression.
    n = len(wanted)
    slack = wanted - gap * np.arange(n)
    level = [
        max(min(slack[j:k].mean() for k in range(i + 1, n + 1)) for j in range(i + 1))
        for i in range(n)
    ]
    return np.array(level) + gap * np.arange(n)


class Layer:
    """A transparent sheet to draw on, SMOOTH times as large as the picture."""

    def __init__(self, size: tuple[int, int]) -> None:
        self.size = size
        self.text_height = size[1] / 27
        self.sheet = Image.new("RGBA", size)
        self.pen = ImageDraw.Draw(self.sheet)
        self.font = ImageFont.load_default(self.text_height)
        self.unit = size[1] / 800  # one pixel of a picture 800 high

    def line(self, ends: list[Pixel], colour: tuple[int, ...], width: float) -> None:
        """Draw a line with round ends, `width` pixels of a picture 800 high."""
        self.pen.line(ends, colour, round(width * self.unit))
        for point in ends:
            self.dot(point, colour, width / 2)

    def dot(self, at: Pixel, colour: tuple[int, ...], radius: float) -> None:
        """Draw a disc."""
        r = radius * self.unit
        self.pen.ellipse((at[0] - r, at[1] - r, at[0] + r, at[1] + r), colour)

    def triad(self, ends: Array, rim: tuple[int, ...] = HALO, width: float = 4) -> None:
        """Draw a frame's axes, the nearest last.

        Args:
            ends: pixels of the origin and the three tips, and their depth, (4, 3).
            rim: the colour around the axes.
            width: of the rim, both sides together.
        """
        origin, *tips = ((float(x), float(y)) for x, y, _ in ends)
        axes = sorted(zip(ends[1:, 2], tips, (X, Y, Z), strict=True), reverse=True)
        for _, tip, colour in axes:
            self.arrow(origin, tip, rim, width)
            self.arrow(origin, tip, colour, 0)
        self.dot(origin, INK, 4.5)

    def letters(self, ends: Array) -> None:
        """Write x, y and z at a frame's tips: red and green are alike to many eyes."""
        for name, tip in zip("xyz", ends[1:, :2], strict=True):
            away = tip - ends[0, :2]
            away = away / max(float(np.linalg.norm(away)), 1e-9)
            x, y = tip + 0.6 * self.text_height * away
            self.text((float(x), float(y)), name, "mm")

    def arrow(
        self, start: Pixel, tip: Pixel, colour: tuple[int, ...], more: float
    ) -> None:
        """Draw an arrow; `more` widens it, for a halo."""
        a, b = np.array(start), np.array(tip)
        length = float(np.linalg.norm(b - a))
        along = (b - a) / max(length, 1e-9)
        across = np.array([-along[1], along[0]])
        head = min(15 * self.unit, length)
        neck = b - head * along
        self.line([start, (neck[0], neck[1])], colour, 5 + more)
        rim = more / 2 * self.unit
        half = 0.45 * head + rim
        back = neck - rim * along
        front = b + rim * along
        corners = [front, back + half * across, back - half * across]
        self.pen.polygon([(x, y) for x, y in corners], colour)

    def labels(self, seen: Mapping[str, Array]) -> None:
        """Name frames, each at the nearer side of all of them, level with its origin.

        Names that would overlap move apart, in the order of their frames.

        Args:
            seen: {name: pixels of the origin and the tips, and their depth, (4, 3)}.
        """
        x = {name: float(ends[0, 0]) for name, ends in seen.items()}
        low = min(x.values())
        high = max(x.values())
        margin = 0.14 * self.size[0]
        left = [name for name in seen if x[name] < (low + high) / 2]
        right = [name for name in seen if name not in left]
        for names in (left, right):
            names.sort(key=lambda name: seen[name][0, 1])
            wanted = np.array([float(seen[name][0, 1]) for name in names])
            apart = spread(wanted, 1.5 * self.text_height)
            for name, origin, y in zip(names, wanted, apart, strict=True):
                # The name, and its distance to both sides.
                room = self.font.getlength(name) + self.text_height
                beside = max(low - margin, room)
                if names is right:
                    beside = min(high + margin, self.size[0] - room)
                self.label(name, (beside, float(y)), (x[name], origin))

    def label(self, name: str, at: Pixel, origin: Pixel) -> None:
        """Draw a name at a pixel, the end of the leader line to its frame's origin."""
        left = at[0] < origin[0]
        self.line([at, origin], HALO, 4)
        self.line([at, origin], LEADER, 1.5)
        self.dot(origin, INK, 4.5)
        gap = 8 * self.unit * (-1 if left else 1)
        self.text((at[0] + gap, at[1]), name, "rm" if left else "lm")

    def text(self, at: Pixel, words: str, anchor: str) -> None:
        """Write on a halo of the room's colour."""
        self.pen.text(
            at, words, INK, self.font, anchor,
            stroke_width=round(3 * self.unit), stroke_fill=HALO,
        )  # fmt: skip

    def legend(self) -> None:
        """Say which colour is which axis, in the lower left corner."""
        x = 0.03 * self.size[0]
        y = self.size[1] - 1.3 * self.text_height
        for name, colour in zip("xyz", (X, Y, Z), strict=True):
            self.line([(x, y), (x + self.text_height, y)], colour, 5)
            x += 1.4 * self.text_height
            self.text((x, y), name, "lm")
            x += 1.2 * self.text_height

    def over(self, picture: Image.Image) -> Image.Image:
        """Return the picture under this sheet."""
        sheet = self.sheet.resize(picture.size, Image.Resampling.LANCZOS)
        return Image.alpha_composite(picture.convert("RGBA"), sheet).convert("RGB")
