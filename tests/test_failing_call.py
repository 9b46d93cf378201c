"""The call that failed: what can be typed, theirs, and the right answer."""

from types import SimpleNamespace

import numpy as np
import pytest
from judged import answered, replies_of, right, round_of

from labkit.base.exchange import Question, Reply
from labkit.check.report import matrix_of, of_arguments
from labkit.judge import Count, Index, Matrix, Scalar, Vector, Word
from labkit.judge.answers import InTurn
from labkit.judge.ask import SEED, Ask, Edges, HeldOut, right_answers
from labkit.judge.failing_call import Failing, failing_call
from labkit.judge.judge import judge
from labkit.judge.row import rows_of
from labkit.judge.typed import number, typed
from labkit.lesson.day import all_days

SINE = Ask(
    lambda rng: [(x,) for x in (0.5, 1.0, *map(float, rng.numbers(-3, 3, 4)))],
    Scalar(),
    truth=np.sin,
)


def asked_with(function, ask=SINE):
    """Return a round whose every question a function has answered."""
    asked = round_of(ask)
    for one in asked.exchanges:
        answered([one], replies_of(np.atleast_1d(function(*one.question.args))))
    return asked


def test_it_is_a_line_that_a_student_can_type():
    verdict = judge(asked_with(lambda x: np.sin(x) + 0.25 * (x == 1.0)))
    assert verdict.call == "f(1) returned 1.09147; expected 0.841471."
    assert "call: f(1)" in verdict.measured


def test_an_entry_of_a_vector_is_named_and_a_matrix_goes_by_its_argument():
    matrix = Question("1.1", "f", (0.1, np.array([0.0, 1.0]), np.eye(2)))
    assert typed(matrix, ["x", "p", "T"]) == "f(0.1, (0, 1), T)"
    assert typed(matrix) == "f(0.1, (0, 1), ...)"
    twice = Ask(lambda rng: [(2.0,), (3.0,)], Vector((2,)), truth=_pairs)
    asked = asked_with(lambda x: np.array([[x, 0.0]]), twice)
    assert failing_call(asked).call == "f(2)[1] returned 0; expected 2."


def _pairs(x):
    return np.stack([x, x], axis=-1)


def test_digits_suffice_to_tell_the_two_apart():
    says, *_ = failing_call(asked_with(lambda x: np.sin(x) + 1e-7 * (x == 1.0)))
    mine, its = says.removesuffix(".").split(" returned ")[1].split("; expected ")
    assert mine != its


def held_out(status):
    """Return a row that looks for a function that is 0 near 0."""
    held = HeldOut(
        "zero", "It is 0.", lambda rng: [(1e-6,)], lambda x: 0.0, status, near=1e-9
    )
    inputs = lambda rng: [(x,) for x in (0.5, 1.0, 2.0)]  # noqa: E731
    return Ask(inputs, Scalar(), truth=np.sin, held_out=[held])


def test_a_call_of_a_certain_mistake_is_shown_however_small_its_error():
    def student(x):
        return np.sin(x) if x > 1e-5 else 0.0

    verdict = judge(asked_with(student, held_out("wrong")))
    assert verdict.mistake == "zero"
    assert verdict.call == "f(1e-06) returned 0; expected 1e-06."
    assert judge(asked_with(student, held_out("close"))).call == ""
    assert failing_call(asked_with(np.sin, held_out("wrong"))) == Failing()


@pytest.mark.parametrize(
    ("x", "text"),
    [
        (1.8999999999999998e-14, "1.9e-14"),
        (0.1 + 0.2, "0.3"),
        (float(np.log(2)), "np.log(2)"),
        (-float(np.log(10)), "-np.log(10)"),
        (0.6931471805, "0.6931471805"),
        (123456.789, "123456.789"),
    ],
)
def test_a_number_is_typed_with_few_digits_that_give_it_back(x, text):
    assert number(x) == text
    assert eval(text, {"np": np}) == pytest.approx(x, rel=1e-15)


def test_a_call_that_stops_is_named_too():
    asked = asked_with(np.sin)
    asked.main[1].reply = Reply(kind="KeyError", error="1.0")
    assert failing_call(asked).call == "f(1) stopped with an error."
    assert failing_call(asked_with(np.sin)) == Failing()


def test_what_was_measured_never_says_that_all_is_right_where_something_is_wrong():
    verdict = judge(asked_with(lambda x: np.sin(x) + (x == 3.0)))
    assert (verdict.status, verdict.mistake) == ("wrong", "some-inputs")
    lines = [line for line in verdict.measured if line.startswith("correct calls: ")]
    counted = [line.split()[2:5] for line in lines]
    assert any(int(right) < int(of) for right, _, of in counted)
    assert verdict.call == "f(3) returned 1.14112; expected 0.14112."


