"""The pictures of a graded class that the page for teachers shows."""

import csv
import os
import re

import pytest

from robo47.errors import Robo47Error
from robo47.paths import ROOT

if not os.environ.get("ROBO47_CI"):
    pytest.importorskip("PIL", reason="needs Pillow: make figures")
from labkit.grade import pictures

pytestmark = pytest.mark.kit
GUIDE = ROOT / "docs" / "teaching.md"


def test_each_invented_student_makes_the_mistake_that_was_put_in(tmp_path):
    out = pictures.graded(tmp_path)
    with (out / "grades.csv").open(encoding="utf-8", newline="") as file:
        first = {row["name"]: row["first_mistake"] for row in csv.DictReader(file)}
    found = dict.fromkeys(first, "")
    tasks = {
        pictures.INVERSE: "1.3",
        pictures.QUATERNION: "1.4",
        pictures.JOINT: "1.5",
        pictures.ORDER: "1.6",
    }
    found |= {
        name: tasks[work]
        for name, work in pictures.CLASS.items()
        if not isinstance(work, int)
    }
    assert {name: says.partition(" ")[0] for name, says in first.items()} == found
    text = (out / "feedback" / f"{pictures.SHOWN}.txt").read_text("utf-8")
    assert re.search(r"1\.5 +link_T, joint_T +WRONG\n", text)


def test_the_page_for_teachers_shows_the_pictures_and_they_are_small():
    shown = re.findall(r"!\[.{40,}?\]\(pictures/(\w+)\.png\)", GUIDE.read_text("utf-8"))
    kept = sorted(pictures.FOLDER.glob("*.png"))
    assert sorted(shown) == [path.stem for path in kept] == ["class", "feedback"]
    assert max(path.stat().st_size for path in kept) < 200_000


def test_without_a_browser_there_is_a_line_and_no_picture(monkeypatch):
    monkeypatch.setattr(pictures.shutil, "which", lambda name: None)
    with pytest.raises(Robo47Error, match="need Chromium, which is not installed"):
        next(pictures.draw())
