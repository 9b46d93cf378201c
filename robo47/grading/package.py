"""What travels to whoever grades: a few files as bytes, and what git said of them."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath

from robo47.checker.deliverables import Item


@dataclass(frozen=True)
class Package:
    """One submission, without the student's name.

    Attributes:
        day: its number.
        kit: fingerprint of the kit that collected it; no other may grade it.
        files: content by path from the top of the clone, with "/" as separator.
        unread: why a file that is there was not read, by path.
        commit_item: the deliverable "commit", which only the clone can tell.
        commit: the hash of the last commit; "" without one.
        committed: its time, seconds since 1970; None without one.
        problem: why there is nothing to grade; "" where there is.
    """

    day: int
    kit: str
    files: Mapping[str, bytes] = field(default_factory=dict)
    unread: Mapping[str, str] = field(default_factory=dict)
    commit_item: Item = field(default_factory=lambda: Item("commit", "todo"))
    commit: str = ""
    committed: int | None = None
    problem: str = ""

    @property
    def fingerprint(self) -> str:
        """A hash of all that the grade depends on, but for the kit."""
        item = self.commit_item
        facts = [
            self.day,
            sorted((name, _hash(data)) for name, data in self.files.items()),
            sorted(self.unread.items()),
            [item.name, item.status, item.message, self.commit, self.committed],
            self.problem,
        ]
        return _hash(json.dumps(facts).encode("ascii"))

    def unpack(self, folder: Path) -> None:
        """Write the files below a folder; one that cannot exist here is left out.

        Args:
            folder: a new one; no path leads out of it.
        """
        for name, data in self.files.items():
            parts = PurePosixPath(name).parts
            if not parts or parts[0] == "/" or ".." in parts:
                continue
            path = folder.joinpath(*parts)
            try:
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(data)
            except (OSError, ValueError):  # a picture's name, from another system
                continue


def _hash(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()
