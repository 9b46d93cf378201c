"""Day 12: the numbers in the guide's sentences, and every reason in it."""

import math
import re
from itertools import pairwise
from unittest.mock import patch

import numpy as np
import pytest

from conftest import ROOT, load_script, printed_by, sentences
from labkit.check.lab_run import rehearse
from labkit.check.tasks import check_tasks
from labkit.judge.worlds import Balls
from labkit.lesson.day import find_day
from labkit.sandbox.process import Process
from labkit.sandbox.sandbox import Sandbox
from robo47 import panda, planning, simulate

import day12_mujoco

SENTENCES = sentences(12)
DAY = find_day(12)
GUIDE = (ROOT / "w2-autonomy/docs/day12-lab.md").read_text("utf-8")
lab = load_script(ROOT / "w2-autonomy/src/day12_planning.py")
ways = DAY.module("ways")
others = DAY.module("planners")
ARM = panda.arm(day12_mujoco.Wall().model)
_, LIMITS = simulate.limits(day12_mujoco.Wall().model)
INVERSE = day12_mujoco.torque(day12_mujoco.Wall().model)
READY = panda.READY_Q


def rows_of(head):
    """Return the cells of a table of the guide, below the row that begins so."""
    _, _, table = GUIDE.partition(f"\n| {head} ")
    rows = table.partition("\n\n")[0].splitlines()[2:]
    return [[cell.strip() for cell in row.strip("| ").split("|")] for row in rows]


def seconds_of(share, *, speed=1.0, weight=1.0, n=lab.POINTS):
    """Return the seconds of Day 7's move, with other speeds and another gravity."""
    A, B, G, most = lab.along(ARM, READY, lab.TO, n)
    x = planning.time_optimal_profile(A, B, weight * G, share * LIMITS, speed**2 * most)
    return planning.travel_time(x)


class AtPoints(day12_mujoco.Wall):
    """A checker that looks at some points inside each edge, and at its end."""

    def __init__(self, points):
        super().__init__()
        self.points = points

    def _looked_along(self, q, dq):
        for s in np.linspace(0.0, 1.0, self.points + 2)[1:]:
            self.looks += 1
            if self.apart(q + s * dq, self.seen) <= day12_mujoco.MARGIN:
                return False
        return True


def planned(wall, step=lab.STEP, seeds=lab.SEEDS):
    """Return counts by COUNTS, looks a plan, lengths when cut, and least distances."""
    with patch.object(lab, "STEP", step):
        needed, found = lab.plan_with(wall, seeds)
    looks = wall.looks / seeds
    cut = lab.shorter(wall, found)
    judge = day12_mujoco.Wall()
    least = np.array([lab.least_distance(judge, one) for one in cut])
    counts = [int(np.sum(needed <= n)) for n in lab.COUNTS]
    return counts, looks, [lab.length(one) for one in cut], least


@pytest.fixture(scope="module")
def printed():
    """Return what the lab prints."""
    told = {"lower bound for 60 of 60": "0.94", "one joint over 1 rad, s": "1",
            "Day 7's motion with half of the torque, s": "0.813"}  # fmt: skip
    return printed_by(lab, told)


@pytest.mark.kit
def test_three_predictions_of_the_worksheet_stand_beside_what_is_measured(printed):
    sheet = (ROOT / "w2-autonomy/docs/day12.md").read_text("utf-8")
    for yours, found in (("0.94", "0.9398"), ("1", "1"), ("0.813", "0.703")):
        row = rf"you predicted {yours}, measured ([\d.]+):\s+([^\n]+)"
        measured, name = re.search(row, printed).groups()
        assert measured == found
        assert f"| {name}" in sheet
    assert "60 / (60 + 3.84) = 0.940" in SENTENCES
    assert "√2 times as long: 0.813 s" in SENTENCES
    assert math.sqrt(2) * 0.575 == pytest.approx(0.813, abs=5e-4)
    assert "estimate was 0.813 s, but the lab measures 0.703 s" in SENTENCES


