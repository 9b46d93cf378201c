"""Make the kit's own Python environment, `.venv`, and keep it current.

    python3 scripts/setup_env.py            what the labs need
    python3 scripts/setup_env.py test       and what `make test` needs
    python3 scripts/setup_env.py view ...   any extra named in pyproject.toml

Runs on a bare Python, so it uses the standard library alone, and no syntax
that would keep an old Python from reading the message that it is too old.
Does nothing when nothing changed. Uses `uv` where it is installed.
"""

import argparse
import hashlib
import os
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
VENV = ROOT / ".venv"
VENV_PYTHON = VENV / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
OLDEST = (3, 11)


def stop(problem, remedy):
    """End with one line on what is wrong and one on what to do."""
    sys.exit("setup: " + problem + "\n       " + remedy)


def find_python():
    """Return a Python that is new enough: this one, or a newer one on PATH."""
    if sys.version_info[:2] >= OLDEST:
        return sys.executable
    for minor in (13, 12, 11, 14):
        found = shutil.which("python3.{}".format(minor))  # noqa: UP032 (old Pythons)
        if found:
            return found
    return stop(
        "this is Python {}.{}; the kit needs 3.11 or newer.".format(
            *sys.version_info[:2]
        ),
        "Install one (python.org, or your package manager) and run make again with"
        " PYTHON=python3.13",
    )


def fingerprint(python):
    """Return a hash of everything that decides what the environment holds."""
    parts = [str(ROOT), python]
    parts += [
        (ROOT / f).read_text("utf-8") for f in ("pyproject.toml", "constraints.txt")
    ]
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


def run(command, doing):
    """Run a quiet command; on failure show the end of what it said."""
    print("setup: " + doing + " ...", flush=True)
    done = subprocess.run(
        [str(part) for part in command],
        cwd=str(ROOT),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    return done.returncode, done.stdout


def make_venv(python, uv):
    """Create `.venv`, replacing one whose Python is gone."""
    command = [python, "-m", "venv", "--clear", VENV]
    if uv:
        command = [uv, "venv", "--quiet", "--clear", "--seed", "--python", python, VENV]
    code, said = run(command, "making .venv")
    if code == 0:
        return
    shutil.rmtree(str(VENV), ignore_errors=True)
    if "ensurepip" in said:
        version = "{}.{}".format(*sys.version_info[:2])
        stop(
            "this Python cannot make environments (no ensurepip).",
            "On Debian or Ubuntu: sudo apt install python3-venv (or python"
            + version
            + "-venv), then run make again.",
        )
    stop("could not make .venv:\n" + said[-1500:], "Mend that and run make again.")


def install(extra, uv):
    """Install the kit, editable, with one extra, at the pinned versions."""
    what = ".[" + extra + "]" if extra != "core" else "."
    command = [VENV_PYTHON, "-m", "pip", "install", "--disable-pip-version-check"]
    if uv:
        command = [uv, "pip", "install", "--python", VENV_PYTHON]
    command += ["--quiet", "--constraint", "constraints.txt", "--editable", what]
    code, said = run(command, "installing robo47 (" + extra + "), a minute at most")
    if code == 0:
        return
    offline = (
        "Temporary failure",
        "Failed to establish",
        "NewConnectionError",
        "Network is unreachable",
        "dns error",
        "Could not resolve",
        "getaddrinfo",
    )
    if any(sign in said for sign in offline):
        stop(
            "the package index cannot be reached.",
            "Check the network (or the proxy: HTTPS_PROXY), then run make again.",
        )
    if "No space left" in said:
        stop("the disk is full.", "Free about 1 GB, then run make again.")
    stop("could not install:\n" + said[-1500:], "Mend that and run make again.")


def works(python):
    """Return whether that interpreter starts (a moved folder breaks a venv)."""
    if not python.exists():
        return False
    probe = [str(python), "-c", "import sys; sys.exit(sys.version_info < (3, 11))"]
    return subprocess.run(probe, check=False).returncode == 0


def main():
    """Bring `.venv` to what pyproject.toml and constraints.txt say."""
    about, usage = __doc__.split("\n", 1)
    parser = argparse.ArgumentParser(
        description=about,
        epilog=usage,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("extras", nargs="*", default=["core"], help="default: core")
    extras = parser.parse_args().extras
    python = find_python()
    uv = shutil.which("uv")
    wanted = fingerprint(python)
    for extra in extras:
        stamp = VENV / (".ready-" + extra)
        current = stamp.exists() and stamp.read_text() == wanted
        if not works(VENV_PYTHON):
            make_venv(python, uv)
            current = False
        if not current:
            install(extra, uv)
        stamp.write_text(wanted)


if __name__ == "__main__":
    main()
