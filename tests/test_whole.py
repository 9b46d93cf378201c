"""CI tests a day wholly that has changed, and a sample of each other day."""

import importlib.util
import operator
import os
import re
import shutil
import subprocess
import sys
from functools import partial
from types import SimpleNamespace

import digests
import pytest
import whole

import conftest
from conftest import ROOT, SKIPPED, copy_kit, keep_first_day
from labkit.base import git
from labkit.commands import kernels
from labkit.lesson.day import all_days, find_day

pytestmark = pytest.mark.kit
W1 = "w1-foundations"
STATEMENT, COMMENT, DOCSTRING = "\nNEW = 1\n", "\n# A comment.\n", '"""Another."""\n'


@pytest.fixture(scope="module")
def kept(tmp_path_factory):
    """Return a copy of the kit with its first day alone, and its tests."""
    copy = keep_first_day(copy_kit(tmp_path_factory.mktemp("kit") / "copy"))
    shutil.copytree(ROOT / "tests", copy / "tests", ignore=SKIPPED)
    shutil.copy(ROOT / "constraints.txt", copy)
    files = f"{W1}/day1/submissions"
    shutil.copytree(ROOT / files, copy / files)
    return copy


@pytest.fixture
def day(kept, monkeypatch):
    """Return the day of that copy."""
    twin = kept / "robo47" / "panda" / "models" / "panda_twin.xml"
    monkeypatch.setattr(digests, "ROOT", kept)
    monkeypatch.setattr(digests, "TWIN_XML", twin)
    monkeypatch.setattr(whole, "RECORDS", kept / "tests" / "catalogues.txt")
    for name in ("ROBO47_DAY", "ROBO47_WHOLE"):
        monkeypatch.delenv(name, raising=False)
    whole.RECORDS.unlink(missing_ok=True)
    whole.record([find_day(1, kept)])
    return find_day(1, kept)


@pytest.fixture
def edited(day, kept):
    """Return whether the day has changed once a file is edited; put the file back."""

    def has_changed(name, edit):
        file = kept / name
        before = file.read_text("utf-8")
        try:
            file.write_text(edit(before), "utf-8")
            return whole.changed(find_day(1, kept))
        finally:
            file.write_text(before, "utf-8")

    return has_changed


@pytest.mark.parametrize(
    ("name", "more"),
    [
        (f"{W1}/day1/inverse.py", STATEMENT),
        (f"{W1}/day1/places.py", STATEMENT),  # which the day's own files import
        (f"{W1}/day1/submissions/wrong/quat_xyzw.py", STATEMENT),
        (f"{W1}/src/day1_transforms.py", COMMENT),  # the checker quotes it
        (f"{W1}/day1/day.toml", "seconds = 3.0\n"),  # of the last task
        (f"{W1}/day1/figures.py", STATEMENT),
        (f"{W1}/day1/test_day1.py", STATEMENT),
        ("labkit/judge/matcher.py", STATEMENT),
        ("labkit/check/tasks.py", STATEMENT),
        ("labkit/lesson/lab.py", STATEMENT),
        ("robo47/se3.py", STATEMENT),
        ("robo47/dynamics.py", STATEMENT),  # which screws.py names in a string
        ("robo47/panda/models/panda_twin.xml", "\n<!-- -->\n"),
        ("tests/catalogue.py", STATEMENT),
        ("tests/judged.py", STATEMENT),
        ("constraints.txt", "mujoco==99.0\n"),
    ],
)
def test_a_day_is_tested_wholly_where_anything_that_decides_a_verdict_changed(
    edited, name, more
):
    assert edited(name, lambda text: text + more)


@pytest.mark.parametrize(
    ("name", "more"),
    [
        (f"{W1}/docs/day1-lab.md", "More words.\n"),
        ("labkit/judge/matcher.py", COMMENT),
        ("labkit/inspector/page.py", STATEMENT),
        ("labkit/site/pages.py", STATEMENT),
        ("robo47/optimal.py", STATEMENT),  # a library of other days alone
        ("constraints.txt", "sphinx==99.0\n"),
    ],
)
def test_what_decides_no_verdict_leaves_the_sample(edited, name, more):
    assert not edited(name, lambda text: text + more)


def test_neither_a_docstring_nor_a_hint_changes_a_day(edited):
    judge, manifest = "labkit/judge/judge.py", f"{W1}/day1/day.toml"
    assert not edited(judge, lambda text: DOCSTRING + text.split('"""\n', 1)[1])
    assert not edited(manifest, lambda text: text.replace("?", ", then?"))
    assert edited(manifest, lambda text: text.replace('"Rz"', '"Rx"'))


