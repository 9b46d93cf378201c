"""The named mistakes: each is found, none is another, none is claimed unduly."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from robo47 import se3
from robo47.diagnose import TASK_FUNCTIONS, Answer, calls, judge
from robo47.diagnose.compare import CLOSE, difference, matches
from robo47.diagnose.judging import mistakes_of
from robo47.diagnose.truth import right_answers, stacked_arguments

FUNCTIONS = [(task, f) for task, names in TASK_FUNCTIONS.items() for f in names]
# What is said where no mistake has the name; everything else is a claim.
TRUTHFUL = {
    *(
        "few-entries-off",
        "bottom-row",
        "not-orthonormal",
        "axes-mixed-up",
        "left-handed",
    ),
    *("rotation-off", "translation-off", "pose-off"),
    *("first-off", "second-off", "both-off"),
}
# One thing with two names: the numbers are the same, and what is said of either is
# true of both. A joint's pose has no translation, so its inverse is its transpose.
BACKWARDS = {"turns-backwards", "R-transposed", "inverse-returned", "T-transposed"}
ON_THE_ARM = [BACKWARDS, {"joints-left-out", "R-lost"}]
SAME = {
    "Rz": [BACKWARDS],
    "joint_T": [BACKWARDS],
    "compose_fk": [*ON_THE_ARM, {"stops-at-link7", "stops-early"}],
    "link4_to_world": ON_THE_ARM,
    "inverse": [
        {"R-kept", "R-transposed"},
        {"unchanged", "inverse-returned"},
        {"t-not-negated", "t-negated"},
    ],
}


def one_thing(function, slug, other):
    return slug == other or any({slug, other} <= s for s in SAME.get(function, []))


def answers(task, function, values):
    """Return answers to a task: these values for one function, the rest right."""
    named = {f: right_answers(f) for f in TASK_FUNCTIONS[task]} | {function: values}
    return [Answer(v) for f in TASK_FUNCTIONS[task] for v in named[f]]


def redone(function):
    """Return (mistake, what it answers) for each that differs from the right answer."""
    arguments, T = stacked_arguments(function), right_answers(function)
    all_redone = [(m, m.redo(*arguments)) for m in mistakes_of(function)]
    return [(m, S) for m, S in all_redone if difference(S, T).max() > CLOSE]


@pytest.mark.parametrize(("task", "function"), FUNCTIONS)
def test_every_mistake_made_on_purpose_is_found_by_its_name(task, function):
    for mistake, S in redone(function):
        verdict = judge(task, answers(task, function, S))
        assert verdict.status == "wrong"
        assert one_thing(function, verdict.mistake, mistake.slug), mistake


@pytest.mark.parametrize(("task", "function"), FUNCTIONS)
def test_no_two_mistakes_look_alike_on_the_questions_asked(task, function):
    found = redone(function)
    for i, (a, S_a) in enumerate(found):
        for b, S_b in found[:i]:
            if matches(S_a, S_b):
                assert one_thing(function, a.slug, b.slug), (a, b)


@pytest.mark.parametrize(("task", "function"), FUNCTIONS)
def test_numbers_at_random_get_no_name(task, function):
    rng = np.random.default_rng(5)
    S = rng.normal(size=right_answers(function).shape)
    assert judge(task, answers(task, function, S)).mistake in TRUTHFUL


@pytest.mark.parametrize(("task", "function"), FUNCTIONS)
@settings(max_examples=25, deadline=None)
@given(seed=st.integers(0, 2**32 - 1))
def test_rigid_answers_at_random_get_no_name(task, function, seed):
    rng, shape = np.random.default_rng(seed), right_answers(function).shape
    S = rng.normal(size=shape)
    if shape[1:] != (2, 3):
        S[..., :3, :3] = Rotation.random(len(S), rng=rng).as_matrix()
        S[..., 3:, :] = np.eye(4)[3:, : shape[-1]]
    verdict = judge(task, answers(task, function, S))
    assert verdict.mistake in TRUTHFUL - {"bottom-row", "not-orthonormal"}
    assert any(character.isdigit() for character in verdict.message)


@pytest.mark.parametrize(("task", "function"), FUNCTIONS)
@settings(max_examples=25, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), exponent=st.floats(-16, -9))
def test_a_right_answer_with_rounding_noise_passes(task, function, seed, exponent):
    T = right_answers(function)
    noise = np.random.default_rng(seed).uniform(-1, 1, T.shape) * 10.0**exponent
    assert judge(task, answers(task, function, T + noise)).status == "passed"


@pytest.mark.parametrize(("task", "function"), FUNCTIONS)
@settings(max_examples=25, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), exponent=st.floats(-7.5, -4.1))
def test_a_nearly_right_answer_is_close_and_never_a_mistake(
    task, function, seed, exponent
):
    T = right_answers(function)
    noise = np.random.default_rng(seed).uniform(0.5, 1, T.shape) * 10.0**exponent
    verdict = judge(task, answers(task, function, T + noise))
    assert (verdict.status, verdict.mistake) == ("close", "rounded-somewhere")


@pytest.mark.parametrize("container", [np.asfortranarray, np.array, list, tuple])
@pytest.mark.parametrize(("task", "function"), FUNCTIONS)
def test_how_the_numbers_are_stored_does_not_matter(task, function, container):
    kept = [container(value) for value in right_answers(function)]
    assert judge(task, answers(task, function, kept)).status == "passed"


@settings(max_examples=50, deadline=None)
@given(seed=st.integers(0, 2**32 - 1))
def test_scipy_the_other_author_passes(seed):
    """Another implementation, through random representations of the same rotation."""
    rng = np.random.default_rng(seed)
    R = []
    for call in calls("1.4"):
        rotation = Rotation.from_quat(np.roll(call.args[0], -1))
        way = rng.integers(4)
        if way == 0:
            rotation = Rotation.from_rotvec(rotation.as_rotvec())
        elif way == 1:
            rotation = Rotation.from_mrp(rotation.as_mrp())
        elif way == 2:
            half = Rotation.from_rotvec(rotation.as_rotvec() / 2)
            rotation = half * half
        R.append(Answer(rotation.as_matrix()))
    assert judge("1.4", R).status == "passed"


def test_the_names_for_the_truth_are_not_the_names_of_mistakes():
    named = {m.slug for _, f in FUNCTIONS for m in mistakes_of(f)}
    assert named & TRUTHFUL == {"left-handed"}  # true either way: det R is -1
    assert len(named) >= 45


def test_half_right_answers_are_told_so():
    T = right_answers("quat_to_R").copy()
    T[4:] = T[4:] @ se3.Rx(0.3)
    message = judge("1.4", answers("1.4", "quat_to_R", T)).message
    assert "right for 4 of 10 inputs" in message
