"""What Day 7's functions are asked, and what a right answer is.

The truth comes from `robo47.trajectory` (tested against SciPy, Ruckig, MuJoCo and the
textbook's examples), never from the lab script. Arrays and floats only.
"""

import numpy as np

from labkit.judge import Ask, Matrix, Pose, Scalar, Slip, Vector, draw
from robo47 import se3, trajectory
from robo47.simulate import ACC_LIMITS, SPEED_LIMITS

from .mistakes.cubes import CUBE
from .mistakes.durations import DURATION, NO_WAY, never_less
from .mistakes.grasps import GRASP
from .mistakes.lines import STRAIGHT
from .mistakes.loads import CARRY
from .mistakes.moves import JOINT_MOVE
from .mistakes.ramps import TRAPEZOID
from .mistakes.scalings import SCALING, by_quotients
from .mistakes.splines import COEFFICIENTS, which_condition
from .mistakes.turns import TURNS

NEAR = 1e-5
NO_LIMIT = 1e9  # rad/s2, in the docstring's case
JOINTS = tuple(f"joint{i}" for i in range(1, 8))
SCALED = ("s", "sd", "sdd")
RAMPS = ("the position", "the speed", "the acceleration")
TEN = ("the mass", "x", "y", "z", "xx", "yy", "zz", "xy", "xz", "yz")
POWERS = ("1", "t", "t^2", "t^3", "t^4", "t^5")
SINGULAR = Slip(
    "LinAlgError: Singular",
    "",
    "singular",
    "Two of the six rows say the same, so the equations have no single answer. Each "
    "row is another condition: a position, a speed or an acceleration, at "
    "either end. What is the derivative of t^n?",
)


def _floats(rows):
    return [tuple(map(float, row)) for row in rows]


def _times(rng, n):
    """Return times and durations: before, on the way, after, then drawn ones."""
    fixed = [(0.6, 2.0), (1.0, 2.0), (2.5, 2.0), (-0.4, 2.0), (0.5, 0.5), (0.9, 3.0)]
    T = draw.numbers(rng, 0.3, 4.0, n)
    t = draw.rounded(T * rng.uniform(0.02, 0.98, n))
    return _floats([*fixed, *zip(t, T, strict=True)])


def _ways(rng):
    """Return ways and limits: the docstring's, the Panda's, then drawn ones."""
    one = np.array([1.0, 0, 0, 0, 0, 0, 0])
    first = (one, np.full(7, 1.875), np.full(7, NO_LIMIT))
    panda = [(dq, SPEED_LIMITS, ACC_LIMITS) for dq in draw.numbers(rng, -2, 2, 3, 7)]
    short = (0.1 * panda[0][0], SPEED_LIMITS, ACC_LIMITS)
    drawn = zip(
        draw.numbers(rng, -2, 2, 6, 7),
        draw.numbers(rng, 0.5, 3, 6, 7),
        draw.numbers(rng, 2, 20, 6, 7),
        strict=True,
    )
    tiny = (1e-5 * panda[0][0], SPEED_LIMITS, ACC_LIMITS)
    return [first, *panda, short, tiny, *drawn]


def _moves(rng):
    times = _times(rng, 6)
    n = len(times)
    q0, q1 = draw.configurations(rng, n), draw.configurations(rng, n)
    rows = [(a, b, t, T) for a, b, (t, T) in zip(q0, q1, times, strict=True)]
    # Past pi, where only joint6 goes: a joint's angle is no direction.
    far = np.array([0.1, -0.4, 0.2, -1.8, 0.3, 3.7, 0.7])
    return [*rows[:6], (q0[0], far, 1.8, 2.0), (far, q1[0], 0.3, 2.0), *rows[6:]]


def _profiles(rng):
    """Return all pieces of a long move and of a short one, then drawn ones.

    Between them, two moves just too short and just long enough to reach v. Never at
    the moment when a piece ends: what the acceleration is there is a matter of taste.
    """
    long, short = (1.0, 0.5, 1.0), (0.1, 1.0, 2.0)
    fixed = [(t, *long) for t in (1.0, 0.3, 2.2, 3.0, -0.2)]
    fixed += [(t, *short) for t in (0.1, 0.3, 0.6)]
    fixed += [(0.6, L, 1.0, 2.0) for L in (0.48, 0.51)]  # v^2 / a is 0.5
    sizes = draw.numbers(rng, 0.3, 2.0, 6, 3)
    t = draw.numbers(rng, 0.1, 2.0, 6)
    return _floats([*fixed, *((x, *row) for x, row in zip(t, sizes, strict=True))])


def _states(rng):
    zero, one = np.zeros(3), np.array([1.0, 0.0, 0.0])
    first = [(zero, one, 1.0), (zero, one, 2.0)]
    start, end = draw.numbers(rng, -1, 1, 2, 8, 3)
    T = map(float, draw.numbers(rng, 0.5, 2.5, 8))
    quick = (np.array([0.02, -0.1, 0.3]), np.array([0.05, 0.1, -0.4]), 0.25)
    return [*first, quick, *zip(start, end, T, strict=True)]


