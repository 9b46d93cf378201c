"""robo47: derive it by hand, verify it against MuJoCo, record the number."""

import importlib
from types import ModuleType

__version__ = "0.2.0"

# Names that labs of before December 2026 import.
_WAS = {
    "dynamics_batch": "robo47.fast.dynamics",
}


def __getattr__(name: str) -> ModuleType:
    """Return a module by the name that it had before."""
    if name not in _WAS:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return importlib.import_module(_WAS[name])
