"""Every result, kept as it comes: a line of JSON each, on the disk before the next.

A run that was killed, even by a power cut, goes on from here. A line that was cut off,
or that is no result of the day, is left out and its student graded again. A fault of
the machine is no result and never written here.
"""

import contextlib
import json
import os
import secrets
import time
from dataclasses import asdict
from pathlib import Path
from typing import Any, NamedTuple, Protocol

from labkit.base.lock import lock
from labkit.grade.result import from_json
from labkit.lesson.day import Day
from robo47.errors import Robo47Error
from robo47.paths import shown

KIND = "robo47 grading"
_LATEST = 4_102_444_800  # the year 2100, in seconds since 1970
_ODD = (ValueError, KeyError, TypeError, AttributeError, OverflowError, RecursionError)


class Storable(Protocol):
    """The fields of a package, of any kind, that a journal needs."""

    @property
    def day(self) -> int:
        """The day's number."""

    @property
    def fingerprint(self) -> str:
        """A hash of all that the grade depends on, but for the kit."""

    @property
    def kit(self) -> str:
        """The fingerprint of the kit that collected it."""

    @property
    def commit(self) -> str:
        """The hash of the commit that counts; "" without one."""

    @property
    def committed(self) -> int | None:
        """Its time, seconds since 1970, or None."""


class StoredResult(NamedTuple):
    """A result, and what of somebody's package and the kit it was given to."""

    package: str  # fingerprints
    kit: str
    commit: str
    committed: int | None
    result: Any  # a `Result`, or what stands in its place in a journal of another kind


