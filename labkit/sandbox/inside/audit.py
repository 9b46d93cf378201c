"""A signpost: says in words what a task has no use for, before it happens.

An audit hook of Python, which student code runs beside and can switch off. So it keeps
nobody out: that is the wall's part (`labkit.sandbox.process`). It is for the honest:
"It tries to write to notes.txt. A task needs only its arguments."
"""

import os
import sys
from typing import Any

# Events that a task has no use for, by the start of their names.
_REFUSED = {
    "os.system": "start another program",
    "os.exec": "start another program",
    "os.spawn": "start another program",
    "os.posix_spawn": "start another program",
    "os.startfile": "start another program",
    "subprocess.": "start another program",
    "os.fork": "start another process",
    "os.kill": "signal another process",
    "socket.": "use the network",
    "ctypes.": "call into a foreign library",
    "gc.get_": "search the interpreter's memory",
}
_CHANGES = {"os.remove", "os.rename", "os.mkdir", "os.rmdir", "os.chmod", "os.chown"}
_CHANGES |= {"os.truncate", "os.utime", "os.symlink", "os.link"}
LONGEST = 2_000  # characters of a refusal
_WRITES = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND


class RefusedError(PermissionError):
    """The guard said no; its text completes "your code tried to ..."."""


class Guard:
    """The rules, and a record of what they refused."""

    def __init__(self, readable: list[str]) -> None:
        """Note which folders may be read: Python's and NumPy's."""
        self.readable = tuple(map(_below, readable))
        self.refused: list[str] = []

    def refuse(self, what: str) -> RefusedError:
        """Record a refusal and return the exception to raise."""
        self.refused.append(what[:LONGEST])
        return RefusedError(f"refused by the checker: {what}")

    def arm(self) -> None:
        """Watch every event of this interpreter from now on."""
        sys.addaudithook(self._check)

    def _check(self, event: str, args: tuple[Any, ...]) -> None:
        if event == "open":
            path, _, flags = args
            self._check_path(path, isinstance(flags, int) and bool(flags & _WRITES))
        elif event in _CHANGES:
            self._check_path(args[0], True)
        else:
            for start, what in _REFUSED.items():
                if event.startswith(start):
                    raise self.refuse(what)

    def _check_path(self, path: Any, writes: bool) -> None:
        if isinstance(path, int):  # a file that is open already
            return
        name = os.fsdecode(path)
        full = _below(name)
        known = any(full.startswith(start) for start in self.readable)
        if full == _below(os.devnull) or (known and not writes):
            return
        raise self.refuse(f"{'write to' if writes else 'read'} {name}")


def _below(path: str) -> str:
    """Return the real path of a folder with a separator at its end."""
    return os.path.join(os.path.normcase(os.path.realpath(path)), "")
