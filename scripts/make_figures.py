"""Draw the pictures of the lessons into w1-foundations/figures.

    make figures                                    all of them
    python scripts/make_figures.py                  the same
    python scripts/make_figures.py day1_order       one of them
    python scripts/make_figures.py --out /tmp/pics  into another folder

Works without a display. MuJoCo draws the robot; the frames over it are composed
by hand, so a wrong one would be seen beside its link.
"""

import importlib
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import kit  # noqa: F401 (goes on in the kit's own Python)

try:
    from tqdm import tqdm

    from robo47 import cli
    from robo47.errors import Robo47Error
    from robo47.figures import backends
    from robo47.paths import ROOT, shown
except ModuleNotFoundError as missing:
    sys.exit(f"{missing.name} is not in this Python: run `make figures` in the clone")

LESSONS = ROOT / "w1-foundations" / "src"
FOLDER = ROOT / "w1-foundations" / "figures"


def find_figures() -> dict[str, Callable[[], Any]]:
    """Return {name of the picture: what draws it} of every day."""
    sys.path.insert(0, str(LESSONS))
    found = {}
    for path in sorted(LESSONS.glob("day*_figures.py")):
        day = path.stem.removesuffix("_figures")
        for name, draw in importlib.import_module(path.stem).FIGURES.items():
            found[f"{day}_{name}"] = draw
    return found


def main() -> int:
    """Draw what was asked for."""
    parser = cli.parser(__doc__)
    parser.add_argument("names", nargs="*", metavar="name", help="default: all")
    parser.add_argument("--out", type=Path, default=FOLDER, help="folder to write to")
    arguments = parser.parse_args()
    # Before a lesson imports MuJoCo, which fails there with a traceback.
    backends.rendering_environment()
    figures = find_figures()
    names = arguments.names or list(figures)
    if unknown := set(names) - set(figures):
        raise Robo47Error(f"no picture {min(unknown)}; there are {', '.join(figures)}")
    written = [
        save(figures[name](), arguments.out / f"{name}.png")
        for name in tqdm(names, "drawing", leave=False, delay=1)
    ]
    print("\n".join(written))
    return cli.EXIT_OK


def save(picture: Any, path: Path) -> str:
    """Write a picture whole, or leave what was there; return a line about it.

    Args:
        picture: a PIL image.
        path: the PNG file.

    Raises:
        Robo47Error: the folder cannot be written to.
    """
    part = path.with_suffix(".part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        picture.save(part, "PNG", optimize=True)
        part.replace(path)
    except OSError as error:
        raise Robo47Error(
            f"cannot write {shown(path)} ({error.strerror}); choose a folder with --out"
        ) from None
    width, height = picture.size
    return f"{shown(path)}  {width} x {height}, {path.stat().st_size / 1e3:.0f} kB"


if __name__ == "__main__":
    cli.run(main)
