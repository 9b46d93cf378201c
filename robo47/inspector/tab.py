"""What a tab is, and how the tabs of a day are found in its own folder."""

import importlib.util
import sys
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Protocol

from robo47.checks import Array
from robo47.errors import Robo47Error
from robo47.inspector.ghost import Ghost
from robo47.paths import shown

if TYPE_CHECKING:
    from robo47.inspector.page import Page

FILE = "inspector.py"


class Tab:
    """One tab of the page; see `robo47.inspector` for what to write in it.

    Attributes:
        title: on the tab.
        wide: the tab needs the room of the two matrices above it.
    """

    title = "a tab"
    wide = False

    def __init__(self, page: "Page") -> None:
        """Open the tab: make its widgets and drawings.

        Args:
            page: what it makes them with.
        """
        self.page = page

    def on_move(self, q: Array) -> None:
        """Show the configuration that the arm has now.

        Args:
            q: radians and metres, (nq,).
        """

    def close(self) -> None:
        """Leave the tab; what `page` made is removed after this."""


class TabType(Protocol):
    """A class of tabs."""

    title: str
    wide: bool

    def __call__(self, page: "Page") -> Tab:
        """Open it."""


class DayTabs:
    """What a day brings to the page.

    Attributes:
        ghost: which function draws the student's arm; None for none.
        tabs: in the day's order.
    """

    def __init__(self, ghost: Ghost | None, tabs: list[type[Tab]]) -> None:
        """Keep both."""
        self.ghost, self.tabs = ghost, tabs


def day_tabs(folder: Path) -> DayTabs:
    """Return what the `inspector.py` of a day's folder brings; nothing where none is.

    Args:
        folder: of the day, such as w1-foundations/day2.

    Raises:
        Robo47Error: it does not load, or TABS and GHOST are not what they should be.
    """
    path = folder / FILE
    if not path.is_file():
        return DayTabs(None, [])
    module = _load(path)
    ghost, tabs = getattr(module, "GHOST", None), list(getattr(module, "TABS", []))
    if ghost is not None and not isinstance(ghost, Ghost):
        raise Robo47Error(f"{shown(path)}: GHOST is not a robo47.inspector.ghost.Ghost")
    for tab in tabs:
        if not (isinstance(tab, type) and issubclass(tab, Tab)):
            raise Robo47Error(
                f"{shown(path)}: {tab!r} in TABS is not a class of robo47.inspector.tab.Tab"
            )
    return DayTabs(ghost, tabs)


def _load(path: Path) -> ModuleType:
    name = f"robo47_tabs_{path.parent.name}"
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module  # dataclasses in it look themselves up
    try:
        spec.loader.exec_module(module)
    except Exception as error:
        raise Robo47Error(
            f"{shown(path)} does not load: {type(error).__name__}: {error}"
        ) from error
    return module
