"""A student's file that has a module's name: one is imported in place of the other.

A practice file `random.py` beside a lab is found before Python's own `random` by
whatever starts there, and after it by the kit, which looks beside the lab last.
"""

import sys
from importlib.machinery import PathFinder
from pathlib import Path

from labkit.base import cli
from robo47.paths import ROOT, shown

_KITS = {"robo47", "labkit"}


def clashes(folder: Path) -> list[Path]:
    """Return the files and packages of a folder that have the name of a module.

    Args:
        folder: in which the labs are; it need not be there.
    """
    if folder.resolve() == ROOT:  # the names there are the kit's
        return []
    found = [*folder.glob("*.py"), *(p.parent for p in folder.glob("*/__init__.py"))]
    return sorted(path for path in found if _is_taken(path.stem, folder))


def _is_taken(name: str, folder: Path) -> bool:
    """Return whether Python, or a package that is installed, has a module's name."""
    if name in sys.stdlib_module_names or name in _KITS:
        return True
    installed = [one for one in sys.path if "site-packages" in Path(one).parts]
    spec = PathFinder.find_spec(name, installed)
    return spec is not None and spec.origin is not None


def sentence(path: Path) -> str:
    """Return what is wrong with a file's name, and what to do."""
    better = path.with_name(f"my_{path.name}").name
    return (
        f"{shown(path)} has the name of a Python module, so one can be imported"
        f" in place of the other. Rename your file, for example to {better}."
    )


def tell(folder: Path) -> None:
    """Print a line on each such file of a folder."""
    for path in clashes(folder):
        cli.complain(f"note: {sentence(path)}")
