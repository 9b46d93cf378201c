"""Three versions of a text made one, where no line of the student's may be lost.

So a lab on a newer kit: theirs is kept, the kit's lines around it are new.
"""

import re
import tempfile
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

from labkit.base import git
from labkit.lesson.day import Day
from labkit.lesson.renames import arguments_as_now, called_as_now
from labkit.lesson.starter import function_lines, make_starter, put_back
from robo47.errors import Robo47Error

Lines = Sequence[str]
Settle = Callable[[Lines, Lines, Lines], Lines]
MARKER = 39  # letters of a conflict's marks: nobody's text has such lines
_CONFLICT = re.compile(
    rf"^<{{{MARKER}}} .*\n(?P<ours>(?:.*\n)*?)^\|{{{MARKER}}} .*\n(?P<base>(?:.*\n)*?)"
    rf"^={{{MARKER}}}\n(?P<theirs>(?:.*\n)*?)^>{{{MARKER}}} .*\n",
    re.MULTILINE,
)


def merged(base: str, ours: str, theirs: str, settle: Settle) -> str:
    """Return what ours and theirs have made of base.

    Args:
        base: the text that both began with.
        ours: the student's.
        theirs: the kit's.
        settle: makes the lines of both, given base's, ours and theirs, one where they
            changed the same ones.

    Raises:
        GitError: git is not there.
    """

    def settled(found: re.Match[str]) -> str:
        lines = (found[name].splitlines() for name in ("base", "ours", "theirs"))
        return "".join(f"{line}\n" for line in settle(*lines))

    return _CONFLICT.sub(settled, _merge_file(base, ours, theirs))


def keep_ours(base: Lines, ours: Lines, theirs: Lines) -> Lines:
    """Return the student's lines."""
    return ours


def keep_both(base: Lines, ours: Lines, theirs: Lines) -> Lines:
    """Return the student's lines with headings as now, and the kit's new ones below."""
    heads = [[ln for ln in lines if ln.startswith("#")] for lines in (base, theirs)]
    now = dict(zip(*heads, strict=True)) if len(heads[0]) == len(heads[1]) else {}
    kept = [now.get(line, line) for line in ours]
    return kept + [ln for ln in theirs if ln not in base and ln not in kept]


def _merge_file(base: str, ours: str, theirs: str) -> str:
    with tempfile.TemporaryDirectory() as folder:
        for name, text in (("ours", ours), ("base", base), ("theirs", theirs)):
            whole = text if text.endswith("\n") or not text else f"{text}\n"
            (Path(folder) / name).write_text(whole, "utf-8", newline="\n")
        how = ("-p", "--diff3", f"--marker-size={MARKER}", "ours", "base", "theirs")
        done = git.run("merge-file", *how, folder=Path(folder), seconds=git.SECONDS)
    if done.returncode < 0 or done.returncode > 127:
        raise git.GitError(done.stderr.strip())
    return done.stdout


def renewed(day: Day, text: str, before: Iterable[str], now: str) -> str:
    """Return a student's lab with what is new in the kit's.

    Functions, helpers and constants of theirs stay; where both changed the same line it
    is theirs, but for `main`, which is the kit's recipe.

    Args:
        day: from the newer kit's manifest.
        text: the student's lab.
        before: the kit's complete labs of earlier versions; the one that is most like
            the student's is the one they began with.
        now: the kit's complete lab of the newer version.
    """
    starters = [called_as_now(day, one) for one in _starters(day, before)]
    text = called_as_now(day, text)
    starter = make_starter(now, day.script, day.number)
    if not starters:
        return text
    oldest = min(starters, key=lambda one: _line_differences(one, text))
    text = arguments_as_now(text, oldest, starter)
    base = arguments_as_now(oldest, oldest, starter)
    both_changed = _CONFLICT.search(_merge_file(base, text, starter))
    if both_changed and function_lines(base, "main")[0] >= 0:
        text = put_back(text, base, ("main",))
    return merged(base, text, starter, keep_ours)


def _starters(day: Day, before: Iterable[str]) -> list[str]:
    found = []
    for text in dict.fromkeys(before):
        try:
            found.append(make_starter(text, day.script, day.number))
        except Robo47Error:  # no lab with regions yet
            continue
    return found


def _line_differences(starter: str, text: str) -> tuple[int, int]:
    """Return how many lines of a starter a lab has not, and how many it has besides."""
    lines, own = (Counter(t.split("\n")) - Counter({"": 1000}) for t in (starter, text))
    return (lines - own).total(), (own - lines).total()