def test_a_file_more_changes_a_day(day, kept):
    more = kept / W1 / "day1" / "submissions" / "wrong" / "more.py"
    more.write_text("# task 1.1: more\n# It is new.\n")
    try:
        assert whole.changed(find_day(1, kept))
    finally:
        more.unlink()
    assert not whole.changed(day)


def test_only_the_days_own_record_gives_the_sample(day):
    (own,) = whole.recorded()[1]
    assert whole.asked(day, range(50), "x") != range(50)
    for text in (
        "",
        f"day 2: {own}\n",
        "day 1: 0123456789abcdef\n",
        f"day 1: {own[1:]}\n",
    ):
        whole.RECORDS.write_text(text)
        assert whole.asked(day, range(50), "x") == range(50)
    whole.RECORDS.unlink()
    assert whole.asked(day, range(50), "x") == range(50)


def test_after_a_merge_a_day_has_the_lines_of_both_branches(day):
    merged = f"day 1: 0123456789abcdef\n{whole.RECORDS.read_text()}"
    whole.RECORDS.write_text(merged)
    assert not whole.changed(day)
    whole.record([day])  # the next record is one line again
    assert len(whole.recorded()[1]) == 1


@pytest.mark.parametrize("name", ["ROBO47_WHOLE", "ROBO47_DAY"])
def test_at_night_and_for_an_author_a_day_is_asked_wholly(day, monkeypatch, name):
    assert not whole.changed(day)
    monkeypatch.setenv(name, "1")
    assert whole.changed(day)


def test_a_record_leaves_the_other_days_lines(day):
    whole.RECORDS.write_text("day 10: 0123456789abcdef\nday 2: 0123456789abcdef\n")
    whole.record([day])
    assert list(whole.recorded()) == [1, 2, 10]


def test_the_sample_is_a_tenth_and_another_one_at_each_commit(monkeypatch):
    seen = []
    for commit in map(str, range(200)):
        monkeypatch.setattr(whole, "commit", lambda commit=commit: commit)
        seen.append(whole.sample(range(50), "x"))
        assert len(seen[-1]) == 5
        assert seen[-1] == whole.sample(range(50), "x")
        assert len(whole.sample(range(3), "x")) == 1
        kinds = whole.one_of_each(range(50), lambda n: n % 7)
        assert sorted(n % 7 for n in kinds) == list(range(7))
    assert whole.sample([], "x") == []
    assert {one for some in seen for one in some} == set(range(50))


def test_the_sample_follows_the_commit_of_the_repository():
    head = git.run("rev-parse", "HEAD", folder=ROOT, seconds=git.SECONDS).stdout.strip()
    assert whole.commit() == head


def report(nodeid, outcome, when="call"):
    told = {name: outcome == name for name in ("passed", "failed", "skipped")}
    return SimpleNamespace(nodeid=nodeid, outcome=outcome, when=when, **told)


@pytest.mark.parametrize(
    ("nodeid", "outcome", "good"),
    [
        ("a.py::test[day1/Rz]", "passed", {1, 2}),
        ("a.py::test[day1/Rz]", "failed", {2}),
        ("a.py::test[day1]", "skipped", {2}),  # it was not asked
        ("w1-foundations/day2/test_day2.py::test[day1]", "failed", {1}),
        ("a.py::test", "failed", set()),
        ("a.py::test[NOTSET]", "skipped", {1, 2}),  # nothing to ask of these days
    ],
)
def test_a_day_is_recorded_only_where_all_its_tests_pass(nodeid, outcome, good):
    outcomes = whole.Outcomes()
    for one in (report("a.py::t[day1]", "passed"), report("a.py::t[day2]", "passed")):
        outcomes.pytest_runtest_logreport(one)
    outcomes.pytest_runtest_logreport(report(nodeid, outcome))
    assert outcomes.passed - outcomes.failed == good


def test_of_a_run_the_days_that_pass_are_recorded(tmp_path, run):
    """Day 2 fails and Day 3 has no test, so that Day 1 alone is recorded."""
    file = tmp_path / "test_days.py"
    file.write_text(
        "import os, pytest\npytestmark = pytest.mark.kit\n"
        "assert os.environ['ROBO47_DAY'] == '1,2,3'\n"
        "@pytest.mark.parametrize('n', [1, 2], ids=['day1', 'day2/f'])\n"
        "def test_a(n): assert n == 1 and os.environ['ROBO47_WHOLE']\n"
    )
    script = tmp_path / "ask.py"
    script.write_text(
        f"import sys; sys.path[:0] = [{str(ROOT)!r}, {str(ROOT / 'tests')!r}]\n"
        f"import whole; whole.tests_of = lambda days: [{str(file)!r}]\n"
        "days = [whole.find_day(n) for n in (1, 2, 3)]\n"
        "print('good', [day.number for day in whole.ask(days)])\n"
    )
    done = run(script, PYTEST_ADDOPTS="--collect-only")
    assert done.stdout.splitlines()[-1] == "good [1]", done.stdout + done.stderr


