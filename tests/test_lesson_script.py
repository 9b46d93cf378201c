"""The lab script: what the starter keeps and takes out; slips that a file shows."""

import ast
import re

import pytest

from labkit.lesson.day import find_day
from labkit.lesson.slips import renamed, unfinished
from labkit.lesson.starter import find_regions, function_lines, make_starter, put_back
from labkit.lesson.starter import solution as solution_of
from robo47.errors import Robo47Error
from robo47.paths import ROOT

DOC = '    """Return it."""\n'
GAP = '    raise NotImplementedError("task 1.2: write f")\n'

DAY = find_day(1)
SOURCE = DAY.source.read_text("utf-8")
STARTER = make_starter(SOURCE, "src", 1)


def test_a_starter_says_what_runs_it():
    head = '"""Day 1.\n\n    make day1     runs this\n    python src/x.py   then\n"""\n'
    lines = make_starter(head + SOURCE, "src", 1).splitlines()
    assert lines[1].startswith("#     make check DAY=1 ")
    assert re.fullmatch(r" +make run DAY=1 +runs this file .*", lines[4])
    assert re.fullmatch(r" +make day1 +runs the kit's .*", lines[5])


def functions(text):
    return {
        node.name: node
        for node in ast.parse(text).body
        if isinstance(node, ast.FunctionDef)
    }


def script(*lines):
    return "\n".join(["def f():", *lines, "", "def g():", "    return 1"]) + "\n"


def test_no_line_of_a_solution_survives_in_the_starter():
    kept = {line.strip() for line in STARTER.splitlines()}
    lines = SOURCE.splitlines()
    for region in find_regions(SOURCE, "src"):
        body = [line.strip() for line in lines[region.start + 1 : region.end]]
        assert body
        assert not kept & set(body)


def test_signatures_and_docstrings_are_the_same_in_both():
    ours, theirs = functions(SOURCE), functions(STARTER)
    assert list(ours) == list(theirs)
    for name, node in ours.items():
        assert ast.unparse(node.args) == ast.unparse(theirs[name].args)
        assert ast.get_docstring(node) == ast.get_docstring(theirs[name])


def test_every_task_has_its_gaps_and_every_gap_raises_an_error_that_names_it():
    regions = {(r.task, r.function) for r in find_regions(SOURCE, "src")}
    assert regions == {(t.id, f) for t in DAY.tasks for f in t.functions}
    for task in DAY.tasks:
        for name in task.functions:
            *_, last = functions(STARTER)[name].body
            assert isinstance(last, ast.Raise)
            text = f"NotImplementedError('task {task.id}: write {name}')"
            assert ast.unparse(last.exc) == text


def test_everything_outside_the_regions_is_kept():
    assert STARTER.endswith(SOURCE[SOURCE.index("def main()") :])
    assert "region" not in STARTER


def test_a_task_may_own_several_regions():
    text = solution_of(SOURCE, "src", "1.5")
    assert "def link_T" in text
    assert "def joint_T" in text
    assert "region" not in text


@pytest.mark.parametrize(
    ("lines", "says"),
    [
        (["    # region 1.1", "    # region 1.2"], "line 3: region 1.2 opens inside"),
        (["    # region 1.1", "    x = 1"], "region 1.1 is still open"),
        (["    # endregion 1.1"], "line 2: endregion 1.1, but no region is open"),
        (
            ["    # region 1.1", "    # endregion 1.2"],
            "endregion 1.2 closes region 1.1",
        ),
        (["    # region"], "line 2: a region marker without the id"),
        (["# region 1.1", "# endregion 1.1"], "region 1.1 is not inside a function"),
    ],
)
def test_a_broken_marker_is_refused_with_its_line(lines, says):
    with pytest.raises(Robo47Error, match=says):
        make_starter(script(*lines), "lab.py", 1)


def test_a_region_that_the_file_ends_in_is_refused():
    with pytest.raises(Robo47Error, match=r"lab\.py, line 2: region 1\.1 is never"):
        make_starter("def f():\n    # region 1.1\n    x = 1\n", "lab.py", 1)


def test_a_function_is_found_even_in_a_file_that_does_not_parse():
    text = "def f(\n    a,\n) -> int:\n    return (a\n\n\ndef g():\n    return 2\n"
    assert function_lines(text, "f")[:2] == (0, 4)
    assert function_lines(text, "g")[2] == ["def g():", "    return 2"]
    assert function_lines(text, "h") == (-1, -1, [])


def test_putting_a_task_back_leaves_the_others_alone():
    gap = 'raise NotImplementedError("task {}")'
    mine = STARTER.replace(gap.format("1.2: write Rz"), "return 2")
    mine = mine.replace(gap.format("1.1: write make_T"), "return 1")
    again = put_back(mine, STARTER, ("make_T",))
    assert "return 1\n" not in again
    assert put_back(again, STARTER, ("Rz",)) == STARTER


def test_a_function_that_was_deleted_comes_back_above_main():
    start, end, _ = function_lines(STARTER, "inverse")
    lines = STARTER.splitlines()
    again = put_back("\n".join(lines[:start] + lines[end:]), STARTER, ("inverse",))
    assert again.index("def inverse") < again.index("def main")
    ast.parse(again)


def test_every_lab_script_of_the_kit_gives_a_starter():
    for source in ROOT.glob("w*/src/day*.py"):
        ast.parse(make_starter(source.read_text("utf-8"), source.name, 1))


@pytest.mark.parametrize(
    ("body", "says"),
    [
        (GAP + "    return 1\n", "Line 3, "),
        ("    y = 1\n" + GAP + "    return y\n", "Line 4, "),
        ("    pass\n", "is `pass`"),
    ],
)
def test_what_keeps_a_function_from_doing_anything_is_said(body, says):
    assert says in unfinished(f"def f():\n{DOC}{body}", "f")


@pytest.mark.parametrize("body", [GAP, "    return 1\n", "    print(1)\n"])
def test_a_plain_gap_or_code_without_a_slip_is_no_slip(body):
    assert unfinished(f"def f():\n{DOC}{body}", "f") == ""


def test_a_function_that_is_gone_or_does_not_parse_is_no_slip():
    assert unfinished("x = 1\n", "f") == ""
    assert unfinished("def f(:\n    pass\n", "f") == ""


def test_a_renamed_function_is_found_again():
    source = "x = 1\ndef rz(t):\n    return t\ndef exp_rotation(w):\n    return w\n"
    assert "but rz (line 2): did you mean Rz?" in renamed(source, "Rz")
    assert renamed(source, "log_rotation") == ""
