"""What each number must reach, read from the weeks' manifests."""

import tomllib
from pathlib import Path
from typing import NamedTuple

from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown


class Threshold(NamedTuple):
    """The range a value must be in; None is no bound."""

    day: int
    max: float | None
    min: float | None

    def passes(self, value: float | None) -> bool:
        """Return whether a value is inside; NaN and no value never are."""
        if value is None or value != value:
            return False
        high_enough = self.min is None or value >= self.min
        return high_enough and (self.max is None or value <= self.max)

    def __str__(self) -> str:
        """Return it as people write it."""
        parts = []
        if self.min is not None:
            parts.append(f"≥ {self.min:g}")
        if self.max is not None:
            parts.append(f"≤ {self.max:g}")
        return ", ".join(parts)


def load(root: Path = ROOT) -> dict[tuple[str, str], Threshold]:
    """Return the thresholds by (check, metric); empty where no manifest has any.

    Args:
        root: the clone; its manifests are `w*/week.toml`.

    Raises:
        Robo47Error: a manifest that cannot be read, by name.
    """
    found = {}
    for path in sorted(root.glob("w*/week.toml")):
        try:
            manifest = tomllib.loads(path.read_text("utf-8"))
            for day in manifest.get("days", []):
                for entry in day.get("metrics", []):
                    found[entry["check"], entry["metric"]] = _threshold(day, entry)
        except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
            raise Robo47Error(
                f"{shown(path)}: [[days.metrics]] cannot be read: {error!r}. Each needs"
                " check, metric, and max or min."
            ) from None
    return found


def _threshold(day: dict, entry: dict) -> Threshold:
    low, high = entry.get("min"), entry.get("max")
    return Threshold(
        int(day["number"]),
        None if high is None else float(high),
        None if low is None else float(low),
    )
