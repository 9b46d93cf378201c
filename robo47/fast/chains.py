"""The chain's product for one configuration or many at once, in pure NumPy.

A plain stack of 4x4 products multiplies mostly zeros and ones. Here a chain becomes a
plan of the elementary moves of `robo47.fast.moves`, which uses what the chain knows:

- Configurations are worked through in chunks that fit the processor's cache; one alone
  goes in plain floats, since NumPy spends its time on calls there, not on numbers.
- Fixed rotations between joints cost nothing. The moving frame does not follow them:
  the next joint's axis is expressed in the frame as it stands (the idea behind the
  product of exponentials, Modern Robotics section 4.1). It is really turned only where
  an axis is none of its own three, and where a frame is asked for.

Units: metres and radians.
"""

import functools
import math
from collections.abc import Callable
from copy import copy

import numpy as np

from robo47 import checks
from robo47.checks import Array
from robo47.fast import moves
from robo47.fast.moves import WORLD, Axes, Chunk
from robo47.fast.vectors import Number

CHUNK = 4096  # 4 columns x 3 x 4096 float64 = 393 kB: stays within a core's L2 cache
LAST_ROW = (0.0, 0.0, 0.0, 1.0)  # the last row of a pose
END = "end"  # the name of the last frame of an arm
ROUNDING = 2e-15  # the error of 0 and 1 in products of unit quaternions


class Plan:
    """A tree of moves: step i leads from its source to node i + 1; 0 is the world."""

    def __init__(self, nq: int) -> None:
        """Measure every q from 0 until a joint says otherwise."""
        self.nq = nq
        self.ref = np.zeros((nq, 1))
        self.steps: list[tuple[int, moves.Step]] = []
        # each with its node
        self.joints: list[tuple[int, moves.Turn | moves.Slide]] = []
        self.frames: dict[str, int] = {}  # the node of each that is asked for

    def nodes(self, chunk: Chunk) -> list[Axes]:
        """Return every node's frame, of configurations measured from `ref`."""
        nodes = [WORLD]
        for source, step in self.steps:
            nodes.append(step.move(nodes[source], chunk))
        return nodes


class Cursor:
    """A place in a plan, to which a chain's factors are added from left to right.

    What is fixed is gathered here (R and t, seen from the moving frame) and becomes a
    step only where a joint needs it. A copy goes on to another child.
    """

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        self.node = 0
        self.R = np.eye(3)
        self.t = np.zeros(3)

    def mark(self, name: str) -> None:
        """Ask for the frame at this place."""
        end = copy(self)
        end._settle()
        self.plan.frames[name] = end.node

    def fixed(self, T: Array) -> None:
        """Add a fixed pose, (4, 4)."""
        self.shift(T[:3, 3])
        self.R = rounded(self.R @ T[:3, :3])

    def shift(self, vector: Array) -> None:
        """Add a fixed translation, metres, (3,)."""
        self.t = self.t + self.R @ vector

    def turn(self, axis: Array, adr: int, ref: float) -> None:
        """Add a hinge about a unit axis, (3,)."""
        axis = rounded(self.R @ axis)
        k = int(np.argmax(np.abs(axis)))
        if np.count_nonzero(axis) > 1:  # none of the moving frame's own: make it z
            self._rotate(frame_with_z(axis))
            k = 2
            axis = np.array([0.0, 0.0, 1.0])
        # A shift along the axis commutes with the turn, so it can wait.
        self._flush_shift(keep=k)
        self.plan.ref[adr] = ref
        self._step(moves.Turn(k, float(axis[k]), adr))

    def slide(self, axis: Array, adr: int, ref: float, pitch: float = 1.0) -> None:
        """Add a slide by pitch times q along a unit axis, (3,)."""
        self.plan.ref[adr] = ref  # no translation stands before it: the two commute
        self._step(moves.Slide(pitch * rounded(self.R @ axis), adr))

    def ball(self, name: str, adr: int) -> None:
        """Add a ball joint."""
        self._settle()
        self._step(moves.Ball(name, adr))

    def free(self, name: str, adr: int) -> None:
        """Add a free joint (position, quaternion), which forgets what is before it."""
        self.node = 0
        self.R = np.eye(3)
        self.t = np.zeros(3)
        for axis in range(3):
            self.slide(np.eye(3)[axis], adr + axis, 0.0)
        self.ball(name, adr + 3)

    def _settle(self) -> None:
        """Take the moving frame to this place."""
        self._flush_shift()
        if not np.array_equal(self.R, np.eye(3)):
            self._rotate(self.R)

    def _rotate(self, R: Array) -> None:
        """Really turn the moving frame by R."""
        self._step(moves.Rotate(R))
        self.R = rounded(R.T @ self.R)
        self.t = R.T @ self.t

    def _flush_shift(self, keep: int | None = None) -> None:
        now = self.t.copy()
        later = np.zeros(3)
        if keep is not None:
            now[keep] = 0.0
            later[keep] = self.t[keep]
        if now.any():
            self._step(moves.Shift(now))
        self.t = later

    def _step(self, step: moves.Step) -> None:
        self.plan.steps.append((self.node, step))
        self.node = len(self.plan.steps)
        if isinstance(step, moves.Turn | moves.Slide):
            self.plan.joints.append((self.node, step))


def plan_of(screws: Array, M: Array) -> Plan:
    """Return the chain of one arm to its `END`, worked out once.

    e^[S] q is a move to the screw's line, a rotation by q (a slide along the line by
    pitch times q) and the move back; the two moves between neighbours become one.

    Args:
        screws: checked space screws, (joints, 6).
        M: checked `T_world_ee` at q = 0, (4, 4).
    """
    return _plan(screws.tobytes(), M.tobytes())


