"""A week as a whole: its labs in one table, its numbers, its page, its diary."""

import html
import json
import os
import re
import shutil
import subprocess
import sys
from dataclasses import replace

import pytest
from test_report import MEASURE, dom

from conftest import copy_kit, keep_first_day, run_copy
from labkit.base import store
from labkit.check.memory import MetMistake
from labkit.commands.week import lines_of
from labkit.lesson.day import days_of, find_day
from labkit.lesson.metric import Metric
from labkit.lesson.week import find_week
from labkit.lesson.writers import Writers, file_mark, marks_of, writers_of
from labkit.report import week_page, week_retro
from labkit.report.series import Series
from labkit.report.week_facts import OwnDay, facts_of, minutes_of
from labkit.report.week_labs import LabResult

pytestmark = pytest.mark.kit

RUN_WEEK, REPORT = "scripts/run_week.py", "scripts/report_metrics.py"
WRITTEN = ("w1-foundations", "metrics", ".robo47")  # folders of a clone
BEFORE, AFTER = (
    b"# Mine\r\n<!-- numbers -->\r\n",
    b"<!-- end -->\r\n\xc3\xa9 mine too\r\n",
)
UNSEEN = b"Not counted, since `make check` has not seen it as it is: day 1."
SMALL = Metric("fk", "err", max=1e-8)
SHARE = Metric("right", "share", min=0.95)


@pytest.fixture
def day():
    return find_day(1)


@pytest.fixture(scope="module")
def kit(tmp_path_factory):
    """Return a copy of the kit with its first day alone, for all tests, one by one."""
    return keep_first_day(copy_kit(tmp_path_factory.mktemp("kit") / "clone"))


@pytest.fixture(scope="module")
def fresh(kit, tmp_path_factory):
    """Return where the parts of that copy that a test may write in are kept."""
    return save(kit, tmp_path_factory.mktemp("fresh"))


@pytest.fixture
def clone(kit, fresh):
    """Return that copy with nothing done in it."""
    bring_back(kit, fresh)
    return kit


@pytest.fixture(scope="module")
def worked(kit, fresh, tmp_path_factory):
    """Keep what is there once a day met a mistake, was checked and run."""
    bring_back(kit, fresh)
    day = begin(kit)
    retro_of(day).write_bytes(BEFORE + b"old\r\n" + AFTER)
    wrong = find_day(1).own / "submissions" / "wrong" / "inverse_no_minus.py"
    solved = day.work.read_text("utf-8")
    day.work.write_text(f"{solved}\n\n{wrong.read_text('utf-8')}", "utf-8")
    run_copy(kit, "scripts/check_day.py", "1")
    day.work.write_text(solved, "utf-8")
    run_copy(kit, "scripts/check_day.py", "1")
    assert run_copy(kit, "scripts/run_day.py", "1").returncode == 0
    return save(kit, tmp_path_factory.mktemp("worked"))


@pytest.fixture
def done(clone, worked):
    """Return the day in that state, with a retrospective."""
    bring_back(clone, worked)
    return find_day(1, clone)


def save(kit, folder):
    """Keep what commands write in, and return where."""
    for name in WRITTEN:
        if (kit / name).is_dir():
            shutil.copytree(kit / name, folder / name)
    return folder


def bring_back(kit, folder):
    """Let a copy of the kit be as it was when that was kept."""
    for name in (*WRITTEN, ".git"):
        shutil.rmtree(kit / name, ignore_errors=True)
    shutil.copytree(folder, kit, dirs_exist_ok=True)


@pytest.fixture
def begun(clone):
    """Begin the day with the kit's solution, in a file of one's own, in a copy."""
    return begin(clone)


def begin(clone):
    day = find_day(1, clone)
    day.work.parent.mkdir()
    for name in ("kit.py", day.script):
        text = day.source.with_name(name).read_text("utf-8")
        day.work.with_name(name).write_text(text + "# mine\n", "utf-8")
    return day


