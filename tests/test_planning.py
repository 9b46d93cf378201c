"""Planning against SciPy's linear programs and binomial test, dense checks, by hand."""

import math

import numpy as np
import pytest
import scipy.optimize
import scipy.stats
from compare import assert_same
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from robo47 import planning

DISC = [[1.0, 1.0, 0.5]]
NONE = np.empty((0, 3))

numbers = st.floats(-3.0, 3.0, allow_subnormal=False)
points = arrays(np.float64, 2, elements=numbers)
discs = arrays(np.float64, (3, 3), elements=st.floats(0.05, 2.0))


def world(rng, m=12):
    """Return a start, a goal and discs that touch neither."""
    ends = np.array([[-1.0, -1.0], [1.0, 1.0]])
    found = np.empty((0, 3))
    while len(found) < m:
        disc = np.append(rng.uniform(-1.0, 1.0, 2), rng.uniform(0.1, 0.3))
        if np.all(np.linalg.norm(ends - disc[:2], axis=1) > disc[2] + 0.1):
            found = np.vstack([found, disc])
    return *ends, found


def is_free(path, discs):
    """Return whether 200 points of each edge keep out of every disc."""
    part = np.linspace(0.0, 1.0, 200)[:, None, None]
    dense = (path[:-1] + part * np.diff(path, axis=0)).reshape(-1, 1, 2)
    gaps = np.linalg.norm(dense - discs[:, :2], axis=2) - discs[:, 2]
    return bool(np.all(gaps > 0.0))


def path_to_time(rng, n, k=3):
    """Return what `time_optimal_profile` takes, of a path with n steps and k joints."""
    shape = (n + 1, k)
    A = rng.normal(size=shape).cumsum(axis=0) / math.sqrt(n) + 1.5
    B = rng.normal(size=shape).cumsum(axis=0) / math.sqrt(n)
    G = rng.uniform(-1.0, 1.0, shape)
    return A, B, G, rng.uniform(2.0, 4.0, k), rng.uniform(0.5, 3.0, n + 1)


def by_lp(A, B, G, limits, x_max):
    """Return the greatest sum of sd^2 that SciPy finds in the same limits."""
    n = len(A) - 1
    rows, above = [], []
    for i in range(n):
        for a, b, g, limit in zip(A[i], B[i], G[i], limits, strict=True):
            row = np.zeros(n + 1)
            row[i] = b - a * n / 2.0
            row[i + 1] = a * n / 2.0
            rows += [row, -row]
            above += [limit - g, limit + g]
    bounds = [(0.0, top) for top in x_max]
    bounds[0] = bounds[-1] = (0.0, 0.0)
    return scipy.optimize.linprog(
        -np.ones(n + 1), A_ub=rows, b_ub=above, bounds=bounds
    ).x  # fmt: skip


def test_the_worked_cases_of_the_lab():
    assert planning.nearest([[0, 0], [2, 0], [1, 1]], [1, 0]) == 0
    assert_same(planning.steer([0, 0], [3, 4], 1), [0.6, 0.8])
    assert planning.steer([0, 0], [0.3, 0.4], 1).tolist() == [0.3, 0.4]
    i, q, free = planning.extend([[0, 0], [1, 0]], [1, 2], 0.5, DISC)
    assert (i, q.tolist(), free) == (1, [1.0, 0.5], False)
    way = planning.rrt_connect([0, 0], [2.5, 0], NONE, [[0, 2]], 1)
    by_hand = [[0, 0], [0, 1], [0.643, 0.7428], [1.5715, 0.3714], [2.5, 0]]
    assert_same(way, by_hand, 5e-5)
    path = [[0, 0], [0, 1], [1, 1], [2, 1], [2, 0]]
    cut = planning.shortcut(path, [[1, 0, 0.5]], [[0.1, 0.9], [0, 0.5], [0.3, 0.99]])
    assert_same(cut, [[0, 0], [1, 1], [2, 0]])
    assert_same(
        planning.path_dynamics([[2]], [3], [1], [5], [7]), [[6], [7], [7]]
    )  # fmt: skip
    assert_same(planning.path_accel_bounds([1, 2], [0, 0], [0, 1], [4, 5], 0), [-3, 2])
    assert_same(
        planning.path_accel_bounds([1, -2], [1, 0], [0, 0], [4, 5], 2), [-2.5, 0]
    )
    assert_same(planning.path_accel_bounds([1, 1], [0, 0], [0, 9], [4, 2], 0), [-4, -7])
    one = np.ones((5, 1))
    told = [(0, 9, [0, 2, 4, 2, 0]), (4, 9, [0, 1, 2, 3, 0]), (0, 1, [0, 1, 1, 1, 0])]
    for gravity, top, x in told:
        found = planning.time_optimal_profile(
            2 * one, 0 * one, gravity * one, [8], top * one.T[0]
        )
        assert_same(found, x)


