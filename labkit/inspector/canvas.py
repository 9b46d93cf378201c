"""A picture of a plane, for `Page.image`: smooth lines, discs, words on a dark ground.

    canvas = Canvas((-1.3, -1.3), (1.3, 1.3), (480, 480))
    canvas.line(path, "orange", 3)
    image.image = canvas.picture()

Points are in the plane's own units; colours as in `draw`.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray
from PIL import Image, ImageDraw, ImageFont

from labkit.inspector.draw import Colour, rgb

GROUND = (27, 31, 36)
FINER = 2  # it is drawn so much larger, and then made smaller: no edge is jagged


class Canvas:
    """A picture that is drawn by points of a plane."""

    def __init__(
        self, low: ArrayLike, high: ArrayLike, size: tuple[int, int],
        ground: Colour = GROUND,
    ) -> None:  # fmt: skip
        """Begin with nothing drawn.

        Args:
            low, high: the plane's points at the lower left and at the upper right,
                (2,); for pixels, whose y points down, low is (0, height).
            size: width and height of the picture, pixels.
            ground: the colour behind all.
        """
        self.low, self.high = np.asarray(low, float), np.asarray(high, float)
        self.size = size
        large = (FINER * size[0], FINER * size[1])
        self.image = Image.new("RGB", large, rgb(ground))
        self.draw = ImageDraw.Draw(self.image)

    def at(self, points: ArrayLike) -> list[tuple[float, float]]:
        """Return where points, (n, 2), are in the large picture; the farthest cut."""
        parts = (np.asarray(points, float) - self.low) / (self.high - self.low)
        parts = np.clip(np.nan_to_num(parts, nan=9.0), -9.0, 9.0)
        width, height = self.image.size
        return [(width * x, height * (1.0 - y)) for x, y in parts.reshape(-1, 2)]

    def line(self, points: ArrayLike, colour: Colour, width: float = 2) -> None:
        """Draw a line through points, (n, 2); the width is in pixels."""
        if len(at := self.at(points)) > 1:
            self.draw.line(at, rgb(colour), round(FINER * width), joint="curve")

    def polygon(self, points: ArrayLike, colour: Colour) -> None:
        """Fill the area between points, (n, 2)."""
        self.draw.polygon(self.at(points), rgb(colour))

    def dots(self, points: ArrayLike, colour: Colour, radius: float = 4) -> None:
        """Draw dots at points, (n, 2); the radius is in pixels."""
        r = FINER * radius
        for x, y in self.at(points):
            self.draw.ellipse((x - r, y - r, x + r, y + r), rgb(colour))

    def rings(self, points: ArrayLike, colour: Colour, radius: float = 6) -> None:
        """Draw rings around points, (n, 2); the radius is in pixels."""
        r = FINER * radius
        for x, y in self.at(points):
            box = (x - r, y - r, x + r, y + r)
            self.draw.ellipse(box, outline=rgb(colour), width=2 * FINER)

    def disc(self, middle: ArrayLike, radius: float, colour: Colour) -> None:
        """Fill a disc of the plane, its radius in the plane's units."""
        edge = np.linspace(0.0, 2 * np.pi, 73)[:, None]
        around = np.hstack([np.cos(edge), np.sin(edge)])
        self.polygon(np.asarray(middle) + radius * around, colour)

    def words(
        self, text: str, at: ArrayLike, colour: Colour = "white",
        anchor: str = "lm", size: int = 13,
    ) -> None:  # fmt: skip
        """Write a text at a point, (2,); the anchor is Pillow's, the size in pixels."""
        font = ImageFont.load_default(FINER * size)
        self.draw.text(self.at(at)[0], text, rgb(colour), font, anchor)

    def picture(self) -> NDArray[np.uint8]:
        """Return it as bytes, (height, width, 3)."""
        return np.asarray(self.image.resize(self.size, Image.Resampling.LANCZOS))


def inset(
    picture: NDArray[np.uint8], part: NDArray[np.uint8], corner: Sequence[int]
) -> NDArray[np.uint8]:
    """Return a picture with another one in it, whose upper left is at (row, column)."""
    made = picture.copy()
    rows, columns = part.shape[:2]
    r, c = corner
    made[r : r + rows, c : c + columns] = part
    made[r : r + rows, [c, c + columns - 1]] = 120
    made[[r, r + rows - 1], c : c + columns] = 120
    return made
