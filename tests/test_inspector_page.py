"""The inspector as a student meets it: in a real browser, with the mouse.

The drawing is done in software here, so the page draws few pixels, and as many tests as
can share one server and one page: a page takes seconds to load.
"""

import importlib.util
import io
import re
import time
import urllib.parse
import urllib.request
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from inspection import ROOT, Served

from conftest import need
from labkit.inspector import typed
from robo47 import panda, se3, verify
from robo47.checks import Array

pytestmark = [pytest.mark.browser, pytest.mark.kit]

FLAGS = [
    "--no-sandbox",
    "--disable-gpu",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-background-networking",
    "--no-first-run",
]
MILLISECONDS = 60_000  # a busy machine
# viser's own word for a coarse picture, said again at every load of the page.
COARSE = """
const query = new URLSearchParams(location.search);
query.set("fixedDpr", "%s");
if (location.protocol === "http:") history.replaceState(null, "", `?${query}`);
"""
FEW_PIXELS, SOME_PIXELS = COARSE % 0.1, COARSE % 0.6
ELSEWHERE = (0.1, -0.2, 0.3, -1.5, 0.5, 1.6, -0.7)
SHOWN = 6e-7  # a matrix is shown with 6 decimals


@pytest.fixture(scope="module")
def browser(chromium) -> Iterator[Any]:
    for module in ("viser", "playwright"):
        found = importlib.util.find_spec(module) is not None
        need(found, f"{module}: python3 scripts/setup_env.py view browser")
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        made = playwright.chromium.launch(executable_path=chromium, args=FLAGS)
        yield made
        made.close()


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    """Where the student's file will be, and the server's memory."""
    folder = tmp_path_factory.mktemp("work")
    (folder / "kit.py").write_bytes((ROOT / "w1-foundations/src/kit.py").read_bytes())
    return folder


@pytest.fixture(scope="module")
def served(browser, folder) -> Iterator[Served]:
    work = folder / "day1_transforms.py"
    with Served("1", "--port", "0", "--simple", work=work, memory=folder) as server:
        yield server


# The least contrast of a text in the panel with what is behind it, as WCAG 2.2 has it.
LEAST_CONTRAST = """() => {
  const shares = [0.2126, 0.7152, 0.0722];
  const light = (rgb) => shares.map((share, i) => [rgb[i], share]).map(([c, share]) =>
    share * (c <= 10.3 ? c / 3294 : ((c / 255 + 0.055) / 1.055) ** 2.4))
    .reduce((a, b) => a + b);
  const behind = (node) => {
    const paint = getComputedStyle(node).backgroundColor.match(/[0-9.]+/g).map(Number);
    return paint[3] === 0 ? behind(node.parentElement) : paint;
  };
  const texts = "[class*=r47] *, [class*=r47], label, button";
  const contrasts = [...document.querySelectorAll(texts)]
    .filter((node) => node.checkVisibility() && [...node.childNodes].some(
      (child) => child.nodeType === 3 && child.data.trim()))
    .map((node) => {
      const text = getComputedStyle(node).color.match(/[0-9.]+/g).map(Number);
      const both = [light(text), light(behind(node))].sort((a, b) => b - a);
      return [(both[0] + 0.05) / (both[1] + 0.05), node.outerHTML];
    });
  return contrasts.sort((a, b) => a[0] - b[0])[0];
}"""


NAMELESS = """() => [...document.querySelectorAll("button")].filter((button) =>
  !button.textContent.trim() && !button.ariaLabel).map((button) => button.outerHTML)"""


