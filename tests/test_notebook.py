"""The notebook: made of guide and starter, and in step with the lab's file."""

import dataclasses
import importlib
import importlib.util
import json
import os
import re
import subprocess
import sys

import numpy as np
import pytest

from conftest import ROOT, copy_kit, environment_of, need
from labkit.commands import notebook as command
from labkit.handin.deliverables import wanted_names
from labkit.handin.handin import notebook_name, read_handin
from labkit.lesson.cells import (
    BEGIN,
    definitions,
    lab_from,
    reverted,
    split_script,
    text_of,
    with_functions,
)
from labkit.lesson.day import all_days, find_day
from labkit.lesson.predictions import predictions
from labkit.lesson.starter import solution, starter_of
from labkit.notebook import build, guide, kernel, sync, worksheet
from robo47.errors import Robo47Error

DAY = find_day(1)
RZ = """def Rz(theta: float) -> np.ndarray:
    return turned(theta)
"""
HELPER = "def turned(angle):\n    return EPS * math.cos(angle)"
OTHERS = "import math\nEPS = 1.5\nUNUSED = 3"


@pytest.fixture
def day(tmp_path):
    """Return Day 1 in a folder where a student has begun it."""
    folder = tmp_path / DAY.folder.name
    (folder / "work").mkdir(parents=True)
    (folder / "src").symlink_to(DAY.folder / "src")
    (folder / "docs").mkdir()
    for name in (DAY.guide, DAY.worksheet):
        (folder / name).write_text((DAY.folder / name).read_text("utf-8"), "utf-8")
    begun = dataclasses.replace(DAY, folder=folder)
    begun.work.write_text(starter_of(DAY), "utf-8")
    return begun


def cells_of(text):
    return json.loads(text)["cells"]


def code_cells(text):
    return ["".join(c["source"]) for c in cells_of(text) if c["cell_type"] == "code"]


@pytest.mark.parametrize("day", all_days(), ids=lambda day: f"day {day.number}")
def test_every_task_has_its_function_and_its_check_in_the_order_of_the_guide(day):
    sources = code_cells(build.build(day, fresh=True))
    starter = starter_of(day)
    for task in day.tasks:
        check = sources.index(f'check("{task.id}")')
        names = task.functions
        above = sources[check - len(names) : check]
        for name, cell in zip(names, above, strict=True):
            assert cell == guide.with_notebook_commands(text_of(starter, name))
        assert check < sources.index("run()"), f"{task.id} comes after the run"
    steps = [
        int(found[1])
        for s in sources
        if (found := re.fullmatch(r"run\(step=(\d+)\)", s))
    ]
    assert steps == sorted(steps)
    assert len(steps) >= 3
    sheet = (ROOT / day.folder.name / day.worksheet).read_text("utf-8")
    asked = [s for s in sources if s.startswith("predict(")]
    assert len(asked) == len(build.rows_asked(sheet)) > 0
    assert len([s for s in sources if s.startswith("answer(")]) >= day.questions


@pytest.mark.parametrize(
    ("number", "row", "step"),
    [
        (11, "gradient for joint 1, m/rad", 3),
        (12, "one joint over 1 rad, s", 4),  # in a function that main calls
        (14, "heaviest cube, mu 0.3, 2 N per pad, g", 2),  # an f-string
    ],
)
def test_a_prediction_stands_above_the_step_that_measures_it(number, row, step):
    sources = code_cells(build.build(find_day(number), fresh=True))
    after = sources[sources.index(f"predict({row!r}, ...)") + 1 :]
    assert next(s for s in after if s.startswith("run(")) == f"run(step={step})"


def test_where_a_guide_asks_for_all_predictions_at_once_their_cells_are_there():
    cells = cells_of(build.build(DAY, fresh=True))
    asked = [i for i, c in enumerate(cells) if c["source"].startswith("predict(")]
    assert asked == list(range(asked[0], asked[0] + 3))
    assert "fill in the first column of *Predictions*" in cells[asked[0] - 1]["source"]
    assert cells[asked[-1] + 1]["source"].startswith("- **The height of the end")


