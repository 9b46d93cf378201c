"""The inspector as a student meets it: in a real browser, with the mouse."""

import importlib.util
import io
import shutil
import time
import urllib.parse
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from inspection import ROOT, Served

from conftest import need
from robo47 import panda, se3, verify
from robo47.checks import Array

pytestmark = [pytest.mark.browser, pytest.mark.kit]

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
FLAGS = [
    "--no-sandbox",
    "--disable-gpu",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-background-networking",
    "--no-first-run",
]
MILLISECONDS = 120_000  # software rendering on a busy machine
SHOWN = 6e-7  # a matrix is shown with 6 decimals


@pytest.fixture(scope="module")
def browser(tmp_path_factory) -> Iterator[Any]:
    for module in ("viser", "playwright"):
        found = importlib.util.find_spec(module) is not None
        need(found, f"{module}: python3 scripts/setup_env.py view browser")
    need(CHROMIUM is not None, "Chromium: apt install chromium")
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        yield chromium
        chromium.close()


@pytest.fixture(scope="module")
def served(browser) -> Iterator[Served]:
    server = Served("--port", "0", "--simple")
    yield server
    server.close()


class Page:
    """The inspector's page, read and moved as a person would."""

    def __init__(self, browser: Any, url: str) -> None:
        self.tab = browser.new_page(viewport={"width": 1280, "height": 800})
        self.tab.set_default_timeout(MILLISECONDS)
        self.asked: list[str] = []
        self.tab.on("request", lambda request: self.asked.append(request.url))
        self.tab.goto(url)
        self.wait()

    def wait(self) -> None:
        self.tab.wait_for_selector("[data-matrix=mujoco]", state="attached")

    def matrix(self, key: str) -> Array:
        text = self.tab.locator(f"[data-matrix={key}]:visible").inner_text()
        return np.array(text.split(), dtype=float).reshape(4, 4)

    def line(self, key: str) -> str:
        return self.tab.locator(f"[data-line={key}]:visible").first.inner_text()

    def said(self, key: str) -> str:
        found = self.tab.locator(f"[data-line={key}]")
        return found.first.inner_text() if found.count() else ""

    def until(self, true: Callable[[], bool]) -> None:
        """Wait for the page to say so; fail with what it says instead."""
        deadline = time.monotonic() + MILLISECONDS / 1000
        while time.monotonic() < deadline:
            if true():
                return
            self.tab.wait_for_timeout(100)
        raise AssertionError(f"still: {self.tab.inner_text('body')}")

    def press(self, name: str) -> None:
        self.tab.get_by_role("button", name=name, exact=True).click()

    def open(self, tab: str) -> None:
        self.tab.get_by_role("tab", name=tab).click()

    def choose(self, label: str, option: str) -> None:
        self.tab.get_by_label(label, exact=True).select_option(option)

    def slider(self, joint: int) -> Any:
        return self.tab.get_by_role("slider", name=f"joint{joint}", exact=True)

    def box(self, joint: int) -> Any:
        return self.tab.get_by_label(f"joint{joint} value", exact=True)

    def angle(self, joint: int) -> float:
        return float(self.slider(joint).input_value())

    def angles(self) -> Array:
        return np.array([self.angle(joint) for joint in range(1, 8)])

    def drag(self, joint: int, pixels: int) -> None:
        box = self.slider(joint).bounding_box()
        share = self.slider(joint).evaluate("e => (e.value - e.min) / (e.max - e.min)")
        x = box["x"] + 8 + share * (box["width"] - 16)  # where the thumb is
        y = box["y"] + box["height"] / 2
        self.tab.mouse.move(x, y)
        self.tab.mouse.down()
        self.tab.mouse.move(x + pixels / 2, y, steps=3)
        self.tab.mouse.move(x + pixels, y, steps=3)
        self.tab.mouse.up()

    def picture(self) -> Array:
        """The part of the canvas beside the panel and the notices, (h, w, 3)."""
        from PIL import Image

        clip = {"x": 320, "y": 190, "width": 550, "height": 600}
        shot = self.tab.screenshot(clip=clip)
        return np.asarray(Image.open(io.BytesIO(shot)).convert("RGB"), dtype=float)


@pytest.fixture(scope="module")
def first_page(browser, served) -> Page:
    return Page(browser, served.url)


