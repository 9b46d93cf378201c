"""A number that the log must have, and its range."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

Row = Mapping[str, Any]  # a row of the log, by column


@dataclass(frozen=True)
class Metric:
    """A row that the log must hold, and the range of its value; None is no bound."""

    check: str
    metric: str
    max: float | None = None
    min: float | None = None
    says: str = field(default="", compare=False)  # the quantity in words
    unit: str = field(default="", compare=False)

    @property
    def limit(self) -> str:
        """The range as people write it: "under 1e-08"."""
        parts = [] if self.min is None else [f"over {self.min:g}"]
        parts += [] if self.max is None else [f"under {self.max:g}"]
        return " and ".join(parts)

    def passes(self, value: float) -> bool:
        """Return whether a value is within the range; NaN never is."""
        high = self.max is None or value < self.max
        return value == value and high and (self.min is None or value > self.min)

    def judge(self, row: Row | None) -> str:
        """Return how a row of the log stands: "pass", "fail", or "none" without one.

        Nothing else in the kit decides this.
        """
        return "none" if row is None else "fail" if self.fault(row) else "pass"

    def fault(self, row: Row) -> str:
        """Return what is wrong with a row's number; "" where it is as it must be."""
        value = row["value"]
        if not isinstance(value, int | float) or not math.isfinite(value):
            return f"is {value}, not a number"
        if value < 0 and self.min is None:
            return f"is {value:.3g}, and an error is never negative"
        if not self.passes(value):
            return f"is {value:.3g}; it must be {self.limit}"
        if failures := row["n_failures"]:
            return f"failed in {failures} of {row['n_trials'] or '?'} trials"
        return ""
