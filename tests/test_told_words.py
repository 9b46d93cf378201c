"""The words of the checker's sentences: one place makes each of them."""

import ast

import inprocess
import numpy as np
import pytest
from toyrows import row_of, told

from labkit.judge import (
    Count,
    Covariance,
    Jacobian,
    Mask,
    Matrix,
    Scalar,
    Symmetric,
    Twist,
    Vector,
)
from labkit.judge.answers import is_or_are, of_result
from labkit.judge.kinds import Kind
from labkit.judge.matrix_kinds import part_off
from labkit.judge.mistake import Finding, both_told
from labkit.judge.results import as_sent, expected, flat_kinds, read
from labkit.judge.rigid_kinds import rotation_wrong
from labkit.judge.sentence import of_a_limit, of_a_step
from robo47.se3 import Rx


def test_what_a_wrong_shape_comes_from_is_a_sentence():
    found = Jacobian((6, 7)).read([np.zeros((7, 6))])
    assert found.message.endswith("a 6x7 matrix. Rows and columns are swapped.")


@pytest.mark.parametrize(
    ("shape", "words"),
    [
        ((2, 3), "an array of shape (2, 3)"),
        ((None,), "an array with 1 axis"),
        ((None, None, None), "an array with 3 axes"),
        ((None, 2), "an array of shape (n, 2) with any n"),
        ((None, None, 3), "an array of shape (n, m, 3) with any n and m"),
    ],
)
def test_a_size_that_the_question_decides_is_a_letter(shape, words):
    assert Kind(shape).expected == words


def test_results_that_are_alike_are_described_once():
    seven, one = Vector((7,)), Scalar()
    assert expected((seven, seven)) == "expected 2 results, each a vector of 7 numbers"
    both = "expected 2 results: a vector of 7 numbers and one number"
    assert expected((seven, one)) == both
    names = MEAN, Vector((2,), called="the mode"), Scalar(called="the loss")
    assert expected(names[:2]) == (
        "expected 2 results (the mean and the mode), each a vector of 2 numbers"
    )
    assert expected(names[1:]) == (
        "expected 2 results: the mode (a vector of 2 numbers) and the loss (one number)"
    )


def test_a_half_that_is_correct_is_yours():
    T = np.array([[1.0, 2.0, 3.0, 4.0, 5.0, 6.0], [2.0, 1.0, 0.0, 5.0, 1.0, 4.0]])
    S = T + np.array([0.0, 0.0, 0.0, 0.5, -0.25, 0.0])
    says = "Your omega is correct, but your v is not. Largest error: 0.5."
    assert Twist().what_is_wrong(S, T).message == says


class Acceleration(Twist):
    halves = ("the angular half", "the linear half")


def test_a_half_with_an_article_has_no_other_determiner():
    T = np.array([[1.0, 2.0, 3.0, 4.0, 5.0, 6.0], [2.0, 1.0, 0.0, 5.0, 1.0, 4.0]])
    S = T + np.array([0.0, 0.0, 0.0, 0.5, -0.25, 0.0])
    says = "The angular half is correct, but the linear half is not."
    assert Acceleration().what_is_wrong(S, T).message.startswith(says)
    says = "The angular half and the linear half are both wrong."
    assert Acceleration().what_is_wrong(T[::-1] ** 2, T).message.startswith(says)


@pytest.mark.parametrize(
    ("rows", "columns", "where"),
    [
        (
            ("vx", "vy", "vz"),
            ("a", "b", "c", "d"),
            "the rows vx and vy of the column b.",
        ),
        (("the x", "the y", "the z"), (), "the rows of the x and the y of column 1"),
        ((), (), "rows 0 to 1 of column 1, counted from 0."),
    ],
)
def test_entries_that_are_wrong_are_in_rows_of_columns(rows, columns, where):
    T = np.arange(48.0).reshape(4, 3, 4) ** 1.5
    S = T.copy()
    S[:, :2, 1] += [[1.0, 2.0], [3.0, 4.0], [0.5, 1.0], [1.0, 3.0]]
    kind = Matrix((3, 4), rows=rows, columns=columns)
    if not rows:
        S[:, 1, 1] += 1.0
    says = part_off(kind, S, T).message
    assert says.startswith(f"All entries are correct except in {where}")


