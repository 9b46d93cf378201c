"""Weights and sizes of answers; covariances, counts, masks, paths, pixels, images."""

import numpy as np
import pytest
from judged import judged, judged_replies, right, round_of

from labkit.base.exchange import Reply
from labkit.judge import (
    Ask,
    Count,
    Covariance,
    Mask,
    Matrix,
    Pixels,
    Robot,
    Scalar,
    Vector,
    Waypoints,
)
from labkit.judge.answers import InTurn
from labkit.judge.ask import stacked
from labkit.judge.judge import judge
from labkit.judge.mistake import Mistake

NUMBERS = np.random.default_rng(3)


def asked(kind, answers, **more):
    """Return a row whose right answers are these."""
    rights = dict(enumerate(answers))
    calls = [(float(i),) for i in rights]
    truth = InTurn(lambda i: rights[int(i)])
    return Ask(lambda rng: calls, kind, truth=truth, **more)


def told(kind, answers, given):
    """Return the verdict on answers, one per question."""
    ask = asked(kind, answers)
    replies = [Reply(value=np.asarray(one), again=np.asarray(one)) for one in given]
    return judged_replies(ask, replies)


def test_the_few_entries_that_are_right_are_named():
    names = ("the mass", "x", "y", "z")
    right = NUMBERS.uniform(1.0, 2.0, (6, 4))
    wrong = right + [0.0, 0.1, 0.2, 0.3] * NUMBERS.uniform(1.0, 2.0, (6, 4))
    kind = Vector((4,), names=names)
    assert "Only the mass is correct" in judged(asked(kind, right), wrong).message
    unnamed = judged(asked(Vector((4,)), right), wrong)
    assert "Only" not in unnamed.message


class TestWeights:
    WEIGHTS = np.array([[1.0, 1e6], [1e-6, 1.0]])
    RIGHT = WEIGHTS * NUMBERS.uniform(1.0, 2.0, (6, 2, 2))
    KIND = Matrix((2, 2), scale=WEIGHTS)

    def off(self, row, column, by):
        wrong = self.RIGHT.copy()
        wrong[:, row, column] += by * NUMBERS.uniform(1.0, 2.0, 6)
        return judged(asked(self.KIND, self.RIGHT), wrong)

    def test_each_entry_is_judged_by_its_own(self):
        assert self.off(0, 1, 1e-4).status == "passed"  # 1e-10 of a million
        assert self.off(0, 1, 1e3).mistake == "few-entries-off"
        found = self.off(1, 0, 1e-9)  # a thousandth of a millionth
        assert found.mistake == "few-entries-off"
        assert "[1, 0]" in found.message

    def test_a_mistake_is_named_in_the_small_entry_too(self):
        doubled = InTurn(lambda i: self.RIGHT[int(i)] * [[1, 1], [2, 1]])
        slip = Mistake("small-doubled", "s", doubled)
        ask = asked(self.KIND, self.RIGHT, mistakes=[slip])
        assert judged(ask, self.RIGHT * [[1, 1], [2, 1]]).mistake == "small-doubled"
        assert judged(ask, self.RIGHT * [[1, 1], [3, 1]]).mistake != "small-doubled"


