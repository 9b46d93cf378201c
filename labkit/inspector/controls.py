"""The page's own controls, as HTML, and who listens to them.

A control has a name; what a person does to it arrives here as (name, text), whatever
browser it comes from, and is given to the one function that listens. What a control
shows is `values[name]`, sent to every browser with the rest of the state: a control
never shows what the server refused. Every word from a browser has a number, and the
state says which one it knows of: a browser leaves out a state older than its own word.
"""

import json
from collections.abc import Callable, Iterable
from html import escape

from labkit.inspector.typed import number

Listener = Callable[[str], None]


class Controls:
    """Names, listeners and shown values of the controls that are on the page."""

    def __init__(self) -> None:
        """Begin without controls: `listen` brings one."""
        self.listeners: dict[str, Listener] = {}
        self.values: dict[str, str] = {}
        self.heard = 0

    def receive(self, name: str, value: str) -> int:
        """Give what a control sent to its listener; unknown names are nothing.

        Args:
            name: of the control.
            value: what it says; believed by nobody.

        Returns:
            The number of this word.
        """
        self.heard += 1
        if listener := self.listeners.get(name):
            listener(value)
        return self.heard

    def listen(self, name: str, listener: Listener, value: str | None = None) -> None:
        """Add a control.

        Args:
            name: unique on the page.
            listener: is given the text that it sends.
            value: what it shows at first; None for a button.
        """
        self.listeners[name] = listener
        if value is not None:
            self.values[name] = value

    def forget(self, names: Iterable[str]) -> None:
        """Drop controls that left the page."""
        for name in names:
            self.listeners.pop(name, None)
            self.values.pop(name, None)

    def state(self, address: str) -> str:
        """Return the hidden element that tells every browser what to show.

        Args:
            address: the query behind the page's address, "?q=...".
        """
        state = json.dumps(
            {"values": self.values, "address": address, "heard": self.heard}
        )
        return f'<div hidden data-r47-state="{escape(state)}"></div>'


def dial(
    name: str, label: str, low: float, high: float, unit: str, step: float = 0.01
) -> str:
    """Return a slider with a box for typing, as HTML.

    Args:
        name: of the control.
        label: what a person reads.
        low: the least value.
        high: the greatest.
        unit: behind the box.
        step: of an arrow key; Shift makes it ten times larger, Alt ten times smaller.
    """
    key, text = escape(name), escape(label)
    return (
        f'<div class="r47-dial"><span>{text}</span>'
        f'<input type="range" aria-label="{text}" data-r47="{key}" min="{low}" '
        f'max="{high}" step="any" data-step="{step}" title="{low} to {high} '
        f'{escape(unit)}; arrow keys: {step}, with Shift {10 * step:g}">'
        f'<input type="text" aria-label="{text} value" data-r47="{key}" '
        f'spellcheck="false" autocomplete="off"><i>{escape(unit)}</i></div>'
    )


def typed(text: str, label: str, low: float, high: float, unit: str) -> float:
    """Return the number that was typed into a dial.

    Args:
        text: what was typed.
        label: of the dial.
        low: the least value.
        high: the greatest.
        unit: such as "rad".

    Raises:
        ValueError: no number, or out of range; the message is for the person.
    """
    value = number(text)
    if not low <= value <= high:
        hint = "; for degrees write: 90 deg" if unit == "rad" else ""
        raise ValueError(
            f"{label}: {text.strip()} is outside {low:g} to {high:g} {unit}{hint}"
        )
    return value


def buttons(name: str, options: Iterable[str], chosen: str | None = None) -> str:
    """Return a row of buttons as HTML; each sends its text.

    Args:
        name: of the control.
        options: the buttons' texts.
        chosen: the one that is pressed in.
    """
    made = "".join(
        f'<button type="button" data-r47-click="{escape(name)}" '
        f'value="{escape(option)}" aria-pressed="{str(option == chosen).lower()}">'
        f"{escape(option)}</button>"
        for option in options
    )
    return f'<div class="r47-buttons">{made}</div>'


def tab_row(names: Iterable[str], chosen: str) -> str:
    """Return the row of tabs as HTML; each sends its name as control `tab`.

    Args:
        names: of the tabs.
        chosen: the open one.
    """
    made = "".join(
        f'<button type="button" role="tab" data-r47-click="tab" value="{escape(name)}" '
        f'aria-selected="{str(name == chosen).lower()}">{escape(name)}</button>'
        for name in names
    )
    return f'<div class="r47-tabs" role="tablist">{made}</div>'


def choice(name: str, label: str, options: Iterable[str]) -> str:
    """Return a drop-down as HTML.

    Args:
        name: of the control.
        label: what a person reads.
        options: to choose from.
    """
    made = "".join(f"<option>{escape(option)}</option>" for option in options)
    text = escape(label)
    return (
        f'<label class="r47-choice"><span>{text}</span>'
        f'<select aria-label="{text}" data-r47="{escape(name)}">{made}</select></label>'
    )


def tick(name: str, label: str) -> str:
    """Return a check box as HTML; it sends "true" or "false".

    Args:
        name: of the control.
        label: what a person reads.
    """
    return (
        f'<label class="r47-tick"><input type="checkbox" data-r47="{escape(name)}">'
        f"{escape(label)}</label>"
    )


def copy_button(label: str, text: str) -> str:
    """Return a button that copies a text.

    Args:
        label: on the button.
        text: what is copied.
    """
    return (
        f'<button type="button" class="r47-copy" data-r47-copy="{escape(text)}">'
        f"{escape(label)}</button>"
    )
