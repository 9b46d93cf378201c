"""Queries of a clone through git that do not trust the clone's configuration.

A clone that was handed in as an archive brings its own `.git/config`, which can name
programs to run. So only commands that read objects are used: no index, no filter, no
hook, no pager, no fetch. Whether a file is committed as it is follows from its hash.

What a foreign repository may hold is decided here, before git looks at it: files and
folders alone, so many, so large, none that leads elsewhere; and how much a commit may
write when it is checked out. Git has its time; what takes longer is the repository's
fault.
"""

from __future__ import annotations  # the doctor runs on old Pythons too

import hashlib
import os
import re
import stat
import subprocess
import tempfile
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from labkit.base import processes

SECONDS = 20.0
SHA = 7  # letters, as `git rev-parse --short` prints for a repository of this size
LARGEST_OBJECT = "100m"  # bytes that git may take at once; a small file can claim more
# The limits of a git folder: files, bytes.
MOST_ENTRIES, LARGEST_GIT = 50_000, 1_000_000_000
DEEPEST = 100  # folders in each other that a commit may write
MOST_FILES = 10_000  # the limit of a commit; the kit has 1,400 files
LARGEST_TREE = 200_000_000  # bytes of a commit's files; the kit has 6 MB
LARGEST_OUTPUT = 20_000_000  # bytes that git may say
LARGEST_CONFIG = 100_000  # bytes of a repository's configuration
LARGEST_COMMIT = 100_000  # bytes; git takes two hundred times as much to parse one
# The beginning of a HEAD that names a branch.
HEAD_OF, LARGEST_NAME = "ref: refs/heads/", 300
YEAR_2100 = 4_102_444_800
SEEN = "refs/robo47/"  # the refs of heads that a later push took back
PULLED = f"{SEEN}pulled/"  # heads, each under the teacher's time of the first pull
# Files that name other object stores.
_ELSEWHERE = ("commondir", "objects/info/alternates")


class GitError(Exception):
    """Git is not there, or did not answer in time: the machine's fault."""


class _SlowError(GitError):
    """Git had its time and did not wait for a processor: the repository's fault."""


@dataclass(frozen=True)
class History:
    """The last commit of a clone."""

    readable: bool  # git can read a repository here
    commit: str = ""  # its hash; "" where there is no commit yet
    # The time that its author gave it, seconds since 1970, or None.
    committed: int | None = None
    author: str = ""  # the name that its author gave; anybody can type any
    branch: str = ""  # the branch of HEAD; "" if HEAD names none
    # Hash of each wanted file in it, by path.
    blobs: Mapping[str, str] = field(default_factory=dict)

    def holds(self, name: str, data: bytes | None) -> bool:
        """Return whether a file is committed as it is; None asks for its name alone."""
        blob = self.blobs.get(name)
        if blob is None or data is None:
            return blob is not None
        # git on Windows may have written CRLF where the commit has LF
        versions = (data, data.replace(b"\r\n", b"\n"))
        sha = hashlib.sha256 if len(blob) == 64 else hashlib.sha1
        return blob in (sha(b"blob %d\0" % len(v) + v).hexdigest() for v in versions)


def read_history(
    clone: Path, wanted: Iterable[str], *, own: bool = False, at: str = "HEAD"
) -> History:
    """Return the last commit of a clone.

    Args:
        clone: the student's folder; a repository around it does not count.
        wanted: paths whose hashes to return.
        own: it is the reader's own, which may be a linked worktree.
        at: another commit to look at.

    Raises:
        GitError: git is not there, or takes too long.
    """
    git = _repository(clone, own)
    named = _git(git, "cat-file", "--batch-check=%(objectname) %(objectsize)", say=at)
    if named is None:  # a command that used all its time is not repeated
        return History(readable=False)
    commit, _, size = named.strip().partition(" ")
    if not size.isdecimal():
        return History(readable=_git(git, "rev-list", "-1", "--all") == "")
    if int(size) > LARGEST_COMMIT:
        return History(readable=False)
    text = _git(git, "cat-file", "commit", commit)
    listing = ("ls-tree", "-z", "--full-tree", commit, "--", *wanted)
    tree = text and _git(git, *listing)
    if tree is None:
        return History(readable=False)
    entries = (entry.partition("\t") for entry in tree.split("\0"))
    blobs = {name: facts.split()[2] for facts, _, name in entries if name}
    author, _ = _signed(text, "author")
    _, committed = _signed(text, "committer")
    return History(True, commit, committed, author, _branch_of(git), blobs)


