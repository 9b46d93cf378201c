"""Day 11: not touching. A distance, its slope, and how far one may go without a look.

    make day11                      in the clone: sets all up, then runs this
    python src/day11_distance.py    in w2-autonomy/, once that is done

A capsule is a segment from a0 to a1, its axis, and a radius; a ball has a0 = a1. A
distance below 0 is an overlap. World axes, twists (omega; v). Metres, radians.
"""

from collections.abc import Callable

import kit  # noqa: F401 (goes on in the kit's own Python)
import mujoco
import numpy as np

from robo47 import cli, panda, shapes
from robo47 import distance as library
from robo47.jacobian import dls_step, site_jacobian, space_jacobian
from robo47.lesson.lab import Lab

import day11_mujoco

SEED = 11  # of poses, of ways and of the wires they cross
TRIALS = 30  # poses that the arm is measured in
FAR = 10.0  # m, up to which MuJoCo measures
STEP = 1e-3  # rad, of differences
ASIDE = 0.2  # m, to the left of the pen's end: something to keep away from
COUNTS = (5, 10, 20)  # points on the way of the pen
MANY = (3, 10, 20, 40, 80)  # points on the way of the whip
PLACES = 200  # at which a wire crosses the pen's way
WIRE = 0.002  # m: its radius; the pen's is 5 mm
THIN = 0.001  # m: that of the wire the whip meets
WHIPS = 60  # ways past it
NEAR = 0.0005  # m: so near counts as a touch
BESIDE = 0.004  # m that the whip passes a wire at, or more
LOOKS = 400  # at most, on a way

# The side quest: the pen is told to go from y = -HALF to HALF, along x = AT, a post
# stands in the hand's way.
POST = ((0.5, 0.0, 0.0), (0.5, 0.0, 0.9), 0.04)  # ends and radius, m
AT = (0.45, 0.4)  # m, x and z of the way
HALF = 0.3  # m
TIME = 3.0  # s that it is told to take
WAIT = 2.0  # s more, to arrive
DT = 0.01  # s
GAIN = 4.0  # 1/s
MARGIN = 0.01  # m that are to be left
PULL = 4.0  # 1/s: how fast the pen is pulled back to its way
DAMPING = 0.05
SWEEPS = 8  # rounds over several pairs
RUSH = 1.0  # m/s, straight at something


def closest_points_segments(
    a0: np.ndarray, a1: np.ndarray, b0: np.ndarray, b1: np.ndarray
) -> np.ndarray:
    """Return the closest points of two segments, (2, 3): the first's, the second's.

    Ends are (3,) each; a0 = a1 is a point. Of parallel ones any closest pair will do.
    (-1, 0, 0) to (1, 0, 0) and (0, -1, 1) to (0, 1, 1): (0, 0, 0) and (0, 0, 1).
    """
    # region 11.1
    u = a1 - a0
    v = b1 - b0
    w = a0 - b0
    a = u @ u
    b = u @ v
    c = v @ v
    d = u @ w
    e = v @ w
    across = a * c - b * b  # a c sin^2: compared with a c, never with a number
    s = np.clip((b * e - c * d) / across, 0, 1) if across > 1e-12 * a * c else 0.0
    t = np.clip((b * s + e) / c, 0, 1) if c > 0 else 0.0
    s = np.clip((b * t - d) / a, 0, 1) if a > 0 else 0.0
    return np.array([a0 + s * u, b0 + t * v])
    # endregion 11.1


def capsule_distance(
    a0: np.ndarray, a1: np.ndarray, ra: float,
    b0: np.ndarray, b1: np.ndarray, rb: float,
) -> float:  # fmt: skip
    """Return how far two capsules are apart, below 0 where they overlap.

    capsule_distance((-1, 0, 0), (1, 0, 0), 0.25, (0, -1, 1), (0, 1, 1), 0.5) -> 0.25
    """
    # region 11.2
    p, o = closest_points_segments(a0, a1, b0, b1)
    return np.linalg.norm(p - o) - ra - rb
    # endregion 11.2


