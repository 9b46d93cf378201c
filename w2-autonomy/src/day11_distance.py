"""Day 11: distance and collision. Distances, their gradient, conservative advancement.

    make day11                      in the clone: sets all up, then runs this
    python src/day11_distance.py    in w2-autonomy/, once that is done

A capsule is a segment from a0 to a1, its axis, with a radius; a sphere has a0 = a1. A
distance is signed: it is negative where two shapes overlap. Points, normals and twists
(omega; v) are expressed in the world frame. Metres, radians.
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

SEED = 11  # for configurations, motions and wires; the same at every run
TRIALS = 30  # configurations in which the distances are compared
FAR = 10.0  # m, the largest distance that MuJoCo reports
STEP = 1e-3  # rad, the step of the finite differences
ASIDE = 0.2  # m, from the pen's end to an obstacle on its left
COUNTS = (5, 10, 20)  # inner samples of the pen's motion about joint 1
MANY = (3, 10, 20, 40, 80)  # inner samples of the fast motions
PLACES = 200  # positions of the wire on the pen's motion
WIRE = 0.002  # m, the radius of that wire; the pen's is 5 mm
THIN = 0.001  # m, the radius of the wire that the fast motions meet
WHIPS = 60  # fast motions
NEAR = 0.0005  # m, a distance that is treated as contact
BESIDE = 0.004  # m, the smallest distance of a motion that passes the wire
LOOKS = 400  # distance queries per motion, at most

# The side quest: the pen is commanded from y = -HALF to HALF along a straight line, and
# a post is in the way of the hand.
POST = ((0.5, 0.0, 0.0), (0.5, 0.0, 0.9), 0.04)  # ends and radius, m
AT = (0.45, 0.4)  # m, x and z of the line
HALF = 0.3  # m
TIME = 3.0  # s, the commanded duration
WAIT = 2.0  # s, the time after it to arrive
DT = 0.01  # s, the time step
GAIN = 4.0  # 1/s, of the velocity damper
MARGIN = 0.01  # m, the distance that the damper keeps
PULL = 4.0  # 1/s, the feedback gain of the pen's position
DAMPING = 0.05  # of the damped least-squares step
SWEEPS = 8  # passes over several pairs
RUSH = 1.0  # m/s, straight at an obstacle


def closest_points_segments(
    a0: np.ndarray, a1: np.ndarray, b0: np.ndarray, b1: np.ndarray
) -> np.ndarray:
    """Return the closest points of two segments, (2, 3): the first's, the second's.

    The segments are a0 to a1 and b0 to b1, four points (3,) in metres; a segment with
    a0 = a1 is a point. For parallel segments return any closest pair. Compare a c - b b
    with a c, because it scales with the fourth power of the length. Source: Ericson,
    Real-Time Collision Detection.
    (-1, 0, 0) to (1, 0, 0) and (0, -1, 1) to (0, 1, 1): (0, 0, 0) and (0, 0, 1).
    """
    # region 11.1
    u = a1 - a0  # direction of the first segment
    v = b1 - b0  # direction of the second segment
    w = a0 - b0  # the vector from the second start point to the first
    a = u @ u  # squared length of the first segment
    b = u @ v  # coupling of s and t
    c = v @ v  # squared length of the second segment
    d = u @ w  # half of the linear coefficient of s
    e = v @ w  # half of the negated linear coefficient of t
    across = a * c - b * b  # determinant of the equations for s and t
    s = (  # the minimiser over both lines, clamped to the first segment
        np.clip((b * e - c * d) / across, 0, 1) if across > 1e-12 * a * c else 0.0
    )
    t = np.clip((b * s + e) / c, 0, 1) if c > 0 else 0.0  # the best t for a fixed s
    s = np.clip((b * t - d) / a, 0, 1) if a > 0 else 0.0  # the best s for a fixed t
    return np.array([a0 + s * u, b0 + t * v])  # the closest points
    # endregion 11.1


def capsule_distance(
    a0: np.ndarray, a1: np.ndarray, ra: float,
    b0: np.ndarray, b1: np.ndarray, rb: float,
) -> float:  # fmt: skip
    """Return the signed distance of two capsules in metres, negative if they overlap.

    a0, a1 and b0, b1 are the endpoints of the axes, (3,), in m; ra and rb are the radii
    in metres. The signed distance is the distance of the axes minus both radii.
    capsule_distance((-1, 0, 0), (1, 0, 0), 0.25, (0, -1, 1), (0, 1, 1), 0.5) -> 0.25
    """
    # region 11.2
    p, o = closest_points_segments(a0, a1, b0, b1)  # closest points of the axes
    return np.linalg.norm(p - o) - ra - rb  # the distance between the surfaces
    # endregion 11.2


def box_sdf(p: np.ndarray, half_extents: np.ndarray) -> float:
    """Return the signed distance of a point from a box, metres, negative inside.

    p (3,) is expressed in the box frame, whose origin is the centre of the box and
    whose axes are parallel to its edges; half_extents (3,) is half of each side.
    Outside, the result is the distance to the box; inside, it is minus the distance to
    the nearest face, so the centre of this box gives -1. Source: Quilez, "Distance
    functions".
    box_sdf((2, 0, 0), (1, 1, 1)) -> 1
    """
    # region 11.3
    beyond = np.abs(p) - half_extents  # distance beyond each pair of faces
    return (  # the distance outside, or minus the depth inside
        np.linalg.norm(np.maximum(beyond, 0)) + min(beyond.max(), 0.0)
    )
    # endregion 11.3


def capsule_box_distance(
    a0: np.ndarray,
    a1: np.ndarray,
    r: float,
    T_world_box: np.ndarray,
    half_extents: np.ndarray,
) -> float:
    """Return the signed distance of a capsule and a box in any pose, metres.

    a0 and a1 (3,) are the axis endpoints in the world frame, r is the radius,
    T_world_box (4, 4) the pose of the box and half_extents (3,) half of its sides, all
    in metres. The result is the minimum of `box_sdf` along the axis, minus r. That
    function is convex along the axis, so golden-section search finds its minimum.
    From (-2, 0, 2) to (2, 0, 2), with r = 0.1, and a box at the origin, half_extents
    1, 1, 1: 0.9.
    """
    # region 11.4
    R = T_world_box[:3, :3]  # rotation of the box
    start = R.T @ (a0 - T_world_box[:3, 3])  # start point in the box frame
    way = R.T @ (a1 - a0)  # direction of the axis in the box frame
    low = 0.0  # lower endpoint of the interval that contains the minimum
    high = 1.0  # upper endpoint of the interval
    for _ in range(60):  # the iterations of the golden-section search
        left = high - 0.618 * (high - low)  # the sample at 0.382 of the interval
        right = low + 0.618 * (high - low)  # the sample at 0.618 of the interval
        if box_sdf(start + left * way, half_extents) < box_sdf(
            start + right * way, half_extents
        ):
            high = right  # the new upper endpoint
        else:
            low = left  # the new lower endpoint
    return (  # the minimum along the axis, minus the radius
        min(box_sdf(start + s * way, half_extents) for s in (low, high)) - r
    )
    # endregion 11.4


def distance_gradient(
    J_space: np.ndarray, p: np.ndarray, o: np.ndarray, link: int
) -> np.ndarray:
    """Return the gradient of the distance |p - o| in the joint angles, (7,), m/rad.

    J_space (6, 7) is Day 3's space Jacobian with columns (omega; v); p (3,) is the
    closest point on link `link`, 1 to 7, and o (3,) the closest point of an obstacle at
    rest, both in metres and expressed in the world frame. The gradient is 0 for the
    joints that are distal to the link. A joint at the origin about z, p at (1, 0, 0),
    o at (1, 1, 0): -1 for it, since p moves towards o.
    """
    # region 11.5
    n = (p - o) / np.linalg.norm(p - o)  # unit normal from the obstacle to the arm
    slope = np.zeros(J_space.shape[1])  # the gradient, 0 for distal joints
    for i in range(link):  # the joints that move the link
        slope[i] = n @ (J_space[3:, i] + np.cross(J_space[:3, i], p))  # normal velocity
    return slope  # the gradient
    # endregion 11.5


def capsule_aabb(a0: np.ndarray, a1: np.ndarray, r: float) -> np.ndarray:
    """Return a capsule's axis-aligned bounding box (AABB), (2, 3): lower, upper corner.

    a0 and a1 (3,) are the axis endpoints, r is the radius, all in metres. The box is
    the smallest one with edges along the world axes that contains the capsule.
    capsule_aabb((0, 1, 0), (1, 0, 0), 0.5) -> ((-0.5, -0.5, -0.5), (1.5, 1.5, 0.5))
    """
    # region 11.6
    return np.array([
        np.minimum(a0, a1) - r,  # the lower corner
        np.maximum(a0, a1) + r,  # the upper corner
    ])  # fmt: skip
    # endregion 11.6


def aabb_overlap(box_a: np.ndarray, box_b: np.ndarray) -> bool:
    """Return whether two axis-aligned boxes overlap; boxes that only touch overlap.

    box_a and box_b are lower and upper corner, (2, 3), in metres, as `capsule_aabb`
    returns them. The boxes (0, 0, 0) to (1, 1, 1) and (1, 0, 0) to (2, 1, 1) overlap.
    """
    # region 11.6
    return bool(  # the overlap along every axis
        np.all(box_a[0] <= box_b[1]) and np.all(box_b[0] <= box_a[1])
    )
    # endregion 11.6


def distal_radii(link_lengths: np.ndarray, link_radii: np.ndarray) -> np.ndarray:
    """Return for each joint a bound on the distance to any distal point, (n,), metres.

    Distal points lie on the links that the joint moves. link_lengths[i], (n,), is the
    distance from the origin of link i to the origin of the next link; the last entry
    has no next link and is not used. link_radii[i], (n,), is the distance from the
    origin of link i to the farthest point of its own shapes. The bound holds for all
    joint angles, and the farthest point is not always on the last link.
    distal_radii((1, 1, 0), (0.5, 0.5, 0.5)) -> (2.5, 1.5, 0.5)
    """
    # region 11.7
    reach = np.array(link_radii)  # the radius of the joint's own link
    for i in range(len(link_radii) - 2, -1, -1):  # the joints, from the last but one
        reach[i] = max(  # the larger of the link's own radius and the distal bound
            link_radii[i], link_lengths[i] + reach[i + 1]
        )
    return reach  # the distal radii
    # endregion 11.7


def conservative_advance(
    s: float, distance: float, delta_q: np.ndarray, radii: np.ndarray
) -> float:
    """Return the next s of q + s delta_q to query; no contact is possible before it.

    One step of conservative advancement; the result is at most 1. distance is the arm's
    distance at s, metres; delta_q (7,) is the joint displacement of the whole motion,
    from s = 0 to s = 1, radians; radii (7,) come from `distal_radii`, metres. No
    point moves further than the sum of |delta_q_i| radii_i per unit of s. If the
    distance is 0 or negative, return s; otherwise, if no joint moves, return 1. Source:
    Schwarzer, Saha and Latombe (2005).
    At s = 0.25 and 0.1 m, for delta_q 1 and radii 0.5 everywhere: 0.278571.
    """
    # region 11.8
    if distance <= 0:  # contact at s
        return s  # the parameter of the contact
    speed = np.abs(delta_q) @ radii  # bound on a point's path length per unit of s, m
    return min(1.0, s + distance / speed) if speed > 0 else 1.0  # the next s
    # endregion 11.8


def velocity_damper(
    qd: np.ndarray, grad: np.ndarray, distance: float, gain: float
) -> np.ndarray:
    """Return the joint velocities nearest to qd with grad . qd >= -gain distance, (7,).

    qd (7,) are the wanted joint velocities, rad/s; grad (7,) is the gradient of the
    distance, m/rad; distance is in metres and gain in 1/s. If qd satisfies the
    condition, or if grad is 0, return a copy of qd. Source: Faverjon and Tournassoud
    (1987).
    qd (-1, 0, ..), grad (1, 0, ..), distance 0.1, gain 4: (-0.4, 0, ..).
    """
    # region 11.9
    lack = -gain * distance - grad @ qd  # the violation of the condition by qd
    square = grad @ grad  # squared norm of the normal of the half-space
    return (  # the projection onto the half-space
        qd + grad * lack / square if lack > 0 and square > 0 else np.array(qd)
    )
    # endregion 11.9


def off_library(name: str, own: Callable, given: list[tuple]) -> float:
    """Return the largest difference of your function and the library's."""
    truth = getattr(library, name)
    off = [np.subtract(own(*one), truth(*one), dtype=float) for one in given]
    return float(np.max([np.abs(one).max() for one in off]))  # NaN, if one is NaN


