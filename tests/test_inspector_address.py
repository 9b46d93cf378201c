"""A configuration in the page's address."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from labkit.inspector import address

pytestmark = pytest.mark.kit


@given(st.lists(st.floats(-100, 100), min_size=7, max_size=7))
def test_every_digit_of_a_configuration_survives(q):
    query = address.write(np.array(q), "link4", "Chain")
    back, frame, tab = address.read(query, 7)
    np.testing.assert_array_equal(back, q)
    assert (frame, tab) == ("link4", "Chain")


@pytest.mark.parametrize(
    "query",
    ["", "?", "?q=", "?q=1,2", "?q=a,b,c,d,e,f,g", "?q=nan,0,0,0,0,0,0",
     "?q=1e300,0,0,0,0,0,0", "?q=inf,0,0,0,0,0,0", "%%%", "?q=" + "0," * 10_000],
)  # fmt: skip
def test_an_address_that_leads_nowhere_leaves_the_arm_where_it_is(query):
    assert address.read(query, 7)[0] is None