def box_sdf(p: np.ndarray, half_extents: np.ndarray) -> float:
    """Return how far a point, (3,), is from a box about the origin; inside below 0.

    half_extents, (3,), is half of its sides; the middle of this box is 1 deep.
    box_sdf((2, 0, 0), (1, 1, 1)) -> 1
    """
    # region 11.3
    beyond = np.abs(p) - half_extents
    return np.linalg.norm(np.maximum(beyond, 0)) + min(beyond.max(), 0.0)
    # endregion 11.3


def capsule_box_distance(
    a0: np.ndarray,
    a1: np.ndarray,
    r: float,
    T_world_box: np.ndarray,
    half_extents: np.ndarray,
) -> float:
    """Return how far a capsule is from a box, wherever that stands.

    The least of `box_sdf` along the axis, less r. From (-2, 0, 2) to (2, 0, 2), with
    r = 0.1, and a box at the origin, half 1, 1, 1: 0.9.
    """
    # region 11.4
    R = T_world_box[:3, :3]
    start = R.T @ (a0 - T_world_box[:3, 3])
    way = R.T @ (a1 - a0)
    low = 0.0
    high = 1.0
    for _ in range(60):  # of one valley, the part that has its bottom
        left = high - 0.618 * (high - low)
        right = low + 0.618 * (high - low)
        if box_sdf(start + left * way, half_extents) < box_sdf(
            start + right * way, half_extents
        ):
            high = right
        else:
            low = left
    return min(box_sdf(start + s * way, half_extents) for s in (low, high)) - r
    # endregion 11.4


def distance_gradient(
    J_space: np.ndarray, p: np.ndarray, o: np.ndarray, link: int
) -> np.ndarray:
    """Return how fast |p - o| grows per joint speed, (7,): p on link 1 to 7, o at rest.

    J_space, (6, 7), is Day 3's, (omega; v). A joint at the origin about z, p at
    (1, 0, 0), o at (1, 1, 0): -1 for it, since p moves towards o.
    """
    # region 11.5
    n = (p - o) / np.linalg.norm(p - o)
    slope = np.zeros(J_space.shape[1])
    for i in range(link):
        slope[i] = n @ (J_space[3:, i] + np.cross(J_space[:3, i], p))
    return slope
    # endregion 11.5


def capsule_aabb(a0: np.ndarray, a1: np.ndarray, r: float) -> np.ndarray:
    """Return the box along the axes around a capsule, (2, 3): least, greatest corner.

    capsule_aabb((0, 1, 0), (1, 0, 0), 0.5) -> ((-0.5, -0.5, -0.5), (1.5, 1.5, 0.5))
    """
    # region 11.6
    return np.array([np.minimum(a0, a1) - r, np.maximum(a0, a1) + r])
    # endregion 11.6


def aabb_overlap(box_a: np.ndarray, box_b: np.ndarray) -> bool:
    """Return whether two boxes of `capsule_aabb`, (2, 3), overlap; touching counts.

    Those of (0, 0, 0) to (1, 1, 1) and (1, 0, 0) to (2, 1, 1) do.
    """
    # region 11.6
    return bool(np.all(box_a[0] <= box_b[1]) and np.all(box_b[0] <= box_a[1]))
    # endregion 11.6


def distal_radii(link_lengths: np.ndarray, link_radii: np.ndarray) -> np.ndarray:
    """Return how far from each joint anything behind it can ever be, (n,).

    link_lengths[i], (n,), is from link i's origin to the next one's, link_radii[i],
    (n,), to the farthest point of link i's own capsules; the last link has no next: its
    length does not count. distal_radii((1, 1, 0), (0.5, 0.5, 0.5)) -> (2.5, 1.5, 0.5)
    """
    # region 11.7
    reach = np.array(link_radii)
    for i in range(len(link_radii) - 2, -1, -1):
        reach[i] = max(link_radii[i], link_lengths[i] + reach[i + 1])
    return reach
    # endregion 11.7


