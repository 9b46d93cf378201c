"""A toy row of each kind of answer: a right function, a wrong one, no answer at all."""

import re

import numpy as np
import pytest
from toyrows import explained, row_of, told

from labkit.judge import (
    Covariance,
    Index,
    Mask,
    Matrix,
    Pixels,
    Row,
    Scalar,
    Vector,
    Waypoints,
    Word,
)
from robo47.errors import Robo47Error

WORDS = ("reached", "advanced", "trapped")


class TestAnIndex:
    """The nearest of some numbers."""

    def row(self):
        def inputs(rng):
            return [(rng.numbers(-9, 9, n), 0.5) for n in (3, 5, 4, 6, 3)]

        row = row_of(Index(called="the place"), self.nearest, inputs)
        row.wrong("farthest", "it is the one that is farthest away")(
            lambda x, at: int(np.argmax(np.abs(x - at)))
        )
        return row

    @staticmethod
    def nearest(x, at):
        return int(np.argmin(np.abs(x - at)))

    @pytest.mark.parametrize(
        ("function", "slug", "says"),
        [
            (lambda x, at: np.argmin(np.abs(x - at)), "", ""),
            (
                lambda x, at: int(np.argmax(np.abs(x - at))),
                "farthest",
                "It is the one that is farthest away.",
            ),
            (
                lambda x, at: int(np.argmin(np.abs(x - at))) + 1,
                "counted-from-one",
                "Your index is counted from 1 instead of 0.",
            ),
            (
                lambda x, at: float(np.argmin(np.abs(x - at))),
                "not-an-index",
                "0; expected an index. Only a whole number can index an array, so "
                "convert the result with int(...).",
            ),
            (
                lambda x, at: x,
                "shape",
                "returns an array of shape (3,); expected an index",
            ),
            (lambda x, at: "first", "not-an-array", "returns 'first'; expected"),
            (
                lambda x, at: int(np.argmin(np.abs(x - at))) - len(x),
                "another-one",
                ", counted from 0.",
            ),
        ],
    )
    def test_is_right_wrong_or_none(self, function, slug, says):
        verdict = told(self.row(), function)
        assert verdict.mistake == slug
        assert says in verdict.message

    def test_is_shown_as_one_would_type_it(self):
        verdict = told(self.row(), lambda x, at: int(np.argmax(np.abs(x - at))))
        mine, right = explained(verdict, "returned"), explained(verdict, "expected")
        values = [one[0].partition(": ")[2] for one in (mine, right)]
        assert all(value.isdecimal() for value in values)
        assert re.search(r"\) returned \d+; expected \d+\.$", verdict.call)


class TestATruthValue:
    def row(self):
        def inputs(rng):
            return [(float(x), bool(x > 3)) for x in rng.numbers(-9, 9, 14)]

        return row_of(Mask(), lambda x, sure: x > 0.0 and not sure, inputs)

    @pytest.mark.parametrize(
        ("function", "slug", "says"),
        [
            (lambda x, sure: bool(x > 0.0 and not sure), "", ""),
            (lambda x, sure: np.bool_(x > 0.0 and not sure), "", ""),
            (lambda x, sure: not (x > 0 and not sure), "inverted", "swaps True"),
            (
                lambda x, sure: x > 0.0,
                "too-often-true",
                "calls; expected False.",
            ),
            (lambda x, sure: x, "not-true-or-false", "; expected True or False."),
            (lambda x, sure: "yes", "not-an-array", "'yes'; expected True or False"),
            (lambda x, sure: None, "nothing-returned", "returns nothing (None)"),
        ],
    )
    def test_is_right_wrong_or_none(self, function, slug, says):
        verdict = told(self.row(), function)
        assert verdict.mistake == slug
        assert says in verdict.message
        assert "sign" not in verdict.message

    def test_is_typed_and_shown_as_true_and_false(self):
        verdict = told(self.row(), lambda x, sure: x > 0.0)
        assert verdict.call.endswith(", True) returned True; expected False.")
        assert explained(verdict, "expected") == ["expected: False"]