# The parts of the card that hold text, and how much of the card cannot be seen: text
# that is scrolled away, edges outside the window, and what the panel hides of it.
CARD = """() => {
  const card = [...document.querySelectorAll("[data-line=standing]")]
    .find((node) => node.checkVisibility());
  if (!card) return null;
  const box = card.getBoundingClientRect();
  const tabs = card.closest(".mantine-Paper-root").getBoundingClientRect();
  const across = Math.min(box.right, tabs.right) - Math.max(box.left, tabs.left);
  const down = Math.min(box.bottom, tabs.bottom) - Math.max(box.top, tabs.top);
  return { bold: card.querySelector("b").innerText, text: card.innerText,
    scrolled: card.scrollHeight - card.clientHeight,
    outside: Math.max(0, -box.left, -box.top, box.right - innerWidth,
      box.bottom - innerHeight),
    hidden: Math.max(0, Math.min(across, down)),
    shadow: Number(getComputedStyle(card, "::after").opacity) };
}"""
# How much of the legend is below the panel, and how much outside the window.
COVERED = """() => {
  const box = document.querySelector(".r47-stage").getBoundingClientRect();
  const panel = document.querySelector(".mantine-Paper-root:has([data-r47-state])");
  const tabs = panel.getBoundingClientRect();
  const across = Math.min(box.right, tabs.right) - Math.max(box.left, tabs.left);
  const down = Math.min(box.bottom, tabs.bottom) - Math.max(box.top, tabs.top);
  return Math.max(0, Math.min(across, down)) + Math.max(0, -box.left, -box.top,
    box.right - innerWidth, box.bottom - innerHeight) + (box.height ? 0 : 1);
}"""
# The sentence of the card becomes so long that no window holds it.
LONG = """() => { for (const card of document.querySelectorAll("[data-line=standing]"))
  card.lastElementChild.append(" and so on".repeat(500)); }"""


class Page:
    """The inspector's page, read and moved as a person would."""

    def __init__(
        self,
        browser: Any,
        url: str,
        query: str = "",
        init: str = FEW_PIXELS,
        **options: Any,
    ) -> None:
        size = {"width": 1280, "height": 800}
        self.tab = browser.new_page(viewport=size, **options)
        self.tab.set_default_timeout(MILLISECONDS)
        self.asked: list[str] = []
        self.tab.on("request", lambda request: self.asked.append(request.url))
        self.tab.add_init_script(init)
        self.tab.goto(url + query)
        self.wait()

    def wait(self) -> None:
        self.tab.wait_for_selector("[data-r47-state]", state="attached")
        self.tab.wait_for_selector("#r47-first", state="detached")

    def later(self) -> None:
        """Move the page's clock on by two seconds."""
        self.tab.evaluate(
            "() => { const now = Date.now(); Date.now = () => now + 2000 }"
        )

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
            self.tab.wait_for_timeout(50)
        raise AssertionError(f"still: {self.tab.inner_text('body')}")

    def press(self, name: str) -> None:
        self.tab.get_by_role("button", name=name, exact=True).click()

    def go(self, query: str) -> None:
        """Go to another address of the page, as the Back button does."""
        self.tab.evaluate(
            "query => { history.pushState(null, '', query);"
            " dispatchEvent(new PopStateEvent('popstate')); }",
            query,
        )

    def check_contrast(self) -> None:
        """Check that all text in the panel stands out from what is behind it."""
        contrast, text = self.tab.evaluate(LEAST_CONTRAST)
        assert contrast >= 4.5, text

    def check_card(self, title: str, count: str, sentence: str) -> None:
        """Check that the whole verdict is seen, on a laptop and on a phone.

        A sentence that is too long for the window scrolls, and a shadow shows it.
        """

        def whole() -> bool:
            card = self.tab.evaluate(CARD) or {"text": "", "hidden": 1}
            seen = sentence in card["text"] and count in card["text"]
            cut = ("scrolled", "outside", "hidden", "shadow")
            return seen and card["bold"] == title and not any(map(card.get, cut))

        def scrolls() -> bool:
            card = self.tab.evaluate(CARD)
            return (
                card["scrolled"] > 100 and card["shadow"] == 1 and not card["outside"]
            )

        for width, height in ((390, 844), (1280, 800)):
            self.tab.set_viewport_size({"width": width, "height": height})
            self.until(whole)
        self.tab.evaluate(LONG)
        self.until(scrolls)

    def open(self, tab: str) -> None:
        self.tab.get_by_role("tab", name=tab).click()

    def selected(self, tab: str) -> bool:
        found = self.tab.get_by_role("tab", name=tab)
        return found.get_attribute("aria-selected") == "true"

    def choose(self, label: str, option: str) -> None:
        self.labelled(label).locator("input").first.click()
        self.tab.get_by_role("option", name=option, exact=True).click()

    def labelled(self, label: str) -> Any:
        """The row of viser's widget with that label."""
        named = self.tab.locator("label").get_by_text(label, exact=True)
        return self.tab.locator("div:has(> div > p > label)").filter(has=named)

    def slider(self, joint: int) -> Any:
        return self.labelled(f"joint{joint}").get_by_role("slider")

    def box(self) -> Any:
        return self.labelled("q").locator("input")

    def angle(self, joint: int) -> float:
        return float(self.slider(joint).get_attribute("aria-valuenow"))

    def angles(self) -> Array:
        words = self.box().input_value()  # empty while the page draws it anew
        return np.array(typed.configuration(words, 7)) if words else np.full(7, np.nan)

    def drag(self, joint: int, pixels: int) -> None:
        self.slider(joint).hover()  # which waits until it stands still
        thumb = self.slider(joint).bounding_box()
        x, y = thumb["x"] + thumb["width"] / 2, thumb["y"] + thumb["height"] / 2
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