def conservative_advance(
    s: float, distance: float, delta_q: np.ndarray, radii: np.ndarray
) -> float:
    """Return where along q + s delta_q the arm may first touch something, at most 1.

    The distance is the arm's at s; delta_q, (7,), the whole way; radii, (7,), of
    `distal_radii`. Where the distance is 0 or below: s. Else, where nothing moves: 1.
    At s = 0.25 and 0.1 m, for delta_q 1 and radii 0.5 everywhere: 0.278571.
    """
    # region 11.8
    if distance <= 0:
        return s
    speed = np.abs(delta_q) @ radii  # m that any point moves at most, on the whole way
    return min(1.0, s + distance / speed) if speed > 0 else 1.0
    # endregion 11.8


def velocity_damper(
    qd: np.ndarray, grad: np.ndarray, distance: float, gain: float
) -> np.ndarray:
    """Return the joint speeds nearest to qd with grad . qd >= -gain distance, (7,).

    qd (-1, 0, ..), grad (1, 0, ..), distance 0.1, gain 4: (-0.4, 0, ..). A grad of 0
    changes nothing.
    """
    # region 11.9
    lack = -gain * distance - grad @ qd
    square = grad @ grad
    return qd + grad * lack / square if lack > 0 and square > 0 else np.array(qd)
    # endregion 11.9


def off_library(name: str, own: Callable, given: list[tuple]) -> float:
    """Return how far your function is at most from robo47's of that name."""
    truth = getattr(library, name)
    off = [np.subtract(own(*one), truth(*one), dtype=float) for one in given]
    return float(np.max([np.abs(one).max() for one in off]))  # NaN, if one is NaN


def given_to(rng: np.random.Generator) -> dict[str, list[tuple]]:
    """Return what some functions are asked, by name: MuJoCo has none of them."""
    ends = rng.uniform(-1, 1, (40, 2, 3))
    boxes = [library.capsule_aabb(*some, 0.2) for some in ends]
    lengths = [rng.uniform(0, 1, (2, 7)) for _ in range(5)]
    long = np.array([0.1, 0.1, 2.0, 0.1, 0.1, 0.1, 0.3])  # in the middle, not the tip
    speeds = rng.uniform(-1, 1, (10, 2, 7))
    still = np.zeros(7)
    half = np.full(7, 0.5)
    touching = np.array([(0.0, 0, 0), (1, 1, 1)])
    return {
        "capsule_aabb": [(*some, 0.2) for some in ends],
        "aabb_overlap": [*zip(boxes[::2], boxes[1::2], strict=True),
                     (touching, touching + np.eye(3)[1]),
                     (touching + np.eye(3)[2], touching)],
        "distal_radii": [*lengths, (np.full(7, 0.2), long)],
        "conservative_advance": [(0.1, 0.3, dq, np.abs(r)) for dq, r in speeds]
        + [(0.9, 1.0, half, half), (0.2, -0.1, half, half), (0.2, 0.1, still, half)],
        "velocity_damper": [(qd, g, 0.05, 4.0) for qd, g in speeds]
        + [(qd, g, -0.05, 4.0) for qd, g in speeds] + [(half, still, -0.1, 4.0)],
    }  # fmt: skip


