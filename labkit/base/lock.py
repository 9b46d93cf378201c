"""An advisory lock on an open file, which the system releases if we are killed."""

import errno
import functools
import os
import sys
import time
import warnings

PATIENCE_S = 60.0  # a row takes microseconds: whoever holds it longer is stuck
PAUSE_S = 0.001
# The errors of file systems without locks (NFS without its lock service, some FUSE).
NO_LOCKS = {
    getattr(errno, name, errno.ENOSYS)
    for name in ("ENOLCK", "ENOTSUP", "EOPNOTSUPP", "ENOSYS")
}

if sys.platform == "win32":
    import msvcrt

    # Windows locks bytes, and against readers too: so one that no file reaches.
    _FAR = 2**31 - 2

    def try_lock(fd: int) -> bool:
        """Return whether the file is ours alone now, and until it is closed."""
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

    def try_lock(fd: int) -> bool:
        """Return whether the file is ours alone now, and until it is closed."""
        try:
            fcntl.flock(fd, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
        return True

    def unlock(fd: int) -> None:
        """Nothing to do: closing the file lets go at once."""


def lock(fd: int, patience: float | None = None) -> bool:
    """Wait until this process alone holds the file.

    Args:
        fd: an open file.
        patience: seconds to wait; None is PATIENCE_S.

    Returns:
        Whether it does; False where the file system has no locks. There, appends that
        come one at a time still arrive whole.

    Raises:
        TimeoutError: somebody else has held it for so long.
    """
    seconds = PATIENCE_S if patience is None else patience
    deadline = time.monotonic() + seconds
    try:
        while not try_lock(fd):
            if time.monotonic() > deadline:
                raise TimeoutError(f"another program has held it for {seconds:.0f} s")
            time.sleep(PAUSE_S)
    except OSError as error:
        if error.errno not in NO_LOCKS:
            raise
        return False
    return True


@functools.cache
def warn_once() -> None:
    """Say once that rows are recorded without a lock."""
    warnings.warn(
        "this file system has no locks: do not let two programs write the log at the"
        " same time",
        stacklevel=2,
    )
