"""Collision geometry of the arm and of its environment, and the distances between them.

The arm consists of capsules that are fixed to its links; its environment consists of
capsules (posts, bars, wires) and boxes. The capsules of the links contain the
Menagerie's collision meshes; `PEN` is a pen of 5 mm that the arm without a hand holds.
The base does not move, so it is no part of the arm.

    arm = shapes.Shape(model)
    world = shapes.World.of(posts=[((0.4, 0, 0), (0.4, 0, 0.9), 0.04)])
    arm.clearance(q, world)                 metres, for one q or for thousands
    arm.edge_free(q0, q1, world)            whether a straight edge is collision-free

`robo47.distance` has the formulas for one pair. Metres, radians.
"""

from collections.abc import Iterable, Sequence
from functools import cached_property
from typing import Any, NamedTuple

import mujoco
import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks, kinematics, panda, se3
from robo47.checks import Array
from robo47.distance import distal_radii
from robo47.errors import Robo47Error
from robo47.fast import near


class Capsule(NamedTuple):
    """One capsule of the arm, fixed to a link."""

    link: int  # 1 to 7
    a: tuple[float, float, float]  # endpoints of its axis in the link's frame, m
    b: tuple[float, float, float]
    radius: float  # m


LINKS = (
    Capsule(1, (0, 0, -0.140), (0, -0.053, 0.001), 0.077),
    Capsule(2, (0, 0, 0.053), (0, -0.142, 0), 0.077),
    Capsule(3, (0.083, 0.043, 0), (0.001, 0.001, -0.081), 0.070),
    Capsule(4, (0, 0, 0.042), (-0.081, 0.083, 0), 0.070),
    Capsule(5, (0.011, 0.055, -0.173), (0, 0, -0.236), 0.060),
    Capsule(5, (-0.002, 0.058, -0.122), (0, 0.064, 0.003), 0.068),
    Capsule(6, (0.023, 0.007, 0.006), (0.087, 0.009, 0), 0.076),
    Capsule(7, (-0.005, -0.005, 0.073), (0.033, 0.033, 0.080), 0.050),
)
PEN = Capsule(7, (0, 0, 0.107), (0, 0, 0.225), 0.005)
# The hand's capsules in the body `hand`: the hand itself, and both fingers, open.
HAND = (
    ((0, -0.076, 0.021), (0, 0.061, 0.030), 0.050),
    ((0, -0.058, 0.084), (0, 0.058, 0.084), 0.029),
)
TINY = 1e-6  # m, the finest resolution of a test


class World(NamedTuple):
    """The arm's environment."""

    ends: Array  # endpoints of the capsules' axes, m, (m, 2, 3)
    radii: Array  # m, (m,)
    boxes: Array  # T_world_box, (b, 4, 4)
    half: Array  # half sides of the boxes, m, (b, 3)

    @classmethod
    def of(
        cls,
        posts: Iterable[tuple[ArrayLike, ArrayLike, float]] = (),
        boxes: Iterable[tuple[ArrayLike, ArrayLike]] = (),
    ) -> "World":
        """Return a world of capsules (a0, a1, radius) and boxes (T_world_box, half).

        Raises:
            ValueError: a wrong shape, not a pose, or a negative length.
        """
        posts = list(posts)
        boxes = list(boxes)
        ends: Any = [(a0, a1) for a0, a1, _ in posts]
        return cls(
            checks.array(np.reshape(ends, (-1, 2, 3)), "posts", (2, 3)),
            checks.not_negative([r for *_, r in posts], "radius"),
            checks.pose(np.reshape([T for T, _ in boxes], (-1, 4, 4)), "T_world_box"),
            checks.not_negative(np.reshape([h for _, h in boxes], (-1, 3)), "half"),
        )

    @classmethod
    def of_model(cls, model: mujoco.MjModel) -> "World":
        """Return a model's capsules, spheres and boxes that are fixed to the world."""
        posts = []
        boxes = []
        for i in np.flatnonzero(model.geom_bodyid == 0):
            pos = model.geom_pos[i]
            R = se3.quat_to_R(model.geom_quat[i])
            size = model.geom_size[i]
            kind = model.geom_type[i]
            if kind == mujoco.mjtGeom.mjGEOM_BOX:
                boxes.append((se3.make_T(R, pos), size))
            elif kind == mujoco.mjtGeom.mjGEOM_CAPSULE:
                posts.append(
                    (pos - size[1] * R[:, 2], pos + size[1] * R[:, 2], size[0])
                )
            elif kind == mujoco.mjtGeom.mjGEOM_SPHERE:
                posts.append((pos, pos, size[0]))
        return cls.of(posts, boxes)

    def add_to(self, spec: mujoco.MjSpec, name: str = "world") -> None:
        """Add these shapes to a model as geoms world0, world1 ..., capsules first.

        They have no contacts, but `mujoco.mj_geomDistance` measures their distances.
        """
        body = spec.worldbody
        for i, (ends, r) in enumerate(zip(self.ends, self.radii, strict=True)):
            _add_capsule(body, f"{name}{i}", ends[0], ends[1], r)
        for i, (T, half) in enumerate(zip(self.boxes, self.half, strict=True)):
            body.add_geom(
                name=f"{name}{len(self.ends) + i}", type=mujoco.mjtGeom.mjGEOM_BOX,
                pos=T[:3, 3], quat=se3.R_to_quat(T[:3, :3]), size=half,
                contype=0, conaffinity=0, mass=0.0,
            )  # fmt: skip


