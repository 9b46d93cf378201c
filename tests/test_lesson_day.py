"""The manifests: the course checks itself."""

import re
import tomllib

import pytest

from conftest import kits_worksheet
from robo47.checker.deliverables.worksheet import split_sections
from robo47.errors import Robo47Error
from robo47.lesson.day import find_day, find_task, load_week
from robo47.lesson.starter import find_regions
from robo47.paths import ROOT

MANIFESTS = sorted(ROOT.glob("w*/week.toml"))
DAYS = [day for manifest in MANIFESTS for day in load_week(manifest)]


@pytest.mark.parametrize("day", DAYS, ids=lambda day: f"day {day.number}")
class TestEveryDay:
    def test_has_a_script_with_exactly_the_tasks_of_the_manifest(self, day):
        regions = find_regions(day.source.read_text("utf-8"), day.script)
        found = {(region.task, region.function) for region in regions}
        assert found == {
            (task.id, name) for task in day.tasks for name in task.functions
        }

    def test_gives_two_or_three_hints_of_a_size_to_read(self, day):
        for task in day.tasks:
            assert len(task.hints) in (2, 3)
            for hint in task.hints:
                assert 20 <= len(hint.split()) <= 50, hint

    def test_asks_in_its_hints_and_gives_no_line_of_the_solution_away(self, day):
        lines = day.source.read_text("utf-8").splitlines()
        given = "\n".join(hint for task in day.tasks for hint in task.hints)
        for region in find_regions("\n".join(lines), day.script):
            for line in lines[region.start + 1 : region.end]:
                assert line.strip() not in given
        for task in day.tasks:
            assert any("?" in hint for hint in task.hints)

    def test_sends_back_to_sections_that_the_lab_guide_has(self, day):
        guide = (day.folder / day.guide).read_text("utf-8")
        headings = set(re.findall(r"^#+ (.+)$", guide, re.MULTILINE))
        for task in day.tasks:
            section = task.read.partition(";")[0].removeprefix("Lab guide, ")
            assert section in headings, task.id

    def test_asks_for_what_its_worksheet_has_room_for(self, day):
        sections = split_sections(kits_worksheet(day))
        assert {term.lower() for term in day.terms} <= sections.keys()
        drawings = [name for name in sections if name.startswith("drawing ")]
        assert len(drawings) == day.drawings
        assert "- [ ]" in sections["checklist"]
        questions = re.findall(r"^\d+\.", sections["can you explain?"], re.MULTILINE)
        assert len(questions) == day.questions


def edited(tmp_path, *changes):
    text = MANIFESTS[0].read_text("utf-8")
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    path = tmp_path / "week.toml"
    path.write_text(text, "utf-8")
    return path


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (('title = "A turn about z"', 'title = ""'), r"tasks 1\.2: title is ''"),
        (('functions = ["Rz"]', "functions = []"), r"1\.2: functions has 0 entries"),
        (('id = "1.2"', 'id = "1.1"'), r"two tasks have the id 1\.1"),
        (('id = "1.2"', 'id = "2.2"'), r"id 2\.2 is not one of day 1"),
        (('needs = ["1.6"]', 'needs = ["1.9"]'), r"1\.8 needs 1\.9"),
        (("max = 1e-10", 'max = "small"'), "max is 'small'; expected a float"),
        (("minutes = 180", "minutes = true"), "minutes is True; expected a int"),
        (("[days.figure]", "[days.picture]"), "figure is None"),
        (('id = "1.4"', "id = 1.4"), "expected a str"),
        (("[[days]]", "[[days"), "cannot be read"),
    ],
)
def test_what_is_wrong_in_a_manifest_is_named(tmp_path, change, says):
    with pytest.raises(Robo47Error, match=says):
        load_week(edited(tmp_path, change))


def test_an_empty_hint_is_refused(tmp_path):
    data = tomllib.loads(MANIFESTS[0].read_text("utf-8"))
    first = data["days"][0]["tasks"][0]["hints"][0]
    text = MANIFESTS[0].read_text("utf-8")
    start = text.index('"""')
    end = text.index('"""', start + 3) + 3
    path = tmp_path / "week.toml"
    path.write_text(text[:start] + '" "' + text[end:], "utf-8")
    assert first.strip()
    with pytest.raises(Robo47Error, match=r"tasks 1\.1: hints holds ' '"):
        load_week(path)


def test_a_day_or_task_that_does_not_exist_is_told_with_those_that_do():
    with pytest.raises(Robo47Error, match="no day 48 yet; the kit has: 1"):
        find_day(48)
    with pytest.raises(Robo47Error, match=r"no task 1\.9; it has 1\.1, 1\.2"):
        find_task("1.9")
    with pytest.raises(Robo47Error, match="'fk' is no task"):
        find_task("fk")
    assert find_task("1.4")[1].functions == ("quat_to_R",)