@pytest.fixture
def page(first_page) -> Page:
    """The page with the arm at the ready."""
    first_page.open("Joints")
    first_page.press("ready")
    first_page.until(lambda: close(first_page.angles(), panda.READY_Q))
    return first_page


@pytest.fixture(scope="module")
def model():
    return panda.load("panda_nohand")


def truth(model: Any, q: Array, frame: str = "site:attachment_site") -> Array:
    return verify.mujoco_poses(model, np.asarray(q)[None])[frame][0]


def close(a: Array, b: Array) -> bool:
    return bool(np.abs(a - b).max() < SHOWN)


def arm_pixels(picture: Array) -> int:
    """Count what is clearly darker than the backdrop: the see-through arm."""
    return int((picture.max(axis=2) < 205).sum())


@pytest.mark.meshes
def test_the_page_shows_the_arm_with_its_meshes_and_triads(page, real_panda):
    page.until(lambda: arm_pixels(page.picture()) > 5_000)
    picture = page.picture()
    red, green, blue = (picture[..., i] for i in range(3))
    assert (red - np.maximum(green, blue) > 60).sum() > 50
    assert (green - np.maximum(red, blue) > 30).sum() > 50
    assert (blue - np.maximum(red, green) > 60).sum() > 50


def test_the_arm_can_be_made_solid(page):
    page.until(lambda: arm_pixels(page.picture()) > 5_000)
    before = page.picture()
    solid = page.tab.get_by_label("solid arm")
    solid.click()
    page.until(lambda: (np.abs(page.picture() - before).max(axis=2) > 30).sum() > 5_000)
    solid.click()
    page.until(lambda: (np.abs(page.picture() - before).max(axis=2) > 30).sum() < 2_000)


def test_the_page_asks_nobody_else_for_anything(page, served):
    hosts = {
        urllib.parse.urlsplit(url.removeprefix("blob:")).netloc
        for url in page.asked
        if not url.startswith("data:")
    }
    assert hosts == {f"127.0.0.1:{served.port}"}


def test_both_matrices_are_mujocos_pose_of_the_ready_arm(page, model):
    expected = truth(model, panda.READY_Q)
    for key in ("mujoco", "library"):
        np.testing.assert_allclose(page.matrix(key), expected, atol=SHOWN)
    difference = page.tab.locator("[data-line=difference]").first
    assert "they agree" in difference.inner_text()
    assert difference.evaluate("e => getComputedStyle(e).color") == "rgb(0, 102, 75)"


def test_dragging_joint2_moves_the_arm_to_that_angle(page, model):
    page.drag(2, 40)
    page.until(lambda: page.angle(2) > panda.READY_Q[1] + 0.3)
    q = panda.READY_Q.copy()
    q[1] = page.angle(2)
    page.until(lambda: close(page.matrix("mujoco"), truth(model, q)))
    page.until(lambda: close(page.matrix("library"), truth(model, q)))
    assert f"{q[1]:.10g}" in page.line("q")


@pytest.mark.parametrize(
    ("typed", "radians"),
    [("-1.25", -1.25), ("-pi/2", -np.pi / 2), ("-90 deg", -np.pi / 2)],
)
def test_an_angle_can_be_typed(page, model, typed, radians):
    page.box(4).fill(typed)
    page.tab.keyboard.press("Enter")
    q = panda.READY_Q.copy()
    q[3] = radians
    page.until(lambda: close(page.matrix("mujoco"), truth(model, q)))
    page.until(lambda: repr(float(f"{radians:.10g}")) in page.line("q"))


def test_ninety_is_refused_in_words_and_the_box_shows_the_arm_again(page, model):
    page.box(4).fill("90")
    page.tab.keyboard.press("Enter")
    page.until(lambda: "90 is outside" in page.line("tab"))
    page.until(lambda: page.box(4).input_value() == "-2.356")
    assert close(page.matrix("mujoco"), truth(model, panda.READY_Q))


def test_the_arrow_keys_drive_the_arm(page, model):
    page.slider(2).focus()
    for _ in range(3):
        page.tab.keyboard.press("ArrowRight")
    page.tab.keyboard.press("Shift+ArrowRight")
    q = panda.READY_Q.copy()
    q[1] += 0.13
    page.until(lambda: close(page.matrix("mujoco"), truth(model, q)))


