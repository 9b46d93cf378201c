"""How far two things are apart, how that changes, and what it promises.

Conventions:

- A capsule is a segment, its axis, from a0 to a1, and a radius: all points within the
  radius of the axis. A ball is one with a0 = a1.
- A distance is signed: negative where the things overlap. Touching is 0.
- Points, normals and Jacobians are in world axes. J_space is Day 3's, (omega; v).
- Metres, radians, float64. One pair at a time; `robo47.shapes` has the whole arm's.

Sources: Ericson, *Real-Time Collision Detection* (2005), section 5.1.9 (two segments);
Quilez, "Distance functions" (a box); Schwarzer, Saha and Latombe, "Adaptive dynamic
collision checking" (2005); Faverjon and Tournassoud, "A local based approach for path
planning of manipulators with a high number of degrees of freedom" (1987).
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks, se3
from robo47.checks import Array
from robo47.fast.near import closest, outside

GOLDEN = 0.5 * (np.sqrt(5.0) - 1.0)  # what a golden section keeps of an interval
SECTIONS = 60  # 0.618^60 = 3e-13 of a segment


def closest_points_segments(
    a0: ArrayLike, a1: ArrayLike, b0: ArrayLike, b1: ArrayLike
) -> Array:
    """Return the points of two segments that are closest to each other.

    Where more than one pair is closest (parallel segments), any of them.

    Args:
        a0, a1: ends of the one, metres, (3,); a point where both are the same.
        b0, b1: ends of the other, metres, (3,).

    Returns:
        The point of the first and that of the second, metres, (2, 3).

    Raises:
        ValueError: a wrong shape or a non-finite number.
    """
    a = _segment(a0, a1, "a")
    b = _segment(b0, b1, "b")
    return np.stack(closest(*a, *b))


def capsule_distance(
    a0: ArrayLike, a1: ArrayLike, ra: float, b0: ArrayLike, b1: ArrayLike, rb: float
) -> float:
    """Return how far two capsules are apart: their axes' distance, less both radii.

    Args:
        a0, a1: ends of the one's axis, metres, (3,).
        ra: its radius, metres, at least 0.
        b0, b1: ends of the other's, metres, (3,).
        rb: its radius, metres, at least 0.

    Returns:
        Metres; negative where they overlap.

    Raises:
        ValueError: a wrong shape, a non-finite number or a negative radius.
    """
    p, o = closest_points_segments(a0, a1, b0, b1)
    radii = checks.not_negative(ra, "ra") + checks.not_negative(rb, "rb")
    return float(np.linalg.norm(p - o) - radii)


def box_sdf(p: ArrayLike, half_extents: ArrayLike) -> float:
    """Return how far a point is from a box about the origin, its edges along the axes.

    Outside the length of what is beyond the faces, inside the way to the nearest face,
    negative (Quilez, "Distance functions").

    Args:
        p: the point in the box's axes, metres, (3,).
        half_extents: half of the box's sides, metres, (3,), at least 0.

    Returns:
        Metres; negative inside.

    Raises:
        ValueError: a wrong shape, a non-finite number or a negative side.
    """
    p = checks.array(p, "p", (3,))
    half_extents = checks.not_negative(
        checks.array(half_extents, "half_extents", (3,)), "half_extents"
    )
    return float(outside(p, half_extents))


def capsule_box_distance(
    a0: ArrayLike,
    a1: ArrayLike,
    r: float,
    T_world_box: ArrayLike,
    half_extents: ArrayLike,
) -> float:
    """Return how far a capsule is from a box: its axis' least `box_sdf`, less r.

    Along a segment the distance from a convex set is convex, so a golden section finds
    its one valley. Inside, it is the depth of the deepest point of the axis, and not
    how far the whole capsule would have to move to be out.

    Args:
        a0, a1: ends of the capsule's axis, metres, (3,).
        r: its radius, metres, at least 0.
        T_world_box: maps the box's coordinates to the world's, (4, 4).
        half_extents: half of the box's sides, metres, (3,), at least 0.

    Returns:
        Metres; negative where they overlap.

    Raises:
        ValueError: a wrong shape, not a pose, or a negative length.
    """
    T_box_world = se3.inverse(checks.pose(T_world_box, "T_world_box"))
    ends = np.stack(_segment(a0, a1, "a")) @ T_box_world[:3, :3].T + T_box_world[:3, 3]
    half_extents = checks.not_negative(
        checks.array(half_extents, "half_extents", (3,)), "half_extents"
    )
    way = ends[1] - ends[0]
    least = _valley(lambda s: float(outside(ends[0] + s * way, half_extents)))
    return least - float(checks.not_negative(r, "r"))


def distance_gradient(
    J_space: ArrayLike, p: ArrayLike, o: ArrayLike, link: int
) -> Array:
    """Return how fast a point of the arm leaves an obstacle, per joint speed.

    d = |p - o|, so d' = n . p' with n = (p - o) / d, and p' = v + omega x p of each
    joint that moves the link. That the closest points slide along their surfaces does
    not count: they slide across n.

    Args:
        J_space: from Day 3, (6, n).
        p: the arm's point, world coordinates, metres, (3,).
        o: the obstacle's, which stands still, metres, (3,); not the same point.
        link: which link p belongs to: 1 is moved by the first joint alone.

    Returns:
        Metres per radian, (n,); 0 for the joints behind the link.

    Raises:
        ValueError: a wrong shape, no such link, or p = o, where there is no direction.
    """
    J = checks.array(J_space, "J_space", (6, "n"))
    p = checks.array(p, "p", (3,))
    if not 1 <= link <= J.shape[1]:
        raise ValueError(f"link is {link}; the arm has 1 to {J.shape[1]}")
    n = checks.unit(p - checks.array(o, "o", (3,)), "p - o")
    slope = n @ J[3:] + np.cross(p, n) @ J[:3]  # n . (omega x p) = omega . (p x n)
    slope[link:] = 0.0
    return slope


def capsule_aabb(a0: ArrayLike, a1: ArrayLike, r: float) -> Array:
    """Return a capsule's box along the world's axes: its least and greatest corner.

    Args:
        a0, a1: ends of the capsule's axis, metres, (3,).
        r: its radius, metres, at least 0.

    Returns:
        Least and greatest x, y, z, metres, (2, 3).

    Raises:
        ValueError: a wrong shape, a non-finite number or a negative radius.
    """
    ends = np.stack(_segment(a0, a1, "a"))
    r = float(checks.not_negative(r, "r"))
    return np.stack([ends.min(axis=0) - r, ends.max(axis=0) + r])


def aabb_overlap(box_a: ArrayLike, box_b: ArrayLike) -> bool:
    """Return whether two boxes along the axes overlap, on all three; touching counts.

    Args:
        box_a, box_b: least and greatest corner, metres, (2, 3).

    Raises:
        ValueError: a wrong shape or a non-finite number.
    """
    box_a = checks.array(box_a, "box_a", (2, 3))
    box_b = checks.array(box_b, "box_b", (2, 3))
    return bool(np.all((box_a[0] <= box_b[1]) & (box_b[0] <= box_a[1])))


def distal_radii(link_lengths: ArrayLike, link_radii: ArrayLike) -> Array:
    """Return how far from each joint anything behind it can ever be.

    From the last joint inwards: the larger of what its own link has, and one offset
    plus what the next joint reaches. No angle of any joint can make it more.

    Args:
        link_lengths: from link i's origin to the next link's, metres, (n,); the last
            one's does not count.
        link_radii: from link i's origin to the farthest point of its own shapes,
            metres, (n,).

    Returns:
        Metres, (n,).

    Raises:
        ValueError: wrong or unlike shapes, or a negative length.
    """
    link_lengths, link_radii = checks.same_size(
        link_lengths=link_lengths, link_radii=link_radii
    )
    checks.not_negative(link_lengths, "link_lengths")
    reach = checks.not_negative(link_radii, "link_radii").copy()
    for i in reversed(range(len(reach) - 1)):
        reach[i] = max(reach[i], link_lengths[i] + reach[i + 1])
    return reach


def conservative_advance(
    s: float, distance: float, delta_q: ArrayLike, radii: ArrayLike
) -> float:
    """Return where along q + s delta_q the arm may first touch something.

    In a share ds of the way no point of the arm moves farther than ds times the sum of
    |dq_i| radii_i; so nothing can happen before the distance is used up (Schwarzer,
    Saha and Latombe, 2005).

    Args:
        s: where the distance was looked at, 0 to 1.
        distance: of the arm from all else there, metres.
        delta_q: the whole way, radians, (n,).
        radii: from `distal_radii`, metres, (n,).

    Returns:
        The next s to look at, at most 1; s itself where the arm touches already.

    Raises:
        ValueError: wrong or unlike shapes, or a radius below 0.
    """
    s = float(checks.array(s, "s", ()))
    d = float(checks.array(distance, "distance", ()))
    delta_q, radii = checks.same_size(delta_q=delta_q, radii=radii)
    speed = float(np.abs(delta_q) @ checks.not_negative(radii, "radii"))
    if d <= 0.0:
        return s
    return min(1.0, s + d / speed) if speed > 0.0 else 1.0


def velocity_damper(
    qd: ArrayLike, grad: ArrayLike, distance: float, gain: float
) -> Array:
    """Return the nearest joint speeds that do not come closer too fast.

    The nearest to qd with grad . qd >= -gain distance. Kept, the distance never falls
    faster than e^(-gain t), so it never is 0 (Faverjon and Tournassoud, 1987).

    Args:
        qd: wanted joint speeds, rad/s, (n,).
        grad: from `distance_gradient`, metres per radian, (n,); 0 changes nothing.
        distance: metres.
        gain: 1/s, at least 0.

    Returns:
        Joint speeds, rad/s, (n,).

    Raises:
        ValueError: wrong or unlike shapes, or a gain below 0.
    """
    qd, grad = checks.same_size(qd=qd, grad=grad)
    gain = float(checks.not_negative(gain, "gain"))
    bound = -gain * float(checks.array(distance, "distance", ()))
    lack = bound - grad @ qd
    square = grad @ grad
    return qd + grad * (lack / square) if lack > 0.0 < square else qd.copy()


def _valley(f: Callable[[float], float]) -> float:
    """Return the least value of a convex function on 0 to 1, ends included."""
    low = 0.0
    high = 1.0
    for _ in range(SECTIONS):
        left = high - GOLDEN * (high - low)
        right = low + GOLDEN * (high - low)
        if f(left) <= f(right):
            high = right
        else:
            low = left
    return min(f(0.5 * (low + high)), f(0.0), f(1.0))


def _segment(start: ArrayLike, end: ArrayLike, name: str) -> tuple[Array, Array]:
    return (
        checks.array(start, f"{name}0", (3,)),
        checks.array(end, f"{name}1", (3,)),
    )