def coloured_pixels(picture: Array, lowest: float, highest: float) -> int:
    """Count the strongly coloured pixels with a hue in this range, degrees."""
    from PIL import Image

    image = Image.fromarray(picture.astype(np.uint8)).convert("HSV")
    hue, saturation, _ = np.moveaxis(np.asarray(image, dtype=float), 2, 0)
    found = (
        (saturation > 100) & (hue * 360 / 255 >= lowest) & (hue * 360 / 255 < highest)
    )
    return int(found.sum())


@pytest.fixture(scope="module")
def first_page(browser, served) -> Iterator[Page]:
    page = Page(browser, served.url)
    yield page
    page.tab.close()


@pytest.fixture
def page(first_page) -> Page:
    """The page with the arm at the ready, in the tab Joints."""
    first_page.go(typed.write_address(panda.READY_Q, "ee", "Joints"))
    first_page.until(lambda: first_page.selected("Joints"))
    first_page.until(lambda: close(first_page.angles(), panda.READY_Q))
    return first_page


@pytest.fixture(scope="class")
def drawn(browser, served) -> Iterator[Page]:
    """A page whose picture is looked at."""
    page = Page(browser, served.url, init=SOME_PIXELS)
    page.until(lambda: arm_pixels(page.picture()) > 5_000)
    yield page
    page.tab.close()


SHARED = f"?q={','.join(map(str, ELSEWHERE))}&frame=link4"


@pytest.fixture(scope="class")
def dark(browser, served) -> Iterator[Page]:
    """A second browser, of somebody who likes it dark, at a shared address."""
    address = f"{served.url}{SHARED}&tab=Tasks"
    page = Page(browser, address, color_scheme="dark")
    yield page
    page.tab.close()


@pytest.fixture(scope="module")
def model():
    return panda.load("panda_nohand")


def truth(model: Any, q: Array, frame: str = "site:attachment_site") -> Array:
    return verify.mujoco_poses(model, np.asarray(q)[None])[frame][0]


def close(a: Array, b: Array) -> bool:
    return bool(np.abs(a - b).max() < SHOWN)


def arm_pixels(picture: Array) -> int:
    """Count what is clearly brighter than the dark stage and its floor: the arm."""
    return int((picture.min(axis=2) > 100).sum())


class TestThePicture:
    """A class, so that its page is closed after it: each of its frames is work."""

    def test_the_page_shows_the_arm_and_triads_in_three_colours(self, drawn):
        picture = drawn.picture()
        for lowest, highest in (15, 30), (165, 180), (195, 210):
            assert coloured_pixels(picture, lowest, highest) > 100

    def test_the_arm_can_be_made_solid(self, drawn):
        before = drawn.picture()
        solid = drawn.tab.get_by_label("solid arm")
        solid.click()
        drawn.until(
            lambda: (np.abs(drawn.picture() - before).max(axis=2) > 30).sum() > 5_000
        )
        solid.click()
        drawn.until(
            lambda: (np.abs(drawn.picture() - before).max(axis=2) > 30).sum() < 2_000
        )

    def test_the_link_that_is_clicked_shows_its_axis(self, drawn):
        drawn.go("?q=0,0,0,-1.5,0,1.5,0&tab=Joints")
        drawn.until(lambda: drawn.box().input_value() == "0, 0, 0, -1.5, 0, 1.5, 0")
        purple = (285, 315)
        drawn.until(lambda: coloured_pixels(drawn.picture(), *purple) == 0)
        drawn.tab.mouse.click(420, 480)  # the shoulder
        drawn.until(lambda: coloured_pixels(drawn.picture(), *purple) > 25)
        drawn.tab.mouse.click(650, 250)  # the air
        drawn.until(lambda: coloured_pixels(drawn.picture(), *purple) == 0)