def test_the_address_follows_the_arm_and_back_goes_back(page, model):
    page.until(lambda: "q=0,-0.785," in page.tab.url)
    page.tab.wait_for_timeout(1600)  # later than that, a move is a step in the history
    page.press("zero")
    page.until(lambda: "q=0,0,0,0,0,0,0" in page.tab.url)
    page.tab.go_back()
    page.until(lambda: close(page.matrix("mujoco"), truth(model, panda.READY_Q)))


def test_the_buttons_take_the_arm_home_to_zero_and_anywhere(page, model):
    page.press("home")
    page.until(lambda: close(page.matrix("mujoco"), truth(model, panda.home_q(model))))
    page.press("zero")
    page.until(lambda: close(page.matrix("mujoco"), truth(model, np.zeros(7))))
    before = page.matrix("mujoco")
    page.press("random")
    page.until(lambda: not close(page.matrix("mujoco"), before))
    page.until(lambda: close(page.matrix("library"), truth(model, page.angles())))


def test_zero_is_said_to_be_out_of_limits_and_ready_is_not(page):
    warning = page.tab.locator("[data-line=limits]")
    assert warning.count() == 0
    page.press("zero")
    warning.wait_for()
    assert "OUT OF LIMITS: joint4 = 0.0000" in warning.inner_text()
    page.press("ready")
    warning.wait_for(state="detached")


def test_another_frame_can_be_chosen(page, model):
    page.choose("Frame", "link4")
    expected = truth(model, panda.READY_Q, "body:link4")
    page.until(lambda: close(page.matrix("mujoco"), expected))
    assert "T_world_link4, MuJoCo" in page.tab.inner_text("body")
    page.choose("Frame", "ee")
    page.until(lambda: close(page.matrix("mujoco"), truth(model, panda.READY_Q)))


def test_the_steps_show_the_product_of_each_factor(page, model):
    page.open("Chain")
    page.until(lambda: "factor 3 of 16, T(q of joint1)" in page.line("step"))
    page.press("next")
    page.until(lambda: "factor 4 of 16, T_link1_link2" in page.line("step"))
    page.press("next")
    page.until(lambda: "factor 5 of 16, T(q of joint2)" in page.line("step"))
    product = page.matrix("before") @ page.matrix("factor")
    np.testing.assert_allclose(page.matrix("product"), product, atol=4 * SHOWN)
    expected = truth(model, panda.READY_Q, "body:link2")
    np.testing.assert_allclose(page.matrix("product"), expected, atol=SHOWN)
    page.press("back")
    page.until(lambda: "factor 4 of 16" in page.line("step"))


def test_play_goes_through_the_factors_and_stops_with_its_tab(page):
    page.open("Chain")
    page.press("play / stop")
    page.until(lambda: "factor 6 of 16" in page.line("step"))
    page.open("Joints")
    page.until(lambda: page.tab.locator("[data-line=step]").count() == 0)


def test_a_reload_in_the_chain_is_still_in_the_chain(page):
    page.open("Chain")
    page.until(lambda: "factor 3 of 16" in page.line("step"))
    page.tab.reload()
    page.tab.wait_for_selector("[data-line=step]", state="attached")
    chain = page.tab.get_by_role("tab", name="Chain")
    page.until(lambda: chain.get_attribute("aria-selected") == "true")


def test_t_extra_on_either_side_is_shown_with_its_product(page, model):
    T_world_ee = truth(model, panda.READY_Q)
    T_extra = se3.make_T(se3.Rz(np.pi / 4), [0.1, 0, 0])
    page.open("Order")
    apart = np.linalg.norm((T_world_ee @ T_extra - T_extra @ T_world_ee)[:3, 3])
    page.until(lambda: f"{apart:.4f} m apart" in page.line("tab"))
    page.choose("T_extra", "left: T_extra @ T_world_ee")
    page.until(lambda: "whole arm" in page.line("tab"))
    shown = page.tab.locator("[data-matrix^=tab]").inner_text()
    left = np.array(shown.split(), dtype=float).reshape(4, 4)
    np.testing.assert_allclose(left, T_extra @ T_world_ee, atol=SHOWN)


def of_day_1(*functions: str) -> str:
    """Return Day 1's lab as a right file, or with functions of the catalogue in it."""
    text = (ROOT / "w1-foundations/src/day1_transforms.py").read_text("utf-8")
    wrong = ROOT / "w1-foundations/day1/submissions/wrong"
    own = [(wrong / f"{name}.py").read_text("utf-8") for name in functions]
    return "\n".join([text.partition("if __name__")[0], *own])


