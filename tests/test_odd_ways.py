"""Whatever a function returns, the checker has a verdict on it."""

import pytest
from inprocess import worked_out_once
from odd_ways import judged, soak, some_of
from whole import changed

from conftest import days

pytestmark = pytest.mark.kit

SAMPLE, FEW = 12, 4  # ways of a day that changed, of another; all come at night


@pytest.mark.filterwarnings("ignore")  # of the altered functions themselves
@pytest.mark.parametrize("day", days(), ids=lambda day: f"day{day.number}")
def test_some_odd_answers_of_each_day_have_a_verdict(day):
    with worked_out_once():
        for odd in some_of(day, SAMPLE if changed(day) else FEW):
            verdict = judged(odd)
            assert verdict.status in ("passed", "wrong", "close", "todo"), odd
            assert verdict.mistake != "unjudged", odd
            assert verdict.status == "passed" or verdict.message, odd


@pytest.mark.soak
@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("day", days(), ids=lambda day: f"day{day.number}")
def test_all_odd_answers_of_each_day_have_a_verdict(day):
    assert soak(day) == 0