def test_a_verb_agrees_with_its_result():
    assert of_result("The result is wrong in all 2 calls.", "the levels") == (
        "The levels are wrong in all 2 calls."
    )
    assert of_result("Largest error: 2.", "the levels") == (
        "The levels are wrong. Largest error: 2."
    )
    singular = ("the loss", "the NIS", "the axis", "the vector of means", "v", "m")
    assert {is_or_are([name]) for name in singular} == {"is"}
    assert is_or_are(["the images"]) == is_or_are(["A", "B"]) == "are"


def test_a_mistake_that_is_a_question_keeps_its_mark():
    says = both_told("does your loop end one sample too early?", "your code adds 1")
    assert says == (
        "Two mistakes together would explain your result. First, does your loop end "
        "one sample too early? Second, your code adds 1."
    )


def test_your_code_for_a_step_stays_your_code():
    says = both_told("your code adds 1", "your code for the next pose uses 2")
    assert says.endswith(
        "First, your code adds 1. Second, your code for the next pose uses 2."
    )


def test_your_code_is_said_once_of_two_mistakes():
    says = both_told("your code adds 1", "your code returns `x`, because it is 0")
    assert says == (
        "Two mistakes together would explain your result. First, your code adds 1. "
        "Second, it returns `x`, because it is 0."
    )
    rule = both_told("your code adds 1. Add 2", "your code returns 0")
    assert rule.endswith("First, your code adds 1. Add 2. Second, your code returns 0.")
    assert "Second, R is" in both_told("your code adds 1", "R is transposed")


@pytest.mark.parametrize(
    ("gloss", "step"),
    [
        ("row 1", "row 1"),
        ("row i of J; the first is 0", "row i of J"),
        ("row of the Jacobian", "the row of the Jacobian"),
        ("entry [a, b] of the windows", "the entry [a, b] of the windows"),
        ("cost-to-go after the last step: a number", "the cost-to-go after the last"
         " step"),
        ("J_site of the hand", "J_site of the hand"),
        ("x of the hand", "x of the hand"),
        ("(T, n)", 'the step "(T, n)"'),
    ],
)  # fmt: skip
def test_a_gloss_has_an_article_where_a_noun_needs_one(gloss, step):
    assert of_a_step(gloss) == step


def test_a_rotation_is_yours_and_has_no_name_that_a_student_need_not_have():
    T = np.stack([np.eye(3), Rx(0.5)])
    S = np.stack([Rx(0.25), Rx(1.5)])
    says = "Your rotation matrix is valid, but it is not the correct one."
    assert rotation_wrong(S, T).message.startswith(f"{says} Largest error: ")
    says = "Your rotation matrix R is not valid, because its columns are not"
    assert rotation_wrong(2 * S, T).message.startswith(says)


def test_truth_values_are_counted_in_calls_or_entries():
    T = np.array([0.0, 0.0, 1.0, 1.0])
    says = Mask().what_is_wrong(np.array([1.0, 1.0, 0.0, 1.0]), T).message
    assert says == (
        "Your function returned True in 2 calls; expected False. "
        "It returned False in 1 call; expected True."
    )


@pytest.mark.parametrize(
    ("says", "named"),
    [
        ("Every entry of the result is 2 times the correct value.",
         "Every entry of the loss is 2 times the correct value."),
        ("Every entry of your result has the wrong sign. The result is wrong.",
         "Every entry of the loss has the wrong sign. The loss is wrong."),
        ("Your matrix is transposed.", "For the loss, your matrix is transposed."),
        ("The results are correct.", "For the loss, the results are correct."),
    ],
)  # fmt: skip
def test_a_result_of_several_has_its_name_in_the_sentence(says, named):
    assert of_result(says, "the loss") == named


