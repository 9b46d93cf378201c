"""Text that somebody else wrote, made fit for a terminal, a file and a table.

A submission's words (an exception's message, a printed line, a file's name) may hold
escape sequences, letters that turn the reading direction, line breaks that look like
lines of ours, or a megabyte. All of it passes through here at the border.
"""

import unicodedata

LENGTH, LINE = 500, 200  # characters
# What a terminal or a page obeys instead of showing it: controls, line and paragraph
# separators, and format characters, which include those of the reading direction.
_OBEYED = {"Cc", "Cf", "Zl", "Zp"}


def visible(text: object, length: int = LENGTH) -> str:
    """Return text as one harmless line.

    Args:
        text: anything; what is no string is put into words by `str`.
        length: characters to keep; "..." stands for the rest.

    Returns:
        Controls, format characters and line breaks as spaces, unpaired surrogates and
        unassigned code points as "?", no space at either end.
    """
    whole = str(text)
    shown = "".join(map(_one, whole[: 2 * length + 2])).strip()
    if len(shown) <= length and len(whole) <= 2 * length + 2:
        return shown
    return shown[:length] + "..."


def visible_lines(text: object, lines: int = 40) -> str:
    """Return text of several lines as so many lines that are each harmless."""
    whole = str(text)[: 2 * lines * LINE]
    return "\n".join(visible(line, LINE) for line in whole.splitlines()[:lines])


def _one(character: str) -> str:
    if character.isascii():
        return character if character.isprintable() else " "
    category = unicodedata.category(character)
    if category in _OBEYED:
        return " "
    return "?" if category in ("Cs", "Cn", "Co") else character