def off_capsules(model, data, q: np.ndarray) -> tuple[list, list, int]:
    """Return how far distances and points are off MuJoCo's, and how many overlap.

    Of the arm's nine capsules from five rods, at all q, (n, 7).
    """
    apart, points, inside = [], [], 0
    fromto = np.zeros(6)  # MuJoCo's closest points, on both surfaces
    for one in q:
        data.qpos[:] = one
        mujoco.mj_kinematics(model, data)  # fills geom_xpos and geom_xmat
        for i, (a0, a1) in enumerate(day11_mujoco.axes(model, data)):
            ra = day11_mujoco.RADII[i]
            for j, (b0, b1, rb) in enumerate(day11_mujoco.RODS):
                pair = model.geom(f"arm{i}").id, model.geom(f"world{j}").id
                truth = mujoco.mj_geomDistance(model, data, *pair, FAR, fromto)
                rod = np.array(b0), np.array(b1)
                apart.append(capsule_distance(a0, a1, ra, *rod, rb) - truth)
                p, o = closest_points_segments(a0, a1, *rod)
                n = (o - p) / np.linalg.norm(o - p)
                points.append(np.append(p + ra * n, o - rb * n) - fromto)
                inside += truth < 0
    return apart, points, inside


def off_boxes(model, data, q: np.ndarray, rng) -> tuple[list, list, list]:
    """Return how far a ball and the arm are off MuJoCo's distance from two boxes.

    The ball is asked inside the boxes, too; the arm only where it is outside: MuJoCo's
    depth is the way out of the whole capsule. There, last, it is robo47's.
    """
    ball, arm, inside = [], [], []
    fromto = np.zeros(6)
    for one in q:
        data.qpos[:] = one
        for j, (T, half) in enumerate(day11_mujoco.BOXES, len(day11_mujoco.RODS)):
            box = model.geom(f"world{j}").id
            half = np.array(half)
            p = half * rng.uniform(-2, 2, 3)
            data.mocap_pos[0] = T[:3, :3] @ p + T[:3, 3]
            mujoco.mj_kinematics(model, data)  # fills geom_xpos and geom_xmat
            small = model.geom("ball")
            truth = mujoco.mj_geomDistance(model, data, small.id, box, FAR, fromto)
            ball.append(box_sdf(p, half) - small.size[0] - truth)
            for i, (a0, a1) in enumerate(day11_mujoco.axes(model, data)):
                geom = model.geom(f"arm{i}").id
                asked = a0, a1, day11_mujoco.RADII[i], T, half
                truth = mujoco.mj_geomDistance(model, data, geom, box, FAR, fromto)
                if truth > 0:
                    arm.append(capsule_box_distance(*asked) - truth)
                else:
                    inside.append(
                        capsule_box_distance(*asked)
                        - library.capsule_box_distance(*asked)
                    )
    return ball, arm, inside


def slopes(model, data, q: np.ndarray, pair: tuple[int, int]) -> np.ndarray:
    """Return MuJoCo's distance of two geoms by differences, per joint angle, (7,)."""

    def apart(way: np.ndarray) -> float:
        data.qpos[:] = q + way
        mujoco.mj_kinematics(model, data)  # fills geom_xpos and geom_xmat
        return mujoco.mj_geomDistance(model, data, *pair, FAR, np.zeros(6))

    rows = STEP * np.eye(7)
    once, twice = (
        np.array([apart(k * h) - apart(-k * h) for h in rows]) / (2 * k * STEP)
        for k in (1, 2)
    )
    return (4 * once - twice) / 3  # Richardson: the error's h^2 drops out


def off_slopes(model, data, q: np.ndarray) -> list[np.ndarray]:
    """Return how far your slopes are from those of MuJoCo's distances, (7,) each."""
    screws = panda.screws(model)
    b0, b1, _ = (np.array(x) for x in day11_mujoco.RODS[0])
    off = []
    for one in q:
        data.qpos[:] = one
        mujoco.mj_kinematics(model, data)
        J = space_jacobian(screws, one)
        for i, (a0, a1) in enumerate(day11_mujoco.axes(model, data)):
            p, o = closest_points_segments(a0, a1, b0, b1)
            slope = distance_gradient(J, p, o, day11_mujoco.LINK[i])
            pair = model.geom(f"arm{i}").id, model.geom("world0").id
            off.append(slope - slopes(model, data, one, pair))
    return off


