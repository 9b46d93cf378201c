"""Importing this goes on in the kit's own Python, whichever started the script.

`python3 scripts/check_day.py` then works from a bare system Python too: everything the
kit needs is in .venv, and that is where the script goes on. The labs do the same:
`import kit` finds `w1-foundations/src/kit.py`, which runs this file.
"""

# Old Pythons read this first: no f-strings and no annotations.
import os
import sys

os.environ.setdefault("OMP_NUM_THREADS", "1")  # before NumPy: its matrices are small
ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
NEEDED = ("robo47", "numpy", "mujoco", "tqdm")
CRASHED = 70  # the exit code where the kit itself failed; 0, 1 and 2 say other things
OWN = os.path.join(ROOT, ".venv", "bin", "python")
SCRIPT = getattr(sys.modules.get("__main__"), "__file__", None) or ""
FOLDER = os.path.dirname(os.path.abspath(SCRIPT))
SCRIPTS = os.path.realpath(os.path.join(ROOT, "scripts"))
if SCRIPT and os.path.realpath(sys.path[0]) == os.path.realpath(FOLDER) != SCRIPTS:
    # A lab's folder: a practice file named random.py is not Python's random.
    sys.path.append(sys.path.pop(0))
sys.path.insert(0, ROOT)
from labkit.base import shell  # noqa: E402

del sys.path[0]
if os.name == "nt":
    OWN = os.path.join(ROOT, ".venv", "Scripts", "python.exe")


def here():
    """Return whether this Python can run the kit, and this clone's."""
    if sys.version_info < (3, 11):
        return False
    from importlib.util import find_spec

    found = [spec.origin or "" for spec in map(find_spec, NEEDED) if spec]
    top = os.path.realpath(ROOT) + os.sep
    return len(found) == len(NEEDED) and os.path.realpath(found[0]).startswith(top)


def go_on():
    """Start the script again in the kit's own Python, or say how to get one."""
    again = os.path.isfile(sys.argv[0])  # not a line typed at a prompt
    if os.environ.get("ROBO47_HANDED_ON") or not os.path.exists(OWN) or not again:
        end(
            2,
            "error: the kit is not set up"
            + (" completely" if os.path.exists(OWN) else "")
            + ". Run `make setup` (without make: python3 scripts/setup_env.py --anew).",
        )
    os.environ["ROBO47_HANDED_ON"] = "1"  # once: a broken .venv must not go in circles
    shell.go_on([OWN] + sys.argv, os.environ)


def run(name):
    """Run a module of labkit/commands/ as the script that was typed."""
    from importlib import import_module

    from labkit.base import cli

    cli.run(import_module("labkit.commands." + name).main)


def explain(kind, error, trace):
    """Say in a few lines what ended a script, where a traceback would not help."""
    import traceback

    cause = error  # MuJoCo's import makes an ImportError of Ctrl-C
    while cause and not isinstance(cause, KeyboardInterrupt):
        cause = cause.__cause__ or cause.__context__
    if cause:
        end(130, "\nstopped")
    frames = traceback.extract_tb(trace)
    found = own_bug(kind, error, frames)
    if found:
        end(int(os.environ.get("ROBO47_NOT_YET", 1)), *found)
    chosen = os.environ.get("MUJOCO_GL")  # which MuJoCo reads when it is imported
    if chosen and any("gl_context" in frame.filename for frame in frames):
        says = "error: MuJoCo cannot use MUJOCO_GL={} here. Unset it: unset MUJOCO_GL"
        end(2, says.format(chosen))
    sys.__excepthook__(kind, error, trace)
    if is_kits():
        says = "This is a fault of the kit. Please report it, with the lines above."
        end(CRASHED, says)


def is_kits():
    """Return whether one of the kit's own scripts is running, or a lab of the kit."""
    script = getattr(sys.modules.get("__main__"), "__file__", None) or ""
    folder = os.path.dirname(os.path.realpath(script))
    above = os.path.realpath(ROOT)
    own = folder == os.path.join(above, "scripts")
    lab = os.path.basename(folder) == "src" and folder.startswith(above + os.sep)
    return bool(script) and (own or lab)


def own_bug(kind, error, frames):
    """Return three lines on a bug in a student's lab, () where it is not theirs."""
    script = getattr(sys.modules.get("__main__"), "__file__", None) or ""
    folder, name = os.path.split(os.path.abspath(script))
    number = name[3 : name.find("_")]
    if os.path.basename(folder) != "work" or not number.isdigit():
        return ()
    own = [
        (os.path.basename(frame.filename), frame.lineno, frame.name, frame.line)
        for frame in frames
        if os.path.dirname(os.path.abspath(frame.filename)) == folder
    ]
    if not own:
        return ()
    where = "{}, line {}, in {}: {}".format(*own[-1])
    says = "{}: {}".format(kind.__name__, error).splitlines()[0]
    if (own[-1][3] or "").startswith(("import ", "from ")):  # no function is at fault
        return (where, says) + taken_names(folder)
    return (where, says, "Which function is it? make check DAY=" + number)


def taken_names(folder):
    """Return a line on each file of a folder that has a module's name."""
    from pathlib import Path

    from labkit.lesson import clash

    return tuple(map(clash.sentence, clash.clashes(Path(folder))))


def end(code, *lines):
    """Print lines and end: after this hook Python would end with 1."""
    sys.stdout.flush()
    sys.stderr.write("\n".join(lines) + "\n")
    sys.stderr.flush()
    os._exit(code)


shell.leave(ROOT)
sys.excepthook = explain
if not here():
    go_on()
import labkit.lesson.day_mujoco  # noqa: E402, F401 (labs find `day5_mujoco` then)

os.environ.pop("ROBO47_HANDED_ON", None)  # programs that we start may hand on too