def given_to(rng: np.random.Generator) -> dict[str, list[tuple]]:
    """Return arguments for the functions that MuJoCo does not have, by name."""
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
    """Return the errors of distances and points against MuJoCo, and the overlaps.

    The pairs are the arm's nine capsules and five rods, in all configurations (n, 7).
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
    """Return the errors of a sphere's and the arm's distances from two boxes.

    The sphere is also placed inside the boxes. The arm is compared with MuJoCo where it
    is outside, and with robo47 where it overlaps, because MuJoCo's penetration depth is
    the translation that separates the whole capsule from the box.
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
    """Return the gradient of MuJoCo's distance of two geoms by differences, (7,)."""

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
    """Return the errors of your gradients against MuJoCo's distances, (7,) each."""
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
    """Return the numbers of pairs, excluded pairs, overlaps, and excluded overlaps."""
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
    """Return the pen's distance from a motion's wire at s, m, with the shape of s."""
    ends = day11_mujoco.pen(edge.q + np.multiply.outer(s, edge.dq))
    a, b, r = edge.wire
    far = [capsule_distance(*some, shapes.PEN.radius, a, b, r)
           for some in ends.reshape(-1, 2, 3)]  # fmt: skip
    return np.reshape(far, np.shape(s))


def missed_by_points(edges: list[day11_mujoco.Edge], k: int) -> int:
    """Return how many motions k inner samples and both endpoints report as free."""
    s = np.linspace(0, 1, k + 2)
    return sum(bool(pen_from(edge, s).min() > 0) for edge in edges)