@pytest.mark.parametrize(
    ("right", "wrong", "says"),
    [
        ("x / y", "np.clip(x / y, -1.0, 1.0)", "clamps a value to [-1, 1]"),
        ("x + 1", "np.maximum(x + 1, 0.0)", "sets negative values to 0"),
        ("np.clip(x, a, b)", "np.maximum(np.clip(x, a, b), 0.5)",
         "applies a limit that does not belong to the formula"),
        ("np.minimum(np.sum(x), 1)", "np.sum(x)", "omits a limit"),
        ("min(x, 1)", "x", "omits a limit"),
        ("np.clip(x, a, b)", "np.minimum(x, b)", "applies a limit only on one side"),
        ("np.clip(x, a, b)", "np.clip(x, -b, b)", "applies a wrong limit"),
    ],
)  # fmt: skip
def test_a_limit_is_missing_or_one_too_many(right, wrong, says):
    of = [ast.parse(text, mode="eval").body for text in (right, wrong)]
    assert of_a_limit(*of) == says


MEAN, COVARIANCE = Vector((2,), called="the mean"), Covariance((2, 2), called="P")


@pytest.mark.parametrize(
    ("kind", "answer", "says"),
    [
        ((MEAN, COVARIANCE), (np.zeros(2), np.zeros(2)),
         "Your second result, P, is an array of shape (2,) in 1 of 2 calls; expected a "
         "2x2 matrix."),
        ((MEAN, COVARIANCE), (None, np.eye(2)),
         "Your first result, the mean, is None; expected a vector of 2 numbers."),
        ((MEAN, COVARIANCE), (1j * np.zeros(2), np.eye(2)),
         "Your first result, the mean, is an array of complex numbers; expected real "
         "numbers (a vector of 2 numbers)."),
        ((Count(), (Mask((2,)), MEAN)), (1, (np.zeros(2, bool), [[1, 2], [3]])),
         "Your result [1][1], the mean, is a list whose parts have the shapes (2,) and "
         "(1,); expected a vector of 2 numbers."),
        ((MEAN, Mask((2,))), (np.zeros(2), np.zeros(3, bool)),
         "Your second result is an array of shape (3,) in 1 of 2 calls; expected True "
         "or False, in shape (2,)."),
        (MEAN, np.zeros(3),
         "Your function returns an array of shape (3,) in 1 of 2 calls; expected a "
         "vector of 2 numbers."),
    ],
)  # fmt: skip
def test_a_shape_that_is_wrong_is_that_of_one_result(kind, answer, says):
    right = as_sent(kind, [np.zeros([*one.shape]) for one in flat_kinds(kind)])
    found = read(kind, [right, answer])
    assert isinstance(found, Finding)
    assert found.message == says


def test_a_size_that_a_question_decides_is_that_of_one_result():
    kinds = Scalar(called="the loss"), Matrix((None, 2), called="the gradient")
    inputs = [(np.ones((n, 2)),) for n in (1, 2, 3)]
    row = row_of(kinds, lambda x: (x.sum(), 3.0 * x), lambda rng: inputs)
    verdict = told(row, lambda x: (x.sum(), 3.0 * x[:2] + 1.0))
    says = "Your second result, the gradient, has the wrong shape in 1 of"
    assert verdict.message.startswith(f"{says} 3 calls.")


def test_a_result_that_is_larger_by_orders_of_magnitude_is_told_by_the_factor():
    T = np.array([[1.0, 2.0], [3.0, 4.0]])
    kind = Vector((2,), "m")
    assert kind.largest_error(T * [1.0, 3.0e13], T) == (
        "The result is over 1e13 times as large as expected."
    )
    assert kind.largest_error(T * [1.0, 1.0e6], T).startswith("Largest error: ")


def test_where_some_results_alone_are_larger_the_error_of_the_others_is_told():
    T = np.array([[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]])
    S = T + np.array([[0.0, 0.5], [0.0, 3.0e13], [0.0, 0.0]])
    assert Vector((2,), "m").largest_error(S, T) == (
        "The result is over 1e12 times as large as expected in 1 of 3 calls. "
        "In the other calls, the largest error is 0.5 m."
    )