def ran(metric, kit=2e-15):
    """Return the runs of a number: a bad one, a good one, and one of the kit's."""
    series = Series(1, metric)
    series.rows = [row(0.5, b"a"), row(1.234e-15, b"a")]
    series.kits = [row(kit, b"kit")] if kit else []
    return series


def facts(day, **changed):
    number = ran(SMALL)
    met = [
        MetMistake("1.3", "t-negated", "left behind", "It keeps t."),
        MetMistake("1.8", "chain-reversed", "still there"),
    ]
    passed = {task.id: "passed" for task in day.tasks[:-1]}
    return replace(OwnDay(day, passed, [number], 200, 4, met), **changed)


def test_a_number_is_called_by_its_check_and_by_its_metric_where_there_are_two(day):
    metrics = (SMALL, SHARE, Metric("right", "other", max=1.0))
    both = replace(day, metrics=metrics)
    assert [both.name_of(m) for m in metrics] == ["fk", "right share", "right other"]


def test_the_weeks_labs_stand_in_one_table(run_in, begun):
    done = run_in(RUN_WEEK)
    assert done.returncode == 0, done.stdout + done.stderr
    lines = done.stdout.splitlines()
    assert lines[0].split() == ["day", "whose", "check", "number", "limit"]
    own = [line for line in lines if line.startswith("1    yours")]
    assert len(own) == len(begun.metrics)
    assert all(line.endswith("PASS") for line in own)
    assert lines[-1] == "PASS  1 lab, 2 numbers within their limits"
    assert max(map(len, lines)) <= 80


def test_the_kits_labs_can_be_run_beside_what_is_begun(run_in, begun):
    begun.work.write_text("raise SystemExit('error: no idea')\n")
    done = run_in(RUN_WEEK, "1", "--kit")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "yours" not in done.stdout


def test_a_lab_that_fails_is_named_with_its_reason(run_in, begun):
    begun.work.write_text("raise SystemExit('error: no idea')\n")
    done = run_in(RUN_WEEK)
    assert done.returncode == 1
    text = " ".join(done.stdout.split())
    assert "day 1 did not pass: error: no idea. See: make run DAY=1" in text
    assert "none" in done.stdout
    assert done.stdout.splitlines()[-1] == "FAIL  1 of 1 lab did not pass"


def row(value, script, when="2026-09-01"):
    mark = file_mark(script)
    notes = f"limit 1e-8; {mark}"
    return {"value": value, "n_failures": 0, "notes": notes, "date": when}


def numbers(day, metric, *rows, own=b"a"):
    day = replace(day, metrics=(metric,))
    writers = Writers(marks_of(day.source.read_bytes()), marks_of(own))
    series = Series(day.number, metric, writers)
    for one in rows:
        series.add(one)
    (found,) = facts_of(day, [series]).numbers
    return found


def test_the_students_numbers_and_the_kits_are_told_apart(day):
    kit, own = day.source.read_bytes(), b"my own"
    rows = (
        row(0.3, own),
        row(2e-15, kit),
        row(1e-15, own),
        {**row(9, own), "notes": ""},
    )
    found = numbers(day, SMALL, *rows, own=own)
    assert (found.latest, found.worst, found.kit) == (1e-15, 0.3, 2e-15)
    assert found.status == "pass"


def test_a_number_of_an_empty_file_is_nobodys(day, tmp_path):
    nobodys = writers_of(replace(day, folder=tmp_path))  # neither has a script there
    found = Series(day.number, SMALL, nobodys)
    found.add(row(1e-15, b""))
    assert (found.status, found.kits) == ("stale", [])


def test_a_number_of_a_file_that_changed_since_is_no_pass(day):
    found = numbers(day, SMALL, row(1e-15, b"before"))
    assert (found.latest, found.status) == (1e-15, "stale")
    one = facts(day, numbers=[found])
    assert "your file changed since" in week_page.render([one], "")
    assert "| 1.0e-15 (my file changed since) |" in week_retro.as_markdown([one])


def test_the_worst_is_the_smallest_where_a_minimum_is_asked_for(day):
    found = numbers(day, SHARE, row(0.2, b"a"), row(1.0, b"a"))
    assert (found.latest, found.worst, found.status) == (1.0, 0.2, "pass")


