"""Draw your picture of a day with your functions, or the pictures of its lesson.

    make figures DAY=6                              yours, that the day hands in
    make figures DAY=6 ARGS=--kit                   all of the lesson
    make figures DAY=1 ARGS=--clips                 its clips, where it has some
    make figures ARGS=--teaching                    those of the teachers' page
    python3 scripts/make_figures.py --day 6         the same as the first
    python3 scripts/make_figures.py NAME            one of them
    python3 scripts/make_figures.py --out elsewhere into another folder

Works without a display. MuJoCo draws the robot; the frames over it are composed
by hand, so a wrong one would be seen beside its link.
"""

import traceback
from pathlib import Path
from typing import Any

from tqdm import tqdm

from labkit.base import cli
from labkit.commands.start import require_begun
from labkit.figures import backends
from labkit.figures.lessons import lesson_figures
from labkit.lesson.day import Day, chosen_day
from labkit.lesson.writers import file_mark
from robo47.errors import Robo47Error
from robo47.paths import shown

SIGNATURE = b"robo47 drawn with"  # a text of the file, before the mark of whose


def main() -> int:
    """Draw what was asked for."""
    parser = cli.parser(__doc__)
    parser.add_argument("names", nargs="*", metavar="name", help="default: all")
    parser.add_argument("--day", type=cli.day, help="default: the one worked on last")
    parser.add_argument("--out", type=Path, help="folder to write to")
    parser.add_argument("--kit", action="store_true", help="the lesson's, not yours")
    parser.add_argument("--clips", action="store_true", help="the lesson's clips")
    parser.add_argument("--teaching", action="store_true", help="a class's pages")
    options = parser.parse_args()
    if options.teaching:
        return draw_class(options.out)
    # Before a lesson imports MuJoCo, which fails there with a traceback.
    backends.rendering_environment()
    number = day_of(options.names) if options.day is None else options.day
    day = chosen_day(number)
    folder = options.out or day.folder / "figures"
    theirs = options.names or options.kit or options.clips
    own = bool(day.draw and day.work.is_file()) and not theirs
    try:
        if options.clips:
            return film(day, folder)
        if own:
            return draw_own(day, folder / Path(day.figure).name)
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


def film(day: Day, folder: Path) -> int:
    """Write the clips of a day's lesson, which take minutes."""
    from labkit.figures import clip

    for name, frames in day.offered("clips").items():
        waits = tqdm(frames(), name, leave=False, delay=1, disable=None)
        print(clip.save_frames(waits, folder / f"{name}.webp"))
    return cli.EXIT_OK


def draw_class(out: Path | None) -> int:
    """Write the pictures of a graded class that `docs/teaching.md` shows."""
    try:
        from labkit.grade import pictures
    except ModuleNotFoundError as missing:
        raise Robo47Error(
            f"pictures need {missing.name}, which is not installed yet: make figures"
        ) from None
    for name, picture in pictures.draw():
        print(save(picture, (out or pictures.FOLDER) / f"{name}.png"))
    return cli.EXIT_OK


def draw_own(day: Day, path: Path) -> int:
    """Draw the picture that a day hands in, with the student's own functions."""
    from PIL import PngImagePlugin

    from labkit.figures import sheet

    if path.is_file() and SIGNATURE not in path.read_bytes():
        raise Robo47Error(
            f"{shown(path)} is there already and is none that this drew: it stays. "
            "Move it away, or choose a folder with --out"
        )
    require_begun(day)
    mark = file_mark(day.work.read_bytes())
    try:
        picture = lesson_figures(day.number, own=True)[f"day{day.number}_{day.draw}"]()
    except (Robo47Error, NotImplementedError):
        raise
    except Exception as error:
        frames = traceback.extract_tb(error.__traceback__)
        own = [f for f in frames if Path(f.filename).parent == day.work.parent]
        if not own:
            raise
        cli.complain(f"{day.script}, line {own[-1].lineno}, in {own[-1].name}")
        cli.complain(f"{type(error).__name__}: {error}")
        cli.complain(f"Which function is it? make check DAY={day.number}")
        return cli.EXIT_FAILED
    about = PngImagePlugin.PngInfo()
    about.add_text(SIGNATURE.decode(), mark)
    print(save(sheet.with_line(picture, f"{day.script}, {mark}"), path, about))
    return cli.EXIT_OK


def day_of(names: list[str]) -> int | None:
    """Return the day that a picture's name begins with: dayN_order."""
    number = names[0].partition("_")[0].removeprefix("day") if names else ""
    return int(number) if number.isdecimal() else None


def save(picture: Any, path: Path, about: Any = None) -> str:
    """Write a PIL image whole, or leave what was there; return a line about it."""
    part = path.with_suffix(".part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        # 256 colours look the same; MAXCOVERAGE (1) keeps those of thin lines, too, and
        # four rounds of k-means those of a dark floor, which has no bands so.
        small = picture.quantize(256, 1, kmeans=4, dither=0)
        small.save(part, "PNG", optimize=True, pnginfo=about)
        part.replace(path)
    except OSError as error:
        raise Robo47Error(
            f"cannot write {shown(path)} ({error.strerror}); choose a folder with --out"
        ) from None
    width, height = picture.size
    return f"{shown(path)}  {width} x {height}, {path.stat().st_size / 1e3:.0f} kB"