@functools.lru_cache(maxsize=64)
def _plan(screws: bytes, M: bytes) -> Plan:
    rows = np.frombuffer(screws).reshape(-1, 2, 3)
    plan = Plan(len(rows))
    cursor = Cursor(plan)
    for i, (omega, v) in enumerate(rows):
        if omega @ omega < 0.5:  # 0, a slide; other lengths than 0 and 1 were refused
            if v.any():
                cursor.slide(checks.unit(v, "v"), i, 0.0, math.hypot(*v))
            continue
        point = np.cross(omega, v)  # the point of the axis nearest to the origin
        pitch = float(omega @ v)
        cursor.shift(point)
        cursor.turn(omega, i, 0.0)
        cursor.shift(-point)
        if abs(pitch) > ROUNDING * max(1.0, float(np.abs(v).max())):
            cursor.slide(omega, i, 0.0, pitch)
    cursor.fixed(np.frombuffer(M).reshape(4, 4))
    cursor.mark(END)
    return plan


def evaluate(plan: Plan, qpos: Array) -> dict[str, Array]:
    """Return the pose of every frame that the plan asks for.

    Args:
        plan: what to compute.
        qpos: configurations, (..., nq).

    Returns:
        {name: T_world_frame, (..., 4, 4)}.

    Raises:
        ValueError: a non-finite number, or a quaternion of length 0.
    """
    only = (qpos.ravel() - plan.ref[:, 0]).tolist() if qpos.size == plan.nq else []
    # One alone, in floats; where a number is not finite, the way for many says which.
    if only and all(map(math.isfinite, only)):
        nodes = plan.nodes(one_of(only))
        shape = (*qpos.shape[:-1], 4, 4)
        return {
            name: np.array([*_numbers(nodes[node]), *LAST_ROW]).reshape(shape)
            for name, node in plan.frames.items()
        }
    flat = qpos.reshape(math.prod(qpos.shape[:-1]), plan.nq)
    poses = {name: np.zeros((len(flat), 4, 4)) for name in plan.frames}
    for start in range(0, len(flat), CHUNK):
        part = slice(start, start + CHUNK)
        q = np.subtract(flat[part].T, plan.ref, order="C")
        if not np.isfinite(q).all():
            bad = start + int(np.argmin(np.isfinite(q).all(axis=0)))
            raise ValueError(f"configuration {bad} holds NaN or infinity: {flat[bad]}")
        # A call, so that its frames are let go before the next chunk fills the cache.
        _write(plan, q, [T[part] for T in poses.values()])
    return {name: T.reshape(*qpos.shape[:-1], 4, 4) for name, T in poses.items()}


def _write(plan: Plan, q: Array, poses: list[Array]) -> None:
    """Write the frames' poses at q, (nq, n), into arrays that are zero, (n, 4, 4)."""
    nodes = plan.nodes(chunk_of(q))
    for T, node in zip(poses, plan.frames.values(), strict=True):
        rows = rows_of(nodes[node], len(T))
        T.reshape(-1, 16)[:, :12] = rows.T  # one pass over the output
        T[:, 3, 3] = 1.0


def in_chunks(
    work: Callable[..., Array], shape: tuple[int, ...], *given: Array
) -> Array:
    """Return what work returns of columns, (shape, n), for rows, (..., shape).

    Args:
        work: is called with each of those given as columns, (nq, n).
        shape: of its answer to one configuration.
        given: of one shape, (..., nq).
    """
    flat = [rows.reshape(-1, rows.shape[-1]) for rows in given]
    out = np.empty((len(flat[0]), math.prod(shape)))
    for start in range(0, len(out), CHUNK):
        part = slice(start, start + CHUNK)
        columns = (np.ascontiguousarray(rows[part].T) for rows in flat)
        out[part] = work(*columns).reshape(out.shape[1], -1).T
    return out.reshape(*given[0].shape[:-1], *shape)


def one_of(q: list[float]) -> Chunk:
    """Return one configuration with its cosine and sine."""
    return Chunk(q, [*map(math.cos, q)], [*map(math.sin, q)])


def chunk_of(q: Array) -> Chunk:
    """Return q, (nq, n), with its cosine and sine.

    Both from one tangent, t = tan(q / 2), and one division, r = 2 / (1 + t^2):
    cos = r - 1 and sin = t r. It is exact to the last bit or two of 1 for every q,
    also near pi, where t is 1e16; and NumPy's tangent is the fastest of the three.
    """
    t = np.tan(0.5 * q)
    r = 2.0 / (1.0 + t * t)
    return Chunk(q, r - 1.0, t * r)


def rows_of(at: Axes, n: int) -> Array:
    """Return the upper three rows of n poses, one after the other, (12, n)."""
    rows = np.empty((12, n))
    for row, number in zip(rows, _numbers(at), strict=True):
        row[:] = number
    return rows


def _numbers(at: Axes) -> list[Number]:
    return [number for row in zip(*at, strict=True) for number in row]


def rounded(R: Array) -> Array:
    """Return R with entries that rounding keeps from -1, 0 and 1 put right."""
    nearest = np.round(R)
    return np.where(np.abs(R - nearest) < ROUNDING, nearest, R)


def frame_with_z(axis: Array) -> Array:
    """Return some rotation whose third column is the unit axis, (3, 3)."""
    x = np.cross(np.eye(3)[np.argmin(np.abs(axis))], axis)
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(axis, x), axis])
