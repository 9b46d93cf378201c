"""The notebook: made from the script, never stale, and it runs from top to bottom."""

import dataclasses
import functools
import importlib.util
import json
import os
import re
import shutil
import subprocess
import sys

import pytest

from conftest import ROOT, need

if not os.environ.get("ROBO47_CI"):
    for package in ("ipykernel", "ipywidgets", "jupytext", "nbclient"):
        pytest.importorskip(package, reason=f"needs {package}: make notebook")
import nbclient
import nbformat
import numpy as np

from labkit.commands import notebook as command
from labkit.lesson import notebook
from labkit.lesson.day import all_days, find_day
from robo47.errors import Robo47Error

pytestmark = pytest.mark.kit

DAY = find_day(1)
LOGGING = 'sys.argv = ["day1_transforms"]'


@pytest.fixture
def generator(monkeypatch, tmp_path):
    """Return the command, writing elsewhere."""
    path = tmp_path / "notebooks" / "day1.ipynb"
    monkeypatch.setattr(command, "notebook_of", lambda day: path)
    monkeypatch.setattr(sys, "argv", ["make_notebook.py", "--day", "1"])
    return command


@functools.cache
def made():
    """Return the text of the day's notebook."""
    return notebook.build(DAY)


def cells(kind):
    notebook = nbformat.reads(made(), as_version=4)
    return [cell for cell in notebook.cells if cell.cell_type == kind]


def outputs(notebook, kind):
    found = [out for cell in notebook.cells for out in cell.get("outputs", [])]
    return [out for out in found if out.output_type == kind]


def test_a_notebook_is_made_once_and_is_up_to_date_then(generator, monkeypatch, capsys):
    assert generator.main() == 0
    assert "written" in capsys.readouterr().out
    monkeypatch.setattr(sys, "argv", [*sys.argv, "--check"])
    assert generator.main() == 0
    assert "is up to date" in capsys.readouterr().out


def test_no_notebook_comes_with_the_kit():
    ignored = (ROOT / ".gitignore").read_text("utf-8").splitlines()
    assert "/w*/notebooks/" in ignored
    need((ROOT / ".git").exists(), "the kit as a git repository")
    listed = ["git", "ls-files", "w*/notebooks"]
    done = subprocess.run(listed, cwd=ROOT, capture_output=True, text=True, check=True)
    assert done.stdout == ""


def test_one_that_was_only_run_is_made_anew_and_one_with_an_edit_is_kept(
    generator, capsys
):
    path = generator.notebook_of(DAY)
    assert generator.main() == 0
    ran = nbformat.read(path, as_version=4)
    cell = next(cell for cell in ran.cells if cell.cell_type == "code")
    cell.outputs = [nbformat.v4.new_output("stream", text="printed")]
    nbformat.write(ran, path)
    assert generator.main() == 0
    assert [p.name for p in path.parent.iterdir()] == [path.name]
    for n in (1, 2):
        cell.source = f"mine = {n}"
        nbformat.write(ran, path)
        assert generator.main() == 0
        kept = path.with_suffix(f".before-{n}.ipynb")
        assert kept.name in capsys.readouterr().out
        assert f"mine = {n}" in kept.read_text("utf-8")
    assert path.read_text("utf-8") == made()


@pytest.mark.parametrize("content", [b"[" * 100_000, b"\xe9\xff", b"\0", b"[1]"])
def test_a_broken_one_is_kept_under_another_name(generator, capsys, content):
    path = generator.notebook_of(DAY)
    path.parent.mkdir()
    path.write_bytes(content)
    assert generator.main() == 0
    assert "as you had it" in capsys.readouterr().out
    assert path.with_suffix(".before-1.ipynb").read_bytes() == content


@pytest.mark.parametrize("make", ["mkdir", "symlink_to"])
def test_what_is_no_file_is_named(generator, make, tmp_path):
    path = generator.notebook_of(DAY)
    path.parent.mkdir()
    getattr(path, make)(*[tmp_path / "gone"] * (make == "symlink_to"))
    with pytest.raises(Robo47Error, match="is no file: move it away"):
        generator.main()


def test_a_changed_script_makes_it_stale(generator, monkeypatch, tmp_path):
    assert generator.main() == 0
    before = generator.notebook_of(DAY).read_bytes()
    source = DAY.source.read_text("utf-8")
    changed = tmp_path / "src" / DAY.script
    changed.parent.mkdir()
    changed.write_text(source.replace("np.pi / 4", "np.pi / 3"), "utf-8")
    shutil.copytree(DAY.own, tmp_path / DAY.own.name)
    moved = dataclasses.replace(DAY, folder=tmp_path)
    monkeypatch.setattr(generator, "chosen_day", lambda number: moved)
    monkeypatch.setattr(sys, "argv", ["make_notebook.py", "--check"])
    assert generator.main() == 1
    assert generator.notebook_of(DAY).read_bytes() == before