def test_the_page_asks_nobody_else_for_anything(page, served):
    hosts = {
        urllib.parse.urlsplit(url.removeprefix("blob:")).netloc
        for url in page.asked
        if not url.startswith("data:")
    }
    assert hosts == {f"127.0.0.1:{served.port}"}


def test_the_matrices_stand_in_the_page_before_viser_draws_anything(served, page):
    with urllib.request.urlopen(served.url, timeout=60) as answer:
        text = answer.read().decode()
    first = text.partition('<div id="r47-first">')[2]
    entries = first.partition('data-matrix="mujoco">')[2].partition("</pre>")[0]
    shown = re.sub("<[^>]*>", "", entries)
    numbers = np.array(shown.split(), dtype=float).reshape(4, 4)
    np.testing.assert_allclose(numbers, page.matrix("mujoco"), atol=SHOWN)


def test_both_matrices_are_mujocos_pose_of_the_ready_arm(page, model):
    expected = truth(model, panda.READY_Q)
    for key in ("mujoco", "library"):
        np.testing.assert_allclose(page.matrix(key), expected, atol=SHOWN)
    difference = page.tab.locator("[data-line=difference]").first
    assert "they agree" in difference.inner_text()
    # Green is the student's alone: here there is no file.
    assert difference.evaluate("e => getComputedStyle(e).color") == "rgb(91, 101, 112)"


def test_dragging_joint2_moves_the_arm_to_that_angle(page, model):
    page.drag(2, 40)
    page.until(lambda: page.angle(2) > panda.READY_Q[1] + 0.3)
    page.until(lambda: close(page.matrix("mujoco"), truth(model, page.angles())))
    page.until(lambda: close(page.matrix("library"), page.matrix("mujoco")))
    page.tab.wait_for_timeout(200)
    assert close(page.angles()[[0, *range(2, 7)]], panda.READY_Q[[0, *range(2, 7)]])


@pytest.mark.parametrize(
    ("angle", "radians"),
    [("-1.25", -1.25), ("-pi/2", -np.pi / 2), ("-90 deg", -np.pi / 2)],
)
def test_an_angle_can_be_typed(page, model, angle, radians):
    text = f"0, -0.785, 0, {angle}, 0, 1.571, 0.785"
    page.box().fill(text)
    q = panda.READY_Q.copy()
    q[3] = radians
    page.until(lambda: close(page.matrix("mujoco"), truth(model, q)))
    page.until(lambda: abs(page.angle(4) - radians) < 1e-4)
    assert page.box().input_value() == text


def test_ninety_is_refused_in_words_and_the_arm_stays(page, model):
    page.box().fill("0, 90, 0, -2.356, 0, 1.571, 0.785")
    page.until(lambda: "90 rad is over a turn" in page.line("tab"))
    assert close(page.matrix("mujoco"), truth(model, panda.READY_Q))
    page.press("zero")  # the box says where the arm is again
    page.until(lambda: page.box().input_value() == "0, 0, 0, 0, 0, 0, 0")


def test_the_arrow_keys_drive_the_arm(page, model):
    page.slider(2).focus()
    for _ in range(3):
        page.tab.keyboard.press("ArrowRight")
    page.until(lambda: abs(page.angle(2) - panda.READY_Q[1] - 0.03) < 0.006)
    page.until(lambda: close(page.matrix("mujoco"), truth(model, page.angles())))
    page.tab.wait_for_timeout(200)  # the slider tells its last place once more


# What a slow page does: what it was told before arrives after it.
TOLD_LATE = """async (old) => {
  document.querySelector("[data-r47-state]").dataset.r47State = old;
  document.body.append(document.createElement("i"));
  await new Promise((done) => setTimeout(done, 200));
}"""


def test_what_arrives_late_takes_nobody_back(page):
    told = page.tab.locator("[data-r47-state]")
    old = told.get_attribute("data-r47-state")
    page.open("Chain")
    page.until(lambda: "tab=Chain" in page.tab.url)
    page.tab.evaluate(TOLD_LATE, old)
    assert "tab=Chain" in page.tab.url
    page.open("Tasks")
    page.until(lambda: "tab=Tasks" in page.tab.url)