class TestAWord:
    def row(self, **more):
        def inputs(rng):
            return [(float(x),) for x in rng.numbers(-9, 9, 9)]

        return row_of(Word(words=WORDS, **more), self.word, inputs)

    @staticmethod
    def word(x):
        return WORDS[int(x > -3) + int(x > 3)]

    @pytest.mark.parametrize(
        ("function", "slug", "says"),
        [
            (lambda x: WORDS[int(x > -3) + int(x > 3)], "", ""),
            (
                lambda x: WORDS[int(x > -3)],
                "the-other-word",
                "'advanced'; expected 'trapped'. The result is wrong in 4 of 9",
            ),
            (
                lambda x: "arrived",
                "another-word",
                "'arrived'; expected 'reached', 'advanced' or 'trapped'.",
            ),
            (lambda x: np.ones(2), "another-word", "an array of shape (2,); expected"),
            (lambda x: 2, "another-word", "returns 2; expected 'reached'"),
        ],
    )
    def test_is_right_wrong_or_none(self, function, slug, says):
        verdict = told(self.row(), function)
        assert verdict.mistake == slug
        assert says in verdict.message

    def test_is_shown_in_quotes(self):
        verdict = told(self.row(), lambda x: WORDS[int(x > -3)])
        assert verdict.call.endswith(") returned 'advanced'; expected 'trapped'.")


class TestAPath:
    """As many way points as fit, none where the goal is out of reach."""

    def row(self):
        def inputs(rng):
            return [(rng.numbers(1, 5, 2), n) for n in (3, 0, 5, 1, 4, 2)]

        row = row_of(Waypoints((None, 2), "m"), self.path, inputs)
        row.wrong("one-too-few", "the last way point is missing", "all but the last")(
            lambda step, n: self.path(step, n)[:-1]
        )
        return row

    @staticmethod
    def path(step, n):
        return np.arange(1, n + 1)[:, None] * step

    @pytest.mark.parametrize(
        ("function", "slug", "says"),
        [
            (lambda s, n: [(k * s).tolist() for k in range(1, n + 1)] or
             np.zeros((0, 2)), "", ""),
            (
                lambda s, n: np.arange(1, n + 1)[:, None] * s * [[1.0, 1 + (n > 4)]],
                "off",
                "The result is wrong in 1 of 6 calls",
            ),
            (
                lambda s, n: np.arange(1, n)[:, None] * s,
                "one-too-few",
                "The last way point is missing. Your path has the wrong number of "
                "waypoints in 5 of 6 calls. The reference solution with this mistake",
            ),
            (
                lambda s, n: np.arange(0, n + 2)[:, None] * s,
                "shape",
                "Your path has the wrong number of waypoints in all 6 calls.",
            ),
            (
                lambda s, n: np.arange(1, n + 1) * s[0],
                "shape",
                "(3,); expected a path, with a row of 2 numbers per waypoint",
            ),
        ],
    )  # fmt: skip
    def test_is_right_wrong_or_none(self, function, slug, says):
        verdict = told(self.row(), function)
        assert verdict.mistake == slug
        assert says in verdict.message

    def test_is_shown_in_its_own_length(self):
        verdict = told(self.row(), lambda s, n: np.arange(1, n)[:, None] * s)
        (mine,), (right,) = (
            explained(verdict, "returned"),
            explained(verdict, "expected"),
        )
        values = [eval(one.partition(": ")[2]) for one in (mine, right)]
        assert len(values[1]) == len(values[0]) + 1
        empty = told(self.row(), lambda s, n: np.zeros((0, 2)))
        assert explained(empty, "returned") == ["returned: np.zeros((0, 2))"]
        assert "returned shape (0, 2); expected shape (" in empty.call


class TestATuple:
    """A place, a point, and whether it is free: unlike things, one of them a pair."""

    def row(self, **more):
        def inputs(rng):
            return [(rng.numbers(-9, 9, n, 2), float(n % 2)) for n in (3, 4, 2, 5, 3)]

        kind = (Index(called="the place"), (Vector((2,)), Mask(called="free")))
        return row_of(kind, self.nearest, inputs, **more)

    @staticmethod
    def nearest(tree, x):
        i = int(np.argmin(np.abs(tree[:, 0] - x)))
        return i, (tree[i], bool(tree[i, 1] > x))

    @pytest.mark.parametrize(
        ("change", "slug", "says"),
        [
            (lambda i, point, free: (i, (point.copy(), free)), "", ""),
            (lambda i, point, free: [i, [point.tolist(), np.bool_(free)]], "", ""),
            (
                lambda i, point, free: (i, (point, not free)),
                "inverted",
                "Your code swaps True and False. Free is wrong in all 5 calls.",
            ),
            (
                lambda i, point, free: (i, (-point, free)),
                "all-signs",
                "Every entry of your result has the wrong sign.",
            ),
            (
                lambda i, point, free: (float(i), (point, free)),
                "not-an-index",
                "Your first result, the place, is 1.0; expected an index",
            ),
            (
                lambda i, point, free: (i, point, free),
                "parts",
                "returns 3 results; expected 2 results: an index and a tuple of 2 "
                "results.",
            ),
            (
                lambda i, point, free: point,
                "parts",
                "Your function returns one array of shape (2,); expected",
            ),
            (lambda i, point, free: None, "nothing-returned", "None"),
            (lambda i, point, free: (i, (None, free)), "nothing-returned", "None"),
        ],
    )
    def test_is_right_wrong_or_none(self, change, slug, says):
        def function(tree, x):
            i, (point, free) = self.nearest(tree, x)
            return change(i, point, free)

        verdict = told(self.row(), function)
        assert verdict.mistake == slug
        assert says in verdict.message

    def test_says_which_part_of_the_answer_is_wrong(self):
        def function(tree, x):
            i, (point, free) = self.nearest(tree, x)
            return i, (point, not free)

        verdict = told(self.row(), function)
        assert ")[1][1] returned " in verdict.call
        assert len(explained(verdict, "returned")) == 3

    def test_of_two_lists_of_rows_is_two_arrays(self):
        row = row_of(
            (Matrix((None, 2)), Matrix((None, 2))),
            lambda X, rows: (X[rows], 2 * X[rows]),
            lambda rng: [
                (rng.numbers(-3, 3, 5, 2), np.array(r))
                for r in ([1, 2], [0, 3, 4], [2, 1, 0])
            ],
        )
        lists = told(row, lambda X, r: ([X[i] for i in r], [2 * X[i] for i in r]))
        assert lists.status == "passed"


