"""Distances against MuJoCo, SciPy's least squares, differences, and the axioms."""

import mujoco
import numpy as np
import pytest
import scipy.optimize
from compare import assert_same
from hypothesis import assume, given
from hypothesis import strategies as st

from robo47 import distance, kinematics, panda, se3, shapes
from robo47.jacobian import space_jacobian

rng = np.random.default_rng(11)
MODEL = panda.load("panda_nohand")
SCREWS = panda.screws(MODEL)
point = st.lists(st.floats(-3, 3), min_size=3, max_size=3).map(np.array)
FAR = 10.0  # m, up to which MuJoCo is asked


@pytest.fixture(autouse=True)
def seeded():
    """Let every test draw the same, whichever ran before it."""
    global rng
    rng = np.random.default_rng(11)


def poses(n):
    """Return n random poses, (n, 4, 4)."""
    return se3.make_T(se3.quat_to_R(rng.normal(size=(n, 4))), rng.normal(size=(n, 3)))


def by_mujoco(first, second):
    """Return MuJoCo's distance of two geoms, given as (type, pos, R, size)."""
    spec = mujoco.MjSpec()
    for name, (kind, pos, R, size) in {"a": first, "b": second}.items():
        spec.worldbody.add_geom(
            name=name, type=kind, pos=pos, quat=se3.R_to_quat(R), size=size
        )
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    return mujoco.mj_geomDistance(model, data, 0, 1, FAR, np.zeros(6))


def capsule(a0, a1, r):
    """Return a capsule as MuJoCo has it: middle, z along the axis, half its length."""
    way = a1 - a0
    z = way / np.linalg.norm(way)
    x = np.linalg.svd(z[None])[2][1]
    R = np.column_stack([x, np.cross(z, x), z])
    half = [r, np.linalg.norm(way) / 2, 0]
    return mujoco.mjtGeom.mjGEOM_CAPSULE, (a0 + a1) / 2, R, half


def test_the_distance_of_two_capsules_is_mujocos_inside_and_outside():
    inside = 0
    for a0, a1, b0, b1 in rng.uniform(-0.5, 0.5, (100, 4, 3)):
        ra, rb = rng.uniform(0.02, 0.1, 2)
        ours = distance.capsule_distance(a0, a1, ra, b0, b1, rb)
        theirs = by_mujoco(capsule(a0, a1, ra), capsule(b0, b1, rb))
        assert abs(ours - theirs) < 1e-14
        inside += ours < 0
    assert 10 < inside < 90


def test_a_capsule_and_a_box_are_apart_as_in_mujoco_while_they_are_apart():
    outside = 0
    for T, (a0, a1) in zip(poses(100), rng.uniform(-2, 2, (100, 2, 3)), strict=True):
        r = rng.uniform(0.02, 0.1)
        half = rng.uniform(0.1, 0.6, 3)
        ours = distance.capsule_box_distance(a0, a1, r, T, half)
        if ours > 0:
            box = (mujoco.mjtGeom.mjGEOM_BOX, T[:3, 3], T[:3, :3], half)
            assert abs(ours - by_mujoco(capsule(a0, a1, r), box)) < 1e-14
            outside += 1
    assert outside > 50


def test_the_closest_points_are_those_of_scipys_bounded_least_squares():
    for a0, a1, b0, b1 in rng.uniform(-1, 1, (100, 4, 3)):
        A = np.column_stack([a1 - a0, b0 - b1])
        best = scipy.optimize.lsq_linear(A, b0 - a0, (0, 1), method="bvls", tol=1e-14)
        s, t = best.x
        theirs = [a0 + s * (a1 - a0), b0 + t * (b1 - b0)]
        assert_same(distance.closest_points_segments(a0, a1, b0, b1), theirs, 1e-12)


@given(point, point, point, point)
def test_no_point_of_one_segment_is_closer_to_the_other(a0, a1, b0, b1):
    p, o = distance.closest_points_segments(a0, a1, b0, b1)
    s, t = np.meshgrid(np.linspace(0, 1, 21), np.linspace(0, 1, 21))
    a = a0 + s[..., None] * (a1 - a0)
    b = b0 + t[..., None] * (b1 - b0)
    assert np.linalg.norm(p - o) <= np.linalg.norm(a - b, axis=-1).min() + 1e-6
    back = distance.closest_points_segments(b0, b1, a0, a1)
    assert abs(np.linalg.norm(p - o) - np.linalg.norm(back[0] - back[1])) < 1e-6


