"""Show the arm and its frames, moved by your code, next to MuJoCo's answer.

    make view                        in your browser; DAY=2: that day's tabs
    make view ARGS=--screenshot      a picture, without a window
    make view ARGS="--clip arm.gif"  the arm moving, and your own code's arm
    make view ARGS=--native          MuJoCo's own window
    python3 scripts/view_panda.py 2  without make: the page of Day 2

In the browser, drag a joint. Where the result of your function differs from MuJoCo's, a
red arm shows it. Your function is called again after every save, in the checker's
sandbox. Only this machine can open the page, at an address that contains a secret.
"""

import argparse
import functools
import importlib.util
from pathlib import Path
from typing import NoReturn

import mujoco
import numpy as np

from labkit.base import cli
from labkit.commands import native_viewer
from labkit.handin.figure import PORTRAIT
from labkit.inspector.arm import Arm
from labkit.inspector.ghost import Seen
from labkit.inspector.student import AGAIN, Student
from labkit.inspector.tab import day_tabs
from labkit.judge.ask import model_of
from labkit.lesson import clash
from labkit.lesson.day import Day, chosen_day
from labkit.sandbox.sandbox import CALL_SECONDS, Sandbox
from robo47 import panda
from robo47.checks import Array
from robo47.errors import Robo47Error
from robo47.panda import files
from robo47.paths import shown

DAYS_OWN = Path("the figure of the day")  # the value of --screenshot without a file
CONFIGURATIONS = ("ready", "home", "zero")
BARE, FRAMES = "panda_nohand", 40
REACH_Q = np.array([0.9, 0.3, -0.4, -1.6, 0.5, 2.2, -0.6])  # the far end of a clip
# Whether a clip says good news, by their kind.
GOOD = {"": None, "good": True, "bad": False, "quiet": False}


def web(day: Day, entry: str, start: str | None, port: int, simple: bool) -> NoReturn:
    """Serve the inspector until Ctrl-C; without a start where it was left."""
    if importlib.util.find_spec("viser") is None:
        raise Robo47Error(
            "the inspector needs viser, which this Python does not have. "
            "`make view` installs it, or: python3 scripts/setup_env.py view"
        )
    from labkit.inspector.serve import serve

    scene = day.folder / entry if entry.endswith(".xml") else None
    print(f"robot: {shown(scene)}" if scene else panda.describe(entry), flush=True)
    about = ""
    if files.panda_folder() is None and not scene:
        about = (
            "The robot's meshes are not here: simple shapes are drawn, with the same "
            "frames (python3 scripts/fetch_menagerie.py fetches them)"
        )
        print(about)
    model = model_of(scene or entry)
    arm = Arm(model, end_of(model) if scene else panda.END_FRAME[entry])
    arm.move(arm.named_q.get(start or CONFIGURATIONS[0], arm.named_q["home"]))
    dressed = functools.partial(panda.load, entry, meshes=True)
    dressed = functools.partial(model_of, scene) if scene else dressed
    serve(day, arm, about, dressed, port, simple=simple, back=start is None)


def end_of(model: mujoco.MjModel) -> str:
    """Return the frame where a robot ends: its last site, else its last body."""
    if model.nsite:
        return f"site:{model.site(model.nsite - 1).name}"
    return f"body:{model.body(model.nbody - 1).name}"


def screenshot(path: Path, start: str) -> int:
    """Write a picture of the arm, drawn offscreen; overwrite nothing."""
    if path.exists():
        raise Robo47Error(
            f"{shown(path)} is there already and stays as it is; name another file: "
            "--screenshot other.png"
        )
    try:
        from labkit.figures.portrait import screenshot as draw
    except ModuleNotFoundError as missing:
        if missing.name != "PIL":
            raise
        raise Robo47Error(
            "pictures need Pillow, which is not installed yet: "
            "make view ARGS=--screenshot (or: python3 scripts/setup_env.py figures)"
        ) from None
    from PIL import PngImagePlugin

    arm = Arm(panda.load(BARE), panda.END_FRAME[BARE])
    picture = draw(arm.named_q[start], start)
    about = PngImagePlugin.PngInfo()
    about.add_text(PORTRAIT, start)
    path.parent.mkdir(parents=True, exist_ok=True)
    picture.save(path, pnginfo=about)
    print(f"wrote {shown(path)}")
    return cli.EXIT_OK


