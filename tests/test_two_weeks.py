"""Two weeks in one clone: which one a command means, and that none hides the other."""

import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

from conftest import ROOT, copy_kit, need, run_copy
from labkit.base import git, store
from labkit.check import report
from labkit.commands import grade
from labkit.commands.proof import OWN_LABS
from labkit.fresh import missing
from labkit.lesson import last_day
from labkit.lesson.day import all_days, chosen_week, days_of, find_day
from labkit.lesson.starter import put_back
from labkit.lesson.week import weeks
from labkit.proof import door
from robo47.errors import Robo47Error

REPORT = "scripts/report_metrics.py"
FACTS = {
    "week": 1,
    "heading": "Week 1: foundations",
    "name": "Ada --> <script>alert(1)</script>",
    "functions": "3 of 9",
    "capstone": "",
}


@pytest.fixture
def tree(tmp_path):
    """Return a clone with manifests alone: a week of two days and a week of one."""
    for week, days in {"w1-first": (1, 2), "w2-second": (8,)}.items():
        for day in days:
            (tmp_path / week / f"day{day}").mkdir(parents=True)
            (tmp_path / week / f"day{day}" / "day.toml").write_text("")
        (tmp_path / week / "work").mkdir()
        number, _, name = week[1:].partition("-")
        (tmp_path / week / "week.toml").write_text(
            f'number = {number}\nname = "{name}"\ntitle = "t"\ndays = {list(days)}\n'
        )
    return tmp_path


def borrowed_names(text):
    """Return the functions that a lab takes from the kit."""
    return re.findall(r"kits\([^)]*?\"(\w+)\"", text)


def save(tree, day, moment):
    week = "w2-second" if day == 8 else "w1-first"
    lab = tree / week / "work" / f"day{day}_lab.py"
    lab.write_text("")
    os.utime(lab, (moment, moment))


class TestTheDayWorkedOnLast:
    def test_is_the_first_one_where_nothing_was_begun(self, tree):
        assert last_day.started_day(tree) == 1

    def test_is_the_one_whose_lab_was_saved_last_and_not_the_highest(self, tree):
        save(tree, 8, 1000)
        save(tree, 2, 2000)
        assert last_day.started_day(tree) == 2
        save(tree, 8, 3000)
        assert last_day.started_day(tree) == 8

    def test_is_the_highest_where_all_files_are_of_one_checkout(self, tree):
        for day, moment in ((8, 1000.0), (1, 1000.9), (2, 1000.5)):
            save(tree, day, moment)
        assert last_day.started_day(tree) == 8

    def test_is_the_one_that_was_started_since_the_last_save(self, tree):
        save(tree, 8, 1000)
        save(tree, 2, 900)
        last_day.remember(2, tree)
        assert last_day.started_day(tree) == 2
        save(tree, 8, store.read(last_day.MEMORY, tree)["time"] + 5)
        assert last_day.started_day(tree) == 8

    @pytest.mark.parametrize("text", ["{}", "[]", '{"day": 7, "time": 9e99}', "x"])
    def test_does_not_hang_on_a_memory_that_cannot_be_read(self, tree, text):
        save(tree, 2, 1000)
        store.write_text(last_day.MEMORY, text, tree)
        assert last_day.started_day(tree) == 2


