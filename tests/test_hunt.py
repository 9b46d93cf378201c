"""Bug hunts: what is drawn, what the hunted script does, what a repair is told."""

import ast
import json
import re
from contextlib import closing
from dataclasses import asdict
from types import SimpleNamespace

import make_hunters
import pytest

from labkit import log as metrics
from labkit.base.deadline import Deadline
from labkit.commands import hunt
from labkit.grade import engine, hunts, hunts_page
from labkit.grade.roster import find_students
from labkit.hunt import capstone_list, experiment, mistakes, tally
from labkit.hunt import case as cases
from labkit.hunt.script import closed_capstone, closed_lab, is_closed, opened
from labkit.hunt.verdict import judged
from labkit.judge.row import rows_of
from labkit.lesson.day import all_days, days_of, find_day
from labkit.lesson.starter import function_lines, put_back
from labkit.lesson.week import weeks
from labkit.report.page import render
from labkit.report.series import Report
from robo47.errors import FaultError, Robo47Error

HUNT = "scripts/hunt_bug.py"


def test_a_seed_draws_the_same_mistake_and_others_other_ones():
    day = find_day(4)
    drawn = [mistakes.sample(day, 1, seed)[0] for seed in range(30)]
    again = [mistakes.sample(day, 1, seed)[0] for seed in range(30)]
    assert [(q.function, q.slug) for q in drawn] == [
        (q.function, q.slug) for q in again
    ]
    assert len({(q.function, q.slug) for q in drawn}) > 20


def test_ones_own_mistakes_are_not_drawn():
    day = find_day(4)
    known = {q.slug for q in mistakes.mistakes_of(day)} - {"armature-per-link"}
    for seed in range(10):
        assert mistakes.sample(day, 1, seed, known)[0].slug == "armature-per-link"
    with pytest.raises(Robo47Error, match="no mistake that you have not met"):
        mistakes.sample(day, 1, 1, {q.slug for q in mistakes.mistakes_of(day)})


def test_level_3_draws_two_functions():
    first, second = mistakes.sample(find_day(4), 3, 7)
    assert first.function != second.function


def test_a_mark_finds_a_mistake_again_though_the_catalogue_has_changed(monkeypatch):
    day = find_day(4)
    case = cases.draw(day, 1, 7, [])
    (first,) = case.mistakes
    pool = mistakes.pool_of(day, 1)
    monkeypatch.setattr(mistakes, "pool_of", lambda *_: pool[::-1])
    assert cases.Case(4, 1, 7, case.marks).mistakes == [first]
    monkeypatch.setattr(mistakes, "pool_of", lambda *_: [q for q in pool if q != first])
    with pytest.raises(Robo47Error, match="no longer the mistake of this hunt"):
        cases.Case(4, 1, 7, case.marks).mistakes  # noqa: B018


def test_a_kit_without_catalogues_says_so_in_a_line(monkeypatch):
    monkeypatch.setattr(mistakes, "mistakes_of", lambda day: [])
    with pytest.raises(Robo47Error, match="nothing to hunt: this kit has no mistakes"):
        cases.draw(find_day(4), 1, 7, [])


def test_rows_of_hunts_add_up_to_found_and_named():
    rows = []
    for seed, end in enumerate(tally.ENDS):
        case = cases.draw(find_day(4), 1, seed, [])
        (name,) = case.guilty
        case.runs = seed + 1
        case.ended = end
        case.suspected = [[name, "less"], ["ad", ""]]
        rows.append(tally.row_of(case, ["ad", "energy"]))
        assert rows[-1]["n_failures"] == len({"ad", "energy"} - {name})
        assert (name in rows[-1]["notes"]) == (end != tally.LEFT)
    assert tally.tally(rows) == "found 1 of 4 in 10 runs, named 1 more"
    page = render(Report([], hunts=[{**row, "date": "2026-11-27"} for row in rows]), "")
    assert "<p>found 1 of 4 in 10 runs, named 1 more</p>" in page
    assert tally.tally([{"check": "fk_by_hand", "notes": "found", "value": 1.0}]) == ""


