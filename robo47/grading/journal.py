"""Every result, kept as it comes: a line of JSON each, on the disk before the next.

A run that was killed, even by a power cut, goes on from here. A last line that was
cut off is left out and its student graded again.
"""

import contextlib
import json
import os
from pathlib import Path
from typing import Any

from robo47.errors import Robo47Error
from robo47.grading.package import Package
from robo47.grading.result import Result, from_json
from robo47.paths import shown

KIND = "robo47 grading"


class Journal:
    """The results of one class and day.

    Attributes:
        reference: the time that "minutes since last commit" counts to, seconds since
            1970.
        deadline: whether that is the deadline, and not when the first run began.
        kits: fingerprints of the kits that graded.
    """

    def __init__(self, path: Path, day: int, reference: int, *, deadline: bool) -> None:
        """Read what is there and open it for more.

        Args:
            path: the file.
            day: its number; results of another day are refused.
            reference: see above.
            deadline: see above; any other reference gives way to one that is there.

        Raises:
            Robo47Error: the file cannot be written, or is another day's.
        """
        self.path, self.reference, self.deadline = path, reference, deadline
        self.kits: set[str] = set()
        self._results: dict[str, tuple[str, Result]] = {}
        known = self._read(day)
        try:
            self._file = path.open("ab")
        except OSError as error:
            raise Robo47Error(
                f"{shown(path)} cannot be written: {error.strerror}"
            ) from None
        if not known or (deadline and reference != self.reference):
            self.reference, self.deadline = reference, deadline
            head = {"reference": reference, "deadline": deadline}
            self._append({"kind": KIND, "day": day, **head})

    def find(self, folder: str, package: Package) -> Result | None:
        """Return a student's result, unless what they hand in has changed since.

        Args:
            folder: the student's.
            package: what they hand in now.
        """
        fingerprint, result = self._results.get(folder, ("", None))
        return result if fingerprint == package.fingerprint else None

    def keep(self, folder: str, package: Package, result: Result) -> None:
        """Write a result and wait until the disk has it."""
        fingerprint = package.fingerprint
        self._results[folder] = (fingerprint, result)
        self._append(
            {
                "folder": folder,
                "package": fingerprint,
                "kit": package.kit,
                "result": result.to_json(),
            }
        )

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    def _append(self, record: dict[str, Any]) -> None:
        # The line break comes first, so that a cut line never swallows the next one.
        self._file.write(b"\n" + json.dumps(record).encode("ascii"))
        self._file.flush()
        os.fsync(self._file.fileno())

    def _read(self, day: int) -> bool:
        """Take over what the file holds; return whether it began as a journal."""
        try:
            lines = self.path.read_bytes().splitlines()
        except FileNotFoundError:
            return False
        except OSError as error:
            raise Robo47Error(
                f"{shown(self.path)} cannot be read: {error.strerror}"
            ) from None
        known = False
        for line in lines:
            with contextlib.suppress(ValueError, KeyError, TypeError, AttributeError):
                known |= self._take(json.loads(line), day)
        return known

    def _take(self, record: dict[str, Any], day: int) -> bool:
        """Take over one record; return whether it is a header."""
        if record.get("kind") == KIND:
            if record["day"] != day:
                raise Robo47Error(
                    f"{shown(self.path)} holds day {record['day']}: give day {day} a "
                    f"folder of its own, such as --out grades-day{day}/grades.csv"
                )
            self.reference = int(record["reference"])
            self.deadline = bool(record["deadline"])
            return True
        self._results[record["folder"]] = (
            record["package"],
            from_json(record["result"]),
        )
        self.kits.add(record["kit"])
        return False
