"""One copy of the kit for all tests of a file, put back after each.

Hundreds of files are copied in tenths of a second; those that a test changed, in
milliseconds.
"""

import os
import shutil
from pathlib import Path


class Restored:
    """A folder that is put back as it was; what Python compiled in it may stay."""

    def __init__(self, folder: Path) -> None:
        """Remember all files of a folder."""
        self.folder = folder
        self._was = {path: _stamp(path) for path in _paths(folder)}
        self._texts = {path: path.read_bytes() for path in self._was if path.is_file()}

    def put_back(self) -> Path:
        """Put it back; return it."""
        for path in set(_paths(self.folder)) - set(self._was):
            if path.is_dir():
                shutil.rmtree(path)
            else:
                path.unlink(missing_ok=True)  # with its folder
        for path, text in self._texts.items():
            if not path.exists() or _stamp(path) != self._was[path]:
                path.parent.mkdir(parents=True, exist_ok=True)
                path.unlink(missing_ok=True)  # git's objects are not writable
                path.write_bytes(text)
                os.utime(path, ns=(self._was[path][0],) * 2)
        return self.folder


def _paths(folder: Path) -> list[Path]:
    return [path for path in folder.rglob("*") if "__pycache__" not in path.parts]


def _stamp(path: Path) -> tuple[int, int]:
    status = path.stat()
    return (status.st_mtime_ns, status.st_size) if path.is_file() else (0, 0)
