"""What git says of a student's clone, asked without trusting its configuration.

A clone that was handed in as an archive brings its own `.git/config`, which can name
programs to run. So only commands that read objects are used: no index, no filter, no
hook, no pager, no fetch. Whether a file is committed as it is follows from its hash.
"""

import hashlib
import os
import subprocess
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

SECONDS = 10


@dataclass(frozen=True)
class History:
    """The last commit of a clone.

    Attributes:
        readable: whether there is a repository that git can read.
        commit: its hash; "" where there is no commit yet.
        committed: its time, seconds since 1970, or None.
        blobs: hash of each wanted file in it, by path.
    """

    readable: bool
    commit: str = ""
    committed: int | None = None
    blobs: Mapping[str, str] = field(default_factory=dict)

    def holds(self, name: str, data: bytes | None) -> bool:
        """Return whether a file is committed as it is.

        Args:
            name: path from the top of the clone.
            data: its content; None where it is not looked at, only for.
        """
        blob = self.blobs.get(name)
        if blob is None or data is None:
            return blob is not None
        # git on Windows may have written CRLF where the commit has LF
        versions = (data, data.replace(b"\r\n", b"\n"))
        return blob in (_blob_hash(version, len(blob)) for version in versions)


def read_history(clone: Path, wanted: Iterable[str]) -> History:
    """Return the last commit of a clone.

    Args:
        clone: the student's folder; a repository around it does not count.
        wanted: paths whose hashes to return.
    """
    git = clone / ".git"
    try:
        own = git.is_dir() and not git.is_symlink()
    except OSError:  # not for us to look at
        own = False
    if not own:
        return History(readable=False)
    head = _git(git, "rev-list", "-1", "--format=%ct", "HEAD")
    if head is None:
        empty = _git(git, "rev-list", "-1", "--all") == ""
        return History(readable=empty)
    tree = _git(git, "ls-tree", "-z", "--full-tree", "HEAD", "--", *wanted)
    try:
        first, time = head.split("\n")[:2]
        commit, committed = first.split()[1], int(time)
    except (ValueError, IndexError):
        return History(readable=False)
    if tree is None:
        return History(readable=False)
    blobs = {}
    for entry in tree.split("\0"):
        facts, _, name = entry.partition("\t")
        if name:
            blobs[name] = facts.split()[2]
    return History(True, commit, committed, blobs)


def clean_environment(**more: str) -> dict[str, str]:
    """Return this process's environment without what points git elsewhere.

    Args:
        more: variables to add.
    """
    login = ("GIT_SSH", "GIT_SSL", "GIT_ASKPASS")  # how the teacher reaches a server
    kept = {
        name: value
        for name, value in os.environ.items()
        if not name.startswith("GIT_") or name.startswith(login)
    }
    return {**kept, "GIT_TERMINAL_PROMPT": "0", "LC_ALL": "C", **more}


def _git(git: Path, *arguments: str) -> str | None:
    """Return what git prints, or None where it fails."""
    environment = clean_environment(
        GIT_DIR=str(git.absolute()),  # none around it, and whoever owns it
        GIT_NO_LAZY_FETCH="1",
        GIT_ALLOW_PROTOCOL="none",
        GIT_NO_REPLACE_OBJECTS="1",
    )
    try:
        done = subprocess.run(
            ["git", "--no-pager", *arguments],
            cwd=git,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            encoding="utf-8",
            errors="replace",
            env=environment,
            timeout=SECONDS,
            check=False,
        )
    except (OSError, subprocess.TimeoutExpired):
        return None
    return done.stdout if done.returncode == 0 else None


def _blob_hash(data: bytes, digits: int) -> str:
    algorithm = hashlib.sha256 if digits == 64 else hashlib.sha1
    return algorithm(b"blob %d\0" % len(data) + data).hexdigest()
