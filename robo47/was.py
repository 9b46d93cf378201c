"""Names of the library that labs have typed, each with the module that has it now.

They are named and not imported: while a day is checked, the module with its answers is
refused, and a name that leads to it with it.
"""

import importlib
from collections.abc import Callable
from typing import Any

MOVED = {
    # Both had a place of their own until a day asked them.
    "robo47.se3": {"axis_angle": "robo47.screws"},
    "robo47.screws": {"ad": "robo47.dynamics"},
}


def moved(module: str) -> Callable[[str], Any]:
    """Return the `__getattr__` of a module that some names have left."""

    def find(name: str) -> Any:
        """Return what has the name now."""
        if name not in MOVED[module]:
            raise AttributeError(f"module {module!r} has no attribute {name!r}")
        return getattr(importlib.import_module(MOVED[module][name]), name)

    return find
