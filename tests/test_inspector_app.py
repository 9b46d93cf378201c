"""The page without a browser: moves, tabs, hostile messages; all on the event loop."""

import asyncio
import time
from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest

pytest.importorskip("viser", reason="the extra view")

from viser import _messages

from labkit.inspector import serve
from labkit.inspector.animate import Jobs
from labkit.inspector.app import Inspector
from labkit.inspector.arm import Arm
from labkit.inspector.common_tabs import Chain, Joints
from labkit.inspector.ghost import Ghost, compare, nothing
from labkit.inspector.guard import LocalServer
from labkit.inspector.robot import Robot
from labkit.inspector.serve import on_loop
from labkit.inspector.shapes import Shape
from labkit.inspector.standing import Standing
from labkit.inspector.tab import DayTabs, Tab, day_tabs
from labkit.lesson.day import Day, day_numbers, find_day
from robo47 import panda
from robo47.errors import Robo47Error

pytestmark = pytest.mark.kit
SECONDS = 120  # a hang, not a slow machine: Day 21 trains its policy in the tab
GHOST = Ghost("my_fk", ("link0", "ee"), lambda model, q: [])


class Noisy(Tab):
    """A tab that makes one of everything."""

    title = "Noisy"

    def __init__(self, page):
        super().__init__(page)
        self.sliders = [page.slider("x", 0, 1, 0.5, self.set, unit="m")]
        self.press = page.buttons(["a", "b"], self.set)
        self.pick = page.choice("c", ["one", "two"], self.set)
        self.tick = page.tick("t", self.set)
        self.bars = page.bars(["j1", "j2"], [87.0, 12.0], "N m", "torque")
        self.plot = page.plot(["e1"], y="error (m)")
        self.image = page.image(np.arange(12.0).reshape(3, 4), "depth")
        page.gui.add_button("viser's own")
        draw = page.draw
        draw.arrows([[[0, 0, 0], [0, 0, 1]]])
        draw.curve(np.zeros((3, 3)))
        draw.sphere([0, 0, 0], 0.1)
        draw.ellipsoid().show(np.diag([4.0, 1.0, 0.0]), [0, 0, 0], 0.1)
        draw.frame("mine", np.eye(4))
        draw.label("here", [0, 0, 0])
        self.ghost = draw.ghost()
        draw.target(np.eye(4), self.set)
        self.heard, self.calls, self.closed = [], 0, False
        self.loop = page.animate(self.step, 100)
        self.loop.start()
        Noisy.last = self

    def set(self, value):
        self.heard.append(value)

    def step(self, t):
        self.calls += 1
        self.bars.show([100.0, -6.0])
        self.plot.add(t, [t])

    def on_move(self, q):
        self.q = q

    def close(self):
        self.closed = True


class Broken(Tab):
    title = "Broken"

    def on_move(self, q):
        raise ZeroDivisionError("one over nothing")


class File:
    """A student's file that is looked at and asked, and says nothing."""

    def __init__(self):
        self.there, self.version, self.asked = False, 1, []
        self.new = False
        self.held = False  # by an answer that does not come

    def saved(self):
        """Return whether a look would find a save; `save` is one."""
        return self.new

    def look(self):
        """Look for a save."""
        if self.new and not self.held:
            self.version, self.new = self.version + 1, False

    def see(self, q):
        self.asked.append(q)
        return nothing("nothing to see")


@pytest.fixture(scope="module")
def server():
    made = LocalServer(0)
    yield made
    made.stop()


@pytest.fixture
def show(server):
    """Show a day's tabs in a page, and leave them after the test."""
    shown = []

    def made(day):
        server.scene.reset()
        server.gui.reset()
        arm = Arm(panda.load(), panda.END_FRAME["panda_nohand"])
        given = server, arm, "a robot", day, File()
        shown.append(on_loop(server, lambda: Inspector(*given)))
        return shown[0]

    yield made
    on_loop(server, shown[0].leave)


@pytest.fixture
def page(show):
    return show(DayTabs(GHOST, [Joints, Noisy, Broken]))


BROWSER = 7  # the number of one that is connected


@pytest.fixture
def say(page):
    """Change widgets as a browser does, or go to an address; let the page settle."""
    gui, clients = page.server.gui, page.server._connected_clients
    kind = _messages.GuiUpdateMessage
    (checked,) = gui._websock_interface._incoming_handlers[kind]
    clients[BROWSER] = SimpleNamespace()

    def send(*messages):
        async def receive():
            for widget, value in messages:
                if widget == "go":
                    page.receive(value)
                else:
                    message = kind(widget._impl.uuid, {"value": value})
                    await checked(BROWSER, message)

        loop = page.server.get_event_loop()
        asyncio.run_coroutine_threadsafe(receive(), loop).result(SECONDS)
        settle(page)

    yield send
    on_loop(page.server, lambda: clients.pop(BROWSER))