def _ends(rng):
    """Return two poses and s: without a turn, at both ends, then drawn ones."""
    move = se3.make_T(np.eye(3), np.array([0.4, 0.0, 0.2]))
    first = [(np.eye(4), move, 0.5)]
    T0, T1 = draw.poses(rng, 9), draw.poses(rng, 9)
    s = [0.0, 1.0, *map(float, draw.numbers(rng, 0.05, 0.95, 7))]
    return [*first, *zip(T0, T1, s, strict=True)]


def _cubes(rng):
    """Return cubes at many yaws, none half way between two quarter turns.

    The first ones are typed: among them hardly any yaw, and no height at all.
    """
    quarters = np.arange(-2, 3)[rng.permutation(5)]
    yaw = quarters * np.pi / 2 + rng.uniform(-0.7, 0.7, 5)
    yaw = [np.radians(80.0), 0.3, -0.5, np.radians(-130.0), *draw.rounded(yaw)]
    place = draw.numbers(rng, 0.1, 0.7, len(yaw), 3)
    above = map(float, draw.numbers(rng, 0.02, 0.3, len(yaw)))
    rows = list(zip(se3.make_T(se3.Rz(np.array(yaw)), place), above, strict=True))
    p = np.array([0.55, -0.15, 0.22])
    low = [(np.radians(0.5), 0.0), (np.radians(-91.0), 0.005)]
    return [*rows[:4], *((se3.make_T(se3.Rz(a), p), h) for a, h in low), *rows[4:]]


def _bodies(rng):
    """Return pairs of bodies: two points, then drawn ones with full inertias."""
    none, two = np.zeros((3, 3)), np.array([2.0, 0.0, 0.0])
    first = [(1.0, np.zeros(3), none, 1.0, two, none)]
    m1, m2 = draw.numbers(rng, 0.2, 3.0, 2, 8)
    c1, c2 = draw.numbers(rng, -0.5, 0.5, 2, 8, 3)
    half = draw.numbers(rng, -0.5, 0.5, 2, 8, 3, 3)
    I1, I2 = draw.rounded(half @ np.swapaxes(half, -1, -2) + np.eye(3))
    rows = zip(map(float, m1), c1, I1, map(float, m2), c2, I2, strict=True)
    return [*first, *rows]


def _grips(rng):
    drawn = draw.numbers(rng, 0.1, 1.0, 9, 3) * [8.0, 1.5, 4.0]
    down = [(6.0, 1.4, -2.5), (3.0, 0.5, -6.0)]
    return _floats([(0.9247, 1.0, 0.0), *down, *draw.rounded(drawn)])


QUESTIONS = {
    "quintic_scaling": Ask(
        lambda rng: _times(rng, 7),
        Vector((3,), names=SCALED),
        truth=trajectory.quintic_scaling,
        mistakes=SCALING,
        near_miss=by_quotients,
        near=NEAR,
    ),
    "quintic_duration": Ask(
        _ways,
        Scalar(unit="s"),
        truth=trajectory.quintic_duration,
        mistakes=DURATION,
        unnamed=never_less,
        held_out=[NO_WAY],
        near=NEAR,
    ),
    "joint_move": Ask(
        _moves,
        Matrix((3, 7), rows=("q", "qd", "qdd"), columns=JOINTS),
        truth=trajectory.joint_move,
        mistakes=JOINT_MOVE,
        near=NEAR,
    ),
    "trapezoid": Ask(
        _profiles,
        Vector((3,), names=RAMPS),
        truth=trajectory.trapezoid,
        mistakes=TRAPEZOID,
        near=NEAR,
    ),
    "quintic_coefficients": Ask(
        _states,
        Vector((6,), names=tuple(f"the factor of {p}" for p in POWERS), scale=10.0),
        truth=trajectory.quintic_coefficients,
        mistakes=COEFFICIENTS,
        slips=[SINGULAR],
        unnamed=which_condition,
        near=NEAR,
    ),
    "straight_pose": Ask(
        _ends,
        Pose(),
        truth=trajectory.straight_pose,
        mistakes=STRAIGHT,
        held_out=TURNS,
        near=NEAR,
    ),
    "grasp_pose": Ask(
        _cubes, Pose(), truth=trajectory.grasp_pose, mistakes=GRASP, near=NEAR
    ),
    "carry": Ask(
        _bodies,
        Vector((10,), names=TEN),
        truth=trajectory.carry,
        mistakes=CARRY,
        near=NEAR,
    ),
    "heaviest_cube": Ask(
        _grips,
        Scalar(unit="kg", scale=0.1),
        truth=trajectory.heaviest_cube,
        mistakes=CUBE,
        near=NEAR,
    ),
}

# One thing with two names: the whole rotation at once is that of the last pose.
ALIKE = {"straight_pose": [{"whole-turn", "turned-at-once"}]}
