"""The oracle: MuJoCo's own poses, and the search for the worst difference."""

import mujoco
import numpy as np
import pytest
from compare import assert_same

from robo47 import panda, verify


def test_the_poses_are_those_of_mj_forward(twin):
    model = panda.load("panda_nohand")
    q = verify.random_q(model, 5, seed=1)
    poses = verify.mujoco_poses(model, q)
    data = mujoco.MjData(model)
    for i, row in enumerate(q):
        data.qpos[:] = row
        mujoco.mj_forward(model, data)
        assert_same(poses["body:link4"][i, :3, 3], data.body("link4").xpos, 0.0)
        site = data.site("attachment_site")
        T = poses["site:attachment_site"][i]
        assert_same(T[:3, :3], site.xmat.reshape(3, 3), 0.0)
        assert_same(T[:3, 3], site.xpos, 0.0)
        assert_same(T[3], [0, 0, 0, 1], 0.0)


def test_random_configurations_fill_the_joint_limits_and_repeat(either_panda):
    q = verify.random_q(either_panda, 4000, seed=47)
    low, high = either_panda.jnt_range.T
    assert np.all((q >= low) & (q <= high))
    assert np.all(np.ptp(q, axis=0) > 0.99 * (high - low))
    assert_same(verify.random_q(either_panda, 4000, seed=47), q, 0.0)
    assert np.any(verify.random_q(either_panda, 4000, seed=48) != q)


def test_joints_without_limits_get_a_full_turn_or_a_metre():
    model = mujoco.MjModel.from_xml_string("""
      <mujoco><worldbody><body><joint name="h"/><joint name="s" type="slide"/>
      <geom size="1"/></body></worldbody></mujoco>""")
    span = np.abs(verify.random_q(model, 4000, seed=1)).max(axis=0)
    assert_same(span, [np.pi, 1.0], 0.01)


def test_a_model_with_a_ball_joint_is_refused():
    model = mujoco.MjModel.from_xml_string("""
      <mujoco><worldbody><body><joint type="ball"/><geom size="1"/></body></worldbody>
      </mujoco>""")
    with pytest.raises(ValueError, match="ball or free joint"):
        verify.random_q(model, 1, seed=1)


def test_the_worst_difference_is_found_with_its_frame_and_configuration():
    truth = {"body:a": np.zeros((3, 4, 4)), "body:b": np.zeros((3, 4, 4))}
    ours = {name: T.copy() for name, T in truth.items()}
    ours["body:b"][2, 0, 3] = -0.25
    q = np.array([[10.0], [11.0], [12.0]])
    worst = verify.worst_difference(ours, truth, q)
    assert (worst.error, worst.frame, worst.q) == (0.25, "body:b", [12.0])


def test_nan_is_the_worst_difference_there_is():
    truth = {"body:a": np.zeros((2, 4, 4)), "body:b": np.zeros((2, 4, 4))}
    ours = {name: T + 1.0 for name, T in truth.items()}
    ours["body:a"][1, 0, 0] = np.nan
    worst = verify.worst_difference(ours, truth, np.zeros((2, 1)))
    assert (worst.error, worst.frame) == (np.inf, "body:a")


def test_sets_of_different_frames_are_not_compared():
    with pytest.raises(ValueError, match="body:b"):
        verify.worst_difference({"body:a": np.eye(4)}, {"body:b": np.eye(4)}, np.eye(1))