def test_ones_own_code_is_drawn_judged_and_reloaded_on_save(browser, tmp_path):
    work = tmp_path / "day1_transforms.py"
    kit = ROOT / "w1-foundations/src/kit.py"
    (tmp_path / "kit.py").write_bytes(kit.read_bytes())
    work.write_text(of_day_1("Rz_swapped"), "utf-8")
    server = Served("1", "--port", "0", "--simple", work=work)
    try:
        page = Page(browser, server.url)
        page.until(lambda: "✗ YOUR compose_fk is off by 744 mm" in page.said("yours"))
        assert "first frame that differs: link1" in page.said("yours")
        assert page.tab.locator("[data-matrix=yours] .off").count() >= 10
        page.until(lambda: "1.2: Sin and cos" in page.said("standing"))
        work.write_text(of_day_1().replace("T_world_body = np.eye(4)", "while 1: pass"))
        page.until(lambda: "compose_fk did not return" in page.said("yours"))
        page.press("zero")  # the page goes on
        page.until(lambda: page.angle(2) == 0)
        work.write_text(of_day_1().replace("def Rz", "deff Rz"))
        page.until(lambda: "SyntaxError" in page.said("yours"))
        work.write_text(of_day_1(), "utf-8")
        page.until(lambda: "✓ YOUR compose_fk agrees" in page.said("yours"))
        page.until(lambda: "tasks pass" in page.said("standing"))
        assert "Traceback" not in server.said
        page.tab.close()
    finally:
        server.close()


def test_a_reload_finds_the_arm_where_it_was_and_still_moves_it(page, model):
    page.drag(2, 30)
    page.until(lambda: page.angle(2) > panda.READY_Q[1] + 0.2)
    angle = page.angle(2)
    page.tab.reload()
    page.wait()
    page.until(lambda: abs(page.angle(2) - angle) < 1e-4)
    page.drag(2, -30)
    page.until(lambda: page.angle(2) < angle - 0.2)
    q = panda.READY_Q.copy()
    q[1] = page.angle(2)
    page.until(lambda: close(page.matrix("mujoco"), truth(model, q)))


def test_two_browsers_see_the_same_arm(page, browser, served, model):
    other = Page(browser, served.url)
    try:
        page.drag(2, 40)
        page.until(lambda: page.angle(2) > panda.READY_Q[1] + 0.3)
        q = panda.READY_Q.copy()
        q[1] = page.angle(2)
        for each in (page, other):
            each.until(lambda each=each: close(each.matrix("mujoco"), truth(model, q)))
        other.until(lambda: abs(other.angle(2) - q[1]) < 1e-4)
        other.press("home")
        home = truth(model, panda.home_q(model))
        page.until(lambda: close(page.matrix("library"), home))
    finally:
        other.tab.close()


def test_ctrl_c_ends_it_with_a_page_open(browser):
    server = Served("--port", "0", "--simple")
    try:
        page = Page(browser, server.url)
        assert server.press_ctrl_c() == 0, server.said
        assert server.said.endswith("inspector stopped\n")
        assert "Traceback" not in server.said
        page.tab.close()
    finally:
        server.close()


def test_a_foreign_page_cannot_connect_in_a_real_browser_either(browser, served):
    tab = browser.new_page()
    tab.goto("data:text/html,<p>a page from elsewhere</p>")
    ended = tab.evaluate(
        """url => new Promise(end => {
            const socket = new WebSocket(url, ['viser-v0']);
            socket.onopen = () => end('open');
            socket.onerror = () => end('refused');
        })""",
        served.url.replace("http", "ws"),
    )
    tab.close()
    assert ended == "refused"


def test_without_the_robot_the_twin_is_drawn_and_the_page_says_so(browser):
    server = Served("--port", "0", "--simple", robot=False)
    try:
        page = Page(browser, server.url)
        assert "simple shapes are drawn" in page.line("about")
        assert "simple shapes are drawn" in server.said
        page.until(lambda: arm_pixels(page.picture()) > 5_000)
        assert "they agree" in page.line("difference")
        page.tab.close()
    finally:
        server.close()


def test_nothing_went_wrong_on_the_servers_side(served):
    """Last, so that it judges the whole module."""
    assert "Traceback" not in served.said
    assert "Error" not in served.said
