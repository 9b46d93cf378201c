"""Bug hunts: what is drawn, what the hunted script does, what a repair is told."""

import ast
import json

import pytest
from restored import Restored

from conftest import copy_kit
from labkit import log as metrics
from labkit.hunt import quarry
from labkit.hunt.script import closed_capstone, closed_lab, is_closed, opened
from labkit.judge.row import rows_of
from labkit.lesson.day import all_days, days_of, find_day
from labkit.lesson.starter import function_lines, put_back
from robo47.errors import Robo47Error

HUNT = "scripts/hunt_bug.py"


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    """Return a copy of the kit that is put back after each test."""
    return Restored(copy_kit(tmp_path_factory.mktemp("kit") / "clone"))


@pytest.fixture
def clone(copy):
    return copy.put_back()


def test_a_seed_draws_the_same_mistake_and_others_other_ones():
    day = find_day(4)
    drawn = [quarry.drawn(day, 1, seed)[0] for seed in range(30)]
    again = [quarry.drawn(day, 1, seed)[0] for seed in range(30)]
    assert [(q.function, q.slug) for q in drawn] == [
        (q.function, q.slug) for q in again
    ]
    assert len({(q.function, q.slug) for q in drawn}) > 20


def test_ones_own_mistakes_are_not_drawn():
    day = find_day(4)
    known = {q.slug for q in quarry.quarries(day)} - {"armature-forgotten"}
    for seed in range(10):
        assert quarry.drawn(day, 1, seed, known)[0].slug == "armature-forgotten"
    with pytest.raises(Robo47Error, match="no mistake that you have not met"):
        quarry.drawn(day, 1, 1, {q.slug for q in quarry.quarries(day)})


def test_level_3_draws_two_functions():
    first, second = quarry.drawn(find_day(4), 3, 7)
    assert first.function != second.function


@pytest.mark.kit
def test_nine_in_ten_of_all_mistakes_can_be_hunted():
    for day in all_days():
        ways = [w for row in rows_of(day).values() for w in row.ways]
        wrong = [w for w in ways if w.status == "wrong" and not w.reached]
        assert len(quarry.quarries(day)) >= 0.9 * len(wrong), day.number


@pytest.mark.kit
@pytest.mark.parametrize("day", all_days(), ids=lambda day: f"day{day.number}")
def test_a_hunted_lab_shows_none_of_its_functions(day):
    text = closed_lab(day)
    ast.parse(text)
    names = [name for task in day.tasks for name in task.functions]
    for name in names:
        own = function_lines(text, name)[2]
        assert is_closed(own)
        assert '"""' in "\n".join(own)
    assert opened(text, names) == {}


@pytest.mark.kit
def test_a_hunted_capstone_has_the_weeks_functions_closed():
    last = find_day(7)
    text = closed_capstone(last, days_of(last.week), "capstone")
    ast.parse(text)
    assert text.count("def ") == text.count("return hunted(") + 1  # and main


@pytest.mark.kit
class TestTheCommand:
    def hunt(self, run_in, *arguments):
        return run_in(HUNT, *arguments)

    def test_writes_a_lab_whose_run_fails_and_no_word_of_the_mistake(
        self, run_in, clone
    ):
        done = self.hunt(run_in, 4, "--seed", 7)
        assert done.returncode == 0
        case = json.loads((clone / "w1-foundations/work/hunt/hunt.json").read_text())
        assert case["seed"] == 7
        mistake = quarry.drawn(find_day(4, clone), 1, 7)[0]
        for path in (clone / "w1-foundations/work/hunt").iterdir():
            assert mistake.slug not in path.read_text("utf-8")
        ran = self.hunt(run_in, 4, "--run")
        assert "FAIL" in ran.stdout
        assert "nothing logged" in ran.stdout

    def test_finds_who_writes_the_right_function_anew(self, run_in, clone):
        self.hunt(run_in, 4, "--seed", 7)
        day = find_day(4, clone)
        name = quarry.drawn(day, 1, 7)[0].function
        script = clone / "w1-foundations/work/hunt/day4_dynamics.py"
        suspected = self.hunt(
            run_in, 4, "--suspect", name, "--expect", "M is too small"
        )
        assert "You expected: M is too small" in suspected.stdout
        assert self.hunt(run_in, 4, "--judge").returncode == 2  # nothing written yet
        right = day.source.read_text("utf-8")
        script.write_text(put_back(script.read_text("utf-8"), right, (name,)))
        assert "FAIL" not in self.hunt(run_in, 4, "--run").stdout
        found = self.hunt(run_in, 4, "--judge")
        assert found.returncode == 0
        assert "found in 2 runs and 1 check" in found.stdout
        rows = metrics.read_rows(clone / "metrics" / "metrics.csv")
        assert [(r["check"], r["value"]) for r in rows] == [("hunt", 2.0)]

    def test_tells_who_suspects_another_one(self, run_in, clone):
        self.hunt(run_in, 4, "--seed", 7)
        day = find_day(4, clone)
        script = clone / "w1-foundations/work/hunt/day4_dynamics.py"
        right = day.source.read_text("utf-8")
        script.write_text(put_back(script.read_text("utf-8"), right, ("ad",)))
        told = self.hunt(run_in, 4, "--judge")
        assert told.returncode == 1
        assert "ad: not it; it was right as it was." in told.stdout

    def test_by_the_capstone_shows_it_beside_the_right_one(self, run_in):
        self.hunt(run_in, 7, "--level", 2, "--seed", 3)
        ran = self.hunt(run_in, 7, "--run")
        assert "these functions" in ran.stdout
        assert "right ones" in ran.stdout

    @pytest.mark.parametrize(
        ("arguments", "says"),
        [
            (("--run",), "no hunt is begun"),
            (("--judge",), "no hunt is begun"),
            (("--level", 9), "invalid choice"),
        ],
    )
    def test_that_cannot_go_on_says_why(self, run_in, clone, arguments, says):
        done = self.hunt(run_in, *arguments)
        assert done.returncode == 2
        assert says in done.stderr
        assert "Traceback" not in done.stderr
