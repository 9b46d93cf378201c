"""The common parts of all commands: help, colour, errors, the exit code."""

from __future__ import annotations  # the doctor runs on old Pythons too

import argparse
import contextlib
import errno
import functools
import os
import shutil
import sys
import textwrap
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NoReturn, TextIO

from robo47.errors import Robo47Error
from robo47.paths import METRICS_CSV, shown

WIDTH = 80  # columns that everything the kit prints fits in
EXIT_OK, EXIT_FAILED, EXIT_CANNOT_RUN = 0, 1, 2  # 70, a crash: see scripts/kit.py
NOT_YET = "ROBO47_NOT_YET"  # the variable by which make asks for another code than 1
_FULL = {errno.ENOSPC, errno.EFBIG, getattr(errno, "EDQUOT", errno.ENOSPC)}
_REFUSALS = {errno.EACCES, errno.EPERM, errno.EROFS, *_FULL}
_PAINT = {"good": "32", "bad": "31", "note": "33"}  # green, red, yellow


class _Parser(argparse.ArgumentParser):
    """A parser that says in one line what it cannot read."""

    def error(self, message: str) -> NoReturn:
        complain(f"error: {message}; see --help")
        sys.exit(EXIT_CANNOT_RUN)


def day(text: str) -> int:
    """Return a day's number, as it was typed."""
    if not text.isdecimal():
        says = f"{text!r} is no day; expected its number, such as 3"
        raise argparse.ArgumentTypeError(says)
    return int(text)


def week(text: str) -> int:
    """Return a week's number, as it was typed."""
    if not text.isdecimal():
        says = f"{text!r} is no week; expected its number, such as 1"
        raise argparse.ArgumentTypeError(says)
    return int(text)


def parser(about: str | None) -> argparse.ArgumentParser:
    """Return the parser of a script whose docstring is its help, lists as they are."""
    summary, *paragraphs = (about or "").strip().split("\n\n")
    return _Parser(
        description=wrapped(" ".join(summary.split())),
        epilog="\n\n".join(
            text if "\n  " in "\n" + text else wrapped(" ".join(text.split()))
            for text in paragraphs
        ),
        formatter_class=functools.partial(
            argparse.RawDescriptionHelpFormatter, width=WIDTH - 1
        ),
    )


def add_week(it: argparse.ArgumentParser) -> None:
    """Add the number of a week, and --day: the week that has it."""
    says = "default: that of the day worked on last"
    it.add_argument("week", type=week, nargs="?", help=says)
    it.add_argument("--day", type=day, metavar="N", help="the week of this day")


def add_log(it: argparse.ArgumentParser) -> None:
    """Add --file: which log."""
    says = "the log; default metrics/metrics.csv"
    it.add_argument("--file", type=Path, default=METRICS_CSV, metavar="CSV", help=says)


def paint(text: str, mood: str, stream: TextIO | None = None) -> str:
    """Return text in colour, or as it is where no colour is wanted.

    Args:
        text: a verdict, such as "PASS" or "to do".
        mood: "good", "bad" or "note".
        stream: where it will be printed; standard output by default.
    """
    if not wants_colour(stream or sys.stdout):
        return text
    return f"\x1b[{_PAINT[mood]}m{text}\x1b[0m"


def verdict(passed: bool) -> str:
    """Return PASS or FAIL in its colour."""
    return paint("PASS", "good") if passed else paint("FAIL", "bad")


def conclude(passed: bool, says: str) -> int:
    """Print a command's last line, PASS or FAIL and why; return its exit code."""
    print(f"{verdict(passed)}  {says}")
    return EXIT_OK if passed else EXIT_FAILED


def wants_colour(stream: TextIO) -> bool:
    """Return whether to paint: a terminal, and nobody said NO_COLOR."""
    plain = os.environ.get("NO_COLOR") or os.environ.get("TERM") == "dumb"
    return stream.isatty() and not plain


def wrapped(text: str, indent: str = "") -> str:
    """Return text in lines that fit, indented but for the first; its breaks stay."""
    columns = min(WIDTH, shutil.get_terminal_size().columns) - 1
    return "\n".join(
        textwrap.fill(
            line,
            max(columns, 20),
            subsequent_indent=indent,
            break_long_words=False,
            break_on_hyphens=False,
        )
        for line in text.splitlines()
    )


def complain(text: str) -> None:
    """Print what went wrong: wrapped on a terminal, one line for a program to read."""
    print(wrapped(text) if sys.stderr.isatty() else text, file=sys.stderr)


@contextlib.contextmanager
def busy(what: str) -> Iterator[None]:
    """Say on a terminal that something is going on, and take it back at the end."""
    shown = sys.stderr.isatty()
    if shown:
        print(f"{what} ...", end="\r", file=sys.stderr, flush=True)
    try:
        yield
    finally:
        if shown:
            print(" " * (len(what) + 4), end="\r", file=sys.stderr, flush=True)


def print_nowhere() -> None:
    """Let Python, at its end, print what is left where nobody reads any more."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def run(main: Callable[[], int]) -> None:
    """Run a command's `main` and exit with its code, never with a traceback.

    Args:
        main: returns the exit code: 0 all well, 1 something to fix, 2 could not run.
    """
    with _code_of_not_yet() as not_yet:
        code = _code_of(main)
    sys.exit(not_yet if code == EXIT_FAILED else code)


def go_on_in(command: list[str]) -> NoReturn:
    """Become another command, which ends with the code that make asked for as well."""
    if _asked:
        os.environ[NOT_YET] = _asked[-1]
    os.execv(command[0], command)


_asked: list[str] = []  # the code of "not yet", where make asked for another


@contextlib.contextmanager
def _code_of_not_yet() -> Iterator[int]:
    """Give the code of "not yet"; programs that are started here use the usual one."""
    asked = os.environ.pop(NOT_YET, "")
    _asked[:] = [asked] if asked.isdecimal() else []
    try:
        yield int(_asked[0]) if _asked else EXIT_FAILED
    finally:
        if asked:
            os.environ[NOT_YET] = asked


_at_end: list[Callable[[], None]] = []


def at_end(call: Callable[[], None]) -> None:
    """Call this when the command ends or stops, before its error is printed."""
    _at_end.append(call)


def _ended(main: Callable[[], int]) -> int:
    """Run `main`, and then what was asked for `at_end`."""
    try:
        return main()
    finally:
        while _at_end:
            _at_end.pop()()


def _code_of(main: Callable[[], int]) -> int:
    """Return the exit code of a command, and print one line if it could not run."""
    warnings.formatwarning = lambda message, *_, **__: f"warning: {message}\n"
    try:
        code = _ended(main)
        sys.stdout.flush()
    except Robo47Error as error:
        complain(f"error: {error}")
        code = EXIT_CANNOT_RUN
    except NotImplementedError as gap:  # a task of a starter that is still to do
        complain(f"to do: {gap}")
        code = EXIT_FAILED
    except BrokenPipeError:  # `... | head` closed early: nobody is left to tell
        print_nowhere()
        code = EXIT_OK
    except OSError as error:  # the machine's no, not a mistake of ours
        # An error without a file name comes from the output.
        full = error.errno in _FULL and not error.filename
        if not full and (error.errno not in _REFUSALS or not error.filename):
            raise
        if full:
            print_nowhere()  # Python would raise the error again at exit
        where = "the output" if full else shown(Path(error.filename).absolute())
        complain(f"error: {where}: {error.strerror}. Fix that and run this again.")
        code = EXIT_CANNOT_RUN
    except KeyboardInterrupt:
        print("\nstopped", file=sys.stderr)
        code = 130
    return code