def test_parallel_segments_points_and_millimetres_have_their_distance():
    def apart(*ends):
        p, o = distance.closest_points_segments(*ends)
        return np.linalg.norm(p - o)

    assert apart((0, 0, 0), (2, 0, 0), (1, 1, 0), (3, 1, 0)) == 1
    assert apart((0, 0, 0), (2, 0, 0), (5, 0, 0), (3, 0, 0)) == 1
    assert apart((0, 0, 0), (0, 0, 0), (-1, 1, 0), (1, 1, 0)) == 1
    assert apart((-1, 1, 0), (1, 1, 0), (0, 0, 0), (0, 0, 0)) == 1
    assert apart((0, 3, 4), (0, 3, 4), (0, 0, 0), (0, 0, 0)) == 5
    for size in (1e-6, 1e-3, 1.0, 1e3):  # a c - b^2 goes with its fourth power
        a0, a1, b0, b1 = size * np.array([(-1, 0, 0), (1, 0, 0), (0, -1, 1), (0, 1, 1)])
        found = distance.closest_points_segments(a0, a1, b0, b1)
        assert_same(found, size * np.array([(0, 0, 0), (0, 0, 1)]), 1e-15 * size)


def test_a_box_is_as_far_as_the_nearest_of_its_points_and_deep_as_its_nearest_face():
    half = np.array([1.0, 0.5, 2.0])
    for p in rng.uniform(-3, 3, (200, 3)):
        d = distance.box_sdf(p, half)
        nearest = np.clip(p, -half, half)
        if (np.abs(p) < half).all():
            assert d == -np.min(half - np.abs(p))
        else:
            assert abs(d - np.linalg.norm(p - nearest)) < 1e-15
    worked = [(2, 0, 0), (0, 0, 0), (2, 2, 0), (0.5, 0.2, 0)]
    d = [distance.box_sdf(p, np.ones(3)) for p in worked]
    assert d == pytest.approx([1, -1, np.sqrt(2), -0.5])


@given(point, point, point, st.floats(0, 1))
def test_along_a_segment_the_distance_from_a_box_has_one_valley(a0, a1, half, s):
    half = np.abs(half)
    middle = distance.box_sdf(a0 + s * (a1 - a0), half)
    chord = (1 - s) * distance.box_sdf(a0, half) + s * distance.box_sdf(a1, half)
    assert middle <= chord + 1e-12


def test_a_box_that_is_moved_and_turned_is_the_box_at_the_origin_seen_from_there():
    for T in poses(30):
        a0, a1 = rng.uniform(-1, 1, (2, 3))
        there = [T[:3, :3] @ x + T[:3, 3] for x in (a0, a1)]
        half = rng.uniform(0.1, 0.5, 3)
        here = distance.capsule_box_distance(a0, a1, 0.1, np.eye(4), half)
        assert abs(distance.capsule_box_distance(*there, 0.1, T, half) - here) < 1e-14


def test_the_slope_is_what_differences_of_the_distance_say():
    arm = shapes.Shape(MODEL)
    post = np.array([(0.4, 0.3, 0), (0.4, 0.3, 0.9)])

    def apart(q, k):
        return np.subtract(*distance.closest_points_segments(*arm.ends(q)[k], *post))

    def rate(q, k, step):
        ahead, back = (np.linalg.norm(apart(q + e, k)) for e in (step, -step))
        return (ahead - back) / (2 * np.linalg.norm(step))

    for q in panda.READY_Q + rng.uniform(-0.5, 0.5, (5, 7)):
        J = space_jacobian(SCREWS, q)
        for k, link in enumerate(arm.links):
            p, o = distance.closest_points_segments(*arm.ends(q)[k], *post)
            slope = distance.distance_gradient(J, p, o, link)
            assert not slope[link:].any()
            for i, step in enumerate(1e-3 * np.eye(7)):  # Richardson's: 4 to 1
                fine = (4 * rate(q, k, step / 2) - rate(q, k, step)) / 3
                assert abs(slope[i] - fine) < 1e-7


def test_a_point_on_the_surface_gives_the_same_slope_as_one_on_the_axis():
    J = space_jacobian(SCREWS, panda.READY_Q)
    p, o = rng.normal(size=(2, 3))
    n = (p - o) / np.linalg.norm(p - o)
    on_surface = distance.distance_gradient(J, p - 0.1 * n, o, 7)
    assert_same(distance.distance_gradient(J, p, o, 7), on_surface, 1e-14)


def test_boxes_exclude_no_pair_that_touches_and_most_that_do_not():
    touching = excluded = 0
    for a0, a1, b0, b1 in rng.uniform(-0.4, 0.4, (500, 4, 3)):
        a1 = a0 + 0.3 * a1
        b1 = b0 + 0.3 * b1
        A = distance.capsule_aabb(a0, a1, 0.05)
        B = distance.capsule_aabb(b0, b1, 0.05)
        d = distance.capsule_distance(a0, a1, 0.05, b0, b1, 0.05)
        assert distance.aabb_overlap(A, B) == distance.aabb_overlap(B, A)
        assert distance.aabb_overlap(A, B) or d > 0
        touching += d <= 0
        excluded += not distance.aabb_overlap(A, B)
    assert touching > 5
    assert excluded > 350