@pytest.mark.parametrize(
    ("shell", "cell"),
    [
        ("`make check TASK=1.2`", '`check("1.2")`'),
        ("Numbers: make\nrun DAY=1 ARGS=--reveal", "Numbers: run(reveal=True)"),
        ("Numbers: make run\nDAY=1 ARGS=--reveal", "Numbers: run(reveal=True)"),
        ("`make run DAY=11 ARGS=--try`", "`run(NAME=value)`"),
        ("make view DAY=1 ARGS=--screenshot", "figure()"),
        ("`make check ARGS=--explain`", "`make check ARGS=--explain`"),
        ("make check DAY=1 TASK=1.2 ARGS=-v", "make check DAY=1 TASK=1.2 ARGS=-v"),
    ],
)
def test_a_command_for_a_terminal_is_that_of_a_cell_if_a_cell_does_the_same(
    shell, cell
):
    assert guide.with_notebook_commands(shell) == cell


def test_a_fenced_text_for_a_terminal_can_be_copied_into_a_cell():
    fence = "```sh\nmake check DAY=1  # all\ngit add metrics\n```"
    (block,) = guide.blocks_of(fence)
    wanted = "```text\ncheck()  # all\n!git add metrics\n```"
    assert guide.plain(block) == wanted
    (block,) = guide.blocks_of("```sh\nmake view ARGS=--web\n```")
    assert guide.plain(block) == block.text, "it waits, and a cell would wait with it"


@pytest.mark.parametrize("day", all_days(), ids=lambda day: f"day {day.number}")
def test_each_picture_of_a_day_follows_a_step_that_the_notebook_runs(day):
    run = set(re.findall(r"run\(step=(\d+)\)", build.build(day, complete=True)))
    assert build.extras(day).keys() <= run | {"end"}


def test_a_fold_with_nothing_but_an_output_is_a_step():
    output = "<!-- run: python src/a.py --no-log | step 4 -->\n```text\n4\n```\n"
    fold = "<details>\n<summary>The output</summary>\n\n{}<!-- end -->\n\n{}</details>"
    assert [b.step for b in guide.blocks_of(fold.format(output, ""))] == [4]
    assert [b.step for b in guide.blocks_of(fold.format(output, "And.\n\n"))] == [0]


def test_no_cell_shows_a_solution_a_mark_of_the_kits_or_a_command_for_a_terminal():
    made = build.build(DAY, fresh=True)
    assert "region 1." not in made
    assert "<!-- run" not in made
    assert "make hint TASK" not in made
    assert 'hint(\\"1.2\\")' in made
    for task in DAY.tasks:
        body = solution(DAY.source.read_text("utf-8"), "", task.id).splitlines()[-1]
        assert body.strip() not in "\n".join(code_cells(made))


def test_a_notebook_for_the_web_has_the_address_and_links_to_the_repository():
    made = build.build(DAY, fresh=True, repository="https://github.com/a/b")
    assert 'REPOSITORY = \\"https://github.com/a/b\\"' in made
    assert "https://raw.githubusercontent.com/a/b/HEAD/w1-foundations/docs/" in made
    assert "](day1.md)" not in made


@pytest.mark.parametrize("text", ["cells = 1", "[[cells]]\nafter = 1", "x = ", ""])
def test_a_notebook_toml_that_is_not_right_is_named(day, text):
    day.own.mkdir()
    (day.own / "notebook.toml").write_text(text, "utf-8")
    with pytest.raises(Robo47Error, match=r"notebook\.toml: .*expected \[\[cells\]\]"):
        build.extras(day)


