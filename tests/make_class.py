"""A class of generated students: right, wrong, hostile, broken, and oddly named.

    python tests/make_class.py FOLDER 200      to look at, or to measure with

What the wrong ones wrote comes from the catalogue in `submissions/`. Commits have fixed
times, so the same class is the same to the byte.
"""

import os
import random
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
from test_deliverables import png, worksheet

from labkit import log
from labkit.lesson.day import find_day
from labkit.lesson.starter import make_starter, put_back
from labkit.lesson.writers import file_mark

DAY = find_day(1)
WEEK = DAY.folder.name
CATALOGUE = DAY.own / "submissions"
SOLVED = DAY.source.read_text("utf-8")
STARTER = make_starter(SOLVED, "starter", 1)
DEADLINE = 1_788_537_600  # 2026-09-04 16:00 UTC
SCRIPT = f"{WEEK}/work/{DAY.script}"
KIT = DAY.source.with_name("kit.py").read_text("utf-8")
LOADED = 'if __name__ == "__main__":'
FORMULA = "=SUM(A1,A9)"

Files = dict[str, bytes | str]


def script(text: str | bytes) -> Files:
    """Return a student's files with this lab script, and what `make start` adds."""
    return {SCRIPT: text, f"{WEEK}/work/kit.py": KIT}


def wrong(name: str) -> Files:
    """Return the solved lab with a file of the catalogue instead of its functions."""
    mistaken = (CATALOGUE / f"{name}.py").read_text("utf-8")
    return script(own_way(mistaken))


def own_way(functions: str) -> str:
    """Return the solved lab with other functions instead of its own."""
    return SOLVED.replace(LOADED, f"{functions}\n\n{LOADED}")


def under_way(tasks: int) -> Files:
    """Return the starter with the first tasks solved."""
    names = [name for task in DAY.tasks[:tasks] for name in task.functions]
    return script(put_back(STARTER, SOLVED, tuple(names)))


def all_handed_in(seed: int, own: Files) -> Files:
    """Return everything the day asks for, with the rows that this script logged."""
    source = own[SCRIPT]
    mark = file_mark(source if isinstance(source, bytes) else source.encode())
    rng = np.random.default_rng(seed)
    picture = png(rng.integers(0, 256, (300, 400, 3), np.uint8))
    return {
        f"{WEEK}/{DAY.worksheet}": worksheet(DAY.terms),
        f"{WEEK}/{DAY.figure}": picture,
        "metrics/metrics.csv": ",".join(log.COLUMNS)
        + f"\nr,2026-09-01,1,fk_identity_check,,,,,,,inv_err,1e-16,{mark}"
        + f"\nr,2026-09-01,1,fk_by_hand,,,,,,,max_abs_err,1e-15,{mark}\n",
        **own,
    }


def some_handed_in(seed: int, own: Files) -> Files:
    """Return a script and a part of what else the day asks for."""
    files = list(all_handed_in(seed, own).items())
    return {**dict(files[: seed % 4]), **own}


def attack(line: str, where: str = "    T = np.eye(4)") -> Files:
    """Return the solved lab with a line of mischief before another line."""
    assert where in SOLVED
    return script(SOLVED.replace(where, f"    {line}\n{where}", 1))


def own_kit() -> Files:
    """Return a clone whose every part that could take part in grading is changed."""
    passes = "import os\nprint('8 of 8 PASSED')\nos._exit(0)\n"
    places = ("robo47/__init__.py", "labkit/check/tasks.py", "robo47/se3.py")
    places += ("conftest.py", f"{WEEK}/work/conftest.py")
    return {
        **under_way(2),
        **dict.fromkeys(places, passes),
        f"{WEEK}/day1/day.toml": "number = 1\ntitle = 'Mine'\n",
        "Makefile": "check:\n\t@echo 8 of 8 PASSED\n",
    }


def renamed(text: str) -> str:
    """Return a script with other names and other comments: the copyist's craft."""
    for old, new in (("left", "a"), ("half", "b"), ("turn", "zz"), ("pieces", "p")):
        text = re.sub(rf"\b{old}\b", new, text)
    return text.replace("# mine", "# all my own work")


ODD_WAY = """
def Rz(theta):  # mine
    half = theta / 2
    turn = np.cos(half) + 1j * np.sin(half)
    left = turn * turn
    pieces = [left.real, -left.imag, 0.0, left.imag, left.real, 0.0, 0.0, 0.0, 1.0]
    return np.array(pieces).reshape(3, 3) + 0 * np.outer(pieces[:3], pieces[3:6])
"""

KINDS: dict[str, Callable[[int], Files]] = {
    "right": lambda i: all_handed_in(i, script(SOLVED)),
    "wrong inverse": lambda i: all_handed_in(i, wrong("wrong/inverse_no_minus")),
    "under way": lambda i: some_handed_in(i, under_way(1 + i % 7)),
    "not started": lambda i: script(STARTER),
    "no file": lambda i: {"notes.txt": "nothing yet"},
    "empty": lambda i: {},
    "exits": lambda i: script("import sys\nsys.exit(0)\n" + SOLVED),
    "exits at once": lambda i: script("import os\nos._exit(0)\n" + SOLVED),
    "loops": lambda i: attack("while True: pass", "    return compose_fk(model, q,"),
    "eats memory": lambda i: attack("x = np.ones(12_500_000_000)"),
    "forks": lambda i: attack("import os; [os.fork() for _ in range(99)]"),
    "forges": lambda i: attack('print("PASSED"); return True'),
    "names the time": lambda i: attack("raise ValueError(object())"),
    "own kit": lambda i: own_kit(),
    "no python": lambda i: script("Dear Sir,\n\nmy dog ate it.\n"),
    "binary": lambda i: script(random.Random(i).randbytes(5_000)),
    "no git": lambda i: script(SOLVED),
    "corrupt git": lambda i: all_handed_in(i, script(SOLVED)),
    "300 MB": lambda i: script(SOLVED),
    "link loop": lambda i: {"notes.txt": "see work"},
    "uncommitted": lambda i: wrong("wrong/fk_reversed"),
    "git with a program": lambda i: script(SOLVED),
    "copied": lambda i: script(own_way(ODD_WAY)),
    "copyist": lambda i: script(own_way(renamed(ODD_WAY))),
}
NAMES = {  # of folders, where the kind's own is not odd enough
    "right": "Zoë Ångström",
    "under way": "名前 山田",
    "forges": '<img src=x onerror=alert(1)> & "Tables"',
    "not started": FORMULA,
    "no file": "-rf",
    "exits": "الطالب",
    "copied": "e\u0301mile",
}
NAMES_ON_WINDOWS = {"forges": "Bobby & 'Tables'"}