def tab(title):
    """Open a tab, as a browser does."""
    return "go", f"?tab={title}"


def settle(page):
    """Wait until the page has nothing left to do, nor its tab's jobs to answer."""
    deadline = time.monotonic() + SECONDS
    while on_loop(page.server, partial(busy, page)) and time.monotonic() < deadline:
        time.sleep(0.01)
    assert not on_loop(page.server, partial(busy, page))


def busy(page):
    """Return whether an update is to come, or a tab's job is at work on its thread."""
    running = page.page.running if page.page else []
    jobs = [one for one in running if isinstance(one, Jobs)]
    return page.scheduled or any(one.task is not None for one in jobs)


def joint(page, i):
    return page.tab.sliders[i]


def contents(page):
    return "\n".join(
        child.content for child in page.widgets().values() if hasattr(child, "content")
    )


def nodes(page):
    return {
        name
        for name in page.server.scene._handle_from_node_name
        if name.startswith("/tab")
    }


def test_two_sliders_in_one_tick_both_count(page, say):
    say((joint(page, 0), 0.3), (joint(page, 4), -0.7))
    assert page.arm.q[0] == 0.3
    assert page.arm.q[4] == -0.7


READY = "0, -pi/4, 0, -2.356, 0, 1.571, 0.785"


def test_what_is_typed_is_read_and_what_cannot_be_is_said_and_not_done(page, say):
    box = page.tab.box
    say((box, READY))
    assert page.arm.q[1] == -np.pi / 4
    assert joint(page, 1).value == -np.pi / 4
    assert box.value == READY  # not written anew under somebody's hand
    for wrong in ("90", READY.replace("-pi/4", "90"), READY.replace("pi", "pie"), ""):
        say((box, wrong))
        assert page.arm.q[1] == -np.pi / 4
        assert "r47-bad" in contents(page)
    say((joint(page, 0), 0.3))
    assert box.value.startswith("0.3, -0.785398163")


def test_the_exact_configuration_can_be_copied(page, say):
    say((page.tab.box, READY))
    assert repr(-np.pi / 4) in contents(page)
    assert repr(-np.pi / 4) in page.state.content


def test_undo_takes_a_move_back_and_a_drag_is_one_move(page, say, monkeypatch):
    monkeypatch.setattr("labkit.inspector.app.DRAG", 20.0)
    start = page.arm.q.copy()
    for x in np.linspace(0, 0.5, 10):
        say((joint(page, 0), float(x)))
    say((page.tab.buttons, "undo"))
    np.testing.assert_array_equal(page.arm.q, start)


@pytest.mark.parametrize(
    "query",
    ["", "?", "nope", "?tab=nope", "?frame=x", "?q=", "?q=1,2", "?q=a,b,c,d,e,f,g",
     "?q=nan,0,0,0,0,0,0", "?q=1e300,0,0,0,0,0,0", "?q=inf,0,0,0,0,0,0", "%%%",
     "?q=" + "0," * 10_000, "?" + "q" * 1000],
)  # fmt: skip
def test_an_address_that_leads_nowhere_changes_nothing(page, say, query):
    before = page.arm.q.copy()
    say(("go", query), (page.frame, "link3"))
    assert page.frame.value == "link3"
    np.testing.assert_array_equal(page.arm.q, before)


@pytest.mark.parametrize("value", [float("nan"), float("inf"), 90.0, "x", None, [1]])
def test_a_number_that_no_slider_has_moves_nothing(page, say, value):
    before = page.arm.q.copy()
    say((joint(page, 1), value), (joint(page, 0), 0.25))
    np.testing.assert_array_equal(page.arm.q, [0.25, *before[1:]])


def test_nothing_is_made_anew_under_somebodys_hand(page, say):
    """viser draws every widget anew when there is one more, or one less."""
    say(tab("Noisy"))
    noisy, before = Noisy.last, set(page.widgets())
    say((joint(page, 0), 0.3), (joint(page, 0), "none"), tab("Noisy"))
    assert page.tab is noisy
    assert set(page.widgets()) == before


