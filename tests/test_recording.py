"""A recording: one file that plays, turns and weighs little."""

import re

import numpy as np
import pytest

pytest.importorskip("viser", reason="the extra view")

from labkit.inspector.recording import Recording
from labkit.inspector.shapes import shapes
from robo47 import panda, scenes

pytestmark = pytest.mark.kit


@pytest.fixture(scope="module")
def film():
    return Recording(scenes.table_top(meshes=True))


@pytest.fixture(scope="module")
def page(film, tmp_path_factory):
    """Return a file in which the arm's first joint turns for two seconds."""
    for angle in np.linspace(0.0, 1.0, 60):
        film.pose([angle, *panda.READY_Q[1:]])
        film.wait()
    path = tmp_path_factory.mktemp("film") / "turn.html"
    path.write_text(film.page("A turn"), "utf-8")
    assert film.seconds == pytest.approx(2.0)
    return path


@pytest.mark.meshes
def test_a_film_with_the_robots_meshes_is_under_two_megabytes(page):
    assert page.stat().st_size < 2_000_000


def test_thin_shapes_are_where_the_full_ones_are(film):
    for shape, thin in zip(shapes(film.model), film.draw.coarse, strict=True):
        assert thin.faces.max() < len(thin.vertices) <= len(shape.vertices)
        for end in (np.min, np.max):
            off = end(thin.vertices, axis=0) - end(shape.vertices, axis=0)
            assert np.abs(off).max() < 1 / 256, shape.body


@pytest.mark.browser
def test_it_plays_from_disk_and_asks_nobody(page, chromium):
    playwright = pytest.importorskip("playwright.sync_api")
    with playwright.sync_playwright() as play:
        browser = play.chromium.launch(
            executable_path=chromium,
            args=["--use-gl=angle", "--use-angle=swiftshader", "--no-sandbox"],
        )
        tab = browser.new_page(viewport={"width": 480, "height": 320})
        asked, errors = [], []
        tab.on("request", lambda request: asked.append(request.url))
        tab.on("pageerror", lambda error: errors.append(str(error)))
        tab.goto(page.as_uri())
        assert tab.title() == "A turn"
        clock = tab.locator("input").first
        clock.wait_for(timeout=60_000)
        tab.wait_for_function(
            "Number(document.querySelector('input').value) > 0.5", timeout=60_000
        )
        browser.close()
    assert [url for url in asked if re.match("(?!file|data|blob)", url)] == []
    assert errors == []