def test_a_function_brings_the_helpers_imports_and_constants_that_it_uses():
    cells = definitions([OTHERS, HELPER, "%pip list\n!ls\nprint(1)", RZ])
    made = with_functions(starter_of(DAY), cells, ["Rz"])
    assert text_of(made, "Rz") == RZ.strip()
    assert set(split_script(made)[1]) == {"math", "EPS", "turned"}
    assert made.index("import math") < made.index("def turned") < made.index("def Rz")
    again = with_functions(
        made, definitions([HELPER.replace("cos", "sin"), RZ]), ["Rz"]
    )
    assert again.count(BEGIN) == 1
    assert "math.sin" in again
    assert "EPS = 1.5" in again  # of a cell that has not run in this kernel
    compile(again, "lab", "exec")


def test_a_cell_that_does_not_parse_still_reaches_the_checker():
    cells = definitions(
        ["def Rz(theta):\n    return (1\n", "def inverse(T):\n    return T"]
    )
    assert cells.functions["Rz"] == "def Rz(theta):\n    return (1"
    assert "inverse" in cells.functions


def test_the_last_cell_of_a_name_counts():
    cells = definitions(["def Rz(a):\n    return 1", "def Rz(a):\n    return 2"])
    assert "return 2" in cells.functions["Rz"]


def bring(day, body, **keep):
    cells = definitions([f"def Rz(theta):\n    return {body}"])
    return sync.bring(day, cells, **keep)


def in_file(day, body):
    script = day.work.read_text("utf-8")
    cells = definitions([f"def Rz(theta):\n    return {body}"])
    day.work.write_text(with_functions(script, cells, ["Rz"]), "utf-8")


def body_of(day):
    return text_of(day.work.read_text("utf-8"), "Rz").rpartition("return ")[2]


def test_a_cell_is_written_to_the_file_and_an_older_one_never_again(day):
    assert bring(day, 1).written == ["Rz"]
    assert bring(day, 2).written == ["Rz"]
    told = bring(day, 1)  # a notebook that was saved before
    assert (told.written, told.newer) == ([], ["Rz"])
    assert body_of(day) == "2"


def test_an_edit_of_the_file_alone_counts_and_is_told(day):
    bring(day, 1)
    in_file(day, 5)
    told = bring(day, 1)
    assert told.newer == ["Rz"]
    assert "newer than the cell" in told.sentences(day)[0]
    assert body_of(day) == "5"
    assert bring(day, 1, keep="notebook").written == ["Rz"]
    assert body_of(day) == "1"
    (kept,) = day.work.parent.glob("*.before-notebook-1.txt")
    assert "return 5" in kept.read_text("utf-8")


def test_an_edit_of_both_is_named_nothing_is_merged_and_the_student_chooses(day):
    bring(day, 1)
    in_file(day, 5)
    with pytest.raises(Robo47Error, match=r"Rz: edited in the notebook and in"):
        bring(day, 7)
    assert body_of(day) == "5"
    assert bring(day, 7, keep="file").newer == ["Rz"]
    assert body_of(day) == "5"
    other = "def Rz(theta):\n    return 6\n\n\ndef make_T(R, t):\n    return R\n"
    told = sync.bring(day, definitions([other]), keep="file")
    assert (told.written, told.newer) == (["make_T"], ["Rz"]), (
        "one choice, one function"
    )
    assert bring(day, 8, keep="notebook").written == ["Rz"]
    assert body_of(day) == "8"
    (kept,) = day.work.parent.glob("*.before-notebook-1.txt")
    assert "return 5" in kept.read_text("utf-8")


def test_an_earlier_text_that_is_run_again_on_purpose_counts(day):
    one, two = (f"def Rz(theta):\n    return {n}" for n in (1, 2))
    for cells, since, wanted in (
        ([one], 0, "1"),
        ([one, two], 1, "2"),
        ([one, two, one], 2, "1"),
        ([one, two, one, "x = 1"], 3, "1"),
    ):
        sync.bring(day, definitions(cells), "", reverted(cells, since))
        assert body_of(day) == wanted
    in_file(day, 5)
    again = [one, two, one, one]
    with pytest.raises(Robo47Error, match="Rz: edited in the notebook and in"):
        sync.bring(day, definitions(again), "", reverted(again, 3))
    assert reverted([two], 0) == set(), "after a restart an old notebook stays old"


