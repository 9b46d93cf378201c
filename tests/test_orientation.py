"""Roll, pitch, yaw, quaternions and slerp against SciPy and MuJoCo."""

import hypothesis.extra.numpy as hnp
import mujoco
import numpy as np
import pytest
from compare import assert_same
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation, Slerp

from robo47 import orientation, se3

angles = hnp.arrays(np.float64, 3, elements=st.floats(-3.1, 3.1))
quats = hnp.arrays(np.float64, 4, elements=st.floats(-1, 1)).filter(
    lambda q: np.linalg.norm(q) > 0.1
)
fractions = st.floats(0.0, 1.0)


def scipys(q):
    return Rotation.from_quat(q, scalar_first=True)


@given(angles)
def test_roll_pitch_yaw_is_scipys_xyz_about_fixed_axes(rpy):
    truth = Rotation.from_euler("xyz", rpy).as_matrix()
    assert_same(orientation.rpy_to_R(rpy), truth, 1e-14)


@given(angles.filter(lambda rpy: abs(np.cos(rpy[1])) > 1e-3))
def test_the_angles_of_a_rotation_are_scipys(rpy):
    R = orientation.rpy_to_R(rpy)
    found = orientation.R_to_rpy(R)
    truth = Rotation.from_matrix(R).as_euler("xyz")
    off = np.mod(found - truth + np.pi, 2.0 * np.pi) - np.pi
    assert np.abs(off).max() < 1e-9
    assert_same(orientation.rpy_to_R(found), R, 1e-12)


@given(angles, st.sampled_from([-np.pi / 2, np.pi / 2]))
def test_at_gimbal_lock_the_roll_is_0_and_the_rotation_comes_back(rpy, pitch):
    R = orientation.rpy_to_R([rpy[0], pitch, rpy[2]])
    found = orientation.R_to_rpy(R)
    assert found[0] == 0.0
    assert found[1] == pytest.approx(pitch, abs=1e-12)
    assert_same(orientation.rpy_to_R(found), R, 1e-12)


@given(quats, quats)
def test_the_product_is_mujocos_and_turns_by_the_second_first(p, q):
    p = p / np.linalg.norm(p)
    q = q / np.linalg.norm(q)
    truth = np.empty(4)
    mujoco.mju_mulQuat(truth, p, q)
    ours = orientation.quat_product(p, q)
    assert_same(ours, truth, 1e-14)
    both = se3.quat_to_R(p) @ se3.quat_to_R(q)
    assert_same(se3.quat_to_R(ours), both, 1e-14)


@given(quats, quats, fractions)
def test_slerp_is_scipys(p, q, s):
    # At half a circle both ways are as short, and rounding chooses one.
    here = abs(p @ q) / np.linalg.norm(p) / np.linalg.norm(q)
    if here < 1e-6:
        return
    truth = Slerp([0.0, 1.0], Rotation.concatenate([scipys(p), scipys(q)]))([s])[0]
    ours = orientation.slerp(p, q, s)
    assert_same(se3.quat_to_R(ours), truth.as_matrix(), 1e-9)
    assert np.linalg.norm(ours) == pytest.approx(1.0, abs=1e-14)


@given(quats, quats, fractions)
def test_slerp_turns_at_a_constant_rate_from_either_end(p, q, s):
    there = orientation.slerp(p, q, s)
    back = orientation.slerp(q, p, 1.0 - s)
    if abs(p @ q) / np.linalg.norm(p) / np.linalg.norm(q) > 1e-6:
        assert_same(se3.quat_to_R(there), se3.quat_to_R(back), 1e-9)
    assert_same(orientation.slerp(p, q, 0.0), p / np.linalg.norm(p), 1e-14)


def test_slerp_keeps_all_digits_between_two_that_nearly_are_one():
    p = np.array([1.0, 0.0, 0.0, 0.0])
    for angle in (1e-3, 1e-7, 1e-9, 1e-12):
        q = np.array([np.cos(angle), np.sin(angle), 0.0, 0.0])
        ours = orientation.slerp(p, q, 0.25)
        assert ours[1] == pytest.approx(np.sin(0.25 * angle), rel=1e-12)


def test_many_at_once_equal_one_at_a_time():
    rng = np.random.default_rng(1)
    p, q = rng.normal(size=(2, 5, 4))
    s = np.linspace(0.0, 1.0, 5)
    many = orientation.slerp(p, q, s)
    products = orientation.quat_product(p, q)
    for i in range(5):
        assert_same(many[i], orientation.slerp(p[i], q[i], s[i]), 1e-15)
        assert_same(products[i], orientation.quat_product(p[i], q[i]), 1e-15)
    rpy = rng.uniform(-1, 1, (5, 3))
    assert_same(orientation.R_to_rpy(orientation.rpy_to_R(rpy)), rpy, 1e-14)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: orientation.rpy_to_R([0.0, 0.0]), "rpy has shape"),
        (lambda: orientation.R_to_rpy(np.ones((3, 3))), "R is not a rotation"),
        (lambda: orientation.quat_product(np.zeros(4), [1, 0, 0, 0]), "p_wxyz has len"),
        (lambda: orientation.slerp([1, 0, 0, 0], [1, 0, 0], 0.5), "q_wxyz has shape"),
    ],
)
def test_what_is_wrong_is_named(call, words):
    with pytest.raises(ValueError, match=words):
        call()