class TestNone:
    """A row that takes None where there is no answer."""

    def row(self, **more):
        def inputs(rng):
            return [(rng.numbers(-2, 2, 2), float(x)) for x in (3, -3, 1, -1, 2, 4)]

        kind = Vector((2,), none="it is out of reach")
        return row_of(kind, self.reach, inputs, **more)

    @staticmethod
    def reach(p, x):
        return None if x < 0 else x * p

    @pytest.mark.parametrize(
        ("function", "slug", "says"),
        [
            (lambda p, x: None if x < 0 else x * p, "", ""),
            (
                lambda p, x: x * p,
                "none-or-not",
                "Your function returns an answer in 2 of 6 calls; expected None (it "
                "is out of reach).",
            ),
            (
                lambda p, x: None if x < 1.5 else x * p,
                "none-or-not",
                "Your function returns None in 1 of 4 calls; expected an answer.",
            ),
            (
                lambda p, x: None if x < 0 else -x * p,
                "all-signs",
                "Every entry of your result has the wrong sign",
            ),
            (lambda p, x: None if x < 0 else p + x**3, "off", "Largest error: "),
        ],
    )
    def test_is_right_or_wrong(self, function, slug, says):
        verdict = told(self.row(), function)
        assert verdict.mistake == slug
        assert says in verdict.message

    def test_is_shown_as_none(self):
        verdict = told(self.row(), lambda p, x: x * p)
        assert verdict.call.endswith(" returned an answer; expected None.")
        assert explained(verdict, "expected") == ["expected: None"]


def test_a_covariance_of_a_twist_may_have_its_blocks_swapped():
    P = np.diag([1.0, 2, 3, 4, 5, 6])
    row = row_of(
        Covariance((6, 6)),
        lambda s: s * P,
        lambda rng: [(float(x),) for x in rng.numbers(1, 3, 4)],
    )
    verdict = told(row, lambda s: s * np.roll(P, (3, 3), (0, 1)))
    assert verdict.mistake == "blocks-swapped"
    assert "in the order (v; omega)" in verdict.message


def test_pixels_of_no_points_are_an_empty_array():
    row = row_of(
        Pixels(),
        lambda p: 100.0 * p,
        lambda rng: [(rng.numbers(1, 2, n, 2),) for n in (3, 0, 2)],
    )
    assert told(row, lambda p: 100.0 * p).status == "passed"
    assert told(row, lambda p: 100.0 * p + 0.5).mistake == "shifted"


@pytest.mark.parametrize(
    ("write", "says"),
    [
        (
            lambda: Row(Scalar("s")),
            r'a Scalar is one value and has no shape.*unit="m"',
        ),
        (lambda: Row(Vector(7)), r"Vector\(7\): a Vector begins with its shape"),
        (lambda: Row(Vector), r"expected Vector\(...\), with its arguments"),
        (lambda: Row(float), "is no kind of an answer; expected a kind of"),
        (lambda: Row([Scalar(), Scalar()]), "or a tuple of several"),
        (lambda: Row((Scalar(),)), "the kind itself where there is one result"),
        (lambda: Row((((Scalar(), Scalar()), Mask()), Mask())), "nested once"),
        (lambda: Row(Word(words=("yes",))), "a Word says which there are"),
    ],
)
def test_what_no_answer_can_be_is_told_when_it_is_written(write, says):
    with pytest.raises(Robo47Error, match=says):
        write()