def test_the_line_ends_of_windows_stay_in_the_lab_and_in_the_worksheet(
    day, monkeypatch
):
    monkeypatch.setattr(kernel, "_now", [day])
    sheet = day.folder / day.worksheet
    for path in (day.work, sheet):
        path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n"))
    bring(day, 1)
    name = next(iter(build.rows_asked(sheet.read_text("utf-8"))))
    kernel.predict(name, 0.25)
    for path in (day.work, sheet):
        content = path.read_bytes()
        assert content.count(b"\n") == content.count(b"\r\n") > 50
    assert body_of(day) == "1"
    assert predictions(sheet.read_text("utf-8")) == {name: "0.25"}


def test_a_picture_is_drawn_with_the_functions_of_the_file_as_they_are_now(day):
    for number in (5, 6):
        in_file(day, number)
        with kernel._own_modules(day):
            assert importlib.import_module(day.work.stem).Rz(0) == number
        assert day.work.stem not in sys.modules
        assert str(day.work.parent) not in sys.path


def test_an_empty_function_of_a_new_notebook_empties_nothing(day):
    in_file(day, 5)
    sync.bring(day, definitions(code_cells(build.build(DAY, fresh=True))))
    assert body_of(day) == "5"


def test_a_saved_notebook_counts_when_it_is_newer_than_the_file(day):
    made = json.loads(build.build(day, fresh=True))
    cell = next(c for c in made["cells"] if c["source"].startswith("def Rz"))
    cell["source"] = ["def Rz(theta):\n", "    return 3"]
    day.notebook.write_text(json.dumps(made), "utf-8")
    os.utime(day.notebook, (1, 1))
    assert sync.bring_saved(day).written == []
    os.utime(day.notebook)
    os.utime(day.work, (2, 2))
    assert sync.bring_saved(day).written == ["Rz"]
    assert body_of(day) == "3"


@pytest.mark.parametrize("content", [b"[" * 100_000, b"\xe9\xff", b"\0", b"[1]", b"{}"])
def test_a_file_that_is_no_notebook_is_named_wherever_it_is_read(day, content):
    day.notebook.write_bytes(content)
    os.utime(day.work, (2, 2))
    with pytest.raises(Robo47Error, match="it is no notebook"):
        sync.bring_saved(day)
    with pytest.raises(Robo47Error, match="is no notebook: move it away"):
        command.renew(day)
    day.work.unlink()
    handin = read_handin(day, day.folder.parent)
    assert "cannot be used: it is no notebook" in handin.unread[day.files["script"]]


def test_a_notebook_alone_is_a_hand_in_and_the_commit_asks_for_it(day):
    made = json.loads(build.build(day, fresh=True))
    cell = next(c for c in made["cells"] if c["source"].startswith("def Rz"))
    cell["source"] = "def Rz(theta):\n    return 3"
    day.work.unlink()
    day.notebook.write_text(json.dumps(made), "utf-8")
    handin = read_handin(day, day.folder.parent)
    lab = handin.files[day.files["script"]].decode()
    assert lab == lab_from(day, day.notebook.read_bytes())
    assert "return 3" in text_of(lab, "Rz")
    assert "NotImplementedError" in text_of(lab, "inverse")
    wanted = wanted_names(day, handin)
    assert notebook_name(day) in wanted
    assert day.files["script"] not in wanted