def test_what_the_opening_promises_is_what_the_lab_prints(printed):
    whole, short = re.search(r"\n +40 +(\d+) of 60 .+? (\d+) of 30 ", printed).groups()
    assert f"in {short} of 30 trials with 40 samples" in SENTENCES
    assert f"a path in {whole} of 60" in SENTENCES
    row = r"{} +([\d.]+) +([\d.]+) +(\d+) +(\d+) of \d+ +(-?[\d.]+)"
    right, blind = (
        re.search(row.format(name), printed).groups()
        for name in ("whole arm", "hand omitted")
    )
    assert float(blind[0]) < float(right[0])
    assert float(blind[1]) < float(right[1])
    assert 0.45 < float(blind[2]) / float(right[2]) < 0.6  # half as many queries
    assert [right[3], blind[3]] == ["0", "25"]
    assert (
        f"{blind[3]} of these 30 paths collide with the wall or the roof" in SENTENCES
    )
    assert f"penetrate it by up to {abs(float(blind[4])):.0f} mm" in SENTENCES
    assert "paths found in 20 of 25 worlds" in printed
    assert "In five of the 25 worlds the planner finds no path" in SENTENCES


def test_the_cases_by_hand():
    disc = np.array([[1.0, 1.0, 0.5]])
    for a, b, free in (((0, 0.6), (2, 0.6), False), ((0, 1), (0.4, 1), True)):
        assert lab.segment_free_of_discs(np.array(a), np.array(b), disc) is free
    assert lab.segment_free_of_discs(np.ones(2), np.ones(2), disc) is False
    alone = np.zeros(2), np.array([2.5, 0]), disc[:0], np.array([[0.0, 2]]), 1.0
    way = lab.rrt_connect(*alone)
    assert np.round(way, 2).tolist() == [
        [0, 0], [0, 1], [0.64, 0.74], [1.57, 0.37], [2.5, 0],
    ]  # fmt: skip
    assert np.linalg.norm(way[1] - way[-1]) == pytest.approx(math.sqrt(7.25))
    assert np.linalg.norm(way[1] - way[2]) == pytest.approx(0.69, abs=5e-3)
    assert lab.wilson_interval(3, 3)[0] == pytest.approx(0.44, abs=5e-3)
    assert lab.wilson_interval(73, 73)[0] > 0.9499 > lab.wilson_interval(72, 72)[0]
    one = np.ones((5, 1))
    x = lab.time_optimal_profile(
        2 * one, 0 * one, 0 * one, np.array([8.0]), 9 * one[:, 0]
    )
    assert x == pytest.approx([0, 2, 4, 2, 0])
    against = lab.bang_bang(lab.time_optimal_profile, 4.0)
    assert against == pytest.approx(2 / math.sqrt(3))
    assert "2/√3 = 1.155 s" in SENTENCES


def test_the_start_and_the_goal_stand_on_either_side_of_the_wall():
    wall = day12_mujoco.Wall()
    for q in (day12_mujoco.START, day12_mujoco.GOAL):
        assert wall.apart(q, wall.pairs) > 0.05
    assert not wall.edge_free(day12_mujoco.START, day12_mujoco.GOAL)
    # What the checker leaves out, links 1 and 2, comes near neither box.
    left = [pair for pair in wall.pairs if pair not in wall.seen]
    assert len(left) == 4
    least = min(wall.apart(q, left) for q in day12_mujoco.samples(wall.model, 300, 1))
    assert least > day12_mujoco.MARGIN