def test_the_address_follows_the_arm_and_back_goes_back(page, model):
    page.until(lambda: "q=0,-0.785," in page.tab.url)
    page.later()  # a move that follows at once is no step of its own in the history
    page.press("zero")
    page.until(lambda: "q=0,0,0,0,0,0,0" in page.tab.url)
    page.tab.go_back()
    page.until(lambda: close(page.matrix("mujoco"), truth(model, panda.READY_Q)))


def test_back_goes_back_through_the_tabs_too(page):
    for tab in ("Order", "Tasks"):
        page.later()
        page.open(tab)
        page.until(lambda tab=tab: f"tab={tab}" in page.tab.url)
    page.tab.go_back()
    page.until(lambda: page.selected("Order"))
    page.tab.go_back()
    page.until(lambda: page.selected("Joints"))
    page.tab.go_forward()
    page.until(lambda: page.selected("Order"))


def test_a_button_is_pressed_once_while_the_page_changes_around_it(page):
    page.open("Chain")
    page.until(lambda: "factor 3 of 16" in page.line("step"))
    button = page.tab.get_by_role("button", name="next", exact=True)
    button.hover()
    page.tab.mouse.down()
    base = page.tab.url.partition("?")[0]
    page.tab.evaluate("base => fetch(`${base}go?q=1,0,0,-1,0,1,0`)", base)
    page.until(lambda: "0.540302" in page.tab.inner_text("body"))  # cos 1
    page.tab.mouse.up()
    page.until(lambda: "factor 4 of 16" in page.line("step"))
    page.press("next")
    page.until(lambda: "factor 5 of 16" in page.line("step"))


def test_a_press_that_is_let_go_elsewhere_does_nothing(page):
    page.tab.get_by_role("button", name="zero", exact=True).hover()
    page.tab.mouse.down()
    page.tab.get_by_role("button", name="home", exact=True).hover()
    page.tab.mouse.up()
    page.slider(1).focus()
    page.tab.keyboard.press("ArrowRight")  # what is sent later arrives later
    page.until(lambda: page.angles()[0] == 0.01)
    assert close(page.angles()[1:], panda.READY_Q[1:])


def test_the_buttons_can_be_pressed_with_the_keyboard(page, model):
    page.tab.get_by_role("button", name="zero", exact=True).press("Enter")
    page.until(lambda: close(page.matrix("mujoco"), truth(model, np.zeros(7))))
    page.tab.get_by_role("tab", name="Chain").press("Space")
    page.until(lambda: "factor 3 of 16" in page.said("step"))


def test_the_buttons_take_the_arm_home_to_zero_and_anywhere(page, model):
    page.press("home")
    page.until(lambda: close(page.matrix("mujoco"), truth(model, panda.home_q(model))))
    assert page.said("limits") == ""
    page.press("zero")
    page.until(lambda: close(page.matrix("mujoco"), truth(model, np.zeros(7))))
    assert "OUT OF LIMITS: joint4 = 0.0000" in page.said("limits")
    before = page.matrix("mujoco")
    page.press("random")
    page.until(lambda: not close(page.matrix("mujoco"), before))
    page.until(lambda: close(page.matrix("library"), truth(model, page.angles())))


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
    page.until(lambda: "factor 1 of 16" in page.line("step"))
    page.until(lambda: "factor 2 of 16" in page.line("step"))
    page.open("Joints")
    page.until(lambda: page.tab.locator("[data-line=step]").count() == 0)


def test_t_extra_on_either_side_is_shown_with_its_product(page, model):
    T_world_ee = truth(model, panda.READY_Q)
    T_extra = se3.make_T(se3.Rz(np.pi / 4), [0.1, 0, 0])
    page.open("Order")
    apart = np.linalg.norm((T_world_ee @ T_extra - T_extra @ T_world_ee)[:3, 3])
    page.until(lambda: f"two positions is {apart:.4f} m" in page.said("says-0"))
    page.choose("T_extra", "left: T_extra @ T_world_ee")
    page.until(lambda: "whole arm" in page.said("says-0"))
    shown = page.tab.locator("[data-matrix^=tab]").inner_text()
    left = np.array(shown.split(), dtype=float).reshape(4, 4)
    np.testing.assert_allclose(left, T_extra @ T_world_ee, atol=SHOWN)


