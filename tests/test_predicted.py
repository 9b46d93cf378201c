"""The worksheet's predictions: what a run writes there, and what it leaves alone."""

import re

import pytest

from conftest import ROOT, copy_kit, keep_first_day, kits_worksheet, run_copy
from labkit.lesson.day import all_days, find_day
from labkit.lesson.hidden_numbers import HiddenNumber, Output, without
from labkit.lesson.predictions import predictions, rows_asked, with_measured

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


OUTPUT = """\
1. Rank 5 of step 1 is a heading
  the screws have rank 5; q = 5, seed 5 of 5, link5, 0.500 m, 15, 1e-05
      0.590270   0.1000
2. Order matters
  rank (omega; v)        5   5.2
  height 590.3 mm, or 0.59 m; predicted 0.6 m
  PASS  worst: 0.5903 (limit 1e-08)
  FAIL  height: 0.5903 (limit 0.1)
  height of ee, m: hidden until you write 0.5903
  held 15 of 60, 25 of 61; 0.25
3. The end
  5 more
All checks PASSED: 0.590270
"""
SAYS = "  height of ee, m: hidden until you write 0.5903"


def test_a_number_is_hidden_wherever_it_is_printed():
    at = OUTPUT.index("2. Order")
    hidden = [HiddenNumber(5.0, at), HiddenNumber(0.59027, at), HiddenNumber(0.25, at)]
    lines = without(OUTPUT, hidden, {SAYS}).splitlines()
    before = OUTPUT.splitlines()
    assert lines[:2] == before[:2]  # a short number before the step that measures it
    assert lines[2] == "      (hidden)   0.1000"
    assert lines[4].split()[3:] == ["(hidden)", "(hidden)"]  # 5.2 is as good as 5
    assert lines[5] == "  height (hidden) mm, or (hidden) m; predicted (hidden) m"
    assert lines[6] == "  PASS  worst: (hidden) (limit 1e-08)"
    assert lines[7:9] == before[7:9]
    assert lines[9] == "  held (hidden) of 60, 25 of 61; (hidden)"
    assert lines[11] == "  (hidden) more"
    assert lines[12] == before[12]


def test_a_zero_is_hidden_in_its_step_and_one_digit_is_no_fraction():
    text = "1. a\n  0.0 and 1 of 2\n2. b\n  0.0  0.9703  1  2\n"
    hidden = [HiddenNumber(0.0, 0), HiddenNumber(0.9703, text.index("2. b") + 1)]
    assert without(text, hidden).splitlines()[1::2] == [
        "  (hidden) and 1 of 2",
        "  0.0 (hidden)  1  2",
    ]


def test_a_short_number_of_the_other_sign_is_not_the_hidden_one():
    text = "1. a\n  2.0, -0.2 and 0.2\n"
    assert without(text, [HiddenNumber(0.209, 0)]) == "1. a\n  2.0, -0.2 and (hidden)\n"
    both = "1. a\n  2.0, (hidden) and (hidden)\n"
    assert without(text, [HiddenNumber(-0.209, 0)]) == both


LABEL = "shift of the puck, camera off by 10 mm, mm"


@pytest.mark.parametrize(
    ("line", "shown"),
    [
        ("  10 mm    10 mm", "10 mm (hidden) mm"),  # the label names one of them
        ("  -10 mm    10 mm", "-10 mm (hidden) mm"),
        ("  10 mm    9.69 mm", "10 mm (hidden) mm"),  # here with all its digits
        ("  10 mm    9.7 mm", "10 mm (hidden) mm"),
        ("  about 10 of 60", "  about (hidden) of 60"),
    ],
)
def test_a_line_about_a_hidden_number_shows_no_rounding_of_it(line, shown):
    first, last = "  10 mm   30 mm", "  30 mm   10 mm"
    text = f"1. a\n{first}\n{line}\n"
    hidden = HiddenNumber(9.694, len(text), LABEL)
    after = without(f"{text}{last}\n", [hidden]).splitlines()
    assert [words.split() for words in after[1:]] == [
        words.split() for words in (first, shown, last)
    ]
    named = f"  {LABEL}: about 10"
    (_, *after) = without(f"{text}{named}\n", [hidden]).splitlines()
    assert after[-1] == f"  {LABEL}: about (hidden)"


