"""Numbers of the house that are told and not asked: nothing here fails on one.

    python tests/counts.py

How many files a wrong answer's check runs through, and how often a reader would switch
between them; how many modules a report loads; how long the labs are.
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

from labkit.lesson.day import all_days, find_task  # noqa: E402
from labkit.log import append_rows  # noqa: E402

# A task, and a line of its solution made wrong.
WRONG = {
    "1.4": ("w, x, y, z = quat", "x, y, z, w = quat"),
    "5.1": ("return kp * e + kd * ed", "return kp * e - kd * ed"),
}


def last_word(tool, script, *args, **env):
    """Return the last line that a tool of this folder says of a script's run."""
    command = [sys.executable, f"tests/{tool}", f"scripts/{script}", *map(str, args)]
    done = subprocess.run(
        command, cwd=ROOT, env={**os.environ, **env}, capture_output=True, text=True
    )
    return done.stderr.strip().rpartition("\n")[2]


def check_of(task, folder):
    """Return files and switches of a check of a task that names a mistake."""
    source = find_task(task)[0].source
    file = folder / source.name
    text = source.read_text("utf-8")
    right, wrong = WRONG[task]
    if right not in text:
        return f"not measured: {source.name} has no {right!r}"
    file.write_text(text.replace(right, wrong, 1), "utf-8")
    return last_word("switches.py", "check_day.py", "--task", task, "--file", file)


def report(folder):
    """Return the modules of the kit that a report of two days loads."""
    log = folder / "metrics.csv"
    row = {"check": "fk", "metric": "err", "value": 1e-9}
    append_rows([{"day": n, **row} for n in (1, 2)], log)
    return last_word("loaded.py", "report_metrics.py", ROBO47_METRICS=str(log))


def main():
    """Print them all."""
    with tempfile.TemporaryDirectory() as name:
        for task in WRONG:
            print(f"a check of {task}: {check_of(task, Path(name))}")
        print(f"a report: {report(Path(name))}")
    for day in all_days():
        lines = len(day.source.read_text("utf-8").splitlines())
        print(f"the lab of Day {day.number}: {lines} lines")


if __name__ == "__main__":
    main()