def test_half_the_torque_has_two_causes_and_neither_alone_is_root_two():
    full, half = seconds_of(1.0), seconds_of(0.5)
    assert [f"{x:.3f}" for x in (full, half)] == ["0.575", "0.703"]
    free = [seconds_of(share, speed=100.0) for share in (1.0, 0.5)]
    words = f"{free[0]:.3f} s and {free[1]:.3f} s, a factor of {free[1] / free[0]:.2f}"
    assert words in SENTENCES
    light = [seconds_of(share, speed=100.0, weight=0.0) for share in (1.0, 0.5)]
    assert light[1] / light[0] == pytest.approx(math.sqrt(2), abs=1e-9)
    assert "and without gravity the factor is 1.414" in SENTENCES
    A, B, G, most = lab.along(ARM, READY, lab.TO, lab.POINTS)
    x = planning.time_optimal_profile(A, B, G, 0.5 * LIMITS, most)
    assert (
        f"at its limit at {100 * np.mean(x > most - 1e-9):.0f} % of the points" in GUIDE
    )
    x = planning.time_optimal_profile(A, B, G, LIMITS, most)
    at_limit = f"at its limit at {100 * np.mean(x > most - 1e-9):.0f} % of the"
    assert f"{at_limit} {len(x)} points of the path" in SENTENCES


def test_the_first_five_seeds_say_next_to_nothing():
    needed, _ = lab.plan_with(day12_mujoco.Wall(), 5)
    k = int(np.sum(needed <= 40))
    low, high = lab.wilson_interval(k, 5)
    assert f"finds a path for {k} of the first 5 seeds" in SENTENCES
    assert f"For {k} of 5 the interval is {low:.2f} to {high:.2f}" in SENTENCES
    low, high = lab.wilson_interval(29, 60)
    assert f"For 29 of 60 it is {low:.2f} to {high:.2f}" in SENTENCES
    assert f"by 60, is {60 * low:.0f} to {60 * high:.0f}" in SENTENCES


def beyond(n):
    """Return how far the interval of about n / 2 of n is from its rate, at most."""
    k = n // 2
    return np.abs(lab.wilson_interval(k, n) - k / n).max()


def chances(n, p):
    """Return the probability of each count of n trials, (n + 1,)."""
    return np.array([math.comb(n, k) * p**k * (1 - p) ** (n - k) for k in range(n + 1)])


def test_an_interval_of_a_tenth_needs_93_trials():
    assert beyond(92) > 0.1 > beyond(93)
    assert "for ±0.1 you need 93 trials" in SENTENCES


def test_the_interval_is_near_95_percent_on_average_and_not_near_1():
    ends = np.array([planning.wilson_interval(k, 60) for k in range(61)])

    def covers(p):
        return chances(60, p)[(ends[:, 0] <= p) & (p <= ends[:, 1])].sum()

    assert np.mean([covers(p) for p in np.linspace(0.5, 1, 1000, endpoint=False)]) == (
        pytest.approx(0.952, abs=1e-3)
    )
    just_above = ends[59, 1] + 1e-9  # from here on only 60 of 60 contains p
    assert f"{just_above:.3f}" == "0.997"
    assert "with $p$ just above 0.997" in SENTENCES
    assert f"in only {100 * covers(just_above):.0f} % of the cases" in SENTENCES


def test_a_second_count_lies_in_the_first_interval_less_often_than_95_percent():
    ends = 60 * np.array([planning.wilson_interval(k, 60) for k in range(61)])
    for p in (0.3, 0.4, 0.5):
        some = chances(60, p)
        both = sum(
            some[k] * some[math.ceil(low) : math.floor(high) + 1].sum()
            for k, (low, high) in enumerate(ends)
        )
        assert both == pytest.approx(0.83, abs=0.006)
        # The difference of two counts has sqrt 2 times the standard deviation of one.
        apart = np.arange(61)[:, None] - np.arange(61)
        variance = (some[:, None] * some * apart**2).sum()
        assert variance == pytest.approx(2 * 60 * p * (1 - p))
    half = 1.96 * math.sqrt(2 * 60 * 0.25)
    assert f"about {29 - half:.0f} to {29 + half:.0f}" in SENTENCES


def found_with_40(wall, first):
    """Return how many of 60 seeds find a path with 40 samples."""
    wall._known.clear()
    ends = day12_mujoco.START, day12_mujoco.GOAL
    return sum(
        len(planning.rrt_connect(
            *ends, wall, day12_mujoco.samples(wall.model, 160, seed)[:40], lab.STEP
        )) > 0
        for seed in range(first, first + 60)
    )  # fmt: skip