@pytest.mark.parametrize(
    ("a", "b", "free"),
    [
        ((0, 0), (2, 0), True),
        ((0, 0.6), (2, 0.6), False),
        ((0, 1), (0.4, 1), True),
        ((0, 1.5), (2, 1.5), False),  # it touches
        ((1, 1), (1, 1), False),
        ((0, 0), (0, 0), True),
    ],
)
def test_an_edge_is_free_beside_a_disc_and_before_it(a, b, free):
    assert planning.segment_free_of_discs(a, b, DISC) is free
    assert planning.segment_free_of_discs(b, a, DISC) is free
    assert planning.segment_free_of_discs(a, b, NONE)


@given(points, points, discs)
@settings(deadline=None, max_examples=50)
def test_an_edge_is_free_where_scipys_nearest_point_is_outside(a, b, discs):
    gaps = [
        scipy.optimize.minimize_scalar(
            lambda t, disc=disc: np.linalg.norm(a + t * (b - a) - disc[:2]) - disc[2],
            bounds=(0.0, 1.0),
            method="bounded",
        ).fun
        for disc in discs
    ]
    assume(abs(min(gaps)) > 1e-3)
    assert planning.segment_free_of_discs(a, b, discs) == (min(gaps) > 0.0)


def test_of_equals_the_first_is_nearest():
    tree = np.vstack([np.eye(7), -np.eye(7)])
    assert planning.nearest(tree, np.zeros(7)) == 0
    assert planning.nearest(tree, -0.5 * np.eye(7)[3]) == 10


@given(points, points, st.floats(0.01, 3.0))
def test_a_step_is_no_longer_than_asked_and_on_the_line(q, target, step):
    reached = planning.steer(q, target, step)
    assert np.linalg.norm(reached - q) <= step * (1.0 + 1e-12)
    whole = np.linalg.norm(target - q)
    parts = np.linalg.norm(reached - q) + np.linalg.norm(target - reached)
    assert parts == pytest.approx(whole, abs=1e-12)
    assert np.array_equal(reached, target) == (whole <= step or whole == 0.0)


@pytest.mark.parametrize("seed", range(8))
def test_a_way_is_free_has_short_edges_and_joins_start_and_goal(seed):
    rng = np.random.default_rng(seed)
    start, goal, discs = world(rng)
    samples = rng.uniform(-1.2, 1.2, (400, 2))
    way = planning.rrt_connect(start, goal, discs, samples, 0.101)
    assert len(way)
    assert_same(way[[0, -1]], [start, goal], 0.0)
    assert np.linalg.norm(np.diff(way, axis=0), axis=1).max() <= 0.101 + 1e-12
    assert is_free(way, discs)
    cut = planning.shortcut(way, discs, rng.uniform(0.0, 0.999, (60, 2)))
    assert_same(cut[[0, -1]], [start, goal], 0.0)
    assert len(cut) < len(way)
    assert is_free(cut, discs)


def test_a_goal_that_is_walled_in_has_no_way():
    around = np.linspace(0.0, 2.0 * np.pi, 12, endpoint=False)
    ring = np.column_stack([np.cos(around), np.sin(around), np.full(12, 0.4)])
    samples = np.random.default_rng(0).uniform(-2.0, 2.0, (200, 2))
    assert planning.rrt_connect([3, 0], [0, 0], ring, samples, 0.3).shape == (0, 2)
    assert planning.rrt_connect([3, 0], [0, 0], NONE, NONE, 0.3).shape == (0, 2)


def test_the_trees_take_turns_by_the_number_of_the_sample():
    caged = [[0.0, 0.5, 0.3]]  # the start's tree cannot grow upwards
    way = planning.rrt_connect([0, 0], [2.5, 0], caged, [[0.0, 2.0], [2.5, 2.0]], 1)
    assert_same(way[-2:], [[2.5, 1.0], [2.5, 0.0]], 1e-15)


def test_more_samples_leave_a_way_that_was_found_as_it_is():
    rng = np.random.default_rng(3)
    start, goal, discs = world(rng)
    samples = rng.uniform(-1.2, 1.2, (150, 2))
    ways = [
        planning.rrt_connect(start, goal, discs, samples[:n], 0.101)
        for n in range(0, 151, 10)
    ]
    found = [way for way in ways if len(way)]
    assert 0 < len(found) < len(ways)
    for way in found:
        assert_same(way, found[0], 0.0)


def test_a_world_of_ones_own_says_itself_what_is_free():
    class Wall:
        """Seven joints, of which the first may not be between 0.4 and 0.6 low down."""

        def edge_free(self, a, b):
            part = np.linspace(0.0, 1.0, 40)[:, None]
            q = a + part * (b - a)
            return not np.any((np.abs(q[:, 0] - 0.5) < 0.1) & (q[:, 1] < 0.5))

    start, goal = np.zeros(7), np.eye(7)[0]
    samples = np.random.default_rng(1).uniform(-2.0, 2.0, (400, 7))
    way = planning.rrt_connect(start, goal, Wall(), samples, 0.6)
    assert len(way) > 2
    assert not planning.edge_free(start, goal, Wall())
    pairs = np.random.default_rng(2).uniform(0.0, 0.999, (40, 2))
    assert len(planning.shortcut(way, Wall(), pairs)) <= len(way)


