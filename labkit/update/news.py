"""News of a day: what its newer manifest and worksheet have that they had not."""

import tomllib
from typing import Any

from labkit.base import git
from labkit.lesson.day import Day
from robo47.errors import Robo47Error
from robo47.paths import ROOT


def news(day: Day, before: str) -> list[str]:
    """Return what is new in a day since a commit, a line each."""
    own = day.own.relative_to(ROOT).as_posix()
    text = said("show", f"{before}:{own}/day.toml")
    if not text:
        return [f"Day {day.number} is new: {day.title}"]
    try:
        old = tomllib.loads(text)
    except ValueError:  # their own, broken
        return []
    return [*_lab(day, old), *_tasks(day, old), *_rows(day, old), *_sheet(day, before)]


def said(*arguments: str) -> str:
    """Return what git says of the clone, "" where it fails."""
    try:
        done = git.run(*arguments, folder=ROOT, seconds=60)
    except git.GitError as error:
        raise Robo47Error(str(error)) from None
    return done.stdout if done.returncode == 0 else ""


def _lab(day: Day, old: dict[str, Any]) -> list[str]:
    was = old.get("script", day.script)
    return [] if was == day.script else [f"the lab {was} is called {day.script}"]


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
    old = said("show", f"{before}:{name}").splitlines() if name else []
    now = (ROOT / name).read_text("utf-8").splitlines() if old else []
    new = [line for line in now if line.startswith("#") and line not in old]
    return [f"the worksheet has a heading {line.strip('# ')!r}" for line in new]
