"""A new day's skeleton passes; what is wrong with a day is told with its line."""

import re
import shutil
import subprocess

import pytest

from conftest import ROOT, kits_worksheet, run_copy
from labkit.commands.new import worksheet_of
from labkit.handin.worksheet import split_sections
from labkit.lesson.day import all_days, find_day
from labkit.lesson.predictions import rows_asked

pytestmark = pytest.mark.kit
NEW, AUTHOR = "scripts/new_day.py", "scripts/author_day.py"
WEEK = "w9-trial"


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """Return a copy of the kit with a new day 46, in a week of its own."""
    kit = tmp_path_factory.mktemp("author") / "kit"
    skipped = shutil.ignore_patterns(".*", "_site", "*node_modules", "work")
    shutil.copytree(ROOT, kit, ignore=skipped)
    done = run_copy(kit, NEW, "46", WEEK, "trial")
    assert done.returncode == 0, done.stderr
    return kit


@pytest.fixture
def kit(made):
    """Return that copy, put back afterwards."""
    before = made.parent / "before"
    readme = (made / "README.md").read_text()
    shutil.copytree(made / WEEK, before)
    yield made
    shutil.rmtree(made / WEEK)
    before.rename(made / WEEK)
    (made / "README.md").write_text(readme)


def test_a_new_day_is_all_as_it_must_be(kit):
    done = run_copy(kit, AUTHOR, "46")
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.count("PASS") == 14
    assert f"**[Day 46: Trial]({GUIDE})**" in (kit / "README.md").read_text()


def test_a_new_week_begins_with_a_retrospective_of_its_own(kit):
    """It is no copy of another week's, which asks about the capstone of that week."""
    template = ROOT / "labkit/commands/templates/RETRO.md.txt"
    number = re.search(r"\d+", WEEK)[0]
    own = (kit / WEEK / "docs" / f"RETRO_w{number}.md").read_text("utf-8")
    assert own == template.read_text("utf-8").replace("$weeknumber", number)
    assert own.startswith(f"# Week {number}: ")
    assert "<!-- numbers -->" in own


def test_a_task_without_its_files_is_told_which_files_are_missing(kit):
    manifest = kit / WEEK / "day46" / "day.toml"
    task = manifest.read_text("utf-8").partition("[[tasks]]")[2]
    more = task.replace("46.1", "46.2").replace("reach", "stretch")
    manifest.write_text(manifest.read_text("utf-8") + f"\n[[tasks]]{more}", "utf-8")
    done = run_copy(kit, AUTHOR, "46", "--fast")
    told = " ".join(done.stdout.split())
    assert (done.returncode, done.stderr) == (1, "")
    assert f"{WEEK}/day46/stretch.py is missing: the questions for stretch" in told
    assert "46.2 in stretch" not in told  # there is no function to mark yet
    assert "make author TASK=46.2" in told
    (kit / WEEK / "day46" / "stretch.py").write_text(
        (kit / WEEK / "day46" / "reach.py")
        .read_text("utf-8")
        .replace(", truth=ends", "")
    )
    change(
        kit / LAB, "def main()", "def stretch(q1, q2, a, b):\n    pass\n\n\ndef main()"
    )
    done = run_copy(kit, AUTHOR, "--task", "46.2")
    assert done.returncode == 2
    assert done.stdout.splitlines() == [
        f"Task 46.2: stretch, in {WEEK}/day46/",
    ]
    assert "the day's library has no stretch" in done.stderr


def test_what_the_skeleton_says_for_the_author_is_told_and_a_worksheet_is_written(kit):
    (kit / WEEK / "docs" / "day46.md").unlink()
    done = run_copy(kit, "scripts/author_day.py", "46", "--fast")
    assert done.returncode == 0, done.stdout
    says = " ".join(done.stdout.split())
    assert "wrote w9-trial/docs/day46.md, yours to fill in" in says
    assert (
        'docs/day46.md still has the words of the skeleton: "What do you want to ask?"'
        in says
    )