def test_boxes_that_only_touch_overlap():
    A = np.array([(0, 0, 0), (1, 1, 1)])
    assert distance.aabb_overlap(A, A + np.eye(3)[0])
    assert not distance.aabb_overlap(A, A + 1.0000001 * np.eye(3)[0])
    assert_same(
        distance.capsule_aabb((0, 1, 0), (1, 0, 0), 0.5),
        [(-0.5, -0.5, -0.5), (1.5, 1.5, 0.5)], 0,
    )  # fmt: skip


def test_nothing_behind_a_joint_is_ever_farther_than_its_reach():
    arm = shapes.Shape(MODEL)
    chain = kinematics.chain_to(MODEL, "body:link7")
    q = rng.uniform(*MODEL.jnt_range.T, (2000, 7))
    origins = kinematics.fk_links(chain, q)[:, :, :3, 3]
    ends = arm.ends(q)
    for i in range(7):
        behind = arm.links > i
        far = np.linalg.norm(ends[:, behind] - origins[:, i, None, None], axis=-1)
        most = (far.max(axis=-1) + arm.radii[behind]).max()
        assert 0.7 * arm.distal_radii[i] < most <= arm.distal_radii[i] + 1e-12
    assert_same(
        arm.distal_radii, [1.109, 1.109, 0.793, 0.711, 0.318, 0.318, 0.230], 5e-4
    )


def test_a_long_link_in_the_middle_reaches_farther_than_the_tip():
    assert_same(
        distance.distal_radii([0.1, 0.1, 0], [0.1, 2.0, 0.3]), [2.1, 2.0, 0.3], 0
    )


@given(st.lists(st.floats(-2, 2), min_size=7, max_size=7), st.floats(0, 1))
def test_the_arm_keeps_its_promise_up_to_the_next_look(dq, s):
    arm = shapes.Shape(MODEL)
    world = shapes.World.of(posts=[((0.4, 0.3, 0), (0.4, 0.3, 0.9), 0.03)])
    dq = np.array(dq)

    def apart(s):
        return float(arm.clearance(panda.READY_Q + s * dq, world))

    d = apart(s)
    assume(d > 0)
    ahead = distance.conservative_advance(s, d, dq, arm.distal_radii)
    assert s < ahead <= 1 or s == 1
    if ahead < 1:
        assert all(apart(x) > -1e-12 for x in np.linspace(s, ahead, 5))


def test_the_next_look_is_here_where_it_touches_and_at_the_end_if_nothing_moves():
    reach = np.full(7, 0.5)
    found = distance.conservative_advance(0.25, 0.1, np.ones(7), reach)
    assert found == pytest.approx(0.278571, abs=1e-6)
    assert distance.conservative_advance(0.25, -0.1, np.ones(7), reach) == 0.25
    assert distance.conservative_advance(0.25, 0.1, np.zeros(7), reach) == 1
    assert distance.conservative_advance(0.9, 9.0, np.ones(7), reach) == 1


def test_slowed_speeds_are_the_nearest_allowed_ones_by_scipys_quadratic_programme():
    for qd, slope in rng.normal(size=(30, 2, 7)):
        d, gain = rng.uniform(-0.1, 0.3), rng.uniform(0.5, 5)
        ours = distance.velocity_damper(qd, slope, d, gain)
        limit = {"type": "ineq", "fun": lambda x, s=slope, b=gain * d: s @ x + b}
        best = scipy.optimize.minimize(
            lambda x, qd=qd: (x - qd) @ (x - qd), qd, constraints=limit, tol=1e-14
        )
        assert_same(ours, best.x, 1e-6)
        assert slope @ ours >= -gain * d - 1e-12
    assert_same(distance.velocity_damper(qd, np.zeros(7), -0.1, 4), qd, 0)


@pytest.mark.parametrize(
    ("call", "told"),
    [
        (lambda: distance.closest_points_segments([0, 0], *np.eye(3)), "a0 has shape"),
        (lambda: distance.capsule_distance(*np.eye(3)[:2], -1, *np.eye(3)[:2], 0),
         "ra is -1; it must not be below 0"),
        (lambda: distance.box_sdf([0, 0, 0], [1, -1, 1]), "half_extents is -1"),
        (lambda: distance.capsule_box_distance(
            *np.eye(3)[:2], 1, np.ones((4, 4)), [1, 1, 1]),
         "T_world_box is not a pose"),
        (lambda: distance.distance_gradient(np.eye(6), [1, 0, 0], [1, 0, 0], 1),
         "p - o has length 0"),
        (lambda: distance.distance_gradient(np.eye(6), [1, 0, 0], [0, 0, 0], 0),
         "link is 0; the arm has 1 to 6"),
        (lambda: distance.distal_radii([1, 2], [1]), "link_radii has shape"),
        (lambda: distance.conservative_advance(0, 1, [1], [-1]), "radii is -1"),
        (lambda: distance.velocity_damper([1], [1], 1, -4), "gain is -4"),
    ],
)  # fmt: skip
def test_what_cannot_be_is_said_in_one_line(call, told):
    with pytest.raises(ValueError, match=told):
        call()
