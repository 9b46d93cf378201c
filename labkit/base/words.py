"""Words that the log's messages share: how many, which command, why it failed."""

import errno
import os
from pathlib import Path

from robo47.paths import ROOT

OWN_LOG = ROOT / "metrics" / "metrics.csv"


def count(number: int, thing: str) -> str:
    """Return "1 row", "2 rows", "1,000 rows"."""
    return f"{number:,} {thing}" if number == 1 else f"{number:,} {thing}s"


def number_of(value: float) -> str:
    """Return a number as a lab prints it: rounding errors short, others readable."""
    if value != value or abs(value) < 1e-3 or abs(value) >= 1e4:
        return f"{value:.1e}" if value else "0"
    return f"{value:.4g}"


def command(option: str, log: Path) -> str:
    """Return what to type, in the kit's folder, to look after a log: `--check`, say."""
    start = f"python3 scripts/log_metric.py {option}"
    path = log.absolute()
    if path == OWN_LOG:
        return start
    name = str(path.relative_to(ROOT) if path.is_relative_to(ROOT) else path)
    return f'{start} --file "{name}"' if " " in name else f"{start} --file {name}"


def in_words(error: OSError, name: str) -> str:
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
