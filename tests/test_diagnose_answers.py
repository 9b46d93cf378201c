"""The judge on what is no answer, state between calls, and how answers came about."""

import numpy as np
import pytest
from judged import answered, judged, judged_replies, replies_of, right, round_of

from labkit.base.exchange import Reply
from labkit.judge import Ask, Draw, HeldOut, Matrix, Pose, Robot, Scalar, Vector
from labkit.judge.judge import judge
from labkit.judge.row import row_of
from labkit.judge.typed import number
from labkit.lesson.day import find_day
from labkit.sandbox.messages import robots_of

MAKE_T = row_of(find_day(1), "make_T").ask


def told(ask, value):
    """Return the verdict on a function that always returns the same."""
    asked = round_of(ask)
    same = Reply(value=value, again=value)
    answered(asked.exchanges, [same] * len(asked.exchanges))
    return judge(asked)


@pytest.mark.parametrize(
    ("value", "slug", "word"),
    [
        (None, "nothing-returned", "None"),
        (np.eye(3), "shape", "(3, 3)"),
        (np.array("T"), "not-numbers", "real numbers"),
        (np.eye(4) * 1j, "not-numbers", "complex"),
        ((np.eye(3), np.zeros(3)), "shape", "a tuple of 2 results; expected"),
        (np.full((4, 4), np.nan), "not-finite", "NaN"),
        (np.zeros((4, 4)), "all-zeros", "never fill it"),
        (np.eye(4), "always-the-identity", "identity"),
        (np.diag([2.0, 2.0, 2.0, 1.0]), "ignores-its-input", "same"),
        (np.eye(4)[:3], "shape", "bottom row"),
        ((), "shape", "(0,)"),
    ],
)
def test_what_is_no_pose_at_all_is_told_by_its_form(value, slug, word):
    verdict = told(MAKE_T, value)
    assert (verdict.status, verdict.mistake) == ("wrong", slug)
    assert word in verdict.message


def test_a_days_own_diagnosis_may_stop_at_a_singular_answer():
    ask = row_of(find_day(6), "task_inertia").ask
    answers = right(ask)[0].copy()
    answers[:, 0] = answers[:, :, 0] = 0.0
    verdict = judged_replies(ask, replies_of(answers))
    assert (verdict.status, verdict.mistake) == ("wrong", "off")
    assert "Largest error: " in verdict.message


def test_an_exception_is_told_with_its_line_and_how_often_it_happens():
    T = right(MAKE_T)[0]
    replies = replies_of(T)
    replies[3] = Reply(error="float division", kind="ZeroDivisionError", line=31)
    verdict = judged_replies(MAKE_T, replies)
    assert (verdict.status, verdict.mistake) == ("wrong", "raises")
    assert verdict.message == (
        f"Your function stops with an error in 1 of {len(T)} calls. The error occurs "
        "in line 31: `ZeroDivisionError: float division`."
    )
    verdict = judged_replies(MAKE_T, [replies[3]] * len(T))
    assert f"with an error in all {len(T)} calls. The error" in verdict.message


def test_an_answer_that_changes_when_asked_again_is_told_so():
    T = right(MAKE_T)[0]
    replies = [Reply(value=one, again=one + 1e-6) for one in T]
    verdict = judged_replies(MAKE_T, replies)
    assert verdict.mistake == "kept-between-calls"
    every = len(T) + len(round_of(MAKE_T).fresh)
    assert f"In {len(T)} of {every} calls, the same" in verdict.message


def test_an_error_of_the_second_time_alone_is_state_too():
    T = right(MAKE_T)[0]
    replies = [Reply(value=one, again_error="IndexError: x") for one in T]
    assert judged_replies(MAKE_T, replies).mistake == "kept-between-calls"


def test_an_error_of_both_times_at_a_fresh_input_is_no_state():
    asked = round_of(MAKE_T)
    answered(asked.main, replies_of(right(MAKE_T)[0] + 1.0))
    stops = Reply(kind="ZeroDivisionError", error="division by zero")
    answered(asked.fresh, [stops] * len(asked.fresh))
    assert judge(asked).mistake != "kept-between-calls"


@pytest.mark.parametrize(
    ("shares", "slug"),
    [("another answer", "one-array-for-all"), ("R", "shares-its-argument")],
)
def test_memory_that_is_shared_never_passes(shares, slug):
    T = right(MAKE_T)[0]
    replies = [Reply(value=one, again=one, shares=(shares,)) for one in T]
    verdict = judged_replies(MAKE_T, replies)
    assert (verdict.status, verdict.mistake) == ("wrong", slug)


