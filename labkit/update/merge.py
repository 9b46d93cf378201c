"""The kit's commits and the student's made one, in a worktree beside the clone."""

import contextlib
import os
import shutil
from collections.abc import Iterator
from pathlib import Path

from labkit.base import git, store
from labkit.lesson.day import all_days
from labkit.lesson.merge import keep_both, merged
from labkit.lesson.week import WORK
from robo47.errors import Robo47Error
from robo47.paths import ROOT

SECONDS = 300.0
LOG = "metrics/metrics.csv"
REMOTES = ("kit", "upstream", "origin")  # where the kit is, the first that is there
NOBODY = ("-c", "user.name=robo47", "-c", "user.email=robo47@localhost")
UNCHANGED = "Nothing of yours has changed."


def ask(*arguments: str, at: Path = ROOT, may_fail: bool = False) -> str:
    """Return what git prints.

    Args:
        arguments: after `git`.
        at: the folder.
        may_fail: return "" where git fails.

    Raises:
        Robo47Error: git fails; the first line of what it says.
    """
    try:
        done = git.run(*arguments, folder=at, seconds=SECONDS, largest=git.LARGEST_GIT)
    except git.GitError as error:
        raise Robo47Error(f"{error}. {UNCHANGED}") from None
    if done.returncode == 0:
        return done.stdout.rstrip("\n")
    if may_fail:
        return ""
    lines = [line for line in done.stderr.splitlines() if line.strip()]
    why = lines[0] if lines else f"git {arguments[0]} ended with {done.returncode}"
    raise Robo47Error(f"{why}. {UNCHANGED}")


def commit(message: str, at: Path) -> None:
    """Commit what is staged; a student without a name in git has one for this."""
    named = ask("config", "user.name", at=at, may_fail=True)
    as_whom = () if named else NOBODY
    how = ("commit", "-q", "--no-verify", "--no-gpg-sign", "-m", message)
    ask(*as_whom, *how, at=at)


def fetch(place: str | None, to: str | None) -> tuple[str, str]:
    """Bring the newer commits here; return the remote or address, and the commit.

    No file of the clone changes.

    Args:
        place: an address; None is the first of REMOTES that is there.
        to: a tag, branch or commit; None is the newest commit.

    Raises:
        Robo47Error: no network, no such place or commit.
    """
    remotes = ask("remote").split()
    found = place or next((name for name in REMOTES if name in remotes), "")
    if not found:
        raise Robo47Error("where is the kit? Say it once: make update FROM=https://...")
    deep = ask("rev-parse", "--is-shallow-repository") == "true"
    more = ("--unshallow",) if deep else ()
    ask("fetch", "-q", "--tags", *more, found, to or "HEAD")
    return found, ask("rev-parse", "FETCH_HEAD^{commit}")


def save_own() -> None:
    """Commit what the student has not: it is merged as it is now.

    Raises:
        Robo47Error: a merge of theirs waits to be finished.
    """
    if ask("ls-files", "-u"):
        raise Robo47Error("a merge is not finished. Finish it, then: make update")
    handed_in = {name for day in all_days() for name in day.files.values()}
    there = [name for name in sorted(handed_in) if (ROOT / name).is_file()]
    ask("add", "-u")
    ask("add", "--", *there, may_fail=True)
    if ask("diff", "--cached", "--name-only"):
        commit("My work before the update", ROOT)


@contextlib.contextmanager
def beside(head: str) -> Iterator[Path]:
    """Yield a worktree at a commit; one of a run that was killed is removed."""
    place = store.path_of("update")

    def clear() -> None:
        shutil.rmtree(place, ignore_errors=True)
        ask("worktree", "prune")

    clear()
    ask("worktree", "add", "-q", "--detach", str(place), head)
    try:
        yield place
    finally:
        clear()