def test_the_worksheet_takes_an_answer_once_and_its_correction(day):
    sheet = (day.folder / day.worksheet).read_text("utf-8")
    names = [place.name for place in worksheet.places(sheet)]
    assert "question 2" in names
    assert not [name for name in names if name.startswith("Drawing")]
    first = worksheet.with_answer(sheet, "question 2", "A\nB")
    assert "\n   A\n   B\n" in first
    second = worksheet.with_answer(first, "question 2", "C", "A\nB")
    assert second == worksheet.with_answer(sheet, "question 2", "C")
    with pytest.raises(Robo47Error, match="has another answer already"):
        worksheet.with_answer(second, "question 2", "D", "A\nB")
    with pytest.raises(Robo47Error, match="no place 'question 99'; still open: 'Pose'"):
        worksheet.with_answer(second, "question 99", "D")


def test_a_prediction_is_written_into_its_row(day, monkeypatch):
    monkeypatch.setattr(kernel, "_now", [day])
    sheet = day.folder / day.worksheet
    name = next(iter(build.rows_asked(sheet.read_text("utf-8"))))
    assert "in place of the three dots" in repr(kernel.predict(name, ...))
    assert not predictions(sheet.read_text("utf-8"))
    kernel.predict(name, 0.25)
    assert predictions(sheet.read_text("utf-8")) == {name: "0.25"}
    told = repr(kernel.predict("x", 1))
    assert "no row 'x'" in told
    assert repr(name) in told
    for value in ("", None, "1 | 2", "1\n2"):
        kernel.predict(name, value)
    assert predictions(sheet.read_text("utf-8")) == {name: "0.25"}


def test_a_constant_is_changed_for_one_run_below_its_definition():
    script = "A, B = 1, 2\nC = [\n 3]\nD = 2 * B\n"
    there: dict[str, object] = {}
    exec(kernel.with_constants(script, {"B": 5, "C": [4]}), there)
    assert (there["A"], there["B"], there["C"], there["D"]) == (1, 5, [4], 10)
    with pytest.raises(Robo47Error, match="no constant E"):
        kernel.with_constants(script, {"E": 1})


def test_what_is_called_before_the_first_cell_says_so(monkeypatch):
    monkeypatch.setattr(kernel, "_now", [])
    assert "run the first cell" in repr(kernel.check("1.1"))


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: kernel.check("99.1"), "day 1 has no task 99.1"),
        (lambda: kernel.check(1.1), 'for example, check("1.1")'),
        (lambda: kernel.check("1.1", keep="me"), 'keep is "notebook" or "file"'),
        (lambda: kernel.hint(1.1), "task is text in quotation marks, and this is 1.1"),
        (lambda: kernel.predict("x"), "missing a required argument: 'value'"),
        (lambda: kernel.answer("question 1", 3), "words is text in quotation marks"),
        (
            lambda: kernel.run(step=99),
            "the lab has no step 99; it has 1, 2, 3, 4, 5, 6",
        ),
        (lambda: kernel.run(step="3"), "step is a whole number, and this is '3'"),
        (lambda: kernel.run(step=True), "step is a whole number, and this is True"),
        (lambda: kernel.run(step=1, NOPE=1), "the lab has no constant NOPE"),
        (lambda: kernel.load("nothing"), "has no function nothing"),
        (lambda: kernel.begin("x"), "number is a whole number, and this is 'x'"),
        (lambda: kernel.figure("x"), "too many positional arguments"),
    ],
)
def test_a_wrong_call_gets_one_line(day, monkeypatch, call, says):
    monkeypatch.setattr(kernel, "_now", [day])
    day.work.write_text(DAY.source.read_text("utf-8"), "utf-8")
    said = repr(call())
    assert says in said
    assert "\n" not in said


def test_a_picture_that_the_day_has_not_is_named(day, monkeypatch):
    pytest.importorskip("matplotlib", reason="needs matplotlib: make figures")
    test_a_wrong_call_gets_one_line(
        day, monkeypatch, lambda: kernel.picture("nothing"), "no picture 'nothing'; it"
    )