def cheap_no(model, data, q: np.ndarray) -> tuple[int, int, int, int]:
    """Return of how many pairs boxes say no, how many touch, and how many of both."""
    pairs = no = touch = both = 0
    for one in q:
        data.qpos[:] = one
        mujoco.mj_kinematics(model, data)  # fills geom_xpos and geom_xmat
        for i, (a0, a1) in enumerate(day11_mujoco.axes(model, data)):
            own = capsule_aabb(a0, a1, day11_mujoco.RADII[i])
            for j, (b0, b1, r) in enumerate(day11_mujoco.RODS):
                pair = model.geom(f"arm{i}").id, model.geom(f"world{j}").id
                d = mujoco.mj_geomDistance(model, data, *pair, FAR, np.zeros(6))
                apart = not aabb_overlap(
                    own, capsule_aabb(np.array(b0), np.array(b1), r)
                )
                pairs += 1
                no += apart
                touch += d <= 0
                both += apart and d <= 0
    return pairs, no, touch, both


def pen_from(edge: day11_mujoco.Edge, s: float | np.ndarray) -> np.ndarray:
    """Return the pen's distance from an edge's wire at s, m, as many as s has."""
    ends = day11_mujoco.pen(edge.q + np.multiply.outer(s, edge.dq))
    a, b, r = edge.wire
    far = [capsule_distance(*some, shapes.PEN.radius, a, b, r)
           for some in ends.reshape(-1, 2, 3)]  # fmt: skip
    return np.reshape(far, np.shape(s))


def missed_by_points(edges: list[day11_mujoco.Edge], k: int) -> int:
    """Return how many edges k inner points find free, and their ends, of course."""
    s = np.linspace(0, 1, k + 2)
    return sum(bool(pen_from(edge, s).min() > 0) for edge in edges)


def walk(edge: day11_mujoco.Edge, reach: np.ndarray) -> tuple[bool, list[float]]:
    """Return whether a way is found free, and where it was looked at."""
    looked = [0.0]
    while len(looked) < LOOKS:
        d = float(pen_from(edge, looked[-1]))
        if d <= NEAR:
            return False, looked
        if looked[-1] >= 1:
            return True, looked
        looked.append(conservative_advance(looked[-1], d, edge.dq, reach))
    return False, looked


def promises(edges: list[day11_mujoco.Edge], reach: np.ndarray) -> tuple[int, list]:
    """Return how many ways your bound finds free, and how many looks each took."""
    walked = [walk(edge, reach) for edge in edges]
    return sum(free for free, _ in walked), [len(looked) for _, looked in walked]


def farthest(model, data, q: np.ndarray) -> np.ndarray:
    """Return how far behind each joint MuJoCo has a point of a capsule, m, (7,)."""
    most = np.zeros(7)
    for one in q:
        data.qpos[:] = one
        mujoco.mj_kinematics(model, data)  # fills xpos, geom_xpos and geom_xmat
        for link, r, ends in zip(
            day11_mujoco.LINK, day11_mujoco.RADII, day11_mujoco.axes(model, data),
            strict=True,
        ):  # fmt: skip
            for i in range(link):
                origin = data.body(f"link{i + 1}").xpos
                far = np.linalg.norm(ends - origin, axis=1).max() + r
                most[i] = max(most[i], far)
    return most


def slopes_of(
    J: np.ndarray, ends: np.ndarray, post: tuple, pairs: int
) -> list[tuple[np.ndarray, float, int]]:
    """Return slope, distance (m) and capsule of the pairs nearest to a post."""
    b0, b1, r = np.array(post[0]), np.array(post[1]), post[2]
    far = [capsule_distance(*some, ra, b0, b1, r)
           for some, ra in zip(ends, day11_mujoco.RADII, strict=True)]  # fmt: skip
    found = []
    for k in np.argsort(far)[:pairs]:
        p, o = closest_points_segments(*ends[k], b0, b1)
        found.append((distance_gradient(J, p, o, day11_mujoco.LINK[k]), far[k], int(k)))
    return found


