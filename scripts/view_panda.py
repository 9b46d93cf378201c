"""See the arm, its frames, and your own code move it, beside MuJoCo's answer.

    make view                          in your browser; make view DAY=2: that day's tabs
    python3 scripts/view_panda.py 2    the same, without make
    python3 scripts/view_panda.py --native           MuJoCo's own window
    python3 scripts/view_panda.py --screenshot       a picture, with neither
    python3 scripts/view_panda.py --clip arm.gif     a short clip, with neither

In the browser: drag a joint. Your own function draws a red arm wherever it
differs from MuJoCo's, and is asked again at every save; it runs in the checker's
sandbox. The page listens on this machine alone, at an address nobody else knows.
"""

import argparse
import functools
import importlib.util
from pathlib import Path

import kit  # noqa: F401 (goes on in the kit's own Python)

from robo47 import cli, menagerie, panda, window
from robo47.errors import Robo47Error
from robo47.lesson.day import Day, find_day, started_day
from robo47.paths import ROOT, shown

PICTURE = ROOT / "w1-foundations" / "figures" / "day1_panda_viewer.png"
CONFIGURATIONS = ("ready", "home", "zero")


def web(day: Day, entry: str, start: str, port: int) -> int:
    """Serve the inspector until Ctrl-C."""
    if importlib.util.find_spec("viser") is None:
        raise Robo47Error(
            "the inspector needs viser, which this Python does not have. "
            "`make view` installs it, or: python scripts/setup_env.py view"
        )
    from robo47.inspector.arm import Arm
    from robo47.inspector.serve import Show, serve

    about = panda.describe(entry)
    print(about, flush=True)
    if menagerie.panda_folder() is None:
        missing = (
            "The robot's meshes are not here: simple shapes are drawn, with the same "
            "frames (python scripts/fetch_menagerie.py fetches them)"
        )
        print(missing)
        about = f"{about}. {missing}"
    arm = Arm(panda.load(entry), panda.END_FRAME[entry])
    arm.move(arm.named_q[start])
    dressed = functools.partial(panda.load, entry, meshes=True)
    return serve(Show(day, arm, about, dressed), port)


def native() -> int:
    """Open MuJoCo's window, or say in one line why not."""
    if why := window.obstacle():
        raise Robo47Error(f"{why}. The browser needs none of that: make view")
    return window.show()


def screenshot(path: Path, entry: str, start: str) -> int:
    """Write a picture of the arm, drawn offscreen; overwrite nothing."""
    if path.exists():
        raise Robo47Error(
            f"{shown(path)} is there already and stays as it is; name another file: "
            "--screenshot other.png"
        )
    try:
        from robo47.figures import render_panda
    except ModuleNotFoundError as missing:
        raise Robo47Error(
            f"pictures need {missing.name}, which this Python does not have. "
            "`make figures` installs it; or take your own from the page: --web"
        ) from None
    from robo47.inspector.arm import Arm

    arm = Arm(panda.load(entry), panda.END_FRAME[entry])
    picture = render_panda(arm.named_q[start])
    path.parent.mkdir(parents=True, exist_ok=True)
    picture.save(path)
    print(f"wrote {shown(path)}")
    return cli.EXIT_OK


def port(text: str) -> int:
    """Return a port number, 0 to 65535."""
    number = int(text)
    if not 0 <= number <= 65535:
        raise argparse.ArgumentTypeError(f"{number} is not a port; 0 to 65535 are")
    return number


def parse() -> argparse.Namespace:
    """Read the command line."""
    parser = cli.parser(__doc__)
    parser.add_argument(
        "day", type=int, nargs="?", help="whose tabs and file; the last you started"
    )
    how = parser.add_mutually_exclusive_group()
    how.add_argument("--web", action="store_true", help="in a browser; the default")
    how.add_argument("--native", action="store_true", help="MuJoCo's own window")
    how.add_argument(
        "--screenshot",
        metavar="FILE",
        nargs="?",
        type=Path,
        const=PICTURE,
        help=f"write a picture (to {shown(PICTURE)})",
    )
    how.add_argument(
        "--clip", metavar="FILE", type=Path, help="write a short .gif or .webp"
    )
    parser.add_argument("--port", type=port, default=8080, help="8080; 0 for any")
    parser.add_argument(
        "--start", choices=CONFIGURATIONS, default="ready", help="configuration"
    )
    parser.add_argument(
        "--entry",
        choices=("panda_nohand", "panda"),
        default="panda_nohand",
        help="which model; panda has the hand",
    )
    return parser.parse_args()


def main() -> int:
    """Show the Panda in the way that was asked for."""
    options = parse()
    if options.screenshot:
        return screenshot(options.screenshot, options.entry, options.start)
    if options.native:
        return native()
    day = find_day(options.day or started_day())
    if options.clip:
        return clip(options.clip, day)
    return web(day, options.entry, options.start, options.port)


if __name__ == "__main__":
    cli.run(main)