class TestSizes:
    """Questions of several sizes in one row, and answers that follow them."""

    def row(self, kind, truth, sizes=(2, 5, 3, 4), **more):
        def inputs(rng):
            return [(rng.uniform(1.0, 2.0, n),) for n in sizes]

        return Ask(inputs, kind, truth=InTurn(truth), **more)

    def test_a_number_of_vectors_of_any_length(self):
        ask = self.row(Scalar(), np.sum)
        assert judged(ask, right(ask)[0]).status == "passed"
        wrong = judged(ask, right(ask)[0] * [1, 2, 1, 1])
        assert "wrong in 1 of 4 calls" in wrong.message

    def test_an_answer_as_long_as_its_question(self):
        ask = self.row(Vector((None,)), np.cumsum)
        questions = [exchange.question.args[0] for exchange in round_of(ask).main]

        def verdict(function):
            given = map(function, questions)
            return judged_replies(ask, [Reply(value=x, again=x) for x in given])

        assert verdict(np.cumsum).status == "passed"
        assert verdict(lambda x: -np.cumsum(x)).mistake == "all-signs"
        short = verdict(lambda x: np.cumsum(x)[:-1])
        assert short.mistake == "shape"
        assert "returns an array of the wrong shape in all 4 calls." in short.message
        assert verdict(lambda x: np.cumsum(x)[None]).mistake == "shape"

    @pytest.mark.parametrize("shape", [(None,), (None, None)])
    def test_entries_are_named_only_if_others_of_the_answer_are_right(self, shape):
        def outer(x):
            return x if len(shape) == 1 else np.outer(x[:1], x)

        sizes = (5, 1, 3, 4) if len(shape) == 1 else (5, 2, 3, 4)
        kind = (Vector if len(shape) == 1 else Matrix)(shape)
        ask = self.row(kind, outer, sizes)
        questions = [exchange.question.args[0] for exchange in round_of(ask).main]

        def verdict(wrong):
            given = [outer(x) + wrong(x) for x in questions]
            return judged_replies(ask, [Reply(value=x, again=x) for x in given])

        whole = verdict(lambda x: 1.0 * (len(x) == min(sizes)))
        assert "all entries are correct except" not in whole.message
        first = verdict(lambda x: 1.0 * (np.arange(len(x)) == 0) * (len(x) == 3))
        assert "all entries are correct except" in first.message.lower()

    def test_a_mistake_is_made_again_in_every_size(self):
        slip = Mistake("sorted-first", "s", InTurn(lambda x: np.cumsum(np.sort(x))))
        ask = self.row(Vector((None,)), np.cumsum, mistakes=[slip])
        questions = stacked(round_of(ask).main)
        assert judged(ask, slip.redo(*questions)).mistake == "sorted-first"
        assert judged(ask, right(ask)[0]).status == "passed"


def test_robots_of_a_row_may_differ_and_be_all_that_is_asked():
    def shorter(model):
        model.body_pos[:] *= 0.5

    robots = [Robot(), Robot(change=shorter), Robot("panda")]
    ask = Ask(
        lambda rng: [(robot,) for robot in robots],
        Vector((2,)),
        truth=InTurn(lambda model: [model.nq, np.abs(model.body_pos).sum()]),
    )
    answers = right(ask)[0]
    assert answers[:, 0].tolist() == [7, 7, 9]
    assert answers[0, 1] == pytest.approx(2 * answers[1, 1])
    assert judged(ask, answers).status == "passed"


class TestCovariance:
    A = NUMBERS.normal(size=(6, 3, 3))
    RIGHT = A @ A.transpose(0, 2, 1) + np.eye(3)

    @pytest.mark.parametrize(
        ("change", "slug"),
        [
            (np.linalg.inv, "inverse"),
            (lambda P: np.sign(P) * np.sqrt(np.abs(P)), "sigma-for-variance"),
            (lambda P: P + 0.1 * np.triu(P), "not-symmetric"),
            (lambda P: P - 9.0 * np.eye(3), "not-positive"),
            (lambda P: 2.0 * P, "one-factor-off"),
        ],
    )
    def test_is_told_what_it_is_instead(self, change, slug):
        verdict = told(Covariance((3, 3)), self.RIGHT, change(self.RIGHT))
        assert verdict.mistake == slug

    @pytest.mark.parametrize(
        ("kept", "where"),
        [
            (np.eye(4), "All entries off the diagonal"),
            (np.tril(np.ones((4, 4))), "All entries above the diagonal"),
            (
                np.kron(np.eye(2), np.ones((2, 2))),
                "The upper right and the lower left blocks",
            ),
        ],
    )
    def test_a_part_that_is_always_0_is_told(self, kept, where):
        A = np.random.default_rng(4).normal(size=(6, 4, 4))
        T = A @ A.mT + np.eye(4)
        found = Matrix((4, 4)).what_is_wrong(T * kept + 0.1 * kept, T)
        assert found.slug == "entries-empty"
        assert found.message.startswith(f"{where} are 0 in every call. Largest error: ")

    def test_is_compared_up_to_its_symmetry(self):
        skew = 1e-6 * np.array([[0, 1, 2], [-1, 0, 3], [-2, -3, 0]])
        assert (
            told(Covariance((3, 3)), self.RIGHT, self.RIGHT + skew).status == "passed"
        )
        assert told(Matrix((3, 3)), self.RIGHT, self.RIGHT + skew).status == "close"


