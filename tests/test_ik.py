"""Inverse kinematics is judged by where the arm is, the limits and the promises."""

import numpy as np
import pytest
from compare import assert_same
from test_screws import PANDA, arm

from robo47 import jacobian, panda, screws, se3, verify
from robo47.fast import chains, ik
from robo47.fast.ik_many import Many
from robo47.fast.ik_one import One
from robo47.fast.walk import walk

READY = panda.READY_Q


@pytest.fixture
def robot(twin):
    model = panda.load("panda_nohand")
    return (*arm(model), model.jnt_range.copy(), model)


def test_a_thousand_random_targets_are_reached_within_the_limits(robot):
    S, M, limits, model = robot
    wanted = verify.random_q(model, 1000, seed=47)
    frame = panda.END_FRAME["panda_nohand"]
    goals = verify.mujoco_poses(model, wanted)[frame]
    q = jacobian.solve_ik(S, M, goals, READY, limits)
    off = jacobian.pose_error(verify.mujoco_poses(model, q)[frame], goals)
    assert np.linalg.norm(off, axis=1).max() < 1e-8
    assert ((q >= limits[:, 0]) & (q <= limits[:, 1])).all()
    assert jacobian.reached(S, M, goals, q).all()


def test_a_start_that_is_the_answer_comes_back_unchanged(robot):
    S, M, limits, model = robot
    q = verify.random_q(model, 20, seed=1)
    same = jacobian.solve_ik(S, M, screws.fk_space(S, M, q), q, limits)
    assert_same(same, q, 0.0)


def test_one_target_alone_and_a_batch_of_any_shape(robot):
    S, M, limits, model = robot
    goals = screws.fk_space(S, M, verify.random_q(model, 6, seed=2)).reshape(2, 3, 4, 4)
    q = jacobian.solve_ik(S, M, goals, READY, limits)
    assert q.shape == (2, 3, 7)
    assert jacobian.reached(S, M, goals, q).shape == (2, 3)
    one = jacobian.solve_ik(S, M, goals[1, 2], READY, limits)
    assert one.shape == (7,)
    assert jacobian.reached(S, M, goals[1, 2], one)
    starts = np.stack([READY, np.zeros(7)])
    from_both = jacobian.solve_ik(S, M, goals[1, 2], starts, limits)
    assert from_both.shape == (2, 7)
    assert jacobian.reached(S, M, goals[1, 2], from_both).all()
    assert jacobian.solve_ik(S, M, np.empty((0, 4, 4)), READY, limits).shape == (0, 7)


def test_more_targets_than_a_chunk_have_no_seam(robot, monkeypatch):
    S, M, limits, model = robot
    goals = screws.fk_space(S, M, verify.random_q(model, 15, seed=3))
    monkeypatch.setattr(ik, "CHUNK", 7)
    q = jacobian.solve_ik(S, M, goals, READY, limits)
    assert jacobian.reached(S, M, goals, q).all()


def test_one_alone_takes_the_steps_that_it_takes_among_many(robot):
    S, M, limits, _ = robot
    near = READY + np.random.default_rng(8).uniform(-0.3, 0.3, (50, 7))
    goals = screws.fk_space(S, M, np.clip(near, *limits.T))
    together = jacobian.solve_ik(S, M, goals, READY, limits)
    alone = [jacobian.solve_ik(S, M, goal, READY, limits) for goal in goals]
    assert_same(alone, together, 1e-9)


# Each step at a limit or out of reach multiplies rounding: after eight it is 1e-9.
@pytest.mark.parametrize(
    ("steps", "off"), [(1, 1e-12), (2, 1e-11), (3, 1e-11), (5, 1e-9)]
)
def test_both_ways_to_compute_a_walk_are_at_one_place_after_each_step(
    robot, steps, off
):
    S, M, limits, _ = robot
    rng = np.random.default_rng(10)
    near = READY + rng.uniform(-0.4, 0.4, (40, 7))
    tight = np.stack([READY - 0.2, READY + 0.2], axis=1)  # most come to a limit
    goals = screws.fk_space(S, M, near)
    goals[0, :3, :3] = np.diag([1.0, -1.0, -1.0]) @ goals[0, :3, :3]  # half a turn
    goals[1, :3, 3] += 3.0  # out of reach
    columns = np.ascontiguousarray(np.moveaxis(goals[:, :3], 0, -1))
    patience = ik.FIRST._replace(steps=steps)
    plan = chains.plan_of(S, M)
    for ends in (limits, tight):
        start = np.repeat(READY[:, None], 40, axis=1)
        many = Many(plan, columns, ends.T[..., None], start, np.arange(40))
        walk(many, patience)
        for i in range(40):
            one = One(plan, columns[..., i], ends)
            one.begin(READY.tolist())
            walk(one, patience)
            assert_same(one.best, many.best[:, i], off)
            assert one.miss == pytest.approx(many.miss[i], rel=1e-6, abs=1e-18)


