"""A tab that a day declares: sliders, the student's functions, the drawing, a verdict.

The page for authors (docs/authors.md) has an example, which a test runs.

The base class makes the widgets, then a place for the lines, then the drawings, each
in the order of the class. It calls `ask` on a thread whenever a slider, the arm or the
file changes, and shows the newest answers. Where a function of the student's stops,
hangs or returns no numbers, it empties all texts, bars and plots, hides what `ui.yours`
made, and calls `show` with the library's answer for both. A line is green where each
function behind it is the student's and agrees with the library's, and red where one
does not; True and False in place of the names are for what the tab judges itself.

`ui.panel.bars(...)` is `Page.bars(...)`, and `ui.scene.lines(...)` is
`Sketch.lines(...)`, made when the tab is opened. `then="press"` of a control names the
method that is called at a change, in place of a new question. `prepare()` makes what
needs the page.

A tab with a motion has `advance(seconds)`, which computes the next picture's state on
a thread and may call `self.own`, and `frame(seconds)`, which draws it and returns False
at the end. `restart()` goes back to the start, when the tab is opened and after a save.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType, SimpleNamespace
from typing import TYPE_CHECKING, Any

import numpy as np

from labkit.inspector import words
from labkit.inspector.draw import COLOURS
from labkit.inspector.own import Library
from labkit.inspector.tab import PLAYS, Tab
from robo47.checks import Array

if TYPE_CHECKING:
    from labkit.inspector.animate import Animation
    from labkit.inspector.page import Page

NOWHERE = np.zeros((1, 2, 3))  # the points of lines and arrows that are not yet known
Says = Iterable[tuple[str, str | bool | None]]


class Piece:
    """What a class declares: made for the tab when it is opened."""

    def make(self, tab: "Declared", name: str) -> None:
        """Make it, as the tab's attribute of that name."""
        raise NotImplementedError


@dataclass(frozen=True)
class Control(Piece):
    """A widget that a person moves; the attribute of its name is its value."""

    kind: str  # the method of `Page` that makes it
    args: tuple[Any, ...]
    start: Any
    then: str = ""  # the method that is called at a change, instead of `on_move`
    named: Mapping[str, Any] = field(default_factory=dict)

    def make(self, tab: "Declared", name: str) -> None:
        """Add it to the page."""
        tab._values.append(name)
        setattr(tab, name, self.start)
        change = tab.sets(name, self.then)
        made = getattr(tab.page, self.kind)(*self.args, change, **self.named)
        tab.widgets[name] = made


def slider(
    label: str, low: float, high: float, start: float, unit: str = "rad",
    step: float = 0.01, then: str = "",
) -> Any:  # fmt: skip
    """Declare a slider; see `Page.slider`. `then` names a method for a change."""
    given = (label, low, high, start)
    return Control("slider", given, start, then, {"unit": unit, "step": step})


def choice(label: str, options: Iterable[str], then: str = "") -> Any:
    """Declare a drop-down; its first option is chosen."""
    options = list(options)
    return Control("choice", (label, options), options[0], then)


def tick(label: str, then: str = "") -> Any:
    """Declare a check box, unticked."""
    return Control("tick", (label,), False, then)


def buttons(*texts: str, then: str) -> Any:
    """Declare a row of buttons: the attribute is the text of the one pressed last."""
    return Control("buttons", (texts,), "", then)


@dataclass(frozen=True)
class Shown(Piece):
    """Something that is shown: what a method of the page, or of its sketch, returns."""

    of: str  # "panel", "scene" or "yours"
    kind: str  # the method
    args: tuple[Any, ...]
    named: Mapping[str, Any]
    legend: str = ""

    def make(self, tab: "Declared", name: str) -> None:
        """Make it for an opened tab."""
        maker = tab.page if self.of == "panel" else tab.page.draw
        made = getattr(maker, self.kind)(*self.args, **self.named)
        setattr(tab, name, made)
        tab._shown.append((self, made))
        if self.legend:
            colour = next(x for x in self.args if isinstance(x, str) and x in COLOURS)
            tab._colours[self.legend] = colour

    def empty(self, made: Any) -> None:
        """Take away what the student's functions gave."""
        if self.of == "yours":
            made.visible = False
        elif self.kind == "html":
            made.content = ""
        elif self.kind in ("bars", "plot"):
            made.clear()


