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
    told = {"low end for 60 of 60": "0.94", "one joint over 1 rad, s": "1",
            "with half of the torque, s": "0.813"}  # fmt: skip
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
    assert "√2 as long: 0.813 s" in SENTENCES
    assert math.sqrt(2) * 0.575 == pytest.approx(0.813, abs=5e-4)
    assert "Predicted 0.813 s, measured 0.703 s" in SENTENCES


def test_what_the_opening_promises_is_what_the_lab_prints(printed):
    whole, short = re.search(r"\n +40 +(\d+) of 60 .+? (\d+) of 30 ", printed).groups()
    assert f"in {short} of 30 tries with 40 samples" in SENTENCES
    assert f"does it in {whole} of 60" in SENTENCES
    assert f"{short} of 30 for {whole} of 60" in SENTENCES
    row = r"{} +([\d.]+) +([\d.]+) +(\d+) +(\d+) of \d+ +(-?[\d.]+)"
    right, blind = (
        re.search(row.format(name), printed).groups()
        for name in ("whole arm", "hand forgotten")
    )
    assert float(blind[0]) < float(right[0])
    assert float(blind[1]) < float(right[1])
    assert 0.45 < float(blind[2]) / float(right[2]) < 0.6  # it looks half as often
    assert [right[3], blind[3]] == ["0", "25"]
    assert f"{blind[3]} of its 30 ways go through wall or roof" in SENTENCES
    assert f"up to {abs(float(blind[4])):.0f} mm deep" in SENTENCES
    assert "ways in 20 of 25 worlds" in printed
    assert "20 of 25: in the other five" in SENTENCES


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
    assert f"{free[0]:.3f} s and {free[1]:.3f} s, {free[1] / free[0]:.2f} times" in (
        SENTENCES
    )
    light = [seconds_of(share, speed=100.0, weight=0.0) for share in (1.0, 0.5)]
    assert light[1] / light[0] == pytest.approx(math.sqrt(2), abs=1e-9)
    assert "and without gravity it is 1.414" in SENTENCES
    A, B, G, most = lab.along(ARM, READY, lab.TO, lab.POINTS)
    x = planning.time_optimal_profile(A, B, G, LIMITS, most)
    assert f"{np.mean(x > most - 1e-9):.0%}".replace(
        "%", " % of the points with all"
    ) in (SENTENCES)


def test_the_first_five_seeds_say_next_to_nothing():
    needed, _ = lab.plan_with(day12_mujoco.Wall(), 5)
    k = int(np.sum(needed <= 40))
    low, high = lab.wilson_interval(k, 5)
    assert f"find a way in {k} of 5" in SENTENCES
    assert f"{k} of 5: {low:.2f} to {high:.2f}" in SENTENCES
    low, high = lab.wilson_interval(29, 60)
    assert f"29 of 60: {low:.2f} to {high:.2f}" in SENTENCES
    assert np.diff(lab.wilson_interval(47, 95))[0] / 2 == pytest.approx(0.1, abs=2e-3)


@pytest.mark.kit
def test_other_planners_find_as_many_ways_of_which_some_are_none():
    rng = np.random.default_rng(lab.SEED)
    lab.given_to_plane(rng)
    worlds = []
    for _ in range(lab.WORLDS):
        start, goal, discs = lab.plane_world(rng)
        samples = rng.uniform(-1.2, 1.2, (150, 2))
        rng.uniform(0.0, 1.0, (lab.PAIRS, 2))
        worlds.append((start, goal, discs, samples, lab.EDGE))

    def other(**how):
        return lambda *given: others.planner(*given, **how)

    planners = [
        planning.rrt_connect, other(turn="grew"), other(turn="failed"),
        other(turn="never"), other(approach="one"), other(approach="sample"),
        others.one_tree, other(approach="jump"), other(parent="newest"),
        other(joined=lambda a, b: a + b[1:]), other(free=True),
    ]  # fmt: skip
    table = rows_of("planner")
    assert len(table) == len(planners)
    for (name, finds, valid), plan in zip(table, planners, strict=True):
        found = [(plan(*given), given) for given in worlds]
        there = [(way, given) for way, given in found if len(way)]
        good = [others.fault(way, *given[:3], given[4]) == "" for way, given in there]
        assert [len(there), sum(good)] == [int(finds), int(valid)], name


@pytest.mark.kit
def test_a_checker_that_forgets_plans_better_because_its_arm_is_smaller():
    right = planned(day12_mujoco.Wall())
    blind = planned(day12_mujoco.Wall(forget=(7,)))
    assert all(a > b for a, b in zip(blind[0][:4], right[0][:4], strict=True))
    assert np.median(blind[2]) < np.median(right[2])
    assert not np.any(right[3] <= 0.0)
    assert np.sum(blind[3] <= 0.0) > 45
    five = planned(day12_mujoco.Wall(forget=(5,)))
    assert five[0][2] == right[0][2] == 29
    assert 0.9 < five[1] / right[1] < 1.1  # nor does speed give it away
    assert f"and {np.sum(five[3] <= 0.0)} of 60 ways collide" in SENTENCES
    for link in (3, 4):
        assert not np.any(planned(day12_mujoco.Wall(forget=(link,)))[3] <= 0.0)


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
    assert f"at 0.80 m it is {low} of 60, at 1.00 m {high}" in SENTENCES
    assert "8, 46 and 36" in SENTENCES


@pytest.mark.kit
def test_between_the_points_the_torque_is_above_its_limit_and_more_with_damping():
    said = []
    for n in (100, 50, 400):
        path = lab.along(ARM, READY, lab.TO, n)
        x = planning.time_optimal_profile(*path[:3], LIMITS, path[3])
        args = INVERSE, LIMITS, READY, lab.TO, x
        assert lab.torque_share(*args, (0.0,)) == pytest.approx(1.0, abs=1e-9)
        said.append(lab.torque_share(*args, (0.5, 1.0)))
        assert said[-1] == pytest.approx(lab.torque_share(*args, (1.0,)))
    words = "there it is {:.3f}, and with 50 or 400 steps {:.3f} and {:.3f}"
    assert words.format(*said) in SENTENCES
    path = lab.along(ARM, READY, lab.TO, 100)
    x = planning.time_optimal_profile(*path[:3], LIMITS, path[3])
    damped = day12_mujoco.torque(panda.load("panda_nohand"))
    share = lab.torque_share(damped, LIMITS, READY, lab.TO, x, (0.0,))
    assert f"with it MuJoCo says {share:.2f}" in SENTENCES


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
    for row, x in zip(rows_of("forgotten"), variants, strict=True):
        _, time, share, rest = row
        assert f"{planning.travel_time(x):.3f}" == time
        found = lab.torque_share(INVERSE, LIMITS, READY, lab.TO, x, (0.0,))
        assert f"{found:.2f}" == share
        assert rest.startswith("yes") == (x[0] == x[-1] == 0.0)
        assert ("ends in motion" in rest) == (x[-1] > 0.0)
        assert ("begins in motion" in rest) == (x[0] > 0.0)
    speed = np.sqrt(np.max(variants[3] / most))
    assert f"at {speed:.1f} times the motors' speed" in SENTENCES


def test_ways_over_the_wall_are_quicker_cut_and_quicker_than_quintics(printed):
    for legs, fast, slow in re.findall(
        r"seed \d: (\d) legs, ([\d.]+) s; as quintics ([\d.]+) s", printed
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
    assert "compare with that" in verdict.message


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
