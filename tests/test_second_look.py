"""Second looks: whose fault it is, when it is right, what a lab finds, borrowing."""

from dataclasses import replace
from types import SimpleNamespace

import inprocess
import mujoco
import numpy as np
import pytest

from labkit.check import lab_run
from labkit.check.lab_run import Budget, TimeUsedUp, behind_wall, rehearse
from labkit.check.tasks import check_tasks
from labkit.judge import Robot
from labkit.lesson import borrowed
from labkit.lesson.added_code import old_names
from labkit.lesson.borrowed import BORROWED, borrowed_tasks, with_borrowed
from labkit.lesson.day import all_days, find_day
from labkit.lesson.lab_module import load_lab, read_script
from labkit.lesson.starter import make_starter
from labkit.sandbox.sandbox import Sandbox
from robo47 import screws

pytestmark = pytest.mark.kit

DAY = find_day(1)
AS_SOON = "This task will be correct as soon as task 1.4 is correct."
REFERENCE = DAY.source.read_text("utf-8")
XYZW = REFERENCE.replace("w, x, y, z = quat", "x, y, z, w = quat", 1)
LINK = (
    '<body name="b{0}" pos="{0} 0.1 0.2"><joint name="j{0}" axis="0 0 1"/>'
    '<geom size="0.1"/>'
)
IN_WORLD = "<mujoco><worldbody>{}</worldbody></mujoco>"


@pytest.fixture
def check(tmp_path):
    def run(code, day=DAY, task=None):
        script = tmp_path / day.script
        script.write_text(code, "utf-8")
        return inprocess.verdicts(day, script, task)

    return run


def test_what_only_inherits_a_fault_is_right_as_soon_as_that_is_mended(check):
    assert XYZW != REFERENCE
    verdicts = check(XYZW)
    assert verdicts["1.4"].mistake == "wxyz-read-as-xyzw"
    for task in ("1.5", "1.6", "1.8"):
        assert (verdicts[task].status, verdicts[task].mistake) == ("todo", "inherited")
        assert verdicts[task].message == AS_SOON


def test_a_fault_of_ones_own_shows_beside_an_inherited_one(check):
    own = XYZW.replace("return T_world_body", "return T_world_body[::-1, :]", 1)
    assert own != XYZW
    verdict = check(own, task="1.6")["1.6"]
    assert verdict.status == "wrong"
    assert "right as soon" not in verdict.message
    assert verdict.follows == ""


def test_a_task_that_waits_says_so_also_when_it_is_asked_alone(check):
    start = "    w, x, y, z = quat"
    gap = '    raise NotImplementedError("task 1.4: write quat_to_R")\n'
    assert start in REFERENCE
    verdict = check(REFERENCE.replace(start, gap + start, 1), task="1.6")["1.6"]
    assert (verdict.status, verdict.message) == (
        "todo",
        "This task will be correct as soon as task 1.4 is correct.",
    )


def says_of_damping_outside(check, term):
    """Return what is said of Day 5's law with its damping term behind M."""
    day = find_day(5)
    text = day.source.read_text("utf-8")
    both, result = "qdd_ref + pd_torque(e, ed, kp, kd)", "return M @ acc + bias"
    outside = text.replace(both, "qdd_ref + kp * e")
    outside = outside.replace(result, f"return M @ acc + {term} + bias")
    assert outside.count(term) == text.count(term) + 1
    return check(outside, day, "5.6")["5.6"].message


def test_a_wrong_term_is_told_by_when_it_is_right(check):
    says = says_of_damping_outside(check, "2 * kd * ed")  # no one change mends it
    assert "The result is correct whenever " in says
    assert "`ed` is 0" in says or "`kd` is 0" in says


def test_the_line_that_one_change_makes_right_is_told_by_the_sandbox(check):
    says = says_of_damping_outside(check, "kd * ed")
    assert "`return M @ acc + kd * ed + bias + damping * qd`, makes all" in says


def test_an_error_on_some_inputs_hides_no_wrong_answer(check):
    code = REFERENCE.replace(
        "R, t = T[:3, :3], T[:3, 3]",
        "R, t = T[:3, :3], -T[:3, 3]\n    if t[0] == -1: raise ValueError(t)",
        1,
    )
    assert code != REFERENCE
    message = check(code, task="1.3")["1.3"].message
    assert message.startswith("Your function stops with an error in 1 of 6 calls.")
    assert ": `ValueError: [-1. -0. -0.]`. The result is also wrong in " in message
    assert "wrong sign" in message


@pytest.fixture(scope="module")
def sandbox():
    with Sandbox() as sandbox:
        yield sandbox


