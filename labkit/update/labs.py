"""The student's labs in a merged worktree, renewed by that worktree's own code.

Run as `python -m labkit.update.labs COMMIT TARGET` there: the newer kit reads its own
manifests. It prints what became of each lab, and what is new, as JSON: what its newer
manifest and worksheet have that they had not.
"""

import json
import sys
import tomllib
from typing import Any

from labkit.base import cli
from labkit.lesson.day import Day, all_days
from labkit.lesson.lab_module import read_script
from labkit.lesson.merge import renewed
from labkit.lesson.sealed import opened
from labkit.update.git import ask
from robo47.paths import ROOT

MOST = 100  # versions of a lab to look through for the one that was begun with


def main() -> int:
    """Renew every lab that was begun."""
    before, target = sys.argv[1:]
    days = [found for day in all_days() if (found := renew(day, before, target))]
    print(json.dumps({"days": days, "changes": changes(before)}))
    return cli.EXIT_OK


def renew(day: Day, before: str, target: str) -> dict[str, object] | None:
    """Renew a day's lab; return what is new in it, or None where nothing is.

    Args:
        day: from the newer manifest.
        before: the student's commit.
        target: the kit's.
    """
    begun = day.named_as(lambda name: (ROOT / name).is_file()).work
    lines = news(day, before)
    if not begun.is_file() or begun.is_symlink():  # a link leads out of this worktree
        return {"day": day.number, "news": lines} if lines else None
    text = read_script(begun)
    new = renewed(day, text, versions(day, before, target), read_script(day.source))
    if begun != day.work:
        begun.rename(day.work)
    if new != text:
        day.work.write_text(new, "utf-8", newline="\n")
    changed = new != text or begun != day.work
    if not (lines or changed):
        return None
    paths = {"was": begun.name, "lab": day.work.relative_to(ROOT).as_posix()}
    return {"day": day.number, "news": lines, "changed": changed, **paths}


def versions(day: Day, *commits: str) -> list[str]:
    """Return the texts that the kit's lab had, the newest first."""
    folder = day.source.parent.relative_to(ROOT).as_posix()
    names = [f"{folder}/{name}" for name in (day.script, *day.was)]
    log = ("log", "--format=%H", f"-{MOST}", *commits, "--", *names)
    found = git_output(*log).split()
    texts = [
        git_output("show", f"{commit}:{name}") for commit in found for name in names
    ]
    return [opened(text + "\n") for text in texts if text]


def changes(before: str) -> list[str]:
    """Return what the changelog has that it had not."""
    path = ROOT / "CHANGELOG.md"
    old = set(git_output("show", f"{before}:CHANGELOG.md").splitlines())
    lines = path.read_text("utf-8").splitlines() if path.is_file() else []
    return [line for line in lines if line.strip() and line not in old]


def news(day: Day, before: str) -> list[str]:
    """Return what is new in a day since a commit, a line each."""
    own = day.own.relative_to(ROOT).as_posix()
    text = git_output("show", f"{before}:{own}/day.toml")
    if not text:
        return [f"Day {day.number} is new: {day.title}"]
    try:
        old = tomllib.loads(text)
    except ValueError:  # their own, broken
        return []
    was = old.get("script", day.script)
    lab = [] if was == day.script else [f"the lab {was} is called {day.script}"]
    return [*lab, *_tasks(day, old), *_rows(day, old), *_sheet(day, before)]


def git_output(*arguments: str) -> str:
    """Return what git says of the clone, "" where it fails."""
    return ask(*arguments, may_fail=True)


def _tasks(day: Day, old: dict[str, Any]) -> list[str]:
    before = {task["id"]: task for task in old.get("tasks", [])}
    found = []
    for task in day.tasks:
        known = [one for one in (task.id, *task.was) if one in before]
        if not known:
            found.append(f"task {task.id} is new: {task.title}")
            continue
        if known[0] != task.id:
            found.append(f"task {known[0]} is called {task.id}")
        functions = zip(before[known[0]]["functions"], task.functions, strict=False)
        found += [f"{a} is called {b}" for a, b in functions if a != b]
    left = {one for task in day.tasks for one in (task.id, *task.was)}
    return [*found, *(f"task {id} is gone" for id in before if id not in left)]


def _rows(day: Day, old: dict[str, Any]) -> list[str]:
    before = {(row["check"], row["metric"]) for row in old.get("metrics", [])}
    rows = [row for row in day.metrics if (row.check, row.metric) not in before]
    return [f"a row more for the log: {row.check} ({row.metric})" for row in rows]


def _sheet(day: Day, before: str) -> list[str]:
    name = day.files.get("worksheet", "")
    old = git_output("show", f"{before}:{name}").splitlines() if name else []
    now = (ROOT / name).read_text("utf-8", "replace").splitlines() if old else []
    new = [line for line in now if line.startswith("#") and line not in old]
    return [f"the worksheet has a heading {line.strip('# ')!r}" for line in new]


if __name__ == "__main__":
    cli.run(main)
