"""An advisory lock on an open file, which the system releases if we are killed."""

import os
import sys
import time

PATIENCE_S = 60.0  # a row takes microseconds: whoever holds it longer is stuck
PAUSE_S = 0.001

if sys.platform == "win32":
    import msvcrt

    # Windows locks bytes, and against readers too: so one that no file reaches.
    _FAR = 2**31 - 2

    def _try_lock(fd: int) -> bool:
        os.lseek(fd, _FAR, os.SEEK_SET)
        try:
            msvcrt.locking(fd, msvcrt.LK_NBLCK, 1)
        except OSError:
            return False
        return True

    def unlock(fd: int) -> None:
        """Let go before closing: Windows would do it, but only some time later."""
        os.lseek(fd, _FAR, os.SEEK_SET)
        msvcrt.locking(fd, msvcrt.LK_UNLCK, 1)

else:
    import fcntl

    def _try_lock(fd: int) -> bool:
        try:
            fcntl.flock(fd, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
        return True

    def unlock(fd: int) -> None:
        """Nothing to do: closing the file lets go at once."""


def lock(fd: int) -> None:
    """Wait until this process alone holds the file.

    Raises:
        TimeoutError: somebody else has held it for PATIENCE_S seconds.
    """
    deadline = time.monotonic() + PATIENCE_S
    while not _try_lock(fd):
        if time.monotonic() > deadline:
            raise TimeoutError(f"another program has held it for {PATIENCE_S:.0f} s")
        time.sleep(PAUSE_S)