def test_what_was_expected_stands_beside_the_run_in_80_columns():
    lines = ["1. A step", "  PASS  one: 0 (limit 1)", f"  FAIL  {'long ' * 30}: 2"]
    told = experiment.side_by_side("the torque of joint 4 is twice as large", lines)
    assert max(map(len, told.splitlines())) <= 80
    assert "the torque of joint 4 is twice" in told.splitlines()[1]
    assert "FAIL  long" in told.splitlines()[1]
    assert told.endswith("1 check PASS")
    rows = ["  place  joints", "these functions  398.4", "  cut", "right ones  0.9"]
    told = experiment.side_by_side("", rows).splitlines()
    assert " ".join(told[1].split()) == "(nothing said) these functions 398.4 cut"
    assert told[2].strip() == "right ones 0.9"


@pytest.mark.kit
def test_most_mistakes_can_be_hunted():
    for day in all_days():
        ways = [w for row in rows_of(day).values() for w in row.ways]
        wrong = [w for w in ways if w.status == "wrong" and not w.reached]
        assert len(mistakes.mistakes_of(day)) >= 0.85 * len(wrong), day.number


@pytest.mark.kit
@pytest.mark.parametrize(
    "week", [w for w in weeks() if w.capstone], ids=lambda w: w.name
)
def test_what_a_capstone_shows_is_in_the_catalogue(week):
    last = find_day(week.days[-1])
    pool = {(one.function, one.slug) for one in mistakes.called_by_capstone(last)}
    assert capstone_list.visible_mistakes(week) <= pool
    assert len(mistakes.pool_of(last, 2)) > len(pool) / 4


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


def test_a_mistyped_name_is_asked_for_again(tmp_path, monkeypatch, capsys):
    day = find_day(4)
    script = tmp_path / "day4_dynamics.py"
    script.write_text(closed_lab(day), "utf-8")
    answers = iter(["mas_matrix", "  ", "mass_matrix"])
    monkeypatch.setattr("builtins.input", lambda question: next(answers))
    case = SimpleNamespace(of_day=day, level=1, script=script)
    assert hunt.suspected(case) == ""  # Enter alone still runs all of it
    said = " ".join(capsys.readouterr().out.split())
    assert said.startswith("'mas_matrix' is no function of this hunt: ")
    assert "mass_matrix" in said
    assert hunt.suspected(case) == "mass_matrix"
    assert capsys.readouterr().out == ""


def test_a_call_passes_lists_of_numbers_as_arrays_and_all_else_as_it_is(
    tmp_path, capfd
):
    script = tmp_path / "hunted_lab.py"
    script.write_text(
        "import numpy as np\n"
        "def twice(x, y=0):\n    return 2 * x + y\n"
        "def kind(x):\n    return type(x).__name__\n"
        "class Box:\n    def __init__(self, side):\n        self.side = side\n"
    )
    case = SimpleNamespace(script=script)
    for text, said in (
        ("twice([0.1, 2])", "[0.2 4. ]"),
        ("twice(((1, 2), (3, 4)), y=[0, 1])", "[[2. 5.]\n [6. 9.]]"),
        ("twice(3)", "6"),
        ("kind([Box([1])])", "list"),
        ("kind('ab')", "str"),
        ("Box([1, 2]).side", "[1, 2]"),
    ):
        assert experiment.call(case, text) == 0
        assert capfd.readouterr().out.strip() == said
    assert experiment.call(case, "twice([1], [1, 2, 3], 4)") != 0
    assert "it stops: TypeError" in capfd.readouterr().err