def through(post: tuple, slow: Callable, pairs: int = 1) -> tuple[float, float]:
    """Drive the pen along its way, qd as `slow` lets it for the pairs that are nearest.

    Return the least distance on the way, by MuJoCo, and how far from its target the pen
    ends, both in mm.
    """
    model, data = day11_mujoco.around(post)
    screws = panda.screws(model)
    start, end = (np.array([AT[0], y, AT[1]]) for y in (-HALF, HALF))
    q = day11_mujoco.pen_at(start)
    least = FAR
    for i in range(round((TIME + WAIT) / DT)):
        data.qpos[:] = q
        mujoco.mj_kinematics(model, data)  # fills geom_xpos and geom_xmat
        ends = day11_mujoco.axes(model, data)
        J = space_jacobian(screws, q)
        near = slopes_of(J, ends, post, pairs)
        pair = model.geom(f"arm{near[0][2]}").id, model.geom("world0").id
        least = min(least, mujoco.mj_geomDistance(model, data, *pair, FAR, np.zeros(6)))
        tip = ends[-1, 1]
        share = min(i * DT / TIME, 1.0)
        v = (end - start) / TIME * (share < 1)
        v = v + PULL * (start + share * (end - start) - tip)
        qd = dls_step(site_jacobian(J, tip)[3:], v, DAMPING)
        for slope, d, _ in near * (SWEEPS if pairs > 1 else 1):
            qd = slow(qd, slope, d - MARGIN, GAIN)
        q = q + DT * qd
    return 1000 * least, 1000 * float(np.linalg.norm(tip - end))


