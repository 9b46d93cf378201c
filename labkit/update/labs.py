"""The student's labs in a merged worktree, renewed by that worktree's own code.

Run as `python -m labkit.update.labs COMMIT TARGET` there: the newer kit reads its own
manifests. It prints what became of each lab, and what is new, as JSON.
"""

import json
import sys

from labkit.lesson.day import Day, all_days
from labkit.lesson.renew import renewed
from labkit.lesson.sealed import opened
from labkit.lesson.starter import read_script
from labkit.update.news import news, said
from robo47.paths import ROOT

MOST = 100  # versions of a lab to look through for the one that was begun with


def main() -> None:
    """Renew every lab that was begun."""
    before, target = sys.argv[1:]
    days = [found for day in all_days() if (found := renew(day, before, target))]
    print(json.dumps({"days": days, "changes": changes(before)}))


def renew(day: Day, before: str, target: str) -> dict[str, object] | None:
    """Renew a day's lab; return what is new in it, or None where nothing is.

    Args:
        before: the student's commit.
        target: the kit's.
    """
    begun = day.named_as(lambda name: (ROOT / name).is_file()).work
    lines = news(day, before)
    if not begun.is_file():
        return {"day": day.number, "news": lines} if lines else None
    text = begun.read_text("utf-8-sig")
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
    found = said(*log).split()
    texts = [said("show", f"{commit}:{name}") for commit in found for name in names]
    return [opened(text) for text in texts if text]


def changes(before: str) -> list[str]:
    """Return what the changelog has that it had not."""
    path = ROOT / "CHANGELOG.md"
    old = set(said("show", f"{before}:CHANGELOG.md").splitlines())
    lines = path.read_text("utf-8").splitlines() if path.is_file() else []
    return [line for line in lines if line.strip() and line not in old]


if __name__ == "__main__":
    main()
