"""Linux's own fence around a process: what it may read.

The kernel enforces it, whatever a program does in Python or below; nothing that the
process starts escapes it, and nothing may be started at all. Source: <linux/landlock.h>
and landlock(7). What it could close besides (TCP, signals, abstract sockets, in newer
kernels) the filter of system calls refuses everywhere: `seccomp`.
"""

import ctypes
import os
import struct
import sys

# the same numbers on every architecture
_CREATE_RULESET, _ADD_RULE, _RESTRICT_SELF = 444, 445, 446
_PATH_BENEATH, _GET_VERSION, _NO_NEW_PRIVS = 1, 1, 38
_READ_FILE, _READ_DIR = 1 << 2, 1 << 3
_FILES = (1 << 13) - 1  # the rights that the first version of Landlock knows
_SINCE = {2: 1 << 13, 3: 1 << 14, 5: 1 << 15}  # refer, truncate, ioctl on devices
# The C library loads what a late import needs from here.
_SYSTEM = ("/lib", "/lib64", "/usr/lib", "/usr/lib64")
# folders of Python packages, not other libraries
_PACKAGES = ("site-packages", "dist-packages", "python")


def version() -> int:
    """Return which version of Landlock the kernel has; 0 where it has none."""
    if not sys.platform.startswith("linux"):
        return 0
    try:
        libc = ctypes.CDLL(None, use_errno=True)
        return max(0, libc.syscall(_CREATE_RULESET, None, 0, _GET_VERSION))
    except (OSError, AttributeError):
        return 0


def fence(readable: list[str]) -> bool:
    """Keep this process to some folders for the rest of its life.

    Args:
        readable: where it may read, besides the system's libraries; not what is in a
            folder of other packages there.

    Returns:
        Whether the kernel did it.
    """
    known = version()
    if known < 1:
        return False
    libc = ctypes.CDLL(None, use_errno=True)
    rights = _FILES | sum(right for since, right in _SINCE.items() if known >= since)
    ruleset = struct.pack("=Q", rights)
    rules = libc.syscall(_CREATE_RULESET, ruleset, ctypes.c_size_t(len(ruleset)), 0)
    if rules < 0:
        return False
    _allow(libc, rules, os.devnull, _READ_FILE | 1 << 1)
    for folder in {os.path.realpath(path) for path in (*readable, *_SYSTEM)}:
        _allow(libc, rules, folder, _READ_DIR)
        for path in _inside(folder):
            _allow(libc, rules, path, _READ_FILE | _READ_DIR)
    _allow(libc, rules, "/etc/ld.so.cache", _READ_FILE)
    libc.prctl(_NO_NEW_PRIVS, 1, 0, 0, 0)
    done = libc.syscall(_RESTRICT_SELF, rules, 0) == 0
    os.close(rules)
    return bool(done)


def _inside(folder: str) -> list[str]:
    try:
        names = os.listdir(folder)
    except OSError:
        return []
    return [os.path.join(folder, n) for n in names if not n.startswith(_PACKAGES)]


def _allow(libc: ctypes.CDLL, rules: int, path: str, rights: int) -> None:
    """Add a rule for what is below a path; one that does not exist needs none."""
    try:
        handle = os.open(path, os.O_PATH | os.O_CLOEXEC)
    except OSError:
        return
    if not os.path.isdir(path):
        rights &= ~_READ_DIR  # the kernel refuses it for a file
    rule = struct.pack("=Qi", rights, handle)  # packed, as the kernel has it
    libc.syscall(_ADD_RULE, rules, _PATH_BENEATH, rule, 0)
    os.close(handle)
