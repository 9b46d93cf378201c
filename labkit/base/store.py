"""The kit's memory on the student's machine: `.robo47/`, which git ignores.

Nothing else reads or writes there. A folder that cannot be written costs the memory
and not the answer. The standard library alone: set-up runs it on a bare Python.
"""

import contextlib
import json
import os
import time
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from labkit.base.lock import try_lock
from robo47.paths import ROOT


def path_of(name: str, root: Path = ROOT) -> Path:
    """Return where a file of the memory is."""
    return root / ".robo47" / name


def read_text(name: str, root: Path = ROOT) -> str:
    """Return a file of the memory; "" where there is none that can be read."""
    try:
        return path_of(name, root).read_text("utf-8", errors="replace")
    except OSError:
        return ""


def write_text(name: str, text: str, root: Path = ROOT) -> None:
    """Remember a text."""
    path = path_of(name, root)
    with contextlib.suppress(OSError):
        path.parent.mkdir(exist_ok=True)
        replace(path, text.encode())


def add_lines(name: str, lines: Iterable[str], root: Path = ROOT) -> None:
    """Remember lines besides those that are there."""
    path = path_of(name, root)
    with contextlib.suppress(OSError):
        path.parent.mkdir(exist_ok=True)
        with path.open("a", encoding="utf-8") as file:
            file.writelines(line + "\n" for line in lines)


def read(name: str, root: Path = ROOT) -> dict[str, Any]:
    """Return a JSON object of the memory; {} where there is none that can be read."""
    try:
        found = json.loads(read_text(name, root))
    except (ValueError, RecursionError):
        return {}
    return found if isinstance(found, dict) else {}


def write(name: str, memory: dict[str, Any], root: Path = ROOT) -> None:
    """Remember a JSON object."""
    write_text(name, json.dumps(memory), root)


def hints_given(root: Path = ROOT) -> dict[str, int]:
    """Return how many hints were asked for, by task."""
    found = read("hints.json", root).items()
    return {task: count for task, count in found if isinstance(count, int)}


def replace(path: Path, content: bytes, sync: bool = False) -> None:
    """Write a file beside and rename it: whole, or as it was after an OSError.

    With `sync` after a power cut, too, which takes the disk its time.
    """
    new = path.with_name(path.name + ".new")
    try:
        with new.open("wb") as file:
            file.write(content)
            if sync:
                file.flush()
                os.fsync(file.fileno())
        new.replace(path)
    except OSError as error:  # half a file helps nobody, and a full disk says no name
        with contextlib.suppress(OSError):
            new.unlink()
        raise OSError(error.errno, error.strerror, str(path)) from None


@contextlib.contextmanager
def alone(name: str, root: Path = ROOT) -> Iterator[None]:
    """Wait until no other process does this; a killed one lets go by itself."""
    path = path_of(f"{name}.lock", root)
    with contextlib.ExitStack() as stack:
        with contextlib.suppress(OSError):  # no locks here, or nobody may write
            path.parent.mkdir(exist_ok=True)
            fd = stack.enter_context(path.open("ab")).fileno()
            if not try_lock(fd):
                says = f"{name}: another run is at it in this folder; waiting ..."
                print(says, flush=True)
            while not try_lock(fd):
                time.sleep(0.2)
        yield
