"""Which Pythons this machine has, asked by starting them; what set-up says."""

# Old Pythons read this first: no f-strings and no annotations.
import os
import shutil
import subprocess
import sys

OLDEST = (3, 11)
ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


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
    try:
        process = subprocess.Popen(
            [str(python), "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE
        )
        said = process.communicate()[0].split()
    except OSError:
        return None
    if process.returncode != 0 or len(said) != 2:
        return None
    return int(said[0]), int(said[1])