def make_class(root: Path, number: int) -> dict[str, list[str]]:
    """Make the students' folders.

    Args:
        root: the folder to make them in.
        number: of students: one of each kind first, then as in any class: some done,
            some under way, and mistakes of which a few are common.

    Returns:
        Folder names by kind; "wrong/NAME" is a file of the catalogue.
    """
    rng = random.Random(47)
    mistakes = [f"wrong/{p.stem}" for p in sorted((CATALOGUE / "wrong").glob("*.py"))]
    rng.shuffle(mistakes)
    often = {kind: 8 / (1 + rank) for rank, kind in enumerate(mistakes)}
    often |= {"right": 12, "under way": 8, "not started": 2}
    more = iter(lambda: rng.choices(list(often), list(often.values()))[0], None)
    made: dict[str, list[str]] = {}
    for i in range(number):
        kind = list(KINDS)[i] if i < len(KINDS) else next(more)
        known = KINDS.get(kind) or (lambda i, k=kind: some_handed_in(i, wrong(k)))
        odd = {**NAMES, **(NAMES_ON_WINDOWS if os.name == "nt" else {})}
        folder = odd.get(kind, f"student {i:04}") if i < len(KINDS) else f"s{i:04}"
        make_student(root / folder, kind, known(i), i)
        made.setdefault(kind, []).append(folder)
    return made


def make_student(clone: Path, kind: str, files: Files, i: int) -> None:
    """Make one student's folder."""
    clone.mkdir(parents=True)
    put(clone, files)
    work = clone / WEEK / "work"
    if kind == "300 MB":
        for path in (work / DAY.script, clone / WEEK / DAY.figure):
            path.parent.mkdir(exist_ok=True)
            with path.open("wb") as file:
                file.truncate(300_000_000)
    if kind == "link loop" and os.name == "nt":  # where links need rights
        put(clone, {f"{WEEK}/work/{DAY.script}/a folder": ""})
    elif kind == "link loop":
        work.mkdir(parents=True)
        (work / DAY.script).symlink_to(work / DAY.script)
        (clone / WEEK / "figures").symlink_to(clone)
        (work / "helper.py").symlink_to(Path(__file__))
    if kind in ("no git", "empty", "300 MB"):
        return
    commit(clone, DEADLINE - 3600 * (i % 50) - 60 * i)
    if kind == "corrupt git":
        (clone / ".git" / "HEAD").write_bytes(b"\0\xff garbage")
    if kind == "uncommitted":
        put(clone, script(SOLVED))
    if kind == "git with a program":
        trap(clone)


def trap(clone: Path) -> None:
    """Give a clone the configuration of somebody who wants git to run a program."""
    program = f"touch '{clone.parent.parent}/pwned'; cat"
    with (clone / ".git" / "config").open("a") as file:
        file.write(f'[core]\n\tfsmonitor = "{program}"\n\tsshCommand = "{program}"\n')
        file.write(f'[filter "x"]\n\tclean = "{program}"\n\tsmudge = "{program}"\n')
        file.write(f'[gpg]\n\tprogram = "{program}"\n[log]\n\tshowSignature = true\n')
    (clone / ".gitattributes").write_text("* filter=x\n")
    (clone / WEEK / "work" / DAY.script).touch()


def put(clone: Path, files: Files) -> None:
    """Write files below a folder."""
    for name, content in files.items():
        path = clone / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content.encode() if isinstance(content, str) else content)


def commit(clone: Path, when: int) -> None:
    """Commit everything in a folder at a given time."""
    who = {
        f"GIT_{role}_{fact}": value
        for role in ("AUTHOR", "COMMITTER")
        for fact, value in (
            ("NAME", "A"),
            ("EMAIL", "a@example.org"),
            ("DATE", f"{when} +0000"),
        )
    }
    steps = (["init", "-q"], ["add", "-A"], ["commit", "-qm", "x", "--allow-empty"])
    for step in steps:
        subprocess.run(
            ["git", "-c", "core.autocrlf=false", "-c", "gc.auto=0", *step],
            cwd=clone,
            env={**os.environ, **who},
            check=True,
        )


def main(arguments: list[str]) -> None:
    """Make the class that the command line asks for, and print who is in it."""
    usage = "usage: python tests/make_class.py FOLDER STUDENTS"
    if len(arguments) != 2 or not arguments[1].isdecimal():
        sys.exit(f"{usage}, such as: python tests/make_class.py /tmp/class 200")
    root = Path(arguments[0])
    if root.exists() and not (root.is_dir() and not any(root.iterdir())):
        sys.exit(f"{usage}; {root} exists already: give a new or an empty folder")
    for kind, folders in make_class(root, int(arguments[1])).items():
        print(f"{kind}: {', '.join(folders[:5])}")


if __name__ == "__main__":
    main(sys.argv[1:])
