"""The origin of a student's files: the kit's commit at which a merge starts.

Git knows it for a clone. A copy of a template has the kit's files and none of its
commits, and a kit whose history was rewritten has other commits with the same files:
there the files themselves say it.
"""

from pathlib import Path

from labkit.base import git
from labkit.update.git import NO_HOOKS, NOBODY, SECONDS, ask
from robo47.errors import Robo47Error
from robo47.paths import ROOT


def joined(worktree: Path, own: str, target: str) -> str:
    """Join the student's history to the kit's where git sees no link, or too old a one.

    No file changes: the commit says only that the kit's commit is in the student's.

    Args:
        worktree: at the student's commit.
        own: the student's commit.
        target: the kit's.

    Returns:
        What to tell the student; "" where git knows the base.

    Raises:
        Robo47Error: no commit of the kit's is like the student's files.
    """
    known = ask("merge-base", own, target, at=worktree, may_fail=True)
    found = _same_files(own, target, known)
    how = "has the very files of"
    if not found and not known:
        found = _nearest(own, target)
        how = "is nearest to"
    if not found:
        return ""
    named = ask("log", "-1", "--format=%h of %as (%s)", found)
    join = ("merge", "-q", "-s", "ours", "--allow-unrelated-histories", "--no-gpg-sign")
    message = f"My files began with the kit's {found[:7]}"
    ask(*NOBODY, *join, "-m", message, found, at=worktree)
    return f"Your copy {how} the kit's commit {named}; the update starts there."


def _trees(commit: str, known: str) -> dict[str, str]:
    """Return the oldest commit with each tree, the newest trees first."""
    without = (f"^{known}",) if known else ()
    listed = ask("rev-list", "--topo-order", "--format=%T %H", commit, *without)
    pairs = (line.split() for line in listed.splitlines())
    return {one[0]: one[1] for one in pairs if one and one[0] != "commit"}


def _same_files(own: str, target: str, known: str) -> str:
    """Return the kit's commit with the files that the student had last; "" for none.

    Args:
        own: the student's commit.
        target: the kit's.
        known: where both lead back to; what came before it is not looked at.
    """
    if known in (own, target):
        return ""
    kit = _trees(target, known)
    return next((kit[tree] for tree in _trees(own, known) if tree in kit), "")


def _nearest(own: str, target: str) -> str:
    """Return the kit's commit, the oldest such, with the fewest files that differ.

    Raises:
        Robo47Error: half of its files differ even there.
    """
    listed = ask("ls-tree", "-rz", "--full-tree", own).split("\0")[:-1]
    mine = {entry.partition("\t")[2]: entry.split()[2] for entry in listed}
    state: dict[str, str] = {}
    same = 0
    best = (len(mine) + 1, "", 0, 0)  # differing, the commit, alike, its files
    for line in _history(target):
        if not line.startswith(":"):
            apart = len(mine) + len(state) - len(mine.keys() & state.keys()) - same
            best = min(best, (apart, line, same, len(state)), key=lambda one: one[0])
            continue
        facts, _, name = line.partition("\t")
        blob, kind = facts.split()[3:]
        same -= name in state and state[name] == mine.get(name)
        state.pop(name, None)
        if kind != "D":
            state[name] = blob
            same += blob == mine.get(name)
    _, commit, alike, files = best
    if not commit or 2 * alike < files:
        raise Robo47Error(
            "the place named is another repository: no commit of it has even half of "
            "your files. Name the kit that yours is a copy of: make update FROM=URL"
        )
    return commit


def _history(target: str) -> list[str]:
    """Return git's list of changed files, the oldest first, a commit after its own."""
    how = ("--first-parent", "-m", "--root", "--raw", "--no-abbrev", "--no-renames")
    log = (
        "-c",
        "core.quotePath=false",
        "log",
        *how,
        "--format=%H",
        "--no-show-signature",
    )
    done = git.run(*NO_HOOKS, *log, "--reverse", target, folder=ROOT, seconds=SECONDS)
    lines: list[str] = []
    commit = ""
    for line in done.stdout.splitlines():
        if not line or line.startswith(":"):
            lines += [line] if line else []
            continue
        lines += [commit] if commit else []
        commit = line
    return [*lines, commit]