def walk(edge: day11_mujoco.Edge, reach: np.ndarray) -> tuple[bool, list[float]]:
    """Return whether a motion is reported free, and the s of its distance queries."""
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
    """Return how many motions your bound reports free, and the queries of each."""
    walked = [walk(edge, reach) for edge in edges]
    return sum(free for free, _ in walked), [len(looked) for _, looked in walked]


def farthest(model, data, q: np.ndarray) -> np.ndarray:
    """Return the largest distance of a distal point from each joint in MuJoCo, m."""
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
    """Return gradient, distance (m) and capsule of the pairs nearest to a post."""
    b0, b1, r = np.array(post[0]), np.array(post[1]), post[2]
    far = [capsule_distance(*some, ra, b0, b1, r)
           for some, ra in zip(ends, day11_mujoco.RADII, strict=True)]  # fmt: skip
    found = []
    for k in np.argsort(far)[:pairs]:
        p, o = closest_points_segments(*ends[k], b0, b1)
        found.append((distance_gradient(J, p, o, day11_mujoco.LINK[k]), far[k], int(k)))
    return found


def through(post: tuple, slow: Callable, pairs: int = 1) -> tuple[float, float]:
    """Drive the pen along its line; `slow` filters qd for the nearest pairs.

    Return the smallest distance to the post, measured by MuJoCo, and the final distance
    of the pen's end from its target, both in mm.
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
    """Return the fraction of ASIDE that is left after 1 s straight at it, at RUSH."""
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

    lab.step("1. The distance between two capsules")
    apart, points, deep = off_capsules(model, data, q)
    print(f"  {len(apart)} pairs of the arm's capsules and rods; {deep} pairs overlap")
    lab.record("distance", apart, label="|capsule_distance - mj_geomDistance|, m",
               seed=SEED)  # fmt: skip
    lab.check("|closest points - MuJoCo's|, m", points)

    lab.step("2. The distance between a capsule and a box")
    ball, sides, inside = off_boxes(model, data, q, rng)
    lab.check("|box_sdf - MuJoCo's sphere|, m, also inside", ball)
    lab.check("|capsule_box_distance - MuJoCo's|, m, outside", sides)
    print(f"  {len(sides)} pairs are apart; {len(inside)} pairs overlap")
    lab.check("capsule_box_distance - the library's, overlapping", inside)

    lab.step("3. The gradient of the distance")
    off = off_slopes(model, data, q[: TRIALS // 5 + 1])
    lab.record("gradient", off, seed=SEED,
               label="|gradient - MuJoCo's differences|, m/rad")  # fmt: skip
    tip = day11_mujoco.pen(panda.READY_Q)[1]
    J = space_jacobian(panda.screws(model), panda.READY_Q)
    slope = distance_gradient(J, tip, tip + ASIDE * np.eye(3)[1], 7)
    lab.show(f"gradient, obstacle {1000 * ASIDE:.0f} mm to the left of the pen, m/rad",
             slope, 5)  # fmt: skip
    lab.measured("gradient for joint 1, m/rad", slope[0])

    lab.step("4. The broad phase")
    pairs, no, touch, both = cheap_no(model, data, q)
    print(f"  the boxes exclude {no} of {pairs} pairs; {touch} pairs overlap")
    lab.check("overlapping pairs that are excluded", both)
    for name, own in {
        "capsule_aabb": capsule_aabb,
        "aabb_overlap": aabb_overlap,
    }.items():
        lab.check(f"{name} - the library's", off_library(name, own, given[name]))

    lab.step("5. A motion checked by samples")
    wires = day11_mujoco.wires(PLACES, WIRE, SEED)
    way = np.linalg.norm(day11_mujoco.pen(panda.READY_Q)[1, :2])  # m, for 1 rad
    contact = 2 * (shapes.PEN.radius + WIRE)
    print("  inner samples  fraction missed: formula  measured")
    for k in COUNTS:
        guess = max(0.0, 1 - contact * (k + 1) / way)
        share = missed_by_points(wires, k) / PLACES
        print(f"  {k:13}{guess:26.3f}{share:10.3f}")
        if k == COUNTS[1]:
            lab.measured("fraction missed by 10 samples", share)

    lab.step("6. Conservative advancement in place of samples")
    reach = distal_radii(*arm.lengths)
    lab.show("distal radii, m", reach, 3)
    seen = farthest(model, data, q)
    lab.show("largest distance in MuJoCo / distal radius", seen / reach, 2)
    lab.check("distance beyond the distal radius, m", np.maximum(seen - reach, 0))
    for name, own in {
        "distal_radii": distal_radii,
        "conservative_advance": conservative_advance,
    }.items():
        lab.check(f"{name} - the library's", off_library(name, own, given[name]))
    edges = day11_mujoco.whips(WHIPS, THIN, SEED)
    for k in MANY:
        print(f"  {k:3} samples miss {missed_by_points(edges, k):2} of {WHIPS} motions")
    missed, looks = promises(edges, reach)
    print(f"  the bound misses {missed}; distance queries: median "
          f"{np.median(looks):.0f}, at most {max(looks)}")  # fmt: skip
    lab.record("edges", missed, metric="missed", label="motions missed", seed=SEED)
    passed = day11_mujoco.whips(WHIPS // 3, THIN, SEED, beside=BESIDE)
    free, _ = promises(passed, reach)
    lab.check("motions past the wire that are refused", len(passed) - free, 0.5)
    halfway = day11_mujoco.whips(WHIPS, THIN, SEED, middle=True)
    by_3, by_10 = (missed_by_points(halfway, k) for k in (3, 10))
    print(f"  wire always met halfway: 3 samples miss {by_3}, 10 samples {by_10}")
    lab.measured("met halfway: missed by 10 samples, of 60", by_10)

    lab.step("7. Side quest: commanded through a post")
    with lab.side_quest():
        lab.check(
            "velocity_damper - the library's",
            off_library("velocity_damper", velocity_damper, given["velocity_damper"]),
        )
        share = left_of_it(velocity_damper)
        print(f"  straight at it: after 1 s {share:.4f} of the distance is left")
        least, beside = through(POST, lambda qd, *_: qd)
        print(f"  without damper: {least:.1f} mm, ends {beside:.1f} mm from its target")
        least, beside = through(POST, velocity_damper)
        print(f"  with damper: {least:.1f} mm, ends {beside:.1f} mm from its target")
        lab.record("post", least, metric="least_mm", label="smallest distance, mm")
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