def left_of_it(slow: Callable, gain: float = GAIN, dt: float = DT) -> float:
    """Return which share of ASIDE is left after 1 s straight at it, at RUSH."""
    screws = panda.screws(panda.load("panda_nohand"))
    q = panda.READY_Q.copy()
    goal = day11_mujoco.pen(q)[1] + ASIDE * np.eye(3)[1]
    for _ in range(round(1.0 / dt)):
        J = space_jacobian(screws, q)
        tip = day11_mujoco.pen(q)[1]
        far = np.linalg.norm(goal - tip)
        qd = dls_step(site_jacobian(J, tip)[3:], RUSH * (goal - tip) / far, DAMPING)
        q = q + dt * slow(qd, distance_gradient(J, tip, goal, 7), far, gain)
    return float(np.linalg.norm(goal - day11_mujoco.pen(q)[1])) / ASIDE


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    rng = np.random.default_rng(SEED)
    model, data = day11_mujoco.scene()
    q = day11_mujoco.poses(TRIALS, SEED)
    arm = shapes.Shape(model, day11_mujoco.CAPSULES)
    given = given_to(rng)
    print(panda.describe("panda_nohand"))

    lab.step("1. Two capsules")
    apart, points, deep = off_capsules(model, data, q)
    print(f"  {len(apart)} pairs of the arm's capsules and rods; {deep} overlap")
    lab.record("distance", apart, label="|capsule_distance - mj_geomDistance|, m",
               seed=SEED)  # fmt: skip
    lab.check("|closest points - MuJoCo's|, m", points)

    lab.step("2. A capsule and a box")
    ball, sides, inside = off_boxes(model, data, q, rng)
    lab.check("|box_sdf - MuJoCo's ball|, m, inside too", ball)
    lab.check("|capsule_box_distance - mj_geomDistance|, m, outside", sides)
    print(
        f"  {len(sides)} pairs; {len(inside)} overlap, where MuJoCo's depth is another"
    )
    lab.check("capsule_box_distance - the library's, inside", inside)

    lab.step("3. How fast it changes")
    off = off_slopes(model, data, q[: TRIALS // 5 + 1])
    lab.record("gradient", off, label="|slope - that of mj_geomDistance|, m/rad",
               seed=SEED)  # fmt: skip
    tip = day11_mujoco.pen(panda.READY_Q)[1]
    J = space_jacobian(panda.screws(model), panda.READY_Q)
    slope = distance_gradient(J, tip, tip + ASIDE * np.eye(3)[1], 7)
    lab.show(f"slope from something {1000 * ASIDE:.0f} mm left of the pen at READY",
             slope, 5)  # fmt: skip
    lab.measured("slope of joint 1, m/rad", slope[0])

    lab.step("4. The cheap no")
    pairs, no, touch, both = cheap_no(model, data, q)
    print(f"  of {pairs} pairs boxes exclude {no}; {touch} touch")
    lab.check("pairs that touch and are excluded", both)
    for name, own in {
        "capsule_aabb": capsule_aabb,
        "aabb_overlap": aabb_overlap,
    }.items():
        lab.check(f"{name} - the library's", off_library(name, own, given[name]))

    lab.step("5. How many points?")
    wires = day11_mujoco.wires(PLACES, WIRE, SEED)
    way = np.linalg.norm(day11_mujoco.pen(panda.READY_Q)[1, :2])  # m, of 1 rad
    contact = 2 * (shapes.PEN.radius + WIRE)
    print("  inner points  predicted  missed")
    for k in COUNTS:
        guess = max(0.0, 1 - contact * (k + 1) / way)
        share = missed_by_points(wires, k) / PLACES
        print(f"  {k:12}{guess:11.3f}{share:8.3f}")
        if k == COUNTS[1]:
            lab.measured("missed by 10 points, share", share)

    lab.step("6. A promise in place of points")
    reach = distal_radii(*arm.lengths)
    lab.show("reach, m", reach, 3)
    seen = farthest(model, data, q)
    lab.show("largest seen by MuJoCo, of it", seen / reach, 2)
    lab.check("seen beyond the reach, m", np.maximum(seen - reach, 0))
    for name, own in {
        "distal_radii": distal_radii,
        "conservative_advance": conservative_advance,
    }.items():
        lab.check(f"{name} - the library's", off_library(name, own, given[name]))
    edges = day11_mujoco.whips(WHIPS, THIN, SEED)
    for k in MANY:
        print(f"  {k:3} points miss {missed_by_points(edges, k):2} of {WHIPS}")
    missed, looks = promises(edges, reach)
    print(f"  the bound misses {missed}; looks: {np.median(looks):.0f}, "
          f"at most {max(looks)}")  # fmt: skip
    lab.record("edges", missed, metric="missed", label="edges missed", seed=SEED)
    passed = day11_mujoco.whips(WHIPS // 3, THIN, SEED, beside=BESIDE)
    free, _ = promises(passed, reach)
    lab.check("ways past the wire that are refused", len(passed) - free, 0.5)
    halfway = day11_mujoco.whips(WHIPS, THIN, SEED, middle=True)
    by_3, by_10 = (missed_by_points(halfway, k) for k in (3, 10))
    print(f"  a wire that is always met halfway: 3 points miss {by_3}, 10 miss {by_10}")
    lab.measured("met halfway: missed by 10 points, of 60", by_10)

    lab.step("7. Side quest: told to go through a post")
    with lab.side_quest():
        lab.check(
            "velocity_damper - the library's",
            off_library("velocity_damper", velocity_damper, given["velocity_damper"]),
        )
        share = left_of_it(velocity_damper)
        print(f"  straight at it: after 1 s {share:.4f} of the distance is left")
        least, beside = through(POST, lambda qd, *_: qd)
        print(f"  as told: {least:.1f} mm, ends {beside:.1f} mm beside its target")
        least, beside = through(POST, velocity_damper)
        print(f"  slowed: {least:.1f} mm, ends {beside:.1f} mm beside its target")
        lab.record("post", least, metric="least_mm", label="least distance, mm")
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