class Shape:
    """The arm as capsules: their poses, and their distances from a world."""

    def __init__(
        self, model: mujoco.MjModel, capsules: Sequence[Capsule] | None = None
    ) -> None:
        """Read the arm's links; capsules are `capsules_of` the model if None."""
        self.model = model
        self.capsules = tuple(capsules_of(model) if capsules is None else capsules)
        self.links = np.array([one.link for one in self.capsules])
        self.radii = np.array([one.radius for one in self.capsules])
        self._ends = np.array([(one.a, one.b) for one in self.capsules], np.float64)
        self._chain = kinematics.chain_to(model, "body:link7")
        adr = model.jnt_qposadr[[model.joint(j).id for j in panda.ARM_JOINTS]]
        self._adr = adr if model.nq > len(adr) else None
        self._qpos0 = model.qpos0.copy()

    def ends(self, q: ArrayLike) -> Array:
        """Return the endpoints of the capsules' axes in the world frame.

        Args:
            q: joint angles, radians, (..., 7).

        Returns:
            Metres, (..., capsules, 2, 3).

        Raises:
            ValueError: a wrong shape or a non-finite number.
        """
        q = checks.array(q, "q", (len(panda.ARM_JOINTS),))
        if self._adr is not None:  # the fingers, and free bodies
            full = np.broadcast_to(self._qpos0, (*q.shape[:-1], self.model.nq)).copy()
            full[..., self._adr] = q
            q = full
        T = kinematics.fk_links(self._chain, q)[..., self.links - 1, :, :]
        turned = self._ends @ np.swapaxes(T[..., :3, :3], -1, -2)
        return turned + T[..., None, :3, 3]

    def distances(self, q: ArrayLike, world: World) -> Array:
        """Return the signed distance of each capsule from each shape of a world.

        Args:
            q: joint angles, radians, (..., 7).
            world: its capsules come first, then its boxes.

        Returns:
            Metres, (..., capsules, shapes); negative for shapes that overlap.

        Raises:
            ValueError: a wrong shape or a non-finite number.
        """
        ends = self.ends(q)[..., None, :, :]  # (..., capsules, 1, 2, 3)
        a0 = ends[..., 0, :]
        a1 = ends[..., 1, :]
        far = []
        if len(world.ends):
            axes = near.segment_distances(a0, a1, world.ends[:, 0], world.ends[:, 1])
            far.append(axes - world.radii)
        if len(world.boxes):
            R = world.boxes[:, :3, :3]
            t = world.boxes[:, :3, 3]
            # The point is expressed in the box frames.
            start = ((a0 - t)[..., None, :] @ R)[..., 0, :]
            end = ((a1 - t)[..., None, :] @ R)[..., 0, :]
            far.append(near.box_distances(start, end, world.half))
        if not far:
            return np.full((*ends.shape[:-3], 0), np.inf)
        return np.concatenate(far, axis=-1) - self.radii[:, None]

    def clearance(self, q: ArrayLike, world: World) -> Array:
        """Return the clearance, the smallest distance from a world, metres, (...).

        Args:
            q: joint angles, radians, (..., 7).
            world: the environment; the clearance from an empty one is infinity.

        Raises:
            ValueError: a wrong shape or a non-finite number.
        """
        return self.distances(q, world).min(axis=(-1, -2), initial=np.inf)

    @cached_property
    def distal_radii(self) -> Array:
        """An upper bound on the distance of distal points from each joint, m, (7,)."""
        return distal_radii(*self.lengths)

    @cached_property
    def lengths(self) -> tuple[Array, Array]:
        """Distances from each link's origin to the next and to its own farthest point.

        Metres, (7,) each; for the last link the first one is 0.
        """
        origins = kinematics.fk_links(self._chain, self._qpos0)[:, :3, 3]
        offsets = np.linalg.norm(np.diff(origins, axis=0), axis=1)
        far = np.zeros(len(origins))
        for one, ends in zip(self.capsules, self._ends, strict=True):
            most = np.linalg.norm(ends, axis=1).max() + one.radius
            far[one.link - 1] = max(far[one.link - 1], most)
        return np.append(offsets, 0.0), far

    def edge_free(
        self, q0: ArrayLike, q1: ArrayLike, world: World, margin: float = 0.0
    ) -> bool:
        """Return whether the straight edge from q0 to q1 is collision-free.

        As in `robo47.distance.conservative_advance`, a distance d excludes contacts
        within d / speed. Many configurations are tested together, and the intervals
        that remain are halved.

        Args:
            q0, q1: joint angles, radians, (7,).
            world: the environment of the arm.
            margin: metres; a tested distance below it is treated as a collision.

        Raises:
            ValueError: a wrong shape, a non-finite number or a negative margin.
        """
        q0 = checks.array(q0, "q0", (7,))
        dq = checks.array(q1, "q1", (7,)) - q0
        margin = float(checks.not_negative(margin, "margin"))
        speed = max(float(np.abs(dq) @ self.distal_radii), TINY)
        at_ends = self.clearance(q0 + np.array([[0.0], [1.0]]) * dq, world)
        if at_ends.min() <= margin:
            return False
        first, last = at_ends / speed
        cuts = np.linspace(first, max(first, 1.0 - last), 5)  # one call costs as four
        low = cuts[:-1]
        high = cuts[1:]
        while (open_ := low < high).any():
            low = low[open_]
            high = high[open_]
            middle = 0.5 * (low + high)
            d = self.clearance(q0 + middle[:, None] * dq, world)
            if d.min() <= margin:
                return False
            free = np.maximum(d, TINY) / speed
            low, high = (
                np.concatenate([low, middle + free]),
                np.concatenate([middle - free, high]),
            )
        return True