@pytest.mark.kit
class TestTheCommand:
    def hunt(self, run_in, *arguments):
        return run_in(HUNT, *arguments)

    def test_writes_a_lab_whose_run_fails_and_no_word_of_the_mistake(
        self, run_in, clone
    ):
        done = self.hunt(run_in, 4, "--seed", 7)
        assert done.returncode == 0
        assert self.hunt(run_in).stdout == done.stdout  # no keyboard: nothing is asked
        case = json.loads((clone / "w1-foundations/work/hunt/hunt.json").read_text())
        assert case["seed"] == 7
        mistake = mistakes.sample(find_day(4, clone), 1, 7)[0]
        for path in (clone / "w1-foundations/work/hunt").iterdir():
            assert mistake.slug not in path.read_text("utf-8")
        ran = self.hunt(run_in, 4, "--run")
        assert "FAIL" in ran.stdout
        assert "nothing logged" in ran.stdout
        verdicts = [line for line in ran.stdout.splitlines() if "FAIL" in line]
        functions = [f for task in find_day(4).tasks for f in task.functions]
        named = re.compile(rf"\b({'|'.join(functions)})\b")
        assert not any(map(named.search, verdicts))

    def test_finds_who_writes_the_right_function_anew(self, run_in, clone):
        self.hunt(run_in, 4, "--seed", 7)
        day = find_day(4, clone)
        name = mistakes.sample(day, 1, 7)[0].function
        script = clone / "w1-foundations/work/hunt/day4_dynamics.py"
        suspected = self.hunt(
            run_in, 4, "--suspect", name, "--expect", "M is too small"
        )
        assert re.search(r"\n  M is too small  +FAIL  ", suspected.stdout)
        assert max(map(len, suspected.stdout.splitlines())) <= 80
        assert self.hunt(run_in, 4, "--judge").returncode == 2  # nothing written yet
        stopped = self.hunt(run_in, "--call", f"{name}(3)").stderr
        assert stopped.startswith("it stops: ")
        assert "src/day4" not in stopped
        right = day.source.read_text("utf-8")
        script.write_text(put_back(script.read_text("utf-8"), right, (name,)))
        assert "FAIL" not in self.hunt(run_in, 4, "--run").stdout
        found = self.hunt(run_in, 4, "--judge")
        assert found.returncode == 0
        assert "found in 2 runs and 1 check" in found.stdout
        rows = metrics.read_rows(clone / "metrics" / "metrics.csv")
        assert [(r["check"], r["value"]) for r in rows] == [("hunt", 2.0)]
        assert "All your hunts: found 1 of 1 in 2 runs." in found.stdout

    def test_tells_who_suspects_another_one(self, run_in, clone):
        self.hunt(run_in, 4, "--seed", 7)
        day = find_day(4, clone)
        script = clone / "w1-foundations/work/hunt/day4_dynamics.py"
        right = day.source.read_text("utf-8")
        script.write_text(put_back(script.read_text("utf-8"), right, ("ad",)))
        told = self.hunt(run_in, 4, "--judge")
        assert told.returncode == 1
        assert "ad: not it; it was right as it was." in told.stdout
        # It does not stand in the way of what is found next.
        name = mistakes.sample(day, 1, 7)[0].function
        script.write_text(put_back(script.read_text("utf-8"), right, (name,)))
        found = self.hunt(run_in, "--judge")
        assert found.returncode == 0
        row = metrics.read_rows(clone / "metrics" / "metrics.csv")[0]
        assert row["n_failures"] == 1
        assert row["notes"] == f"found: {name} (never suspected)"

    def test_by_the_capstone_shows_it_beside_the_right_one(self, run_in):
        self.hunt(run_in, 7, "--level", 2, "--seed", 3)
        ran = self.hunt(run_in, 7, "--run")
        assert "these functions" in ran.stdout
        assert "right ones" in ran.stdout

    def test_that_has_not_begun_cannot_go_on(self, run_in):
        done = self.hunt(run_in, "--judge")
        assert done.returncode == 2
        assert "no such hunt is begun" in done.stderr
        assert "Traceback" not in done.stderr


GIVEN = hunts.Hunt(make_hunters.DAY, make_hunters.LEVEL, make_hunters.SEED)