def test_a_file_that_is_loaded_and_left_out_of_the_digest_is_named(monkeypatch):
    day = find_day(1)
    before = digests.missed(day)
    files = {path.relative_to(ROOT).as_posix() for path in digests.files_of(day)}
    every = (path.relative_to(ROOT).as_posix() for path in ROOT.glob("labkit/*/*.py"))
    name = next(path for path in every if path not in {*before, *files})
    page = SimpleNamespace(__file__=str(ROOT / name))
    monkeypatch.setitem(sys.modules, "of_the_site", page)
    assert name in digests.missed(day)


@pytest.fixture
def loaded(monkeypatch):
    """Load a file of tests anew, for two days, of which the first has changed."""
    two = [find_day(1), find_day(5)]
    monkeypatch.setattr(conftest, "days", lambda: two)
    monkeypatch.setattr(whole, "changed", lambda day: day.number == 1)

    def load(name):
        spec = importlib.util.spec_from_file_location(
            f"{name}_anew", f"tests/{name}.py"
        )
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        return module

    return load


def test_the_catalogues_tests_ask_all_of_a_changed_day_and_some_of_another(
    loaded, monkeypatch
):
    monkeypatch.chdir(ROOT)
    catalogue, judging = loaded("test_days_catalogue"), loaded("test_days_judging")
    first, other = (find_day(number) for number in (1, 5))
    verdicts = [param.values[0].number for param in catalogue.FUNCTIONS]
    assert verdicts.count(1) == len(catalogue.functions(first))
    assert verdicts.count(5) == 1 < len(catalogue.functions(other))
    judged = [param.values[0] for param in judging.ROWS]
    assert judged.count(1) == len(judging.rows(first))
    assert 1 <= judged.count(5) < len(judging.rows(other))
    runs = {1: "--labs", 5: "--some-labs"}

    def run(_, number, which, **options):
        assert which == runs.pop(number)
        return SimpleNamespace(returncode=0)

    for day in (first, other):
        catalogue.test_a_wrong_file_run_as_a_lab_fails(day, run)
    assert not runs


def item(path, name, mark):
    """Return a collected test of a file, with its name and its mark."""
    marked = partial(operator.eq, mark)
    return SimpleNamespace(path=path, nodeid=name, get_closest_marker=marked)


def test_of_a_days_authors_tests_a_tenth_is_left_where_it_has_not_changed(monkeypatch):
    monkeypatch.setattr(whole, "changed", lambda day: day.number == 1)
    monkeypatch.setattr(whole, "machine_is_recorded", lambda: False)

    first, other, house = find_day(1).own, find_day(5).own, ROOT / "tests"
    folders = [folder for folder in (first, other, house) for _ in range(30)]
    items = [item(folder / "test_x.py", "", "kit") for folder in folders]
    students = [item(other / "test_x.py", "", "") for _ in range(30)]
    left = whole.left_out([*items, *students])
    assert len(left) == 27
    assert {one.path.parent for one in left} == {other}
    assert not [one for one in left if one in students]


@pytest.fixture
def machine(tmp_path, monkeypatch):
    """Return a function that edits a small repository; is its machine recorded?"""
    copy = tmp_path / "kit"
    texts = {"labkit/a.py": "1", "w1-a/day1/b.py": "2", "w1-a/src/c.py": "3"}
    texts["w1-a/docs/day1-lab.md"] = "<!-- run: make x -->\n0.1 m\n<!-- end -->\n"

    def edit(name, text):
        (copy / name).parent.mkdir(parents=True, exist_ok=True)
        (copy / name).write_text(text)
        subprocess.run(["git", "add", "-A"], cwd=copy, check=True)
        return whole.machine_is_recorded()

    copy.mkdir()
    subprocess.run(["git", "init", "-q"], cwd=copy, check=True)
    week = copy / "w1-a"
    day = SimpleNamespace(
        number=1,
        folder=week,
        guide="docs/day1-lab.md",
        own=week / "day1",
        source=week / "src" / "c.py",
    )
    monkeypatch.setattr(digests, "ROOT", copy)
    monkeypatch.setattr(whole, "RECORDS", copy / "tests" / "catalogues.txt")
    monkeypatch.setattr(whole, "all_days", lambda: [day])
    monkeypatch.delenv("ROBO47_WHOLE", raising=False)
    for name, text in texts.items():
        assert not edit(name, text)
    (copy / "tests").mkdir()
    assert whole.record_machine().startswith("machine 1: ")
    return edit