def capsules_of(model: mujoco.MjModel) -> tuple[Capsule, ...]:
    """Return the arm's capsules, with those of the hand, or of the pen without a hand.

    Args:
        model: of the arm.

    Raises:
        Robo47Error: the model has no link7.
    """
    poses = kinematics.fk_all(model, model.qpos0)
    if "body:link7" not in poses:
        raise Robo47Error("the model has no link7; load the Panda")
    if "body:hand" not in poses:
        return (*LINKS, PEN)
    T = se3.inverse(poses["body:link7"]) @ poses["body:hand"]
    hand = [
        Capsule(7, tuple(T[:3, :3] @ a + T[:3, 3]), tuple(T[:3, :3] @ b + T[:3, 3]), r)
        for a, b, r in HAND
    ]
    return (*LINKS, *hand)


def add_arm(spec: mujoco.MjSpec, capsules: Sequence[Capsule] = (*LINKS, PEN)) -> None:
    """Add the arm's capsules to a model as geoms arm0, arm1 ...; an `edit` of it.

    They have neither contacts nor mass; `mujoco.mj_geomDistance` measures them.
    """
    for i, one in enumerate(capsules):
        body = spec.body(f"link{one.link}")
        _add_capsule(body, f"arm{i}", np.array(one.a), np.array(one.b), one.radius)


def _add_capsule(body: Any, name: str, a: Array, b: Array, radius: float) -> None:
    """Add one geom, a sphere if both ends are equal."""
    if np.array_equal(a, b):
        body.add_geom(
            name=name, type=mujoco.mjtGeom.mjGEOM_SPHERE, pos=a, size=[radius, 0, 0],
            contype=0, conaffinity=0, mass=0.0,
        )  # fmt: skip
        return
    body.add_geom(
        name=name, type=mujoco.mjtGeom.mjGEOM_CAPSULE, fromto=[*a, *b],
        size=[radius, 0, 0], contype=0, conaffinity=0, mass=0.0,
    )  # fmt: skip