def test_a_fault_of_a_students_function_in_a_picture_is_one_line(day, monkeypatch):
    pytest.importorskip("matplotlib", reason="needs matplotlib: make figures")
    monkeypatch.setattr(kernel, "_now", [day])
    told = repr(kernel.picture("day1_order"))
    assert told.endswith("still to do; task 1.2: write Rz")
    in_file(day, "1 / 0")
    with pytest.raises(ZeroDivisionError) as caught, kernel._own_modules(day):
        importlib.import_module(day.work.stem).Rz(0)
    told = kernel._own_fault(day, caught.value)
    assert told == "your Rz, `return 1 / 0`: ZeroDivisionError: division by zero"
    with pytest.raises(KeyError):
        kernel._own_fault(day, KeyError("the kit's own"))


def test_a_step_that_the_lab_does_not_reach_shows_where_it_stopped():
    first = "Predict first: 3 are missing.\nrobot: Panda\n\n1. One\n  a (hidden)\n\n"
    printed = first + "2. Two\nto do: task 1.6: write f\n"
    told = kernel._step_output(printed, 3)
    assert told.startswith("The lab stopped before step 3.")
    assert "task 1.6" in told
    assert "One" not in told
    assert kernel._step_output(printed, 1).startswith(
        "Predict first: 3 are missing.\n\n1. One"
    )


def test_a_constant_that_the_lab_cannot_use_is_one_line_below_its_output(
    day, monkeypatch, capsys
):
    monkeypatch.setattr(kernel, "_now", [day])
    crash = "1. One\n  a 1\nTraceback (most recent call last):\n  File x\n    f(\n"
    monkeypatch.setattr(kernel, "_printed", lambda _: f"{crash}ValueError: no, a: b")
    kernel.run(step=1, TRIALS="x")
    assert capsys.readouterr().out == "1. One\n  a 1\nValueError: no, a: b\n"


@pytest.mark.parametrize(
    ("number", "command"),
    [
        (1, ("view_panda.py", "1", "--screenshot")),
        (11, ("make_figures.py", "--day", "11")),
    ],
)
def test_the_picture_to_hand_in_has_a_cell_on_every_day(monkeypatch, number, command):
    assert "figure()" in code_cells(build.build(find_day(number), fresh=True))
    monkeypatch.setattr(kernel, "_now", [find_day(number)])
    monkeypatch.setattr(kernel, "_bring", lambda day: [])
    ran = []
    monkeypatch.setattr(kernel, "_script", lambda *words: ran.append(words) or "")
    kernel.figure()
    assert ran == [command]


def test_a_lab_that_stops_early_hides_only_steps_with_numbers_to_be_predicted(
    day, monkeypatch, capsys
):
    monkeypatch.setattr(kernel, "_now", [day])
    complete = "1. One\n  a 5.25\n\n2. Two\n  b (hidden)\n\n"
    monkeypatch.setattr(kernel, "_printed", lambda command: complete)
    ran = []

    def script(name, *arguments):
        ran.append("--reveal" in arguments)
        number = "5.25" if ran[-1] else "(hidden)"
        return f"1. One\n  a {number}\n\n2. Two\n  b {number}\n\n"

    monkeypatch.setattr(kernel, "_script", script)
    kernel.run(step=1)
    assert "a 5.25" in capsys.readouterr().out
    kernel.run(step=2)
    assert "b (hidden)" in capsys.readouterr().out
    kernel.run(step=2, reveal=True)
    assert "b 5.25" in capsys.readouterr().out
    for name in build.rows_asked((day.folder / day.worksheet).read_text("utf-8")):
        kernel.predict(name, 1)
    kernel.run(step=2)
    assert ran[-1] is False, "nothing is hidden, so the lab decides"


def test_a_cell_with_a_syntax_error_is_named_with_its_own_line_until_it_is_right():
    broken = "import math\n\ndef Rz(theta):\n    return (1\n"
    assert definitions([broken]).broken == {"Rz": "line 4: '(' was never closed"}
    assert definitions([broken, RZ]).broken == {}