def test_every_heading_carries_its_functions_own_task():
    text = "\n".join(cell.source for cell in cells("markdown"))
    named = re.findall(r"^### (\d+\.\d+) `(\w+)`$", text, re.MULTILINE)
    assert named == [(task.id, name) for task in DAY.tasks for name in task.functions]


@pytest.mark.parametrize("text", ["cells = 1", "[[cells]]\nafter = 1", "x = ", ""])
def test_a_notebook_toml_that_is_not_right_is_named(generator, tmp_path, text):
    moved = dataclasses.replace(DAY, folder=tmp_path)
    moved.own.mkdir()
    (moved.own / "notebook.toml").write_text(text, "utf-8")
    with pytest.raises(Robo47Error, match=r"notebook\.toml: .*expected \[\[cells\]\]"):
        notebook.extras(moved)


def test_every_function_and_step_of_the_script_is_there(generator):
    source = DAY.source.read_text("utf-8")
    code = "\n".join(cell.source for cell in cells("code"))
    text = "\n".join(cell.source for cell in cells("markdown"))
    functions = [line for line in source.splitlines() if line.startswith("def ")]
    assert all(line in code for line in functions if "def main" not in line)
    assert source.count("lab.check(") == code.count("lab.check(") > 0
    assert source.count("lab.record(") == code.count("lab.record(") > 0
    for step in range(1, source.count("lab.step(") + 1):
        assert f"### {step}. " in text


@pytest.mark.parametrize("day", all_days(), ids=lambda day: f"day {day.number}")
def test_every_cell_of_every_day_is_python_by_itself(day):
    found = nbformat.reads(notebook.build(day), as_version=4)
    for cell in found.cells:
        if cell.cell_type == "code":  # a `return` of main() has no function there
            compile(cell.source, f"day {day.number}, {cell.id}", "exec")


def test_it_holds_no_markers_no_outputs_and_no_unfilled_heading():
    raw = made()
    assert "region" not in raw
    assert all(cell.outputs == [] for cell in cells("code"))
    assert all(cell.execution_count is None for cell in cells("code"))
    assert "{CONFIGURATIONS" not in "".join(cell.source for cell in cells("markdown"))
    assert len(raw) < 40_000
    nbformat.validate(json.loads(raw))


@pytest.mark.gl
@pytest.mark.usefixtures("gl")
def test_it_runs_from_top_to_bottom(tmp_path):
    notebook = nbformat.reads(made(), as_version=4)
    setup = next(cell for cell in notebook.cells if LOGGING in cell.source)
    setup.source = setup.source.replace(LOGGING, LOGGING[:-1] + ', "--no-log"]')
    for cell in notebook.cells:
        cell.metadata.pop("tags", None)  # here a picture that fails is a failure
    run = {"metadata": {"path": str(tmp_path)}}  # wherever Jupyter was started
    nbclient.NotebookClient(notebook, timeout=120, resources=run).execute()
    printed = "".join(out.text for out in outputs(notebook, "stream"))
    assert "All checks PASSED." in printed
    assert "FAIL" not in printed
    shown = [out.data for out in outputs(notebook, "execute_result")]
    assert sum("image/png" in data for data in shown) == 2
    assert not any(data.get("text/plain") == "0" for data in shown)
    widget = "application/vnd.jupyter.widget-view+json"
    assert sum(widget in data for data in shown) == 1


def test_without_the_kit_the_set_up_asks_for_the_clones_address(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    with pytest.raises(AssertionError, match="set REPOSITORY above"):
        exec(cells("code")[0].source, {})


@pytest.mark.gl
@pytest.mark.usefixtures("gl")
def test_a_slider_moves_the_arm_and_the_matrix_of_the_function_that_is_given():
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


def test_a_starter_notebook_has_the_gaps_and_no_answer(
    generator, monkeypatch, tmp_path
):
    work = tmp_path / "work" / "day1_transforms.py"
    monkeypatch.setattr("labkit.lesson.day.Day.work", work)
    monkeypatch.setattr(sys, "argv", [*sys.argv, "--starter"])
    assert generator.main() == 0
    text = work.with_suffix(".ipynb").read_text("utf-8")
    source = DAY.source.read_text("utf-8")
    answers = re.findall(r"# region \S+\n(.*?)\n    # endregion", source, re.DOTALL)
    assert len(answers) >= 8
    assert all(json.dumps(answer)[1:-1] not in text for answer in answers)
    assert text.count("raise NotImplementedError") == len(answers)
    with pytest.raises(Robo47Error, match="stays as it is"):
        generator.main()
