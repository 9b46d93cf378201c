"""State of one deliverable."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Item:
    """One line of the day."""

    name: str  # "figure", "definitions", ...
    status: str = "passed"  # or "todo" (not there yet), "wrong" (there, but)
    message: str = ""  # what to do; "" when passed

    @property
    def passed(self) -> bool:
        """Whether nothing is left to do."""
        return self.status == "passed"