def test_its_starter_is_to_do_and_its_lab_passes(kit):
    done = run_copy(kit, "scripts/run_day.py", "46", "--kit", "--no-log")
    assert done.returncode == 0
    assert run_copy(kit, "scripts/start_day.py", "46").returncode == 0
    told = run_copy(kit, "scripts/check_day.py", "46").stdout
    assert "46.1  reach               to do" in told


def test_nothing_is_written_over(kit):
    done = run_copy(kit, NEW, "46", WEEK, "trial")
    assert (done.returncode, "day 46 is there already" in done.stderr) == (2, True)
    done = run_copy(kit, NEW, "45", "w1-other", "trial")
    assert "week 1 is there already, in another folder" in done.stderr
    done = run_copy(kit, NEW, "45", "perception", "trial")
    assert "expected one like w2-autonomy" in done.stderr


def test_a_second_day_of_a_week_is_listed_and_no_longer_announced(kit):
    manifest = kit / WEEK / "week.toml"
    soon = 'soon = [\n    { number = 47, title = "The end" },\n]\n'
    manifest.write_text(manifest.read_text() + soon)
    done = run_copy(kit, "scripts/build_docs.py", "--day", "46")
    readme = kit / WEEK / "README.md"
    assert "- Not written yet: Day 47, The end" in readme.read_text(), done.stderr
    assert run_copy(kit, NEW, "47", "9", "end").returncode == 0
    assert "days = [46, 47]" in manifest.read_text()
    assert "The end" not in manifest.read_text()
    assert "[Day 47: End](docs/day47-lab.md)" in readme.read_text()


FUNCTION, LAB = f"{WEEK}/day46/reach.py", f"{WEEK}/src/day46_trial.py"
GUIDE = f"{WEEK}/docs/day46-lab.md"


def change(path, old, new):
    """Replace a text in a file that has it."""
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))


@pytest.mark.parametrize(
    ("file", "old", "new", "says"),
    [
        (FUNCTION, "end.imag])", "end.imag.nothing])", "reach.py, line 11)"),
        (FUNCTION, "[end.real, end.imag]", "[end.real]", "shape (1,), and its kind a"),
        (FUNCTION, "truth=ends", "thruth=ends", "a Row has no thruth"),
        (FUNCTION, "def sine_first(q1", "def sine_first(q1 q2", "(reach.py, line 35)"),
        (FUNCTION, "yield 0.0, np.pi", "yield np.pi", "takes 4: q1, q2, a, b"),
        (FUNCTION, "(q1, q2))\n", "(q1, q1 + q2))\n", "angle-of-its-own"),
        (LAB, "# region 46.1", "# region 46.2", "endregion 46.1 closes region 46.2"),
        (GUIDE, "(0.913 m", "(0.9 m", "w9-trial/day46/test_day46.py:18)"),
        (f"{WEEK}/day46/day.toml", 'id = "46.1"', 'id = "45.1"', "id 45.1 is not one"),
        (f"{WEEK}/week.toml", "days", "day", "w9-trial/week.toml: "),
    ],
)
def test_what_is_wrong_is_told_with_its_file_and_no_traceback(
    kit, file, old, new, says
):
    change(kit / file, old, new)
    fast = () if "test_day46.py" in says else ("--fast",)
    done = run_copy(kit, AUTHOR, "46", *fast)
    told = " ".join((done.stdout + done.stderr).split())
    assert done.returncode in (1, 2)
    assert says in told
    assert f"{WEEK}/" in told
    assert "Traceback" not in told
    assert "git checkout" not in told


