"""Text of others, made fit to be shown."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from labkit.base import html
from labkit.base.text import blocks, count, refill, visible, visible_lines


class TestVisible:
    @pytest.mark.parametrize(
        ("text", "shown"),
        [
            ("a plain sentence: 3.5 m", "a plain sentence: 3.5 m"),
            ("\x1b[2J\x07 cleared", "[2J  cleared"),
            ("one\r\ntwo\x85three\u2028four", "one  two three four"),
            ("\u202egnp.exe", "gnp.exe"),
            ("zero\u200bwidth", "zero width"),
            ("half \ud800 a pair", "half ? a pair"),
            ("naïve β 手 😀", "naïve β 手 😀"),
            (47, "47"),
            (None, "None"),
        ],
    )
    def test_shows_what_can_be_shown(self, text, shown):
        assert visible(text) == shown

    def test_cuts_what_is_long(self):
        assert visible("x" * 10**7, 20) == "x" * 20 + "..."
        assert visible("x" * 20, 20) == "x" * 20

    @given(st.text(st.characters(), max_size=80))
    def test_is_one_printable_line_that_utf_8_can_write(self, text):
        shown = visible(text, 40)
        assert len(shown) <= 43
        assert len(shown.splitlines()) <= 1
        assert shown.encode("utf-8").decode("utf-8") == shown
        assert visible(shown, 60) == shown

    def test_keeps_lines_apart_where_it_may(self):
        assert visible_lines("one\n\x1b[31mtwo\r\nthree") == "one\n[31mtwo\nthree"
        assert len(visible_lines("x\n" * 10**6, lines=3)) == 5


def test_no_page_holds_what_a_reader_would_obey_and_not_see():
    odd = "\x00\x07\x1b\x7f\x85\u202e\u2066\ud800 \u2028"
    whole = html.page("title", f"about{odd}", f"<p>a{odd}b</p>\nnext")
    assert not set(odd) - {" "} & set(whole)
    assert "<p>a          b</p>\nnext" in whole
    whole.encode("utf-8")


def test_a_count_agrees_with_its_noun():
    assert [count(n, "row") for n in (0, 1, 1000)] == ["0 rows", "1 row", "1,000 rows"]


@pytest.mark.parametrize("opening", ["<!-- numbers -->\n", "<!-- numbers: x "])
def test_openings_that_nobody_closes_are_text_and_cost_nothing(opening):
    many = opening * 10_000  # minutes, were each followed to the end
    whole = f"<!-- numbers -->\nold\n<!-- end -->{many}"
    assert blocks(many, "numbers") == []
    assert blocks(whole, "numbers") == ["old\n"]
    assert refill(whole, {"numbers": lambda *_: "new\n"}) == whole.replace("old", "new")
