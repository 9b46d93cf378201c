"""Adding lines to the log: one append, under a lock, checked before and after.

Nothing is ever rewritten to add a row, and the file is never held open: after a
git branch switch a held handle writes to a file that nobody can see any more.
"""

import contextlib
import errno
import os
import stat
import sys
import time
import warnings
from collections.abc import Iterator
from pathlib import Path

from labkit.base import lock
from labkit.log.rows import BOM, HEAD, HEADER, is_open_quote, line_end, wrong_header
from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown

OWN_LOG = ROOT / "metrics" / "metrics.csv"
UNSAVED = ".unsaved"  # the file beside the log with rows that it could not take
CUT = ".repairs"  # the file beside the log with lines that were cut off
TRIES = 5
# An echo takes no lock, and half of it shows while it is being written: look twice.
MID_WRITE_S = 0.005
_TAIL = 1 << 20  # bytes of an unfinished last line that are looked at
_FLAGS = (
    os.O_RDWR
    | os.O_APPEND
    | os.O_CREAT
    | getattr(os, "O_BINARY", 0)
    | getattr(os, "O_NOINHERIT", 0)
    | getattr(os, "O_NOCTTY", 0)
)
_AT_ONCE = getattr(os, "O_NONBLOCK", 0)  # opening a pipe would wait for ever


def command(option: str, log: Path) -> str:
    """Return what to type, in the kit's folder, to look after a log: `--check`, say."""
    start = f"python3 scripts/log_metric.py {option}"
    path = log.absolute()
    if path == OWN_LOG:
        return start
    name = str(path.relative_to(ROOT) if path.is_relative_to(ROOT) else path)
    return f'{start} --file "{name}"' if " " in name else f"{start} --file {name}"


def append_or_keep(path: Path, text: str, sync: bool) -> None:
    """Add lines to the log, or keep them beside it and say so.

    Args:
        path: the log; it is made, with its header, if it is not there.
        text: one or more lines, without the last line end.
        sync: force them to the disk before returning.

    Raises:
        Robo47Error: the log cannot take them; the message carries the text, which
            is also kept in `<log>.unsaved` where that can be written.
    """
    try:
        append(path, text, sync)
    except Robo47Error as error:
        raise Robo47Error(f"{error}\n{_keep(path, text)}") from None


def append(path: Path, text: str, sync: bool) -> None:
    """Add lines to the log in a single write; arguments as in `append_or_keep`.

    Raises:
        Robo47Error: nothing was added.
    """
    try:
        for _ in range(TRIES):
            text = _try_append(path, text, sync)
            if not text:
                return
    except OSError as error:
        why = _explanation(error, str(path))
        raise Robo47Error(f"{shown(path)}: {why}") from None
    raise Robo47Error(
        f"{shown(path)} keeps being replaced by another program."
        " Close that and try again."
    )


def unsaved_rows(path: Path) -> int:
    """Return how many refused rows wait beside the log."""
    try:
        return Path(f"{path}{UNSAVED}").read_bytes().count(b"\n")
    except OSError:
        return 0


def restore(path: Path) -> int:
    """Append the rows kept in `<log>.unsaved` and empty it; return how many.

    Raises:
        Robo47Error: the log still cannot take them; they stay where they are.
    """
    count = unsaved_rows(path)
    if not count:
        return 0
    kept = Path(f"{path}{UNSAVED}")
    try:
        with locked(kept) as fd:
            text = read_at(fd, 0, os.fstat(fd).st_size).decode()
            append(path, text.removesuffix("\n"), sync=True)
            os.ftruncate(fd, 0)
            if os.name != "nt":  # there an open file cannot be removed
                kept.unlink()
    except (Robo47Error, OSError) as error:
        raise Robo47Error(f"{error}\n  the rows are still in {shown(kept)}") from None
    return text.count("\n")


@contextlib.contextmanager
def locked(path: Path) -> Iterator[int]:
    """Open a file, made if absent, to read and append; nobody else may append."""
    try:
        fd = os.open(path, _FLAGS | _AT_ONCE, 0o666)
    except BlockingIOError:  # a file server has leased it, and gives it up when asked
        fd = os.open(path, _FLAGS, 0o666)
    try:
        if not stat.S_ISREG(os.fstat(fd).st_mode):
            raise OSError(errno.EINVAL, "not a file")
        alone = lock.lock(fd)
        try:
            yield fd
        finally:
            if alone:
                lock.unlock(fd)
    finally:
        os.close(fd)
    if not alone:
        lock.warn_once()  # afterwards, so that the row is there whatever it does


def read_at(fd: int, offset: int, count: int) -> bytes:
    """Return up to `count` bytes from an offset."""
    if sys.platform != "win32":
        return os.pread(fd, count, offset)
    os.lseek(fd, offset, os.SEEK_SET)
    return os.read(fd, count)


