"""A lab script read and loaded: as text, and as a module in the kit's Python."""

import ast
from functools import cache, lru_cache
from pathlib import Path
from types import CodeType, ModuleType

from labkit.lesson import day_mujoco  # noqa: F401 (a lab's import needs it)
from labkit.lesson.day import Day, find_day
from labkit.lesson.sealed import opened
from robo47.errors import Robo47Error
from robo47.paths import shown


def read_script(path: Path) -> str:
    """Return a script's text in UTF-8, of a sealed one the complete lab's."""
    try:
        return opened(path.read_text("utf-8-sig"))
    except FileNotFoundError:
        raise Robo47Error(f"{shown(path)} is not there") from None
    except UnicodeDecodeError:
        raise Robo47Error(f"{shown(path)} is not in UTF-8: save it as such") from None
    except OSError as error:
        raise Robo47Error(f"{shown(path)} cannot be read: {error.strerror}") from None


@cache
def lab_of(day: Day) -> ModuleType:
    """Return a day's complete lab as a module, one for all who ask; see `load_lab`."""
    return load_lab(day.source)


def complete_lab(number: int) -> ModuleType:
    """Return the complete lab of the day with this number, as `lab_of` does."""
    return lab_of(find_day(number))


def definition(text: str, name: str) -> ast.FunctionDef | None:
    """Return a function of a lab's text as it is written; None where it has none."""
    some = (node for node in ast.parse(text).body if isinstance(node, ast.FunctionDef))
    return next((node for node in some if node.name == name), None)


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
