"""The numbers that the inspector shows, and what they are drawn as."""

import importlib.util
import re
from itertools import starmap

import numpy as np
import pytest

from conftest import need
from labkit.inspector import words
from labkit.inspector.arm import AGREES, END, Arm
from robo47 import panda, verify

pytestmark = pytest.mark.kit


@pytest.fixture
def arm(either_panda) -> Arm:
    return Arm(either_panda, panda.END_FRAME["panda_nohand"])


def test_it_starts_at_the_handouts_home_q(arm):
    np.testing.assert_array_equal(arm.q, panda.READY_Q)


def test_every_link_has_a_frame_and_the_end_is_called_ee(arm):
    assert list(arm.names) == [END, *(f"link{i}" for i in range(8))]
    assert arm.names[END] == "site:attachment_site"


def test_with_the_hand_the_end_is_the_hand_and_the_fingers_have_frames():
    arm = Arm(panda.load("panda"), panda.END_FRAME["panda"])
    assert arm.names[END] == "body:hand"
    assert {"left_finger", "right_finger"} < set(arm.names)
    assert len(arm.named_q["ready"]) == 9


def test_both_judges_agree_on_every_frame_in_random_configurations(arm):
    for seed in range(5):
        arm.move(arm.random_q(seed))
        assert max(starmap(arm.difference, arm.by_library.items())) < 1e-12


def test_a_wrong_pose_is_reported_as_different(arm):
    wrong = arm.by_library[END].copy()
    wrong[0, 3] += 1e-6
    assert arm.difference(END, wrong) == pytest.approx(1e-6, rel=1e-6)
    assert "THEY DIFFER" in words.verdict(arm.difference(END, wrong), "yours")
    assert "they agree" in words.verdict(AGREES / 2, "yours")
    assert "THEY DIFFER" in words.verdict(float("nan"), "yours")


def test_the_steps_lead_from_the_world_to_the_end_effector(arm):
    arm.move(arm.random_q(7))
    steps = arm.steps()
    truth = verify.mujoco_poses(arm.model, arm.q[None])
    assert [step.link for step in steps if not step.joint] == [
        *(f"link{i}" for i in range(8)), END,
    ]  # fmt: skip
    assert [step.joint for step in steps if step.joint] == arm.joints
    so_far = np.eye(4)
    for step, then in zip(steps, [*steps[1:], None], strict=True):
        np.testing.assert_array_equal(step.before, so_far)
        so_far = step.before @ step.factor
        np.testing.assert_array_equal(step.after, so_far)
        if then is None or then.link != step.link:  # its own joint is in
            expected = truth[arm.names[step.link]][0]
            np.testing.assert_allclose(step.after, expected, atol=1e-12)


def test_a_step_turns_with_its_own_joint_alone_and_marks_what_turns(arm):
    before = arm.steps()
    q = arm.q.copy()
    q[3] += 0.5
    arm.move(q)
    changed = [
        then
        for then, now in zip(before, arm.steps(), strict=True)
        if not np.array_equal(then.factor, now.factor)
    ]
    assert [step.joint for step in changed] == ["joint4"]
    turning = np.zeros((4, 4), dtype=bool)
    turning[:2, :2] = True  # a turn about z
    np.testing.assert_array_equal(changed[0].moves, turning)
    assert not any(step.moves.any() for step in before if not step.joint)


def test_zero_is_out_of_limits_for_joint4_and_home_is_not(arm):
    arm.move(arm.named_q["zero"])
    (warning,) = arm.out_of_limits()
    assert warning == "joint4 = 0.0000 is outside [-3.0718, -0.0698]"
    assert "OUT OF LIMITS" in words.limits(arm)
    arm.move(arm.named_q["home"])
    assert words.limits(arm) == ""


def test_random_configurations_are_within_limits_and_never_the_same(arm):
    drawn = [tuple(arm.random_q(seed)) for seed in range(20)]
    assert len(set(drawn)) == 20
    for q in drawn:
        arm.move(q)
        assert arm.out_of_limits() == []


def test_a_matrix_reads_back_as_the_numbers_it_shows(arm):
    T = arm.by_library[END]
    shown = words.matrix("T", T, "key").partition('data-matrix="key">')[2]
    text = re.sub("<[^>]+>", " ", shown)
    numbers = [float(n) for n in text.split()]
    np.testing.assert_allclose(np.reshape(numbers, (4, 4)), T, atol=5.1e-7)
    assert "-0.000000" not in text


def test_a_configuration_that_is_no_configuration_is_refused(arm):
    for wrong in ([0.0] * 6, [np.nan] * 7):
        with pytest.raises(ValueError, match=r"^q "):
            arm.move(wrong)


