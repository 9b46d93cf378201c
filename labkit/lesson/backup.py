"""Replaces a student's file and keeps a copy of the former one beside it."""

from itertools import count
from pathlib import Path

from labkit.base import store


def rewrite(work: Path, text: str, why: str) -> Path:
    """Write a lab anew with its own line ends; return where it is as it was."""
    before = work.read_bytes()
    kept = free_name(work, why)
    store.replace(kept, before)
    store.replace(work, with_ends_of(before, text))
    return kept


def with_ends_of(before: bytes, text: str) -> bytes:
    """Return a text to write in the place of `before`, with the line ends of that."""
    end = "\r\n" if b"\r\n" in before else "\n"
    return text.replace("\n", end).encode()


def free_name(work: Path, task_id: str) -> Path:
    """Return a name beside the student's file that nothing has yet."""
    names = (work.with_suffix(f".before-{task_id}-{n}.txt") for n in count(1))
    return next(name for name in names if not name.exists())
