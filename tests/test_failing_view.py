"""`make view TASK=1.2`: the call of a task that fails, as a picture."""

import importlib.util
import sys

import mujoco
import numpy as np
import pytest
from inprocess import InProcess

from conftest import load_script, need
from labkit.check import tasks
from labkit.commands import native_viewer, view
from labkit.figures import client
from labkit.inspector import failing
from labkit.inspector.failing import EXPECTED, GIVEN, YOURS, drawing_of, sentence_of
from labkit.lesson.day import Day, find_task
from robo47 import panda
from robo47.errors import Robo47Error
from robo47.panda import files

pytestmark = pytest.mark.kit


def result_of(id, **instead):
    """Return the day, and the result of a task with some functions written anew."""
    day, _ = find_task(id)
    (result,) = tasks.check_tasks(day, day.source, InProcess(instead), id, 1)
    return day, result


def drawn(id, **instead):
    """Return what is drawn of a task's failing call."""
    return drawing_of(*result_of(id, **instead))


def right(id):
    """Return the functions of the day's complete lab."""
    return load_script(find_task(id)[0].source)


def by_whose(things):
    """Return {(whose, name): value}."""
    return {(one.whose, one.name): one.value for one in things}


def backwards(theta):
    return right("1.2").Rz(-theta)


def test_a_wrong_rotation_is_drawn_as_two_frames_at_the_origin():
    day, result = result_of("1.2", Rz=backwards)
    frames = by_whose(drawing_of(day, result).frames)
    (theta,) = result.verdict.example.question.args
    for whose, angle in ((EXPECTED, theta), (YOURS, -theta)):
        T = frames.pop((whose, ""))
        np.testing.assert_allclose(T[:3, :3], right("1.2").Rz(angle), atol=1e-12)
        assert not T[:3, 3].any()
    assert not frames  # an angle is no frame
    assert result.verdict.call.startswith(f"{result.task.functions[0]}(")


def test_the_arm_stands_in_the_configuration_that_was_given():
    def short(model, q, *path):
        T = right("1.6").compose_fk(model, q, *path)
        T[2, 3] -= 0.1
        return T

    day, result = result_of("1.6", compose_fk=short)
    drawing = drawing_of(day, result)
    q = result.verdict.example.question.args[1]
    np.testing.assert_array_equal(drawing.q, q)
    frames = by_whose(drawing.frames)
    off = frames[YOURS, ""] - frames[EXPECTED, ""]
    np.testing.assert_allclose(off[:3, 3], [0, 0, -0.1], atol=1e-12)
    assert not sentence_of(result, drawing)


def test_angles_are_an_arm_where_a_configuration_was_given_and_else_a_step():
    step = right("5.4").pd_equilibrium_step
    arms = drawn(
        "5.4", pd_equilibrium_step=lambda q, g, kp: 2 * q - step(q, g, kp)
    ).arms
    assert [one.whose for one in arms] == [GIVEN, EXPECTED, YOURS]
    dls = right("3.5").dls_step
    drawing = drawn("3.5", dls_step=lambda J, e, damping: -dls(J, e, damping))
    assert not drawing.arms


def test_what_the_docstring_has_in_metres_is_drawn_as_points():
    drawing = drawn("11.1", closest_points_segments=lambda a0, a1, b0, b1: (a0, b0))
    points = by_whose(drawing.points)
    given = {(GIVEN, name) for name in ("a0", "a1", "b0", "b1")}
    assert set(points) == given | {(YOURS, ""), (EXPECTED, "")}
    assert points[YOURS, ""].shape == (2, 3)
    np.testing.assert_array_equal(points[YOURS, ""][0], points[GIVEN, "a0"][0])


def test_an_answer_that_is_no_pose_or_none_leaves_the_expected_one():
    for wrong in (lambda R, t: np.zeros(3), lambda R, t: None, lambda R, t: 1 / 0):
        frames = by_whose(drawn("1.1", make_T=wrong).frames)
        assert {whose for whose, _ in frames} <= {GIVEN, EXPECTED}
        assert (GIVEN, "R") in frames


def test_one_line_where_nothing_can_be_drawn():
    day, result = result_of("1.2")
    assert "passes" in sentence_of(result, drawing_of(day, result))
    gains = right("5.2").pd_gains
    day, result = result_of("5.2", pd_gains=lambda w, z: -np.array(gains(w, z)))
    says = sentence_of(result, drawing_of(day, result))
    assert "no configuration, pose or point" in says
    assert says.endswith("make check TASK=5.2 ARGS=--explain")

    def unwritten(theta):
        raise NotImplementedError("task 1.2")

    day, result = result_of("1.2", Rz=unwritten)
    says = sentence_of(result, drawing_of(day, result))
    assert "no failing call yet" in says
    assert "Not written yet" in says
    results = tasks.check_tasks(day, day.source, InProcess({"Rz": backwards}), None, 1)
    waits = next(one for one in results if one.task.id == "1.5")
    says = sentence_of(waits, drawing_of(day, waits))
    assert says.endswith("See: make view TASK=1.2")


