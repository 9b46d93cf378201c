"""Faults planted in a day: each is told by name, with what to do."""

import re
import shutil

import pytest
from toyrows import row_of

from conftest import ROOT, SKIPPED, kit_folders, run_copy
from labkit.author import display, docstring, hints, stops
from labkit.author.renumber import OUTPUTS, renumbered
from labkit.judge import Scalar
from labkit.judge.row import rows_of
from labkit.lesson.day import all_days, find_day

pytestmark = pytest.mark.kit
AUTHOR = "scripts/author_day.py"
WEEK = "w9-trial"
LAB = f"{WEEK}/src/day46_trial.py"
TAB = '''"""A tab."""

from labkit.inspector.tab import Tab
{lab}

class Arm(Tab):
    title = "Arm"

    def __init__(self, page):
        super().__init__(page)
        page.job(lambda: {work}, lambda found: None)


TABS = [Arm]
'''
PICTURE = '''"""A picture."""

from PIL import Image

FIGURES = {"reached": lambda: Image.new("RGB", (640, 480), "COLOUR")}
'''


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """Return a copy of the kit with a new day 46, in a week of its own."""
    kit = tmp_path_factory.mktemp("author") / "kit"
    skipped = shutil.ignore_patterns(".*", "_site", "*node_modules", "work")
    shutil.copytree(ROOT, kit, ignore=skipped)
    done = run_copy(kit, "scripts/new_day.py", "46", WEEK, "trial")
    assert done.returncode == 0, done.stderr
    return kit


@pytest.fixture
def kit(made):
    """Return that copy, put back afterwards."""
    before = made.parent / "before"
    shutil.copytree(made / WEEK, before)
    yield made
    shutil.rmtree(made / WEEK)
    before.rename(made / WEEK)


def change(path, old, new):
    """Replace a text in a file that has it."""
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new, 1))


def told(kit):
    """Return what the author is told, in one line."""
    done = run_copy(kit, AUTHOR, "46", "--fast")
    assert "Traceback" not in done.stderr
    return " ".join(done.stdout.split())


def test_a_hint_with_the_formula_or_of_another_size_is_told(kit):
    manifest = kit / WEEK / "day46" / "day.toml"
    change(manifest, "Draw both links.", "It is `np.array([np.cos(q1), np.sin(q1)])`.")
    change(
        manifest, "Each link adds a vector to the one before. How long is it, and", ""
    )
    says = told(kit)
    assert "hint 1 has the solution's own `np . array ( [ np . cos ( q1 )" in says
    assert re.search(r"hint 2 has 1\d words; a hint has 20 to 50", says)


def test_a_wrong_case_a_tab_that_stops_and_a_picture_not_drawn_are_told(kit):
    change(kit / LAB, "-> (1, 0.5)", "-> (1, 0.6)")
    own = kit / WEEK / "day46"
    (own / "inspector.py").write_text(TAB.format(lab="", work="1 / 0"))
    (own / "figures.py").write_text(PICTURE)
    says = told(kit)
    case = "the docstring's case reach(0, pi / 2, 1, 0.5) -> (1, 0.6) is not so"
    assert f"{LAB}, reach: {case}: it returns [1. , 0.5]" in says
    pytest.importorskip("viser", reason="the extra view")
    assert "tab Arm: stopped: ZeroDivisionError: division by zero" in says
    pytest.importorskip("matplotlib", reason="needs matplotlib: make figures")
    assert "make figures DAY=46 ARGS=--kit fails" in says  # "COLOUR" is none


def test_a_wrong_shape_a_tab_with_the_lab_and_an_old_picture_are_told(kit):
    change(kit / LAB, "two links, (2,), in", "two links, (3,), in")
    own = kit / WEEK / "day46"
    lab = "\nimport day46_trial\n"
    (own / "inspector.py").write_text(TAB.format(lab=lab, work="day46_trial.TRIALS"))
    (own / "figures.py").write_text(PICTURE.replace("COLOUR", "red"))
    says = told(kit)
    assert "the docstring says that what it returns is (3,); a question" in says
    pytest.importorskip("matplotlib", reason="needs matplotlib: make figures")
    drawn = kit / WEEK / "figures" / "day46_reached.png"
    assert f"{WEEK}/figures/{drawn.name} is not there: make figures DAY=46" in says
    done = run_copy(kit, "scripts/make_figures.py", "--day", "46", "--kit")
    assert done.returncode == 0, done.stderr
    (own / "figures.py").write_text(PICTURE.replace("COLOUR", "blue"))
    assert "is not what is drawn now: 100.0% of its pixels" in told(kit)
    pytest.importorskip("viser", reason="the extra view")
    assert "inspector.py does not load: ModuleNotFoundError" in says