def hunters_of(clones, deadline=None, seed=None, hunt=GIVEN):
    """Return everybody's hunt and the seed; the journal lies beside the clones."""
    path = clones / "hunting.jsonl"
    with (
        closing(hunts.HuntJournal(path, hunt, deadline, seed)) as journal,
        engine.local(2) as it,
    ):
        return list(hunts.grade(hunt, find_students(clones), it, journal)), journal.seed


@pytest.mark.kit
def test_a_class_is_graded_by_its_scripts_and_not_by_its_word(tmp_path):
    make_hunters.make(tmp_path)
    hunt = GIVEN
    class_, _ = hunters_of(tmp_path)
    assert {one.student.name: one.state for one in class_} == {
        "another-seed": hunts.NO_HUNT,
        "broken": hunts.UNGRADED,
        "found-0": hunts.FOUND,
        "found-second-0": hunts.FOUND,
        "gave-up-0": hunts.NOT_FOUND,
        "log-edited-0": hunts.NOT_FOUND,
        "marks-edited-0": hunts.NOT_FOUND,
        "named-only-0": hunts.NAMED,
        "no-git": hunts.NO_HUNT,
        "nothing": hunts.NO_HUNT,
        "repaired-only-0": hunts.REPAIRED,
        "runs-edited-0": hunts.FOUND,
    }
    odd = {one.student.name: one.odd for one in class_ if one.odd}
    assert set(odd) == {"log-edited-0", "marks-edited-0", "runs-edited-0"}
    assert odd["runs-edited-0"] == ["the log says 1 runs, hunt.json 4"]
    page = hunts_page.render(hunt, class_)
    assert "the committed script does not repair it" in page
    late, _ = hunters_of(tmp_path, deadline=1_000_000_000)
    assert {one.state for one in late} == {hunts.NO_HUNT}


def hostile_hunters():
    """Return one hunt of each kind that once kept a whole class from its grades."""
    first, second = make_hunters.GUILTY, make_hunters.INNOCENT
    big = make_hunters.Hunter().suspect(first).botch(first)
    big.text = big.text.replace("np.zeros(7)", f"np.zeros(7)  # {'x' * 120_000}")
    infinite = make_hunters.Hunter().suspect(first).botch(first)
    infinite.text = infinite.text.replace("np.zeros(7)", "np.inf")
    sleeps = make_hunters.Hunter().suspect(first).botch(first).botch(second)
    sleep = "__import__('time').sleep(1e3)"
    sleeps.text = sleeps.text.replace("np.zeros(7)", sleep)
    return {"big": big, "infinite": infinite, "sleeps": sleeps}


@pytest.mark.kit
def test_a_hostile_hunt_costs_one_grade_and_not_the_classs(tmp_path):
    for name, hunter in hostile_hunters().items():
        hunter.write(tmp_path / name)
    honest = make_hunters.hunters()["found"]
    for name in ("columns", "rows", "zz-honest"):
        honest.write(tmp_path / name)
    short = tmp_path / "rows" / "metrics" / "metrics.csv"
    short.write_text(short.read_text("utf-8") + "1\n" * 20_000, "utf-8")
    make_hunters.commit(tmp_path / "rows")
    table = tmp_path / "columns" / "metrics" / "metrics.csv"
    table.write_text(",".join("a" * 20_000) + "\n" + "1\n" * 20_000)
    make_hunters.commit(tmp_path / "columns")
    class_ = {one.student.name: one for one in hunters_of(tmp_path)[0]}
    assert {name: one.state for name, one in class_.items()} == {
        "big": hunts.UNGRADED,
        "columns": hunts.FOUND,
        "infinite": hunts.NAMED,
        "rows": hunts.FOUND,
        "sleeps": hunts.NAMED,
        "zz-honest": hunts.FOUND,
    }
    assert class_["big"].why == "the hunted script is over 100 kB"
    (odd, _) = class_["columns"].odd
    assert "not the log's header" in odd


