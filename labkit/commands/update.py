"""Update your clone to the newest version of the kit, and keep your work.

    python3 scripts/update.py                          (make update)
    python3 scripts/update.py --from https://...       (make update FROM=...)
    python3 scripts/update.py --to v0.3.0              (make update TO=v0.3.0)

Your work is committed first, rows and worksheets are merged line by line, and your
labs get what is new around your functions, helpers and constants; a copy of each as
it was stays beside it. Without a network nothing has changed; interrupted anywhere,
the next run puts it right. A file of yours is never written over.
"""

import contextlib
import json
import os
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from labkit.base import cli, processes, store
from labkit.lesson.backup import free_name
from labkit.lesson.student_files import is_students
from labkit.update import base, git, last_step, merge
from labkit.update.git import ask, sweep, worktree_at
from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown

CHANGES = 24  # lines of the changelog to print


def main() -> int:
    """Update, and say what is new."""
    parser = cli.parser(__doc__)
    parser.add_argument("--from", dest="place", metavar="URL", help="where the kit is")
    parser.add_argument("--to", metavar="TAG", help="default: the newest commit")
    options = parser.parse_args()
    if not (ROOT / ".git").exists():
        raise Robo47Error("this folder is no git repository; clone the kit instead")
    with store.alone("update"):
        try:
            last_step.heal()
            sweep()
            done = update(options.place, options.to)
        except OSError as error:
            says = f"{error.filename}: {error.strerror}"
            raise Robo47Error(f"{says}. {last_step.state()}") from None
        except Robo47Error as error:
            raise Robo47Error(f"{error}. {last_step.state()}") from None
    tell(*done)
    return cli.EXIT_OK


def update(
    kit: str | None, to: str | None
) -> tuple[dict[str, Any], list[Path], list[str], str, str]:
    """Fetch, merge and take over; until the last step nothing of the student's moves.

    Args:
        kit: where it is; None is where it was.
        to: a tag; None is the newest commit.

    Returns:
        What `tell` takes.
    """
    with cli.busy("fetching"):
        place, commit = merge.fetch(kit, to)
    own = merge.saved_own()
    copies = list[Path]()
    with cli.busy("merging"), worktree_at(own) as worktree:
        began = base.joined(worktree, own, commit)
        taken = merge.merge(worktree, commit)
        found = renew_labs(worktree, own, commit)
        if ask("status", "--porcelain", at=worktree):
            ask("add", "-A", at=worktree)
            git.commit("My labs on the newer kit", worktree)
        merge.remember(place)
        if ask("rev-parse", "HEAD", at=worktree) != own:
            with kept_copies(found["days"]) as copies:
                last_step.take(worktree, own)
    return found, copies, taken, own, began


def renew_labs(worktree: Path, own: str, target: str) -> dict[str, Any]:
    """Return what the newer kit's own code did with the labs."""
    command = [sys.executable, "-m", "labkit.update.labs", own, target]
    environment = {**os.environ, "PYTHONPATH": str(worktree), "PYTHONUTF8": "1"}
    done = processes.run(command, env=environment, cwd=worktree)
    if done.returncode:
        why = done.stderr.strip().splitlines()[-1:] or ["it ended early"]
        raise Robo47Error(f"the newer kit stops: {why[0].removeprefix('error: ')}")
    found: dict[str, Any] = json.loads(done.stdout)
    return found


@contextlib.contextmanager
def kept_copies(days: list[dict[str, Any]]) -> Iterator[list[Path]]:
    """Keep each lab that changes as it was, and yield where; none if that fails."""
    copies = list[Path]()
    new = list[Path]()  # a run that was killed may have left the same one
    try:
        for day in (day for day in days if day.get("changed")):
            work = ROOT / Path(day["lab"]).with_name(day["was"])
            there = work.parent.glob(f"{work.stem}.before-update-*.txt")
            same = (one for one in there if one.read_bytes() == work.read_bytes())
            copies.append(next(same, None) or free_name(work, "update"))
            if not copies[-1].exists():
                new.append(copies[-1])
                new[-1].write_bytes(work.read_bytes())
        yield copies
    except BaseException:
        for copy in new:
            copy.unlink(missing_ok=True)
        raise


def _of_the_work(files: list[str], taken: list[str]) -> str:
    """Return what is true of the student's files after an update."""
    changed = sorted(name for name in files if is_students(name))
    if changed:
        return (
            f"; your lines are kept, and the kit's changes are in: {', '.join(changed)}"
        )
    return "" if taken else "; your work is as it was"


def tell(
    found: dict[str, Any], copies: list[Path], taken: list[str], own: str, began: str
) -> None:
    """Say where the update started, what is new and what to run again."""
    if began:
        print(began)
    now = ask("describe", "--tags", "--always")
    files = ask("diff", "--name-only", own)
    if not files:
        print("This is the kit's newest version; nothing has changed.")
        return
    changed = ask("diff", "--name-only", "--no-renames", "--diff-filter=MD", own)
    says = _of_the_work(changed.splitlines(), taken)
    print(cli.wrapped(f"The kit is at {now} now{says}.", "  "))
    for line in found["changes"][:CHANGES]:
        print(f"  {line}")
    if len(found["changes"]) > CHANGES:
        print("  ... (CHANGELOG.md has it all)")
    for name in taken:
        print(f"{name} is the kit's now; as you had it: git show {own[:7]}:{name}")
    for day in found["days"]:
        print(f"\nDay {day['day']}:")
        for line in day["news"]:
            print(cli.wrapped(f"  {line}", "    "))
        if "changed" in day:
            what = "check" if not day["changed"] else "run"
            print(f"  Run again: make {what} DAY={day['day']}")
    for copy in copies:
        print(f"your lab as it was: {shown(copy)}")