def test_the_factor_of_several_large_results_is_that_of_the_smallest_one():
    T = np.array([1.0, 1.0, 1.0])
    says = Scalar(unit="m").largest_error(np.array([1.0, 3.0e13, 3.0e17]), T)
    assert says == "The result is over 1e13 times as large as expected."


def test_the_distance_and_the_determinant_are_of_the_same_matrix():
    """One is further from orthonormal, the other's determinant is further from 1."""
    shear, stretched = np.eye(3), np.diag([1.5, 1.5, 1.5])
    shear[0, 1] = 4.0
    S = np.array([stretched, shear])
    _, says = rotation_wrong(S, np.array([np.eye(3)] * 2))
    assert "(R R^T differs from the identity matrix by 16.)" in says
    _, says = rotation_wrong(S[:1], np.array([np.eye(3)]))
    assert "by 1.2; det R is 3.38, not 1.)" in says


@pytest.mark.parametrize(
    ("every", "says"),
    [
        (1, "Only the diagonal is correct."),
        (2, "The diagonal is correct, but other entries are not."),
    ],
)
def test_only_the_diagonal_is_correct_where_no_other_entry_is(every, says):
    T = np.arange(180.0).reshape(5, 6, 6)
    T += T.mT
    i = np.arange(6)
    wrong = ((i[:, None] + i) % every == 0) & (i[:, None] != i)
    off = 1.5 ** np.arange(5.0)[:, None, None] * wrong
    assert Symmetric((6, 6)).what_is_wrong(T + off, T).message.startswith(says)


def numbers(rng):
    return [(rng.numbers(0.1, 0.9, 3),) for _ in range(6)]


def large(rng):
    return [(rng.numbers(1.1, 4.9, 3),) for _ in range(6)]


@pytest.mark.parametrize(("inputs", "is_told"), [(numbers, False), (large, True)])
def test_whole_numbers_are_told_only_where_a_right_answer_has_one(inputs, is_told):
    row = row_of(Vector((3,)), lambda x: x, inputs)
    tiny = (lambda x: np.trunc(x)) if is_told else (lambda x: 1e-4 * x * x)
    verdict = told(row, tiny)
    assert (verdict.mistake == "whole-numbers") == is_told


def sizes(rng):
    return [(rng.numbers(1, 5, n),) for n in (2, 3, 4, 6, 7, 8)]


@pytest.mark.parametrize("many", [False, True])
def test_the_call_that_is_shown_has_the_wrong_shape_that_is_told(many):
    shape = Vector((None,))
    kinds = (Scalar(called="the sum"), shape) if many else shape
    row = row_of(kinds, lambda x: (x.sum(), x + 1) if many else x + 1, sizes)

    def student(x):
        one = x + 1 if len(x) < 6 else np.append(x + 1, 0.0)
        one = one + (len(x) == 2)  # a value is wrong in a shorter call
        return (x.sum(), one) if many else one

    verdict = told(row, student)
    assert "wrong shape in 3 of 6 calls" in verdict.message
    assert "returned shape (7,); expected shape (6,)." in verdict.call


def test_a_result_of_several_that_has_a_wrong_shape_is_shown():
    kinds = Scalar(called="the sum"), Vector((3,), called="the sums")
    row = row_of(kinds, lambda x: (x.sum(), x + 1), large)
    verdict = told(row, lambda x: (x.sum(), (x + 1)[:2]))
    assert verdict.call.endswith("[1] returned shape (2,).")


def test_an_argument_handed_back_inside_a_tuple_shares_its_memory():
    x, y = np.ones(3), np.ones(3)
    assert inprocess._shares((y.copy(), x[1:]), [], [y, x]) == ([], [1])
    kept = []
    assert inprocess._shares((x,), kept, []) == ([], [])
    assert inprocess._shares((y, x[:1]), kept, []) == (["another answer"], [])
