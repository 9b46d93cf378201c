"""The picture of predictions: a dot and a ring each, and the same in words."""

import re
from dataclasses import replace
from xml.etree import ElementTree

import pytest
from test_proof import EVIL, a_clone, hostile

from labkit.commands import report as report_command
from labkit.grade.roster import Student
from labkit.lesson.day import find_day
from labkit.proof import page as proof_page
from labkit.proof.facts import facts_of
from labkit.report import page as report_page
from labkit.report.prediction_plot import draw
from labkit.report.prediction_values import compared, value_of
from labkit.report.series import collect, series_of
from labkit.sandbox.sandbox import Sandbox

pytestmark = pytest.mark.kit

TITLES = "| number | predicted | measured | why |\n|---|---|---|---|\n"
HEAD = f"# Day\n\n## Predictions\n\n{TITLES}"
OPEN = "*(your number)*"


def sheet(*rows, head=HEAD):
    lines = (f"| {name} | {said} | {came} | why |" for name, said, came in rows)
    return head + "\n".join(lines) + "\n\n## Can you explain?\n"


def marks(text):
    """Return the places of the dots and of the rings, without those of the legend."""
    circles = [c for c in ElementTree.fromstring(text).iter() if c.tag == "circle"]
    found = {"dot": [], "ring": []}
    for circle in circles[2:]:
        found[circle.get("class")].append(float(circle.get("cx")))
    return found["dot"], found["ring"]


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("about 40 mm", 40),
        ("-0.55", -0.55),
        ("−3", -3),
        ("0,25", 0.25),
        ("0,125", 0.125),
        ("1,000", 1000),
        ("-1,250,000", -1.25e6),
        ("2e-3 m", 0.002),
        ("10^-12", 1e-12),
        ("3 * 10^-4", 3e-4),
        ("20 N/m^2", 20),
        ("50 %", 0.5),
        ("5 to 10", None),
        ("5-10", None),
        ("2/3", None),
        ("pi/2", None),
        ("3 * sqrt(2)", None),
        ("5 m or 7", None),
        ("it falls", None),
        ("1e999", None),
    ],
)
def test_a_prediction_is_a_number_only_where_it_is_exactly_one(text, value):
    assert value_of(text) == (value if value is None else pytest.approx(value))


@pytest.mark.parametrize(
    ("cell", "measured"),
    [
        ("18.57 (run of 14:05)", "18.57"),
        ("19 mm, by a ruler", "19 mm, by a ruler"),
        (OPEN, ""),
        ("", ""),
    ],
)
def test_a_prediction_is_compared_with_what_a_run_or_the_student_wrote(cell, measured):
    row = ("the sag, mm", "20", cell)
    assert compared(sheet(row)) == [("the sag, mm", "20", measured)]
    assert compared(sheet(row).replace("Predictions", "Another table")) == []
    assert compared(sheet(("the sag, mm", "*(your prediction)*", cell))) == []


def test_a_prediction_that_came_true_is_a_dot_in_its_ring():
    (dot,), (ring,) = marks(draw(sheet(("the sag, mm", "19", "19 (run of 14:05)"))))
    assert dot == ring


@pytest.mark.parametrize(
    ("said", "came", "first"),
    [
        ("10", "19", "dot"),
        ("30", "19", "ring"),
        ("-3", "3", "dot"),  # a wrong sign
        ("0", "3", "dot"),
        ("1e-15", "1e-3", "dot"),
        ("1e-320", "1.7e308", "dot"),
        ("-1.7e308", "1.7e308", "dot"),
    ],
)
def test_the_smaller_number_stands_left_on_the_scale(said, came, first):
    (dot,), (ring,) = marks(draw(sheet(("x, m", said, came))))
    assert (dot < ring) == (first == "dot")
    assert all(0 < place < 360 for place in (dot, ring))


def test_far_numbers_are_compared_in_decades_and_near_ones_from_zero():
    (dot,), (ring,) = marks(draw(sheet(("x, m", "50", "100"))))
    assert dot == pytest.approx(180, abs=1)  # half way from 0
    (dot,), (ring,) = marks(draw(sheet(("x, m", "1e-6", "1"))))
    assert (dot, ring) == (18, 342)


def test_words_and_open_cells_have_no_mark_and_the_alternative_text_has_all():
    picture = draw(sheet(("the arm", "it falls", "3.2"), ("the hand, mm", "7", OPEN)))
    assert [len(some) for some in marks(picture)] == [1, 1]
    says = ElementTree.fromstring(picture).get("aria-label")
    assert "the arm: predicted it falls, measured 3.2." in says
    assert "the hand, mm: predicted 7, not measured yet." in says


@pytest.mark.parametrize("text", ["", HEAD, sheet(("x", "*(your prediction)*", "3"))])
def test_a_worksheet_without_a_prediction_has_no_picture(text):
    assert draw(text) == ""


def test_long_text_stays_inside_and_nothing_from_a_worksheet_becomes_a_tag():
    picture = draw(sheet((f"{EVIL} " * 9, EVIL * 3, EVIL), ("x" * 300, "1" * 300, "2")))
    seen = ElementTree.fromstring(picture)
    assert {node.tag for node in seen.iter()} == {"svg", "text", "circle", "path"}
    assert max(len(node.text or "") for node in seen.iter()) < 110


def test_the_report_and_the_proof_show_it_for_a_day_that_has_predictions():
    text = sheet(("the sag, mm", "19", "18.57"))
    day = find_day(1)
    series = series_of(day, [])
    with_it = report_page.render(collect([], series), "rows", sheets={1: text})
    assert draw(text) in with_it
    assert "Predicted and measured" not in report_page.render(collect([], series), "")
    proof = hostile()
    assert "Predicted and measured" not in proof_page.render(proof)
    days = [replace(proof.days[0], worksheet=text)]
    shown = proof_page.render(replace(proof, days=days))
    assert draw(text) in shown
    assert re.search("<h3>Day 1</h3><svg", shown)


def test_a_proof_reads_the_worksheet_of_the_clone_and_a_report_ones_own(tmp_path):
    day = find_day(1)
    someone = Student("Ada", "of", a_clone(tmp_path / "of", own=""))
    file = someone.path / day.files["worksheet"]
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_bytes(sheet(("the sag, mm", "19", "18.57")).encode() + b"\xff")
    (tmp_path / "files").mkdir()
    with Sandbox() as sandbox:
        found = facts_of(day, someone, tmp_path / "files", sandbox)
    assert marks(draw(found.worksheet))[0]
    assert "## Predictions" in report_command.worksheet_of(day)
    assert report_command.worksheet_of(replace(day, worksheet="nowhere.md")) == ""
    assert report_command.worksheet_of(replace(day, worksheet="")) == ""
