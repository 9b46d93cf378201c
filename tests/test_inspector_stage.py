"""What a declared tab shows when, and how the stage shows it; without a browser."""

import math
import re
from types import SimpleNamespace
from unittest.mock import MagicMock

import numpy as np
import pytest

pytest.importorskip("viser", reason="the extra view")

from tabs_on_paper import Paper

from conftest import ROOT, paper
from labkit.inspector.arm import Arm
from labkit.inspector.canvas import Canvas
from labkit.inspector.draw import Sketch
from labkit.inspector.scene import FOV, ArmScene, narrow
from labkit.inspector.shapes import LARGER, PACKED, Shape, larger
from robo47 import panda

pytestmark = pytest.mark.kit

BOX = Shape(  # its corners split, as those of a mesh with sharp edges
    "link1", (1.0, 1.0, 1.0, 1.0),
    np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0.0]]), np.array([[0, 1, 2]], np.int32),
)  # fmt: skip


def reach(shoulder, length):
    """Return the end of two links, the second of which continues the first, m."""
    return (1.0 + length) * np.array([np.cos(shoulder), np.sin(shoulder), 0.0])


def example():
    """Return the tab that the page for authors shows."""
    page = (ROOT / "docs/authors.md").read_text("utf-8")
    code = re.search(r"```python\n(from labkit\.inspector.*?)```", page, re.DOTALL)[1]
    known = {"arms": {"reach": reach}, "ORIGIN": np.zeros(3), "apart": math.dist}
    exec(code, known)
    return known["TABS"][0]


def opened(function=None):
    """Return the example's tab for a student with this function; None wrote nothing."""
    functions = {} if function is None else {"reach": function}
    page = paper(panda.load("panda_nohand"), panda.READY_Q, functions)
    page.draw.sphere.side_effect = lambda *_, **__: MagicMock()
    tab = example()(page)
    tab.on_move(panda.READY_Q)
    return tab


def twice(*given):
    """Return a wrong end."""
    return 2 * reach(*given)


def test_a_line_is_green_only_if_the_function_is_the_students_and_right():
    assert "r47-good" in opened(reach).verdict.content
    assert "r47-bad" in opened(twice).verdict.content
    assert "r47-" not in opened().verdict.content  # the library's is no achievement


def test_a_slider_asks_anew_and_an_answer_to_its_old_place_is_not_shown():
    tab = opened(twice)
    np.testing.assert_allclose(tab.end.position, 2 * reach(0.3, 0.5))
    np.testing.assert_allclose(tab.goal.position, reach(0.3, 0.5))
    late = tab.both(tab.at())
    tab.sets("length")(1.0)
    np.testing.assert_allclose(tab.end.position, 2 * reach(0.3, 1.0))
    assert "2000.0 mm" in tab.verdict.content
    tab.answered(late)
    np.testing.assert_allclose(tab.end.position, 2 * reach(0.3, 1.0))


def test_without_an_answer_nothing_of_the_students_stays():
    tab = opened(twice)
    tab.lost()
    assert tab.verdict.content == ""
    assert (tab.end.visible, bool(tab.goal.visible)) == (False, True)
    tab.on_move(panda.READY_Q)
    assert tab.end.visible


def test_a_ghost_is_larger_than_the_arm_and_a_second_one_than_the_first():
    by = larger(BOX, 0.1).vertices - BOX.vertices
    np.testing.assert_allclose(by, [[0, 0, 0.1]] * 3, atol=1 / PACKED)
    log = []
    sketch = Sketch(SimpleNamespace(scene=Paper(log, "scene")), [BOX])
    sketch.ghost("blue")
    sketch.ghost("red")
    made = [given[0][1] for name, given in log if name == "scene.add_mesh_simple"]
    heights = [float(vertices[0, 2]) for vertices in made]
    np.testing.assert_allclose(heights, [LARGER, 2 * LARGER], atol=1 / PACKED)


def test_a_tab_without_the_arm_has_no_ghost_of_it_either():
    server = MagicMock()
    server.on_client_connect = lambda call: call
    arm = Arm(panda.load("panda_nohand"), panda.END_FRAME["panda_nohand"])
    scene = ArmScene(server, arm)
    scene.ghost.bodies["link1"] = ghost = MagicMock()
    scene.hide()
    scene.show_ghost({"link1": np.eye(4), "ee": np.eye(4)}, "ee")
    assert (ghost.visible, scene.gap.visible, scene.yours.visible) == (False,) * 3
    scene.hide(False)  # another tab has it again, without a new answer
    assert (ghost.visible, scene.gap.visible, scene.yours.visible) == (True,) * 3


def test_a_phone_sees_the_same_in_the_upper_half():
    view = ((1.75, -1.45, 0.95), (0.42, 0.24, 0.4))
    for position, middle in (view, narrow(view)):
        back = np.subtract(position, middle)
        height = 2 * np.linalg.norm(back) * np.tan(FOV / 2)
        right = np.cross([0, 0, 1], back)
        right /= np.linalg.norm(right)
        up = np.cross(back, right) / np.linalg.norm(back)
        off = np.array([0.0, 0.0, 0.45]) - middle  # the middle of the arm
        places = [float(off @ axis / height) for axis in (right, up)]
        wide, high = (-0.26, 0.0) if position == view[0] else (0.0, 0.33)
        assert places == pytest.approx([wide, high], abs=0.06)


def test_a_canvas_has_its_points_where_the_plane_has_them():
    canvas = Canvas((0, 100), (200, 0), (200, 100))  # y down, as in an image
    canvas.dots([(150, 20)], "white", 3)
    picture = canvas.picture()
    assert picture.shape == (100, 200, 3)
    rows, columns = np.nonzero(picture.min(axis=2) > 200)
    assert (rows.mean(), columns.mean()) == pytest.approx((20, 150), abs=1)
    canvas.line(
        [(np.nan, 0), (1e9, 5)], "red"
    )  # nothing that a student returns stops it
    canvas.picture()
