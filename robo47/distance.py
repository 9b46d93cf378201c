"""Signed distances, their gradient, conservative advancement and a velocity damper.

Conventions:

- A capsule is the set of all points within a radius of a segment, its axis, from a0 to
  a1. A sphere is a capsule with a0 = a1.
- A distance is signed: positive where two shapes are apart, 0 where they touch and
  negative where they overlap.
- Points, normals and Jacobians are expressed in the world frame. J_space is the space
  Jacobian of Day 3 with the columns (omega; v).
- Metres, radians, float64. One pair at a time; `robo47.shapes` computes the distances
  of a whole arm.

Sources: Ericson, *Real-Time Collision Detection* (2005), section 5.1.9 (two segments);
Quilez, "Distance functions" (box); Schwarzer, Saha and Latombe, "Adaptive dynamic
collision checking" (2005); Faverjon and Tournassoud, "A local based approach for path
planning of manipulators with a high number of degrees of freedom" (1987).
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks, se3
from robo47.checks import Array
from robo47.fast.near import closest, outside

GOLDEN = 0.5 * (np.sqrt(5.0) - 1.0)  # fraction of an interval that is kept
SECTIONS = 60  # 0.618^60 = 3e-13 of a segment


def closest_points_segments(
    a0: ArrayLike, a1: ArrayLike, b0: ArrayLike, b1: ArrayLike
) -> Array:
    """Return the closest points of two segments.

    For parallel segments with more than one closest pair, any of these pairs.

    Args:
        a0, a1: endpoints of the first segment, metres, (3,); if equal, a point.
        b0, b1: endpoints of the second segment, metres, (3,).

    Returns:
        The point of the first and the point of the second segment, metres, (2, 3).

    Raises:
        ValueError: a wrong shape or a non-finite number.
    """
    a = _segment(a0, a1, "a")
    b = _segment(b0, b1, "b")
    return np.stack(closest(*a, *b))


def capsule_distance(
    a0: ArrayLike, a1: ArrayLike, ra: float, b0: ArrayLike, b1: ArrayLike, rb: float
) -> float:
    """Return the signed distance of two capsules.

    This is the distance of the axes minus both radii.

    Args:
        a0, a1: endpoints of the first axis, metres, (3,).
        ra: radius of the first capsule, metres, at least 0.
        b0, b1: endpoints of the second axis, metres, (3,).
        rb: radius of the second capsule, metres, at least 0.

    Returns:
        The signed distance, metres; negative for capsules that overlap.

    Raises:
        ValueError: a wrong shape, a non-finite number or a negative radius.
    """
    p, o = closest_points_segments(a0, a1, b0, b1)
    radii = checks.not_negative(ra, "ra") + checks.not_negative(rb, "rb")
    return float(np.linalg.norm(p - o) - radii)


def box_sdf(p: ArrayLike, half_extents: ArrayLike) -> float:
    """Return the signed distance of a point from a box (a signed distance function).

    Outside, the distance to the box; inside, minus the distance to the nearest face
    (Quilez, "Distance functions").

    Args:
        p: the point in the box frame, whose origin is the centre of the box and whose
            axes are parallel to its edges, metres, (3,).
        half_extents: half of the box's sides, metres, (3,), at least 0.

    Returns:
        The signed distance, metres; negative inside.

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
    """Return the signed distance of a capsule and a box in any pose.

    This is the minimum of `box_sdf` along the axis, minus the radius. The signed
    distance from a convex body is a convex function of the point, so golden-section
    search finds its single minimum. Where the shapes overlap, the result is the depth
    of the deepest point of the axis plus the radius, and not the shortest translation
    that separates them.

    Args:
        a0, a1: endpoints of the capsule's axis, metres, (3,).
        r: radius of the capsule, metres, at least 0.
        T_world_box: pose of the box in the world frame, (4, 4).
        half_extents: half of the box's sides, metres, (3,), at least 0.

    Returns:
        The signed distance, metres; negative where they overlap.

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
    """Return the gradient of the distance |p - o| in the joint angles.

    The derivative of the distance is the component of the velocity of p along the
    normal n = (p - o) / |p - o|, and joint i moves p with v_i + omega_i x p. That the
    closest points slide along their surfaces does not change the distance to first
    order. This holds for a unique closest pair; where there are several (parallel
    capsules side by side), the distance has a kink, and the result is one of the
    one-sided derivatives or lies between them.

    Args:
        J_space: space Jacobian, (6, n).
        p: closest point on the arm, in the world frame, metres, (3,).
        o: closest point of an obstacle at rest, metres, (3,); different from p.
        link: the link of p; link 1 is moved by the first joint alone.

    Returns:
        The gradient, metres per radian, (n,); 0 for the joints distal to the link.

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
    """Return the axis-aligned bounding box (AABB) of a capsule.

    Args:
        a0, a1: endpoints of the capsule's axis, metres, (3,).
        r: radius of the capsule, metres, at least 0.

    Returns:
        Lower and upper corner, metres, (2, 3).

    Raises:
        ValueError: a wrong shape, a non-finite number or a negative radius.
    """
    ends = np.stack(_segment(a0, a1, "a"))
    r = float(checks.not_negative(r, "r"))
    return np.stack([ends.min(axis=0) - r, ends.max(axis=0) + r])


