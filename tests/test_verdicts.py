"""What the checker sees beyond the numbers, and how tasks stand to each other."""

import pytest

from labkit.base.exchange import Reply
from labkit.check.tasks import _changed_arguments
from labkit.judge.mistake import Verdict
from labkit.lesson.day import find_day
from labkit.sandbox import sandbox

pytestmark = pytest.mark.kit

REFERENCE = find_day(1).source.read_text("utf-8")


def test_a_general_inverse_gives_the_right_numbers_but_not_the_task(check):
    code = REFERENCE.replace(
        "    R, t = T[:3, :3]", "    return np.linalg.inv(T)\n    R, t = T[:3, :3]", 1
    )
    verdict = check(code, "1.3")["1.3"]
    assert (verdict.status, verdict.mistake) == ("close", "general-inverse")
    assert "does not need a general method" in verdict.message


def test_a_task_that_calls_an_unwritten_one_waits_for_it(check):
    gap = 'raise NotImplementedError("task 1.4: write quat_to_R")'
    start = "    w, x, y, z = quat"
    code = REFERENCE.replace(start, f"    {gap}\n{start}", 1)
    verdicts = check(code)
    assert verdicts["1.4"].status == verdicts["1.6"].status == "todo"
    assert verdicts["1.6"].message.endswith("as soon as task 1.4 is correct.")


def test_a_missing_function_is_told_with_the_way_to_get_it_back(check):
    verdict = check(REFERENCE.replace("def Rz(", "def spun_about_z("), "1.2")["1.2"]
    assert verdict.mistake == "missing"
    assert "make start RESET=1.2" in verdict.message


@pytest.mark.parametrize(
    ("task", "line", "mischief", "name"),
    [
        (
            "1.3",
            "    return make_T(R.T, -R.T @ t)",
            "R, t = R.copy(), t.copy(); T[:] = 0",
            "T",
        ),
        ("1.4", "    w, x, y, z = quat", "quat /= np.linalg.norm(quat)", "quat"),
    ],
)
def test_an_argument_that_is_changed_in_place_is_named(
    check, task, line, mischief, name
):
    assert line in REFERENCE
    code = REFERENCE.replace(line, f"    {mischief}\n{line}", 1)
    verdict = check(code, task)[task]
    assert (verdict.status, verdict.mistake) == ("wrong", "argument-changed")
    assert f"changes its argument `{name}`" in verdict.message
    assert f"{name} = {name}.copy()" in verdict.message


def test_a_tuple_that_is_changed_is_to_be_copied_array_by_array():
    came = [Reply(changed=("second",))]
    verdict = _changed_arguments(came, Verdict("passed"), {"second"})
    assert verdict.mistake == "argument-changed"
    assert "second = tuple(one.copy() for one in second)" in verdict.message


def test_an_argument_that_is_changed_and_returned_is_to_be_copied_first():
    came = [Reply(changed=("integral",))]
    verdict = _changed_arguments(came, Verdict("wrong", "shares-its-argument"))
    assert verdict.message == (
        "Your code changes its argument `integral` and returns it, so the array of the "
        "caller changes too. Begin with a copy: `integral = integral.copy()`."
    )


def test_a_wrong_answer_keeps_its_name_where_an_argument_is_changed_too(check):
    line = "    R, t = T[:3, :3], T[:3, 3]"
    code = REFERENCE.replace(line, f"    T[:3, 3] *= -1\n{line}", 1)
    verdict = check(code, "1.3")["1.3"]
    assert (verdict.status, verdict.mistake) != ("wrong", "argument-changed")
    assert "In addition, your code changes its argument `T`" in verdict.message


def test_a_chain_that_ignores_its_path_is_told_in_its_own_task(check):
    code = REFERENCE.replace("for name, joint in path:", "for name, joint in PATH:", 1)
    verdicts = check(code)
    assert verdicts["1.6"].mistake == "path-ignored"
    assert "ignores `path`" in verdicts["1.6"].message
    assert verdicts["1.8"].follows == "1.6"


def test_a_chain_that_takes_no_path_at_all_passes(check):
    code = REFERENCE.replace(", path: list = PATH)", ")", 1)
    code = code.replace("for name, joint in path:", "for name, joint in PATH:", 1)
    assert check(code, "1.6")["1.6"].status == "passed"


def test_a_result_that_is_printed_instead_of_returned_is_told_so(check):
    printed = REFERENCE.replace("    return T\n", "    print(T)\n", 1)
    silent = REFERENCE.replace("    return T\n", "    T.copy()\n", 1)
    assert "print the result instead" in check(printed, "1.1")["1.1"].message
    verdict = check(silent, "1.1")["1.1"]
    assert verdict.mistake == "nothing-returned"
    assert "print" not in verdict.message


def test_an_error_inside_a_helper_names_the_lines_that_called_it(check):
    code = REFERENCE.replace(
        "link_T(body.pos, body.quat)", "link_T(body.quat, body.pos)"
    )
    lines = code.splitlines()
    (inner,) = (i for i, ln in enumerate(lines, 1) if "w, x, y, z = quat" in ln)
    (middle,) = (i for i, ln in enumerate(lines, 1) if "make_T(quat_to_R" in ln)
    outer = next(i for i, ln in enumerate(lines, 1) if "link_T(body.quat" in ln)
    says = (
        f"The error occurs in line {inner}, called from line {middle}, which is called "
        f"from line {outer}: `"
    )
    assert says in check(code, "1.6")["1.6"].message


def test_a_generator_expression_is_no_caller_on_its_own_line(check):
    bad = "    sum(1 / 0 for _ in quat)\n"
    code = REFERENCE.replace("    w, x, y, z = quat", f"{bad}    w, x, y, z = quat", 1)
    (line,) = (i for i, ln in enumerate(code.splitlines(), 1) if "1 / 0" in ln)
    assert f"occurs in line {line}: `" in check(code, "1.4")["1.4"].message


def test_a_loop_without_an_end_is_told_in_one_sentence(check, monkeypatch):
    monkeypatch.setattr(sandbox, "CALL_SECONDS", 1.0)
    code = REFERENCE.replace("    c, s =", "    while True: pass\n    c, s =", 1)
    message = check(code, "1.2")["1.2"].message
    assert message.startswith("Rz did not return: it does not end")
    assert message.endswith("per call; yours was stopped after 1 s).")
