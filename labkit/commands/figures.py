"""Draw the pictures of a day's lesson into its week's figures/.

    make figures DAY=1                                 all of a day
    python3 scripts/make_figures.py --day 1            the same
    python3 scripts/make_figures.py day1_order         one of them
    python3 scripts/make_figures.py --out other/place  into another folder

Works without a display. MuJoCo draws the robot; the frames over it are composed
by hand, so a wrong one would be seen beside its link.
"""

from pathlib import Path
from typing import Any

from tqdm import tqdm

from labkit.base import cli
from labkit.figures import backends
from labkit.figures.lessons import lesson_figures
from labkit.lesson.day import find_day, started_day
from robo47.errors import Robo47Error
from robo47.paths import shown


def main() -> int:
    """Draw what was asked for."""
    parser = cli.parser(__doc__)
    parser.add_argument("names", nargs="*", metavar="name", help="default: all")
    parser.add_argument("--day", type=cli.day, help="default: the last begun")
    parser.add_argument("--out", type=Path, help="folder to write to")
    options = parser.parse_args()
    # Before a lesson imports MuJoCo, which fails there with a traceback.
    backends.rendering_environment()
    day = find_day(options.day or day_of(options.names) or started_day())
    folder = options.out or day.folder / "figures"
    try:
        figures = lesson_figures(day.number)
    except ModuleNotFoundError as missing:
        raise Robo47Error(
            f"pictures need {missing.name}, which is not installed yet: make figures"
        ) from None
    names = options.names or list(figures)
    unknown = set(names) - set(figures)
    if unknown:
        raise Robo47Error(
            f"no picture {min(unknown)}; day {day.number} has: "
            f"{', '.join(figures) or 'none'}"
        )
    for name in tqdm(names, "drawing", leave=False, delay=1, disable=None):
        print(save(figures[name](), folder / f"{name}.png"))
    return cli.EXIT_OK


def day_of(names: list[str]) -> int | None:
    """Return the day that a picture's name begins with: dayN_order."""
    number = names[0].partition("_")[0].removeprefix("day") if names else ""
    return int(number) if number.isdecimal() else None


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