def test_both_pages_say_that_a_row_with_failed_trials_failed(day):
    failed = {**row(1e-15, b"a"), "n_failures": 7, "n_trials": 1000}
    assert numbers(day, SMALL, failed).status == "fail"
    series = Series(1, SMALL)
    series.rows = [failed]
    assert series.status == "fail"


def test_a_number_that_is_none_is_the_worst_of_all(day):
    found = numbers(day, SMALL, row(float("nan"), b"a"), row(5.0, b"a"))
    assert found.worst != found.worst
    assert found.status == "fail"


def test_without_rows_there_are_no_numbers(day):
    found = numbers(day, SMALL)
    assert (found.latest, found.worst, found.kit) == (None, None, None)
    assert found.status == "none"


def commit(clone, path, when):
    (clone / path).parent.mkdir(exist_ok=True)
    with (clone / path).open("a") as file:
        file.write("more\n")
    who = {
        f"GIT_{r}_{f}": "a@b"
        for r in ("AUTHOR", "COMMITTER")
        for f in ("NAME", "EMAIL")
    }
    environment = {**os.environ, **who, "GIT_COMMITTER_DATE": f"{when} +0000"}
    for step in (["add", "-f", path], ["commit", "-qm", "x", "--", path]):
        subprocess.run(["git", *step], cwd=clone, env=environment, check=True)


def test_the_minutes_of_a_day_are_those_between_its_commits(clone):
    day = find_day(1, clone)
    subprocess.run(["git", "init", "-q"], cwd=clone, check=True)
    script, sheet = (
        f"w1-foundations/work/{day.script}",
        f"w1-foundations/{day.worksheet}",
    )
    assert minutes_of(day, clone) is None
    commit(clone, sheet, 1_700_000_000)  # the kit's own
    assert minutes_of(day, clone) is None
    commit(clone, script, 1_800_000_000)
    assert minutes_of(day, clone) is None
    commit(clone, script, 1_800_003_600)
    commit(clone, sheet, 1_800_007_200)
    assert minutes_of(day, clone) == 120


@pytest.mark.parametrize("text", ["", "[1]", '{"1.1": "many"}', '{"1.1": null}'])
def test_hints_that_cannot_be_read_are_none(tmp_path, text):
    (tmp_path / ".robo47").mkdir()
    file = tmp_path / ".robo47" / "hints.json"
    file.write_text(text)
    assert store.hints_given(tmp_path) == {}
    file.write_text(json.dumps({"1.1": 2}))
    assert store.hints_given(tmp_path) == {"1.1": 2}


@pytest.mark.parametrize(
    ("minutes", "says"),
    [(None, "–"), (50, "50 min"), (200, "3 h 20 min"), (2880, "2.0 days")],
)
def test_a_time_is_said_as_people_say_it(minutes, says):
    assert week_page.minutes_in_words(minutes) == says


def test_the_page_shows_the_week(day):
    text = week_page.render([facts(day)], "of my log")
    for words in ("Week 1: foundations", "7 of 8", "8 of 9", "3 h 20 min", "0.5"):
        assert words in text
    assert "inverse: t negated<br><span class=muted>It keeps t.</span>" in text
    assert "<td class=pass>✓ left behind" in text
    assert "chain reversed</td><td class=fail>✗ still there" in text


def test_the_kits_numbers_have_a_column_where_the_kit_has_run_here(day):
    both, own = ran(SMALL), ran(SMALL, kit=None)
    assert "the kit's here" in week_page.render([facts(day, numbers=[both, own])], "")
    assert "the kit's here" not in week_page.render([facts(day, numbers=[own])], "")


def test_no_text_of_a_journal_becomes_a_script(day):
    evil = "<script>alert(1)</script>"
    text = week_page.render(
        [facts(day, met=[MetMistake("1.1", evil, "still there", evil)])], evil
    )
    assert "<script" not in text
    assert "default-src 'none'" in text


