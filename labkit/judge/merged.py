"""Adjacent ranges of one quantity in a list of cases, told as one range.

"Angles below 0.02 rad" and "angles from 0.02 to 2 rad" are "angles below 2 rad".
"""

import re
from collections.abc import Sequence
from typing import NamedTuple

_RANGE = re.compile(r"(.+?) (?:below (.+)|above (.+)|from (.+) to (.+))")


class Range(NamedTuple):
    """A phrase on a range: "angles from 0.02 to 2 rad". A limit is None without one."""

    what: str  # "angles"
    low: str | None  # "0.02 rad"
    high: str | None  # "2 rad"

    @property
    def phrase(self) -> str:
        """The range in words; the unit of both limits is said once."""
        if self.low is None:
            return f"{self.what} below {self.high}"
        if self.high is None:
            return f"{self.what} above {self.low}"
        (low, unit), (_, other) = _split(self.low), _split(self.high)
        first = low if unit == other else self.low
        return f"{self.what} from {first} to {self.high}"


def merged(phrases: Sequence[str]) -> list[str]:
    """Return phrases, in which ranges that begin where the last one ends are one."""
    found: list[str] = []
    for phrase in phrases:
        before, one = _range(found[-1]) if found else None, _range(phrase)
        if before and one and _meet(before, one):
            found[-1] = Range(one.what, before.low, one.high).phrase
        else:
            found.append(phrase)
    return found


def _meet(before: Range, one: Range) -> bool:
    """Return whether a range begins where another ends.

    Of "below 1" and "above 1" neither has the limit itself, so they are two.
    """
    if before.what != one.what or before.high is None or before.high != one.low:
        return False
    return before.low is not None or one.high is not None


def _range(phrase: str) -> Range | None:
    """Return a phrase as a range; None where it is none."""
    found = _RANGE.fullmatch(phrase)
    if not found:
        return None
    what, below, above, low, high = found.groups()
    if low is None:
        return Range(what, above, below)
    unit = _split(high)[1]
    return Range(what, low if _split(low)[1] else f"{low} {unit}".strip(), high)


def _split(limit: str) -> tuple[str, str]:
    """Return a limit's number and its unit, "" where it has none."""
    number, _, unit = limit.partition(" ")
    return number, unit
