"""The arm's capsules and its surroundings against MuJoCo and the robot's own meshes."""

from itertools import pairwise

import mujoco
import numpy as np
import pytest
from compare import assert_same

from conftest import need
from robo47 import distance, panda, se3, shapes
from robo47.errors import Robo47Error
from robo47.fast import near
from robo47.panda import files

WORLD = shapes.World.of(
    posts=[((0.4, 0, 0), (0.4, 0, 0.9), 0.04), ((0.3, 0.3, 0.5), (0.3, 0.3, 0.5), 0.1)],
    boxes=[
        (se3.make_T(se3.Rz(0.3), (0.5, 0.2, 0.3)), (0.1, 0.2, 0.3)),
        (se3.make_T(se3.Rx(0.3), (0, -0.5, 0.3)), (0.3, 0.02, 0.3)),
    ],
)


@pytest.fixture(scope="module")
def measured():
    """Return the arm, 40 configurations, and MuJoCo's distances, (40, 9, 4)."""

    def edit(spec):
        shapes.add_arm(spec)
        WORLD.add_to(spec)

    model = panda.load("panda_nohand", edit=edit)
    data = mujoco.MjData(model)
    arm = shapes.Shape(model)
    rng = np.random.default_rng(11)
    q = rng.uniform(*model.jnt_range.T, (40, 7))
    truth = np.empty((40, len(arm.capsules), 4))
    for n, one in enumerate(q):
        data.qpos[:] = one
        mujoco.mj_kinematics(model, data)  # fills geom_xpos and geom_xmat
        for i, j in np.ndindex(truth.shape[1:]):
            pair = model.geom(f"arm{i}").id, model.geom(f"world{j}").id
            truth[n, i, j] = mujoco.mj_geomDistance(model, data, *pair, 10, np.zeros(6))
    return model, arm, q, truth


def test_the_arm_and_each_thing_are_as_far_apart_as_mujoco_says(measured):
    model, arm, q, truth = measured
    ours = arm.distances(q, WORLD)
    assert_same(ours[..., :2], truth[..., :2], 1e-14)  # capsules, inside too
    assert np.sum(truth[..., :2] < 0) > 5
    apart = truth > 0
    assert_same(ours[apart], truth[apart], 1e-14)
    assert np.all(ours[~apart] <= 1e-14)
    assert_same(arm.clearance(q, WORLD), ours.min(axis=(1, 2)), 0)
    again = shapes.World.of_model(model)
    assert_same(arm.distances(q, again), ours, 1e-14)


def test_many_configurations_have_the_distances_of_each_alone(measured):
    _, arm, q, _ = measured
    alone = [arm.distances(one, WORLD) for one in q]
    assert_same(arm.distances(q, WORLD), alone, 1e-14)
    assert_same(arm.distances(q.reshape(4, 10, 7), WORLD),
                np.reshape(alone, (4, 10, 9, 4)), 1e-14)  # fmt: skip
    nothing = shapes.World.of()
    assert arm.distances(q, nothing).shape == (40, 9, 0)
    assert np.isinf(arm.clearance(q, nothing)).all()


def test_the_quick_distance_from_a_box_is_the_golden_sections_also_inside():
    rng = np.random.default_rng(11)
    ends = rng.uniform(-1, 1, (300, 2, 3))
    half = rng.uniform(0.1, 0.8, (300, 3))
    ends[:20, 1, 0] = ends[:20, 0, 0]  # along a face
    ends[20:30, 1] = ends[20:30, 0]  # a point
    quick = near.box_distances(ends[:, 0], ends[:, 1], half)
    slow = [
        distance.capsule_box_distance(*e, 0, np.eye(4), h)
        for e, h in zip(ends, half, strict=True)
    ]
    assert_same(quick, slow, 1e-12)
    assert np.sum(quick < 0) > 50