COUNTS = np.array([62, 43, 10, 7])


@pytest.mark.parametrize(
    ("given", "slug", "says"),
    [
        (COUNTS, "", ""),
        (
            [61, 43, 10, 7],
            "miscounted",
            "returned 61; expected 62. The result is wrong in 1 of",
        ),
        (COUNTS - 0.5, "not-whole", "returned 42.5; expected a whole number"),
        (-COUNTS, "miscounted", "-43; expected 43"),  # no talk of signs
        ([0, 0, 0, 0], "ignores-its-input", "same"),  # nor of arrays never filled
    ],
)
def test_a_count_is_a_whole_number(given, slug, says):
    verdict = told(Count(), COUNTS, given)
    assert verdict.mistake == slug
    assert says in verdict.message


MASKS = NUMBERS.uniform(size=(6, 8)) < 0.4
ONE_EACH = np.arange(8) == np.arange(6)[:, None]


@pytest.mark.parametrize(
    ("given", "slug", "says"),
    [
        (MASKS, "", ""),
        (MASKS.astype(int), "", ""),
        (~MASKS, "inverted", "our code swaps True and False"),
        (np.ones_like(MASKS), "ignores-its-input", "the same for every input"),
        (
            MASKS | ONE_EACH,
            "too-often-true",
            "returned True in 3 entries; expected False.",
        ),
        (MASKS & ~ONE_EACH, "too-seldom-true", "Your function returned False"),
        (
            MASKS * 0.5,
            "not-true-or-false",
            "0.5; expected True or False, in shape",
        ),
    ],
)
def test_a_mask_says_which_way_it_is_wrong(given, slug, says):
    verdict = told(Mask((8,)), MASKS, given)
    assert verdict.mistake == slug
    assert says in verdict.message


def test_a_yes_or_no_is_a_mask_of_one():
    yes = [True, False, True, False]
    assert told(Mask(), yes, yes).status == "passed"
    assert told(Mask(), yes, [False, True, False, True]).mistake == "inverted"


def test_a_path_of_any_length_is_accepted_by_a_property():
    def accept(start, goal, path):
        if (
            len(path) < 2
            or not (path[0] == start).all()
            or not (path[-1] == goal).all()
        ):
            return "It does not lead from the start to the goal."
        return None

    def inputs(rng):
        return [(rng.normal(size=2), rng.normal(size=2)) for _ in range(4)]

    ask = Ask(inputs, Waypoints((None, 2)), accept=accept)

    def verdict(path):
        exchanges = round_of(ask)
        for i, one in enumerate(exchanges.exchanges):
            x = path(i, *one.question.args)
            one.reply = Reply(value=x, again=x)
        return judge(exchanges)

    straight = verdict(lambda i, a, b: np.linspace(a, b, 3 + i))
    assert straight.status == "passed"
    back = verdict(lambda i, a, b: np.linspace(b, a, 3 + i))
    assert back.mistake == "not-accepted"
    assert "This happens in all 6 calls." in back.message
    assert back.call.startswith("One failing call: ")
    once = verdict(lambda i, a, b: np.linspace(*([b, a] if i == 2 else [a, b]), 3 + i))
    assert "This happens in 1 of 6 calls." in once.message
    assert once.call.startswith("The failing call: ")
    flat = verdict(lambda i, a, b: np.concatenate([a, b]))
    assert "a row of 2 numbers per waypoint" in flat.message


