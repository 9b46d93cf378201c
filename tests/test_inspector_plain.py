"""The inspector's page in a browser without 3D, and when its server has ended."""

import importlib.util
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from inspection import ROOT, Served

from conftest import need
from labkit.lesson.day import find_day

pytestmark = [pytest.mark.browser, pytest.mark.kit]

MILLISECONDS = 30_000


@pytest.fixture(scope="module")
def browser(chromium) -> Iterator[Any]:
    for module in ("viser", "playwright"):
        found = importlib.util.find_spec(module) is not None
        need(found, f"{module}: python3 scripts/setup_env.py view browser")
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        flags = ["--no-sandbox", "--disable-gpu", "--disable-3d-apis"]
        made = playwright.chromium.launch(executable_path=chromium, args=flags)
        yield made
        made.close()


@pytest.fixture
def work(tmp_path) -> Path:
    (tmp_path / "kit.py").write_bytes((ROOT / "w1-foundations/src/kit.py").read_bytes())
    return tmp_path / "day1_transforms.py"


def matrix(tab: Any, key: str) -> np.ndarray:
    text = tab.locator(f"#r47-first [data-matrix={key}]").inner_text()
    return np.array(text.split(), dtype=float).reshape(4, 4)


def test_without_webgl_the_page_says_so_and_its_numbers_move_and_follow_the_file(
    browser, work
):
    with Served("1", "--port", "0", "--simple", work=work, memory=work.parent) as it:
        tab = browser.new_page(viewport={"width": 390, "height": 844})
        tab.set_default_timeout(MILLISECONDS)
        tab.goto(it.url)
        draws = "!!document.createElement('canvas').getContext('webgl2')"
        assert not tab.evaluate(draws)
        slider = tab.get_by_role("slider", name="joint1", exact=True)
        slider.wait_for()
        text = tab.inner_text("body")
        assert "This browser draws no 3D" in text
        assert "make view ARGS=--screenshot" in text
        for vizers in ("Scene tree", "Save Canvas", "WebGL unavailable"):
            assert not tab.get_by_text(vizers).is_visible()
        assert not tab.locator("#root").is_visible()
        assert tab.evaluate("document.documentElement.scrollWidth") == 390
        before = matrix(tab, "mujoco")
        slider.focus()
        slider.press("End")
        tab.wait_for_function(
            "([key, x]) => !document.querySelector(key).innerText.includes(x)",
            arg=["#r47-first [data-matrix=mujoco]", f"{before[0, 3]:.6f}"],
        )
        assert "q=2.89" in tab.url  # joint 1's upper limit, to the slider's step
        tab.get_by_role("combobox", name="frame").select_option("link3")
        tab.get_by_text("T_world_link3, MuJoCo").wait_for()
        tab.get_by_role("button", name="ready", exact=True).click()
        tab.wait_for_function("() => location.search.includes('q=0,')")
        work.write_bytes(find_day(1).source.read_bytes())
        tab.get_by_text("agrees with MuJoCo").first.wait_for()
        tab.close()


def test_an_old_tab_says_that_its_server_has_ended_and_names_the_new_ones_address(
    browser, work
):
    over = "#r47-over"
    with Served("1", "--port", "0", "--simple", work=work, memory=work.parent) as it:
        port, own = it.port, browser.new_context()
        old = own.new_page()
        old.set_default_timeout(MILLISECONDS)
        old.goto(it.url)
        old.get_by_role("slider", name="joint1", exact=True).wait_for()
        assert old.locator(over).count() == 0
        assert it.press_ctrl_c() == 0
        old.locator(over).wait_for()
        text = old.inner_text(over)
        assert "The inspector's server has ended." in text
        assert "make view" in text
        # No verdict stays green that nobody can ask again.
        assert "grayscale" in old.evaluate(
            "getComputedStyle(document.getElementById('r47-first')).filter"
        )
    with Served("1", "--port", str(port), work=work, memory=work.parent) as new:
        assert new.url != old.url
        assert "has ended" in old.inner_text(over)  # another secret: it is not its own
        own.new_page().goto(new.url)
        old.bring_to_front()
        old.get_by_role("link", name="open its page").wait_for()
        old.get_by_role("link", name="open its page").click()
        old.wait_for_url(f"{new.url}**")
        old.get_by_role("slider", name="joint1", exact=True).wait_for()
        assert old.locator(over).count() == 0
