"""What git says of a clone, asked without trusting the clone's configuration.

A clone that was handed in as an archive brings its own `.git/config`, which can name
programs to run. So only commands that read objects are used: no index, no filter, no
hook, no pager, no fetch. Whether a file is committed as it is follows from its hash.
"""

import hashlib
import os
import stat
import subprocess
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from labkit.base import processes

SECONDS = 20.0
SHA = 7  # letters, as `git rev-parse --short` prints for a repository of this size
LARGEST_OBJECT = "100m"  # bytes that git may take at once; a small file can claim more
LARGEST_COMMIT = 100_000  # bytes; git takes two hundred times as much to parse one
YEAR_2100 = 4_102_444_800
_READ = ("HEAD", "config", "packed-refs")  # git would wait for ever at a pipe


class GitError(Exception):
    """Git is not there, or did not answer in time: the machine's fault."""


class _BusyError(GitError):
    """Git worked all the time that it had: the repository's fault."""


@dataclass(frozen=True)
class History:
    """The last commit of a clone.

    Attributes:
        readable: whether there is a repository that git can read.
        commit: its hash; "" where there is no commit yet.
        committed: the time that its author gave it, seconds since 1970, or None.
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
            data: its content; None where only its name counts.
        """
        blob = self.blobs.get(name)
        if blob is None or data is None:
            return blob is not None
        # git on Windows may have written CRLF where the commit has LF
        versions = (data, data.replace(b"\r\n", b"\n"))
        return blob in (_blob_hash(version, len(blob)) for version in versions)


def read_history(clone: Path, wanted: Iterable[str], *, own: bool = False) -> History:
    """Return the last commit of a clone.

    Args:
        clone: the student's folder; a repository around it does not count.
        wanted: paths whose hashes to return.
        own: it is the reader's own, which may be a linked worktree.

    Raises:
        GitError: git is not there, or takes too long.
    """
    git = _repository(clone, own)
    if git is None:
        return History(readable=False)
    named = _git(
        git, "cat-file", "--batch-check=%(objectname) %(objectsize)", say="HEAD"
    )
    commit, _, size = (named or "").strip().partition(" ")
    if not size.isdecimal():
        return History(readable=_git(git, "rev-list", "-1", "--all") == "")
    if int(size) > LARGEST_COMMIT:
        return History(readable=False)
    text = _git(git, "cat-file", "commit", commit)
    tree = _git(git, "ls-tree", "-z", "--full-tree", commit, "--", *wanted)
    if text is None or tree is None:
        return History(readable=False)
    entries = (entry.partition("\t") for entry in tree.split("\0"))
    blobs = {name: facts.split()[2] for facts, _, name in entries if name}
    return History(True, commit, _time(text), blobs)


def short_sha(folder: Path) -> str:
    """Return the short commit id that HEAD names, or "" outside a repository.

    Args:
        folder: the working tree's top folder: a clone or a linked worktree.
    """
    try:
        return (_git(folder / ".git", "rev-parse", "--verify", "HEAD") or "")[:SHA]
    except GitError:
        return ""


def run(
    *arguments: str, folder: Path, seconds: float, say: str = "", **more: str
) -> subprocess.CompletedProcess[str]:
    """Run git and return what became of it; all that it started ends with it.

    Args:
        arguments: after `git`.
        folder: where.
        seconds: the limit.
        say: its standard input.
        more: variables of its environment.

    Raises:
        GitError: git is not there, or took longer.
    """
    command = ["git", "--no-pager", *arguments]
    try:
        process = subprocess.Popen(
            command,
            cwd=folder,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            env=_environment(**more),
            **processes.start_options(),  # type: ignore[call-overload]
        )
    except OSError as error:
        raise GitError(f"git cannot be run: {error.strerror}; install git") from None
    try:
        out, err = process.communicate(say.encode(), timeout=seconds)
    except subprocess.TimeoutExpired:
        ran, waited = processes.scheduled(process)
        busy = ran > (seconds - waited) / 2
        kind = _BusyError if busy else GitError
        raise kind(f"git took more than {seconds:.0f} s") from None
    finally:
        processes.end(process)
        for stream in (process.stdin, process.stdout, process.stderr):
            stream.close()
    if processes.was_killed(process):
        raise GitError("git was killed")
    texts = (data.decode("utf-8", "replace") for data in (out, err))
    return subprocess.CompletedProcess(command, process.returncode, *texts)


def _repository(clone: Path, own: bool) -> Path | None:
    """Return the git folder of a clone, or None."""
    git = clone / ".git"
    try:
        if own:
            return git.absolute() if git.exists() else None
        if not stat.S_ISDIR(git.lstat().st_mode) or (git / "commondir").exists():
            return None
        modes = [(git / n).lstat().st_mode for n in _READ if os.path.lexists(git / n)]
        return git.absolute() if all(map(stat.S_ISREG, modes)) else None
    except OSError:  # none, or not for us to look at
        return None


def _environment(**more: str) -> dict[str, str]:
    """Return this process's environment without what points git elsewhere."""
    login = ("GIT_SSH", "GIT_SSL", "GIT_ASKPASS")  # how the teacher reaches a server
    kept = {
        name: value
        for name, value in os.environ.items()
        if not name.startswith("GIT_") or name.startswith(login)
    }
    return {**kept, "GIT_TERMINAL_PROMPT": "0", "LC_ALL": "C", **more}


def _git(git: Path, *arguments: str, say: str = "") -> str | None:
    """Return what git prints, or None where it fails or the repository is too much."""
    try:
        done = run(
            *arguments,
            folder=git if git.is_dir() else git.parent,  # in a worktree it is a file
            seconds=SECONDS,
            say=say,
            GIT_ALLOC_LIMIT=LARGEST_OBJECT,
            GIT_DIR=str(git),  # none around it, and whoever owns it
            GIT_NO_LAZY_FETCH="1",
            GIT_ALLOW_PROTOCOL="none",
            GIT_NO_REPLACE_OBJECTS="1",
        )
    except _BusyError:
        return None
    return done.stdout if done.returncode == 0 else None


def _time(commit: str) -> int | None:
    """Return the committer's time of a commit's text; None where it is none."""
    for line in commit.partition("\n\n")[0].splitlines():
        if line.startswith("committer "):
            seconds = line.rsplit(" ", 2)[-2]
            if seconds.isdecimal() and len(seconds) < 12:
                return int(seconds) if int(seconds) < YEAR_2100 else None
    return None


def _blob_hash(data: bytes, digits: int) -> str:
    algorithm = hashlib.sha256 if digits == 64 else hashlib.sha1
    return algorithm(b"blob %d\0" % len(data) + data).hexdigest()