def test_a_tab_runs_ones_own_functions_and_says_what_they_did(browser, folder):
    work = folder / "day4_dynamics.py"
    right = (ROOT / "w1-foundations/src/day4_dynamics.py").read_text("utf-8")
    wrong = right.replace("tau[: i + 1] -= m * g", "tau[: i + 1] += m * g")
    work.write_text(wrong, "utf-8")
    with Served("4", "--port", "0", "--simple", work=work) as server:
        page = Page(browser, server.url, "?tab=Forces")
        page.until(lambda: "library's: gravity_torque by" in page.said("whose"))
        page.until(lambda: "largest joint velocity" in page.said("says-0"))
        page.until(lambda: "velocity 0.00 rad/s" not in page.said("says-0"))  # it falls
        work.write_text(right, "utf-8")
        page.until(lambda: "✓ YOUR" in page.said("whose"))
        afloat = r"t = (0\.[5-9]|[1-9]).* velocity 0\.00 rad/s"
        page.until(lambda: re.search(afloat, page.said("says-0"), re.DOTALL))
        work.write_text(
            right.replace("    tau = np.zeros", "    while 1: pass\n    t =")
        )
        page.until(lambda: "gravity_torque did not return" in page.said("whose"))
        page.open("Joints")  # the page goes on
        page.until(lambda: page.selected("Joints"))
        assert "Traceback" not in server.said
        page.tab.close()


def test_a_reload_finds_the_arm_where_it_was_and_still_moves_it(page, model):
    page.drag(2, 30)
    page.until(lambda: page.angle(2) > panda.READY_Q[1] + 0.2)
    page.until(lambda: close(page.matrix("mujoco"), truth(model, page.angles())))
    angle = page.angle(2)
    page.until(lambda: f",{angle:g}," in page.tab.url)  # the address keeps the pose
    page.tab.reload()
    page.wait()
    page.until(lambda: abs(page.angle(2) - angle) < 1e-4)
    page.drag(2, -30)
    page.until(lambda: page.angle(2) < angle - 0.2)
    page.until(lambda: close(page.matrix("mujoco"), truth(model, page.angles())))


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


def of_day_1(*functions: str) -> str:
    """Return Day 1's lab as a right file, or with functions of the catalogue in it."""
    text = (ROOT / "w1-foundations/src/day1_transforms.py").read_text("utf-8")
    wrong = ROOT / "w1-foundations/day1/submissions/wrong"
    own = [(wrong / f"{name}.py").read_text("utf-8") for name in functions]
    return "\n".join([text.partition("if __name__")[0], *own])