@pytest.mark.kit
def test_twelve_groups_of_sixty_seeds_and_each_link_omitted():
    counts = {}
    for row in rows_of("omitted link"):
        forget = () if row[0] == "none" else (int(row[0]),)
        wall = day12_mujoco.Wall(forget=forget)
        counts[row[0]] = [found_with_40(wall, 60 * k) for k in range(12)]
        assert str(sum(counts[row[0]])) == row[1], row
        assert str(np.sum(planned(wall)[3] <= 0.0)) == row[2], row
    whole = counts["none"]
    assert all(18 <= k <= 40 for k in whole)
    assert sum(22 <= k <= 36 for k in whole[1:]) == 8
    # The refutation: more edges become free without link 5 than without link 6.
    assert sum(counts["5"]) < sum(whole) < sum(counts["6"]) < sum(counts["7"])


@pytest.mark.kit
def test_more_edges_become_free_without_link_5_than_without_link_6():
    wall, blocked = day12_mujoco.Wall(), []

    class Asked:
        def edge_free(self, a, b):
            free = wall.edge_free(a, b)
            if not free:
                blocked.append((a.copy(), b.copy()))
            return free

    for seed in range(60):
        some = day12_mujoco.samples(wall.model, 160, seed)[:40]
        ends = day12_mujoco.START, day12_mujoco.GOAL
        planning.rrt_connect(*ends, Asked(), some, lab.STEP)
    free = {}
    for link in (5, 6, 7):
        other = day12_mujoco.Wall(forget=(link,))
        free[link] = sum(other.edge_free(a, b) for a, b in blocked)
    assert f"Of the {len(blocked):,} edges that collide" in SENTENCES
    words = f"{free[7]} become collision-free without link 7, {free[6]} without"
    assert f"{words} link 6, and {free[5]} without link 5" in SENTENCES


@pytest.mark.kit
def test_twelve_groups_of_thirty_seeds_without_the_hand():
    judge, found, collide = day12_mujoco.Wall(), [], []
    ends = day12_mujoco.START, day12_mujoco.GOAL
    for k in range(12):
        blind, paths = day12_mujoco.Wall(forget=(7,)), []
        for seed in range(30 * k, 30 * k + 30):
            some = day12_mujoco.samples(blind.model, lab.COUNTS[-1], seed)
            for n in lab.COUNTS:
                path = planning.rrt_connect(*ends, blind, some[:n], lab.STEP)
                if len(path):
                    break
            paths.append((n, path))
        found.append(sum(n <= 40 and len(path) > 0 for n, path in paths))
        cut = lab.shorter(blind, [path for _, path in paths])
        collide.append(sum(lab.least_distance(judge, path) <= 0.0 for path in cut))
    assert min(found) >= 25
    assert min(collide) >= 25


def test_the_endless_line_rejects_edges_and_accepts_none_that_collides():
    rng = np.random.default_rng(0)
    for _ in range(5000):
        a, b, c = rng.uniform(-1, 1, (3, 2))
        radius = rng.uniform(0.05, 0.5)
        if not planning.segment_free_of_discs(a, b, [(*c, radius)]):
            assert not EndlessLine(np.array([[*c, radius]])).edge_free(a, b)
    found = [
        planning.rrt_connect(start, goal, EndlessLine(discs), samples, step)
        for start, goal, discs, samples, step in worlds()
    ]
    assert (
        f"finds {sum(len(one) > 0 for one in found)} paths instead of 20" in SENTENCES
    )


class EndlessLine:
    """A collision checker that does not clamp: it uses the line, not the edge."""

    def __init__(self, discs):
        self.discs = discs

    def edge_free(self, a, b):
        to_centres = self.discs[:, :2] - a
        along = b - a
        t = to_centres @ along / max(along @ along, 1e-300)
        off = np.linalg.norm(to_centres - t[:, None] * along, axis=1)
        return bool(np.all(off > self.discs[:, 2]))


