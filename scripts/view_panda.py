"""See the Panda, its frames, and that your kinematics agree with MuJoCo.

    make view                                 what suits this machine
    make view ARGS=--screenshot               a picture, without a window
    python3 scripts/view_panda.py --web       the SE(3) inspector, in a browser
    python3 scripts/view_panda.py --native    MuJoCo's own window

In the inspector: drag a joint and watch T_world_ee change twice, from MuJoCo
and by hand; step through the chain link by link; put T_extra on the left or on
the right. It listens on this machine alone and prints the ssh line to use from
another.
"""

import argparse
import importlib.util
import sys
from pathlib import Path

import kit  # noqa: F401 (goes on in the kit's own Python)
import numpy as np

from robo47 import cli, menagerie, panda, window
from robo47.checks import Array
from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown

PICTURE = ROOT / "w1-foundations" / "figures" / "day1_panda_viewer.png"
CONFIGURATIONS = ("ready", "home", "zero")


def web(entry: str, start: str, port: int) -> int:
    """Serve the inspector until Ctrl-C."""
    if importlib.util.find_spec("viser") is None:
        raise Robo47Error(
            "the inspector needs viser, which this Python does not have. "
            "`make view` installs it, or: python3 scripts/setup_env.py view"
        )
    from robo47.inspector.arm import Arm
    from robo47.inspector.serve import serve

    about = panda.describe(entry)
    print(about, flush=True)
    if menagerie.panda_folder() is None:
        missing = (
            "The robot's meshes are not here: simple shapes stand in, with the same "
            "frames (python3 scripts/fetch_menagerie.py fetches them)"
        )
        print(missing)
        about = f"{about}. {missing}"
    arm = Arm(panda.load(entry, meshes=True), panda.END_FRAME[entry])
    arm.move(arm.named_q[start])
    return serve(arm, about, port)


def native() -> int:
    """Open MuJoCo's window, or say in one line why not."""
    why = window.obstacle()
    if why:
        raise Robo47Error(f"{why}. The browser needs none of that: --web")
    return window.show()


def screenshot(path: Path, start: str) -> int:
    """Write a picture of the arm, drawn offscreen; overwrite nothing."""
    if path.exists():
        raise Robo47Error(
            f"{shown(path)} is there already and stays as it is; name another file: "
            "--screenshot other.png"
        )
    try:
        from robo47.figures.screenshot import screenshot as draw
    except ModuleNotFoundError as missing:
        if missing.name != "PIL":
            raise
        raise Robo47Error(
            "pictures need Pillow, which is not installed yet: "
            "make view ARGS=--screenshot (or: python3 scripts/setup_env.py report)"
        ) from None
    picture = draw(configuration(start), start)
    path.parent.mkdir(parents=True, exist_ok=True)
    picture.save(path)
    print(f"wrote {shown(path)}")
    return cli.EXIT_OK


def configuration(name: str) -> Array:
    """Return the arm's joint angles at one of CONFIGURATIONS, (7,)."""
    if name == "ready":  # the handout's home_q; `home` is the model's own key
        return panda.READY_Q
    model = panda.load("panda_nohand")
    return panda.home_q(model) if name == "home" else np.zeros(model.nq)


def port(text: str) -> int:
    """Return a port number, 0 to 65535."""
    number = int(text)
    if not 0 <= number <= 65535:
        raise argparse.ArgumentTypeError(f"{number} is not a port; 0 to 65535 are")
    return number


def parse() -> argparse.Namespace:
    """Read the command line."""
    parser = cli.parser(__doc__)
    how = parser.add_mutually_exclusive_group()
    how.add_argument("--web", action="store_true", help="the inspector, in a browser")
    how.add_argument("--native", action="store_true", help="MuJoCo's own window")
    how.add_argument(
        "--screenshot",
        metavar="FILE",
        nargs="?",
        type=Path,
        const=PICTURE,
        help=f"write a picture (to {shown(PICTURE)})",
    )
    parser.add_argument("--port", type=port, default=8080, help="8080; 0 for any")
    parser.add_argument(
        "--start",
        choices=CONFIGURATIONS,
        default="ready",
        help="ready (the labs' home_q), home (the model's own key) or zero",
    )
    parser.add_argument(
        "--entry",
        choices=("panda_nohand", "panda"),
        help="which model, for --web; panda has the hand",
    )
    return parser.parse_args()


def main() -> int:
    """Show the Panda in the way that was asked for, or that suits the machine."""
    options = parse()
    if options.screenshot:
        if options.entry:
            raise Robo47Error("--entry is for --web; a picture has the hand on")
        return screenshot(options.screenshot, options.start)
    if options.native:
        return native()
    if not options.web:
        why = window.obstacle()
        if why is None:
            return native()
        print(f"no window: {why}.\nSo in the browser:", file=sys.stderr)
    return web(options.entry or "panda_nohand", options.start, options.port)


if __name__ == "__main__":
    cli.run(main)