@dataclass(frozen=True)
class Maker:
    """Declares parts: each method of the page, or of its sketch, by its own name."""

    of: str

    def __getattr__(self, kind: str) -> Callable[..., Any]:
        """Return what declares a part; `legend` says what its colour means."""
        return lambda *args, legend="", **named: Shown(
            self.of, kind, args, named, legend
        )


panel = Maker("panel")  # bars, plot, image, html, robot: as `Page` has them
scene = Maker("scene")  # arrows, lines, sphere, ghost, ...: as `Sketch` has them
yours = Maker("yours")  # the same, from the student's answers: hidden where none came


@dataclass(frozen=True)
class Handle(Piece):
    """A pose that the mouse drags, which starts at the hand."""

    then: str

    def make(self, tab: "Declared", name: str) -> None:
        """Draw it."""
        made = tab.page.draw.target(tab.page.pose("ee"), getattr(tab, self.then))
        setattr(tab, name, made)


def handle(then: str) -> Any:
    """Declare a pose to drag; the method of that name is given it, (4, 4)."""
    return Handle(then)


class Declared(Tab):
    """A tab that says what it has; see the module's text."""

    wide = True
    library: Any = MappingProxyType(
        {}
    )  # the module with the reference, or {name: function}
    # the student's, {name: unit of what it returns}
    functions: Mapping[str, str] = MappingProxyType({})
    free: tuple[str, ...] = ()  # of those, what has more than one right answer
    any_rows: tuple[str, ...] = ()  # of those, what may have any number of rows
    arm_hidden = False  # whether the page's arm is not drawn
    hz = 30.0  # pictures a second
    plays = PLAYS  # seconds that the motion plays by itself

    def __init__(self, page: "Page") -> None:
        """Make what the class declares."""
        super().__init__(page)
        self._values: list[str] = []  # the names of the controls
        self.widgets: dict[str, Any] = {}  # the controls themselves
        self._shown: list[tuple[Shown, Any]] = []
        self._colours: dict[str, str] = {}
        self._found: tuple[Any, Any] | None = None  # the last answers
        self._reference: Any = None  # the library's last answer
        self.emptied = False  # whether the student's functions gave none since
        self.right = Library(self.library)
        self.own: Any = self.right
        if self.functions:
            given = {"free": self.free, "any_rows": self.any_rows}
            self.own = page.own(self.library, **given, units=self.functions)
        self._make(Control)
        self.verdict = page.html()
        page.light("ee", {"ee"})
        if self.arm_hidden:
            page.hide_arm()
        self._make(Shown, Handle)
        self.loop: Any = self._loop()
        page.legend(self._colours)
        self.prepare()

    def _make(self, *kinds: type[Piece]) -> None:
        for name, piece in self.declared().items():
            if isinstance(piece, kinds):
                piece.make(self, name)

    @classmethod
    def declared(cls) -> dict[str, Piece]:
        """Return what the class declares, its bases' first, {attribute: piece}."""
        found: dict[str, Piece] = {}
        for kind in reversed(cls.__mro__):
            found |= {n: x for n, x in vars(kind).items() if isinstance(x, Piece)}
        return found

    def _loop(self) -> "Animation | None":
        """Return the motion; None where the class has none."""
        kind = type(self)
        if kind.frame is Declared.frame:
            return None
        work = None if kind.advance is Declared.advance else self.advance
        return self.page.animate(self._frame, self.hz, work=work)

    # What a day writes

    def prepare(self) -> None:
        """Make what needs the page, such as the state at the start."""

    def ask(self, fns: Any, at: SimpleNamespace) -> Any:
        """Return what is shown, by the functions `fns`; it may wait for them.

        `at` has the controls' values by their names, and the arm's `q`.
        """

    def show(self, yours: Any, right: Any) -> None:
        """Draw what `ask` returned with the student's functions and the library's."""

    def says(self, yours: Any, right: Any) -> Says:
        """Yield each line of the verdict, and what decides about its colour.

        That is the names of the functions behind it, or True for a right one, False
        for a wrong one, None for a line without a verdict.
        """
        return ()

    def legend(self, what: str, colour: str) -> None:
        """Say what a colour means, of what `prepare` has drawn."""
        self._colours[what] = colour
        self.page.legend(self._colours)

    def restart(self) -> None:
        """Go back to the start of the motion."""

    def advance(self, seconds: float) -> None:
        """Compute the state of the next picture; it may wait for `self.own`."""

    def frame(self, seconds: float) -> bool | None:
        """Draw that state; return False for the last picture."""
        return None

    # What the page calls

    def sets(self, name: str, then: str = "") -> Callable[[Any], None]:
        """Return what a control calls: it keeps the value, and all is shown anew."""

        def changed(value: Any) -> None:
            setattr(self, name, value)
            if then:
                getattr(self, then)()
            else:
                self.on_move(self.page.q)

        return changed

    def at(self) -> SimpleNamespace:
        """Return the controls' values and the arm's configuration."""
        values = {name: getattr(self, name) for name in self._values}
        return SimpleNamespace(**values, q=self.page.q)

    def on_move(self, q: Array) -> None:
        """Ask again: the arm or a control was moved, or the file may be another."""
        self.request()

    def request(self) -> None:
        """Ask the student's functions, and the library's, for what is shown."""
        if self.asks:
            at = self.at()
            self.page.job(lambda: self.both(at), self.answered)

    @property
    def asks(self) -> bool:
        """Whether the class has `ask`."""
        return type(self).ask is not Declared.ask

    def both(self, at: SimpleNamespace) -> tuple[SimpleNamespace, Any, Any]:
        """Return the student's answer and the library's; it waits."""
        self._reference = right = self.ask(self.right, at)
        return at, self.ask(self.own, at), right

    def answered(self, found: tuple[SimpleNamespace, Any, Any]) -> None:
        """Show the answers, unless a control has been moved meanwhile."""
        at, *answers = found
        if all(getattr(at, name) == getattr(self, name) for name in self._values):
            self._found = (answers[0], answers[1])
            self.reveal()
            self.show(*self._found)
            self.tell()

    def _frame(self, seconds: float) -> bool | None:
        self.reveal()
        more = self.frame(seconds)
        self.tell()
        return more

    def tell(self) -> None:
        """Show the lines of the verdict, each in its colour."""
        if self.asks and self._found is None:
            return
        lines = self.says(*(self._found or (None, None)))
        self.verdict.content = "".join(
            words.line(text, f"says-{k}", self.kind_of(of))
            for k, (text, of) in enumerate(lines)
        )

    def kind_of(self, of: str | bool | None) -> str:
        """Return the kind of a line, see `words.line`, by what decides about it."""
        if isinstance(of, str):
            return self.own.kind(of.split())
        return "" if of is None else "good" if of else "bad"

    def begin(self) -> None:
        """Play the motion from its start."""
        if self.loop is not None:
            self.loop.stop()
            self.restart()
            self.loop.start(self.plays)

    def reveal(self) -> None:
        """Draw again what `lost` hid."""
        if self.emptied:
            self.emptied = False
            for piece, made in self._shown:
                if piece.of == "yours":
                    made.visible = True

    def lost(self) -> None:
        """Show the library's answer alone: a function of the student's gave none."""
        self._found, self.emptied = None, True
        if self._reference is not None:
            self.show(self._reference, self._reference)
        self.verdict.content = ""
        for piece, made in self._shown:
            piece.empty(made)


class Played(Declared):
    """A tab whose answer is a motion: it plays when the answer has come."""

    def begin(self) -> None:
        """Wait for the answer; `show` calls `play`."""

    def play(self) -> None:
        """Draw the start of the answer, and play on unless the answer is missing."""
        self.frame(0.0)
        self.loop.stop()
        if not self.emptied:
            self.loop.start()
