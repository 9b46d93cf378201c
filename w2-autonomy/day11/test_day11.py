"""Day 11: the numbers in the guide's sentences, and every reason in it."""

import re
from unittest.mock import patch

import mujoco
import numpy as np
import pytest

from conftest import ROOT, load_script, printed_by, sentences
from labkit.judge.row import row_of
from labkit.lesson.day import find_day
from robo47 import distance, panda, se3, shapes
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
TWELVE = range(1, 13)  # seeds
BY_SAMPLES = "fraction missed by 10 samples"
BY_JOINT_1 = "gradient for joint 1, m/rad"
HALFWAY = "met halfway: missed by 10 samples, of 60"


@pytest.fixture(scope="module")
def printed():
    """Return what the lab prints."""
    return printed_by(lab, {BY_SAMPLES: "0.498", BY_JOINT_1: "-0.30702", HALFWAY: "60"})


@pytest.fixture(scope="module")
def whips():
    """Return the ways past a wire, by seed."""
    return [day11_mujoco.whips(lab.WHIPS, lab.THIN, seed) for seed in SEEDS]


def missed(radius, points, scale=1.0, seeds=SEEDS):
    """Return how many motions past a post samples miss, by seed; they may be scaled."""
    return [
        lab.missed_by_points(
            [shorter(e, scale) for e in day11_mujoco.whips(lab.WHIPS, radius, seed)],
            points,
        )
        for seed in seeds
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


NORM = "norm of the displacement times the largest radius"
CHECKS = {
    "the bound of 11.8": {},
    "the distance used as a step, s + D": {"check": by(lambda dq, reach: 1.0)},
    "the signs of the displacements kept": {"check": by(lambda dq, reach: dq @ reach)},
    "distances from the base, not from the joint": {
        "reach": np.append(0.0, np.cumsum(OFFSETS)[:-1]) + FAR
    },
    "radius of the joint's own link only": {"reach": FAR},
    NORM: {"check": by(lambda dq, reach: np.linalg.norm(dq) * reach.max())},
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
def test_the_opening_says_what_the_lab_prints_and_what_other_seeds_do(printed):
    by_20 = int(re.search(r" 20 samples miss (\d+) of 60", printed)[1])
    assert f"misses the wire in {by_20} of the 60 motions" in SENTENCES
    looks = re.search(r"the bound misses 0; distance queries: median (\d+)", printed)[1]
    assert f"a median of {looks} distance queries per motion" in SENTENCES
    assert f"misses a thin wire in {by_20} of 60 motions" in DAY.see
    assert f"median of {looks} distance queries" in DAY.see
    least = re.search(r"with damper: ([\d.]+) mm, ends 0.0 mm", printed)[1]
    assert "around the post at a distance of 10 mm" in SENTENCES
    assert round(float(least)) == 10


@pytest.mark.kit
def test_twelve_seeds_of_samples_and_of_the_bound():
    edges = [day11_mujoco.whips(lab.WHIPS, lab.THIN, seed) for seed in TWELVE]
    by_20 = [lab.missed_by_points(some, 20) for some in edges]
    assert f"it misses {min(by_20)} to {max(by_20)}" in SENTENCES
    free, looks = zip(*(walked(some) for some in edges), strict=True)
    assert sum(free) == 0
    most = max(max(some) for some in looks)
    assert (
        f"none of the {12 * lab.WHIPS} motions, and no motion needs more than"
        in SENTENCES
    )
    assert f"more than {most} queries" in SENTENCES


def test_the_arm_is_nine_capsules_the_last_a_pen():
    pen = shapes.PEN
    length = 1000 * np.subtract(pen.b, pen.a)[2]
    assert len(day11_mujoco.CAPSULES) == 9
    words = (
        f"a pen with a radius of {1000 * pen.radius:.0f} mm and a length of "
        f"{length:.0f} mm"
    )
    assert words in SENTENCES


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
        "s and t not clamped": "not-clamped",
        "s and t clamped independently": "clamped-apart",
        "only the endpoints are compared": "ends-only",
        "the two points swapped": "points-swapped",
    }.items():  # fmt: skip
        assert f"| {name} | {mm[slug].max():.0f} |" in SENTENCES
    ends = pairs.reshape(-1, 2, 2, 3)  # pair, segment, end
    to_ends = np.linalg.norm(right[:, :, None] - ends, axis=3).min(axis=2)
    inside = np.all(to_ends > 1e-9, axis=1)
    for slug in ("not-clamped", "clamped-apart"):
        assert mm[slug][inside].max() < 1e-9
    assert (
        f"points: {np.mean(mm['ends-only'] < 1e-6):.0%} of".replace("%", " %")
        in SENTENCES
    )
    assert np.array_equal(mm["ends-only"] > 1e-6, inside)
    assert mm["size-absolute"].max() < 1e-9
    small = 1000 * off("size-absolute", 0.004).max()
    assert f"cube of 4 mm the error is up to {small:.1f} mm" in SENTENCES


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
    assert f"{np.sum(truth > 0)} pairs are apart; {np.sum(truth < 0)} pairs" in printed


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
    rows = re.findall(r"\n +(\d+) +(0\.\d+) +(0\.\d+)", printed)
    assert len(rows) == len(lab.COUNTS)
    for k, guess, share in rows:
        assert float(guess) == pytest.approx(
            max(0, 1 - 14 * (int(k) + 1) / rho), abs=1e-3
        )
        assert float(share) == pytest.approx(float(guess), abs=0.05)
    thick = day11_mujoco.wires(lab.PLACES, 2 * lab.WIRE, lab.SEED)  # contact 18 mm
    share = lab.missed_by_points(thick, 10) / lab.PLACES
    assert share == pytest.approx(1 - 18 * 11 / rho, abs=0.05)
    sigma = np.sqrt(0.498 * 0.502 / lab.PLACES)
    assert f"$ = {sigma:.3f}" in SENTENCES
    others = [
        lab.missed_by_points(day11_mujoco.wires(lab.PLACES, lab.WIRE, seed), 10)
        / lab.PLACES
        for seed in TWELVE
    ]
    assert abs(np.mean(others) - 0.498) < 2 * sigma / np.sqrt(12)


@pytest.mark.kit
@pytest.mark.parametrize("row", TABLE, ids=lambda row: row[0])
def test_a_row_of_the_trap(row, whips):
    name, *numbers, looks = row
    numbers = [int(x) for x in numbers]
    if points := re.fullmatch(r"(\d+) samples", name):
        assert points[1] == looks
        assert [lab.missed_by_points(some, int(looks)) for some in whips] == numbers
        return
    found = [walked(some, **CHECKS[name]) for some in whips]
    assert [free for free, _ in found] == numbers
    assert np.median([n for _, some in found for n in some]) == int(looks)


def test_all_checks_of_the_trap_were_compared():
    assert len(TABLE) == 11
    assert {row[0] for row in TABLE} >= CHECKS.keys()


def against_the_norm(seed):
    """Return motions that the norm of the displacement misjudges most."""
    rng = np.random.default_rng(seed)
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
    return edges


@pytest.mark.kit
def test_the_norm_of_the_displacement_is_no_bound_and_chosen_motions_show_it():
    found = []
    for seed in TWELVE:
        edges = against_the_norm(seed)
        found.append(walked(edges, **CHECKS[NORM])[0])
        assert walked(edges)[0] == 0
    assert (
        f"Of 60 such motions it misses {found[0]}, and the bound misses none"
        in SENTENCES
    )
    assert min(found) > 0


def across(edge, s):
    """Return the pen's velocity at the wire across its own axis, m per motion."""
    start, end = day11_mujoco.pen(edge.q + s * edge.dq)
    along = end - start
    flat = np.append(edge.wire[0][:2], start[2])
    t = np.clip((flat - start) @ along / (along @ along), 0, 1)

    def at(s):
        start, end = day11_mujoco.pen(edge.q + s * edge.dq)
        return start + t * (end - start)

    v = (at(s + 1e-4) - at(s - 1e-4)) / 2e-4
    n = along / np.linalg.norm(along)
    return np.linalg.norm(v - (v @ n) * n)


def met(edge):
    """Return the s at which a motion meets its wire."""
    s = np.linspace(0, 1, 801)
    return s[np.argmin(day11_mujoco.far(edge, s))]


@pytest.mark.kit
def test_a_test_with_the_wire_always_halfway_is_blind(printed):
    assert "always met halfway: 3 samples miss 0, 10 samples 60" in printed
    slow, fast = np.inf, 0.0
    for seed in (lab.SEED, *SEEDS):
        middle = day11_mujoco.whips(lab.WHIPS, lab.THIN, seed, middle=True)
        assert [lab.missed_by_points(middle, k) for k in (3, 10)] == [0, 60]
        found = [across(edge, 0.5) for edge in middle]
        slow, fast = min(slow, *found), max(fast, *found)
    assert f"at a rate of {slow:.2f} to {fast:.1f} m per unit of $s$. A" in SENTENCES
    assert min(abs(k / 11 - 0.5) for k in range(12)) == pytest.approx(1 / 22)
    assert f"slowest motion this is {1000 * slow / 22:.0f} mm" in SENTENCES
    assert slow / 22 > 0.006  # the contact begins 6 mm before the wire


@pytest.mark.kit
def test_20_samples_are_enough_only_where_the_gap_is_shorter_than_the_contact():
    """The velocity across the pen decides, for each of the three changes alone."""
    edges = [day11_mujoco.whips(lab.WHIPS, 0.015, seed) for seed in TWELVE]
    V = np.array([[across(e, met(e)) for e in some] for some in edges])
    words = (
        f"at a rate of {V.min():.1f} to {V.max():.1f} m per unit of $s$; the median is "
    )
    assert f"{words}{np.median(V):.2f} m" in SENTENCES
    thick, thin, few, half = 21 * 0.070, 21 * 0.040, 11 * 0.070, 2 * 21 * 0.040
    for limit in (thick, thin, few, half):
        assert f"{limit:.2f} m" in SENTENCES
    assert V.max() < thick < half  # so none can be missed
    faster = [round(60 * np.mean(limit < V)) for limit in (thin, few)]
    assert f"and {faster[0]} of the 60 motions are faster" in SENTENCES
    assert f"and {faster[1]} of the 60 motions are faster" in SENTENCES
    expected = [np.maximum(0, 1 - limit / V).sum() / 12 for limit in (thin, few)]
    by_thin = missed(0.015, 20, seeds=TWELVE)
    by_few = missed(0.030, 10, seeds=TWELVE)
    means = np.mean(by_thin), np.mean(by_few)
    words = "misses {:.1f} of 60 motions in case 1 and {:.1f} of 60 motions in case 2"
    assert words.format(*means) in SENTENCES
    assert means == pytest.approx(expected, abs=1.1)
    assert missed(0.015, 20, scale=0.5, seeds=TWELVE) == [0] * 12
    assert missed(0.030, 20, seeds=TWELVE) == [0] * 12


@pytest.mark.kit
def test_a_query_uses_up_a_fraction_of_the_distance_that_twice_the_radii_halve():
    used = []
    for factor in (1, 2):
        part = []
        for edge in day11_mujoco.whips(lab.WHIPS, lab.THIN, lab.SEED):
            _, s = lab.walk(edge, factor * REACH)
            d = lab.pen_from(edge, np.array(s))
            part.append(1 - d[1:] / d[:-1])
        used.append(np.median(np.concatenate(part)))
    guide = (DAY.folder / DAY.guide).read_text("utf-8")
    words = f"covers {used[1]:.2f} of the remaining distance instead of {used[0]:.2f}"
    assert words in guide


def test_the_tip_is_the_farthest_point_on_the_panda_and_not_on_every_arm():
    to_tip = np.cumsum(OFFSETS[:-1][::-1])[::-1] + FAR[-1]
    assert np.allclose(np.append(to_tip, FAR[-1]), REACH)
    lengths, radii = np.array([1.0, 1, 0]), np.array([0.5, 3, 0.5])
    assert np.allclose(lab.distal_radii(lengths, radii), [4, 3, 0.5])
    assert "$\\rho_2$ is 3 and $\\rho_1$ is 4" in SENTENCES


def smallest(a0, a1, b0, b1):
    """Return the distance of two segments: the best of ends and of crossing lines."""

    def to(p, x, y):
        t = np.clip((p - x) @ (y - x) / ((y - x) @ (y - x)), 0, 1)
        return np.linalg.norm(p - x - t * (y - x))

    found = [to(a0, b0, b1), to(a1, b0, b1), to(b0, a0, a1), to(b1, a0, a1)]
    u, v, w = a1 - a0, b1 - b0, a0 - b0
    s, t = np.linalg.lstsq(np.stack([u, -v], axis=1), -w, rcond=None)[0]
    if 0 <= s <= 1 and 0 <= t <= 1:
        found.append(np.linalg.norm(w + s * u - t * v))
    return min(found)


def test_three_steps_find_the_minimum_and_two_do_not():
    """The strip's minimum has the t before clamping; step 3 is needed after that."""
    rng = np.random.default_rng(lab.SEED)
    worst = two_steps = 0.0
    for _ in range(2000):
        a0, a1, b0, b1 = rng.uniform(-0.5, 0.5, (4, 3))
        p, o = lab.closest_points_segments(a0, a1, b0, b1)
        truth = smallest(a0, a1, b0, b1)
        worst = max(worst, abs(np.linalg.norm(p - o) - truth))
        u, v, w = a1 - a0, b1 - b0, a0 - b0
        a, b, c, d, e = u @ u, u @ v, v @ v, u @ w, v @ w
        s = np.clip((b * e - c * d) / (a * c - b * b), 0, 1)
        t = np.clip((b * s + e) / c, 0, 1)
        two_steps = max(two_steps, np.linalg.norm(w + s * u - t * v) - truth)
        strip = (b * s + e) / c  # t may be any number
        other = rng.uniform(0, 1, 20)[:, None], rng.uniform(-3, 3, 20)[:, None]
        best = np.linalg.norm(w + s * u - strip * v)
        assert np.linalg.norm(w + other[0] * u - other[1] * v, axis=1).min() >= best
    assert worst < 1e-12
    assert two_steps > 0.1


def test_the_signed_distance_of_a_box_is_the_largest_of_planes_so_it_is_convex():
    rng = np.random.default_rng(lab.SEED)
    half = np.array([0.3, 0.5, 0.8])
    n = rng.normal(size=(20_000, 3))
    n = np.vstack([n / np.linalg.norm(n, axis=1)[:, None], np.eye(3), -np.eye(3)])
    across_it = 0
    for p, o in rng.uniform(-1.2, 1.2, (600, 2, 3)):
        d = lab.box_sdf(p, half)
        planes = n @ p - np.abs(n) @ half
        assert planes.max() <= d + 1e-12
        assert planes.max() == pytest.approx(d, abs=0.01)
        other = lab.box_sdf(o, half)
        middle = lab.box_sdf((p + o) / 2, half)
        assert middle <= (d + other) / 2 + 1e-12
        across_it += d * other < 0
    assert across_it > 50


def test_where_many_pairs_are_closest_the_distance_has_a_kink():
    J = np.zeros((6, 7))
    J[2, 0] = 1.0  # a joint about z at the origin
    arm_axis = np.array([(0.5, 0, 0), (1.0, 0, 0)])
    post = np.array([(0.4, 0.3, 0), (1.1, 0.3, 0)])

    def far(angle):
        R = se3.Rz(angle)
        p, o = lab.closest_points_segments(*(arm_axis @ R.T), *post)
        return np.linalg.norm(p - o)

    ahead = (far(1e-6) - far(0)) / 1e-6
    back = (far(0) - far(-1e-6)) / 1e-6
    assert (ahead, back) == (pytest.approx(-1), pytest.approx(-0.5))
    p, o = lab.closest_points_segments(*arm_axis, *post)
    assert lab.distance_gradient(J, p, o, 1)[0] == pytest.approx(back)


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

    return {
        "no filter": lambda qd, *_: qd,
        "the velocity damper": distance.velocity_damper,
        "correction applied even to a permitted velocity": always,
        "not divided by the squared norm": not_divided,
        "sign of the correction reversed": nearer,
        "all joints scaled by one factor": alike,
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

    damper = distance.velocity_damper
    one, _ = lab.through(post(lab.POST[0][0] - 0.05), damper)
    four, _ = lab.through(post(lab.POST[0][0] - 0.05), damper, 4)
    assert f"the smallest distance is {one:.1f} mm. The gradient describes" in SENTENCES
    assert f"in several passes, the smallest distance is {four:.1f} mm" in SENTENCES
    with patch.object(lab, "WAIT", 40.0):
        safe, off = lab.through(post(lab.POST[0][0] - 0.08), damper, 4)
    assert f"smallest distance is {safe:.1f} mm, but the arm does not" in SENTENCES
    assert f"After 40 s the pen is still {off:.0f} mm away" in SENTENCES


@pytest.mark.kit
def test_one_factor_for_all_joints_stands_still_and_two_pairs_keep_the_margin():
    alike = near_relatives()["all joints scaled by one factor"]
    ends = []
    for wait in (lab.WAIT, 20.0):
        with patch.object(lab, "WAIT", wait):
            ends.append(lab.through(lab.POST, alike)[1])
    assert ends[1] == pytest.approx(ends[0], abs=0.1)
    thick = (*lab.POST[:2], 2 * lab.POST[2])
    two, _ = lab.through(thick, distance.velocity_damper, 2)
    guide = (DAY.folder / DAY.guide).read_text("utf-8")
    assert f"with two pairs it is {two:.1f} mm" in guide


@pytest.mark.kit
def test_a_larger_gain_passes_the_margin_since_a_step_is_not_continuous_time():
    def least(gain, dt=lab.DT):
        with patch.multiple(lab, GAIN=gain, DT=dt):
            return lab.through(lab.POST, distance.velocity_damper)[0]

    row = [least(gain) for gain in (4.0, 8.0, 20.0, 50.0, 100.0)]
    assert "10 ms | " + " | ".join(f"{x:.1f}" for x in row) + " |" in SENTENCES
    assert [x > 1000 * lab.MARGIN for x in row] == [True, *[False] * 4]
    assert row[1] > 9.5 > row[2]  # the lab's limit
    fine = least(50.0, 0.001)  # the cause alone
    assert f"smallest distance for a gain of 50/s is {fine:.2f} mm" in SENTENCES
    assert fine > 9.95
