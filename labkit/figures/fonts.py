"""The letters of drawn pictures: matplotlib's fonts, which have most of them."""

from importlib.util import find_spec
from pathlib import Path
from typing import Any

from PIL import ImageFont


def font(size: float, face: str = "") -> Any:
    """Return a font, or Pillow's own, which has few letters, without matplotlib.

    Args:
        size: of its letters, pixels.
        face: "Bold", or "Mono", all of one width.
    """
    if (found := find_spec("matplotlib")) and found.origin:
        fonts = Path(found.origin).parent / "mpl-data" / "fonts" / "ttf"
        name = f"DejaVuSans-{face}" if face == "Bold" else f"DejaVuSans{face}"
        if (file := fonts / f"{name}.ttf").is_file():
            return ImageFont.truetype(file, size)
    return ImageFont.load_default(size)
