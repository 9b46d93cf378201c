"""Where along a chain of poses: one wrong factor, or the first wrong prefix."""

import numpy as np
import pytest

from labkit.judge import Finding
from labkit.judge.chain import Factor, first_wrong, one_place, product
from robo47 import se3

N = 12


@pytest.fixture
def factors():
    rng = np.random.default_rng(3)
    angles = rng.uniform(-2, 2, (N, 3))
    found = []
    for k in range(3):
        fixed = se3.make_T(se3.quat_to_R(rng.normal(size=4)), rng.uniform(-1, 1, 3))
        found.append(Factor(f"link{k}", np.broadcast_to(fixed, (N, 4, 4)), True))
        turned = se3.make_T(se3.Rz(angles[:, k]), np.zeros(3))
        back = (Finding("backwards", f"joint{k} turns backwards"), se3.inverse(turned))
        found.append(Factor(f"joint{k}", turned, False, lambda back=back: [back]))
    return found


def poses(factors, change=(), at=0):
    parts = [factor.T for factor in factors]
    if len(change):
        parts[at] = np.broadcast_to(change, (N, 4, 4))
    return product(parts, N)


def test_a_right_chain_has_no_wrong_place_that_explains_it(factors):
    T = poses(factors)
    named = one_place(T, T, factors)
    assert named is None or named.slug == "one-link-off"


@pytest.mark.parametrize("k", [0, 1, 2])
def test_a_wrong_joint_is_named(factors, k):
    S = poses(factors, se3.inverse(factors[2 * k + 1].T), 2 * k + 1)
    found = one_place(S, poses(factors), factors)
    assert found.slug == "backwards"
    assert f"joint{k}" in found.message


@pytest.mark.parametrize("k", [0, 1, 2])
def test_a_wrong_link_is_found_and_measured(factors, k):
    off = se3.make_T(se3.Rx(0.3), [0.0, 0.1, 0.0])
    S = poses(factors, factors[2 * k].T @ off, 2 * k)
    found = one_place(S, poses(factors), factors)
    assert found.slug == "one-link-off"
    assert f"link{k}" in found.message
    assert "17.2 deg" in found.message


def test_two_wrong_links_have_no_one_place(factors):
    off = se3.make_T(se3.Rx(0.3), [0.1, 0.1, 0.0])
    parts = [factor.T for factor in factors]
    parts[0], parts[4] = parts[0] @ off, parts[4] @ off
    assert one_place(product(parts, N), poses(factors), factors) is None


def test_the_first_wrong_prefix_is_named():
    names = ["a", "b", "c"]
    right = [np.eye(4)] * 3
    wrong = 2.0 * np.eye(4)
    assert first_wrong(names, right, right) == ""
    assert "already" in first_wrong(names, [wrong, wrong, wrong], right)
    says = first_wrong(names, [right[0], right[1], wrong], right)
    assert "correct up to b" in says
    assert "c is the first" in says
    assert first_wrong(names, [None, right[1], wrong], right) == ""
