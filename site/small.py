"""Thumbnails of the days' pictures, for the tables of the weeks.

.venv/bin/python site/small.py      w1-foundations/figures/small/dayN.png
"""

from pathlib import Path

from PIL import Image

ROOT = Path(__file__).resolve().parent.parent
SIZE = (168, 112)
# The picture, its part that is shown: left, top and width, in parts of its width.
PARTS = {
    1: ("day1_order", 0.0, 0.09, 0.42),
    2: ("day2_screws", 0.22, 0.1, 0.56),
    3: ("day3_ellipses", 0.03, 0.04, 0.5),
    4: ("day4_torques", 0.04, 0.22, 0.5),
    5: ("day5_error_curves", 0.06, 0.05, 0.66),
    6: ("day6_press", 0.03, 0.06, 0.72),
    7: ("day7_pick", 0.24, 0.16, 0.56),
}


def main() -> None:
    """Cut them out."""
    figures = ROOT / "w1-foundations" / "figures"
    for day, (name, left, top, width) in PARTS.items():
        whole = Image.open(figures / f"{name}.png").convert("RGB")
        x, y, w = (round(part * whole.width) for part in (left, top, width))
        part = whole.crop((x, y, x + w, y + w * SIZE[1] // SIZE[0]))
        small = part.resize(SIZE, Image.Resampling.LANCZOS).quantize(64)
        small.save(figures / "small" / f"day{day}.png", optimize=True)


if __name__ == "__main__":
    main()
