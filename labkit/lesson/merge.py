"""Three versions of a text made one, where no line of the student's may be lost."""

import re
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

from labkit.base import git

Lines = Sequence[str]
Settle = Callable[[Lines, Lines, Lines], list[str]]
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
    text = _merge_file(base, ours, theirs)

    def settled(found: re.Match[str]) -> str:
        lines = (found[name].splitlines() for name in ("base", "ours", "theirs"))
        return "".join(f"{line}\n" for line in settle(*lines))

    return _CONFLICT.sub(settled, text)


def conflicts(base: str, ours: str, theirs: str) -> bool:
    """Return whether both changed the same lines."""
    return bool(_CONFLICT.search(_merge_file(base, ours, theirs)))


def keep_ours(base: Lines, ours: Lines, theirs: Lines) -> list[str]:
    """Return the student's lines."""
    return list(ours)


def keep_both(base: Lines, ours: Lines, theirs: Lines) -> list[str]:
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
