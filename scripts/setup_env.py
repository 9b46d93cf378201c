"""Make the kit's own Python environment, `.venv`, and keep it current.

    python3 scripts/setup_env.py            what the labs need
    python3 scripts/setup_env.py test       and what `make test` needs
    python3 scripts/setup_env.py view ...   any extra named in pyproject.toml
    python3 scripts/setup_env.py --anew     throw .venv away and make it again
    python3 scripts/setup_env.py --venv .venv-bench bench    in another folder

Does nothing when nothing changed, and heals what an interrupted run left
behind. Two at once wait for each other. Uses `uv` where it is installed.
"""

# Runs on a bare Python, so: the standard library alone, and no syntax (f-strings,
# annotations) that would keep Python 2.7 or 3.6 from saying that it is too old.
import os
import sys

TOP = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, TOP)
from labkit.base import shell

shell.leave(TOP)
import errno
import hashlib
import re
import shutil
import subprocess

OLDEST = (3, 11)


def say(text):
    """Print a line at once, also into a pipe."""
    print("setup: " + text)
    sys.stdout.flush()


def stop(problem, remedy):
    """End with one line on what is wrong and one on what to do."""
    sys.exit("setup: " + problem + "\n       " + remedy)


def find_python():
    """Return a Python that is new enough, and its version: this one, or on PATH."""
    if sys.version_info[:2] >= OLDEST:
        # Run from inside an environment, the Python that it was made with.
        return getattr(sys, "_base_executable", sys.executable), sys.version_info[:2]
    which = getattr(shutil, "which", lambda name: None)  # Python 2 has none
    for minor in (13, 12, 11, 14):
        found = which("python3.{}".format(minor))
        if found and ask(found, "import sys") == (3, minor):  # a pyenv shim may not be
            return found, (3, minor)
    return stop(
        "this is Python {}.{}; the kit needs 3.11 or newer.".format(
            *sys.version_info[:2]
        ),
        "Install one (python.org, or your package manager), then run make again\n"
        "       with PYTHON=python3.13",
    )


def ask(python, imports):
    """Return the version of a Python that can import something, or None."""
    code = imports + "; import sys; print('%d %d' % sys.version_info[:2])"
    try:  # -I: what it finds is in its environment, and not in this folder
        process = subprocess.Popen(
            [str(python), "-I", "-c", code],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )
        said = process.communicate()[0].split()
    except OSError:
        return None
    if process.returncode != 0 or len(said) != 2:
        return None
    return int(said[0]), int(said[1])


# All that an old Python gets to see stands above.
if sys.version_info[:2] < OLDEST:  # go on in one that is new enough
    newer = find_python()[0]
    sys.exit(subprocess.call([newer, os.path.abspath(__file__)] + sys.argv[1:]))
from pathlib import Path

ROOT = Path(TOP)
from labkit.base import cli, processes
from labkit.base.store import alone, replace

OFFLINE = re.compile(
    "Temporary failure|Failed to establish|NewConnectionError|Network is unreachable"
    "|dns error|Could not resolve|getaddrinfo"
)
# Of these extras something has no wheel for a Python yet; tests/test_resolver.py looks.
WITHOUT_WHEELS = {(3, 15): ("bench", "grade", "notebook", "site", "trajectory", "view")}
UNRESOLVED = re.compile(
    "ResolutionImpossible|No matching distribution|No solution found"
)
NEWEST = (3, 14)  # for which everything has wheels
OLDER = "An older Python has all: make setup PYTHON=python{}.{}, then run make again."
# A MUJOCO_GL that MuJoCo refuses is no fault of the install.
IMPORTED = "import os; os.environ.pop('MUJOCO_GL', 0); import robo47, numpy, mujoco"
DISK_FULL = ("the disk is full.", "Free about 1 GB, then run make again.")


