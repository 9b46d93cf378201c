"""Write the student edition: solutions sealed, no catalogues, no history.

    python3 scripts/edition.py ../robo47-students      (make edition OUT=...)

The edition is a repository of its own, with one commit per version. Run the command
again after a change, and `make update` brings it to your students. The labs' solutions
are sealed: they run, so `make day1` verifies them, but nobody reads them by chance.
EDITION.md lists the solutions that the library still contains.
"""

import re
import shutil
import tempfile
from pathlib import Path

from labkit import log
from labkit.base import cli
from labkit.lesson.day import LOG, all_days
from labkit.lesson.lab_module import read_script
from labkit.lesson.sealed import seal
from labkit.lesson.student_files import is_made
from labkit.update.git import NOBODY, ask
from robo47 import __version__
from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown

NOTE = "EDITION.md"
LEFT_OUT = re.compile(
    r"\.ci/|\.github/|bench/|site/|tests/|conftest\.py|CONTRIBUTING\.md"
    r"|docs/|w[^/]*/day\d+/(submissions/|test_)"
)
COMMANDS = "test|soak|lint|docs|site|oracle|bench|test-matrix|grade|edition"
NOT_HERE = re.compile(rf"make ({COMMANDS})\b")
SECTION = "Where things are"  # the README's section that lists what is left out
FOR_TESTS = re.compile(r"\s+`make test` runs[^.]*\.")  # README's sentence about them
FOR_AUTHORS = re.compile(r"To change the kit.*", re.DOTALL)  # README's last sentence
ABOUT = """# Student edition of robo47 {version}

The whole course, its checker and its library, without what gives answers away: the
labs' solutions are sealed in `src/` (they run, and `make day1` shows that they are
right); catalogues of mistakes, notebooks, the kit's tests and its history are left out.

What is still here, honestly: the library `robo47/` holds most of the functions that the
labs ask for, under their names, since later days are built on it; the files of a day
(`w*/day*/`) hold mistakes and right answers, since the checker judges by them; and a
seal is no lock. A copied function teaches nothing, and your teacher's page shows who
handed in the kit's own.
"""


def main() -> int:
    """Write the edition and commit it."""
    parser = cli.parser(__doc__)
    parser.add_argument("out", type=Path, help="a folder outside the clone")
    out = parser.parse_args().out.resolve()
    older = refuse_others(out)
    out.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=out.parent, prefix=".edition-") as folder:
        write(Path(folder))  # whole, or the disk is full and nothing has changed
        for name in older:
            (out / name).unlink(missing_ok=True)
        for path in Path(folder).rglob("*"):
            target = out / path.relative_to(folder)
            if path.is_file():
                target.parent.mkdir(parents=True, exist_ok=True)
                path.replace(target)
    commit(out)
    print(f"wrote {shown(out)}: push it where students clone it from; {NOTE} says what")
    print("is left out. After a change of the kit: the same command, and push again.")
    return cli.EXIT_OK


def write(out: Path) -> None:
    """Write its files."""
    for name in ask("ls-files", "-z").split("\0")[:-1]:
        left_out = LEFT_OUT.match(name) or is_made(name)
        if not left_out and (ROOT / name).is_file():
            target = out / name
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, target)
    for day in all_days():
        target = out / day.source.relative_to(ROOT)
        target.write_text(seal(read_script(day.source), day.number), "utf-8")
    header = ",".join(log.COLUMNS) + "\n"
    (out / LOG).write_text(header, "utf-8")
    (out / NOTE).write_text(ABOUT.format(version=__version__), "utf-8")
    shorten(out)


def refuse_others(out: Path) -> list[str]:
    """Refuse what is neither new nor an older edition; return that one's files."""
    if out.is_relative_to(ROOT):
        raise Robo47Error(f"{shown(out)} is inside the kit; expected a place beside it")
    if not out.exists() or not any(out.iterdir()):
        return []
    if not (out / NOTE).is_file() or not (out / ".git").is_dir():
        raise Robo47Error(f"{shown(out)} is there and is no edition; choose another")
    looks = "--no-optional-locks", "status"  # git would leave a lock on a full disk
    if ask(*looks, "--porcelain", "--untracked-files=no", at=out):
        raise Robo47Error(f"{shown(out)} has changes; commit or take them back first")
    return ask("ls-files", "-z", at=out).split("\0")[:-1]


def shorten(out: Path) -> None:
    """Take from Makefile and README what is about things that are left out."""
    makefile = out / "Makefile"
    blocks = makefile.read_text("utf-8").split("\n\n")
    gone = re.compile(rf"({COMMANDS}|site/\S+|\.venv-bench/\S+):")
    makefile.write_text("\n\n".join(b for b in blocks if not gone.match(b)), "utf-8")
    readme = out / "README.md"
    text = readme.read_text("utf-8")
    until = r"\n.*?(?=\n## |\nThe robot is)"
    text = re.sub(rf"\n## {SECTION}{until}", "", text, flags=re.S)
    text = FOR_AUTHORS.sub(f"[{NOTE}]({NOTE}) lists what is left out.\n", text)
    text = FOR_TESTS.sub("", text)
    lines = [line for line in text.splitlines() if not NOT_HERE.search(line)]
    readme.write_text("\n".join(lines) + "\n", "utf-8")
    for page in out.rglob("*.md"):
        unlink_missing(page)


def unlink_missing(page: Path) -> None:
    """Make text of a page's links that lead to what is left out."""

    def kept(link: re.Match[str]) -> str:
        target = link[2].partition("#")[0]
        there = not target or ":" in target or (page.parent / target).exists()
        return link[0] if there else link[1]

    text = page.read_text("utf-8")
    found = re.sub(r"(?<!!)\[([^\]\n]*(?:\n[^\]\n]*)?)\]\(([^)\s]+)\)", kept, text)
    if found != text:
        page.write_text(found, "utf-8")


def commit(out: Path) -> None:
    """Commit the edition, with nothing of the kit's history."""
    if not (out / ".git").exists():
        ask("init", "-q", "-b", "main", at=out)
    ask("add", "-A", at=out)
    if ask("status", "--porcelain", at=out):
        message = f"robo47 {__version__}, student edition"
        ask(*NOBODY, "commit", "-q", "--no-verify", "-m", message, at=out)
