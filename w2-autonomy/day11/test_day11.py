"""Day 11: the numbers in the guide's sentences, and every reason in it."""

import re
from unittest.mock import patch

import mujoco
import numpy as np
import pytest

from conftest import ROOT, load_script, printed_by, sentences
from labkit.judge.row import row_of
from labkit.lesson.day import find_day
from robo47 import distance, panda, shapes
from robo47.jacobian import space_jacobian

import day11_mujoco

SENTENCES = sentences(11)
DAY = find_day(11)
lab = load_script(ROOT / "w2-autonomy/src/day11_distance.py")
arm = shapes.Shape(panda.load("panda_nohand"), day11_mujoco.CAPSULES)
REACH = arm.distal_radii
OFFSETS, FAR = arm.lengths
SEEDS = (1, 2, 3)
TABLE = re.findall(r"\| ([^|]+) \| \**(\d+) (\d+) (\d+)\** \| (\d+) \|", SENTENCES)


@pytest.fixture(scope="module")
def printed():
    """Return what the lab prints."""
    told = {"missed by 10 points, share": "0.498",
            "slope of joint 1, m/rad": "-0.30702",
            "met halfway: missed by 10 points, of 60": "60"}  # fmt: skip
    return printed_by(lab, told)


@pytest.fixture(scope="module")
def whips():
    """Return the ways past a wire, by seed."""
    return [day11_mujoco.whips(lab.WHIPS, lab.THIN, seed) for seed in SEEDS]


def missed(radius, points, scale=1.0):
    """Return how many ways past a post points miss, by seed; ways may be shorter."""
    return [
        lab.missed_by_points(
            [shorter(e, scale) for e in day11_mujoco.whips(lab.WHIPS, radius, seed)],
            points,
        )
        for seed in SEEDS
    ]


def shorter(edge, scale):
    """Return a way of another length, which meets the wire at the same s."""
    if scale == 1.0:
        return edge
    s = np.linspace(0, 1, 401)
    at = s[np.argmin(lab.pen_from(edge, s))]
    return edge._replace(q=edge.q + at * (1 - scale) * edge.dq, dq=scale * edge.dq)


def by(speed):
    """Return a `conservative_advance` with another speed of the farthest point."""

    def check(s, d, dq, reach):
        return s if d <= 0 else min(1.0, s + d / max(speed(dq, reach), 1e-12))

    return check


def walked(edges, check=distance.conservative_advance, reach=REACH):
    """Return how many ways a check finds free, and its looks."""
    with patch.object(lab, "conservative_advance", check):
        return lab.promises(edges, reach)


CHECKS = {
    "the bound of 11.8": {},
    "the distance as a step, s + d": {"check": by(lambda dq, reach: 1.0)},
    "the signs of dq kept": {"check": by(lambda dq, reach: dq @ reach)},
    "only the joint that moves most": {
        "check": by(lambda dq, reach: (np.abs(dq) * reach).max())
    },
    "reach from the base, not from the joint": {
        "reach": np.append(0.0, np.cumsum(OFFSETS)[:-1]) + FAR
    },
    "reach of the joint's own link only": {"reach": FAR},
    "half of the reach": {"reach": REACH / 2},
    "length of dq times the largest reach": {
        "check": by(lambda dq, reach: np.linalg.norm(dq) * reach.max())
    },
}


@pytest.mark.kit
def test_three_predictions_of_the_worksheet_stand_beside_what_is_measured(printed):
    sheet = (ROOT / "w2-autonomy/docs/day11.md").read_text("utf-8")
    for yours, found in (("0.498", 0.485), ("-0.30702", -0.307), ("60", 60)):
        row = rf"you predicted {yours}, measured ([-\d.]+):\s+([^\n]+)"
        measured, name = re.search(row, printed).groups()
        assert float(measured) == pytest.approx(found, abs=5e-4)
        assert f"| {name}" in sheet


@pytest.mark.kit
def test_what_the_opening_promises_is_what_the_lab_prints(printed):
    by_20 = int(re.search(r" 20 points miss (\d+) of 60", printed)[1])
    assert f"finds {60 - by_20} of them, and calls {by_20} free" in SENTENCES
    looks = re.search(r"the bound misses 0; looks: (\d+), at most", printed)[1]
    assert f"found all 60, with {looks} looks at each" in SENTENCES
    assert f"misses a wire on {by_20} of 60; a bound with {looks} looks" in DAY.see
    least = re.search(r"slowed: ([\d.]+) mm, ends 0.0 mm", printed)[1]
    assert "have gone round it, 10 mm away" in SENTENCES
    assert round(float(least)) == 10


