"""Pictures of a graded class for `docs/teaching.md`: its page and a feedback file.

    make figures ARGS=--teaching    docs/pictures/class.png and feedback.png

The class is invented. Each student hands in the lab of Day 1 with one change, or with
the first tasks alone. `make grade` grades the class as any other, and Chromium renders
the files that it wrote.
"""

import html
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from PIL import Image, ImageChops

from labkit.lesson.day import Day, find_day
from labkit.lesson.starter import put_back, starter_of
from robo47.errors import Robo47Error
from robo47.paths import ROOT

FOLDER = ROOT / "docs" / "pictures"  # the folder of the pictures
BROWSERS = ("chromium", "chromium-browser", "google-chrome")
DEADLINE = 1_788_537_600  # 2026-09-04 16:00 UTC
INVERSE = ("make_T(R.T, -R.T @ t)", "make_T(R.T, -t)")
QUATERNION = ("w, x, y, z = quat", "x, y, z, w = quat")
JOINT = ("make_T(Rz(q), np.zeros(3))", "make_T(Rz(-q), np.zeros(3))")
ORDER = ("T_world_body @ link_T(body.pos, body.quat)",
         "link_T(body.pos, body.quat) @ T_world_body")  # fmt: skip
# A student: a change of the solved lab, or how many tasks are done.
CLASS: dict[str, tuple[str, str] | int] = {
    "Amina Diallo": 8,
    "Ben Carter": INVERSE,
    "Chen Wei": QUATERNION,
    "Dilara Kaya": INVERSE,
    "Elena Popescu": 5,
    "Farid Rahimi": JOINT,
    "Grace Mwangi": 8,
    "Hugo Martin": INVERSE,
    "Ines Costa": 0,
    "Jonas Lund": ORDER,
    "Kavya Rao": QUATERNION,
    "Luca Bianchi": 3,
}
SHOWN = "Farid Rahimi"  # the student whose feedback file is drawn
SHEET = """<meta charset="utf-8"><style>
body {{ margin: 0; background: #fff; color: #1f2328; }}
pre {{ font: 15px/1.45 "DejaVu Sans Mono", monospace; margin: 20px 24px; }}
</style><pre>{}</pre>
"""


def draw() -> Iterator[tuple[str, Image.Image]]:
    """Yield each picture with its name.

    Raises:
        Robo47Error: there is no Chromium.
    """
    browser = next(filter(None, map(shutil.which, BROWSERS)), None)
    if browser is None:
        raise Robo47Error("the pictures need Chromium, which is not installed")
    with tempfile.TemporaryDirectory(prefix="robo47-class-") as made:
        out = graded(Path(made))
        text = (out / "feedback" / f"{SHOWN}.txt").read_text("utf-8")
        sheet = Path(made, "feedback.html")
        sheet.write_text(SHEET.format(html.escape(text)), "utf-8")
        pages = {
            "class": (out / "class.html", 1100, 1125),
            "feedback": (sheet, 860, 800),
        }
        for name, (page, width, height) in pages.items():
            yield name, seen(browser, page, width, height)


def graded(folder: Path) -> Path:
    """Make the class in a folder and grade it; return the folder of its grades."""
    day = find_day(1)
    for i, (name, work) in enumerate(CLASS.items()):
        hand_in(folder / "class" / name, day, work, DEADLINE - 3600 * (5 + 7 * i))
    out = folder / "grades"
    script = str(ROOT / "scripts" / "grade_class.py")
    command = [sys.executable, script, str(folder / "class"), "--day", "1"]
    command += ["--seed", "47", "--out", str(out / "grades.csv")]
    command += ["--deadline", "2026-09-04T16:00:00+00:00"]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return out


def hand_in(clone: Path, day: Day, work: tuple[str, str] | int, when: int) -> None:
    """Commit a student's lab at a given time, seconds since 1970."""
    solved, starter = day.source.read_text("utf-8"), starter_of(day)
    if isinstance(work, int):
        names = [name for task in day.tasks[:work] for name in task.functions]
        text = put_back(starter, solved, tuple(names)) if names else starter
    elif work[0] not in solved:
        raise Robo47Error(f"{day.script} has no {work[0]!r}; correct {__name__}")
    else:
        text = solved.replace(*work)
    file = clone / day.work.relative_to(ROOT)
    file.parent.mkdir(parents=True)
    file.write_text(text, "utf-8")
    who = {
        f"GIT_{role}_{fact}": value
        for role in ("AUTHOR", "COMMITTER")
        for fact, value in (
            ("NAME", clone.name),
            ("EMAIL", "student@example.org"),
            ("DATE", f"{when} +0000"),
        )
    }
    for step in (["init", "-q"], ["add", "-A"], ["commit", "-qm", "Day 1"]):
        subprocess.run(["git", *step], cwd=clone, env={**os.environ, **who}, check=True)


def seen(browser: str, page: Path, width: int, height: int) -> Image.Image:
    """Return what a browser shows of a page, without the empty paper below it."""
    shot = page.with_suffix(".png")
    flags = ["--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars"]
    size = [f"--window-size={width},{height}", f"--screenshot={shot}"]
    subprocess.run(
        [browser, *flags, *size, page.as_uri()],
        check=True, timeout=60, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    picture = Image.open(shot).convert("RGB")
    paper = Image.new("RGB", picture.size, picture.getpixel((2, height - 2)))
    box = ImageChops.difference(picture, paper).getbbox()
    bottom = min(height, box[3] + 20) if box else height
    return picture.crop((0, 0, width, bottom))