def test_a_held_out_question_tells_how_an_answer_came_about():
    held = HeldOut("by-halves", "Only half.", lambda rng: [(8.0,)], mistaken=np.sqrt)
    ask = Ask(
        lambda rng: [(x,) for x in (1.0, 4.0)],
        Scalar(),
        truth=lambda x: x,
        held_out=[held],
    )

    def verdict(answer):
        asked = round_of(ask)
        answered(asked.main, replies_of([1.0, 4.0]))
        answered(asked.held_out[0], replies_of([answer]))
        return judge(asked).mistake

    assert verdict(np.sqrt(8.0)) == "by-halves"
    assert verdict(8.0) == ""


def test_a_tuples_parts_are_judged_apart_and_named():
    ask = Ask(
        lambda rng: [(x,) for x in rng.uniform(1, 2, 6)],
        (Scalar(called="the length"), Scalar(unit="rad", called="the angle")),
        truth=lambda x: (x, 2.0 * x),
    )
    x, twice = right(ask)
    assert judged(ask, (x, twice)).status == "passed"
    verdict = judged(ask, (x, -twice))
    assert verdict.mistake == "all-signs"
    assert verdict.message.startswith("Every entry of the angle has the wrong sign.")
    assert "expected 2 results" in told(ask, np.array(1.0)).message


@pytest.mark.parametrize(
    ("second", "says"),
    [
        (np.zeros(2), "Your second result, the angle, is an array of shape (2,);"),
        ("left", "Your second result, the angle, is 'left'; expected one number."),
        (None, "For the angle, your function returns None in all 6 calls;"),
    ],
)
def test_a_sentence_on_one_of_several_results_has_its_name(second, says):
    ask = Ask(
        lambda rng: [(x,) for x in rng.uniform(1, 2, 6)],
        (Scalar(called="the length"), Scalar(called="the angle", none="no angle")),
        truth=lambda x: (x, 2.0 * x),
    )
    assert told(ask, (1.0, second)).message.startswith(says)


def test_accepting_needs_no_truth_and_says_why_not():
    ask = Ask(
        lambda rng: [(x,) for x in rng.uniform(1, 2, 6)],
        Scalar(),
        accept=lambda x, y: None if y > x else "It is not larger.",
    )
    assert told_many(ask, 9.0).status == "passed"
    verdict = told_many(ask, 0.0)
    assert (verdict.status, verdict.mistake) == ("wrong", "not-accepted")
    assert "It is not larger." in verdict.message
    assert "This happens in all 8 calls." in verdict.message


def told_many(ask, answer):
    asked = round_of(ask)
    answered(asked.exchanges, replies_of([answer] * len(asked.exchanges)))
    return judge(asked)


def test_a_row_has_either_a_truth_or_a_judge():
    with pytest.raises(ValueError, match="either truth or accept"):
        Ask(lambda rng: [], Scalar())


def test_a_question_without_a_reply_is_the_callers_error():
    with pytest.raises(ValueError, match="no reply to"):
        judge(round_of(MAKE_T))


@pytest.mark.parametrize(
    ("kind", "S", "T", "word"),
    [
        (Vector((7,), "N m"), np.ones(7) * 3, np.ones(7), "3 times the correct value"),
        (Matrix((6, 6)), np.eye(6) + 2 * np.eye(6)[[5]].T, np.eye(6), "row 5"),
        (Pose(), np.eye(4) * np.nan, np.eye(4), "wrong"),
    ],
)
def test_each_kind_says_what_is_wrong_in_its_own_words(kind, S, T, word):
    S, T = np.array([S] * 3), np.array([T] * 3)
    with np.errstate(all="ignore"):
        assert word in kind.what_is_wrong(S, T).message


@pytest.mark.parametrize(
    ("x", "shown"),
    [
        (np.pi / 2, "pi / 2"),
        (-np.pi, "-pi"),
        (2 * np.pi / 3, "2 * pi / 3"),
        (1.57, "1.57"),
        (0.0, "0"),
        (-2.356, "-2.356"),
        (3.0, "3"),
        (0.1 + 0.2, "0.3"),  # what a sum leaves in the last digits is not typed
        (1 / 3, "0.3333333333333333"),
        (5e-324, "5e-324"),
        (1e14, "1e14"),
        (-2.5e16, "-2.5e16"),
        (1234567.0, "1234567.0"),
    ],
)
def test_inputs_are_shown_as_python_reads_them_back(x, shown):
    assert number(x) == shown
    assert eval(shown, {"pi": np.pi}) == pytest.approx(x, abs=1e-15)


def test_a_robot_is_compiled_once_and_may_be_changed():
    def longer(model):
        model.body_pos[:] *= 2.0

    plain, changed = Robot(), Robot(change=longer)
    assert plain.model is plain.model
    np.testing.assert_array_equal(changed.model.body_pos, 2 * plain.model.body_pos)
    assert robots_of([]) == []


def test_drawn_configurations_are_within_the_limits_and_typable():
    q = Draw(1).configurations(20)
    np.testing.assert_array_equal(q, np.round(q, 3))
    low, high = Robot().model.jnt_range.T
    assert ((q >= low - 1e-3) & (q <= high + 1e-3)).all()