def test_the_tab_follows_the_checker():
    pytest.importorskip("viser", reason="the extra view")
    from tabs_on_paper import Desk

    from labkit.inspector.standing import ASKING, standing

    day, result = result_of("1.2", Rz=backwards)
    desk = Desk(1, failing.failing_tab(day, result), {})
    assert desk.tab.title == "1.2 Rz"
    drawn = [said for said in desk.log if said[0].endswith(".sphere")]
    assert len(drawn) == 2
    assert "expected" in desk.seen
    assert result.verdict.call.split("(")[0] in desk.seen
    desk.tab.judged(ASKING)
    assert "asking" in desk.seen
    _, passed = result_of("1.2")
    desk.tab.judged(standing([passed]))
    assert "passes" in desk.seen
    again = [said for said in desk.log if said[0].endswith(".sphere")]
    assert len(again) == 2  # nothing is drawn anew


def test_the_card_is_about_the_task_that_was_asked_for():
    pytest.importorskip("viser", reason="the extra view")
    from labkit.inspector.standing import standing

    wrong = [result_of("1.1", make_T=lambda R, t: np.eye(4))[1]]
    wrong += [result_of("1.2", Rz=backwards)[1]]
    assert standing(wrong).title == "1.1 make_T"
    assert standing(wrong, "1.2").title == "1.2 Rz"
    assert standing(wrong, "1.3").title == "1.1 make_T"


def test_the_native_window_has_the_same_frames_points_and_arms():
    need(files.panda_folder() is not None, "the robot: make robot")
    model = panda.load("scene", meshes=True)
    scene = mujoco.MjvScene(model, 2000)
    native_viewer.add_call(scene, model, drawn("1.2", Rz=backwards))
    kinds = [geom.type for geom in scene.geoms[: scene.ngeom]]
    assert kinds.count(int(mujoco.mjtGeom.mjGEOM_ARROW)) == 6
    labels = [geom.label for geom in scene.geoms[: scene.ngeom] if geom.label]
    assert sorted(labels) == ["expected", "yours"]
    before = scene.ngeom
    step = right("5.4").pd_equilibrium_step
    arms = drawn("5.4", pd_equilibrium_step=lambda q, g, kp: 2 * q - step(q, g, kp))
    native_viewer.add_call(scene, model, arms)
    assert scene.ngeom > before + 10


def test_the_picture_shows_the_frames_and_says_the_call(monkeypatch):
    need(importlib.util.find_spec("PIL") is not None, "Pillow: make figures")
    from labkit.figures import overlay
    from labkit.inspector.failing_picture import picture_of

    empty = np.zeros((800, 1200, 3), np.uint8)  # it has the overlay alone
    monkeypatch.setattr(client, "draw", lambda scene: empty)
    named = []
    label = overlay.Layer.label
    monkeypatch.setattr(
        overlay.Layer,
        "label",
        lambda self, name, *at: (named.append(name), label(self, name, *at)),
    )
    picture = picture_of("1.2 Rz", "Rz(1)", drawn("1.2", Rz=backwards))
    assert sorted(named) == ["expected", "yours"]
    seen = np.asarray(picture)
    for colour in (overlay.X, overlay.Y, overlay.Z):
        assert (np.abs(seen.astype(int) - colour).max(axis=2) < 8).sum() > 100


@pytest.fixture
def look(monkeypatch, tmp_path):
    """Run the command on a file of a student's; return its exit code."""

    def called(text, *arguments):
        file = tmp_path / "day1_transforms.py"
        file.write_text(text)
        monkeypatch.setattr(Day, "work", file)
        monkeypatch.setattr(sys, "argv", ["view_panda.py", *map(str, arguments)])
        return view.main()

    return called


WRONG = """import numpy as np

def Rz(theta):
    c, s = np.cos(theta), np.sin(theta)
    return np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
"""


def test_the_command_opens_the_page_at_the_call(look, monkeypatch, capsys):
    served = []
    monkeypatch.setattr(view, "web", lambda *given: served.append(given[-1]))
    look(WRONG, "--task", "1.2")
    (result,) = served
    assert result.task.id == "1.2"
    assert capsys.readouterr().out.startswith("1.2 Rz: Rz(")


def test_the_command_answers_in_a_line_where_there_is_nothing_to_see(
    look, monkeypatch, capsys
):
    monkeypatch.setattr(view, "web", None)  # never called
    right_one = WRONG.replace("c, s, 0], [-s", "c, -s, 0], [s")
    assert look(right_one, "--task", "1.2") == 0
    assert "passes" in capsys.readouterr().out
    todo = "def Rz(theta):\n    raise NotImplementedError('task 1.2')\n"
    assert look(todo, "--task", "1.2") == 0
    assert "no failing call yet" in capsys.readouterr().out


def test_a_clip_has_no_failing_call(look):
    with pytest.raises(Robo47Error, match="--task is for"):
        look(WRONG, "--task", "1.2", "--clip", "a.gif")
