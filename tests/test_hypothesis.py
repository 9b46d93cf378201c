"""When a hypothesis explains a student's answers: it explains the difference."""

import numpy as np
import pytest
from test_claims import right, told
from toyrows import row_of
from toyrows import told as judged

from labkit.judge import Symmetric, Vector
from labkit.judge.hypothesis import Difference, equals, evidence

T = np.array([[1.0, 2.0], [3.0, 50.0], [0.5, 0.0]])
OFF = np.array([[0.5, 0.0], [0.0, 1.0], [0.0, 0.0]])
ROW = row_of(Vector((2,)), lambda x: x, lambda rng: [(0.0,)]).ask


def holds(S, H, row=ROW):
    return Difference(row, (np.asarray(S),), (T,)).explains((np.asarray(H),))


def test_it_leaves_less_than_a_hundredth_of_the_difference():
    S = T + OFF
    assert holds(S, T + 0.995 * (S - T))
    assert not holds(S, T + 0.98 * (S - T))


def test_it_does_so_at_every_call():
    S = T + OFF
    H = S.copy()
    H[1] = T[1]
    assert not holds(S, H)
    H = S.copy()
    H[2, 1] = 0.1  # where the student is right
    assert not holds(S, H)


def test_a_change_that_leaves_the_right_answer_as_it_is_explains_nothing():
    for off in (2e-4, 1e-3, 1.0):
        assert not holds(T + off, T)


def test_single_precision_is_no_other_answer_where_both_are_right():
    S = (T + OFF).astype(np.float32)
    assert holds(S, T + OFF)


def test_what_is_infinite_has_to_be_infinite_at_the_same_places():
    S = T.copy()
    S[0, 0] = np.inf
    assert holds(S, S)
    assert not holds(S, T)


def test_exactly_is_said_of_equal_numbers_alone():
    S = (T * [3.0, 1.0],)
    assert equals(ROW.kinds, S, (S[0] * (1.0 + 1e-13),))
    assert not equals(ROW.kinds, S, (S[0] * (1.0 + 1e-7),))
    assert "same output" in evidence(exact=True)
    assert "reproduces" not in evidence(exact=False)


@pytest.mark.kit
@pytest.mark.parametrize("ridge", [3e-6, 1e-5, 3e-5])
def test_a_symmetric_matrix_with_a_ridge_is_not_called_transposed(ridge):
    def inverse_of(A):
        return np.linalg.inv(A)

    def inputs(rng):
        for _ in range(8):
            J = rng.normal(size=(3, 3))
            yield (J @ J.T + 0.1 * np.eye(3),)

    row = row_of(Symmetric((3, 3)), inverse_of, inputs, near=1e-5)
    verdict = judged(row, lambda A: np.linalg.inv(A + ridge * np.eye(3)))
    assert verdict.status != "passed"
    assert "transpose" not in verdict.message


@pytest.mark.kit
@pytest.mark.parametrize("ridge", [3e-6, 1e-5])
def test_a_ridge_in_the_kalman_update_is_not_a_transposed_covariance(ridge):
    update = right(9, "kalman_update")

    def kalman_update(x, P, z, H, R):
        return update(x, P, z, H, R + ridge * np.eye(len(R)))

    says = told(9, "9.5", kalman_update=kalman_update)
    assert "transposed" not in says


@pytest.mark.parametrize("lost", [np.inf, -np.inf, np.nan, 3e17, -8e15])
def test_what_a_division_by_almost_zero_leaves_may_be_huge_infinite_or_nan(lost):
    S = T + OFF
    H = S.copy()
    S[1, 0], H[1, 0] = np.nan, lost
    assert holds(S, H)
    assert holds(H, S)
    H[0, 0] += 0.1  # of the other numbers it has to explain each
    assert not holds(S, H)
    H = S.copy()
    H[1, 0] = 3.0
    assert not holds(S, H)
