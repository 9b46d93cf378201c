"""The toy day's picture."""

from PIL import Image


def square() -> Image.Image:
    """Draw a square."""
    return Image.new("RGB", (64, 64), "#335577")


FIGURES = {"square": square}