@given(st.integers(1, 200).flatmap(lambda n: st.tuples(st.integers(0, n), st.just(n))))
def test_wilsons_interval_is_scipys(pair):
    k, n = pair
    low, high = planning.wilson_interval(k, n)
    told = scipy.stats.binomtest(k, n).proportion_ci(method="wilson")
    # Its z is 1.959964, ours 1.96: with one of one that is 6e-6.
    assert_same([low, high], [told.low, told.high], 1e-5)


def test_no_trial_makes_every_share_believable():
    assert planning.wilson_interval(0, 0).tolist() == [0.0, 1.0]
    assert (
        planning.wilson_interval(73, 73)[0]
        > 0.95 - 1e-4
        > planning.wilson_interval(72, 72)[0]
    )
    assert planning.wilson_interval(60, 60)[0] == pytest.approx(
        60 / (60 + 1.96**2), abs=1e-12
    )


@given(st.integers(0, 2**31))
@settings(deadline=None, max_examples=50)
def test_torques_stay_within_their_limits_up_to_the_greatest_acceleration(seed):
    rng = np.random.default_rng(seed)
    a, b, g = rng.normal(size=(3, 7))
    limits, sd = rng.uniform(1.0, 4.0, 7), rng.uniform(0.0, 1.5)
    low, high = planning.path_accel_bounds(a, b, g, limits, sd)
    lp = [
        scipy.optimize.linprog(
            [sign], A_ub=np.append(a, -a)[:, None], bounds=(None, None),
            b_ub=np.append(limits - b * sd**2 - g, limits + b * sd**2 + g),
        )
        for sign in (1, -1)
    ]  # fmt: skip
    assert (low <= high) == lp[0].success
    if lp[0].success:
        assert_same([low, high], [lp[0].x[0], lp[1].x[0]], 1e-9)


def test_a_joint_that_does_not_move_limits_nothing_if_it_holds():
    lim = [4.0, 4.0]
    assert planning.path_accel_bounds([1, 0], [0, 0], [0, 3], lim, 0).tolist() == [
        -4,
        4,
    ]
    held = planning.path_accel_bounds([1, 0], [0, 0], [0, 5], lim, 0)
    assert held.tolist() == [math.inf, -math.inf]
    free = planning.path_accel_bounds([0, 0], [0, 0], [0, 3], lim, 0)
    assert free.tolist() == [-math.inf, math.inf]


@pytest.mark.parametrize("seed", range(6))
def test_the_fastest_motion_is_the_linear_programs(seed):
    given_path = path_to_time(np.random.default_rng(seed), 40)
    x = planning.time_optimal_profile(*given_path)
    assert x.max() > 0.1
    assert_same(x, by_lp(*given_path), 1e-9)
    for i in range(0, 41, 10):
        alone = list(given_path)
        alone[4] = given_path[4] * (np.arange(41) == i) + 1e-3 * (np.arange(41) != i)
        assert_same(planning.time_optimal_profile(*alone), by_lp(*alone), 1e-9)


def test_where_gravity_is_too_much_nothing_moves():
    one = np.ones((5, 1))
    G = one.copy()
    G[3] = 9.0
    assert not planning.time_optimal_profile(2 * one, 0 * one, G, [8], one[:, 0]).any()


def test_bang_bang_takes_the_time_of_the_formula():
    one = np.ones((101, 1))
    x = planning.time_optimal_profile(2 * one, 0 * one, 0 * one, [8], 99 * one[:, 0])
    assert planning.travel_time(x) == pytest.approx(1.0, abs=1e-9)
    x = planning.time_optimal_profile(2 * one, 0 * one, 4 * one, [8], 99 * one[:, 0])
    assert planning.travel_time(x) == pytest.approx(2.0 / math.sqrt(3.0), abs=1e-9)
    assert planning.travel_time([0.0, 0.0, 1.0]) == math.inf


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: planning.nearest([[0, 0]], [1, 2, 3]), "q has shape"),
        (lambda: planning.steer([0, 0], [1, 0], 0.0), "step is 0"),
        (lambda: planning.segment_free_of_discs([0, 0], [1, 0], [[1, 2]]), "discs"),
        (
            lambda: planning.segment_free_of_discs([0, 0], [1, 0], [[1, 2, -1]]),
            "radius",
        ),
        (lambda: planning.rrt_connect([0], [1, 2], NONE, NONE, 1), "goal has shape"),
        (lambda: planning.shortcut([[0, 0]], NONE, [[0.5, 1.0]]), "below 1"),
        (lambda: planning.wilson_interval(3, 2), "expected 0 to 2"),
        (lambda: planning.path_accel_bounds([1], [1], [1], [0], 0), "limits is 0"),
        (
            lambda: planning.time_optimal_profile([[1]], [[1]], [[1, 2]], [1], [1]),
            "c has",
        ),
    ],
)
def test_an_error_says_what_is_wrong(call, says):
    with pytest.raises(ValueError, match=says):
        call()