def made_with(venv):
    """Return the version of an environment's Python, or None if it is not whole.

    An environment is whole once it carries a stamp: a run that is killed while pip is
    being unpacked leaves one that starts and cannot install anything. What `uv sync`
    has made and filled is whole too.
    """
    stamped = any(venv.glob(".made*")) or any(venv.glob(".ready-*"))
    python = venv / processes.IN_VENV
    if not python.exists() or not (stamped or recorded(venv, "uv")):
        return None
    return ask(python, "import pip" if stamped else "import pip, mujoco")


def recorded(venv, what):
    """Return the version of "uv" or "version" that made an environment, or ""."""
    try:
        text = (venv / "pyvenv.cfg").read_text("utf-8")
    except (OSError, ValueError):
        return ""
    found = re.search(r"^" + what + r"\w* *= *(\d+\.\d+)", text, re.MULTILINE)
    return found.group(1) if found else ""


def fingerprint():
    """Return a hash of everything that decides what an environment holds."""
    digest = hashlib.sha256(str(ROOT).encode("utf-8"))
    for name in ("pyproject.toml", "constraints.txt"):
        digest.update((ROOT / name).read_bytes().replace(b"\r\n", b"\n"))
    return digest.hexdigest().encode("ascii")


def is_stamped(path):
    """Return whether a stamp is there and says what it must; any bytes may be in it."""
    return path.is_file() and path.read_bytes() == fingerprint()


def write_stamp(path):
    """Write a stamp whole or not at all; rewriting it tells make that it is new."""
    replace(path, fingerprint())


def run(command, doing):
    """Run a quiet command; return its exit code and what it said.

    Of a person's settings pip and uv get what leads them to their packages.
    """
    say(doing + " ...")
    pip = command[1:3] == ["-m", "pip"]
    settings = shell.for_pip(command[0]) if pip else shell.for_installer(os.environ)
    done = processes.run(command, cwd=ROOT, env=settings)
    return done.returncode, done.stdout + done.stderr


def last_lines(said):
    """Return the last lines of what an installer said."""
    return "\n".join(filter(str.strip, said.splitlines()[-8:]))[-1500:]


def make_venv(venv, python, uv):
    """Create the environment, replacing one that does not work."""
    for mark in (".made*", ".ready-*", ".installing-*"):
        for path in venv.glob(mark):  # first: without a stamp nobody takes it for whole
            path.unlink()
    command = [python, "-m", "venv", "--clear", venv]
    if uv:
        command = [uv, "venv", "--quiet", "--clear", "--seed", "--python", python, venv]
    code, said = run(command, "making " + venv.name)
    if code == 0:
        write_stamp(venv / ".made")
        return
    shutil.rmtree(venv, ignore_errors=True)
    if "ensurepip" in said:
        remedy = "On Debian or Ubuntu: sudo apt install python3-venv\n"
        remedy += "       (or python{}.{}-venv), then run make again."
        stop(
            "this Python cannot make environments (no ensurepip).",
            remedy.format(*sys.version_info[:2]),
        )
    if "No space left" in said:
        stop(*DISK_FULL)
    stop("could not make it:\n" + said[-1500:], "Fix that and run make again.")


def install(venv, extras, uv, version):
    """Install the kit, editable, with some extras, at the pinned versions."""
    named = ",".join(extra for extra in extras if extra != "core")
    what = ".[" + named + "]" if named else "."
    command = [venv / processes.IN_VENV, "-m", "pip", "install"]
    command += ["--disable-pip-version-check"]
    if uv:
        command = [uv, "pip", "install", "--python", command[0]]
    command += ["--quiet", "--constraint", "constraints.txt", "--editable", what]
    begun = [venv / (".installing-" + extra) for extra in extras]
    if any(mark.exists() for mark in begun):  # killed halfway: there may be gaps
        command.append("--reinstall" if uv else "--force-reinstall")
    for mark in begun:
        mark.touch()
    what = ", ".join(extras)
    code, said = run(command, "installing robo47 (" + what + "), a minute at most")
    if code:
        explain(code, said, what, version)
    if ask(venv / processes.IN_VENV, IMPORTED) is None:
        stop(
            "the install ended without an error, and yet its packages cannot be"
            " imported:\n" + failure(venv),
            "Make it anew: make setup",
        )


