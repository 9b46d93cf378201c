"""One set-up at a time: two at once, from two terminals, wait for each other."""

# Old Pythons read this first: no f-strings and no annotations.
import contextlib
import errno
import os
import sys
import time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def say(text):
    """Print a line at once, also into a pipe."""
    print("setup: " + text)
    sys.stdout.flush()


@contextlib.contextmanager
def alone(name):
    """Wait until no other process does this; a killed one lets go by itself."""
    try:
        folder = os.path.join(ROOT, ".robo47")
        if not os.path.isdir(folder):
            os.makedirs(folder)
        file = open(os.path.join(folder, name + ".lock"), "a+b")  # noqa: SIM115
    except OSError:  # a folder that nobody can write to: setting up will say so
        yield
        return
    try:
        waited = False
        while not try_lock(file.fileno()):
            if not waited:
                say("another run is at it in this folder; waiting ...")
            waited = True
            time.sleep(0.2)
        yield
    finally:
        file.close()


def try_lock(fd):
    """Take a lock on an open file; True too where the system has no locks."""
    try:
        if sys.platform == "win32":
            import msvcrt

            os.lseek(fd, 0, os.SEEK_SET)
            msvcrt.locking(fd, msvcrt.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(fd, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        return error.errno not in (errno.EAGAIN, errno.EACCES, errno.EDEADLK)
    return True
