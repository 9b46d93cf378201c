"""The one list of what a student writes, and nobody else's pattern of it."""

import re
import tokenize

import pytest

from conftest import ROOT
from labkit.lesson.day import find_day
from labkit.lesson.student_files import is_made, is_students, retrospectives
from labkit.lesson.week import find_week

W1 = find_week(1).folder.name
MADE = {
    f"{W1}/work/day1_transforms.py",
    f"{W1}/work/hunt/hunt.json",
    f"{W1}/notebooks/day1_transforms.ipynb",
    find_day(1).files["figure"],
}
FILLED_IN = {"metrics/metrics.csv", f"{W1}/docs/RETRO_w1.md", f"{W1}/docs/day1.md"}
KITS = {"README.md", f"{W1}/docs/RETRO.txt", f"{W1}/src/day1_transforms.py"}


@pytest.mark.parametrize("name", sorted(MADE | FILLED_IN | KITS))
def test_a_file_is_the_students_or_the_kits(name):
    assert is_students(name) == (name not in KITS)
    assert is_made(name) == (name in MADE)


def test_the_retrospectives_of_another_clone_are_found_there(tmp_path):
    there = tmp_path / W1 / "docs" / "RETRO_w1.md"
    there.parent.mkdir(parents=True)
    there.touch()
    assert retrospectives(find_week(1), tmp_path) == [there]
    assert [path.name for path in retrospectives(find_week(1))] == [there.name]


def test_no_other_module_has_a_pattern_of_these_files():
    pattern = re.compile(r"RETRO_.?\*|/(work|notebooks)/\*|\(work\|")
    known = {"week.py", "student_files.py"}
    found = []
    for path in (ROOT / "labkit").rglob("*.py"):
        with tokenize.open(path) as file:
            words = [
                token.string
                for token in tokenize.generate_tokens(file.readline)
                if token.type == tokenize.STRING and not token.string.startswith('"""')
            ]
        if path.name not in known and any(map(pattern.search, words)):
            found.append(path.relative_to(ROOT).as_posix())
    assert not found
