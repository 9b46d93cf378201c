"""Forward kinematics by hand against MuJoCo, Pinocchio and the textbook."""

import json
from pathlib import Path

import mujoco
import numpy as np
import pytest
from compare import assert_same
from hypothesis import given
from hypothesis import strategies as st

from robo47 import kinematics, panda, verify
from robo47.fast import chains

PINOCCHIO = Path(__file__).parent / "data" / "pinocchio_panda.json"

# Every joint type, odd axes, anchors off the origin, several joints on one body,
# reference values, a tree, unnamed bodies, sites that are turned.
ZOO = """
<mujoco>
  <compiler angle="radian"/>
  <worldbody>
    <site name="origin" pos="1 2 3" quat="1 2 3 4"/>
    <body name="cart" pos="0.1 0.2 0.3" quat="1 0.2 0 0">
      <joint name="rail" type="slide" axis="1 2 0" ref="0.4"/>
      <joint name="swivel" axis="0.3 -0.5 1" pos="0.1 0 0.2" ref="-0.7"/>
      <geom size="0.1"/>
      <body pos="0.5 0 0">
        <joint axis="0 -1 0" pos="0 0.1 0"/>
        <geom size="0.1"/>
        <body name="wrist" pos="0 0 0.4" quat="0 1 1 0">
          <joint name="ball" type="ball" pos="0.05 -0.02 0.1"/>
          <geom size="0.1"/>
          <site name="tip" pos="0 0.1 0" quat="0.5 0.1 0.2 0.3"/>
          <site name="wrist"/>
        </body>
        <body name="thumb" quat="1 1 0 0">
          <joint name="lift" type="slide" axis="0 0 -1"/>
          <joint name="roll" axis="1 0 0" pos="0 0.3 0"/>
          <joint name="yaw" axis="0 0 -1" pos="0 0.3 0.1"/>
          <geom size="0.1"/>
        </body>
      </body>
    </body>
    <body name="drone" pos="9 9 9" quat="0 1 0 0">
      <freejoint name="float"/>
      <geom size="0.1"/>
      <body name="rotor" pos="0.2 0 0.1">
        <joint name="spin" axis="0 1 1"/>
        <geom size="0.05"/>
      </body>
    </body>
  </worldbody>
</mujoco>
"""


@pytest.fixture(scope="module")
def zoo():
    return mujoco.MjModel.from_xml_string(ZOO)


def zoo_q(model, n, seed):
    """Random configurations with quaternions of random length."""
    return np.random.default_rng(seed).normal(size=(n, model.nq))


def off_mujoco(model, q):
    """The worst difference from MuJoCo over every named frame."""
    ours, truth = kinematics.fk_all(model, q), verify.mujoco_poses(model, q)
    return verify.worst_difference(ours, truth, q)


@pytest.mark.meshes
@pytest.mark.parametrize("entry", ["panda", "panda_nohand", "scene"])
def test_every_frame_of_the_real_panda_agrees_with_mujoco(real_panda, entry):
    assert verify.verify_fk(panda.load(entry), 2000, seed=47).error < 1e-14


@pytest.mark.parametrize("entry", ["panda", "panda_nohand", "scene"])
def test_every_frame_of_the_twin_agrees_with_mujoco(twin, entry):
    assert verify.verify_fk(panda.load(entry), 2000, seed=47).error < 1e-14


def test_every_joint_type_axis_and_anchor_agrees_with_mujoco(zoo):
    worst = off_mujoco(zoo, zoo_q(zoo, 300, seed=47))
    assert worst.error < 1e-13, worst


def test_the_chain_to_one_frame_agrees_with_the_whole_tree(zoo):
    q = zoo_q(zoo, 50, seed=1)
    everything = kinematics.fk_all(zoo, q)
    for frame, T in everything.items():
        assert_same(kinematics.fk(kinematics.chain_to(zoo, frame), q), T, 1e-13)


@pytest.mark.parametrize("entry", ["panda", "panda_nohand"])
def test_pinocchio_reads_the_same_poses_from_the_same_file(real_panda, entry):
    answer = json.loads(PINOCCHIO.read_text("utf-8"))["entries"][entry]
    model = panda.load(entry)
    assert len(answer["poses"]) >= 10
    for name, rows in answer["poses"].items():
        kind = "site" if name == "attachment_site" else "body"
        T = kinematics.fk(kinematics.chain_to(model, f"{kind}:{name}"), answer["q"])
        # Pinocchio lets the rounding of its fixed rotations add up; MuJoCo does not.
        assert_same(T[:, :3].reshape(-1, 12), rows, 2e-14)


def test_an_axis_that_is_nearly_one_of_the_frames_own_is_not_taken_for_it():
    # (1, 3e-8, 3e-8) is a unit vector whose first entry is 1 to the last bit.
    model = mujoco.MjModel.from_xml_string("""
      <mujoco><worldbody><body name="link"><joint axis="1 3e-8 3e-8"/>
      <geom size="1"/></body></worldbody></mujoco>""")
    q = [[1.0]]
    T = kinematics.fk(kinematics.chain_to(model, "link"), q)
    assert_same(T, verify.mujoco_poses(model, q)["body:link"], 1e-14)