def worlds(seed=lab.SEED):
    """Return the lab's 25 worlds with their samples, or the worlds of another seed."""
    rng = np.random.default_rng(seed)
    lab.given_to_plane(rng)
    some = []
    for _ in range(lab.WORLDS):
        start, goal, discs = lab.plane_world(rng)
        samples = rng.uniform(-1.2, 1.2, (150, 2))
        rng.uniform(0.0, 1.0, (lab.PAIRS, 2))
        some.append((start, goal, discs, samples, lab.EDGE))
    return some


@pytest.mark.kit
def test_twelve_seeds_of_the_worlds():
    found = [
        sum(len(planning.rrt_connect(*one)) > 0 for one in worlds(seed))
        for seed in range(lab.SEED, lab.SEED + 12)
    ]
    assert found[0] == 20
    assert min(found) > 0.7 * 25


@pytest.mark.kit
def test_plain_rrt_needs_more_samples_than_rrt_connect():
    there = worlds()
    plain, biased, both = [], [], []
    for seed in range(12):
        rng = np.random.default_rng(seed)
        drawn = [rng.uniform(-1.2, 1.2, (150, 2)) for _ in there]
        aimed = [
            np.where(rng.random(150)[:, None] < 0.1, world[1], some)
            for world, some in zip(there, drawn, strict=True)
        ]
        for counts, plan, samples in (
            (plain, others.one_tree, drawn),
            (biased, others.one_tree, aimed),
            (both, planning.rrt_connect, drawn),
        ):
            counts.append(sum(
                len(plan(*world[:3], some, lab.EDGE)) > 0
                for world, some in zip(there, samples, strict=True)
            ))  # fmt: skip
    assert not any(plain)
    assert "it finds no path with any of twelve seeds" in SENTENCES
    assert f"RRT finds paths in {min(biased)} to {max(biased)} of the 25" in SENTENCES
    assert f"it finds paths in {min(both)} to {max(both)} of the 25" in SENTENCES


def test_the_voronoi_bias_comes_from_the_nearest_node():
    for name, squares, reach in rows_of("the node that grows"):
        found = np.array([grown(name, seed) for seed in range(12)]).mean(axis=0)
        assert f"{found[0]:.1f}" == squares, name
        assert f"{found[1]:.2f}" == reach, name


def grown(which, seed):
    """Return squares and reach of a tree that grows from one kind of node."""
    rng = np.random.default_rng(seed)
    tree = [np.zeros(2)]
    for q in rng.uniform(-1, 1, (100, 2)):
        i = {
            "the nearest": planning.nearest(np.array(tree), q),
            "the newest": len(tree) - 1,
            "a random one": rng.integers(len(tree)),
        }[which]
        tree.append(planning.steer(tree[i], q, 0.1))
    squares = np.unique(np.floor((np.array(tree) + 1) / 0.25).clip(0, 7), axis=0)
    return len(squares), np.linalg.norm(tree, axis=1).max()


def connects(towards, until, world, limit=200):
    """Return how the worked example ends if the other tree grows like this."""
    trees = [np.zeros(2)], [np.array([2.5, 0.0])]
    sample = np.array([0.0, 2.0])
    _, new, _ = planning.extend(np.array(trees[0]), sample, 1.0, world)
    points = {"the new node": new, "the sample": sample}
    for _ in range(limit):
        _, q, free = planning.extend(np.array(trees[1]), points[towards], 1.0, world)
        if not free:
            return "collides"
        trees[1].append(q)
        if np.array_equal(q, points[until]):
            return "found" if np.array_equal(q, new) else "found, and they do not meet"
    return "never ends"


def test_two_of_four_connect_loops_never_end():
    nothing = np.empty((0, 3))
    for towards, until, end in (
        ("the new node", "the new node", "found"),
        ("the new node", "the sample", "never ends"),
        ("the sample", "the new node", "never ends"),
        ("the sample", "the sample", "found, and they do not meet"),
    ):
        assert connects(towards, until, nothing) == end


