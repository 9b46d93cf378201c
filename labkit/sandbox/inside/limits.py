"""Limits that the sandbox's process puts on itself before it meets student code.

Each is taken where the platform has it; the checker's own watchdog (wall clock, memory)
stands behind them everywhere. A limit that is set cannot be raised again.
"""

import contextlib
import ctypes
import os
import signal
import sys

try:
    import resource
except ImportError:  # Windows
    resource = None  # type: ignore[assignment]

GB = 1024**3  # NumPy itself takes some 0.2 of address space
_NEW_USER = 0x10000000  # <linux/sched.h>: CLONE_NEWUSER
_PDEATHSIG = 1  # <linux/prctl.h>


def die_with_parent() -> None:
    """Have the kernel end this process with the one that started it, where it can."""
    if sys.platform.startswith("linux"):
        with contextlib.suppress(OSError, AttributeError):
            ctypes.CDLL(None).prctl(_PDEATHSIG, signal.SIGKILL, 0, 0, 0)


def stop_being_root() -> None:
    """Be nobody where this process is root, as far as Linux lets it.

    The filter of system calls leaves root what root alone may do: to be another user,
    to hang up a terminal, to lock memory. Who is no root has nothing to lose here, and
    the network is that filter's to refuse.
    """
    if sys.platform.startswith("linux") and os.geteuid() == 0:
        with contextlib.suppress(OSError, AttributeError):
            ctypes.CDLL(None).unshare(_NEW_USER)


def tighten(cpu_seconds: float, memory: float) -> None:
    """Bound memory, processor time and open files; forbid files, processes, threads.

    Call it once the imports are done: NumPy may start threads of its own.

    Args:
        cpu_seconds: of processor time, for the whole life of the process.
        memory: GB that it may hold; of address space it gets one more.
    """
    if resource is None:
        return
    wanted = {
        "RLIMIT_AS": int((memory + 1.0) * GB),
        "RLIMIT_CPU": int(cpu_seconds),
        "RLIMIT_FSIZE": 0,  # files in memory (memfd) too
        "RLIMIT_NOFILE": 64,
        "RLIMIT_CORE": 0,
        "RLIMIT_NPROC": 0,  # all there is of it where no wall stands
    }
    for name, value in wanted.items():
        # macOS has no working RLIMIT_AS, and a hard limit may already be lower.
        with contextlib.suppress(AttributeError, ValueError, OSError):
            resource.setrlimit(getattr(resource, name), (value, value))