def test_a_sentence_that_begins_with_a_capital_is_told(kit):
    """It may follow the number of a line; the name of a matrix is no word."""
    own = kit / WEEK / "day46" / "reach.py"
    change(own, "the second link is rotated", "The second link is rotated")
    change(own, "the sine and the cosine", "R and the cosine")
    says = told(kit)
    assert 'capital, but it may follow "In line 12, ": The second link' in says
    assert says.count("begins with a capital") == 1


@pytest.mark.parametrize("day", all_days(), ids=lambda day: f"day{day.number}")
def test_the_kits_own_days_have_none_of_these(day):
    assert [*hints.faults_of(day)] == []
    for row in rows_of(day).values():
        assert [*docstring.faults_of(row), *docstring.capitals(row)] == []
        assert [*stops.faults_of(row)] == []


class TestAMistakeThatStops:
    """An entry that stops where its author did not mean it is told with its line."""

    @staticmethod
    def row(wrongs=None, wrong=None):
        row = row_of(
            Scalar(), lambda x: 2.0 * x, lambda rng: [(float(x),) for x in range(6)]
        )
        if wrongs:
            wrongs.__doc__ = "one: your code adds 1\n    two: your code divides by x"
            row.wrongs(wrongs)
        if wrong:
            row.wrong("three", "your code does something")(wrong)
        return list(stops.faults_of(row))

    def test_takes_all_of_its_table_along(self):
        (told,) = self.row(lambda x: {"one": x + 1.0, "two": 2.0 / x})
        assert "its @row.wrongs stops with ZeroDivisionError: float division" in told
        assert "test_author_faults.py, line " in told
        assert "so none of its 2 mistakes has an answer to that question" in told

    def test_alone_is_none_where_it_is_a_function_of_its_own(self):
        assert self.row(lambda x: {"one": x + 1.0, "two": lambda: 2.0 / x}) == []
        assert self.row(wrong=lambda x: 2.0 / x) == []

    def test_is_one_where_a_name_is_missing(self):
        (told,) = self.row(lambda x: {"one": x, "two": lambda: 1 if x else spam})  # noqa: F821
        assert "its mistake two stops with NameError: name 'spam'" in told
        (told,) = self.row(lambda x: {"one": x, "too": x})
        assert "stops with KeyError" in told

    def test_is_one_where_it_has_no_answer_at_all(self):
        (told,) = self.row(wrong=lambda x: 2.0 / (x - x))
        assert "three stops with ZeroDivisionError" in told
        assert told.endswith(", and so at every other question")


@pytest.mark.parametrize(
    ("text", "call", "value"),
    [
        ("f(1, (2, 3)) -> (1, 0.5).", "f(1, (2, 3))", "(1, 0.5)"),
        ("With f([0]) -> -0.25, say; f(2) is more.", "f([0])", "-0.25"),
        ("f(pi / 2) -> sqrt(2) / 2. No more.", "f(pi / 2)", "sqrt(2) / 2"),
    ],
)
def test_a_worked_case_is_read_from_a_sentence(text, call, value):
    assert docstring.cases(text, "f") == [(call, value)]


def test_the_number_of_a_section_is_none_of_a_case(monkeypatch):
    """A note to an author: the decimals of a docstring that no question has."""
    row = next(iter(rows_of(all_days()[0]).values()))
    function = getattr(row.lab, row.function)
    text = "Return 0.77 (Modern Robotics, section 3.3.1, eq. 3.64, appendix B.3)."
    monkeypatch.setattr(function, "__doc__", text)
    assert docstring.unlike_its_questions(row) == ["0.77"]


