"""A notebook and the day's file in step: the file is the lab, the notebook its view.

Every command reads the file in `work/`. Before one does, the functions of the notebook
are put into it. `.robo47/notebook.json` remembers each text that both had: what is none
of these is an edit. A function that was edited in both is named, and nothing is merged.
"""

import hashlib
from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass, field
from typing import Any

from labkit.base import store
from labkit.lesson.backup import rewrite, with_ends_of
from labkit.lesson.cells import (
    MOST,
    Cells,
    code_of,
    definitions,
    functions_of,
    is_gap,
    split_script,
    text_of,
    with_functions,
)
from labkit.lesson.day import Day
from labkit.lesson.lab_module import read_script
from labkit.lesson.starter import starter_of
from robo47.errors import Robo47Error
from robo47.paths import shown

MEMORY = "notebook.json"
KEPT = 200  # texts that are remembered, per function


@dataclass
class SyncResult:
    """The result of copying a notebook's functions."""

    written: list[str] = field(default_factory=list)  # taken from the notebook
    newer: list[str] = field(default_factory=list)  # the file's was edited: it counts

    def sentences(self, day: Day) -> list[str]:
        """Return a sentence for each kind of change."""
        file, says = shown(day.work), []
        if self.written:
            says.append(f"Written to {file}: {', '.join(self.written)}.")
        if self.newer:
            names = ", ".join(self.newer)
            says.append(
                f"{names}: the text in {file} is newer than the cell, and it counts. "
                f'load("{self.newer[0]}") shows it; check(keep="notebook") takes the '
                "cell."
            )
        return says


def bring(
    day: Day, cells: Cells, keep: str = "", reverted: Collection[str] = ()
) -> SyncResult:
    """Put the functions of a notebook into the day's file, and say what happened.

    Args:
        day: begun, so its file is there.
        cells: of the notebook.
        keep: "notebook" or "file", which one counts if both were edited; "notebook"
            also takes a cell's text that is older than the file's.
        reverted: functions whose cell has an earlier text again, which was run on
            purpose and therefore counts as an edit.

    Raises:
        Robo47Error: both were edited, and `keep` does not say which one counts.
    """
    script, clone = read_script(day.work), day.folder.parent
    memory = store.read(MEMORY, clone)
    seen: dict[str, list[str]] = memory.get(str(day.number), {})
    pairs = list(_pairs(day, script, cells))
    counts = {
        n: _counts(cell, file, seen.get(n, []), n in reverted)
        for n, cell, file in pairs
    }
    if not keep and (both := [name for name in counts if counts[name] == "both"]):
        raise Robo47Error(_both(day, both))
    open_to = ("both", "file") if keep == "notebook" else ("both",)
    counts = {name: keep if who in open_to else who for name, who in counts.items()}
    taken = [name for name in counts if counts[name] == "notebook"]
    newer = [name for name in counts if counts[name] == "file"]
    left = {n: text for n, text in cells.functions.items() if n not in newer}
    _, own = split_script(script)
    labs = [name for name in taken if name not in own]
    after = with_functions(script, Cells(left, cells.others), labs)
    if after != script:
        _write(day, after, keep_old=bool(keep))
    for name, cell, _ in pairs:
        seen[name] = [*seen.get(name, []), _mark(cell)][-KEPT:]
    store.write(MEMORY, {**memory, str(day.number): seen}, clone)
    return SyncResult(taken, newer)


def _pairs(day: Day, script: str, cells: Cells) -> Iterator[tuple[str, str, str]]:
    """Yield name, cell's text and file's text of what the student writes in both."""
    _, own = split_script(script)
    for name in dict.fromkeys([*functions_of(day), *own]):
        cell = cells.functions.get(name, "")
        if cell and not is_gap(cell):
            yield name, cell, own.get(name) or text_of(script, name)


def _counts(cell: str, file: str, known: list[str], reverted: bool) -> str:
    """Return which text of a function counts: "notebook", "file", "both" or neither.

    Args:
        cell: the notebook's text.
        file: the lab's.
        known: marks of texts that both have had.
        reverted: an earlier text of the cell was run again on purpose.
    """
    if _mark(cell) == _mark(file):
        return ""
    if _mark(cell) in known and not reverted:
        return "file"
    begun = file and not is_gap(file) and _mark(file) not in known
    return "both" if begun else "notebook"


def bring_saved(day: Day) -> SyncResult:
    """Put the functions of the notebook in `work/` into the day's file, if it is newer.

    Raises:
        Robo47Error: as `bring`; or the notebook cannot be read.
    """
    path = day.notebook
    try:
        status = path.stat()
        if day.work.is_file() and status.st_mtime_ns <= day.work.stat().st_mtime_ns:
            return SyncResult()
        if status.st_size > MOST:
            raise ValueError(f"has more than {MOST // 1_000_000} MB: clear its outputs")
        cells = definitions(code_of(path.read_bytes()))
    except FileNotFoundError:
        return SyncResult()
    except (OSError, ValueError) as error:
        raise Robo47Error(f"{shown(path)}: {error}") from None
    if not day.work.is_file():
        store.replace(day.work, starter_of(day).encode())
    return bring(day, cells)


def remember(day: Day) -> None:
    """Remember the functions of a day's file, which a new notebook shows."""
    if not day.work.is_file():
        return
    script = read_script(day.work)
    marks = {name: [_mark(text_of(script, name))] for name in functions_of(day)}
    clone = day.folder.parent
    store.write(MEMORY, {**store.read(MEMORY, clone), str(day.number): marks}, clone)


def with_newer(day: Day, notebook: dict[str, Any]) -> list[str]:
    """Put functions that were edited in the file alone into a notebook's cells.

    Args:
        day: from its manifest.
        notebook: its content, which is changed.

    Returns:
        The names of the functions that were renewed.
    """
    if not day.work.is_file():
        return []
    script = read_script(day.work)
    seen = store.read(MEMORY, day.folder.parent).get(str(day.number), {})
    renewed = []
    for cell in notebook["cells"]:
        name = cell["metadata"].get("robo47", {}).get("function", "")
        own, file = "".join(cell["source"]), text_of(script, name)
        known = _mark(own) in seen.get(name, []) or is_gap(own)
        if name and file and known and not is_gap(file) and _mark(own) != _mark(file):
            cell["source"] = file
            renewed.append(name)
    return renewed


def _mark(text: str) -> str:
    """Return a fingerprint of a text, whatever the white space at the ends of lines."""
    plain = "\n".join(line.rstrip() for line in text.strip().splitlines())
    return hashlib.sha256(plain.encode("utf-8", "replace")).hexdigest()[:16]


def _write(day: Day, text: str, keep_old: bool) -> None:
    """Write a day's file; what it had is kept beside it if the student chose."""
    if keep_old:
        rewrite(day.work, text, "notebook")
    else:
        store.replace(day.work, with_ends_of(day.work.read_bytes(), text))


def _both(day: Day, names: Iterable[str]) -> str:
    names = list(names)
    return (
        f"{', '.join(names)}: edited in the notebook and in {shown(day.work)}, so "
        "nothing was changed. To take the notebook's text, run check(keep="
        '"notebook"); to take the file\'s, check(keep="file"). The other text is kept.'
    )