class TestTheLabWithAFilesFunctions:
    def test_passes_with_the_kits_own(self, sandbox):
        assert rehearse(DAY, DAY.source, sandbox)[0] == ""

    def test_names_the_step_and_the_number(self, sandbox, tmp_path):
        day = find_day(3)
        text = day.source.read_text("utf-8")
        line = "    # endregion 3.6"
        head, tail = text.split(line, 1)
        start = head.rindex("    # region 3.6")
        body = head[start:].replace("return best", "return best + 1e-3")
        assert body != head[start:]
        script = tmp_path / day.script
        script.write_text(head[:start] + body + line + tail, "utf-8")
        says, *_ = rehearse(day, script, sandbox)
        assert says.startswith('at "')
        assert "it must be" in says

    def test_says_that_a_function_stops(self, sandbox, tmp_path):
        code = REFERENCE.replace("    c, s =", "    1 / 0\n    c, s =", 1)
        script = tmp_path / DAY.script
        script.write_text(code, "utf-8")
        says, *_ = rehearse(DAY, script, sandbox)
        assert says.startswith("compose_fk stops with an error. The error occurs in")
        assert says.endswith(": `ZeroDivisionError: division by zero`")

    def test_hands_over_the_robot_that_it_has_and_not_the_panda(
        self, sandbox, tmp_path, monkeypatch
    ):
        scene = tmp_path / "arm.xml"
        links = map(LINK.format, range(7))
        scene.write_text(IN_WORLD.format("".join(links) + "</body>" * 7), "utf-8")
        arm = Robot(scene)
        data = mujoco.MjData(arm.model)
        data.qpos[:] = np.linspace(-1.0, 1.0, 7)
        mujoco.mj_kinematics(arm.model, data)  # fills xpos
        row = SimpleNamespace(ask=SimpleNamespace(main=[(arm,)]))
        lab = load_lab(DAY.source)
        path = [(f"b{i}", arm.model.joint(i).name) for i in range(7)]

        def end():
            own = behind_wall(DAY, DAY.source, sandbox, lab, Budget(60.0))
            return own["compose_fk"](arm.model, data.qpos.copy(), path)[:3, 3]

        with pytest.raises(TimeUsedUp):  # it has the Panda's seven joints
            end()
        monkeypatch.setattr(lab_run, "rows_of", lambda day: {"compose_fk": row})
        np.testing.assert_allclose(end(), data.xpos[-1], atol=1e-12)


class TestBorrowing:
    def test_is_marked_counts_as_not_passed_and_lets_one_go_on(self, check):
        code = with_borrowed(XYZW, REFERENCE, ["quat_to_R"])
        assert BORROWED in code
        verdicts = check(code)
        assert verdicts["1.4"].mistake == "borrowed"
        assert "make start RESET=1.4" in verdicts["1.4"].message
        assert verdicts["1.6"].status == "passed"

    def test_ends_with_the_function_written_again(self):
        code = with_borrowed(REFERENCE, REFERENCE, ["quat_to_R"])
        assert [task.id for task in borrowed_tasks(DAY, code)] == ["1.4"]
        assert borrowed_tasks(DAY, REFERENCE) == []

    def test_looks_the_kits_function_up_once_in_all_of_a_run(self, monkeypatch):
        looked = []
        monkeypatch.setattr(borrowed, "day_of", lambda file: looked.append(file) or DAY)
        for _ in range(3):
            assert borrowed.kits("a student's", "make_T")(np.eye(3), np.ones(3))[0, 3]
        assert len(looked) == 1

    def test_calls_the_kits_function_when_the_lab_runs(self, run_in, clone):
        day = find_day(1, clone)
        assert run_in("scripts/start_day.py", 1).returncode == 0
        before = day.work.read_text("utf-8")
        done = run_in("scripts/borrow.py", "1.4")
        assert done.returncode == 0, done.stderr
        assert "task 1.4 borrows quat_to_R" in done.stdout
        (kept,) = day.work.parent.glob("*.before-1.4-*.txt")
        assert kept.read_text("utf-8") == before
        lab = {"__file__": str(day.work), "__name__": "day"}
        text = day.work.read_text("utf-8").replace("\nimport kit ", "\n# ")
        exec(compile(text, str(day.work), "exec"), lab)
        turned = lab["quat_to_R"](np.array([1.0, 1.0, 0.0, 0.0]))
        right = screws.exp_rotation(np.array([1.0, 0.0, 0.0]), np.pi / 2)
        np.testing.assert_allclose(turned, right, atol=1e-15)

    def test_of_a_task_that_is_not_there_is_refused_in_one_line(self, run_in, clone):
        run_in("scripts/start_day.py", 1)
        done = run_in("scripts/borrow.py", "1.99")
        assert done.returncode == 2
        assert "no task 1.99" in done.stderr
        assert "Traceback" not in done.stderr


@pytest.mark.parametrize("number", [3, 4])
def test_a_lab_is_rehearsed_with_predictions_and_without_its_side_quests(
    tmp_path, number
):
    day = find_day(number)
    script = tmp_path / day.script
    gap = "def {}(*_):\n    raise NotImplementedError('task {}')\n"
    optional = [task for task in day.tasks if task.optional]
    gaps = [gap.format(name, task.id) for task in optional for name in task.functions]
    text = day.source.read_text("utf-8").partition("def main(")[0]
    script.write_text("\n\n".join([text, *gaps]), "utf-8")
    with Sandbox() as sandbox:
        assert rehearse(day, script, sandbox)[0] == ""


@pytest.mark.parametrize("day", all_days(), ids=lambda day: f"day{day.number}")
def test_a_starter_loads_behind_the_wall(sandbox, tmp_path, day):
    """There the kit's library of later days and MuJoCo are no more than names."""
    script = tmp_path / day.script
    text = make_starter(day.source.read_text("utf-8"), day.script, day.number)
    script.write_text(text, "utf-8")
    first = check_tasks(day, script, sandbox, day.tasks[0].id)
    assert [result.verdict.status for result in first] == ["todo"]


def test_a_function_is_judged_under_the_name_that_it_had():
    day = find_day(1)
    tasks = [
        replace(t, functions=("undone",), was=("inverse",)) if t.id == "1.3" else t
        for t in day.tasks
    ]
    newer = replace(day, tasks=tuple(tasks))
    text = read_script(day.source)
    assert old_names(newer, text).strip() == "undone = inverse"
    assert old_names(newer, text.replace("def inverse(", "def undone(")) == ""
    assert old_names(day, text) == ""