def test_a_record_of_the_machine_holds_until_its_code_or_that_of_its_days_changes(
    machine,
):
    assert machine("README.md", "words")
    output = "<!-- run: make x -->\n{}\n<!-- end -->\n"
    assert machine("w1-a/docs/day1-lab.md", "words\n" + output.format("0.1 m"))
    assert not machine("w1-a/docs/day1-lab.md", output.format("0.2 m"))
    assert whole.record_machine()
    assert machine("w2-b/day8/new.py", "another day")
    for name in ("labkit/a.py", "w1-a/day1/b.py", "w1-a/src/c.py", "tests/test_d.py"):
        assert not machine(name, "changed")
        assert whole.record_machine()
        assert machine("README.md", f"words on {name}")


def test_with_the_machine_recorded_ci_leaves_out_most_tests_that_ask_about_no_new_day(
    monkeypatch,
):
    files = sorted((ROOT / "tests").glob("test_*.py"))
    items = [item(path, f"tests/{path.name}::test_it", "kit") for path in files]
    monkeypatch.setattr(whole, "machine_is_recorded", lambda: False)
    assert whole.left_out_of_machine(items) == []
    monkeypatch.setattr(whole, "machine_is_recorded", lambda: True)
    left = {one.path.name for one in whole.left_out_of_machine(items)}
    assert {"test_days_catalogue.py", "test_site.py", "test_docs.py"}.isdisjoint(left)
    alone = [path for path in files if not whole.EVERY_DAY.search(path.read_text())]
    assert len(left) == len(alone) - len(alone) // whole.FILES_PART


@pytest.mark.parametrize("kernel", ["", "Prescott"])
def test_with_the_machine_recorded_a_fifth_of_the_days_that_are_the_same_is_asked(
    monkeypatch, kernel
):
    monkeypatch.setattr(whole, "changed", lambda day: day.number == 1)
    monkeypatch.setattr(whole, "machine_is_recorded", lambda: True)
    monkeypatch.setenv("OPENBLAS_CORETYPE", kernel)
    path = ROOT / "tests" / "test_days.py"
    days = [day.number for day in all_days()]
    loops = [item(path, f"tests/test_days.py::test_it[day{n}]", "kit") for n in days]
    other = item(path, "tests/test_days.py::test_another", "kit")
    students = [
        item(find_day(n).own / "t.py", f"w/day{n}/t.py::test", "") for n in days
    ]
    left = whole.left_out_of_machine([*loops, other, *students])
    kept = [one for one in loops if one not in left]
    assert loops[0] in kept
    assert len(kept) == 1 + (len(days) - 1) // whole.FILES_PART
    assert other not in left
    assert students[0] not in left
    assert bool([one for one in students if one in left]) == bool(kernel)


@pytest.mark.parametrize(("nightly", "asked"), [("", "Prescott"), ("1", "--others")])
def test_ci_tests_all_days_wholly_at_night(nightly, asked):
    ci = (ROOT / ".ci" / "run").read_text("utf-8")
    (part,) = re.findall(r"(?ms)^kernels=.*?^fi$", ci)
    script = f'{part}\necho "$kernels ${{ROBO47_WHOLE:-}}"'
    variables = {**os.environ, "NIGHTLY": nightly}
    variables.pop("ROBO47_WHOLE", None)
    done = subprocess.run(
        ["bash", "-c", script], env=variables, capture_output=True, text=True
    )
    assert done.stdout.strip() == f"{asked} {nightly}".strip()


def test_what_a_run_skips_is_written_as_arguments_of_another_run(tmp_path):
    ran, test, file = (
        SimpleNamespace(skipped=skipped, nodeid=name)
        for skipped, name in [(False, "a.py::ran"), (True, "a.py::b"), (True, "c.py")]
    )
    skipped = conftest.Skipped(tmp_path / "skipped")
    for report in (ran, test, test):
        skipped.pytest_runtest_logreport(report)
    skipped.pytest_collectreport(file)
    skipped.pytest_sessionfinish()
    assert (tmp_path / "skipped").read_text() == "a.py::b\nc.py\n"


def test_what_ci_leaves_to_another_kernel_is_run_there():
    ci = (ROOT / ".ci" / "run").read_text("utf-8")
    (left,) = re.findall(r"^outputs=(\S+)$", ci, re.MULTILINE)
    file, name = left.split("::")
    assert file in kernels.command(whole=True)
    assert f"def {name}(" in (ROOT / file).read_text("utf-8")