def test_a_notebook_is_written_once_and_shows_later_edits_of_the_file(
    day, monkeypatch, capsys
):
    monkeypatch.setattr(command, "chosen_day", lambda number: day)
    monkeypatch.setattr(sys, "argv", ["make_notebook.py"])
    assert command.main() == 0
    assert "day1.ipynb written" in " ".join(capsys.readouterr().out.split())
    found = json.loads(day.notebook.read_text("utf-8"))
    found["cells"].append(build.code("mine = 1"))
    day.notebook.write_text(json.dumps(found), "utf-8")
    in_file(day, 5)
    assert command.main() == 0
    assert "Renewed from" in " ".join(capsys.readouterr().out.split())
    sources = code_cells(day.notebook.read_text("utf-8"))
    assert "mine = 1" in sources
    assert any("return 5" in source for source in sources)


def test_no_notebook_comes_with_the_kit():
    need((ROOT / ".git").exists(), "the kit as a git repository")
    listed = ["git", "ls-files", "*.ipynb"]
    done = subprocess.run(listed, cwd=ROOT, capture_output=True, text=True, check=True)
    assert done.stdout == ""


def test_without_the_kit_the_set_up_asks_for_the_clones_address(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    setup = code_cells(build.build(DAY, fresh=True))[0]
    with pytest.raises(AssertionError, match="write the address of the course"):
        exec(setup, {})


@pytest.mark.kit
def test_a_wrong_function_is_told_in_its_cell_and_the_run_goes_on(tmp_path):
    nbclient = pytest.importorskip("nbclient", reason="needs nbclient: make notebook")
    nbformat = pytest.importorskip("nbformat", reason="needs nbformat: make notebook")
    kit = copy_kit(tmp_path / "kit")
    made = nbformat.reads(build.build(DAY, fresh=True), as_version=4)
    nbformat.validate(made)
    wrong = "def Rz(theta):\n    c, s = np.cos(theta), np.sin(theta)\n"
    wrong += "    return np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])"
    kept = []
    for cell in made.cells:
        if cell.source.startswith("def Rz("):
            cell.source = wrong
        if re.match(r'(# Run|import|def Rz|check\("1.2"\)|run\(step=3)', cell.source):
            kept.append(cell)
    made.cells = kept
    where = {"metadata": {"path": str(kit)}}
    client = nbclient.NotebookClient(made, timeout=120, resources=where)
    client.execute(env=environment_of(kit))
    told = "\n".join(str(out) for cell in made.cells for out in cell.outputs)
    assert "WRONG" in told
    assert "<table>" in told
    assert "task 1.1: write make_T" in told
    work = kit / DAY.folder.name / "work"
    assert "[-s, c, 0]" in (work / DAY.script).read_text("utf-8")


@pytest.mark.kit
@pytest.mark.gl
@pytest.mark.usefixtures("gl")
def test_a_slider_moves_the_arm_and_the_matrix_of_the_function_that_is_given():
    pytest.importorskip("ipywidgets", reason="needs ipywidgets: make notebook")
    from labkit.figures.sliders import joint_sliders

    left, picture = joint_sliders().children
    *sliders, numbers = left.children
    before = picture.value, numbers.value
    sliders[0].value = 1.0
    assert picture.value != before[0]
    assert numbers.value != before[1]
    assert "color:green" in numbers.value
    assert "robo47.kinematics" in numbers.value, "what computed it is named"
    assert "T_world_ee, MuJoCo" in numbers.value
    assert "-0.0000" not in numbers.value
    wanted = [f"joint{i}, rad" for i in range(1, 8)]
    assert [s.description for s in sliders] == wanted
    assert sliders[3].max < 0  # joint4's limits, so that 0 cannot be chosen

    def compose_fk(model, q):
        return np.eye(4)

    left, _ = joint_sliders(compose_fk).children
    assert "T_world_ee, compose_fk" in left.children[-1].value
    assert "color:crimson" in left.children[-1].value
