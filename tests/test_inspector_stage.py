"""What a declared tab shows when, and how the stage shows it; without a browser."""

from types import SimpleNamespace

import numpy as np
import pytest

pytest.importorskip("viser", reason="the extra view")

from tabs_on_paper import Paper

from conftest import paper
from labkit.inspector import declared as ui
from labkit.inspector.canvas import Canvas
from labkit.inspector.draw import Sketch
from labkit.inspector.scene import FOV, narrow
from labkit.inspector.shapes import LARGER, Shape, larger
from robo47 import panda

pytestmark = pytest.mark.kit

BOX = Shape(  # its corners split, as those of a mesh with sharp edges
    "link1", (1.0, 1.0, 1.0, 1.0),
    np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0.0]]), np.array([[0, 1, 2]], np.int32),
)  # fmt: skip


class Double(ui.Declared):
    """Twice a number."""

    title = "Double"
    library = {"double": lambda x: 2.0 * x}  # noqa: RUF012
    functions = {"double": "m"}  # noqa: RUF012
    x = ui.slider("x", 0, 5, 1.0, "m")
    text = ui.panel.html()
    ball = ui.yours.sphere(np.zeros(3), 0.1, "blue", legend="yours")

    def ask(self, fns, at):
        return fns.double(at.x)

    def show(self, yours, right):
        self.text.content = f"{yours}, {right}"

    def says(self, yours, right):
        yield f"{yours}", "double"


def opened(double=None):
    """Return the tab of a student with this function; None wrote nothing."""
    functions = {} if double is None else {"double": double}
    tab = Double(paper(panda.load("panda_nohand"), panda.READY_Q, functions))
    tab.on_move(panda.READY_Q)
    return tab


def test_a_line_is_green_only_if_the_function_is_the_students_and_right():
    for double, kind in ((lambda x: 2.0 * x, "good"), (lambda x: 3.0 * x, "bad")):
        assert f"r47-{kind}" in opened(double).verdict.content
    assert "r47-" not in opened().verdict.content  # the library's is no achievement


def test_a_slider_asks_anew_and_an_answer_to_its_old_place_is_not_shown():
    tab = opened(lambda x: 3.0 * x)
    assert tab.text.content == "3.0, 2.0"
    late = tab.both(tab.at())
    tab.sets("x")(2.0)
    assert tab.text.content == "6.0, 4.0"
    tab.answered(late)
    assert tab.text.content == "6.0, 4.0"


def test_without_an_answer_nothing_of_the_students_stays():
    tab = opened(lambda x: 3.0 * x)
    tab.lost()
    assert tab.verdict.content == tab.text.content == ""
    assert not tab.ball.visible
    tab.on_move(panda.READY_Q)
    assert tab.ball.visible


def test_a_ghost_is_larger_than_the_arm_and_a_second_one_than_the_first():
    np.testing.assert_allclose(
        larger(BOX, 0.1).vertices - BOX.vertices, [[0, 0, 0.1]] * 3
    )
    log = []
    sketch = Sketch(SimpleNamespace(scene=Paper(log, "scene")), [BOX])
    sketch.ghost("blue")
    sketch.ghost("red")
    made = [given[0][1] for name, given in log if name == "scene.add_mesh_simple"]
    heights = [float(vertices[0, 2]) for vertices in made]
    np.testing.assert_allclose(heights, [LARGER, 2 * LARGER], rtol=1e-6)


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
