"""The kit's memory on the student's machine: `.robo47/`, which git ignores.

Nothing else reads or writes there but `scripts/alone.py`, which old Pythons run. A
folder that cannot be written costs the memory and not the answer.
"""

import contextlib
import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any

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
    try:
        return {task: int(count) for task, count in read("hints.json", root).items()}
    except (ValueError, TypeError):
        return {}


def replace(path: Path, content: bytes) -> None:
    """Write a file beside and rename it: whole, or as it was after an OSError."""
    new = path.with_name(path.name + ".new")
    new.write_bytes(content)
    new.replace(path)
