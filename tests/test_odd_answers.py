"""Mistakes that stop or change a shape; tolerances; edges of indices and truths."""

import itertools

import numpy as np
import pytest
from judged import alike, moved, redone
from toyrows import row_of, told

from labkit.judge import Finding, Matrix, Scalar, Slip, Vector
from labkit.judge.answers import capitalised
from labkit.judge.draw import Edges


class TestAMistakeThatStopsOrReshapes:
    """A weight that is transposed stops where it is not square."""

    def row(self):
        def inputs(rng):
            return [
                (rng.numbers(-2, 2, n, k), rng.numbers(-2, 2, k, m))
                for n, k, m in ((2, 3, 3), (3, 2, 4), (2, 2, 2), (4, 3, 3), (1, 2, 3))
            ]

        row = row_of(Matrix((None, None)), lambda X, W: X @ W, inputs)
        row.wrong("transposed", "W is (k, m): rows of X meet its rows", "with W^T")(
            lambda X, W: X @ W.T
        )
        row.wrong("by-one-row", "the last row is missing", "all rows but the last")(
            lambda X, W: (X @ W)[:-1]
        )
        row.wrong("by-division", "it is divided by how many of three rows are over")(
            lambda X, W: X @ W + 0 * (1 // (len(X) % 3))
        )
        return row

    def test_is_named_where_it_stops_at_some_questions(self):
        def function(X, W):
            if W.shape[0] != W.shape[1]:
                raise FloatingPointError("cannot be multiplied")
            return X @ W.T

        verdict = told(self.row(), function)
        assert verdict.mistake == "transposed"
        assert "stops with an error in 2 of 5 calls." in verdict.message
        also = "The result is also wrong in all 3 other calls."
        assert f"multiplied`. {also}" in verdict.message
        assert "W is (k, m)" in verdict.message

    def test_is_named_where_it_is_right_at_all_others(self):
        def function(X, W):
            return X @ W + 0 * (1 // (len(X) % 3))

        verdict = told(self.row(), function)
        assert verdict.mistake == "by-division"
        assert "stops with an error in 1 of 5 calls." in verdict.message
        assert "`ZeroDivisionError: " in verdict.message
        assert "with this mistake stops in the same call." in verdict.message
        other = told(self.row(), lambda X, W: X @ W if len(W) == 3 else 1 / 0)
        assert other.mistake == "raises"

    def test_is_named_where_it_changes_the_shape(self):
        verdict = told(self.row(), lambda X, W: (X @ W)[:-1])
        assert verdict.mistake == "by-one-row"
        assert "Your function returns an array of the wrong shape in" in verdict.message
        assert "with this mistake gives the same output as" in verdict.message

    def test_may_be_known_to_its_row_where_no_name_gives_it(self):
        def unnamed(case):
            rows = [int(one.any(axis=1).sum()) for one in case.S]
            return Finding("fewer", f"Your rows that are not 0: {rows[0]}.")

        row = row_of(
            Matrix((None, 2)),
            lambda n: np.ones((int(n), 2)),
            lambda rng: [(3,), (4,), (5,)],
            unnamed=unnamed,
        )
        verdict = told(row, lambda n: np.ones((2, 2)))
        assert (verdict.mistake, verdict.message) == (
            "fewer", "Your rows that are not 0: 2.",
        )  # fmt: skip

    def test_is_no_infinity_that_is_right(self):
        row = row_of(
            Vector((2,)),
            lambda x: np.array([np.inf if x > 0 else 1.0, x]),
            lambda rng: [(1.0,), (-1.0,), (-2.0,)],
        )
        assert told(row, lambda x: row.truth(x)).status == "passed"
        verdict = told(row, lambda x: row.truth(x) + np.array([0.0, 1.0]))
        assert "infinity" not in verdict.message
        verdict = told(row, lambda x: np.array([np.inf, x]))
        assert "Your function returns infinity in 2 of 3 calls." in verdict.message

    def test_is_taken_by_the_catalogues_tests(self):
        ask = self.row().ask
        found = redone(ask)
        assert [mistake.slug for mistake, _ in found] == [
            "transposed",
            "by-one-row",
            "by-division",
        ]
        assert not any(alike(a[1], b[1]) for a, b in itertools.combinations(found, 2))
        assert alike(found[0][1], found[0][1])


class TestEntriesInAnotherOrder:
    """The entries are the right ones, in all calls, and only their places are wrong."""

    @staticmethod
    def said(change, kind=None, truth=lambda X: 2.0 * X):
        def inputs(rng):
            return [(rng.numbers(-9, 9, n, k),) for n, k in ((2, 3), (3, 3), (1, 4))]

        row = row_of(kind or Matrix((None, None)), truth, inputs)
        return told(row, lambda X: change(row.truth(X))).message

    @pytest.mark.parametrize(
        ("change", "says"),
        [
            (
                np.transpose,
                "calls. All entries are correct, but the result is transposed.",
            ),
            (
                lambda Y: Y.reshape(Y.shape[::-1]),
                "All entries and their order are correct. Only the shape is wrong.",
            ),
            (
                lambda Y: Y.ravel(),
                "All entries and their order are correct. Only the shape is wrong.",
            ),
            (
                lambda Y: np.sort(Y, axis=None).reshape(Y.shape[::-1]),
                "All entries are correct, but their order is wrong in the result.",
            ),
        ],
    )
    def test_are_told_beside_the_wrong_shape(self, change, says):
        assert says in self.said(change)

    def test_are_told_of_the_result_that_has_them(self):
        kind = Scalar(called="the sum"), Matrix((None, None), called="the product")
        says = self.said(lambda Y: (Y[0], Y[1].T), kind, lambda X: (np.sum(X), 2.0 * X))
        assert "All entries are correct, but the product is transposed." in says

    def test_are_not_told_where_one_call_has_others(self):
        says = self.said(lambda Y: Y.T + (len(Y) == 1))
        assert "of the wrong shape" in says
        assert "entries" not in says
        assert "entries" not in self.said(lambda Y: 0.0 * Y.T, truth=lambda X: 0.0 * X)

    @pytest.mark.parametrize(
        ("truth", "is_told"), [(lambda X: 2.0 * X, True), (np.sign, False)]
    )
    def test_are_told_of_the_right_shape_and_of_wrong_calls_alone(self, truth, is_told):
        def inputs(rng):
            return [(rng.numbers(-9, 9, n, 2),) for n in (1, 3, 4, 3)]

        row = row_of(Matrix((None, 2)), truth, inputs)
        says = told(row, lambda X: truth(X)[np.argsort(X[:, 0])][::-1]).message
        known = "In every wrong call, the numbers are correct, but their order"
        assert (known in says) == is_told


@pytest.mark.parametrize(
    ("stops", "wrong", "says"),
    [
        (4, {1, 2}, "in the other two calls. Largest error: 1."),
        (3, {1, 2, 3}, "in all 3 other calls. Largest error: 1."),
        (3, {2, 3}, "in 2 of the other 3 calls. Largest error: 1."),
        (3, {3}, "in 1 of the other 3 calls. Largest error: 1."),
        (5, {1}, "in the other call. The result is 1.5 times the correct value."),
    ],
)
def test_the_calls_without_an_error_are_counted_by_themselves(stops, wrong, says):
    inputs = [(float(x),) for x in range(1, 7)]
    row = row_of(Scalar(), lambda x: 2.0 * x, lambda rng: inputs)

    def function(x):
        if x > 6 - stops:
            raise ZeroDivisionError
        return 2.0 * x + (x in wrong)

    message = told(row, function).message
    assert message.startswith("Your function stops with an error in")
    assert message.endswith(f"`ZeroDivisionError`. The result is also wrong {says}")


def test_nothing_is_said_of_every_call_where_some_calls_stop():
    inputs = [(float(x),) for x in range(1, 7)]
    row = row_of(Scalar(), lambda x: 2.0 * x, lambda rng: inputs)

    def function(x):
        if x > 4:
            raise ZeroDivisionError
        return 3.0 * x

    message = told(row, function).message
    assert message.endswith(
        "The result is also wrong in all 4 other calls. The result is 1.5 times the "
        "correct value in these calls."
    )


@pytest.mark.parametrize(
    ("right", "mine", "says"),
    [
        (np.inf, np.nan, "returns NaN in 2 of 4 calls; expected infinity."),
        (np.inf, -np.inf, "returns -infinity in 2 of 4 calls; expected infinity."),
        (-np.inf, np.nan, "returns NaN in 2 of 4 calls; expected -infinity."),
        (1.0, -np.inf, "returns -infinity in 2 of 4 calls."),
    ],
)
def test_an_infinity_that_is_right_is_said_to_be_expected(right, mine, says):
    inputs = [(float(x),) for x in (-1, 2, -3, 4)]
    row = row_of(Scalar(), lambda x: right if x < 0 else x, lambda rng: inputs)
    verdict = told(row, lambda x: mine if x < 0 else x)
    assert verdict.message.startswith(f"Your function {says}")


def test_the_infinite_result_of_several_is_named():
    kind = (Scalar(called="the rank"), Scalar(called="the limit"))
    inputs = [(float(x),) for x in (-1, 2, -3, 4)]
    row = row_of(kind, lambda x: (x, np.inf if x < 0 else x), lambda rng: inputs)
    message = told(row, lambda x: (x, np.nan if x < 0 else x)).message
    assert message.startswith(
        "Your function returns NaN for the limit in 2 of 4 calls; expected infinity."
    )


def test_a_number_where_an_infinity_is_expected_is_off_by_no_number():
    inputs = [(float(x),) for x in (-1, 2, -3, 4)]
    row = row_of(Scalar(), lambda x: np.inf if x < 0 else x, lambda rng: inputs)
    message = told(row, lambda x: x * x + 3.0 if x < 0 else x).message
    assert "The result is wrong in 2 of 4 calls. Largest error: infinite." in message


class TestATolerance:
    def row(self, **more):
        inputs = [(float(x),) for x in (1.0, 20.0, 300.0, 5.0)]
        return row_of(Scalar(), lambda x: 2.0 * x, lambda rng: inputs, **more)

    def test_may_be_a_share_of_the_answer(self):
        def off(x):
            return 2.0 * x * 1.009

        assert told(self.row(), off).status == "wrong"
        assert told(self.row(rtol=0.01), off).status == "passed"
        assert told(self.row(rtol=0.005), off).status == "wrong"

    def test_is_told_where_it_is_measured(self):
        verdict = told(self.row(rtol=0.005), lambda x: 2.1 * x)
        assert "+ 0.005 of the largest entry" in verdict.measured[0]


def test_edges_of_a_whole_number_are_the_first_and_the_last():
    rng = Edges(5)
    drawn = {int(rng.integers(2, 8)) for _ in range(40)}
    assert drawn == {2, 4, 7}
    assert {bool(rng.integers(2)) for _ in range(20)} == {True, False}
    assert set(rng.integers(0, 5, 40, endpoint=True).tolist()) == {0, 2, 5}


def test_a_truth_value_and_an_index_are_no_edge_that_moves():
    for column in (np.array([True, False]), np.array([1, 2])):
        assert moved(column, 1e-12) is column
    several = np.empty(3, dtype=object)
    several[:] = [np.ones(2), np.array([True]), 0.5]
    near = moved(several, 0.25)
    assert near[0].tolist() == [1.25, 1.25]
    assert near[1].tolist() == [True]
    assert near[2] == 0.75


@pytest.mark.parametrize(
    ("clause", "sentence"),
    [
        ("dY is cut at 0", "dY is cut at 0"),
        ("the weights are cut", "The weights are cut"),
        ("qd is 0", "qd is 0"),
    ],
)
def test_a_sentence_that_begins_with_a_symbol_keeps_it(clause, sentence):
    assert capitalised(clause) == sentence


def test_an_exception_with_words_of_its_own_is_counted_where_other_calls_are_wrong():
    slip = Slip("ZeroDivisionError", "", "at-0", "Your code divides by 0.")
    inputs = [(float(x),) for x in range(1, 7)]
    row = row_of(Scalar(), lambda x: 2.0 * x, lambda rng: inputs, slips=(slip,))

    def function(x):
        if x > 4:
            raise ZeroDivisionError
        return x * x + 1.0

    assert told(row, function).message.startswith(
        "Your code divides by 0. Your function stops with an error in 2 of 6 calls. "
        "The result is also wrong in 3 of the other 4 calls. Largest error: 9."
    )
