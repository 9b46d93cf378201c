"""A class that hunted the same bug: found, repaired, named, given up, and untrue.

python tests/make_hunters.py FOLDER        to look at: make grade ROOT=FOLDER SEED=7
"""

import csv
import io
import json
import subprocess
import sys
from dataclasses import asdict
from pathlib import Path

from labkit import log
from labkit.hunt import tally
from labkit.hunt.case import FILE, Case, draw, folder_of, script_of
from labkit.hunt.script import closed_lab
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import read_script
from labkit.lesson.starter import put_back
from robo47.paths import METRICS_CSV, ROOT

DAY, LEVEL, SEED = find_day(4), 1, 7
GUILTY = draw(DAY, LEVEL, SEED, []).mistakes[0].function
INNOCENT = next(f for task in DAY.tasks for f in task.functions if f != GUILTY)
AUTHOR = ("-c", "user.name=A", "-c", "user.email=a@b", "-c", "commit.gpgsign=false")


class Hunter:
    """One student's hunt, on the way to a folder."""

    def __init__(self) -> None:
        """Begin one."""
        self.case = draw(DAY, LEVEL, SEED, [])
        self.case.runs = 2
        self.text = closed_lab(DAY)
        self.row: dict[str, object] = {}

    def suspect(self, name: str, expected: str = "it is too small") -> "Hunter":
        """Name a function."""
        self.case.suspected.append([name, expected])
        self.case.runs += 1
        return self

    def repair(self, name: str) -> "Hunter":
        """Write a function anew, rightly."""
        self.text = put_back(self.text, read_script(DAY.source), (name,))
        return self

    def botch(self, name: str) -> "Hunter":
        """Write a function anew, wrongly."""
        right = put_back(closed_lab(DAY), read_script(DAY.source), (name,))
        closed = next(ln for ln in self.text.splitlines() if f'hunted("{name}"' in ln)
        self.text = self.text.replace(closed, "    return np.zeros(7)")
        assert right != self.text
        return self

    def end(self, how: str) -> "Hunter":
        """Have it in the log."""
        self.case.ended = how
        self.case.checks = 1
        self.row = tally.row_of(self.case)
        return self

    def write(self, clone: Path, case: Case | None = None) -> None:
        """Write the files and commit them."""
        text = io.StringIO()
        table = csv.DictWriter(text, log.COLUMNS, lineterminator="\n")
        table.writeheader()
        if self.row:
            table.writerow({**dict.fromkeys(log.COLUMNS, ""), **self.row})
        said = json.dumps(asdict(case or self.case), indent=1)
        files = {
            folder_of(DAY) / FILE: said,
            script_of(DAY, LEVEL): self.text,
            METRICS_CSV: text.getvalue(),
        }
        for path, content in files.items():
            place = clone / path.relative_to(ROOT)
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_text(content, "utf-8")
        commit(clone)


def commit(clone: Path) -> None:
    """Commit all of a folder."""
    for words in (
        ("init", "-q"),
        ("add", "-A"),
        (*AUTHOR, "commit", "-qm", "The hunt", "--allow-empty"),
    ):
        subprocess.run(("git", *words), cwd=clone, check=True)


def hunters() -> dict[str, Hunter]:
    """Return one of each kind, by what is true of it."""
    edited = Hunter().suspect(INNOCENT)
    edited.case.ended = tally.FOUND
    edited.row = tally.row_of(edited.case)  # typed into the log by hand
    few = Hunter().suspect(INNOCENT).suspect(GUILTY).repair(GUILTY).end(tally.FOUND)
    few.row["value"] = 1.0
    elsewhere = Hunter().suspect(INNOCENT).repair(INNOCENT)
    elsewhere.case.marks = ["0" * 16]
    return {
        "found": Hunter().suspect(GUILTY).repair(GUILTY).end(tally.FOUND),
        "found second": Hunter()
        .suspect(INNOCENT, "the run at rest is off too")
        .repair(INNOCENT)
        .suspect(GUILTY, "only what moves is off")
        .repair(GUILTY)
        .end(tally.FOUND),
        "repaired only": Hunter().repair(GUILTY).end(tally.FOUND),
        "named only": Hunter().suspect(GUILTY).botch(GUILTY),
        "gave up": Hunter().suspect(INNOCENT).end(tally.GAVE_UP),
        "log edited": edited,
        "runs edited": few,
        "marks edited": elsewhere,
    }


def make(folder: Path, copies: int = 1) -> None:
    """Write a class: each kind some times, and who has no hunt, another, no folder."""
    for kind, hunter in hunters().items():
        for number in range(copies):
            hunter.write(folder / f"{kind} {number}".replace(" ", "-"))
    Hunter().write(folder / "another-seed", draw(DAY, LEVEL, SEED + 1, []))
    (folder / "nothing").mkdir()
    commit(folder / "nothing")
    broken = folder / "broken"
    Hunter().write(broken)
    (broken / folder_of(DAY).relative_to(ROOT) / FILE).write_text('{"day": [', "utf-8")
    commit(broken)
    (folder / "no-git").mkdir()


if __name__ == "__main__":
    make(Path(sys.argv[1]), copies=2)