def test_the_arm_is_nine_capsules_the_last_a_pen():
    pen = shapes.PEN
    length = 1000 * np.subtract(pen.b, pen.a)[2]
    assert len(day11_mujoco.CAPSULES) == 9
    words = f"a pen of {1000 * pen.radius:.0f} mm radius and {length:.0f} mm length"
    assert words in SENTENCES
    short = np.linalg.norm(np.subtract(*day11_mujoco.RODS[4][:2]))
    assert f"one {1000 * short:.0f} mm short" in SENTENCES


def test_what_is_worked_by_hand():
    ends = [np.array(x, float) for x in ((0, 0, 0), (1, 0, 0), (2, 1, 0), (1, 2, 0))]
    assert np.allclose(lab.closest_points_segments(*ends), [(1, 0, 0), (2, 1, 0)])
    assert lab.box_sdf(np.array([2.0, 2, 0]), np.ones(3)) == pytest.approx(
        1.414, abs=1e-3
    )
    assert lab.box_sdf(np.array([0.5, 0.2, 0]), np.ones(3)) == pytest.approx(-0.5)
    assert f"{0.618**60:.0e}".replace("e-", "e-") == "3e-13"
    half = np.full(7, 0.5)
    assert lab.conservative_advance(0.25, 0.1, np.ones(7), half) == pytest.approx(
        0.27857, abs=1e-5
    )
    assert np.allclose(
        lab.distal_radii(np.array([1.0, 1, 0]), half[:3]), [2.5, 1.5, 0.5]
    )


@pytest.mark.kit
def test_what_a_mistake_does_to_the_distance_of_pairs_and_where_it_hides():
    pairs = np.random.default_rng(lab.SEED).uniform(-0.5, 0.5, (2000, 4, 3))
    row = row_of(DAY, "closest_points_segments")
    code = {way.slug: way.code for way in reversed(row.ways)}
    right = np.array([distance.closest_points_segments(*x) for x in pairs])
    far = np.linalg.norm(right[:, 0] - right[:, 1], axis=1)

    def off(slug, size=1.0):
        found = np.array([code[slug](*x) for x in size * pairs])
        return np.abs(np.linalg.norm(found[:, 0] - found[:, 1], axis=1) - size * far)

    mm = {slug: 1000 * off(slug)
          for slug in ("not-clamped", "clamped-apart", "ends-only", "points-swapped",
                       "size-absolute")}  # fmt: skip
    for name, slug in {
        "s and t not cut": "not-clamped", "both cut, each for itself": "clamped-apart",
        "only ends are tried": "ends-only", "the second point first": "points-swapped",
    }.items():  # fmt: skip
        assert f"| {name} | {mm[slug].max():.0f} |" in SENTENCES
    ends = pairs.reshape(-1, 2, 2, 3)  # pair, segment, end
    to_ends = np.linalg.norm(right[:, :, None] - ends, axis=3).min(axis=2)
    inside = np.all(to_ends > 1e-9, axis=1)
    for slug in ("not-clamped", "clamped-apart"):
        assert mm[slug][inside].max() < 1e-9
    assert (
        f"two: {np.mean(mm['ends-only'] < 1e-6):.0%} of".replace("%", " %") in SENTENCES
    )
    assert np.array_equal(mm["ends-only"] > 1e-6, inside)
    assert mm["size-absolute"].max() < 1e-9
    small = 1000 * off("size-absolute", 0.004).max()
    assert f"cube of 4 mm it is off by up to {small:.1f} mm" in SENTENCES


@pytest.mark.kit
def test_depth_has_two_meanings_and_one_sign(printed):
    model, data = day11_mujoco.scene()
    truth, ours = [], []
    for q in day11_mujoco.poses(lab.TRIALS, lab.SEED):
        data.qpos[:] = q
        mujoco.mj_kinematics(model, data)
        near = arm.distances(q, day11_mujoco.WORLD)[:, 5:]
        for i, j in np.ndindex(near.shape):
            pair = model.geom(f"arm{i}").id, model.geom(f"world{5 + j}").id
            d = mujoco.mj_geomDistance(model, data, *pair, 10, np.zeros(6))
            truth.append(d)
            ours.append(near[i, j])
    truth, ours = np.array(truth), np.array(ours)
    assert np.array_equal(truth < 0, ours < 0)
    assert np.abs(truth - ours)[truth > 0].max() < 1e-14
    assert np.abs(truth - ours)[truth < 0].max() > 0.01
    assert f"{np.sum(truth > 0)} pairs; {np.sum(truth < 0)} overlap" in printed