def shapes_of(model):
    need(importlib.util.find_spec("trimesh") is not None, "trimesh: make view")
    from labkit.inspector.shapes import shapes

    return shapes(model)


@pytest.mark.meshes
def test_the_real_panda_is_drawn_with_its_visual_meshes_alone(real_panda):
    model = panda.load(meshes=True)
    made = shapes_of(model)
    assert {shape.body for shape in made} == {f"link{i}" for i in range(8)}
    visual = [g for g in range(model.ngeom) if model.geom_group[g] == 2]
    faces = sum(int(model.mesh_facenum[model.geom_dataid[g]]) for g in visual)
    assert sum(len(shape.faces) for shape in made) == faces
    for shape in made:
        assert shape.faces.max() < len(shape.vertices)
        assert np.abs(shape.vertices).max() < 0.5  # metres, on its own body


@pytest.mark.meshes
def test_a_mesh_stands_where_mujoco_puts_it(real_panda):
    import mujoco

    model = panda.load(meshes=True)
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    (link1,) = [s for s in shapes_of(model) if s.body == "link1"]
    (geom,) = [
        g
        for g in range(model.ngeom)
        if model.geom_group[g] == 2 and model.geom_bodyid[g] == model.body("link1").id
    ]
    mesh = model.mesh(model.geom_dataid[geom])
    first = int(mesh.vertadr[0])
    stored = model.mesh_vert[first : first + int(mesh.vertnum[0])]
    R, p = data.geom_xmat[geom].reshape(3, 3), data.geom_xpos[geom]
    world = stored @ R.T + p
    body = data.body("link1")
    ours = link1.vertices @ body.xmat.reshape(3, 3).T + body.xpos
    for pick in (np.min, np.max):
        np.testing.assert_allclose(pick(ours, 0), pick(world, 0), atol=1e-6)


def test_the_twin_is_drawn_with_primitives(twin):
    made = shapes_of(panda.load("panda", meshes=True))
    assert {"link0", "link7", "hand", "left_finger"} <= {s.body for s in made}
    (base,) = [s for s in made if s.body == "link0"]
    low, high = base.vertices.min(axis=0), base.vertices.max(axis=0)
    np.testing.assert_allclose(low, [-0.11, -0.08, 0.0], atol=1e-3)
    np.testing.assert_allclose(high, [0.05, 0.08, 0.06], atol=1e-3)


def test_planes_and_hidden_groups_are_left_out_and_every_primitive_has_its_size():
    import mujoco

    model = mujoco.MjModel.from_xml_string(
        """<mujoco><worldbody>
        <geom type="plane" size="1 1 1"/>
        <geom type="box" size="9 9 9" group="3"/>
        <body name="s"><geom type="sphere" size="0.1"/></body>
        <body name="e"><geom type="ellipsoid" size="0.1 0.2 0.3"/></body>
        <body name="b"><geom type="box" size="0.1 0.2 0.3"/></body>
        <body name="c"><geom type="capsule" size="0.1 0.2"/></body>
        <body name="y"><geom type="cylinder" size="0.1 0.2" pos="1 0 0"/></body>
        </worldbody></mujoco>"""
    )
    made = {s.body: (s.vertices.min(0), s.vertices.max(0)) for s in shapes_of(model)}
    expected = {
        "s": ([-0.1, -0.1, -0.1], [0.1, 0.1, 0.1]),
        "e": ([-0.1, -0.2, -0.3], [0.1, 0.2, 0.3]),
        "b": ([-0.1, -0.2, -0.3], [0.1, 0.2, 0.3]),
        "c": ([-0.1, -0.1, -0.3], [0.1, 0.1, 0.3]),
        "y": ([0.9, -0.1, -0.2], [1.1, 0.1, 0.2]),
    }
    assert made.keys() == expected.keys()
    for body, (low, high) in expected.items():
        np.testing.assert_allclose(made[body], (low, high), atol=1e-3)


def test_a_hand_stays_on_the_last_link_of_a_ghost():
    model = panda.load("panda")
    arm = Arm(model, panda.END_FRAME["panda"])
    there = arm.poses_at(panda.home_q(model) + 0.1 * np.eye(model.nq)[0])
    links = {f"link{i}": there[f"link{i}"] for i in range(8)}
    carried = arm.carried(links)
    assert {"hand", "left_finger", "right_finger"} <= set(carried)
    np.testing.assert_allclose(carried["left_finger"], there["left_finger"], atol=1e-12)
    np.testing.assert_allclose(carried["link3"], there["link3"], atol=1e-12)
    del links["link7"]  # no answer for it: nothing is known of the hand either
    assert arm.carried(links) == links
