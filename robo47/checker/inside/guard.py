"""What student code may not do, watched through Python's audit hooks.

A hook cannot be removed again. It keeps a task to its arguments: no file outside its
own folder but Python's own libraries, no process, no network, no foreign library, no
second look at MuJoCo. It is there against accidents and short cuts. It is no wall
against an expert: that is `landlock`, where the system has it; and what protects the
grade is that the answers themselves are judged elsewhere.
"""

import os
import stat
import sys
from typing import Any

# Events that a task has no use for, by the start of their names.
_FORBIDDEN = {
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
    "resource.setrlimit": "change the checker's limits",
    "resource.prlimit": "change the checker's limits",
    "winreg.": "use the registry",
    "os.symlink": "make a link",
    "os.link": "make a link",
}
# Events that change a file, and which of their arguments are paths and folder handles.
_CHANGES = {
    "os.remove": ((0,), (1,)),
    "os.rename": ((0, 1), (2, 3)),
    "os.mkdir": ((0,), (2,)),
    "os.rmdir": ((0,), (1,)),
    "os.chmod": ((0,), (2,)),
    "os.chown": ((0,), (3,)),
    "os.truncate": ((0,), ()),
    "os.utime": ((0,), (3,)),
    "os.chdir": ((0,), ()),
    "os.setxattr": ((0,), ()),
    "os.removexattr": ((0,), ()),
}
_WRITES = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND


class RefusedError(PermissionError):
    """The guard said no; its text completes "your code tried to ..."."""


class Guard:
    """The rules, and a record of what they refused."""

    def __init__(self, folder: str, readable: list[str], closed: list[str]) -> None:
        """Note which folders are open.

        Args:
            folder: the task's own, the only one it may write to.
            readable: folders of Python and its libraries.
            closed: folders below those that stay closed all the same.
        """
        self.folder = _below(folder)
        self.readable = tuple(_below(path) for path in readable)
        self.closed = tuple(_below(path) for path in closed)
        self.refused: list[str] = []

    def refuse(self, what: str) -> RefusedError:
        """Record a refusal and return the exception to raise."""
        self.refused.append(what)
        return RefusedError(f"refused by the checker: {what}")

    def arm(self) -> None:
        """Watch every event of this interpreter from now on."""
        sys.addaudithook(self._check)

    def _check(self, event: str, args: tuple[Any, ...]) -> None:
        if event == "open":
            path, mode, flags = args
            writes = bool(flags & _WRITES) if isinstance(flags, int) else False
            self._check_path(path, writes, handle=mode is None)
        elif event in _CHANGES:
            paths, handles = _CHANGES[event]
            for index in handles:
                if index < len(args) and args[index] not in (-1, None):
                    raise self.refuse(f"{event} through a folder's handle")
            for index in paths:
                self._check_path(args[index], True, handle=False)
        elif event == "import":
            if len(args) > 1 and isinstance(args[1], str):  # a compiled module's file
                self._check_path(args[1], False, handle=False)
        else:
            for start, what in _FORBIDDEN.items():
                if _starts(event, start):
                    raise self.refuse(what)

    def _check_path(self, path: Any, writes: bool, handle: bool) -> None:
        if isinstance(path, int):  # a file that is open already
            return
        full = _below(os.fsdecode(path))
        if _starts(full, self.folder) or full == _below(os.devnull):
            return
        known = any(_starts(full, start) for start in self.readable)
        closed = any(_starts(full, start) for start in self.closed)
        if not writes and known and not closed and not (handle and _is_folder(path)):
            return
        raise self.refuse(f"{'write to' if writes else 'read'} {os.fsdecode(path)}")


def _below(path: str) -> str:
    """Return the real path of a folder with a separator at its end."""
    return os.path.join(os.path.normcase(os.path.realpath(path)), "")


def _starts(text: str, start: str) -> bool:
    return text[: len(start)] == start


def _is_folder(path: Any) -> bool:
    try:
        return stat.S_ISDIR(os.stat(path).st_mode)
    except OSError:
        return False