def branch_of(clone: Path) -> str:
    """Return the branch that a clone's HEAD names; "" where it names none."""
    return _branch_of(_repository(clone))


def _branch_of(git: Path | None) -> str:
    try:
        with open(git / "HEAD" if git else os.devnull, "rb") as file:
            text = file.read(LARGEST_NAME).decode("utf-8", "replace").strip()
    except OSError:
        return ""
    return text.removeprefix(HEAD_OF) if text.startswith(HEAD_OF) else ""


def user_name(clone: Path) -> str:
    """Return the name that git would put under a commit made here; "" for none.

    Args:
        clone: the reader's own; another's configuration is not read.
    """
    done = run("config", "--get", "user.name", folder=clone, seconds=SECONDS)
    return done.stdout.strip() if done.returncode == 0 else ""


def author_of(clone: Path, files: str) -> str:
    """Return who is named as the author of the last commit of some files.

    Args:
        clone: a student's folder; "" where no commit has such a file.
        files: "w*/work/**".

    Raises:
        GitError: git is not there, or takes too long.
    """
    git = _repository(clone)
    listing = ("rev-list", "-1", "HEAD", "--", f":(glob){files}")
    commit = (_git(git, *listing) or "").strip()
    return read_history(clone, (), at=commit).author if commit else ""


def before(clone: Path, moment: int, own: str) -> tuple[str, int]:
    """Return the last commit up to a moment, as it was pulled or by its own clock.

    A newer kit, merged too late, brings commits from before that moment: where the last
    one has nothing of the student's, it is the last of those that were made here.

    Args:
        clone: a student's folder.
        moment: seconds since 1970.
        own: "w1-foundations/work/": what stands there no commit of the kit's has.

    Returns:
        Its hash, "" where there is none, and how many commits of HEAD came later. What
        `make grade` saw before a push that took it back counts, too.

    Raises:
        GitError: git is not there, or takes too long.
    """
    git = _repository(clone)
    last = ("rev-list", "-1", f"--min-age={moment}", "HEAD", f"--glob={SEEN}*")
    found = (_git(git, *last) or "").strip()
    if found and not files_of(clone, found, own):
        found = (_git(git, *last, "--first-parent") or "").strip() or found
    seen = _pulled(git, moment)
    dated = ("rev-list", "--no-walk", f"--max-age={moment + 1}")
    if seen and _git(git, *dated, seen[-1]):  # its clock is wrong: it was there by then
        ancestor = ("merge-base", "--is-ancestor", seen[-1], found)
        found = found if found and _git(git, *ancestor) is not None else seen[-1]
    without = [f"^{commit}" for commit in seen]
    count = ("rev-list", "--count", f"--max-age={moment + 1}", "HEAD")
    later = _git(git, *count, *without)
    return found, int((later or "").strip() or 0)


def _pulled(git: Path | None, moment: int) -> list[str]:
    """Return the commits that `make grade` had pulled by a moment, the last last."""
    return [commit for time, commit in _pulls(git) if time <= moment]


def _pulls(git: Path | None) -> list[tuple[int, str]]:
    """Return when which commits were pulled first, by the teacher's clock, sorted."""
    listed = _git(git, "for-each-ref", "--format=%(refname) %(objectname)", PULLED)
    heads = (line.removeprefix(PULLED).split() for line in (listed or "").splitlines())
    return sorted((int(time), commit) for time, commit in heads if time.isdecimal())


def pulled_at(clone: Path, commit: str) -> int | None:
    """Return when `make grade` pulled a commit first; None where it never did.

    Args:
        clone: a student's folder.
        commit: its hash.

    Raises:
        GitError: git is not there, or takes too long.
    """
    pulls = _pulls(_repository(clone))
    return next((time for time, pulled in pulls if pulled == commit), None)


