"""One configuration in plain floats: the same poses as in a batch, and MuJoCo's."""

import mujoco
import numpy as np
import pytest
from compare import assert_same
from hypothesis import given, settings
from hypothesis import strategies as st
from test_screws import any_screws, poses

from bench.bench_fk import tilted_panda
from robo47 import jacobian, kinematics, panda, screws, verify
from robo47.fast.chains import one_of
from robo47.fast.exponentials import plan_of
from robo47.fast.jacobians import columns_of, jacobians

EVERY_JOINT = """
<mujoco><worldbody><body name="a" pos="0.1 0.2 0.3" quat="1 2 3 4">
  <joint name="s" type="slide" axis="1 1 0" ref="0.2"/>
  <joint name="h" axis="1 2 3" pos="0.3 0 0.1" ref="0.5"/>
  <geom size="1"/><site name="tip" pos="0 0 1" quat="1 0 1 0"/>
  {more}
</body></worldbody></mujoco>"""
BALL = '<body name="b" pos="1 0 0"><joint type="ball"/><geom size="1"/></body>'


@pytest.mark.parametrize("entry", ["panda", "panda_nohand", "tilted"])
def test_every_frame_of_one_configuration_is_mujocos(entry, twin):
    model = tilted_panda() if entry == "tilted" else panda.load(entry)
    q = verify.random_q(model, 30, seed=5)
    truth = verify.mujoco_poses(model, q)
    for i, row in enumerate(q):
        for frame, T in kinematics.fk_all(model, row).items():
            assert_same(T, truth[frame][i], 1e-13)


def test_slides_and_references_are_taken_into_account():
    model = mujoco.MjModel.from_xml_string(EVERY_JOINT.format(more=""))
    q = verify.random_q(model, 20, seed=5)
    truth = verify.mujoco_poses(model, q)["site:tip"]
    chain = kinematics.chain_to(model, "tip")
    for row, T in zip(q, truth, strict=True):
        assert_same(kinematics.fk(chain, row), T, 1e-14)


@settings(max_examples=50, deadline=None)
@given(S=st.lists(any_screws(), min_size=1, max_size=7), M=poses())
def test_the_jacobians_are_the_formulas_whatever_the_joints(S, M):
    S, q = np.array(S), np.random.default_rng(1).uniform(-3, 3, (2, len(S)))
    formula = jacobian.space_jacobian(np.stack([S, S]), q)
    assert_same(jacobian.space_jacobian(S, q), formula, 1e-12)
    T = screws.fk_space(S, M, q)
    at_end = jacobian.site_jacobian(formula, T[:, :3, 3])
    assert_same(jacobians(S, M, q, at_end=True), at_end, 1e-12)
    for i in range(2):
        assert_same(jacobian.space_jacobian(S, q[i]), formula[i], 1e-12)
        columns, frame = columns_of(plan_of(S, M), one_of(q[i].tolist()), at_end=True)
        assert_same(np.transpose(frame), T[i, :3], 1e-12)
        assert_same(np.transpose(columns), at_end[i], 1e-12)


def test_a_ball_joint_alone_is_what_it_is_in_a_batch():
    model = mujoco.MjModel.from_xml_string(EVERY_JOINT.format(more=BALL))
    chain = kinematics.chain_to(model, "body:b")
    q = np.array([0.3, 0.4, 1.0, 2.0, 0.0, 3.0])
    assert_same(kinematics.fk(chain, q), kinematics.fk(chain, [q, q])[1], 1e-15)
    q[2:] = 0.0
    with pytest.raises(ValueError, match="joint 2: its quaternion in qpos has length"):
        kinematics.fk(chain, q)


def test_the_shape_is_the_callers_and_nothing_is_shared(twin):
    chain = kinematics.chain_to(panda.load(), "attachment_site")
    one = kinematics.fk(chain, panda.READY_Q)
    assert_same(kinematics.fk(chain, panda.READY_Q[None, None]), one[None, None], 0.0)
    kinematics.fk(chain, panda.READY_Q)[:] = 0.0
    assert_same(kinematics.fk(chain, panda.READY_Q), one, 0.0)
