"""One file, one grade: what a file draws is the same in every process."""

import random

import numpy as np
import pytest

from labkit.base.exchange import Question

SOURCES = (
    "os.urandom(8)[0]",
    "secrets.randbits(30)",
    "secrets.token_bytes(4)[0]",
    "random.random()",
    "random.Random().random()",
    "random.SystemRandom().random()",
    "np.random.default_rng().random()",
    "np.random.random()",
    "np.random.SeedSequence().entropy % 2**40",
    "uuid.uuid4().int % 2**40",
)
FILE = "import os, random, secrets, sys, uuid\nimport numpy as np\n"


@pytest.mark.parametrize("source", SOURCES)
def test_a_coin_that_is_kept_in_sys_falls_alike_in_every_process(ask, source):
    code = f"""{FILE}
if not hasattr(sys, "coin"):
    sys.coin = float({source})
def f(): return sys.coin
"""
    (one,), (other,) = ask(code), ask(code)
    assert one.value == other.value


@pytest.mark.parametrize("source", SOURCES)
def test_two_calls_still_draw_different_numbers(ask, source):
    code = f"{FILE}\ndef f(): return [float({source}) for _ in range(4)]\n"
    first, second = ask(code, Question("1.1", "f", ()), Question("1.1", "f", ()))
    assert len({*map(float, first.value), *map(float, second.value)}) > 4
    assert list(first.value) != list(first.again)


def test_a_seed_of_ones_own_gives_what_it_always_gives(ask):
    code = f"""{FILE}
def f(): return [random.Random(47).random(), np.random.default_rng(47).random()]
"""
    (reply,) = ask(code)
    right = [random.Random(47).random(), np.random.default_rng(47).random()]
    assert list(reply.value) == right