def files_of(clone: Path, commit: str, *names: str) -> dict[str, tuple[str, int]]:
    """Return plain files of a commit: hash and bytes of each, by path.

    Args:
        clone: a student's folder.
        commit: its hash.
        names: paths; one that ends with "/" means what is right below it.
    """
    listing = ("ls-tree", "-lz", "--full-tree", commit, "--")
    listed = _git(_repository(clone), *listing, *names) if names else ""
    found = {}
    for entry in (listed or "").split("\0")[:-1]:
        facts, _, name = entry.partition("\t")
        mode, kind, blob, size = facts.split()
        # Git prints "BAD" as the size of a blob that the repository has lost
        if kind == "blob" and mode.startswith("100") and size.isdecimal():
            found[name] = (blob, int(size))
    return found


def mode_of(clone: Path, commit: str, name: str) -> str:
    """Return the mode that a commit has for a path, "160000" a submodule's; or ""."""
    listing = ("ls-tree", "-z", "--full-tree", commit, "--", name)
    return (_git(_repository(clone), *listing) or "").partition(" ")[0]


def branches_of(clone: Path) -> list[str]:
    """Return the full names of a clone's branches, those of its servers after them."""
    listing = ("for-each-ref", "--format=%(refname)", "refs/heads", "refs/remotes")
    names = (_git(_repository(clone), *listing) or "").splitlines()
    return [name for name in names if not name.endswith("/HEAD")]


def ignored_by(folder: Path, name: str) -> str:
    """Return which line ignores a path, ".gitignore, line 3", or "".

    Args:
        folder: a repository of the reader's own.
        name: a path in it.

    Raises:
        GitError: git is not there, or takes too long.
    """
    command = ("check-ignore", "-v", "--", name)
    said = run(*command, folder=folder, seconds=SECONDS).stdout
    found = re.match(r"(.+?):(\d+):", said)
    return f"{found[1]}, line {found[2]}" if found else ""


def blob(clone: Path, name: str) -> bytes:
    """Return the content of an object, b"" where git cannot read it."""
    return _git(_repository(clone), "cat-file", "blob", name, text=False) or b""


def short_sha(folder: Path) -> str:
    """Return the short commit id that HEAD names, or "" outside a repository."""
    try:
        return (_git(folder / ".git", "rev-parse", "--verify", "HEAD") or "")[:SHA]
    except (GitError, OSError):  # a folder that is not for us to look into
        return ""


def too_much(folder: Path, commit: str) -> str:
    """Return why a commit of our own clone is not to be checked out; "" where it is.

    Args:
        folder: the clone.
        commit: its name; one that is not there yet writes nothing.

    Raises:
        GitError: git is not there, or takes too long.
    """
    where: dict[str, Any] = {"folder": folder, "seconds": SECONDS}
    # A line of git's on a file with a name of 300 letters has 400.
    where |= {"largest": MOST_FILES * 400, "GIT_NO_REPLACE_OBJECTS": "1"}
    if run("rev-parse", "-q", "--verify", commit, **where).returncode:
        return ""
    listed = run("ls-tree", "-rlz", "--full-tree", commit, **where)
    entries = listed.stdout.split("\0")[:-1]
    if any(entry.count("/") > DEEPEST for entry in entries):
        return f"the last commit has folders more than {DEEPEST} deep in each other"
    sizes = [entry.split(None, 4)[3] for entry in entries]
    size = sum(int(one) for one in sizes if one.isdecimal())
    if listed.returncode or len(sizes) > MOST_FILES or size > LARGEST_TREE:
        most = f"{MOST_FILES:,} files, {LARGEST_TREE // 1_000_000} MB"
        return f"the last commit is too large to check out (at most {most})"
    return ""


def run(
    *arguments: str,
    folder: Path,
    seconds: float,
    say: str = "",
    largest: int = LARGEST_OUTPUT,
    text: bool = True,
    **more: str,
) -> subprocess.CompletedProcess[Any]:
    """Run git and return what became of it; all that it started ends with it.

    Args:
        arguments: after `git`.
        folder: where.
        seconds: the limit.
        say: its standard input.
        largest: bytes of a file that it writes, and of what it says (Linux).
        text: what it says is text, else bytes.
        more: variables of its environment.

    Raises:
        GitError: git is not there, or took longer.
    """
    command = ["git", "--no-pager", *arguments]
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        try:
            process = subprocess.Popen(
                command,
                cwd=folder,
                stdin=subprocess.PIPE,
                stdout=out,
                stderr=err,
                env=_environment(**more),
                **processes.start_options(),  # type: ignore[call-overload]
            )
        except OSError as error:
            says = f"git cannot be run: {error.strerror}; install git"
            raise GitError(says) from None
        _wait(process, say, seconds, largest)
        if processes.was_killed(process):
            raise GitError("git was killed")
        said: list[Any] = []
        for file in (out, err):
            file.seek(0)
            said.append(file.read(LARGEST_OUTPUT))
    if text:
        said = [each.decode("utf-8", "replace") for each in said]
    return subprocess.CompletedProcess(command, process.returncode, *said)