def test_a_lab_that_stops_early_shows_no_number(capsys):
    output = Output({"the sag, mm", "the rest"})
    print("1. A step of 3\n  0.1 and 7 mm\n  FAIL  it: 0.2")
    output.hide("the sag, mm", 18.57, "  the sag, mm: hidden")
    assert capsys.readouterr().out == ""
    output.release()
    output.release()
    assert capsys.readouterr().out == (
        "1. A step of 3\n  (hidden) and (hidden) mm\n  FAIL  it: 0.2\n"
        "  the sag, mm: hidden\n"
    )


@pytest.mark.parametrize("day", all_days(), ids=lambda day: str(day.number))
def test_every_day_asks_for_three_numbers_or_more_first(day):
    asked = rows_asked(kits_worksheet(day))
    assert len(asked) >= 3
    assert set(asked.values()) == {""}


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
    15: ("130.6", "1.409"),
    16: ("0.38", "0.90 nats", "0.27"),
    17: ("0.364", "0.612", "0.617"),
    18: ("5.36", "0.82"),
    19: ("0.929", "0.215", "2.259"),
    20: ("2.19", "14.3 mm"),
    21: ("8.13", "18.1", "27.1"),
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
@pytest.mark.parametrize("number", [1, 9])
def test_the_kits_own_lab_shows_its_numbers_after_the_predictions(run, number):
    kits_worksheet(find_day(number))
    command = ("scripts/run_day.py", str(number), "--kit", "--no-log")
    quiet, whole = run(*command).stdout, run(*command, "--reveal").stdout
    measured = {1: ("0.590270", "0.2434", "3.2e-15"), 9: ("0.0196", "ms: 4", "-4.709")}
    for answer in measured[number]:
        assert answer in whole
        assert answer not in quiet
    assert "3 predictions of yours are missing" in " ".join(quiet.split())
    assert quiet.count("PASS") == whole.count("PASS")
    assert " ".join(quiet.split()).count("hidden until you write your prediction") == 3


@pytest.mark.kit
def test_ones_own_lab_hides_a_number_until_it_is_predicted(tmp_path):
    clone = keep_first_day(copy_kit(tmp_path / "clone"))
    day = find_day(1, clone)
    sheet = day.folder / day.worksheet
    sheet.write_text(kits_worksheet(find_day(1)), "utf-8")
    day.work.parent.mkdir()
    day.work.write_text(day.source.read_text("utf-8"), "utf-8")
    first, revealed, whole = (
        run_copy(clone, "scripts/run_day.py", "1", *options).stdout
        for options in ((), ("--reveal",), ("--kit", "--reveal", "--no-log"))
    )
    assert "0.590270" not in first
    assert "0.2434" not in first
    assert revealed.count("0.590270") == whole.count("0.590270") == 4
    rows = (clone / "metrics/metrics.csv").read_text().splitlines()[1:]
    written = [row.split(",")[1:] for row in rows]
    assert len(written) == 4
    assert written[:2] == written[2:]  # recorded as ever
    text = sheet.read_text("utf-8").replace("*(your prediction)*", "0.6", 1)
    sheet.write_text(text, "utf-8")
    second = run_copy(clone, "scripts/run_day.py", "1", "--no-log").stdout
    assert "you predicted 0.6, measured 0.5903" in second
    assert second.count("0.590270") == 4
    assert "0.2434" not in second
    begun = day.source.read_text("utf-8").replace(
        "    T = np.eye(4)", "    raise NotImplementedError('task 1.1')", 1
    )
    day.work.write_text(begun, "utf-8")
    done = run_copy(clone, "scripts/run_day.py", "1", "--no-log")
    assert "to do: task 1.1" in done.stderr
    assert done.returncode == 1
    assert not re.search(r"\d\.\d", done.stdout.partition("1. What")[2])