class TestWhichWeek:
    def test_a_day_of_another_week_is_refused(self):
        with pytest.raises(Robo47Error, match="day 8 is of week 2, not of week 1"):
            chosen_week(1, 8)
        assert chosen_week(2, 8).number == 2

    @pytest.mark.parametrize(
        ("words", "says"),
        [
            (("--week", "33"), "there is no week 33 yet; the kit has: 1, 2"),
            (("--week", "x"), "'x' is no week; expected its number, such as 1"),
            (("--week", "1", "--day", "8"), "day 8 is of week 2, not of week 1"),
        ],
    )
    @pytest.mark.parametrize("script", [REPORT, "scripts/proof.py"])
    def test_a_week_that_cannot_be_is_one_line(self, run, script, words, says):
        if script.endswith("proof.py"):
            pytest.importorskip("viser", reason="the extra view")
        done = run(script, *words)
        assert done.returncode == 2
        assert says in done.stderr
        assert done.stderr.count("\n") == 1

    @pytest.mark.skipif(not shutil.which("make"), reason="needs make")
    def test_make_refuses_a_week_where_a_day_is_meant(self, tmp_path):
        done = subprocess.run(
            ["make", "-n", "check", "WEEK=1"],
            cwd=ROOT,
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 2
        assert "make check takes DAY=2, no WEEK=" in done.stderr


def test_the_grades_of_a_week_are_not_written_over_by_those_of_another():
    first, second = weeks()[:2]
    folders = {
        grade.folder_of(days_of(first), 1),
        grade.folder_of(days_of(second), 2),
        grade.folder_of(all_days(), None),
        grade.folder_of([find_day(8)], None),
    }
    assert folders == {"grades-week1", "grades-week2", "grades-days", "grades-day8"}
    assert grade.chosen(None, 2) == days_of(second)


def test_without_a_day_the_last_one_is_graded_and_printed(monkeypatch, capsys):
    monkeypatch.setattr(grade, "chosen_day", lambda number: find_day(number or 2))
    assert [day.number for day in grade.chosen(None)] == [2]
    assert capsys.readouterr().out.startswith("grading Day 2: you worked on it last")


@pytest.mark.kit
class TestReport:
    @pytest.fixture
    def both(self, tmp_path):
        """Return a copy of the kit in which a day of each week was begun."""
        clone = copy_kit(tmp_path / "clone")
        for week in weeks(clone):
            day = find_day(week.days[0], clone)
            day.work.parent.mkdir(exist_ok=True)
            shutil.copy(day.source, day.work)
        return clone

    def test_every_week_that_was_begun_has_its_page_and_they_link_each_other(
        self, both
    ):
        done = run_copy(both, REPORT)
        assert done.returncode == 0, done.stderr
        for week, other in ((1, 2), (2, 1)):
            page = (both / "metrics" / f"report-week{week}.html").read_text("utf-8")
            assert f'href="report-week{other}.html">Week {other}</a>' in page
            assert f'href="report-week{week}.html"' not in page

    def test_one_week_leaves_the_other_pages_as_they_are(self, both):
        done = run_copy(both, REPORT, "--week", "1")
        assert done.returncode == 0, done.stderr
        pages = sorted(page.name for page in (both / "metrics").glob("*.html"))
        assert pages == ["report-week1.html"]
        alone = (both / "metrics" / pages[0]).read_text("utf-8")
        assert "href" not in alone  # no page stands there that it could lead to

    def test_the_retrospective_of_week_one_is_filled_in_after_week_two_was_begun(
        self, both
    ):
        (retro,) = find_day(1, both).folder.glob("docs/RETRO_*.md")
        before = retro.read_text("utf-8")
        run_copy(both, REPORT)
        assert "| day | number | mine |" in retro.read_text("utf-8")
        assert "| day | number | mine |" not in before


class TestDoor:
    def test_leads_to_the_page_of_each_week_in_order(self, tmp_path):
        for number in (10, 2):
            facts = FACTS | {"week": number, "heading": f"Week {number}: x"}
            page = tmp_path / door.PAGE.format(number)
            page.write_text(door.with_facts("<html></html>\n", facts), "utf-8")
        (tmp_path / "proof-week3.html").write_text("of somebody else", "utf-8")
        text = door.render(door.pages_beside(tmp_path))
        assert text.index("proof-week2.html") < text.index("proof-week10.html")
        assert "proof-week3.html" not in text
        assert "3 of 9 functions by the student" in text

    def test_a_name_cannot_end_the_comment_or_bring_a_script(self, tmp_path):
        page = tmp_path / door.PAGE.format(1)
        page.write_text(door.with_facts("<html></html>\n", FACTS), "utf-8")
        assert "<script>" not in page.read_text("utf-8")
        assert page.read_text("utf-8").count("-->") == 1
        assert door.facts_in(page) == FACTS
        assert "<script>" not in door.render(door.pages_beside(tmp_path))


class TestName:
    @pytest.fixture
    def clone(self, tmp_path):
        need(bool(shutil.which("git")), "git")
        self.commit(tmp_path, "README.md", "The kit's maintainers")
        return tmp_path

    def commit(self, folder: Path, name: str, author: str) -> None:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(author)
        who = ["-c", f"user.name={author}", "-c", "user.email=a@example.org"]
        for words in (["init", "-q"], ["add", "-A"], ["commit", "-qm", "x"]):
            subprocess.run(["git", *who, *words], cwd=folder, check=True)

    def test_who_wrote_the_kit_is_never_the_student(self, clone):
        assert git.author_of(clone, OWN_LABS) == ""

    def test_a_student_is_who_committed_work_last_even_before_an_update(self, clone):
        self.commit(clone, "w1-foundations/work/day1_transforms.py", "Ada")
        self.commit(clone, "CHANGELOG.md", "The kit's maintainers")
        assert git.author_of(clone, OWN_LABS) == "Ada"

    def test_in_ones_own_clone_it_is_gits_user_name(self, clone):
        subprocess.run(["git", "config", "user.name", "Grace"], cwd=clone, check=True)
        assert git.user_name(clone) == "Grace"


@pytest.mark.kit
class TestTheEndOfAWeek:
    @pytest.fixture
    def solved(self, clone):
        def begin(number, *gaps):
            day = find_day(number, clone)
            day.work.parent.mkdir(exist_ok=True)
            run_copy(clone, "scripts/start_day.py", str(number))
            starter = day.work.read_text("utf-8")
            text = day.source.read_text("utf-8")
            day.work.write_text(put_back(text, starter, gaps) if gaps else text)
            return day

        return begin

    def test_make_borrow_takes_what_is_next(self, clone, solved):
        day = solved(1, "make_T", "inverse")
        done = run_copy(clone, "scripts/borrow.py")
        assert done.returncode == 0, done.stderr
        assert "task 1.1 borrows make_T" in done.stdout
        assert "1.3" not in done.stdout
        assert "make_T" in borrowed_names(day.work.read_text("utf-8"))

    def test_make_borrow_of_a_day_takes_all_that_is_open(self, clone, solved):
        day = solved(1, "make_T", "inverse")
        done = run_copy(clone, "scripts/borrow.py", "--day", "1")
        text = day.work.read_text("utf-8")
        assert {"make_T", "inverse"} <= set(borrowed_names(text)), done.stderr
        again = run_copy(clone, "scripts/borrow.py", "--day", "1")
        assert "borrows" in again.stdout or "nothing to borrow" in again.stdout

    def test_the_last_day_names_what_the_week_ends_with_in_order(self):
        says = report._after(find_day(7))
        order = ["make capstone", "make report", "make fresh", "make proof"]
        places = [says.index(one) for one in order]
        assert places == sorted(places)
        assert "make capstone" not in report._after(find_day(3))

    def test_a_fresh_clone_is_not_asked_for_what_only_it_can_tell(self, tmp_path):
        docs = tmp_path / "w1-x" / "docs"
        docs.mkdir(parents=True)
        sheet = docs / "RETRO_w1.md"
        asked = "## The fresh clone\n\nWhat `make fresh` found missing.\n\n"
        sheet.write_text(f"## One\n\n*(your words)*\n\n{asked}*(your words)*\n")
        assert list(missing._blanks(sheet, "it")) == [
            ("it", "1 place still to fill in")
        ]
        sheet.write_text(f"## One\n\nmine\n\n{asked}*(your words)*\n")
        assert list(missing._blanks(sheet, "it")) == []


def test_no_two_days_give_two_functions_one_name():
    """`labkit.check.own_functions` puts all days' functions into one namespace."""
    names = [f for day in all_days() for task in day.tasks for f in task.functions]
    assert sorted(names) == sorted(set(names))