class TestTwoBrowsers:
    """One of them dark, at an address that somebody shared."""

    def test_a_shared_address_opens_at_its_arm_frame_and_tab(self, dark, model):
        expected = truth(model, np.array(ELSEWHERE), "body:link4")
        dark.until(lambda: close(dark.matrix("mujoco"), expected))
        assert dark.selected("Tasks")

    def test_they_see_the_same_arm(self, page, dark, model):
        page.drag(2, 40)
        page.until(lambda: page.angle(2) > panda.READY_Q[1] + 0.3)
        for each in (dark, page):
            each.until(
                lambda each=each: close(
                    each.matrix("mujoco"), truth(model, page.angles())
                )
            )
        dark.until(lambda: abs(dark.angle(2) - page.angle(2)) < 1e-4)
        dark.press("home")
        home = truth(model, panda.home_q(model))
        page.until(lambda: close(page.matrix("library"), home))

    def test_every_text_can_be_read_in_light_and_in_dark(self, page, dark):
        for tab in ("Chain", "Order", "Joints"):
            page.open(tab)
            for each in (page, dark):
                each.until(lambda each=each, tab=tab: each.selected(tab))
                each.check_contrast()
        page.press("zero")  # out of limits
        for each in (page, dark):
            each.until(lambda each=each: "OUT OF LIMITS" in each.said("limits"))
            each.check_contrast()
        back = "e => getComputedStyle(e.closest('.mantine-Paper-root')).backgroundColor"
        light, night = (
            each.tab.locator("[data-line=degrees]").evaluate(back)
            for each in (page, dark)
        )
        assert light == "rgb(255, 255, 255)"
        assert night != light

    def test_on_a_phone_the_panel_is_as_wide_as_the_page_and_half_as_high(self, page):
        page.tab.set_viewport_size({"width": 390, "height": 844})
        panel = page.tab.locator(".mantine-Paper-root:has([data-r47-state])")

        def size():  # None while it is laid out anew
            box = panel.bounding_box() or {"width": 0, "height": 999}
            return box["width"], box["height"]

        page.until(lambda: size()[0] == 390 and size()[1] <= 422)
        # All sliders are on the first screen, before the matrices.
        page.until(lambda: page.slider(7).bounding_box()["y"] < 830)
        page.check_contrast()
        page.until(lambda: page.tab.evaluate(COVERED) == 0)
        page.tab.set_viewport_size({"width": 1280, "height": 800})
        page.until(lambda: 0 < size()[0] < 390)
        page.until(lambda: page.tab.evaluate(COVERED) == 0)

    def test_every_button_has_a_name(self, page):
        page.until(lambda: page.tab.evaluate(NAMELESS) == [])

    def test_ones_own_code_is_drawn_judged_and_reloaded_on_save(
        self, page, dark, served, folder
    ):
        work = folder / "day1_transforms.py"
        work.write_text(of_day_1("Rz_swapped"), "utf-8")
        page.until(lambda: "✗ YOUR compose_fk is off by 744 mm" in page.said("yours"))
        assert "first frame that differs: link1" in page.said("yours")
        page.until(lambda: "sine and the cosine" in page.said("standing"))
        marked = "[data-matrix=yours] .off"
        for each in (page, dark):
            each.until(lambda each=each: each.tab.locator(marked).count() >= 10)
            each.check_contrast()  # with entries that are marked
        said = dark.said("standing").splitlines()
        dark.check_card("✗ 1.2 Rz", "of 8 pass", said[-1])
        work.write_text(of_day_1().replace("T_world_body = np.eye(4)", "while 1: pass"))
        page.until(lambda: "asking your" in page.said("standing"))
        page.until(lambda: "compose_fk did not return" in page.said("yours"))
        assert "the sine and the cosine" not in page.said("standing").lower()
        assert "no answer" in page.said("difference")
        page.press("zero")  # the page goes on
        page.until(lambda: page.angles()[1] == 0)
        work.write_text(of_day_1().replace("def Rz", "deff Rz"))
        page.until(lambda: "SyntaxError" in page.said("yours"))
        work.write_text(of_day_1(), "utf-8")
        page.until(lambda: "✓ YOUR compose_fk agrees" in page.said("yours"))
        page.until(lambda: "All tasks pass" in page.said("standing"))
        work.unlink()
        page.until(lambda: "day1_transforms.py yet" in page.said("yours"))


@pytest.fixture(scope="module")
def again(browser, served, first_page, folder) -> Iterator[tuple[Served, Page]]:
    """The server started once more after its end, without the robot; and its page."""
    where = f"{SHARED}&tab=Order"  # whole: it is written down once a second
    first_page.go(where)
    first_page.until(lambda: where in (folder / "view.json").read_text("utf-8"))
    assert served.press_ctrl_c() == 0, served.said  # with a page open
    with Served("1", "--port", "0", "--simple", robot=False, memory=folder) as server:
        page = Page(browser, server.url, init=COARSE % 0.3)
        yield server, page
        page.tab.close()


def test_a_restart_finds_the_tab_and_the_arm_where_they_were(again, model):
    _, page = again
    expected = truth(model, np.array(ELSEWHERE), "body:link4")
    page.until(lambda: page.selected("Order"))
    page.until(lambda: close(page.matrix("mujoco"), expected))


def test_without_the_robot_the_twin_is_drawn_and_the_page_says_so(again):
    server, page = again
    assert "simple shapes are drawn" in page.line("about")
    assert "simple shapes are drawn" in server.said
    page.until(lambda: arm_pixels(page.picture()) > 5_000)
    assert "they agree" in page.line("difference")


def test_nothing_went_wrong_on_the_servers_side(served, again):
    """Last, so that it judges the whole module."""
    assert served.said.endswith("inspector stopped\n")
    for server in (served, again[0]):
        assert "Traceback" not in server.said
        assert "Error" not in server.said