def test_an_edge_is_free_where_none_of_200_points_on_it_is_too_near(measured):
    _, arm, q, _ = measured
    free = 0
    for q0, q1 in pairwise(q):
        end = q0 + 0.6 * (q1 - q0) / np.linalg.norm(q1 - q0)
        on_it = q0 + np.linspace(0, 1, 200)[:, None] * (end - q0)
        least = arm.clearance(on_it, WORLD).min()
        for margin in (0.0, 0.005):
            if abs(least - margin) > 1e-3:
                assert arm.edge_free(q0, end, WORLD, margin) == (least > margin)
        free += least > 0
    assert 5 < free < 35


def test_an_edge_that_crosses_a_wire_anywhere_is_not_free():
    model = panda.load("panda_nohand")
    arm = shapes.Shape(model)
    q0 = panda.READY_Q
    dq = 0.5 * np.eye(7)[0]
    for s in np.linspace(0.013, 0.987, 23):
        tip = arm.ends(q0 + s * dq)[-1, 1]
        up = np.array([0, 0, 0.01])
        wire = shapes.World.of(posts=[(tip - up, tip + up, 1e-4)])
        assert not arm.edge_free(q0, q0 + dq, wire)
    assert arm.edge_free(q0, q0, shapes.World.of(posts=[((1, 0, 0), (1, 0, 1), 0.1)]))


@pytest.mark.kit
@pytest.mark.parametrize("entry", ["panda_nohand", "panda"])
def test_the_capsules_contain_every_point_of_the_collision_meshes(entry):
    need(files.panda_folder() is not None, "the Menagerie's meshes: make robot")
    model = panda.load(entry, meshes=True)
    data = mujoco.MjData(model)
    data.qpos[:7] = q = panda.READY_Q
    data.qpos[7:] = 0.04  # fingers open
    mujoco.mj_kinematics(model, data)
    arm = shapes.Shape(model)
    ends = arm.ends(q)
    for g in np.flatnonzero(model.geom_group == 3):
        name = model.body(model.geom_bodyid[g]).name
        if name == "link0":
            continue
        link = int(name[4:]) if name.startswith("link") else 7
        own = arm.links == link
        mesh = model.geom_dataid[g]
        if mesh < 0:
            continue  # the fingertips' pads, which lie in the fingers' meshes
        first = model.mesh_vertadr[mesh]
        points = model.mesh_vert[first : first + model.mesh_vertnum[mesh]]
        points = points @ data.geom_xmat[g].reshape(3, 3).T + data.geom_xpos[g]
        far = near.segment_distances(
            points[:, None], points[:, None], ends[own][:, 0], ends[own][:, 1]
        )
        assert (far - arm.radii[own]).min(axis=1).max() < 1e-6, name


def test_a_hand_has_its_own_capsules_and_fingers_do_not_move_the_arm():
    model = panda.load("panda")
    arm = shapes.Shape(model)
    assert len(arm.capsules) == len(shapes.LINKS) + len(shapes.HAND)
    without = shapes.Shape(panda.load("panda_nohand"))
    q = panda.READY_Q
    assert_same(arm.ends(q)[:8], without.ends(q)[:8], 1e-15)
    alone = shapes.Shape(model, shapes.LINKS[:3])
    assert_same(alone.ends(q), without.ends(q)[:3], 1e-15)


def test_what_cannot_be_is_said_in_one_line():
    empty = mujoco.MjModel.from_xml_string("<mujoco/>")
    with pytest.raises(Robo47Error, match="no link7; load the Panda"):
        shapes.capsules_of(empty)
    with pytest.raises(ValueError, match="radius is -1"):
        shapes.World.of(posts=[((0, 0, 0), (1, 0, 0), -1)])
    with pytest.raises(ValueError, match="T_world_box is not a pose"):
        shapes.World.of(boxes=[(np.ones((4, 4)), (1, 1, 1))])
    arm = shapes.Shape(panda.load("panda_nohand"))
    with pytest.raises(ValueError, match="q has shape"):
        arm.clearance(np.zeros(6), WORLD)
