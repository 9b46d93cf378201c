"""Marked blocks of documents, filled anew; every other byte stays as it is.

<!-- name: request -->
what is written anew
<!-- end -->
"""

import re
from collections.abc import Callable, Mapping

Maker = Callable[[str, str], str]  # from the request and the old content to the new


def refill(document: str, makers: Mapping[str, Maker]) -> str:
    """Return a document with new contents of its blocks, in its own line ends."""

    def fresh(block: re.Match[str]) -> str:
        opening, name, request, newline, old, closing = block.groups()
        new = makers[name](request or "", old).replace("\r\n", "\n")
        return opening + new.replace("\n", newline) + closing

    return _pattern(*makers).sub(fresh, document)


def contents(document: str, name: str) -> list[str]:
    """Return what the blocks of a name hold."""
    return [found[4] for found in _pattern(name).findall(document)]


def _pattern(*names: str) -> re.Pattern[str]:
    opening = rf"<!-- ({'|'.join(names)})(?:: (.+?))? -->[ \t]*(\r?\n)"
    return re.compile(rf"({opening})(.*?)(<!-- end -->)", re.DOTALL)