def _wait(
    process: subprocess.Popen[bytes], say: str, seconds: float, largest: int
) -> None:
    """Tell git what it is to read, and wait for its end; arguments as in `run`."""
    try:
        processes.limit_files(process, largest)
        process.communicate(say.encode(), timeout=seconds)
    except subprocess.TimeoutExpired:
        ran, waited = processes.scheduled(process)
        starved = waited > seconds / 2 and ran < (seconds - waited) / 2
        kind = GitError if starved else _SlowError
        raise kind(f"git took more than {seconds:.0f} s") from None
    finally:
        processes.end(process)
        if process.stdin:
            process.stdin.close()


def _repository(clone: Path, own: bool = False) -> Path | None:
    """Return the git folder of a clone, or None."""
    git = clone / ".git"
    try:
        if own:
            return git.absolute() if git.exists() else None
        plain = stat.S_ISDIR(git.lstat().st_mode) and _is_plain(git)
        return git.absolute() if plain else None
    except OSError:  # none, or not for us to look at
        return None


def _is_plain(git: Path) -> bool:
    """Return whether a git folder is files and folders alone, and of a sane size.

    At a pipe git would wait for ever, whatever it is the name of.
    """
    waiting = [str(git)]
    entries = 0
    size = 0
    while waiting:
        with os.scandir(waiting.pop()) as found:
            for entry in found:
                entries += 1
                if entry.is_dir(follow_symlinks=False):
                    waiting.append(entry.path)
                elif entry.is_file(follow_symlinks=False):
                    size += entry.stat(follow_symlinks=False).st_size
                else:
                    return False
                if entries > MOST_ENTRIES or size > LARGEST_GIT:
                    return False
    if any(os.path.lexists(git / name) for name in _ELSEWHERE):
        return False
    configs = filter(Path.exists, (git / "config", git / "config.worktree"))
    return all(
        config.stat().st_size <= LARGEST_CONFIG
        and b"[include" not in config.read_bytes().lower()  # another file
        for config in configs
    )


def _environment(**more: str) -> dict[str, str]:
    """Return this process's environment without what points git elsewhere."""
    # Settings by which a teacher reaches a server.
    login = ("GIT_SSH", "GIT_SSL", "GIT_ASKPASS")
    kept = {
        name: value
        for name, value in os.environ.items()
        if not name.startswith("GIT_") or name.startswith(login)
    }
    return {**kept, "GIT_TERMINAL_PROMPT": "0", "LC_ALL": "C", **more}


def _git(git: Path | None, *arguments: str, **more: Any) -> Any:
    """Return what git prints; None where it fails, or the repository is too much."""
    if git is None:
        return None
    try:
        done = run(
            *arguments,
            # The .git of a worktree is a file.
            folder=git if git.is_dir() else git.parent,
            seconds=SECONDS,
            GIT_ALLOC_LIMIT=LARGEST_OBJECT,
            GIT_DIR=str(git),  # none around it, and whoever owns it
            GIT_NO_LAZY_FETCH="1",
            GIT_ALLOW_PROTOCOL="none",
            GIT_NO_REPLACE_OBJECTS="1",
            **more,
        )
    except _SlowError:
        return None
    return done.stdout if done.returncode == 0 else None


def _signed(commit: str, role: str) -> tuple[str, int | None]:
    """Return who a commit's text names as "author" or "committer", and when.

    Without the address; None is a time that cannot be.
    """
    lines = commit.partition("\n\n")[0].splitlines()
    line = next((line for line in lines if line.startswith(f"{role} ")), f"{role} ")
    name = line.removeprefix(f"{role} ")
    seconds = line.rsplit(" ", 2)[-2]
    plain = seconds.isdecimal() and len(seconds) < 12
    when = int(seconds) if plain and int(seconds) < YEAR_2100 else None
    return name.rpartition("<")[0].strip(), when