def titles(chromium, folder, *pages):
    """Return what each page makes of its title, all in one browser."""
    frame = '<iframe style="width:1400px;height:1000px" srcdoc="{}"></iframe>'
    frames = "".join(frame.format(html.escape(page)) for page in pages)
    each = "[...document.querySelectorAll('iframe')].map(f => f.contentDocument.title)"
    script = f"<script>onload = () => document.title = {each}.join('|')</script>"
    text = dom(chromium, folder, f"<body>{frames}{script}")
    found = re.search(r"<title>(.*?)</title>", text)
    assert found is not None
    return found[1].split("|")


@pytest.mark.browser
def test_the_page_fits_and_its_verdicts_are_seen_on_a_phone(day, tmp_path, chromium):
    week = [
        facts(d, numbers=[ran(m) for m in d.metrics]) for d in days_of(find_week(1))
    ]
    text = week_page.render(week, "of my log")
    box = "getBoundingClientRect()"
    seen = "[...d.querySelectorAll('td.pass')].every("
    seen += f"e => e.{box}.left + 30 < e.closest('.card').{box}.right)"
    harness = MEASURE.replace("d.documentElement.scrollWidth", seen)
    pages = [harness.format(width=w, page=html.escape(text)) for w in (390, 1280)]
    for found in titles(chromium, tmp_path, *pages):
        *title, shown, too_wide, _, _, made = found.split()
        assert " ".join(title) == "Week 1: foundations"
        assert (shown, too_wide, made) == ("true", "0", "0")


def retro_of(day):
    return day.folder / "docs" / "RETRO_w1.md"


@pytest.fixture
def diary(begun):
    file = retro_of(begun)
    file.write_bytes(BEFORE + b"old\r\n" + AFTER)
    return file


def test_a_retrospective_gets_its_numbers_and_nothing_else_changes(begun, diary):
    assert week_retro.fill([facts(begun)]) == [diary]
    text = diary.read_bytes()
    assert text.startswith(BEFORE)
    assert text.endswith(AFTER)
    assert b"| 1 | fk | 1.2e-15 | 0.5 | under 1e-08 |\r\n" in text
    assert b"old" not in text
    assert b"Tasks passed: 7 of 8. Functions of my own: 8 of 9.\r\n" in text
    assert b"\n" not in text.replace(b"\r\n", b"")
    assert week_retro.fill([facts(begun)]) == []


def test_hints_stay_out_of_what_is_handed_in(begun):
    assert "hint" not in week_retro.as_markdown([facts(begun, hints=4)])


@pytest.mark.parametrize("text", [b"mine\n", AFTER + BEFORE, (BEFORE + AFTER) * 2])
def test_without_its_marks_a_retrospective_is_left_alone(begun, diary, text):
    diary.write_bytes(text)
    assert week_retro.fill([facts(begun)]) == []
    assert diary.read_bytes() == text


def test_nobodys_numbers_are_written_nowhere(clone):
    day = find_day(1, clone)
    file = retro_of(day)
    file.write_bytes(BEFORE + AFTER)
    assert week_retro.fill([facts(day)]) == []
    assert file.read_bytes() == BEFORE + AFTER


def test_another_logs_numbers_stay_out_of_the_retrospective(
    run_in, begun, clone, diary
):
    other = clone / "other.csv"
    shutil.copy(clone / "metrics" / "metrics.csv", other)
    before = diary.read_bytes()
    done = run_in(REPORT, "--file", other)
    assert done.returncode == 0, done.stderr
    assert "report-week1.html" in done.stdout
    assert diary.read_bytes() == before


def test_make_report_writes_the_weeks_page_from_what_was_done(run_in, kit, done):
    said = run_in(REPORT)
    assert said.returncode == 0, said.stderr
    assert "wrote metrics/report-week1.html" in said.stdout
    assert "checks: 2 passing, 0 failing" in said.stdout
    log = (kit / "metrics" / "report.html").read_text("utf-8")
    assert 'href="report-week1.html">Week 1</a>' in log
    text = (kit / "metrics" / "report-week1.html").read_text("utf-8")
    assert "8 of 8" in text
    assert "make check DAY=1" not in text
    assert "inverse: t negated<br>" in text
    assert "<td class=pass>✓ left behind" in text
    diary = retro_of(done).read_bytes()
    assert b"Named mistakes met: 1; left behind: 1." in diary
    assert UNSEEN not in diary
    assert "report-week" not in run_in(REPORT, "--day", "1").stdout


