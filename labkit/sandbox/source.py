"""A student's script and the files beside it, as they travel to the sandbox."""

import base64
from pathlib import Path
from typing import Any

from robo47.errors import Robo47Error
from robo47.paths import shown

LARGEST, MOST = 1_000_000, 50  # bytes of a file, files beside the script


def code_of(script: Path) -> dict[str, Any]:
    """Return a script and the ones beside it, for the sandbox's request.

    Args:
        script: the student's file.

    Raises:
        Robo47Error: there is no such file, or it is no script.
    """
    if not script.is_file():
        raise Robo47Error(f"{shown(script)} is not there")
    if script.stat().st_size > LARGEST:
        raise Robo47Error(f"{shown(script)} is over 1 MB: that is no script")
    beside = {
        path.stem: _text(path)
        for path in sorted(script.parent.glob("*.py"))[:MOST]
        if _is_own(path) and path.stat().st_size <= LARGEST
    }
    return {"file": script.name, "code": _text(script), "beside": beside}


def _is_own(path: Path) -> bool:
    """Return whether a file counts as handed in: a grade follows no link either."""
    return path.is_file() and not path.is_symlink()


def _text(path: Path) -> str:
    return base64.b64encode(path.read_bytes()).decode("ascii")
