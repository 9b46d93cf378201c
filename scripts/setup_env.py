"""Make the kit's own Python environment, `.venv`, and keep it current.

    python3 scripts/setup_env.py            what the labs need
    python3 scripts/setup_env.py test       and what `make test` needs
    python3 scripts/setup_env.py view ...   any extra named in pyproject.toml
    python3 scripts/setup_env.py --anew     throw .venv away and make it again
    python3 scripts/setup_env.py --venv .venv-bench bench    in a folder of its own

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
PYTHON_IN_VENV = "Scripts/python.exe" if os.name == "nt" else "bin/python"
OLDEST = (3, 11)


def stop(problem, remedy):
    """End with one line on what is wrong and one on what to do."""
    sys.exit("setup: " + problem + "\n       " + remedy)


def find_python():
    """Return a Python that is new enough, and its version: this one, or on PATH."""
    if sys.version_info[:2] >= OLDEST:
        # Run from inside an environment, the Python that it was made with.
        return getattr(sys, "_base_executable", sys.executable), sys.version_info[:2]
    for minor in (13, 12, 11, 14):
        found = shutil.which(f"python3.{minor}")
        if found and is_version(found, (3, minor)):
            return found, (3, minor)
    return stop(
        "this is Python {}.{}; the kit needs 3.11 or newer.".format(
            *sys.version_info[:2]
        ),
        "Install one (python.org, or your package manager) and run make again with"
        " PYTHON=python3.13",
    )


def fingerprint():
    """Return a hash of everything that decides what an environment holds."""
    files = [ROOT / name for name in ("pyproject.toml", "constraints.txt")]
    parts = [str(ROOT)] + [path.read_text("utf-8") for path in files]
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


def make_venv(venv, python, uv):
    """Create the environment, replacing one that does not work."""
    command = [python, "-m", "venv", "--clear", venv]
    if uv:
        command = [uv, "venv", "--quiet", "--clear", "--seed", "--python", python, venv]
    code, said = run(command, "making " + venv.name)
    if code == 0:
        return
    shutil.rmtree(str(venv), ignore_errors=True)
    if "ensurepip" in said:
        version = "{}.{}".format(*sys.version_info[:2])
        stop(
            "this Python cannot make environments (no ensurepip).",
            "On Debian or Ubuntu: sudo apt install python3-venv (or python"
            + version
            + "-venv), then run make again.",
        )
    stop("could not make it:\n" + said[-1500:], "Mend that and run make again.")


def install(venv, extra, uv):
    """Install the kit, editable, with one extra, at the pinned versions."""
    what = ".[" + extra + "]" if extra != "core" else "."
    python = venv / PYTHON_IN_VENV
    command = [python, "-m", "pip", "install", "--disable-pip-version-check"]
    if uv:
        command = [uv, "pip", "install", "--python", python]
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


def is_version(python, version):
    """Return whether a Python starts and is that version (a pyenv shim may not)."""
    test = f"import sys; sys.exit(sys.version_info[:2] != {tuple(version)})"
    done = subprocess.run(
        [str(python), "-c", test], stderr=subprocess.PIPE, check=False
    )
    return done.returncode == 0


def works(venv, version):
    """Return whether an environment's Python is the right one and starts."""
    python = venv / PYTHON_IN_VENV
    return python.exists() and is_version(python, version)


def main():
    """Bring `.venv` to what pyproject.toml and constraints.txt say."""
    about, usage = __doc__.split("\n", 1)
    parser = argparse.ArgumentParser(
        description=about,
        epilog=usage,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("extras", nargs="*", default=["core"], help="default: core")
    parser.add_argument("--anew", action="store_true", help="make it from nothing")
    parser.add_argument("--venv", default=".venv", help="its folder; default: .venv")
    options = parser.parse_args()
    venv = ROOT / options.venv
    python, version = find_python()
    uv = shutil.which("uv")
    if options.anew or not works(venv, version):
        make_venv(venv, python, uv)
    for extra in options.extras:
        stamp = venv / (".ready-" + extra)
        if not (stamp.exists() and stamp.read_text() == fingerprint()):
            install(venv, extra, uv)
        stamp.write_text(fingerprint())


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        print("\nsetup: stopped; the next make goes on")
        sys.exit(130)
