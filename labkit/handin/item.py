"""State of one deliverable."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Item:
    """One line of the day.

    Attributes:
        name: "figure", "definitions", ...
        status: "passed", "todo" (not there yet) or "wrong" (there, but).
        message: what to do; "" when passed.
    """

    name: str
    status: str = "passed"
    message: str = ""

    @property
    def passed(self) -> bool:
        """Whether nothing is left to do."""
        return self.status == "passed"
