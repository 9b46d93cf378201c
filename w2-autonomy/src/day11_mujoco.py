"""Day 11's MuJoCo models: the Panda as nine capsules, with obstacles around it.

`mujoco.mj_geomDistance` measures any two of the geoms named here, also where they
overlap. It needs `mj_kinematics` alone. Metres, radians.
"""

from typing import NamedTuple

import mujoco
import numpy as np

from robo47 import panda, se3, shapes
from robo47.checks import Array
from robo47.jacobian import dls_step, site_jacobian, space_jacobian

CAPSULES = (*shapes.LINKS, shapes.PEN)  # geoms arm0 to arm8; the last is the pen
LINK = [one.link for one in CAPSULES]  # the link of each capsule, 1 to 7
RADII = [one.radius for one in CAPSULES]  # m
# Five rods and two boxes, one of them rotated: the obstacles around the arm.
RODS = (
    ((0.40, 0.00, 0.0), (0.40, 0.00, 0.9), 0.040),
    ((0.00, 0.45, 0.1), (0.50, 0.45, 0.6), 0.020),
    ((-0.40, -0.30, 0.7), (0.40, -0.30, 0.7), 0.030),
    ((0.25, -0.25, 0.2), (0.25, -0.25, 0.2), 0.060),  # a sphere
    ((0.30, 0.20, 0.4), (0.31, 0.20, 0.4), 0.002),
)
BOXES = (
    (se3.make_T(np.eye(3), (0.55, 0.0, 0.1)), (0.20, 0.45, 0.1)),
    (se3.make_T(se3.Rz(0.5) @ se3.Rx(0.4), (-0.1, -0.5, 0.5)), (0.30, 0.02, 0.25)),
)
WORLD = shapes.World.of(RODS, BOXES)
PEN_UP = 0.10  # m above the pen's end, the height of the wire
FINE = np.linspace(0.0, 1.0, 401)  # fine samples of a motion
# The arm lies flat: joints 1, 4 and 6 rotate about the vertical and move the pen fast.
FLAT = np.array([0.0, np.pi / 2, np.pi / 2, 0.0, 0.0, 0.0, 0.0])


class Edge(NamedTuple):
    """A motion q + s dq, a straight line in joint space, past a wire."""

    q: Array  # rad, (7,)
    dq: Array  # rad, (7,)
    wire: tuple[Array, Array, float]  # its endpoints and radius, m


def scene() -> tuple[mujoco.MjModel, mujoco.MjData]:
    """Return the Panda with its capsules, the obstacles of `WORLD`, and a free sphere.

    The geoms are arm0 to arm8, world0 to world6 (rods first), and `ball`, a sphere with
    a radius of 10 mm.
    """

    def edit(spec: mujoco.MjSpec) -> None:
        shapes.add_arm(spec, CAPSULES)
        WORLD.add_to(spec)
        ball = spec.worldbody.add_body(name="ball", mocap=True)
        ball.add_geom(
            name="ball", type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[0.01, 0, 0],
            contype=0, conaffinity=0,
        )  # fmt: skip

    model = panda.load("panda_nohand", edit=edit)
    return model, mujoco.MjData(model)


def around(post: tuple) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """Return the Panda with its capsules and one post, the geom world0."""

    def edit(spec: mujoco.MjSpec) -> None:
        shapes.add_arm(spec, CAPSULES)
        shapes.World.of([post]).add_to(spec)

    model = panda.load("panda_nohand", edit=edit)
    return model, mujoco.MjData(model)


def axes(model: mujoco.MjModel, data: mujoco.MjData) -> Array:
    """Return the endpoints of the capsules' axes in MuJoCo's state, (9, 2, 3)."""
    ends = []
    for i in range(len(CAPSULES)):
        geom = data.geom(f"arm{i}")
        z = geom.xmat.reshape(3, 3)[:, 2]  # z points from the end to the start
        half = model.geom(f"arm{i}").size[1] * z
        ends.append([geom.xpos + half, geom.xpos - half])
    return np.array(ends)


def poses(n: int, seed: int) -> Array:
    """Return n random configurations within the joint limits, (n, 7)."""
    low, high = panda.load("panda_nohand").jnt_range.T
    return np.random.default_rng(seed).uniform(low, high, (n, 7))


def pen(q: Array) -> Array:
    """Return the endpoints of the pen's axis, (..., 2, 3), at q, (..., 7)."""
    return _PEN.ends(q)[..., 0, :, :]


def wires(n: int, radius: float, seed: int) -> list[Edge]:
    """Return n motions in which joint 1 moves the upright pen by 1 rad past a wire.

    The wire is horizontal, points away from the arm, and is anywhere on the path.
    """
    rng = np.random.default_rng(seed)
    found = []
    for s in rng.uniform(0.1, 0.9, n):
        x, y, z = pen(panda.READY_Q + s * np.eye(7)[0])[1]
        far = np.array([x, y, 0.0]) / np.hypot(x, y)
        at = np.array([0.0, 0.0, z + PEN_UP])
        wire = (at + 0.1 * far, at + 0.6 * far, radius)
        found.append(Edge(panda.READY_Q.copy(), np.eye(7)[0], wire))
    return found


def whips(
    n: int, radius: float, seed: int, beside: float = 0.0, middle: bool = False
) -> list[Edge]:
    """Return n motions of the flat arm in which the pen meets a vertical wire.

    Args:
        n: number of motions.
        radius: of the wire, m.
        seed: for the motions and for the position of each wire.
        beside: m; if positive, the wire is this far beyond the pen's end and is passed.
        middle: whether every motion meets the wire halfway.
    """
    rng = np.random.default_rng(seed)
    found: list[Edge] = []
    while len(found) < n:
        q = FLAT.copy()
        q[[0, 3, 5]] = rng.uniform((-1.0, -0.9, 2.4), (1.0, -0.2, 3.6))
        dq = np.zeros(7)
        dq[[0, 3, 5]] = rng.uniform((0.5, 0.3, 0.3), (0.9, 0.7, 0.7)) * (1, -1, -1)
        s, share = rng.uniform((0.05, 0.3), (0.95, 0.95))
        start, end = pen(q + (0.5 if middle else s) * dq)
        along = (end - start) / np.linalg.norm(end - start)
        at = start + share * (end - start)
        if beside:
            at = end + (shapes.PEN.radius + radius + beside) * along
        up = np.array([0.0, 0.0, 0.2])
        edge = Edge(q, dq, (at - up, at + up, radius))
        if not beside or far(edge, FINE).min() > 0.5 * beside:
            found.append(edge)
    return found


def far(edge: Edge, s: Array) -> Array:
    """Return the library's distance of pen and wire at each s of a motion, m, (n,)."""
    q = edge.q + np.multiply.outer(s, edge.dq)
    return _PEN.clearance(q, shapes.World.of([edge.wire]))


def pen_at(point: Array) -> Array:
    """Return a configuration near READY that has the pen's end at a point, (7,)."""
    q = panda.READY_Q.copy()
    for _ in range(50):
        end = pen(q)[1]
        J = site_jacobian(space_jacobian(_SCREWS, q), end)[3:]
        q = q + dls_step(J, point - end, 0.02)
    return q


_MODEL = panda.load("panda_nohand")
_SCREWS = panda.screws(_MODEL)
_PEN = shapes.Shape(_MODEL, [shapes.PEN])
