"""The worksheet's predictions: what a run writes there, and what it leaves alone."""

import re

import pytest

from conftest import ROOT, kits_worksheet
from labkit.commands.run import waiting, without_numbers
from labkit.lesson.day import all_days, find_day
from labkit.lesson.predicted import predictions, rows_asked, with_measured

HEAD = "| number | predicted | measured | why apart |\n|---|---|---|---|\n"
OPEN = "*(your number)*"


def sheet(predicted, measured, name="the sag, mm"):
    return f"{HEAD}| {name} | {predicted} | {measured} | it bends |\nThe end.\n"


@pytest.mark.parametrize("cell", [OPEN, "", "...", "17 (run of 09:59)"])
def test_a_measured_number_goes_beside_its_prediction(cell):
    after = with_measured(sheet("19", cell), {"the sag, mm": 18.57}, "14:05")
    assert after.splitlines()[2] == (
        "| the sag, mm | 19 | 18.57 (run of 14:05) | it bends |"
    )
    assert after.splitlines()[:2] == HEAD.splitlines()
    assert after.endswith("The end.\n")


@pytest.mark.parametrize(
    ("predicted", "cell", "name"),
    [
        ("19", "18.57 mm, by a ruler", "the sag, mm"),  # the student's own words
        ("19", "18.57 (run of 14:05), so it bends", "the sag, mm"),
        ("19", "18.57 (run of 09:59)", "the sag, mm"),  # the same number
        ("*(your prediction)*", OPEN, "the sag, mm"),  # it is asked first
        ("", OPEN, "the sag, mm"),
        ("19", OPEN, "another number"),
    ],
)
def test_nothing_else_is_ever_written(predicted, cell, name):
    before = sheet(predicted, cell, name)
    assert with_measured(before, {"the sag, mm": 18.57}, "14:05") == before


@pytest.mark.parametrize("value", [float("nan"), float("inf")])
def test_what_is_no_number_is_not_written(value):
    before = sheet("19", OPEN)
    assert with_measured(before, {"the sag, mm": value}, "14:05") == before


@pytest.mark.parametrize("value", [0.0, -3.2e-15, 1.5e7, 123456.0, 12])
def test_what_a_run_wrote_the_next_run_may_renew(value):
    once = with_measured(sheet("19", OPEN), {"the sag, mm": value}, "14:05")
    again = with_measured(once, {"the sag, mm": 7}, "15:05")
    assert "| 7 (run of 15:05) |" in again


def test_a_table_of_anything_else_is_no_prediction():
    assert rows_asked("| a | b |\n|---|---|\n| 1 | 2 |\n") == {}
    assert rows_asked(sheet("*(your prediction)*", OPEN)) == {"the sag, mm": ""}
    assert predictions(sheet("-", OPEN)) == {}


def test_a_verdict_is_shown_without_its_number():
    lines = [
        "4. The order matters",
        "  The distance between the two positions is 0.2434 m.",
        "  PASS  your two translations - the products: 0 (limit 1e-08)",
        "  PASS  worst at body:link7: 2.4e-15 (over 3 and under 4)",
        "  FAIL  height: 0.59 (limit 0.1)",
        "All checks PASSED.",
    ]
    both = "  PASS  your two translations - the products"
    names = [both, "  PASS  worst at body:link7"]
    kept = [without_numbers(line) for line in lines]
    assert kept == [lines[0], None, *names, *lines[4:]]


@pytest.mark.parametrize("day", all_days(), ids=lambda day: str(day.number))
def test_every_day_asks_for_three_numbers_first(day):
    asked = rows_asked(kits_worksheet(day))
    assert list(asked.values()) == ["", "", ""]
    assert waiting(day) == 3


# What a lab measures of the rows of its worksheet, as documents print it.
ANSWERS = {
    1: ("0.59", "0.243", "3.2e-15"),
    2: ("-0.0825", "rank 5"),
    3: ("3.07", "12.94", "197"),
    4: ("18.575", "103 mm", "0.039"),
    5: ("190.4", "0.195", "225.1"),
    6: ("25.000", "with 20 N", "217"),
    7: ("0.995", "0.167", "5.7 mm"),
    8: ("43 of 70", "16 g", "0.048"),
    9: ("0.0196", "4 ms", "-4.7"),
    10: ("2.3 mm", "8.9", "2 of its six"),
    11: ("0.498", "-0.307", "48 mm"),
    12: ("0.940", "0.813", "0.703"),
    13: ("135.1", "0.9615", "12.92"),
    14: ("122 g", "0.32", "384"),
}


def read_before(day):
    """Return what stands before a day's predictions, without what is folded."""
    guide = (day.folder / day.guide).read_text("utf-8")
    first = [ROOT / "README.md", day.folder / "README.md"]
    texts = [path.read_text("utf-8") for path in first]
    texts = [*texts, day.see, guide.partition("*Predictions*")[0]]
    return re.sub(r"(?s)<details>.*?</details>", "", "\n".join(texts)), guide


@pytest.mark.parametrize("day", all_days(), ids=lambda day: str(day.number))
def test_what_is_to_be_predicted_stands_nowhere_before_it_is_asked(day):
    before, guide = read_before(day)
    assert "*Predictions*" in guide
    for answer in ANSWERS[day.number]:
        assert not re.search(rf"(?<![\d.]){re.escape(answer)}", before), answer
    if day.number != 2:  # whose third is the joint's own line
        assert all(answer.split()[-1] in guide for answer in ANSWERS[day.number][:1])


@pytest.mark.kit
def test_the_kits_own_lab_shows_its_numbers_after_the_predictions(run):
    kits_worksheet(find_day(1))
    command = ("scripts/run_day.py", "1", "--kit", "--no-log")
    quiet, whole = run(*command).stdout, run(*command, "--numbers").stdout
    for number in ("0.590270", "0.2434", "e-15"):
        assert number in whole
        assert number not in quiet
    assert "3 predictions of yours go first" in " ".join(quiet.split())
    assert quiet.count("PASS") == whole.count("PASS")