def test_one_joint_is_exact_with_an_even_number_of_steps_only():
    for n, time in ((100, 1.0), (4, 1.0), (5, 1.0062), (11, 1.0011)):
        one = np.ones((n + 1, 1))
        x = planning.time_optimal_profile(
            2 * one, 0 * one, 0 * one, [8.0], 1e3 * one[:, 0]
        )
        assert planning.travel_time(x) == pytest.approx(time, abs=5e-5)


@pytest.mark.kit
def test_a_larger_speed_permits_a_larger_speed_at_the_next_point():
    A, B, G, most = lab.along(ARM, READY, lab.TO, lab.POINTS)
    two_ds = 2.0 / lab.POINTS
    top = np.zeros(len(A))
    for i in range(lab.POINTS - 1, -1, -1):
        given = A[i], B[i], G[i], LIMITS, most[i], top[i + 1], two_ds
        top[i] = planning._reaches_next(*given)
    for i in range(lab.POINTS):
        after = [
            min(top[i + 1], x + two_ds * planning.path_accel_bounds(
                A[i], B[i], G[i], LIMITS, np.sqrt(x))[1])
            for x in np.linspace(0.0, top[i], 60)
        ]  # fmt: skip
        assert np.all(np.diff(after) >= -1e-12), i
    assert "this condition holds at all 100 steps" in SENTENCES


@pytest.mark.kit
def test_other_planners_find_as_many_ways_of_which_some_are_none():
    there = worlds()

    def other(**how):
        return lambda *given: others.planner(*given, **how)

    planners = [
        planning.rrt_connect, other(turn="grew"), other(turn="never"),
        other(approach="one"), other(approach="sample"), others.one_tree,
        other(approach="jump"), other(parent="newest"),
        other(joined=lambda a, b: a + b[1:]), other(free=True),
    ]  # fmt: skip
    table = rows_of("planner")
    assert len(table) == len(planners)
    for (name, finds, valid), plan in zip(table, planners, strict=True):
        found = [(plan(*given), given) for given in there]
        found = [(path, given) for path, given in found if len(path)]
        good = [others.fault(path, *given[:3], given[4]) == "" for path, given in found]
        assert [len(found), sum(good)] == [int(finds), int(valid)], name
        if "of any length" in name:  # only the rule about the step is broken
            assert all(
                planning.segment_free_of_discs(a, b, given[2])
                for path, given in found for a, b in pairwise(path)
            )  # fmt: skip


@pytest.mark.kit
def test_a_checker_that_omits_a_link_is_not_known_by_the_planners_numbers():
    right = planned(day12_mujoco.Wall())
    blind = planned(day12_mujoco.Wall(forget=(7,)))
    assert all(a > b for a, b in zip(blind[0][:4], right[0][:4], strict=True))
    assert np.median(blind[2]) < np.median(right[2])
    assert not np.any(right[3] <= 0.0)
    assert np.sum(blind[3] <= 0.0) > 45
    five = planned(day12_mujoco.Wall(forget=(5,)))
    assert five[0][2] == right[0][2] == 29
    assert 0.9 < five[1] / right[1] < 1.1  # nor do the distance queries reveal it
    assert f"and {np.sum(five[3] <= 0.0)} of 60 paths collide" in SENTENCES


@pytest.mark.kit
def test_points_of_an_edge_miss_what_a_walk_along_it_does_not():
    checkers = [AtPoints(k) for k in (0, 1, 3, 8)] + [day12_mujoco.Wall()]
    table = rows_of("points inside each edge")
    for row, wall in zip(table, checkers, strict=True):
        counts, looks, _, least = planned(wall)
        assert counts[-1] == 60
        hit = f"{np.sum(least <= 0.0)} of 60"
        assert row[1:] == [str(counts[2]), f"{looks:.0f}", hit], row[0]


