"""Finds `import dayN_mujoco`: what a day asks of MuJoCo, beside its complete lab.

A student's lab lies in `work/`, the module in `src/`, and only the kit's own is found,
wherever the lab lies: a file of that name in `work/` would be an oracle of their own.
The folder itself is on no path, since the complete labs are in it.
"""

import re
import sys
from functools import cache
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec
from importlib.util import spec_from_file_location
from pathlib import Path
from typing import Any

from robo47.paths import ROOT

_NAME = re.compile(r"day[1-9]\d*_mujoco")


@cache
def modules() -> dict[str, Path]:
    """Return the files of all days that have one, by the name that labs import."""
    found = sorted(ROOT.glob("w*/src/day*_mujoco.py"))
    return {path.stem: path for path in found if _NAME.fullmatch(path.stem)}


class BesideTheLab(MetaPathFinder):
    """Looks there before Python looks beside the script."""

    def find_spec(
        self, name: str, path: Any = None, _: Any = None
    ) -> ModuleSpec | None:
        """Return how to load a day's module, None for any other."""
        file = modules().get(name)
        return spec_from_file_location(name, file) if file else None


def install() -> None:
    """Let `import dayN_mujoco` work in this Python."""
    if not any(isinstance(finder, BesideTheLab) for finder in sys.meta_path):
        sys.meta_path.insert(0, BesideTheLab())


install()  # an import of this module is enough