class Journal:
    """The results of one class for a day.

    Attributes:
        reference: the time that "minutes since last commit" counts to, seconds since
            1970.
        deadline: whether that is the deadline, and not when the first run began.
        seed: of the fresh inputs, the same for everybody; drawn at the first run.
        odd: lines that are no result.
        outdated: results that were not used, since another kit gave them.
    """

    def __init__(
        self,
        path: Path,
        day: Day,
        deadline: int | None = None,
        seed: int | None = None,
        **about: Any,
    ) -> None:
        """Open it for ourselves alone and read what is there.

        Args:
            path: the file.
            day: what is graded; a journal of another day is refused.
            deadline: seconds since 1970; None is the one that is there, if any.
            seed: see above; None is the one that is there, or a new one.
            about: what it is a journal of, besides the day: other numbers are refused.

        Raises:
            Robo47Error: the file cannot be written, is another day's, or somebody else
                is grading into it.
        """
        self.path, self._day, self._about = path, day, about
        # A machine that has lost its clock grades, too, and knows its head again.
        self.reference = min(max(0, int(time.time())), _LATEST - 1)
        self.deadline = False
        self.seed = secrets.randbits(32)
        self.odd = self.outdated = 0
        self._last: dict[str, StoredResult] = {}  # the last result by folder
        self._best: dict[str, StoredResult] = {}
        self._written: dict[str, Any] = {}  # the last header
        try:
            self._file = path.open("a+b")
        except OSError as error:
            raise self._unwritten(error) from None
        try:
            self._lock()
            self._file.seek(0)
            for line in filter(bytes.strip, self._file):
                self._take(line)
        except BaseException:
            self._file.close()
            raise
        if deadline is not None:
            self.reference = deadline
            self.deadline = True
        self.seed = self.seed if seed is None else seed
        if self._written != self._head():
            self._append(self._head())

    def _head(self) -> dict[str, Any]:
        since = {"reference": self.reference, "deadline": self.deadline}
        about = {"days": [self._day.number], **self._about}
        return {"kind": KIND, **about, "seed": self.seed, **since}

    def find(
        self, folder: str, package: Storable, *, frozen: bool = False
    ) -> Any | None:
        """Return a student's result, unless what they hand in, or the kit, has changed.

        Args:
            folder: the student's.
            package: what they hand in now.
            frozen: another version of the kit may have given it.
        """
        known = self._last.get(folder)
        if known is None or known.package != package.fingerprint:
            return None
        if frozen or known.kit == package.kit:
            return known.result
        self.outdated += 1
        return None

    def best(self, folder: str) -> StoredResult:
        """Return a student's best result of all that were kept, the last of equals."""
        return self._best[folder]

    def keep(self, folder: str, package: Storable, result: Any) -> None:
        """Write a result and wait until the disk has it."""
        kept = StoredResult(
            package=package.fingerprint,
            kit=package.kit,
            commit=package.commit,
            committed=package.committed,
            result=result,
        )
        self._note(folder, kept)
        told = {**kept._asdict(), "result": self._as_json(result)}
        self._append({"day": package.day, "folder": folder, **told})

    def _note(self, folder: str, kept: StoredResult) -> None:
        self._last[folder] = kept
        rival = self._best.get(folder)
        at = kept.committed
        late = self.deadline and at is not None and at > self.reference
        if (
            rival is None
            # A result of another seed counts no longer.
            or rival.result.seed != kept.result.seed
            or (kept.result.score >= rival.result.score and not late)
        ):
            self._best[folder] = kept

    def close(self) -> None:
        """Close the file, which lets go of it."""
        self._file.close()

    def _lock(self) -> None:
        try:
            lock(self._file.fileno(), patience=0)
        except TimeoutError:
            raise Robo47Error(
                f"{shown(self.path)}: another make grade is at work there. Wait for it,"
                " or give this one a folder of its own with --out"
            ) from None

    def _append(self, record: dict[str, Any]) -> None:
        # The line break comes first, so that a cut line never swallows the next one.
        try:
            self._file.write(b"\n" + json.dumps(record).encode("ascii"))
            self._file.flush()
            os.fsync(self._file.fileno())
        except OSError as error:
            with contextlib.suppress(OSError):
                self._file.close()
            goes_on = ". What is graded is kept; the same command goes on"
            raise self._unwritten(error, goes_on) from None

    def _unwritten(self, error: OSError, more: str = "") -> Robo47Error:
        return Robo47Error(
            f"{shown(self.path)} cannot be written: {error.strerror}{more}"
        )

    def _take(self, line: bytes) -> None:
        """Take a line over, or count it as odd."""
        try:
            record = json.loads(line)
            if record.get("kind") == KIND:
                self._begin(record)
            else:
                self._note(record["folder"], self._record(record))
        except _ODD:
            self.odd += 1

    def _begin(self, head: dict[str, Any]) -> None:
        reference, days = head["reference"], head["days"]
        if {name: head.get(name) for name in self._about} != self._about:
            raise Robo47Error(
                f"{shown(self.path)} is of another grading of day {self._day.number}: "
                "give this one a folder of its own with --out"
            )
        if days != [self._day.number]:
            of = ", ".join(str(int(day)) for day in days)
            raise Robo47Error(
                f"{shown(self.path)} holds day {of}: give each day a folder of its "
                "own, such as --out grades-dayN/grades.csv"
            )
        if type(reference) is not int or not 0 <= reference < _LATEST:
            raise ValueError(reference)
        seed = int(head["seed"])
        self.deadline = head["deadline"] is True
        self.reference, self.seed = reference, seed
        self._written = self._head()

    def _record(self, record: dict[str, Any]) -> StoredResult:
        words = {name: record[name] for name in ("package", "kit", "commit")}
        if not all(
            isinstance(word, str) for word in (record["folder"], *words.values())
        ):
            raise TypeError(words)
        at = record["committed"]
        if record["day"] != self._day.number or type(at) not in (int, type(None)):
            raise ValueError(record["day"], at)
        return StoredResult(
            **words, committed=at, result=self._from_json(record["result"])
        )

    def _as_json(self, result: Any) -> dict[str, Any]:
        """Return a result as it is written."""
        return asdict(result)

    def _from_json(self, told: Any) -> Any:
        """Return a result of what was written; one of `_ODD` where it is none."""
        return from_json(told, self._day)