@pytest.mark.kit
def test_a_longer_step_finds_more_in_the_same_narrow_scene():
    for step, *counts, cut in rows_of("step"):
        wall = day12_mujoco.Wall()
        found, _, lengths, _ = planned(wall, float(step))
        assert list(map(str, found)) == counts, step
        assert f"{np.median(lengths):.2f}" == cut, step
    low, high = (
        planned(day12_mujoco.Wall(roof=roof))[0][2] for roof in (0.80, 1.00)
    )  # fmt: skip
    assert f"at 0.80 m the planner finds a path in {low} of 60 trials" in SENTENCES
    assert f"of 60 trials, and at 1.00 m in {high}" in SENTENCES
    assert "8, 46 and 36" in SENTENCES
    # Doubling the step has about the effect of doubling the samples.
    table = {row[0]: [int(x) for x in row[1:6]] for row in rows_of("step")}
    for short, long in (("0.3", "0.6"), ("0.6", "1.2")):
        assert np.abs(np.subtract(table[short][1:], table[long][:4])).max() <= 6


@pytest.mark.kit
def test_longer_edges_collide_more_often():
    wall = day12_mujoco.Wall()
    shares = []
    for step in (0.3, 0.6, 1.2, 2.4):
        told = []

        class Asked:
            def edge_free(self, a, b, told=told):
                told.append(wall.edge_free(a, b))
                return told[-1]

        for seed in range(20):
            some = day12_mujoco.samples(wall.model, 160, seed)[:40]
            ends = day12_mujoco.START, day12_mujoco.GOAL
            planning.rrt_connect(*ends, Asked(), some, step)
        shares.append(f"{100 * (1 - np.mean(told)):.0f}")
    a, b, c, d = shares
    assert f"{a}, {b}, {c} and {d} % of them for the four steps" in SENTENCES


@pytest.mark.kit
def test_between_the_points_the_torque_is_above_its_limit_and_more_with_damping():
    said = []
    for n in (50, 100, 400):
        path = lab.along(ARM, READY, lab.TO, n)
        x = planning.time_optimal_profile(*path[:3], LIMITS, path[3])
        args = INVERSE, LIMITS, READY, lab.TO, x
        assert lab.torque_share(*args, (0.0,)) == pytest.approx(1.0, abs=1e-9)
        said.append(lab.torque_share(*args, (0.5, 1.0)))
        assert said[-1] == pytest.approx(lab.torque_share(*args, (1.0,)))
    assert said[0] > said[1] > said[2]  # it shrinks with the steps
    assert f"imposes no limits, and the ratio reaches {said[1]:.3f}" in SENTENCES
    path = lab.along(ARM, READY, lab.TO, 100)
    x = planning.time_optimal_profile(*path[:3], LIMITS, path[3])
    damped = day12_mujoco.torque(panda.load("panda_nohand"))
    share = lab.torque_share(damped, LIMITS, READY, lab.TO, x, (0.0,))
    assert f"with damping, MuJoCo computes a ratio of {share:.2f}" in SENTENCES


@pytest.mark.kit
def test_what_a_forgotten_pass_looks_like():
    timed = DAY.module("time_optimal_profile").timed
    A, B, G, most = lab.along(ARM, READY, lab.TO, lab.POINTS)
    given = A, B, G, LIMITS, most
    variants = [
        planning.time_optimal_profile(*given),
        timed(*given, passes="forward"),
        timed(*given, passes="back"),
        timed(*given, most=lambda x: 1e4 * x),
        timed(*given, pull=lambda A, B, G: (A, B, 0 * G)),
    ]
    for row, x in zip(rows_of("omitted part"), variants, strict=True):
        _, time, share, rest = row
        assert f"{planning.travel_time(x):.3f}" == time
        found = lab.torque_share(INVERSE, LIMITS, READY, lab.TO, x, (0.0,))
        assert f"{found:.2f}" == share
        assert rest.startswith("yes") == (x[0] == x[-1] == 0.0)
        assert ("moves at the end" in rest) == (x[-1] > 0.0)
        assert ("moves at the start" in rest) == (x[0] > 0.0)
    speed = np.sqrt(np.max(variants[3] / most))
    assert f"at {speed:.1f} times the velocity limit" in SENTENCES


def test_ways_over_the_wall_are_quicker_cut_and_quicker_than_quintics(printed):
    for legs, fast, slow in re.findall(
        r"seed \d: (\d) edges, ([\d.]+) s; as quintics ([\d.]+) s", printed
    ):
        assert int(legs) == 3
        assert 1.7 < float(slow) / float(fast) < 2.0


