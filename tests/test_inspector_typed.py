"""A configuration as people type it into the page, and in its address."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from labkit.inspector import typed
from labkit.inspector.typed import configuration, number

pytestmark = pytest.mark.kit


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("0.5", 0.5),
        (" -1e-3 ", -1e-3),
        ("pi/2", math.pi / 2),
        ("-3*pi/4", -3 * math.pi / 4),
        ("π", math.pi),
        ("−0.5", -0.5),
        ("90 deg", math.pi / 2),
        ("90°", math.pi / 2),
        ("-45 degrees", -math.pi / 4),
        ("(1 + 2)/4", 0.75),
    ],
)
def test_a_number_is_read_as_it_is_meant(text, value):
    assert number(text) == pytest.approx(value, abs=1e-15)


@pytest.mark.parametrize(
    "text",
    [
        "", "x", "1,5", "nan", "inf", "1/0", "1e999", "2**9", "__import__('os')",
        "'pi'", "[1]", "1 if 1 else 2", "9" * 100, "(" * 50, "1j", "deg", "lambda: 1",
        "\x00", "pi()", "pi.real",
    ],
)  # fmt: skip
def test_what_is_no_number_is_refused_with_an_example(text):
    with pytest.raises(ValueError, match=r"is no number; write 0\.5, pi/2 or 90 deg"):
        number(text)


@given(st.floats(-1e6, 1e6))
def test_every_digit_of_a_float_arrives(value):
    assert number(repr(value)) == value


def test_degrees_without_their_unit_are_refused_and_the_unit_is_named():
    with pytest.raises(ValueError, match=r"90 rad is over a turn.* write: 90 deg"):
        configuration("0, 90", 2)
    assert configuration("0, 90 deg", 2) == [0.0, math.pi / 2]


@pytest.mark.parametrize(
    "text", ["1, 2", "[1, 2]", "np.array([1.0, 2.0])", " [1,\n2] "]
)
def test_a_configuration_is_read_as_one_types_it_and_as_numpy_prints_it(text):
    assert configuration(text, 2) == [1.0, 2.0]


@pytest.mark.parametrize("text", ["", "1", "1, 2, 3", "1 2", "[1, x]"])
def test_what_is_no_configuration_is_refused(text):
    with pytest.raises(ValueError, match=r"numbers; a configuration|is no number"):
        configuration(text, 2)


@given(st.lists(st.floats(-100, 100), min_size=7, max_size=7))
def test_every_digit_of_a_configuration_survives(q):
    query = typed.write_address(np.array(q), "link4", "Chain")
    back, frame, tab = typed.read_address(query, 7)
    np.testing.assert_array_equal(back, q)
    assert (frame, tab) == ("link4", "Chain")