def _try_append(path: Path, text: str, sync: bool) -> str:
    """Append once; return the lines that another program spoilt meanwhile."""
    with locked(path) as fd:
        if not _is_at(fd, path):
            return text
        before, end, cut = _continuation(fd, path)
        data = before + text.encode().replace(b"\n", end) + end
        start = _write(fd, data, sync)
        if sync and start == 0:
            _sync_folder(path.parent)
        # A writer without a lock (bash's echo of over 4,096 bytes comes in two
        # parts) may have left half a line before ours: then our first goes again.
        seen = 0 if before else 1  # the number of lines before our first
        back = read_at(fd, start - seen, len(data) + seen)
        alone = back[:seen] in (b"", b"\n")
        there = back[seen:] == data and _is_at(fd, path)
    if cut is not None:
        _report_cut(path, cut, before)
    if not there:
        return text
    return "" if alone else text.partition("\n")[0]


def _continuation(fd: int, path: Path) -> tuple[bytes, bytes, str | None]:
    """Return what to write first, the file's line end, and its last line if cut."""
    head = read_at(fd, 0, HEAD)
    if head in (b"", BOM):
        return HEADER.encode() + b"\n", b"\n", None
    end = line_end(head)
    if end is None:
        raise Robo47Error(wrong_header(path))
    last = head[-1:] if len(head) < HEAD else _last_byte(fd)[1]
    if last == b"\n":
        return b"", end, None
    time.sleep(MID_WRITE_S)
    size, last = _last_byte(fd)
    if last == b"\n":
        return b"", end, None
    start = max(0, size - _TAIL)
    line = read_at(fd, start, size - start).rpartition(b"\n")[2]
    text = line.decode("utf-8", "replace").rstrip("\r")
    quote = b'"' if is_open_quote(text) else b""
    return quote + (b"\n" if line.endswith(b"\r") else end), end, text


def _last_byte(fd: int) -> tuple[int, bytes]:
    size = os.lseek(fd, 0, os.SEEK_END)
    return size, read_at(fd, size - 1, 1)


def _report_cut(path: Path, text: str, before: bytes) -> None:
    with (
        contextlib.suppress(OSError),
        open(f"{path}{CUT}", "a", encoding="utf-8", newline="\n") as file,
    ):
        file.write(text + before.decode().strip() + "\n")
    warnings.warn(
        f"{shown(path)}: the last line had no line end, so it may be cut. It is"
        f" kept, and the new row has a line of its own. It ends: {text[-40:]}",
        stacklevel=6,  # the caller of append_row
    )


def _write(fd: int, data: bytes, sync: bool) -> int:
    """Write all or nothing; return the offset where it went."""
    before = os.lseek(fd, 0, os.SEEK_END)
    try:
        if os.write(fd, data) < len(data):
            raise OSError(errno.ENOSPC, "only a part was written")
        end = os.lseek(fd, 0, os.SEEK_CUR)
        if sync:
            _sync(fd)
    except OSError:
        with contextlib.suppress(OSError):
            piece = read_at(fd, before, len(data) + 1)
            if piece and data.startswith(piece):  # ours, and nothing after it
                os.ftruncate(fd, before)
        raise
    return end - len(data)


def _sync(fd: int) -> None:
    if sys.platform == "darwin":  # there fsync stops at the drive's own cache
        import fcntl

        fcntl.fcntl(fd, fcntl.F_FULLFSYNC)
    else:
        os.fsync(fd)


def _sync_folder(folder: Path) -> None:
    """Make a new file's name as durable as its content."""
    if os.name == "nt":
        return
    fd = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(fd)
    finally:
        os.close(fd)


def _is_at(fd: int, path: Path) -> bool:
    try:
        return os.path.samestat(os.fstat(fd), os.stat(path))
    except FileNotFoundError:
        return False


def _keep(path: Path, text: str) -> str:
    """Put refused lines beside the log; return what to tell the person."""
    kept = Path(f"{path}{UNSAVED}")
    rows = "".join(f"  row: {line}\n" for line in text.split("\n"))
    them = "them" if "\n" in text else "it"
    with contextlib.suppress(OSError):  # the folder itself may be gone
        later = f"to add {them} later:\n  {command('--restore', path)}"
        for _ in range(TRIES):
            with locked(kept) as fd:
                if _is_at(fd, kept):  # it may also have been removed by a restore
                    _write(fd, text.encode() + b"\n", sync=True)
                    return f"{rows}  kept in {shown(kept)}; {later}"
    return f"{rows}  kept nowhere but here: copy {them}"


def _explanation(error: OSError, name: str) -> str:
    """Return what an error with the log of that name means, and what to do about it."""
    if os.path.isdir(name):
        return "a folder is in the log's place. Move that folder away."
    if error.errno in (errno.ENOSPC, getattr(errno, "EDQUOT", errno.ENOSPC)):
        return "the disk is full. Free some space."
    if error.errno == errno.EFBIG:
        return "the file may not grow further (see `ulimit -f`). Raise that limit."
    if error.errno in (errno.EACCES, errno.EPERM, errno.EROFS):
        return (
            "it is read-only, or another program has it open. Make it and its"
            " folder writable (chmod u+w), or close that program."
        )
    if error.errno in (errno.ENOENT, errno.ENOTDIR):
        return "its folder does not exist. Make that folder, or correct the path."
    if error.errno == errno.EINVAL:
        return "it is not a regular file. Name a .csv file."
    if isinstance(error, TimeoutError):
        return f"{error}. End or continue that program."
    return f"{error.strerror or error}. Fix that and try again."
