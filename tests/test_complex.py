"""Complex arguments: they travel, and a function that loses a part of them is told."""

import numpy as np
import pytest
from judged import round_of

from labkit.base.exchange import Question, Reply
from labkit.judge import Ask, HeldOut, Matrix
from labkit.judge.answers import InTurn
from labkit.judge.failing_call import failing_call
from labkit.judge.judge import judge
from labkit.sandbox.inside import wire

SAYS = "Your function loses the imaginary part."


def inputs(rng):
    """Yield two matrices of real numbers."""
    for n in (1, 3):
        yield (rng.numbers(-1, 1, n, 2),)


def complex_ones(rng):
    """Yield one of complex numbers."""
    yield (rng.numbers(-1, 1, 2, 2) + 1j * rng.numbers(-1, 1, 2, 2),)


ASK = Ask(
    inputs,
    Matrix((None, None)),
    truth=InTurn(np.tanh),
    held_out=[HeldOut("imaginary-lost", SAYS, complex_ones)],
)


def verdict(function):
    """Return the verdict on a function, and the call that is shown."""
    asked = round_of(ASK)
    for one in asked.exchanges:
        value = function(*one.question.args)
        one.reply = Reply(value=value, again=value)
    return judge(asked), failing_call(asked)


def test_who_keeps_both_parts_is_right():
    found, _ = verdict(np.tanh)
    assert found.status == "passed"


@pytest.mark.parametrize("part", [np.real, np.abs])
def test_who_loses_one_is_told_and_no_call_in_pairs_is_shown(part):
    lossy = lambda x: np.tanh(part(x) if np.iscomplexobj(x) else x)  # noqa: E731
    found, call = verdict(lossy)
    assert (found.status, found.mistake) == ("wrong", "imaginary-lost")
    assert SAYS in found.message
    assert call.call == ""


def test_who_has_the_wrong_imaginary_part_is_told():
    found, _ = verdict(lambda x: np.conj(np.tanh(x)))
    assert found.mistake == "imaginary-lost"


def test_complex_numbers_travel_and_come_back():
    array = np.array([[1 + 2j, -3e-20j]])
    again = wire.unpack_value(wire.pack_value(array))
    assert again.dtype == complex
    assert (again == array).all()


def test_a_complex_answer_to_a_real_question_is_refused_as_before(ask):
    given = np.ones(2), np.array([1 + 1j])
    real, pairs = ask(
        "def f(x): return x * 1j", *(Question("1.1", "f", (x,)) for x in given)
    )
    assert "dtype complex128" in real.error
    assert pairs.value == [1j - 1]
