"""The kit's commits and the student's made one, in a worktree beside the clone."""

import shutil
from pathlib import Path

from labkit.base import git
from labkit.lesson.day import LOG
from labkit.lesson.merge import keep_both, merged
from labkit.lesson.student_files import deliverables, is_students, work_links
from labkit.update.git import (
    NOBODY,
    SECONDS,
    as_whom,
    ask,
    commit,
    look_again,
    own_index,
)
from robo47.errors import Robo47Error
from robo47.paths import ROOT

# remotes of the kit; the first that exists is taken
REMOTES = ("kit", "upstream", "origin")
STALLED = ("-c", "http.lowSpeedLimit=1000", "-c", "http.lowSpeedTime=30")


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
    ask(*STALLED, "fetch", "-q", "--tags", *more, found, to or "HEAD")
    return found, ask("rev-parse", "FETCH_HEAD^{commit}")


def saved_own() -> str:
    """Return a commit with what the student has now, to be merged as it is.

    Their branch and their index stay as they are: HEAD, where that has it all.

    Raises:
        Robo47Error: a merge of theirs waits to be finished.
    """
    if ask("ls-files", "-u"):
        raise Robo47Error("a merge is not finished. Finish it, then: make update")
    if links := work_links():
        raise Robo47Error(
            f"{links[0]} is a symbolic link. Git does not see the labs behind it, and "
            "nothing in it is handed in. Put a folder with your labs in its place, "
            "then: make update"
        )
    there = [name for name in sorted(deliverables()) if (ROOT / name).is_file()]
    with own_index() as index:
        own = ROOT / ask("rev-parse", "--git-path", "index")
        try:
            shutil.copyfile(own, index)
        except OSError as error:
            raise Robo47Error(f"{error.filename}: {error.strerror}") from None
        look_again(index)
        ask("add", "-u", index=index)
        ask("add", "--", *there, may_fail=True, index=index)
        tree = ask("write-tree", index=index)
    if tree == ask("rev-parse", "HEAD^{tree}"):
        return ask("rev-parse", "HEAD")
    commit = ("commit-tree", "-p", "HEAD", "-m", "My work before the update", tree)
    return ask(*as_whom(ROOT), *commit)


def merge(worktree: Path, target: str) -> list[str]:
    """Merge a commit; no line of the student's is lost.

    Args:
        worktree: at the student's commit, which leads back to one of the kit's.
        target: the kit's.

    Returns:
        Files of the kit's that the student had changed in the same place: they are the
        kit's now.
    """
    own = ask("rev-parse", "HEAD", at=worktree)
    base = ask("merge-base", own, target, at=worktree)
    how = ("merge", "-q", "--no-ff", "--no-commit", target)
    ask(*NOBODY, *how, at=worktree, may_fail=True)
    both: dict[str, dict[str, str]] = {}  # blobs: "1" of the base, "2" ours, "3" theirs
    for entry in ask("ls-files", "-uz", at=worktree).split("\0")[:-1]:
        facts, _, name = entry.partition("\t")
        _, blob, stage = facts.split()
        both.setdefault(name, {})[stage] = blob
    taken = [
        name
        for name, blobs in both.items()
        if not _resolve(worktree, name, blobs, is_students(name))
    ]
    _keep_rows(worktree, own)
    ask("add", "-A", at=worktree)
    if ask("rev-parse", "-q", "--verify", "MERGE_HEAD", at=worktree, may_fail=True):
        commit(f"Update to the kit's {target[:7]}", worktree)
    elif base != target:
        raise Robo47Error("git could not merge")
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
            (worktree / name).unlink(missing_ok=True)  # a link leads out of there
            (worktree / name).write_text(text, "utf-8", newline="\n")
        return True
    if "3" in blobs:
        ask("checkout", "--theirs", "--", name, at=worktree)
    else:
        (worktree / name).unlink(missing_ok=True)
    return "2" not in blobs


def _text(worktree: Path, blob: str) -> str | None:
    """Return a blob's text; None for what is none."""
    content = _content(worktree, blob)
    try:
        return None if b"\0" in content else content.decode("utf-8")
    except UnicodeDecodeError:
        return None


def _content(worktree: Path, blob: str) -> bytes:
    """Return a blob's content; b"" where there is none."""
    done = git.run("show", blob, folder=worktree, seconds=SECONDS, text=False)
    content: bytes = done.stdout
    return content


def _keep_rows(worktree: Path, own: str) -> None:
    """Put back rows of the log that a merge left out, however it came about."""
    before = _content(worktree, f"{own}:{LOG}").splitlines()
    path = worktree / LOG
    if path.is_symlink():  # it leads out of the worktree
        return
    now = path.read_bytes().splitlines() if path.is_file() else []
    if lost := [row for row in before if row not in set(now)]:
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(b"\n".join([*now, *lost, b""]))


def remember(place: str) -> None:
    """Remember where the kit is, where the clone has no name for it."""
    known = ask("remote").split()
    if place not in REMOTES and place not in known:
        ask("remote", "set-url" if "kit" in known else "add", "kit", place)
