"""A day's Python files, imported by path: the machine names no day.

`w1-foundations/dayN/gains.py` becomes the module `lesson_dayN.gains`; files of
one day import each other as `from .mistakes import ...`.
"""

import importlib
import sys
import traceback
import types
from functools import cache, lru_cache
from pathlib import Path
from types import CodeType, ModuleType
from typing import Any

from labkit.lesson.day import Day
from labkit.lesson.starter import read_script
from robo47.errors import Robo47Error
from robo47.paths import shown


def has(day: Day, name: str) -> bool:
    """Return whether a day brings a file or a folder of that name, "inspector" say."""
    return (day.own / f"{name}.py").is_file() or (day.own / name).is_dir()


def load(day: Day, name: str) -> ModuleType:
    """Return a module of a day's folder, "gains".

    Raises:
        Robo47Error: the day has no such file, or it stops while it is loaded.
    """
    if not has(day, name):
        raise Robo47Error(f"{shown(day.own / name)}.py is not there")
    package = f"lesson_day{day.number}"
    known = sys.modules.get(package)
    if known is None or list(known.__path__) != [str(day.own)]:
        for module in [m for m in sys.modules if m.partition(".")[0] == package]:
            del sys.modules[module]
        sys.modules[package] = types.ModuleType(package)
        sys.modules[package].__path__ = [str(day.own)]
    try:
        return importlib.import_module(f"{package}.{name}")
    except ModuleNotFoundError:  # a package that a picture or a page needs
        raise
    except Exception as error:
        last = traceback.extract_tb(error.__traceback__)[-1]
        where = f" ({Path(last.filename).name}, line {last.lineno})"
        where = "" if isinstance(error, SyntaxError) else where  # it says so itself
        why = f"{type(error).__name__}: {error}{where}"
        file = shown(day.own / name)
        raise Robo47Error(f"{file}.py does not load: {why}") from error


def offered(day: Day, name: str, lab: Path | None = None) -> dict[str, Any]:
    """Return what a day's figures.py or films.py offers: {"dayN_name": function}.

    Args:
        day: {} where it has no such file.
        name: "figures", for FIGURES.
        lab: the script that the file imports from; by default the kit's.
    """
    if not has(day, name):
        return {}
    source = str((lab or day.source).parent)
    if source not in sys.path:
        sys.path.insert(0, source)
    found = getattr(load(day, name), name.upper(), None)
    if not isinstance(found, dict):
        file = f"{shown(day.own)}/{name}.py"
        raise Robo47Error(f"{file} has no {name.upper()}: {{name: function}}")
    return {f"day{day.number}_{key}": made for key, made in found.items()}


@cache
def lab(day: Day) -> ModuleType:
    """Return a day's complete lab as a module, one for all who ask; see `load_lab`."""
    return load_lab(day.source)


def load_lab(script: Path) -> ModuleType:
    """Return a lab script as a module of its own, in the kit's Python: this one."""
    module = ModuleType(script.stem)
    module.__file__ = str(script)
    exec(_code(read_script(script), str(script)), vars(module))
    return module


@lru_cache(maxsize=16)
def _code(text: str, name: str) -> CodeType:
    return compile(without_kit(text), name, "exec")


def without_kit(text: str) -> str:
    """Return a lab's text without its first import, which leads to the kit's Python."""
    return text.replace("\nimport kit ", "\n# ")