def failure(venv):
    """Return the last line of what stops the import of what was installed."""
    python = str(venv / processes.IN_VENV)
    said = processes.run([python, "-I", "-c", IMPORTED]).stderr
    return last_lines(said).rpartition("\n")[2]


def explain(code, said, what, version):
    """End with why an installer failed, in its own last words, and what to do."""
    if OFFLINE.search(said):
        stop(
            "the package index cannot be reached.",
            "Check the network (or the proxy: HTTPS_PROXY), then run make again.",
        )
    if "No space left" in said:
        stop(*DISK_FULL)
    if UNRESOLVED.search(said) and version > NEWEST:
        says = "something in {} has no wheel for Python {}.{}:\n{}"
        stop(says.format(what, *(version + (last_lines(said),))), OLDER.format(*NEWEST))
    if UNRESOLVED.search(said):
        stop(
            "the package index has not all that "
            + what
            + " needs:\n"
            + last_lines(said),
            "Another index (yours: python3 -m pip config list), or a 64-bit\n"
            "       Python of python.org may have it; then run make again.",
        )
    if code < 0 or not said.strip():  # a signal, or an end without a word
        stop(
            "the install ended without saying why (code {}): killed, perhaps for"
            " want of memory.".format(code),
            "Close other programs (it needs about 1 GB), then run make again.",
        )
    stop("could not install:\n" + last_lines(said), "Fix that and run make again.")


def provide(venv, anew, uv):
    """Make the environment if it is not whole; return the version of its Python."""
    python, version = find_python()
    has = made_with(venv)
    wanted = "{}.{}".format(*version)
    folder = venv.name
    if has is not None and has >= OLDEST and not anew:
        if has != version:
            say("{} keeps its Python {}.{}; to change that:".format(folder, *has))
            say("make setup PYTHON=" + python)
        return has
    before = "{}.{}".format(*has) if has else recorded(venv, "version")
    if before and not anew:
        say("{} (Python {}) is not whole; making it anew".format(folder, before))
    if before and before != wanted:
        say("{} had Python {}; it gets {} now".format(folder, before, wanted))
    make_venv(venv, python, uv)
    return version


def bring(venv, extras, anew):
    """Bring an environment to what pyproject.toml and constraints.txt say."""
    uv = shutil.which("uv")
    version = provide(venv, anew, uv)
    stamps = {extra: venv / (".ready-" + extra) for extra in extras}
    missing = [extra for extra in extras if not is_stamped(stamps[extra])]
    lacking = [e for e in missing if e in WITHOUT_WHEELS.get(version, ())]
    if lacking:
        says = "Python {}.{} is too new for ".format(*version) + ", ".join(lacking)
        says += ": something in it has no wheel yet."
        stop(says, OLDER.format(*NEWEST))
    if missing:
        install(venv, missing, uv, version)
    for extra in extras:
        write_stamp(stamps[extra])
        (venv / (".installing-" + extra)).unlink(missing_ok=True)


def main():
    """Set up what was asked for."""
    parser = cli.parser(__doc__)
    parser.add_argument("extras", nargs="*", default=["core"], help="default: core")
    parser.add_argument("--anew", action="store_true", help="make it from nothing")
    parser.add_argument("--venv", default=".venv", help="its folder; default: .venv")
    options = parser.parse_args()
    try:
        with alone("setup", ROOT):
            bring(ROOT / options.venv, options.extras, options.anew)
    except OSError as error:
        if error.errno != errno.ENOSPC:
            raise
        stop(*DISK_FULL)


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        print("\nsetup: stopped; the next make goes on")
        sys.exit(130)
