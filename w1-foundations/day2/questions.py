"""What Day 2's functions are asked, and what a right answer is.

The truth comes from `robo47.screws` (tested against MuJoCo, Pinocchio and the
textbook's package), never from the lab script. Arrays and floats only.
"""

from functools import cache

import numpy as np

from robo47 import kinematics, panda, screws, se3
from robo47.diagnose import Ask, Matrix, Pose, Rotation, Twist, draw

JOINTS = tuple(f"the screw of joint{i}" for i in range(1, 8))
TWIST = ("omega x", "omega y", "omega z", "v x", "v y", "v z")
Z = np.array([0.0, 0.0, 1.0])
POINT = np.array([1.0, 0.0, 0.0])
LINKS = [f"body:link{i}" for i in range(1, 8)]
# Franka's published table: alpha, a, d.
FRANKA = np.array([
    [0.0, 0.0, 0.333],
    [-np.pi / 2, 0.0, 0.0],
    [np.pi / 2, 0.0, 0.316],
    [np.pi / 2, 0.0825, 0.0],
    [-np.pi / 2, -0.0825, 0.384],
    [np.pi / 2, 0.0, 0.0],
    [np.pi / 2, 0.088, 0.0],
    [0.0, 0.0, 0.107],
])  # fmt: skip


@cache
def _panda():
    """Return the Panda's screws, M, and link poses at q = 0."""
    model = panda.load("panda_nohand")
    poses = kinematics.fk_all(model, np.zeros(7))
    links = np.array([poses[name] for name in LINKS])
    return panda.screws(model), panda.home_pose(model), links


def _vectors(rng):
    return [(Z,), *((w,) for w in draw.numbers(rng, -2, 2, 8, 3))]


def _turns(rng):
    """Return axes of length 1 and angles: the coordinate axes, then drawn ones."""
    axes = [Z, *np.eye(3), *draw.units(rng, 6)]
    angles = [np.pi / 2, 0.5, -1.2, 2.5, 0.0, *map(float, draw.numbers(rng, -3, 3, 5))]
    return list(zip(axes, angles, strict=True))


def _hinges(rng):
    axes = [Z, *np.eye(3), *draw.units(rng, 5)]
    points = [POINT, *draw.numbers(rng, -1, 1, 8, 3)]
    return list(zip(axes, points, strict=True))


def _motions(rng):
    """Return a hinge, slides, and screws that turn and move along, with angles."""
    drawn = np.hstack([draw.units(rng, 8), draw.numbers(rng, -1, 1, 8, 3)])
    drawn[[0, 3], :3] = 0.0
    angles = [np.pi / 2, *map(float, draw.numbers(rng, -3, 3, 8))]
    return list(zip([np.array([0, 0, 1, 0, -1.0, 0]), *drawn], angles, strict=True))


def _links(rng):
    return [(_panda()[2],), *((draw.poses(rng, 7),) for _ in range(7))]


def _arms(rng):
    """Return the Panda at q = 0 and elsewhere, then arms nobody has seen."""
    S, M, _ = _panda()
    own = [(S, M, q) for q in (draw.ZERO, *draw.configurations(rng, 4))]
    q = draw.numbers(rng, -2, 2, 5, 7)
    return own + [(*arm, x) for arm, x in zip(_others(rng, 5), q, strict=True)]


def _others(rng, n):
    """Return n arms of seven hinges: their screws and M."""
    return [
        (screws.screw_axis(draw.units(rng, 7), draw.numbers(rng, -1, 1, 7, 3)), T)
        for T in draw.poses(rng, n)
    ]


def _seen_by_the_hand(rng):
    return [(screws.body_screws(S, M), M, q) for S, M, q in _arms(rng)]


def _poses(rng):
    move = np.eye(4)
    move[0, 3] = 1.0
    return [(move,), *((T,) for T in draw.poses(rng, 8))]


def _without_q(rng):
    S, M, _ = _panda()
    return [(S, M), *_others(rng, 8)]


def _rows(rng):
    case = (np.pi / 2, 0.0, 0.316, 0.0)
    table = [(*map(float, FRANKA[3]), 0.4), (*map(float, FRANKA[4]), -1.3)]
    drawn = draw.numbers(rng, -1.5, 1.5, 7, 4)
    return [case, *table, *(tuple(map(float, row)) for row in drawn)]


def _tables(rng):
    """Return Franka's table at q = 0 and elsewhere, then other robots' tables."""
    own = [(FRANKA, q) for q in (draw.ZERO, *draw.configurations(rng, 5))]
    others = draw.numbers(rng, -1.5, 1.5, 4, 8, 3)
    return own + list(zip(others, draw.numbers(rng, -2, 2, 4, 7), strict=True))


def _dh_fk(table, q):
    """Return the product for each table and its q, (n, 4, 4)."""
    return np.array([screws.dh_fk(one, x) for one, x in zip(table, q, strict=True)])


NEAR = 1e-5

QUESTIONS = {
    "skew": Ask(_vectors, Matrix((3, 3)), truth=screws.skew, near=NEAR),
    "exp_rotation": Ask(_turns, Rotation(), truth=se3.axis_angle, near=NEAR),
    "screw_axis": Ask(_hinges, Twist(), truth=screws.screw_axis, near=NEAR),
    "exp_screw": Ask(_motions, Pose(), truth=screws.exp_screw, near=NEAR),
    "joint_screws": Ask(
        _links,
        Matrix((7, 6), rows=JOINTS, columns=TWIST),
        truth=screws.joint_screws,
        near=NEAR,
    ),
    "fk_space": Ask(_arms, Pose(), truth=screws.fk_space, near=NEAR),
    "adjoint": Ask(_poses, Matrix((6, 6)), truth=screws.adjoint, near=NEAR),
    "body_screws": Ask(
        _without_q,
        Matrix((7, 6), rows=JOINTS, columns=TWIST),
        truth=screws.body_screws,
        near=NEAR,
    ),
    "fk_body": Ask(_seen_by_the_hand, Pose(), truth=screws.fk_body, near=NEAR),
    "dh_link": Ask(_rows, Pose(), truth=screws.dh_link, near=NEAR),
    "dh_fk": Ask(_tables, Pose(), truth=_dh_fk, near=NEAR),
}