@given(st.lists(st.floats(-1, 1), min_size=3, max_size=3), st.floats(-7, 7))
def test_a_hinge_about_any_axis_agrees_with_mujoco(axis, q):
    axis = np.round(axis, 9)  # MuJoCo 3.3 reads no denormal number
    if np.linalg.norm(axis) < 1e-3:
        return
    model = mujoco.MjModel.from_xml_string(f"""
      <mujoco><worldbody><body name="b" pos="1 2 3" quat="1 2 0 1">
        <joint axis="{axis[0]} {axis[1]} {axis[2]}" pos="0.1 0.2 0.3"/><geom size="1"/>
      </body></worldbody></mujoco>""")
    assert off_mujoco(model, np.array([[q]])).error < 1e-14


def test_leading_dimensions_of_qpos_are_kept(twin):
    model = panda.load("panda_nohand")
    chain = kinematics.chain_to(model, "attachment_site")
    q = verify.random_q(model, 6, seed=3)
    T = kinematics.fk(chain, q.reshape(2, 3, 7))
    assert T.shape == (2, 3, 4, 4)
    assert_same(T[1, 2], kinematics.fk(chain, q[5]), 1e-15)
    assert kinematics.fk(chain, q[0]).shape == (4, 4)
    assert kinematics.fk(chain, q[:0]).shape == (0, 4, 4)


def test_a_batch_longer_than_a_chunk_has_no_seam(twin):
    model = panda.load("panda")
    q = verify.random_q(model, 2 * chains.CHUNK + 7, seed=5)
    chain = kinematics.chain_to(model, "body:hand")
    T = kinematics.fk(chain, q)
    for i in (0, chains.CHUNK - 1, chains.CHUNK, 2 * chains.CHUNK, len(q) - 1):
        assert_same(T[i], kinematics.fk(chain, q[i]), 1e-15)


def test_the_chain_copies_what_it_reads(twin):
    model = panda.load("panda_nohand")
    chain = kinematics.chain_to(model, "body:link7")
    before = kinematics.fk(chain, panda.READY_Q)
    model.body_pos[:] = 0.0
    model.jnt_axis[:] = [1.0, 0.0, 0.0]
    assert_same(kinematics.fk(chain, panda.READY_Q), before, 0.0)


def test_a_mocap_body_stands_where_the_file_puts_it():
    model = mujoco.MjModel.from_xml_string("""
      <mujoco><worldbody><body name="m" mocap="true" pos="1 2 3" quat="1 1 0 0">
      <geom size="1"/></body></worldbody></mujoco>""")
    assert off_mujoco(model, np.zeros((1, 0))).error < 1e-15


def test_bare_names_serve_where_only_one_object_has_them(zoo):
    assert kinematics.chain_to(zoo, "tip").frame == "site:tip"
    assert kinematics.chain_to(zoo, "cart").frame == "body:cart"


@pytest.mark.parametrize(
    ("frame", "words"),
    [
        ("wrist", "is a body and a site; say body:wrist or site:wrist"),
        ("nobody", "no frame 'nobody'; the model has body:world, body:cart"),
        ("site:cart", "no frame 'site:cart'"),
        ("", "no frame ''"),
    ],
)
def test_a_frame_that_is_not_there_is_refused_with_the_names_that_are(
    zoo, frame, words
):
    with pytest.raises(ValueError, match=words):
        kinematics.chain_to(zoo, frame)


@pytest.mark.parametrize(
    ("q", "words"),
    [
        (np.zeros(6), r"qpos has shape \(6,\); expected \(..., 7\)"),
        (0.0, r"qpos has shape \(\)"),
        ("home", "not an array of numbers"),
        (
            [[0.0] * 7, [0.0, np.inf] + [0.0] * 5],
            "configuration 1 holds NaN or infinity",
        ),
        ([0.0] * 6 + [np.inf], "configuration 0 holds NaN"),  # alone: in plain floats
    ],
)
def test_a_configuration_that_does_not_fit_is_refused(twin, q, words):
    chain = kinematics.chain_to(panda.load("panda_nohand"), "attachment_site")
    with pytest.raises(ValueError, match=words):
        kinematics.fk(chain, q)


def test_a_ball_joint_without_a_direction_is_refused_by_name(zoo):
    q = zoo_q(zoo, 3, seed=1)
    adr = zoo.joint("ball").qposadr[0]
    q[2, adr : adr + 4] = 0.0
    with pytest.raises(ValueError, match="ball: its quaternion in qpos has length 0"):
        kinematics.fk_all(zoo, q)


def test_the_panda_needs_no_move_but_turns_and_shifts_up_to_its_hand(twin):
    chain = kinematics.chain_to(panda.load("panda"), "body:hand")
    *kinds, last = [type(step).__name__ for _, step in chain.plan.steps]
    assert kinds.count("Turn") == 7
    assert set(kinds) == {"Turn", "Shift"}, "a fixed rotation was not folded away"
    assert last == "Rotate"
