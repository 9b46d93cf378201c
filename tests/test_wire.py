"""What a function may return: one list, in the sandbox and in the catalogue's tests."""

import json

import inprocess
import numpy as np
import pytest

from labkit.base.exchange import Exchange, Question
from labkit.judge.answers import grouped
from labkit.sandbox.inside import wire

ROWS = [np.arange(3.0), np.ones(3)]
SENT = {
    "True": True,
    "np.True_": np.True_,
    "5": 5,
    "2.0": 2.0,
    "np.int64(5)": np.int64(5),
    "np.float32(0.5)": np.float32(0.5),
    "np.float64('nan')": np.float64("nan"),
    "-np.inf": -np.inf,
    "'advanced'": "advanced",
    "None": None,
    "np.zeros((0, 2))": np.zeros((0, 2)),
    "np.arange(3)": np.arange(3),
    "np.array(1.5)": np.array(1.5),
    "np.array([True, False])": np.array([True, False]),
    "()": (),
    "[]": [],
    "(2, 3)": (2, 3),
    "(0.5, np.ones(2))": (0.5, np.ones(2)),
    "(1, np.ones(2), False)": (1, np.ones(2), False),
    "((0.5, np.ones(2)), 3.0)": ((0.5, np.ones(2)), 3.0),
    "(None, 'a', True)": (None, "a", True),
    "[[1.0, 2.0], [3.0, 4.0]]": [[1.0, 2.0], [3.0, 4.0]],
    "[True, False]": [True, False],
    "[np.arange(3.0), np.ones(3)]": ROWS,
    "[1, np.ones(2)]": [1, np.ones(2)],
    "[[1, 2], [3]]": [[1, 2], [3]],
    "[['a', None], [0.5]]": [["a", None], [0.5]],
    "([np.arange(3.0), np.ones(3)], [1, 2])": (ROWS, [1, 2]),
    "tuple(map(float, range(150)))": tuple(map(float, range(150))),
}


def same(a, b):
    """Return whether two values are one, of the same types."""
    if type(a) is not type(b):
        return False
    if isinstance(a, tuple | list):
        return len(a) == len(b) and all(map(same, a, b))
    if isinstance(a, np.ndarray | np.generic):
        if a.dtype != b.dtype:
            return False
        return np.array_equal(a, b, equal_nan=a.dtype.kind == "f")
    return bool(a == b)


@pytest.mark.parametrize("value", SENT.values(), ids=SENT)
def test_what_is_sent_arrives_as_it_was(value):
    packed = json.loads(json.dumps(wire.pack_value(value)))
    assert same(wire.unpack_value(packed), value)


@pytest.mark.kit
def test_the_sandbox_and_the_catalogues_tests_bring_the_same(ask, tmp_path):
    body = "".join(f"def f{i}(): return {one}\n" for i, one in enumerate(SENT))
    code = f"import numpy as np\n{body}"
    questions = [Question("1.1", f"f{i}", ()) for i in range(len(SENT))]
    for reply, value in zip(ask(code, *questions), SENT.values(), strict=True):
        assert reply.kind == ""
        assert same(reply.value, value)
        assert same(reply.again, value)
    file = tmp_path / "script.py"
    file.write_text(code)
    exchanges = [Exchange(question) for question in questions]
    inprocess.InProcess().run(file, exchanges, {})
    for exchange, value in zip(exchanges, SENT.values(), strict=True):
        assert same(exchange.reply.value, value)


@pytest.mark.kit
def test_arrays_in_a_tuple_are_each_calls_own_and_a_change_of_one_is_told(
    ask, tmp_path
):
    code = """
def f(some):
    some[0][0] += 1.0
    return some[0].copy()
"""
    question = Question("1.1", "f", grouped([(np.zeros(2), np.ones(2))]))
    file = tmp_path / "script.py"
    file.write_text(code)
    exchange = Exchange(question)
    inprocess.InProcess().run(file, [exchange], {})
    (reply,) = ask(code, question)
    for one in (reply, exchange.reply):
        assert one.value.tolist() == one.again.tolist() == [1.0, 0.0]
        assert one.changed == ("some",)
    assert question.args[0][0].tolist() == [0.0, 0.0]


@pytest.mark.kit
def test_arguments_arrive_as_they_were_given(ask):
    code = """
        def f(*args):
            return ", ".join(type(arg).__name__ for arg in args)
    """
    given = (True, 2, 0.5, np.int64(3), "red", None, (1, 2), [0.5], np.ones(2))
    (reply,) = ask(code, Question("1.1", "f", given))
    assert reply.value == (
        "bool, int, float, int64, str, NoneType, tuple, list, ndarray"
    )


@pytest.mark.parametrize(
    "forged",
    [
        {"number": "1"},
        {"number": [1]},
        {"number": 1, "dtype": "O"},
        {"number": 2**70},
        {"text": 5},
        {"tuple": [{"tuple": [{"tuple": []}]}]},
        {"tuple": [{"number": 1}] * 101},
        {"list": 5},
        {"rows": {"dtype": "f8", "shape": [1], "data": "AAAAAAAAAAA="}, "levels": 9},
        {"rows": {"dtype": "f8", "shape": [1], "data": "AAAAAAAAAAA="}, "levels": "1"},
        "text",
        {},
    ],
    ids=str,
)
def test_what_nobody_packed_is_refused(forged):
    with pytest.raises(ValueError, match="not "):
        wire.unpack_value(forged)