def clip(path: Path, day: Day, file: Path | None) -> int:
    """Write a .gif or .webp of the arm with the student's own; overwrite nothing.

    That is of the file in work/ unless one is given, and red wherever it differs.
    """
    if path.exists():
        raise Robo47Error(f"{shown(path)} is there already; name another file")
    try:
        from labkit.figures import clip as clips
    except ModuleNotFoundError as missing:
        raise Robo47Error(
            f"a clip needs {missing.name}, which is not installed yet: "
            'make view ARGS="--clip arm.gif" (or: python3 scripts/setup_env.py view)'
        ) from None
    clips.kind_of(path)
    if file and not file.is_file():
        raise Robo47Error(f"{file} is not there")
    qs = clips.there_and_back(panda.READY_Q, REACH_Q, FRAMES)
    shots = [
        (clips.arm_scene(q, seen.drawn), (seen.sentence.rstrip("."), GOOD[seen.kind]))
        for q, seen in zip(qs, seen_at(qs, day, file or day.work), strict=True)
    ]
    size = clips.save_clip(clips.drawn(shots), path)
    print(f"wrote {shown(path)}, {size / 1000:.0f} kB")
    return cli.EXIT_OK


def seen_at(qs: Array, day: Day, script: Path) -> list[Seen]:
    """Return what a student's file gives at configurations, (n, 7), beside MuJoCo's.

    Where there is no file, or the day has no such function, the sentences say that.
    """
    ghost = day_tabs(day).ghost
    if ghost is None or not script.is_file():
        why = f"{shown(script)} is not there"
        if ghost is None:
            why = f"day {day.number} has no other. Live: make view"
        return [Seen(f"MuJoCo's arm; {why}", "")] * len(qs)
    arm = Arm(panda.load(BARE), panda.END_FRAME[BARE])
    with Sandbox() as sandbox:
        student = Student(day, arm, ghost, sandbox, script, CALL_SECONDS)
        student.look()
        found = [student.see(q) for q in qs]
    if student.problem:
        raise Robo47Error(student.problem.removesuffix(AGAIN))
    return found


def port(text: str) -> int:
    """Return a port number, 0 to 65535."""
    number = int(text)
    if not 0 <= number <= 65535:
        raise argparse.ArgumentTypeError(f"{number} is not a port; 0 to 65535 are")
    return number


def parse() -> argparse.Namespace:
    """Read the command line."""
    parser = cli.parser(__doc__)
    add = parser.add_argument
    how = parser.add_mutually_exclusive_group()
    add(
        "day", type=cli.day, nargs="?", help="whose tabs and file; the last you started"
    )
    how.add_argument("--web", action="store_true", help="in a browser; the default")
    how.add_argument("--native", action="store_true", help="MuJoCo's own window")
    how.add_argument(
        "--screenshot", metavar="FILE", nargs="?", type=Path, const=DAYS_OWN,
        help="write a picture; without FILE the one that the day hands in",
    )  # fmt: skip
    how.add_argument(
        "--clip", metavar="FILE", type=Path, help="write a short .gif or .webp"
    )
    add("--file", type=Path, help="with --clip: whose code, instead of your own")
    add("--simple", action="store_true", help="simple meshes: a computer without a GPU")
    add("--port", type=port, default=8080, help="8080; 0 for any")
    says = "ready (the labs' home_q), home (the model's own key) or zero; else where"
    add("--start", choices=CONFIGURATIONS, help=f"{says} you left it")
    says = "which model, for --web; panda has the hand"
    add("--entry", choices=("panda_nohand", "panda"), help=says)
    return parser.parse_args()


def picture_of(options: argparse.Namespace) -> Path:
    """Return which file a picture is written to.

    Raises:
        Robo47Error: no file is named, and the day hands no figure in.
    """
    if options.screenshot != DAYS_OWN:
        return options.screenshot
    day = chosen_day(options.day)
    if not day.figure:
        raise Robo47Error(f"day {day.number} hands no figure in; name a file")
    if day.draw:
        raise Robo47Error(
            f"the picture of day {day.number} shows what your functions do: make "
            f"figures DAY={day.number}. For one of the arm alone name a file: "
            'ARGS="--screenshot arm.png"'
        )
    return day.folder / day.figure


def main() -> int:
    """Show the Panda in the way that was asked for."""
    options = parse()
    if options.file and not options.clip:
        raise Robo47Error("--file is for --clip; --web shows the file in work/")
    if options.screenshot:
        if options.entry:
            raise Robo47Error("--entry is for --web; a picture has the hand on")
        return screenshot(picture_of(options), options.start or CONFIGURATIONS[0])
    if options.native:
        if why := native_viewer.obstacle():
            raise Robo47Error(f"{why}. The browser needs none of that: make view")
        return native_viewer.show()
    day = chosen_day(options.day)
    clash.tell(day.work.parent)
    if options.clip:
        return clip(options.clip, day, options.file)
    entry = options.entry or day.week.robot
    web(day, entry, options.start, options.port, options.simple)
