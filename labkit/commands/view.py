"""Show the arm and its frames, moved by your code, next to MuJoCo's answer.

    make view                        in your browser; DAY=2: that day's tabs
    make view ARGS=--screenshot      a picture, without a window
    make view ARGS="--clip arm.gif"  the arm moving, and your own code's arm
    make view ARGS=--native          MuJoCo's own window
    make view TASK=1.2               a call of task 1.2 that fails
    python3 scripts/view_panda.py 2  without make: the page of Day 2

With a task it opens at a call that fails: its configuration, poses and points, your
answer in red and the expected one in blue; in the browser, as a picture, or in MuJoCo's
window. In the browser, drag a joint. Where the result of your function differs from
MuJoCo's, a red arm shows it. Your function is called again after every save, in the
checker's sandbox. Only this machine can open the page, at an address that contains a
secret.
"""

import argparse
import functools
import importlib.util
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

import mujoco
import numpy as np

from labkit.base import cli
from labkit.check.tasks import TaskResult, check_tasks
from labkit.commands import native_viewer
from labkit.commands.start import require_begun
from labkit.handin.figure import PORTRAIT
from labkit.inspector.arm import Arm
from labkit.inspector.failing import Drawing, drawing_of, sentence_of
from labkit.inspector.ghost import Seen
from labkit.inspector.standing import named
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

if TYPE_CHECKING:
    from PIL.Image import Image

DAYS_OWN = Path("the figure of the day")  # the value of --screenshot without a file
CONFIGURATIONS = ("ready", "home", "zero")
BARE, FRAMES = "panda_nohand", 40
REACH_Q = np.array([0.9, 0.3, -0.4, -1.6, 0.5, 2.2, -0.6])  # the far end of a clip
Failing = tuple[TaskResult, Drawing]
# Whether a clip says good news, by their kind.
GOOD = {"": None, "good": True, "bad": False, "quiet": False}


def web(
    day: Day,
    entry: str,
    start: str | None,
    port: int,
    simple: bool,
    failing: TaskResult | None = None,
) -> NoReturn:
    """Serve the inspector until Ctrl-C; without a start where it was left.

    It opens at the failing call of a task, where one is given.
    """
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
    back = start is None and failing is None
    serve(day, arm, about, dressed, port, simple=simple, back=back, failing=failing)


def end_of(model: mujoco.MjModel) -> str:
    """Return the frame where a robot ends: its last site, else its last body."""
    if model.nsite:
        return f"site:{model.site(model.nsite - 1).name}"
    return f"body:{model.body(model.nbody - 1).name}"


def failing_of(day: Day, task: str) -> Failing | None:
    """Return a task's result and what to draw of its failing call.

    Where nothing can be drawn a line says why.
    """
    require_begun(day)
    with cli.busy("checking"), Sandbox() as sandbox:
        (result,) = check_tasks(day, day.work, sandbox, task)
    drawing = drawing_of(day, result)
    if why := sentence_of(result, drawing):
        print(cli.wrapped(why))
        return None
    print(cli.wrapped(f"{named(result)}: {result.verdict.call}"), flush=True)
    return result, drawing


def screenshot(path: Path, draw: Callable[[], "Image"], about: str) -> int:
    """Write a picture, drawn offscreen; overwrite nothing.

    Args:
        path: of the file.
        draw: returns the picture.
        about: is kept in the file.
    """
    if path.exists():
        raise Robo47Error(
            f"{shown(path)} is there already and stays as it is; name another file: "
            "--screenshot other.png"
        )
    try:
        picture = draw()
    except ModuleNotFoundError as missing:
        if missing.name != "PIL":
            raise
        raise Robo47Error(
            "pictures need Pillow, which is not installed yet: "
            "make view ARGS=--screenshot (or: python3 scripts/setup_env.py figures)"
        ) from None
    from PIL import PngImagePlugin

    kept = PngImagePlugin.PngInfo()
    kept.add_text(PORTRAIT, about)
    path.parent.mkdir(parents=True, exist_ok=True)
    picture.save(path, pnginfo=kept)
    print(f"wrote {shown(path)}")
    return cli.EXIT_OK


def portrait_at(start: str) -> "Image":
    """Return the picture of the arm in a configuration, by its name."""
    from labkit.figures.portrait import screenshot

    arm = Arm(panda.load(BARE), panda.END_FRAME[BARE])
    return screenshot(arm.named_q[start], start)


def call_of(result: TaskResult, drawing: Drawing) -> "Image":
    """Return the picture of a failing call."""
    from labkit.inspector.failing_picture import picture_of

    return picture_of(named(result), result.verdict.call, drawing)


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
    add("--task", metavar="1.2", help="a call of this task that fails")
    add("--file", type=Path, help="with --clip: whose code, instead of your own")
    add("--simple", action="store_true", help="simple meshes: a computer without a GPU")
    add("--port", type=port, default=8080, help="8080; 0 for any")
    says = "ready (the labs' home_q), home (the model's own key) or zero; else where"
    add("--start", choices=CONFIGURATIONS, help=f"{says} you left it")
    says = "which model, for --web; panda has the hand"
    add("--entry", choices=("panda_nohand", "panda"), help=says)
    return parser.parse_args()


def picture(options: argparse.Namespace, failing: Failing | None) -> int:
    """Write the picture that was asked for: of the arm, or of a failing call."""
    path = path_of(options)
    if failing is not None:
        return screenshot(path, functools.partial(call_of, *failing), "a call")
    start = options.start or CONFIGURATIONS[0]
    return screenshot(path, functools.partial(portrait_at, start), start)


def path_of(options: argparse.Namespace) -> Path:
    """Return which file a picture is written to.

    Raises:
        Robo47Error: no file is named, and the day hands no figure in.
    """
    if options.screenshot != DAYS_OWN:
        return options.screenshot
    if options.task:
        return Path(f"task-{options.task}.png")
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
    if options.screenshot and options.entry:
        raise Robo47Error("--entry is for --web; a picture has the hand on")
    if options.task and options.clip:
        raise Robo47Error("--task is for a picture or a page; a clip has no such call")
    if options.native and (why := native_viewer.obstacle()):
        raise Robo47Error(f"{why}. The browser needs none of that: make view")
    failing = None
    if options.task:
        failing = failing_of(chosen_day(options.day, options.task), options.task)
        if failing is None:
            return cli.EXIT_OK
    if options.screenshot:
        return picture(options, failing)
    if options.native:
        return native_viewer.show(failing and failing[1])
    day = chosen_day(options.day, options.task)
    clash.tell(day.work.parent)
    if options.clip:
        return clip(options.clip, day, options.file)
    entry = options.entry or day.week.robot
    result = failing and failing[0]
    web(day, entry, options.start, options.port, options.simple, result)
