"""A tab of the page, and the tabs of a day, found in its own folder."""

from typing import TYPE_CHECKING, NamedTuple

from labkit.inspector.ghost import Ghost
from labkit.lesson.day import Day
from robo47.checks import Array
from robo47.errors import Robo47Error
from robo47.paths import shown

if TYPE_CHECKING:
    from labkit.inspector.page import Page
    from labkit.inspector.scene import View
    from labkit.inspector.standing import Standing

FILE = "inspector"
PLAYS = 6.0  # seconds that a tab plays by itself


class Tab:
    """One tab of the page; see `labkit.inspector` for what to write in it."""

    title = "a tab"
    wide = False  # whether it needs the room of the two matrices above it
    solid = True  # whether the arm is solid when the tab is opened
    # From where one looks, and at what, metres; aimed beside the arm, since the panel
    # covers the right third of the page.
    camera: "View" = ((1.75, -1.45, 0.95), (0.42, 0.24, 0.4))

    def __init__(self, page: "Page") -> None:
        """Open the tab: make its widgets and drawings."""
        self.page = page

    def on_move(self, q: Array) -> None:
        """Show the configuration that the arm has now; radians and metres, (nq,)."""

    def begin(self) -> None:
        """Play what the tab has to show: it was opened, or the file was saved.

        For `PLAYS` seconds, unless it ends by itself: nobody has to press anything.
        """

    def judged(self, standing: "Standing") -> None:
        """Hear what the checker says of the file now, or that it is at work."""

    def lost(self) -> None:
        """Show no numbers: the student's function gave none."""

    def close(self) -> None:
        """Leave the tab; what `page` made is removed after this."""


class DayTabs(NamedTuple):
    """What a day brings to the page."""

    ghost: Ghost | None  # the function that draws the student's arm
    tabs: list[type[Tab]]  # in the day's order


def day_tabs(day: Day) -> DayTabs:
    """Return what the `inspector.py` of a day's folder brings; nothing where none is.

    Raises:
        Robo47Error: it does not load, or TABS and GHOST are not what they should be.
    """
    if not day.has(FILE):
        return DayTabs(None, [])
    where = f"{shown(day.own / FILE)}.py"
    try:
        module = day.module(FILE)
    except ModuleNotFoundError as error:
        why = f"ModuleNotFoundError: {error}"
        raise Robo47Error(f"{where} does not load: {why}") from error
    ghost = getattr(module, "GHOST", None)
    tabs = getattr(module, "TABS", [])
    if not isinstance(tabs, list | tuple):
        raise Robo47Error(f"{where}: TABS is no list; write TABS = [YourTab]")
    if ghost is not None and not isinstance(ghost, Ghost):
        raise Robo47Error(f"{where}: GHOST is not a labkit.inspector.ghost.Ghost")
    for tab in tabs:
        if not (isinstance(tab, type) and issubclass(tab, Tab)):
            raise Robo47Error(
                f"{where}: {tab!r} in TABS is not a class of labkit.inspector.tab.Tab"
            )
    return DayTabs(ghost, list(tabs))
