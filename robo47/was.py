"""Names that older labs import from a module, and the module that has each now.

A module is loaded only on request, because a day's own answers are not available to a
submission while that day is checked.
"""

import importlib
from collections.abc import Callable
from typing import Any

MOVED = {
    "robo47.se3": {"axis_angle": "robo47.screws"},
    "robo47.screws": {"ad": "robo47.dynamics"},
}


def moved(module: str) -> Callable[[str], Any]:
    """Return the `__getattr__` of a module from which names have moved."""

    def find(name: str) -> Any:
        """Return the function with this name from the module that has it now."""
        if name not in MOVED[module]:
            raise AttributeError(f"module {module!r} has no attribute {name!r}")
        return getattr(importlib.import_module(MOVED[module][name]), name)

    return find