@pytest.mark.filterwarnings("error:Attempted to remove")
def test_meshes_that_arrive_late_dress_the_open_tab_and_its_ghosts(page, say):
    say(tab("Noisy"))
    noisy, before = Noisy.last, set(page.widgets())
    noisy.ghost.pose({"link1": np.eye(4)})
    white = (1.0, 1.0, 1.0, 1.0)
    triangle = Shape("link1", white, np.eye(3), np.array([[0, 1, 2]]))
    for _ in range(2):  # the fine ones may be as many as the simple ones
        on_loop(page.server, lambda: page.dress(page.arm.model, [triangle], [triangle]))
    assert page.tab is noisy
    assert set(page.widgets()) == before
    assert len(noisy.ghost.meshes) == 1
    assert noisy.ghost.bodies["link1"].visible


def test_looks_that_arrive_late_stand_where_the_scene_was_shown(page):
    model = panda.load("panda_nohand", drive="torque")
    dressed = partial(panda.load, "panda_nohand", meshes=True)
    robot = on_loop(page.server, lambda: Robot(page.page, model, dressed))
    on_loop(page.server, lambda: robot.show(panda.READY_Q))
    deadline = time.monotonic() + SECONDS
    while "link7" not in robot.skin.bodies and time.monotonic() < deadline:
        time.sleep(0.05)
    settle(page)
    hand = robot.skin.bodies["link7"]
    assert hand.visible
    np.testing.assert_allclose(hand.position, page.arm.pose("link7")[:3, 3], atol=1e-9)


def test_a_flood_of_moves_is_one_move(page, say):
    moved = []
    real = page.arm.move
    page.arm.move = lambda q: (moved.append(q), real(q))
    say(*((joint(page, 0), float(x)) for x in np.linspace(0, 1, 5_000)))
    assert page.arm.q[0] == 1.0
    assert len(moved) < 10


def test_a_tab_takes_all_that_it_made_with_it(page, say):
    before = set(page.widgets())
    say(tab("Noisy"))
    noisy, drawn = Noisy.last, nodes(page)
    assert len(drawn) > 8
    deadline = time.monotonic() + SECONDS
    while noisy.calls < 3 and time.monotonic() < deadline:
        time.sleep(0.01)
    assert noisy.calls >= 3
    say(tab("Tasks"))
    assert noisy.closed
    assert not noisy.loop.running
    assert nodes(page) == {"/tab"}
    say(tab("Noisy"))
    assert drawn & nodes(page) == {"/tab"}  # a browser keeps a name's last pose
    say(tab("Tasks"))
    calls = noisy.calls
    time.sleep(0.1)
    assert noisy.calls == calls
    say(tab("Joints"))
    assert len(page.widgets()) == len(before)


def test_a_tabs_own_controls_are_heard_and_odd_values_are_not(page, say):
    say(tab("Noisy"))
    noisy = Noisy.last
    slider = noisy.sliders[0]
    say((slider, 0.25), (noisy.press, "b"), (noisy.pick, "two"), (noisy.tick, True))
    assert noisy.heard == [0.25, "b", "two", True]
    say((slider, 7.0), (noisy.press, "c"), (noisy.pick, "three"))
    assert len(noisy.heard) == 4


def test_a_tab_that_fails_says_so_and_the_page_goes_on(page, say):
    say(tab("Broken"))
    assert "the tab Broken stopped with ZeroDivisionError: one over" in contents(page)
    say(tab("Joints"), (page.frame, "link2"))
    say((joint(page, 0), 0.2))
    assert page.arm.q[0] == 0.2


def test_the_chain_shows_one_factor_per_link_and_one_per_joint(page, say, monkeypatch):
    def late(self, fns, at):
        time.sleep(0.1)  # a job's answer may come after the page's update
        return self.page.arm.steps()

    monkeypatch.setattr(Chain, "ask", late)
    say(tab("Chain"))
    assert len(page.arm.steps()) == 16
    say((page.tab.widgets["does"], "next"))
    assert "factor 4 of 16, T_link1_link2" in contents(page)
    assert "T_world_ee, MuJoCo" not in contents(page)  # the tab needs the room
    say(tab("Joints"))
    shown = [triad.state[0] for triad in page.scene.triads.values()]
    assert all(shown)


def hear(page, poses, problem=""):
    """Have the page hear what a student's function said where the arm is."""
    q = page.arm.q.copy()
    seen = compare(GHOST, poses, problem, page.arm.poses_at(q))
    on_loop(page.server, lambda: page.hear(page.student.version, seen))


def test_the_students_poses_are_judged_in_their_name(page):
    right = {"link0": page.arm.pose("link0"), "ee": page.arm.pose("ee")}
    hear(page, right)
    assert "✓ YOUR my_fk agrees" in contents(page)
    wrong = right["ee"].copy()
    wrong[2, 3] -= 0.7
    hear(page, {**right, "ee": wrong})
    assert "✗ YOUR my_fk is off by 700 mm at ee" in contents(page)
    assert 'class="p off"' in contents(page)
    hear(page, {})
    settle(page)
    assert "✗ YOUR my_fk gave no pose" in contents(page)
    assert "robo47.kinematics" not in contents(page)  # in the place of theirs
    assert "yours: no answer" in contents(page)
    assert "r47-good" not in contents(page)


