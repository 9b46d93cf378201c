"""A whole invented day, dropped into a copy of the kit: nothing shared is touched.

`tests/toyday/` is the specification of what an author may expect: a scalar, a vector, a
6x6, a bracket that is no pose, a tuple, a `min` metric, an answer that is not unique,
an optional task, the library of day 1, and a robot with a hand.
"""

import json
import shutil
from functools import partial

import pytest

from conftest import ROOT, SKIPPED, kit_folders, run_copy
from labkit.check.tasks import check_tasks
from labkit.lesson.day import find_day
from labkit.sandbox import sandbox

pytestmark = pytest.mark.kit
TOY = ROOT / "tests" / "toyday" / "w9-toy"


@pytest.fixture(scope="module")
def kit(tmp_path_factory):
    """Return a copy of the kit with the toy day in it."""
    copy = tmp_path_factory.mktemp("kit") / "clone"
    for name in kit_folders():
        shutil.copytree(ROOT / name, copy / name, ignore=SKIPPED)
    shutil.copytree(TOY, copy / "w9-toy")
    return copy


@pytest.fixture
def run(kit):
    return partial(run_copy, kit)


@pytest.fixture
def begun(kit, run):
    """Begin the day; return the student's file."""
    work = kit / "w9-toy" / "work" / "day46_toy.py"
    work.unlink(missing_ok=True)
    done = run("scripts/start_day.py", 46)
    assert done.returncode == 0, done.stderr
    return work


def solve(kit, work):
    work.write_bytes((kit / "w9-toy" / "src" / work.name).read_bytes())


def checked(kit, task, file):
    """Return the verdict on a task of a file."""
    with sandbox.Sandbox() as box:
        (found,) = check_tasks(find_day(46, kit), file, box, task, seed=4)
    return found.verdict


def test_the_starter_has_every_task_to_do_and_the_last_day_begun_is_checked(run, begun):
    done = run("scripts/check_day.py", "--json")
    assert done.stderr == ""
    found = json.loads(done.stdout)
    tasks = [entry for entry in found["entries"] if entry["kind"] == "task"]
    assert (found["day"], len(tasks)) == (46, 8)
    assert {entry["status"] for entry in tasks} == {"todo"}


def test_the_solution_passes_and_a_side_quest_is_not_counted(kit, run, begun):
    solve(kit, begun)
    done = run("scripts/check_day.py", 46)
    assert "Day 46: A toy" in done.stdout
    assert "46.8  fingers (side quest)  passed" in done.stdout
    assert "WRONG" not in done.stdout


FILES = sorted(TOY.glob("day46/submissions/*/*.py"))


@pytest.mark.parametrize("file", FILES, ids=lambda path: path.stem)
def test_each_kind_of_answer_has_its_own_words(kit, file, monkeypatch):
    monkeypatch.setattr(sandbox, "CALL_SECONDS", 1.0)
    tasks, _, slug = file.read_text().splitlines()[0].partition(": ")
    slug = slug.partition(" ")[0]
    for task in tasks.split()[2:]:
        verdict = checked(kit, task, kit / "w9-toy" / file.relative_to(TOY))
        assert (verdict.mistake or verdict.status) == slug, verdict.message
        assert "rotation" not in verdict.message


def test_the_library_of_its_own_day_and_later_ones_is_refused(kit, begun):
    manifest = kit / "w9-toy" / "day46" / "day.toml"
    text = manifest.read_text()
    own = text.replace("minutes = 10", 'minutes = 10\nlibrary = ["simulate"]')
    solve(kit, begun)
    call = "    import robo47.simulate\n    return robo47.simulate.anything(a, b)\n"
    gap = "    # region 46.2\n"
    begun.write_text(begun.read_text().replace(gap, gap + call))
    try:
        manifest.write_text(own)
        verdict = checked(kit, "46.2", begun)
    finally:
        manifest.write_text(text)
    assert verdict.mistake == "not-by-hand"
    assert "robo47.simulate.anything" in verdict.message


def test_its_lab_runs_logs_and_is_judged_by_max_and_min(kit, run, begun):
    solve(kit, begun)
    done = run("scripts/run_day.py", 46)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "PASS  toy right share: 1 (over 0.95)" in done.stdout
    week = run("scripts/run_week.py", 9, "--no-log")
    assert week.returncode == 0
    assert week.stdout.count("PASS") == 3  # two numbers, and all


def test_a_share_under_its_min_fails(kit, run, begun):
    solve(kit, begun)
    code = begun.read_text()
    begun.write_text(code.replace("return n / np.linalg.norm(n)", "return v"))
    done = run("scripts/run_day.py", 46, "--no-log")
    assert done.returncode == 1
    assert "FAIL  toy right share: 0 (over 0.95)" in done.stdout