@pytest.mark.parametrize(
    ("table", "slug"),
    [
        (lambda x, known: known.get(x, 9.0), "looked-up"),  # one answer for all others
        (
            lambda x, known: min(known.items(), key=lambda k: abs(k[0] - x))[1],
            "looked-up",
        ),
        (lambda x, known: known.get(x, np.sin(x) + 0.1 * x + 1), "some-inputs"),
    ],
)
def test_looked_up_is_said_only_where_answers_are_those_to_other_inputs(table, slug):
    calls = [one.question.args[0] for one in round_of(SINE).main]
    known = dict(zip(calls, right(SINE)[0], strict=True))
    verdict = judge(asked_with(lambda x: table(x, known)))
    assert verdict.mistake == slug


def test_edges_are_the_ends_of_every_range_and_whole_axes():
    rng = Edges(SEED)
    assert set(np.unique(rng.numbers(-3, 5, 50))) == {-3.0, 1.0, 5.0}
    axes = rng.normal(size=(50, 4))
    assert set(np.unique(axes)) == {-1.0, 0.0, 1.0}
    assert axes.any(axis=1).all()


# Of trees on a grid rounding would say which node is the nearest, a part of a
# path is below 1, and at gravity's limit zeros begin from one bit to the next.
NO_EDGES = {"rrt_connect", "shortcut", "time_optimal_profile"}


@pytest.mark.parametrize("day", all_days(), ids=lambda day: f"day {day.number}")
def test_every_function_with_one_right_answer_is_asked_at_edges(day):
    for name, row in rows_of(day).items():
        if row.ask.truth is not None and name not in NO_EDGES:
            assert row.ask.edges, name
            fresh = round_of(row.ask).fresh
            assert len(fresh) >= len(row.ask.edges) + 2
            found = right_answers(row.ask, fresh)  # a limit may be infinite
            assert not any(np.isnan(part).any() for part in found)


def test_an_edge_with_two_right_answers_is_not_asked():
    jump = Ask(lambda rng: [(float(rng.numbers(0, 2)),) for _ in range(2)], Scalar(),
               truth=lambda x: np.where(x > 1, 1.0, 0.0),
               at_edge=lambda x: x != 1)  # fmt: skip
    assert (1.0,) not in jump.edges
    assert {(0.0,), (2.0,)} == set(jump.edges)


def test_of_several_results_the_one_that_is_wrong_is_named():
    kinds = (Scalar(called="the sine"), Vector((2,)))
    ask = Ask(lambda rng: [(2.0,), (3.0,)], kinds, truth=InTurn(_sine_and_pair))
    asked = round_of(ask)
    answers = right(ask)
    answers[1][1, 1] = 7.0
    answered(asked.exchanges, replies_of(answers))
    assert failing_call(asked).call == "f(3)[1][1] returned 7; expected 3."


def test_of_several_wrong_results_it_is_the_one_that_is_talked_about():
    kinds = (Scalar(called="the sine"), Vector((2,)))
    ask = Ask(lambda rng: [(2.0,), (3.0,)], kinds, truth=InTurn(_sine_and_pair))
    asked = round_of(ask)
    answers = right(ask)
    answers[0][0] += 0.5
    answers[1][1, 1] = 7000.0  # further off, in a call whose sine is right
    answered(asked.exchanges, replies_of(answers))
    assert failing_call(asked).call.startswith("f(2)[0] returned ")