@pytest.fixture
def watched(page):
    """Have the page watch its file, with a checker; stop after the test."""
    watching = []

    def watch(check=None):
        page.student.there = check is not None
        loop = page.server.get_event_loop()
        watching.append(asyncio.run_coroutine_threadsafe(page.watch(check), loop))
        until(lambda: page.seen.kind != "asking")
        settle(page)
        return page.student

    yield watch
    watching[0].cancel()
    on_loop(page.server, page.close)


def until(true):
    deadline = time.monotonic() + SECONDS
    while not true() and time.monotonic() < deadline:
        time.sleep(0.01)
    assert true()


def test_a_page_without_a_file_asks_once_and_rests(page, watched):
    file = watched()
    time.sleep(0.2)
    assert len(file.asked) == 1
    on_loop(page.server, lambda: page.move(page.arm.q + 0.1))
    until(lambda: len(file.asked) == 2)
    assert file.asked[1][0] == page.arm.q[0]


def test_a_save_is_asked_and_checked(page, watched):
    file = watched(lambda: Standing(f"version {page.student.version}"))
    until(lambda: "version 1" in contents(page))
    file.new = True
    until(lambda: "version 2" in contents(page))
    assert len(file.asked) == 2


def test_at_a_save_nothing_green_or_red_stays_until_it_is_known_again(page, watched):
    green = Standing("all pass", "good")
    file = watched(lambda: green)
    hear(page, {name: page.arm.pose(name) for name in GHOST.frames})
    until(lambda: "all pass" in contents(page))
    assert "YOUR my_fk agrees" in contents(page)
    file.held = file.new = True  # the old file's answer does not come
    until(lambda: "asking" in contents(page))
    settle(page)
    shown = contents(page)
    assert "asking YOUR my_fk ..." in shown
    assert "asking your functions ..." in shown
    for old in ("all pass", "my_fk agrees", "r47-good", "r47-bad", "robo47.kinematics"):
        assert old not in shown
    late = nothing("what the old file said")
    on_loop(page.server, lambda: page.hear(file.version, late))
    on_loop(page.server, lambda: page.judge(file.version, green))
    settle(page)
    assert contents(page) == shown
    file.held = False
    until(lambda: "all pass" in contents(page))
    assert "nothing to see" in contents(page)


def test_a_checker_that_breaks_is_said(monkeypatch):
    def broken(*_, **__):
        raise ValueError("no questions")

    monkeypatch.setattr(serve, "check_tasks", broken)
    found = serve.Checks(find_day(1)).ask()
    assert (found.sentence, found.kind) == ("no questions", "bad")


@pytest.mark.parametrize("way", [[0, 0, 0], [np.nan] * 3, [np.inf, 0, 0], [1e308] * 3])
@pytest.mark.parametrize("start", [[0, 0, 1], [1e308] * 3, [np.nan] * 3])
def test_a_click_that_no_browser_makes_meets_nothing(page, start, way):
    page.pointed.watch(page.arm.model)
    assert page.pointed.find(start, way) == 0
    assert page.pointed.find([2.0, 0.0, 0.3], [-1.0, 0.0, 0.0]) >= 0


def test_a_text_that_is_far_too_long_is_answered_at_once(page, say):
    before = page.arm.q.copy()
    started = time.monotonic()
    say((page.tab.box, "9, " * 1_000_000), (page.tab.box, "(" * 1_000_000))
    assert time.monotonic() - started < SECONDS
    np.testing.assert_array_equal(page.arm.q, before)


def test_a_target_is_dragged_to_no_other_planet(page, say):
    say(tab("Noisy"))
    handle = next(
        node
        for name, node in page.server.scene._handle_from_node_name.items()
        if type(node).__name__ == "TransformControlsHandle"
    )
    (moved,) = page.server.scene._websock_interface._incoming_handlers[
        _messages.TransformControlsUpdateMessage
    ]

    def drag(position):
        name, upright = handle._impl.name, (1.0, 0.0, 0.0, 0.0)
        message = _messages.TransformControlsUpdateMessage(name, upright, position)
        loop = page.server.get_event_loop()
        asyncio.run_coroutine_threadsafe(moved(BROWSER, message), loop).result(SECONDS)
        settle(page)

    for far in ((1e300, 0.0, 0.0), (float("nan"), 0.0, 0.0), (0.0, -50.0, 0.0)):
        drag(far)
    assert Noisy.last.heard == []
    drag((0.3, 0.2, 0.1))
    assert Noisy.last.heard[0][0, 3] == 0.3