@pytest.mark.kit
def test_columns_behind_the_link_are_wrong_but_for_link_7():
    screws = panda.screws(panda.load("panda_nohand"))
    b0, b1, _ = (np.array(x) for x in day11_mujoco.RODS[0])
    off = dict.fromkeys(range(1, 8), 0.0)
    for q in day11_mujoco.poses(lab.TRIALS, lab.SEED)[: lab.TRIALS // 5 + 1]:
        J = space_jacobian(screws, q)
        for link, ends in zip(arm.links, arm.ends(q), strict=True):
            p, o = distance.closest_points_segments(*ends, b0, b1)
            right = distance.distance_gradient(J, p, o, int(link))
            kept = distance.distance_gradient(J, p, o, 7)
            off[int(link)] = max(off[int(link)], np.abs(kept - right).max())
            swapped = distance.distance_gradient(J, o, p, int(link))
            lever = distance.distance_gradient(J, p + 0.3 * (o - p), o, int(link))
            assert np.allclose(lever, right)  # where along n does not matter
            assert np.allclose(swapped, -right)
    assert off[7] == 0.0
    assert f"wrong by up to {max(off.values()):.2f} m/rad" in SENTENCES


@pytest.mark.kit
def test_what_points_miss_is_the_share_of_the_way_that_none_looks_at(printed):
    rho = 1000 * np.linalg.norm(day11_mujoco.pen(panda.READY_Q)[1, :2])
    assert f"its axis {rho:.0f} mm from joint 1" in SENTENCES
    assert f"{rho:.0f} / 11 = {rho / 11:.1f} mm" in SENTENCES
    assert f"1 - 14 / 27.9 = {1 - 14 / 27.9:.3f}" in SENTENCES
    for k, guess, share in re.findall(r"\n +(\d+) +(0\.\d+) +(0\.\d+)", printed):
        assert float(guess) == pytest.approx(
            max(0, 1 - 14 * (int(k) + 1) / rho), abs=1e-3
        )
        assert float(share) == pytest.approx(float(guess), abs=0.05)
    thick = day11_mujoco.wires(lab.PLACES, 2 * lab.WIRE, lab.SEED)  # contact 18 mm
    share = lab.missed_by_points(thick, 10) / lab.PLACES
    assert share == pytest.approx(1 - 18 * 11 / rho, abs=0.05)


@pytest.mark.kit
@pytest.mark.parametrize("row", TABLE, ids=lambda row: row[0])
def test_a_row_of_the_trap(row, whips):
    name, *numbers, looks = row
    numbers = [int(x) for x in numbers]
    if points := re.fullmatch(r"(\d+) points", name):
        assert points[1] == looks
        assert [lab.missed_by_points(some, int(looks)) for some in whips] == numbers
        return
    found = [walked(some, **CHECKS[name]) for some in whips]
    assert [free for free, _ in found] == numbers
    assert np.median([n for _, some in found for n in some]) == int(looks)


def test_all_checks_of_the_trap_were_compared():
    assert len(TABLE) == 13
    assert {row[0] for row in TABLE} >= CHECKS.keys()


@pytest.mark.kit
def test_the_length_of_dq_is_no_bound_and_ways_can_be_chosen_that_show_it():
    rng = np.random.default_rng(1)
    edges = []
    up = np.array([0, 0, 0.2])
    for _ in range(60):
        q = day11_mujoco.FLAT.copy()
        q[[0, 3, 5]] = rng.uniform((-1, -0.4, 2.6), (1, -0.07, 3.2))
        dq = np.zeros(7)
        dq[[0, 3, 5]] = rng.uniform((0.7, 0.4, 0.15), (0.9, 0.6, 0.25)) * (1, -1, -1)
        start, end = day11_mujoco.pen(q + rng.uniform(0.05, 0.95) * dq)
        at = start + rng.uniform(0.8, 0.98) * (end - start)
        edges.append(day11_mujoco.Edge(q, dq, (at - up, at + up, lab.THIN)))
    by_length, _ = walked(edges, **CHECKS["length of dq times the largest reach"])
    assert f"it misses {by_length} of 60; the bound none" in SENTENCES
    assert by_length > 0
    assert walked(edges)[0] == 0


@pytest.mark.kit
def test_a_test_with_the_wire_always_halfway_is_blind(printed):
    assert "always met halfway: 3 points miss 0, 10 miss 60" in printed
    for seed in SEEDS:
        middle = day11_mujoco.whips(lab.WHIPS, lab.THIN, seed, middle=True)
        assert [lab.missed_by_points(middle, k) for k in (3, 10)] == [0, 60]
    assert min(abs(k / 11 - 0.5) for k in range(12)) == pytest.approx(1 / 22)
    assert f"That is {1050 / 22:.0f} mm of 1.05 m" in SENTENCES


@pytest.mark.kit
def test_20_points_are_enough_only_for_what_is_thick_on_a_way_that_is_short():
    assert missed(0.030, 20) == [0, 0, 0]
    thin, few = missed(0.015, 20), missed(0.030, 10)
    assert "{}, {} and {} are missed; then {}, {} and {}; then none".format(
        *thin, *few
    ) in SENTENCES  # fmt: skip
    assert missed(0.015, 20, scale=0.5) == [0, 0, 0]
    ways = [
        np.linalg.norm(np.diff(day11_mujoco.pen(
            e.q + np.linspace(0, 1, 51)[:, None] * e.dq)[:, 1], axis=0), axis=1).sum()
        for seed in SEEDS for e in day11_mujoco.whips(lab.WHIPS, lab.THIN, seed)
    ]  # fmt: skip
    assert f"a way of about {np.median(ways):.2f} m" in SENTENCES
    assert f"are {1000 * np.median(ways) / 21:.0f} mm each" in SENTENCES


@pytest.mark.kit
def test_straight_at_it_the_distance_shrinks_as_the_gain_says(printed):
    assert f"$e^{{-4}}$ = {np.exp(-4):.4f}" in SENTENCES
    assert f"$0.96^{{100}}$ = {0.96**100:.4f}" in SENTENCES
    share = float(re.search(r"after 1 s (0\.\d+) of", printed)[1])
    assert share == pytest.approx(0.96**100, rel=0.03)
    fine = lab.left_of_it(distance.velocity_damper, dt=0.002)
    assert fine == pytest.approx(np.exp(-4), rel=0.03)


def near_relatives():
    """Return other rules for qd, by the guide's name."""

    def lack(qd, slope, d, gain):
        return -gain * d - slope @ qd

    def always(qd, slope, d, gain):
        return qd + slope * lack(qd, slope, d, gain) / (slope @ slope)

    def not_divided(qd, slope, d, gain):
        return qd + slope * max(lack(qd, slope, d, gain), 0)

    def nearer(qd, slope, d, gain):
        return 2 * qd - distance.velocity_damper(qd, slope, d, gain)

    def alike(qd, slope, d, gain):
        if lack(qd, slope, d, gain) <= 0:
            return qd
        return qd * max(-gain * d / (slope @ qd), 0)

    def stops(qd, slope, d, gain):
        return qd * (lack(qd, slope, d, gain) <= 0)

    return {
        "nothing": lambda qd, *_: qd, "the right one": distance.velocity_damper,
        "always changed, also when allowed": always,
        "not divided by slope²": not_divided,
        "pushed nearer": nearer, "all joints slowed alike": alike, "stops dead": stops,
    }  # fmt: skip


@pytest.mark.kit
@pytest.mark.parametrize("name", near_relatives())
def test_told_to_go_through_a_post(name):
    least, beside = lab.through(lab.POST, near_relatives()[name])
    assert f"| {name} | {least:.0f} | {beside:z.0f} |" in SENTENCES


@pytest.mark.kit
def test_one_pair_guards_one_pair_and_several_do_not_plan():
    def post(x):
        return ((x, 0.0, 0.0), (x, 0.0, 0.9), lab.POST[2])

    one, _ = lab.through(post(lab.POST[0][0] - 0.05), distance.velocity_damper)
    four, _ = lab.through(post(lab.POST[0][0] - 0.05), distance.velocity_damper, 4)
    safe, beside = lab.through(post(lab.POST[0][0] - 0.08), distance.velocity_damper, 4)
    assert f"50 mm nearer: {one:.1f} mm" in SENTENCES
    assert f"in rounds, it is {four:.1f} mm" in SENTENCES
    assert f"{safe:.1f} mm, and it stops {beside:.0f} mm away" in SENTENCES