def test_all_functions_of_a_hunt_have_one_deadline():
    case = cases.draw(make_hunters.DAY, make_hunters.LEVEL, make_hunters.SEED, [])
    hunter = hostile_hunters()["sleeps"]
    none_left = Deadline(-1.0)
    found = judged(case, hunter.text.encode(), 1, none_left)
    assert [one.verdict.mistake for one in found] == ["too-slow"] * 2


class TestAClassHuntThatIsGradedAgain:
    @pytest.fixture
    def judged_now(self, monkeypatch):
        """Count the hunts that go to a grading process."""
        sent = []

        def counted(package):
            sent.append(package)
            return {"state": hunts.NOT_FOUND}

        monkeypatch.setattr(hunts, "grade_package", counted)
        return sent

    def test_keeps_its_seed_and_judges_only_what_has_changed(
        self, tmp_path, judged_now
    ):
        for name in ("a", "b"):
            make_hunters.Hunter().write(tmp_path / name)
        first, seed = hunters_of(tmp_path)
        make_hunters.Hunter().suspect(make_hunters.GUILTY).write(tmp_path / "b")
        assert hunters_of(tmp_path) == (first, seed)
        assert len(judged_now) == 3
        assert {one.questions for one in judged_now} == {seed}
        assert hunters_of(tmp_path, seed=seed + 1)[1] == seed + 1
        assert len(judged_now) == 5

    def test_goes_on_where_it_was_stopped(self, tmp_path, judged_now):
        for name in ("a", "b"):
            make_hunters.Hunter().write(tmp_path / name)
        path = tmp_path / "hunting.jsonl"
        with (
            closing(hunts.HuntJournal(path, GIVEN, None, 5)) as journal,
            engine.local(1) as it,
        ):
            next(hunts.grade(GIVEN, find_students(tmp_path), it, journal))
        judged_now.clear()
        assert len(hunters_of(tmp_path)[0]) == 2
        assert [one.questions for one in judged_now] == [5]

    def test_is_not_mixed_with_another_hunt_of_the_day(self, tmp_path, judged_now):
        make_hunters.Hunter().write(tmp_path / "a")
        hunters_of(tmp_path)
        other = hunts.Hunt(GIVEN.day, GIVEN.level, GIVEN.seed + 1)
        with pytest.raises(Robo47Error, match="another grading of day 4"):
            hunters_of(tmp_path, hunt=other)


@pytest.mark.parametrize("wrong", [Robo47Error("this kit"), FaultError("no room")])
def test_what_a_worker_says_of_one_hunt_costs_that_hunt(tmp_path, monkeypatch, wrong):
    for name in ("a", "b"):
        make_hunters.Hunter().write(tmp_path / name)
    make_hunters.Hunter().suspect(make_hunters.GUILTY).write(tmp_path / "b")

    def refuses(package):
        if b"too small" in package.files.case:
            raise wrong
        return {"state": hunts.NOT_FOUND}

    monkeypatch.setattr(hunts, "grade_package", refuses)
    first, second = hunters_of(tmp_path)[0]
    assert (first.state, second.state) == (hunts.NOT_FOUND, hunts.UNGRADED)
    assert str(wrong) in second.why
    assert second.fault == isinstance(wrong, FaultError)


def test_a_case_that_cannot_be_drawn_costs_one_grade(monkeypatch):
    def none(*_):
        raise Robo47Error("there is nothing to hunt")

    monkeypatch.setattr(hunts, "draw", none)
    hunter = make_hunters.Hunter()
    said = json.dumps(asdict(hunter.case)).encode()
    files = hunts.Files(said, hunter.text.encode(), b"")
    package = hunts.HuntPackage(4, GIVEN.level, GIVEN.seed, files, "", 1)
    assert package.answer()["state"] == hunts.UNGRADED
    assert "there is nothing to hunt" in package.answer()["why"]