def test_a_tab_that_was_closed_hears_of_no_move(page, say):
    say(tab("Noisy"))
    heard = Noisy.last.q

    def move_and_close():
        page.move(panda.READY_Q + 0.1)
        page.close()

    on_loop(page.server, move_and_close)
    settle(page)
    assert page.arm.q[0] == 0.1  # the arm itself has moved
    np.testing.assert_array_equal(Noisy.last.q, heard)


@pytest.mark.parametrize("number", day_numbers())
def test_a_day_opens_in_a_tab_of_its_own_and_a_begin_plays_it(show, number):
    day = day_tabs(find_day(number))
    page = show(day)
    assert page.kind is day.tabs[0]
    begun = []
    page.tab.begin = lambda: begun.append(page.kind.title)
    on_loop(page.server, lambda: page.hear(page.student.version, nothing("")))
    assert not begun  # a move is no save
    page.unchecked = True
    page.check = lambda: Standing("")
    on_loop(page.server, lambda: page.hear(page.student.version, nothing("")))
    assert begun == [page.kind.title]


@pytest.mark.parametrize("number", day_numbers())
def test_every_tab_of_every_day_opens_moves_and_closes(show, number):
    page = show(day_tabs(find_day(number)))
    page.simple = True
    for title in page.kinds:
        on_loop(page.server, lambda title=title: page.open_tab(title))
        on_loop(page.server, lambda: page.move(page.arm.q + 0.01))
        settle(page)
        assert page.kind.title == title
        assert "stopped with" not in contents(page)


@pytest.mark.parametrize(
    ("brings", "says"),
    [
        ({"TABS": Noisy}, "inspector.py: TABS is no list"),
        ({"TABS": [Noisy, int]}, "<class 'int'> in TABS is not a class of"),
        ({"GHOST": "fk"}, "inspector.py: GHOST is not a labkit.inspector.ghost.Ghost"),
    ],
)
def test_what_a_day_brings_and_is_no_tab_is_refused(monkeypatch, brings, says):
    monkeypatch.setattr(Day, "module", lambda *_: SimpleNamespace(**brings))
    with pytest.raises(Robo47Error, match=says):
        day_tabs(find_day(1))


def test_what_is_no_pose_is_drawn_as_the_nearest_one():
    from labkit.inspector.meshes import place

    node = SimpleNamespace()
    place(node, -np.eye(4))  # a mirror image, as a sign makes one
    assert np.linalg.norm(node.wxyz) == pytest.approx(1.0)
    np.testing.assert_array_equal(node.position, np.zeros(3))


def test_an_image_of_depths_goes_from_black_to_white():
    from labkit.inspector.instruments import as_bytes

    shown = as_bytes(np.array([[1.0, 2.0], [np.nan, 4.0]]))
    assert shown.shape == (2, 2, 3)
    assert shown[..., 0].tolist() == [[64, 128], [0, 255]]


def test_a_logarithmic_axis_has_one_tick_a_decade_and_reaches_over_the_curves():
    from labkit.inspector.instruments import Plot

    gui = SimpleNamespace(add_uplot=lambda *_, **all_: SimpleNamespace(**all_))
    plot = Plot(gui, ("error",), "t (s)", "error (mrad)", 150, 1e-3)
    assert plot.handle.axes[1]["splits"] == pytest.approx((1e-3, 1e-2))
    plot.add(0.0, [0.0])
    plot.add(1.0, [np.nan])
    plot.add(2.0, [2_200.0])
    low, high = plot.handle.scales["y"]["range"]
    assert (low, high) == (1e-3, 1e4)
    ticks = plot.handle.axes[1]
    np.testing.assert_allclose(np.diff(np.log10(ticks["splits"])), 1.0)
    assert ticks["values"] == (
        "0.001",
        "0.01",
        "0.1",
        "1",
        "10",
        "100",
        "1,000",
        "10,000",
    )
    plot.show([0.0, 1.0], [[1.0, 1e12]])  # not every decade has a label any more
    assert len([label for label in plot.handle.axes[1]["values"] if label]) <= 9
    plain = Plot(gui, ("error",), "t (s)", "", 150, 0.0)
    for one in (plot, plain):  # the axis has its name, the legend no empty values
        assert one.handle.axes[0]["label"] == "t (s)"
        assert one.handle.legend == {"live": False}
    assert "y" not in plain.handle.scales