def merge(worktree: Path, target: str) -> list[str]:
    """Merge a commit; no line of the student's is lost.

    Args:
        worktree: at the student's commit.
        target: the kit's.

    Returns:
        Files of the kit's that the student had changed in the same place: they are the
        kit's now.
    """
    own = ask("rev-parse", "HEAD", at=worktree)
    base = ask("merge-base", own, target, at=worktree, may_fail=True)
    if not base:
        raise Robo47Error(
            f"that is another repository: no commit is in both. {UNCHANGED}"
        )
    how = ("merge", "-q", "--no-ff", "--no-commit", target)
    ask(*NOBODY, *how, at=worktree, may_fail=True)
    mine = {LOG, *(name for day in all_days() for name in day.files.values())}
    both: dict[str, dict[str, str]] = {}  # blobs: "1" of the base, "2" ours, "3" theirs
    for entry in ask("ls-files", "-uz", at=worktree).split("\0")[:-1]:
        facts, _, name = entry.partition("\t")
        _, blob, stage = facts.split()
        both.setdefault(name, {})[stage] = blob
    taken = [
        name
        for name, blobs in both.items()
        if not _resolve(worktree, name, blobs, name in mine or f"/{WORK}/" in name)
    ]
    _keep_rows(worktree, own)
    ask("add", "-A", at=worktree)
    if ask("rev-parse", "-q", "--verify", "MERGE_HEAD", at=worktree, may_fail=True):
        commit(f"Update to the kit's {target[:7]}", worktree)
    elif ask("merge-base", "--is-ancestor", target, "HEAD", at=worktree):
        raise Robo47Error(f"git could not merge. {UNCHANGED}")
    return taken


def _resolve(worktree: Path, name: str, blobs: dict[str, str], own: bool) -> bool:
    """Settle a file that both changed; return whether the student's lines stay."""
    if "2" in blobs and (own or "3" not in blobs):
        base, ours, theirs = (
            _text(worktree, blobs[stage]) if stage in blobs else "" for stage in "123"
        )
        if base is None or ours is None or theirs is None or "3" not in blobs:
            # a picture, or what the kit took away
            ask("checkout", "--ours", "--", name, at=worktree, may_fail=True)
        else:
            text = merged(base, ours, theirs, keep_both)
            (worktree / name).write_text(text, "utf-8", newline="\n")
        return True
    if "3" in blobs:
        ask("checkout", "--theirs", "--", name, at=worktree)
    else:
        (worktree / name).unlink(missing_ok=True)
    return "2" not in blobs


def _text(worktree: Path, blob: str) -> str | None:
    """Return a blob's text; None for what is none."""
    done = git.run("show", blob, folder=worktree, seconds=SECONDS, text=False)
    try:
        return None if b"\0" in done.stdout else done.stdout.decode("utf-8")
    except UnicodeDecodeError:
        return None


def _keep_rows(worktree: Path, own: str) -> None:
    """Put back rows of the log that a merge left out, however it came about."""
    before = ask("show", f"{own}:{LOG}", at=worktree, may_fail=True).splitlines()
    path = worktree / LOG
    now = path.read_text("utf-8").splitlines() if path.is_file() else []
    if lost := [row for row in before if row not in set(now)]:
        path.parent.mkdir(exist_ok=True)
        path.write_text("\n".join([*now, *lost]) + "\n", "utf-8", newline="\n")


def take(worktree: Path, place: str) -> None:
    """Bring the clone to what the worktree has, in one step, and remember the place.

    Raises:
        Robo47Error: a file in the clone is in the way; says which.
    """
    head = ask("rev-parse", "HEAD", at=worktree)
    labs = {path: path.stat() for path in ROOT.glob(f"w*/{WORK}/day*.py")}
    ask("merge", "-q", "--ff-only", head)
    for path, was in labs.items():
        if path.is_file():  # what the kit merged is no edit of the student's
            os.utime(path, ns=(was.st_atime_ns, was.st_mtime_ns))
    if place not in REMOTES and place not in ask("remote").split():
        known = "kit" in ask("remote").split()
        ask("remote", *(("set-url",) if known else ("add",)), "kit", place)