def test_what_does_not_fit_is_told_at_once_each_with_its_file(kit):
    sheet = f"{WEEK}/docs/day46.md"
    change(kit / LAB, "def reach(", "def reached(")
    change(kit / GUIDE, "## 46.1 The end", "## 46.1 The End")
    change(kit / sheet, "### joint angle or absolute angle", "### angle")
    done = run_copy(kit, AUTHOR, "46")
    told = " ".join(done.stdout.split())
    assert (done.returncode, done.stderr) == (1, "")
    assert f"{LAB}: no function reach, which {WEEK}/day46/day.toml asks" in told
    assert f"{GUIDE} has no heading" in told
    assert f"{sheet}: no section 'joint angle or absolute angle'" in told
    assert "git checkout" not in told


@pytest.mark.parametrize("day", all_days(), ids=lambda day: f"day{day.number}")
def test_the_worksheets_skeleton_has_what_the_manifest_asks_for(day):
    sections = split_sections(worksheet_of(day))
    assert {term.lower() for term in day.terms} <= set(sections)
    assert sum(name.startswith("drawing ") for name in sections) == day.drawings
    assert worksheet_of(find_day(day.number)).count("*(your answer)*") == day.questions


def test_the_worksheets_skeleton_asks_for_what_the_lab_measures():
    rows = rows_asked(worksheet_of(find_day(14)))
    assert "fraction of slippery cubes held" in rows
    assert rows.keys() <= rows_asked(kits_worksheet(find_day(14))).keys()


OPEN = "    open(__file__).close()\n"  # the wall refuses it
METRICS = '\n[[metrics]]\ncheck = "speed"\nmetric = "seconds"\nmax = 3.0\n'


@pytest.mark.parametrize(
    ("file", "old", "new", "says"),
    [
        (
            f"{WEEK}/day46/day.toml",
            "\n[[tasks]]",
            f"{METRICS}\n[[tasks]]",
            "no step of",
        ),
        (
            GUIDE,
            "# Day 46",
            "![gone](../figures/gone.png)\n\n# Day 46",
            "gone.png is not",
        ),
        (LAB, "# region 46.1\n", "# region 46.1\n    raise KeyError\n", "stops at a"),
        (LAB, "# region 46.1\n", f"# region 46.1\n{OPEN}", "make grade judges"),
    ],
)
def test_what_only_a_student_would_meet_is_told_to_the_author(
    kit, file, old, new, says
):
    text = (kit / file).read_text()
    assert old in text
    (kit / file).write_text(text.replace(old, new, 1))
    done = run_copy(kit, AUTHOR, "46", "--fast")
    assert done.returncode == 1
    assert says in " ".join(done.stdout.split())


def test_a_students_file_in_the_repository_is_told(kit):
    work = kit / WEEK / "work"
    work.mkdir()
    (work / "day46_trial.py").write_text("mine")
    for words in (["init", "-q"], ["add", "-A", WEEK]):
        subprocess.run(["git", *words], cwd=kit, check=True)
    done = run_copy(kit, AUTHOR, "46", "--fast")
    shutil.rmtree(kit / ".git")
    assert f"git holds {WEEK}/work/day46_trial.py" in " ".join(done.stdout.split())


def test_answers_of_the_library_that_no_test_is_about_are_told(kit):
    name = "_".join(["un", "tested"])  # else this file would be about it
    (kit / "robo47" / f"{name}.py").write_text('"""Answers."""\n')
    change(
        kit / WEEK / "day46" / "day.toml", "# library = [", f'library = ["{name}"] # ['
    )
    done = run_copy(kit, AUTHOR, "46", "--fast")
    (kit / "robo47" / f"{name}.py").unlink()
    assert f"no test is about robo47/{name}.py" in " ".join(done.stdout.split())


def test_a_function_that_another_day_has_is_told(kit):
    change(kit / WEEK / "day46" / "day.toml", '["reach"]', '["skew"]')
    done = run_copy(kit, AUTHOR, "46", "--fast")
    assert "day 2 has a function skew too" in " ".join(done.stdout.split())


def test_one_task_is_looked_at_alone(kit):
    (kit / GUIDE).unlink()
    done = run_copy(kit, AUTHOR, "--task", "46.1")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "0 not told what they must be" in done.stdout