def test_its_hints_are_given(run, begun):
    done = run("scripts/hint.py", "46.6")
    assert "How many are there?" in done.stdout


def test_the_report_knows_its_rows(kit, run, begun):
    solve(kit, begun)
    run("scripts/run_day.py", 46)
    done = run("scripts/report_metrics.py", "--out", kit)
    assert done.returncode == 0, done.stderr
    page = (kit / "report.html").read_text()
    assert "toy_right_share" in page
    assert "toy_cross" in page


def test_its_submissions_are_graded(kit, run, tmp_path):
    work = tmp_path / "class" / "ada" / "w9-toy" / "work"
    work.mkdir(parents=True)
    shutil.copyfile(kit / "w9-toy" / "src" / "day46_toy.py", work / "day46_toy.py")
    folder, out = tmp_path / "class", tmp_path / "out" / "grades.csv"
    done = run("scripts/grade_class.py", folder, "--day", 46, "--out", out)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "ada" in out.read_text("utf-8-sig")


def test_its_picture_is_drawn_and_its_notebook_made(kit, run):
    done = run("scripts/make_figures.py", "--day", 46)
    assert done.returncode == 0, done.stderr
    assert (kit / "w9-toy" / "figures" / "day46_square.png").is_file()


class TestItsCapstone:
    """A module of its own, and a line of week.toml: nothing else."""

    @pytest.fixture(autouse=True)
    def capstone(self, kit):
        manifest = kit / "w9-toy" / "week.toml"
        before = manifest.read_text("utf-8")
        manifest.write_text(f'{before}capstone = "pointing"\n', "utf-8")
        module = kit / "robo47" / "pointing.py"
        shutil.copyfile(TOY.parent / "pointing.py", module)
        yield module
        module.unlink(missing_ok=True)
        manifest.write_text(before, "utf-8")

    def test_prints_what_its_module_returns_and_nothing_of_another_weeks(self, run):
        done = run("scripts/capstone.py", 9, "--kit")
        assert done.returncode == 0, done.stderr
        assert "one mark           0.00\nit points with its base" in done.stdout
        assert "1 of 1 pointed at within 1 mrad" in done.stdout
        *_, last = done.stdout.splitlines()
        command = 'make capstone WEEK=9 ARGS="--kit --clip pointing.gif"'
        assert last == f"To see it: {command}"
        every = run("scripts/capstone.py", 9, "--kit", "--all")
        assert "20 of 20 pointed at within 1 mrad" in every.stdout
        none = run("scripts/capstone.py", 9, "--kit", "--ablations")
        assert none.returncode == 2
        assert "the pointing has no table of mistakes" in none.stderr
        for word in ("cube", "pick", "place"):
            assert word not in done.stdout + every.stdout + none.stderr

    def test_is_done_with_the_students_own_functions(self, kit, run, begun):
        solve(kit, begun)
        text = begun.read_text("utf-8").replace("np.arctan2(y, x)", "np.arctan2(x, y)")
        begun.write_text(text, "utf-8")
        done = run("scripts/capstone.py", 9)
        assert "the library's instead of polar: wrong" in done.stdout
        assert "1 of 1 pointed at within 1 mrad" in done.stdout
        assert done.stdout.endswith('WEEK=9 ARGS="--clip pointing.gif"\n')

    def test_is_on_the_proof_with_its_own_words_and_film(
        self, kit, run, begun, tmp_path
    ):
        pytest.importorskip("viser", reason="needs viser: make view")
        solve(kit, begun)
        begun.write_text(f"{begun.read_text('utf-8')}\n\nMINE = 1\n", "utf-8")
        out = tmp_path / "proof.html"
        done = run("scripts/proof.py", "--week", 9, "--out", out)
        assert done.returncode == 0, done.stderr
        page = out.read_text("utf-8")
        assert "The pointing in 3D" in page
        assert "The arm turns to its mark; 1 mrad is allowed." in page
        assert "cube" not in page.partition("srcdoc")[0]

    def test_that_lacks_something_is_told_in_a_line(self, run, capstone):
        text = capstone.read_text("utf-8").replace("def summary(", "def said(")
        capstone.write_text(text, "utf-8")
        done = run("scripts/capstone.py", 9, "--kit")
        assert done.returncode == 2
        told = " ".join(done.stderr.split())
        assert "robo47.pointing has no summary; what a capstone needs" in told
        capstone.unlink()
        done = run("scripts/capstone.py", 9, "--kit")
        assert done.returncode == 2
        told = " ".join(done.stderr.split())
        assert "capstone pointing: No module named 'robo47.pointing'" in told


def test_no_shared_file_was_touched_for_it():
    for path in (*ROOT.glob("robo47/**/*.py"), *ROOT.glob("labkit/**/*.py")):
        text = path.read_text("utf-8")
        assert "day46" not in text
        assert "toyday" not in text
