"""Text of the kit's: counts, blocks of documents, and what somebody else wrote.

A submission's words (an exception's message, a printed line, a file's name) may hold
escape sequences, letters that turn the reading direction, line breaks that look like
lines of ours, or a megabyte. All of it passes through `visible` at the border.

A block of a document is filled anew; every other byte stays as it is:

<!-- name: request -->
what is written anew
<!-- end -->
"""

import re
import unicodedata
from collections.abc import Callable, Mapping

# Maps a request and the old content to the new content.
Maker = Callable[[str, str], str]

LENGTH, LINE = 500, 200  # characters
_END = "<!-- end -->"  # the last line of a block
# A terminal or a page obeys these instead of showing them: controls, line and paragraph
# separators, and format characters, which include those of the reading direction.
_OBEYED = {"Cc", "Cf", "Zl", "Zp"}


def count(number: int, thing: str) -> str:
    """Return "1 row", "2 rows", "1,000 rows"."""
    return f"{number:,} {thing}" if number == 1 else f"{number:,} {thing}s"


def number_of(value: float) -> str:
    """Return a number as a lab prints it: rounding errors short, others readable."""
    if value != value or abs(value) < 1e-3 or abs(value) >= 1e4:
        return f"{value:.1e}" if value else "0"
    return f"{value:.4g}"


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
    kept = whole[: 2 * length + 2]
    plain = kept.isascii() and kept.isprintable()  # most texts are plain
    shown = (kept if plain else "".join(map(_one, kept))).strip()
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


def refill(document: str, makers: Mapping[str, Maker]) -> str:
    """Return a document with new contents of its blocks, in its own line ends."""

    def fresh(block: re.Match[str]) -> str:
        opening, name, request, newline, old, closing = block.groups()
        new = makers[name](request or "", old).replace("\r\n", "\n")
        return opening + new.replace("\n", newline) + closing

    closed, rest = _closed_blocks(document)
    return _pattern(*makers).sub(fresh, closed) + rest


def blocks(document: str, name: str) -> list[str]:
    """Return what the blocks of a name hold."""
    return [found[4] for found in _pattern(name).findall(_closed_blocks(document)[0])]


def _closed_blocks(document: str) -> tuple[str, str]:
    """Return a document up to its last end of a block, and the rest.

    Each of a thousand openings without an end would be followed to the last line.
    """
    closed, end, rest = document.rpartition(_END)
    return closed + end, rest


def _pattern(*names: str) -> re.Pattern[str]:
    opening = rf"<!-- ({'|'.join(names)})(?:: ([^<\n]+?))? -->[ \t]*(\r?\n)"
    return re.compile(rf"({opening})(.*?)({_END})", re.DOTALL)