PIXELS = NUMBERS.uniform(0.0, 300.0, (5, 8, 2))


def test_pixels_of_several_sizes_may_be_shifted_too():
    clouds = [PIXELS[0][:n] for n in (2, 5, 8)]
    ask = asked(Pixels((None, 2)), clouds)
    replies = [Reply(value=one + 0.5, again=one + 0.5) for one in clouds]
    assert judged_replies(ask, replies).mistake == "shifted"


@pytest.mark.parametrize(
    ("change", "slug", "says"),
    [
        (lambda p: p + 0.5, "shifted", "off by the same (0.5, 0.5)"),
        (lambda p: p[..., ::-1], "row-first", "Your code puts the row first"),
        (lambda p: 2.0 * p, "one-factor-off", "2 times"),
        (np.trunc, "whole-numbers", "truncates the result to whole numbers"),
    ],
)
def test_pixels_are_told_what_happened_to_them(change, slug, says):
    verdict = told(Pixels((8, 2)), PIXELS, change(PIXELS))
    assert verdict.mistake == slug
    assert says in verdict.message


def test_who_draws_random_numbers_is_told_that_they_are_an_argument():
    ask = asked(Scalar(), [1.0, 2.0, 3.0])
    replies = [Reply(value=np.array(x), again=np.array(x + 0.1)) for x in right(ask)[0]]
    draws = "def f(x):\n    return x + np.random.normal()\n"
    assert judged_replies(ask, replies, draws).mistake == "draws-itself"
    lab = "def f(x):\n    return x\n\n\ndef main():\n    np.random.normal()\n"
    assert judged_replies(ask, replies, lab).mistake == "kept-between-calls"
    for text in ('"random numbers"', "return x  # rng"):
        said = judged_replies(ask, replies, f"def f(x):\n    {text}\n")
        assert said.mistake == "kept-between-calls"
    given = "def f(noise):\n    return noise + np.random.normal(), rng\n"
    found = judged_replies(ask, replies, given)
    assert found.mistake == "draws-itself"
    assert "Use only the random numbers in the argument `noise`, so" in found.message


def test_a_mask_is_inverted_only_where_it_is_so_at_fresh_inputs_too():
    def inputs(rng):
        return [(float(x),) for x in rng.uniform(-1.0, 1.0, 6)]

    ask = Ask(inputs, Mask(), truth=InTurn(lambda x: x > 0.0))

    def verdict(function):
        exchanges = round_of(ask)
        for one in exchanges.exchanges:
            x = np.asarray(function(*one.question.args))
            one.reply = Reply(value=x, again=x)
        return judge(exchanges).mistake

    main = [exchange.question.args[0] for exchange in round_of(ask).main]
    assert verdict(lambda x: x <= 0.0) == "inverted"
    assert verdict(lambda x: (x > 0.0) != (x in main)) != "inverted"


@pytest.mark.parametrize(
    ("names", "says"),
    [
        (("kp", "kd", "ki"), "except the entry for kd. "),
        (("the mass", "the height", "the width"), "except the height. "),
    ],
)
def test_an_entry_is_named(names, says):
    right = np.arange(1.0, 13.0).reshape(4, 3) ** 2
    verdict = told(Vector((3,), names=names), right, right + [0.0, 1.0, 0.0] * right)
    assert says in verdict.message


def test_a_number_for_a_vector_is_called_a_number():
    verdict = told(Vector((3,)), np.ones((4, 3)), np.ones(4))
    assert "returns a single number; expected a vector of 3" in verdict.message