@pytest.mark.parametrize("kind", [Count(), Index()])
def test_a_wrong_count_in_the_message_is_that_of_the_failing_call(kind):
    calls = [(7.25,), (3.125,), (0.0,), (2.5,), (6.75,)]
    ask = Ask(lambda rng: calls, kind, truth=np.floor)
    asked = round_of(ask)
    for one in asked.exchanges:
        (x,) = one.question.args
        answer = int(x // 1) + (round(4 * x) % 4)  # right at 0
        answered([one], [Reply(value=answer, again=answer)])
    verdict = judge(asked)
    numbers = "returned 4; expected 2"
    assert verdict.call == f"f(2.5) {numbers}."
    assert f"Your function {numbers}" in verdict.message


@pytest.mark.parametrize(
    ("kind", "answer", "says"),
    [
        ((Scalar(), Vector((2,))), [1.0, 2.0, 3.0], "f(2) returned 3 results."),
        (
            (Scalar(), Vector((2,))),
            np.ones(3),
            "f(2) returned one array of shape (3,).",
        ),
        ((Index(), (Scalar(), Scalar())), (0, (1.0,)), "f(2)[1] returned 1 result."),
        ((Index(), Vector((2,))), (0, np.ones(3)), "f(2)[1] returned shape (3,)."),
        ((Scalar(), Vector((2,))), (1.0, "x"), "f(2)[1] returned 'x'."),
        (Index(), 1.5, "f(2) returned 1.5."),
        (Word(words=("yes", "no")), "maybe", "f(2) returned 'maybe'."),
    ],
)
def test_a_call_whose_answer_cannot_be_compared_is_shown(kind, answer, says):
    ask = Ask(lambda rng: [(2.0,), (3.0,)], kind, accept=lambda x, answer: None)
    asked = round_of(ask)
    answered(
        asked.exchanges, [Reply(value=answer, again=answer)] * len(asked.exchanges)
    )
    verdict = judge(asked)
    assert (verdict.status, verdict.call) == ("wrong", says)


def test_a_call_whose_answer_is_not_accepted_is_shown():
    ask = Ask(
        lambda rng: [(2.0,), (3.0,), (float(rng.numbers(3, 4)),)],
        Vector((2,)),
        accept=lambda x, answer: None if answer[0] < x else "The first entry is large.",
    )
    asked = asked_with(lambda x: np.array([[2.0, x]]), ask)
    verdict = judge(asked)
    assert verdict.call == "The failing call: f(2)."
    assert "returned: [2.0, 2.0]" in verdict.measured


def _sine_and_pair(x):
    return np.sin(x), np.array([x, x])


@pytest.mark.parametrize("rounding", [(0.0, 1e-15), (1e-15, 0.0), (0.0, 0.0)])
def test_rounding_neither_chooses_the_entry_nor_is_shown_as_a_number(rounding):
    ask = Ask(lambda rng: [(2.0,), (3.0,)], Vector((2,)), truth=lambda x: _pairs(0 * x))
    says, *_ = failing_call(
        asked_with(lambda x: np.array([np.add(rounding, 1 / 3)]), ask)
    )
    assert says == "f(2)[0] returned 0.333333; expected 0."
    dust = Ask(lambda rng: [(2.0,)], Vector((1,)), truth=lambda x: x[:, None] * 1e-17)
    says, *_ = failing_call(asked_with(lambda x: np.array([[1.0]]), dust))
    assert says == "f(2)[0] returned 1; expected 0."


def test_a_matrix_with_some_wrong_entries_is_shown_with_these_in_brackets():
    ask = Ask(
        lambda rng: [(3.0,)],
        Matrix((2, 2)),
        truth=lambda x: np.array([[[1.0, 2.0], [x[0], 4.0]]]),
    )
    wrong = asked_with(lambda x: np.array([[[1.0, x], [2.0, 4.0]]]), ask)
    compared = failing_call(wrong).compared
    assert compared is not None
    lines = matrix_of(compared)
    assert lines[1:] == ["  1  [3]", " [2]  4"]


def test_the_shortest_of_the_calls_that_are_clearly_wrong_is_shown():
    calls = [(2.718281828,), (2.5,), (0.2,), (0.0,)]
    shown = Ask(lambda rng: calls, Vector((2,)), truth=_pairs)
    asked = asked_with(lambda x: np.array([[x, 0.0]]), shown)
    said = failing_call(asked).call
    assert said == "f(2.5)[1] returned 0; expected 2.5.", "0.2 is off by less than 0.27"


def test_the_report_says_how_to_see_arguments_that_a_call_only_names():
    task = SimpleNamespace(id="1.2")
    inputs = lambda rng: [(n * np.eye(2),) for n in (1.0, 2.0, 3.0)]  # noqa: E731
    trace = Ask(inputs, Scalar(), truth=InTurn(np.trace))
    named = judge(asked_with(lambda x: np.max(x), trace))
    typed = judge(asked_with(lambda x: np.sin(x) + 0.25 * (x == 1.0)))
    says = [of_arguments(SimpleNamespace(task=task, verdict=v)) for v in (named, typed)]
    assert says == ["All arguments: make check TASK=1.2 ARGS=--explain", ""]


def _sizes_of(n, m):
    return np.ones(int(n)), np.ones(int(m))


@pytest.mark.parametrize(
    "student",
    [
        lambda n, m: (np.ones(2), np.ones(int(n))),  # the two have changed places
        lambda n, m: (np.ones((1, 2)) if n == 3 else np.ones(2), np.ones((1, 2))),
    ],
    ids=["the sizes", "the axes"],
)
def test_the_call_is_of_the_result_that_the_message_names(student):
    kinds = Vector((None,)), Vector((None,))
    ask = Ask(
        lambda rng: [(2.0, 1.0), (3.0, 3.0), (3.0, 1.0)],
        kinds,
        truth=InTurn(_sizes_of),
    )
    asked = round_of(ask)
    for one in asked.exchanges:
        value = student(*one.question.args)
        one.reply = Reply(value=value, again=value)
    verdict = judge(asked)
    place = {"Your first": ")[0]", "Your secon": ")[1]"}[verdict.message[:10]]
    assert place in verdict.call
