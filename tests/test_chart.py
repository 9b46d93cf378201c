"""The style of drawn pictures: it is theirs alone, and a phone can show it."""

import os

import pytest

if not os.environ.get("ROBO47_CI"):
    pytest.importorskip("matplotlib", reason="needs matplotlib: make figures")
import matplotlib

from labkit.figures import chart


@chart.picture(height=3.0)
def drawn(figure, words):
    axes = figure.subplots()
    chart.blank(axes)
    chart.arrow(axes, (0, 0), (1, 1), chart.RED)
    assert axes.text(0, 0, words).get_fontsize() == chart.FONT


def test_what_draws_on_a_figure_returns_an_image_of_the_one_width():
    before = matplotlib.rcParams["font.size"]
    assert drawn("words").size == (1200, 450)
    assert matplotlib.rcParams["font.size"] == before


def test_the_smallest_text_is_eight_pixels_high_where_a_phone_shows_it():
    pixels = chart.SMALL / 72 * chart.DPI
    assert pixels * 358 / (chart.WIDTH * chart.DPI) > 8  # 390 wide, with margins