@pytest.mark.kit
def test_a_tree_that_waits_for_the_sample_is_told_what_to_compare_with(student):
    code = (ROOT / "w2-autonomy/src/day12_planning.py").read_text("utf-8")
    waits = code.replace("while grow(other, new):", "while grow(other, sample):")
    waits = waits.replace(
        "array_equal(trees[other][-1], new)", "array_equal(new, sample)"
    )
    assert waits.count("sample)") == code.count("sample)") + 2
    with Sandbox() as sandbox:
        results = check_tasks(DAY, student(waits, DAY.script), sandbox, "12.4", seed=1)
    (verdict,) = [one.verdict for one in results if one.task.id == "12.4"]
    assert verdict.mistake == "stopped"
    assert "rrt_connect did not return" in verdict.message
    assert "compare its last node with the new node" in verdict.message


def test_edges_of_a_way_are_free_and_a_step_long_at_most():
    wall = day12_mujoco.Wall()
    samples = day12_mujoco.samples(wall.model, 160, 0)
    way = lab.rrt_connect(
        day12_mujoco.START, day12_mujoco.GOAL, wall, samples, lab.STEP
    )
    for a, b in pairwise(way):
        assert np.linalg.norm(b - a) <= lab.STEP * (1 + 1e-12)
        assert wall.edge_free(a, b)


LOOKS = {
    "rows": "world.rows",
    "rows if there are": 'getattr(world, "rows", np.empty((0, 3)))',
    "its discs": "world if isinstance(world, np.ndarray) else np.empty((0, 3))",
    "what it keeps": "([x for x in getattr(world, '__dict__', {}).values()"
    " if isinstance(x, np.ndarray)] or [np.empty((0, 3))])[0]",
}


@pytest.mark.kit
@pytest.mark.parametrize("look", LOOKS.values(), ids=LOOKS)
@pytest.mark.parametrize("task", ["12.3", "12.5"])
def test_who_does_not_ask_a_world_does_not_pass(student, look, task):
    code = (ROOT / "w2-autonomy/src/day12_planning.py").read_text("utf-8")
    discs = f"world if isinstance(world, np.ndarray) else {look}"
    code += f"""

def edge_free(a, b, world):
    return segment_free_of_discs(a, b, {discs})
"""
    with Sandbox() as sandbox:
        results = check_tasks(DAY, student(code, DAY.script), sandbox, task, seed=1)
    told = {one.task.id: one.verdict.status for one in results}
    assert told[task] == "wrong"


@pytest.mark.kit
def test_behind_the_wall_the_lab_asks_the_students_own_planner():
    asked = set()

    def heard(process, told):
        asked.add(type(process.worlds[told[0]]).__name__)
        return old(process, told)

    old = Process._say_if_free
    with Sandbox() as sandbox, patch.object(Process, "_say_if_free", heard):
        assert rehearse(DAY, DAY.source, sandbox).fault == ""
    assert "Wall" in asked


@pytest.mark.kit
def test_behind_the_wall_the_lab_is_run_to_its_end():
    with Sandbox() as sandbox:
        fault, numbers, unfinished = rehearse(DAY, DAY.source, sandbox)
    assert (fault, unfinished) == ("", "")
    assert numbers["planned", "low_160"] == pytest.approx(0.9398, abs=1e-4)


@pytest.mark.kit
def test_a_world_that_can_only_be_asked_says_what_the_library_says_of_its_discs():
    rng = np.random.default_rng(7)
    told = []
    for _ in range(300):
        discs = rng.uniform((-1, -1, 0.05), (1, 1, 0.4), (3, 3))
        a, b = rng.uniform(-1, 1, (2, 2)) if len(told) % 10 else np.zeros((2, 2))
        told.append(planning.segment_free_of_discs(a, b, discs))
        assert Balls(discs).edge_free(a, b) is told[-1]
    assert 30 < sum(told) < 270