def aabb_overlap(box_a: ArrayLike, box_b: ArrayLike) -> bool:
    """Return whether two axis-aligned boxes overlap; boxes that only touch overlap.

    Args:
        box_a, box_b: lower and upper corner, metres, (2, 3).

    Raises:
        ValueError: a wrong shape or a non-finite number.
    """
    box_a = checks.array(box_a, "box_a", (2, 3))
    box_b = checks.array(box_b, "box_b", (2, 3))
    return bool(np.all((box_a[0] <= box_b[1]) & (box_b[0] <= box_a[1])))


def distal_radii(link_lengths: ArrayLike, link_radii: ArrayLike) -> Array:
    """Return for each joint an upper bound on the distance to any distal point.

    From the last joint inwards: the larger of the radius of the joint's own link, and
    the link length plus the result for the next joint. The bound holds for all joint
    angles, because it is the distance in the stretched arm.

    Args:
        link_lengths: distance from the origin of link i to the origin of the next
            link, metres, (n,); the last entry is not used.
        link_radii: distance from the origin of link i to the farthest point of its own
            shapes, metres, (n,).

    Returns:
        The distal radii, metres, (n,).

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
    """Return the next s of q + s delta_q to query; no contact is possible before it.

    One step of conservative advancement: no point of the arm moves further than the
    sum of |delta_q_i| radii_i per unit of s, so contact is impossible before this bound
    has used up the distance (Schwarzer, Saha and Latombe, 2005).

    Args:
        s: where the distance was queried, 0 to 1.
        distance: signed distance of the arm from all obstacles there, metres.
        delta_q: joint displacement of the whole motion, radians, (n,).
        radii: from `distal_radii`, metres, (n,).

    Returns:
        The next s to query, at most 1; s itself where the arm touches already.

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
    """Return the joint velocities nearest to qd with grad . qd >= -gain distance.

    In continuous time the distance then falls no faster than e^(-gain t), so it never
    reaches 0. With time steps this is approximate and needs a gain well below 1 / step.
    The condition is the velocity damper of Faverjon and Tournassoud (1987); today it is
    called a control barrier function with a linear bound.

    Args:
        qd: wanted joint velocities, rad/s, (n,).
        grad: gradient of the distance from `distance_gradient`, metres per radian,
            (n,); if it is 0, qd is returned.
        distance: distance minus the margin to keep, metres.
        gain: 1/s, at least 0.

    Returns:
        Joint velocities, rad/s, (n,).

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
    """Return the minimum of a convex function on 0 to 1 by golden-section search."""
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