@pytest.mark.parametrize("known", [False, True])
def test_what_no_check_has_seen_is_not_counted_and_not_run(run_in, request, kit, known):
    day = request.getfixturevalue("done" if known else "begun")
    if known:
        text = day.work.read_text("utf-8")
        day.work.write_text(text + "raise SystemExit\n", "utf-8")
    else:
        retro_of(day).write_bytes(BEFORE + AFTER)
    assert run_in(REPORT).returncode == 0
    text = (kit / "metrics" / "report-week1.html").read_text("utf-8")
    assert "make check DAY=1" in text
    assert "8 of 8" not in text
    assert UNSEEN in retro_of(day).read_bytes()


def test_the_kits_runs_are_not_mine(run_in, begun):
    run_in("scripts/run_day.py", "1", "--kit")
    assert "checks: 0 passing, 0 failing" in run_in(REPORT).stdout


def test_an_edit_after_the_run_makes_every_number_of_the_day_stale(run_in, kit, done):
    text = done.work.read_text("utf-8")
    broken = text.replace("    return make_T(R.T, -R.T @ t)", "    return T.T")
    done.work.write_text(broken + "# later\n", "utf-8")
    said = run_in(REPORT)
    assert "checks: 0 passing, 0 failing" in said.stdout
    told = " ".join(said.stdout.split())
    assert "day 1: Not checked in this version: make check DAY=1" in told
    assert "2 numbers from before your file changed: make run DAY=1" in told
    for page in ("report.html", "report-week1.html"):
        text = (kit / "metrics" / page).read_text("utf-8")
        assert "your file changed since" in text
        assert "✓ pass" not in text
    assert retro_of(done).read_bytes().count(b"(my file changed since)") == 2


def test_borrowed_functions_are_told_everywhere_and_pass_nowhere(
    run_in, begun, clone, diary
):
    assert run_in("scripts/borrow.py", "1.1").returncode == 0
    assert run_in("scripts/run_day.py", "1").returncode == 0
    checked = run_in("scripts/check_day.py", "1", "--explain").stdout
    assert "Borrowed from the kit: 1.1. The rows count once" in checked
    done = run_in(REPORT)
    assert "checks: 0 passing, 0 failing" in done.stdout
    assert "1.1 borrowed" in done.stdout
    for page in ("report.html", "report-week1.html"):
        assert "partly borrowed" in (clone / "metrics" / page).read_text("utf-8")
    assert b"Borrowed from the kit, and not counted: 1.1." in diary.read_bytes()
    (line,) = lines_of(LabResult(begun, True, [ran(SMALL)], ""))
    assert line[:3] == ("1", "part kit's", "fk")


def test_another_days_file_leaves_a_day_as_it_was_checked(run_in, done):
    done.work.with_name("day2_screws.py").write_text("x = 1\n")
    assert "Not checked" not in run_in(REPORT).stdout


@pytest.mark.parametrize("whole", [False, True])
def test_a_check_of_one_task_tells_nothing_of_the_others(run_in, request, kit, whole):
    request.getfixturevalue("done" if whole else "begun")
    run_in("scripts/check_day.py", "--task", "1.1")
    run_in(REPORT)
    page = (kit / "metrics" / "report-week1.html").read_text("utf-8")
    assert ("make check DAY=1" in page) is not whole
    assert ("8 of 8" in page) is whole


def test_the_weeks_facts_are_found_without_mujoco_and_the_sandbox():
    script = (
        "import sys, labkit.report.week_facts, labkit.report.week_page\n"
        "heads = ('numpy', 'mujoco', 'labkit.sandbox', 'robo47.capstone')\n"
        "print([name for name in sys.modules if name.startswith(heads)])"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True
    )
    assert done.stdout == "[]\n"
