"""Linux's own fence around a process: which folders it may read, and which write.

The kernel enforces it, whatever a program does in Python or below; nothing that the
process starts escapes it, and nothing may be started at all. Source: <linux/landlock.h>
and landlock(7). Where the kernel has no Landlock (before 5.13, or switched off), the
audit hooks of `guard` stand alone.
"""

import ctypes
import os
import sys

_CREATE_RULESET, _ADD_RULE, _RESTRICT_SELF = 444, 445, 446  # on every architecture
_PATH_BENEATH, _GET_VERSION, _NO_NEW_PRIVS = 1, 1, 38
_READ_FILE, _READ_DIR, _EXECUTE = 1 << 2, 1 << 3, 1 << 0
_FIRST_RIGHTS = (1 << 13) - 1  # those that the first version of Landlock knows
_TRUNCATE, _TRUNCATE_SINCE = 1 << 14, 3
# The C library loads what a late import needs from here.
_SYSTEM = ("/lib", "/lib64", "/usr/lib", "/usr/lib64", "/etc/ld.so.cache")


class _Ruleset(ctypes.Structure):
    _fields_ = [("handled", ctypes.c_uint64)]


class _Beneath(ctypes.Structure):
    _pack_ = 1
    _layout_ = "ms"
    _fields_ = [("allowed", ctypes.c_uint64), ("folder", ctypes.c_int32)]


def fence(folder: str, readable: list[str]) -> bool:
    """Keep this process to some folders for the rest of its life.

    Args:
        folder: where it may do anything but start a program.
        readable: where it may read, besides the system's libraries.

    Returns:
        Whether the kernel did it.
    """
    if not sys.platform.startswith("linux"):
        return False
    try:
        libc = ctypes.CDLL(None, use_errno=True)
        version = libc.syscall(_CREATE_RULESET, None, 0, _GET_VERSION)
    except (OSError, AttributeError):
        return False
    if version < 1:
        return False
    rights = _FIRST_RIGHTS | (_TRUNCATE if version >= _TRUNCATE_SINCE else 0)
    rights &= ~_READ_DIR  # listing harms nobody, and imports list a lot
    attributes = _Ruleset(rights)
    size = ctypes.c_size_t(ctypes.sizeof(attributes))
    rules = libc.syscall(_CREATE_RULESET, ctypes.byref(attributes), size, 0)
    if rules < 0:
        return False
    _allow(libc, rules, folder, rights & ~_EXECUTE)
    _allow(libc, rules, os.devnull, rights & 0b110)  # read and write
    for path in (*readable, *_SYSTEM):
        _allow(libc, rules, path, _READ_FILE)
    libc.prctl(_NO_NEW_PRIVS, 1, 0, 0, 0)
    done = libc.syscall(_RESTRICT_SELF, rules, 0) == 0
    os.close(rules)
    return bool(done)


def _allow(libc: ctypes.CDLL, rules: int, path: str, rights: int) -> None:
    """Add a rule for what is below a path; one that does not exist needs none."""
    try:
        handle = os.open(path, os.O_PATH | os.O_CLOEXEC)
    except OSError:
        return
    rule = _Beneath(rights, handle)
    libc.syscall(_ADD_RULE, rules, _PATH_BENEATH, ctypes.byref(rule), 0)
    os.close(handle)