def test_targets_one_by_one_are_all_reached_wherever_they_are(robot):
    S, M, limits, model = robot
    goals = screws.fk_space(S, M, verify.random_q(model, 100, seed=9))
    found = [jacobian.solve_ik(S, M, goal, READY, limits) for goal in goals]
    assert jacobian.reached(S, M, goals, found).all()
    assert ((found >= limits[:, 0]) & (found <= limits[:, 1])).all()


def test_the_same_call_gives_the_same_answer(robot):
    S, M, limits, model = robot
    goals = screws.fk_space(S, M, verify.random_q(model, 30, seed=4))
    first, second = (jacobian.solve_ik(S, M, goals, READY, limits) for _ in range(2))
    assert_same(first, second, 0.0)


def test_an_unreachable_target_gets_the_best_that_was_found_and_is_told_apart(robot):
    S, M, limits, model = robot
    near = screws.fk_space(S, M, verify.random_q(model, 1, seed=5)[0])
    far = se3.make_T(near[:3, :3], [3.0, 0.0, 0.5])
    q = jacobian.solve_ik(S, M, [near, far], READY, limits)
    assert jacobian.reached(S, M, [near, far], q).tolist() == [True, False]
    assert ((q >= limits[:, 0]) & (q <= limits[:, 1])).all()
    off = jacobian.pose_error(screws.fk_space(S, M, q[1]), far)
    others = screws.fk_space(S, M, verify.random_q(model, 3000, seed=6))
    theirs = np.linalg.norm(jacobian.pose_error(others, far), axis=-1)
    assert np.linalg.norm(off) < theirs.min()


@pytest.mark.parametrize("axis", np.eye(3))
def test_a_target_that_is_exactly_half_a_turn_away_is_no_answer_yet(robot, axis):
    S, M, limits, _ = robot
    here = screws.fk_space(S, M, READY)
    half = np.eye(4)
    half[:3, :3] = 2.0 * np.outer(axis, axis) - np.eye(3)
    goal = here.copy()
    goal[:3, :3] = half[:3, :3] @ here[:3, :3]
    q = jacobian.solve_ik(S, M, goal, READY, limits)
    assert not np.array_equal(q, READY)
    off = jacobian.pose_error(screws.fk_space(S, M, q), goal)
    assert jacobian.reached(S, M, goal, q) == (np.linalg.norm(off) < 1e-8)


def test_tight_limits_are_kept_where_a_solution_still_exists(robot):
    S, M, limits, _ = robot
    tight = np.stack([np.maximum(READY - 0.3, limits[:, 0]), READY + 0.3], axis=1)
    wanted = np.random.default_rng(47).uniform(*tight.T, (100, 7))
    goals = screws.fk_space(S, M, wanted)
    q = jacobian.solve_ik(S, M, goals, READY, tight)
    assert jacobian.reached(S, M, goals, q).all()
    assert ((q >= tight[:, 0]) & (q <= tight[:, 1])).all()


def test_an_arm_with_a_slide_is_solved_too():
    S = [[0, 0, 1, 0, 0, 0], [0, 0, 0, 0, 0, 1.0], [0, 1, 0, -1, 0, 0]]
    S += [[0, 0, 1, 0, -0.5, 0], [0, 1, 0, -1, 0, 0.8], [1, 0, 0, 0, 1, 0]]
    M = se3.make_T(np.eye(3), [1.0, 0.0, 1.0])
    limits = np.tile([-1.0, 1.0], (6, 1))
    goals = screws.fk_space(S, M, np.random.default_rng(47).uniform(-0.9, 0.9, (50, 6)))
    q = jacobian.solve_ik(S, M, goals, np.full(6, 0.1), limits)
    assert jacobian.reached(S, M, goals, q).all()


def test_a_start_outside_the_limits_is_brought_inside(robot):
    S, M, limits, _ = robot  # joint 4 cannot be 0
    goal = screws.fk_space(S, M, READY)
    q = jacobian.solve_ik(S, M, goal, np.zeros(7), limits)
    assert jacobian.reached(S, M, goal, q)


BAD = np.tile([-1.0, 1.0], (7, 1))
BAD[3] = [1.0, -1.0]


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"limits": BAD}, r"limits\[3\] is \[1.0, -1.0\]; expected low <= high"),
        ({"limits": BAD[:6]}, r"limits has shape \(6, 2\); expected"),
        ({"q_start": [0] * 6}, r"q_start has shape \(6,\)"),
        ({"T_goal": np.ones((4, 4))}, "T_goal is not a pose"),
        ({"screws": [PANDA]}, "one arm, many targets"),
        (
            {"M_home": np.full((4, 4), np.nan)},
            "M_home holds a number that is not finite",
        ),
    ],
)
def test_what_does_not_fit_is_named(change, words):
    good = {
        "screws": PANDA,
        "M_home": np.eye(4),
        "T_goal": np.eye(4),
        "q_start": READY,
        "limits": np.tile([-1.0, 1.0], (7, 1)),
    }
    with pytest.raises(ValueError, match=words) as caught:
        jacobian.solve_ik(**{**good, **change})
    assert "\n" not in str(caught.value)