def test_a_shape_is_read_behind_its_argument_alone():
    text = "Return Y, (n, 7), of X (n, d). q, (7,), at (1, 2) is W (2, 2)."
    found = docstring._documented_shapes(text, ["X", "q", "W"])
    assert found == [("X", "n, d"), ("q", "7,"), ("W", "2, 2"), ("", "n, 7")]
    found = docstring._documented_shapes("Return A^-1 e, (n,). e is (m,).", ["A", "e"])
    assert found == [("e", "m,"), ("", "n,")]


def test_a_row_of_the_skeleton_has_few_lines_that_are_no_content():
    path = ROOT / "labkit" / "commands" / "templates" / "function.py.txt"
    text = path.read_text("utf-8").partition("@row.wrong")[0]
    truth = re.compile(r"def ends\(.*?\n\n\n", re.DOTALL)
    lines = [line for line in truth.sub("", text).splitlines() if line.strip()]
    content = ("    yield", "    for", "        yield", "#")
    assert len([line for line in lines if not line.startswith(content)]) <= 8


@pytest.fixture(scope="module")
def moved(tmp_path_factory):
    """Return a copy of the kit whose toy day became day 45, and what was said."""
    copy = tmp_path_factory.mktemp("kit") / "clone"
    for name in kit_folders():
        shutil.copytree(ROOT / name, copy / name, ignore=SKIPPED)
    toy = ROOT / "tests" / "toyday" / "w9-toy"
    shutil.copytree(toy, copy / "w9-toy")
    for name in ("README.md", "pyproject.toml"):
        shutil.copyfile(ROOT / name, copy / name)
    to = ("45", "2", "game", "--from", "46")
    refused = run_copy(copy, "scripts/new_day.py", *to)
    assert refused.returncode == 2
    assert "day 46 is all that week 9 has" in refused.stderr
    return copy, run_copy(copy, "scripts/new_day.py", "45", "--from", "46")


class TestADayThatMoves:
    """The toy day, to another number, week and name."""

    def test_takes_its_files_its_number_and_its_tasks_along(self, moved):
        copy, done = moved
        assert done.returncode == 0, done.stderr
        week = copy / "w9-toy"
        assert not [*week.rglob("*day46*")]
        assert "days = [45]" in (week / "week.toml").read_text()
        day = find_day(45, copy)
        assert (day.script, day.was) == ("day45_toy.py", ("day46_toy.py",))
        assert {task.id.partition(".")[0] for task in day.tasks} == {"45"}
        for path in (day.own, day.source):
            for file in [path] if path.is_file() else path.rglob("*.py"):
                assert "46." not in file.read_text(), file

    def test_tells_no_line_that_is_made_anew(self):
        for made in ("days: w*", "functions: by day", "run: make help"):
            text = f"Day 8 <!-- {made} -->\nDay 8\n<!-- end -->"
            assert OUTPUTS.sub("", text) == "Day 8 "

    def test_takes_the_sentences_of_its_tests_along(self):
        day = find_day(8)
        text = "SENTENCES = sentences(8)\nDAY = find_day(8)\nsines(8)\n"
        new = renumbered(text, day, 12, "day12_mine")
        assert new == "SENTENCES = sentences(12)\nDAY = find_day(12)\nsines(8)\n"

    def test_passes_its_own_check(self, moved):
        copy, _ = moved
        assert run_copy(copy, "scripts/start_day.py", "45").returncode == 0
        work = copy / "w9-toy" / "work" / "day45_toy.py"
        shutil.copyfile(copy / "w9-toy" / "src" / work.name, work)
        checked = run_copy(copy, "scripts/check_day.py", "45").stdout
        assert "45.1  angle_between" in checked
        assert "WRONG" not in checked


def test_pictures_of_two_sizes_are_told_by_their_sizes(tmp_path):
    Image = pytest.importorskip("PIL.Image", reason="needs Pillow: make figures")
    paths = [tmp_path / "a.png", tmp_path / "b.png"]
    for path, size in zip(paths, ((400, 300), (400, 320)), strict=True):
        Image.new("RGB", size).save(path)
    assert display._difference(*paths) == "400 x 300 became 400 x 320"
    assert display._difference(paths[0], paths[0]) == ""
