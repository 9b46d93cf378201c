"""What Day 2's functions are asked, and what a right answer is.

The truth comes from `robo47.screws` (tested against MuJoCo, Pinocchio and the
textbook's package), never from the lab script. Arrays and floats only.
"""

from functools import cache

import numpy as np

from labkit.judge import Ask, Matrix, Pose, Probe, Rotation, Twist, draw
from robo47 import kinematics, panda, screws, se3

from .mistakes import halves, places
from .mistakes.brackets import SKEW
from .mistakes.frames import ADJOINT, BODY_SCREWS
from .mistakes.lines import JOINT_SCREWS, SCREW_AXIS
from .mistakes.links import DH_LINK
from .mistakes.motions import EXP_SCREW
from .mistakes.products import FK_BODY, FK_SPACE
from .mistakes.tables import DH_FK, FRANKA
from .mistakes.turns import EXP_ROTATION

JOINTS = tuple(f"the screw of joint{i}" for i in range(1, 8))
TWIST = ("omega x", "omega y", "omega z", "v x", "v y", "v z")
Z = np.array([0.0, 0.0, 1.0])
POINT = np.array([1.0, 0.0, 0.0])
OBLIQUE = np.array([0.0, 0.6, 0.8])
MOTIONS = (
    ((0, 0, 1, 0, -1, 0), np.pi / 2),
    ((0, 0, 1, 0, 0, 0), 1.1),
    ((0, 1, 0, -0.333, 0, 0), -0.8),
    ((1, 0, 0, 0, 0, 0.2), 2.3),
    ((0, 0, 0, 0.6, 0, 0.8), 4.0),
    ((0, 0.6, 0.8, 0.3, -0.2, 0.5), 4.0),
    ((0, 0.6, -0.8, 0.1, 0.5, 0.4), 1e-4),
    ((0.6, 0, 0.8, -0.2, 0.4, 0.7), -5e-3),
)
FAR = np.array([0.3, -0.4, 0.5, -1.2, 0.6, 3.5, -0.7])  # joint6 goes to 3.75
LINKS = [f"body:link{i}" for i in range(1, 8)]


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
    """Return axes of length 1 and angles: the coordinate axes, then drawn ones.

    Some angles are small and one is beyond pi: the formula needs no case of its own.
    One angle comes with two axes, so that no cache can take it for the whole question.
    """
    axes = [Z, *np.eye(3), Z, *[OBLIQUE] * 3, *draw.units(rng, 6)]
    angles = [np.pi / 2, 0.5, -1.2, 2.5, 3.3, 1e-4, -5e-3, 0.5, 0.0]
    angles += map(float, draw.numbers(rng, -3, 3, 5))
    return list(zip(axes, angles, strict=True))


def _hinges(rng):
    axes = [Z, *np.eye(3), *draw.units(rng, 5)]
    points = [POINT, *draw.numbers(rng, -1, 1, 8, 3)]
    return list(zip(axes, points, strict=True))


def _motions(rng):
    """Return hinges, slides, and screws that turn and move along, with angles.

    Hinges through the origin and about x, y and z; angles beyond pi, and small ones.
    """
    drawn = np.hstack([draw.units(rng, 8), draw.numbers(rng, -1, 1, 8, 3)])
    drawn[[0, 3], :3] = 0.0
    angles = draw.numbers(rng, -3, 3, 8)
    return [(np.array(S, dtype=float), theta) for S, theta in MOTIONS] + [
        (S, float(theta)) for S, theta in zip(drawn, angles, strict=True)
    ]


def _links(rng):
    return [(_panda()[2],), *((draw.poses(rng, 7),) for _ in range(7))]


def _arms(rng):
    """Return the Panda at q = 0 and elsewhere, then arms nobody has seen."""
    S, M, _ = _panda()
    own = [(S, M, q) for q in (draw.ZERO, FAR, *draw.configurations(rng, 4))]
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
    own = [(FRANKA, q) for q in (draw.ZERO, FAR, *draw.configurations(rng, 5))]
    others = draw.numbers(rng, -1.5, 1.5, 4, 8, 3)
    return own + list(zip(others, draw.numbers(rng, -2, 2, 4, 7), strict=True))


def _dh_fk(table, q):
    """Return the product for each table and its q, (n, 4, 4)."""
    return np.array([screws.dh_fk(one, x) for one, x in zip(table, q, strict=True)])


NEAR = 1e-5  # further off is wrong, not only rounded

SCREWS = Matrix((7, 6), rows=JOINTS, columns=TWIST)


def _chain(inputs, truth, mistakes) -> Ask:
    return Ask(
        inputs,
        Pose(wrong_way="maps the world to the end effector"),
        truth=truth,
        mistakes=mistakes,
        near=NEAR,
        probe=Probe(places.alone(inputs)),
        unnamed=places.unnamed,
        measured=places.measured,
    )


def _plain(inputs, kind, truth, mistakes) -> Ask:
    return Ask(inputs, kind, truth=truth, mistakes=mistakes, near=NEAR)


def _table(inputs, truth, mistakes) -> Ask:
    return Ask(
        inputs,
        SCREWS,
        truth=truth,
        mistakes=mistakes,
        near=NEAR,
        unnamed=halves.which_half,
    )


QUESTIONS = {
    "skew": _plain(_vectors, Matrix((3, 3)), screws.skew, SKEW),
    "exp_rotation": _plain(_turns, Rotation(), se3.axis_angle, EXP_ROTATION),
    "screw_axis": Ask(
        _hinges,
        Twist(),
        truth=screws.screw_axis,
        mistakes=SCREW_AXIS,
        near=NEAR,
        unnamed=halves.turned_round,
    ),
    "exp_screw": _plain(_motions, Pose(), screws.exp_screw, EXP_SCREW),
    "joint_screws": _table(_links, screws.joint_screws, JOINT_SCREWS),
    "fk_space": _chain(_arms, screws.fk_space, FK_SPACE),
    "adjoint": _plain(_poses, Matrix((6, 6)), screws.adjoint, ADJOINT),
    "body_screws": _table(_without_q, screws.body_screws, BODY_SCREWS),
    "fk_body": _chain(_seen_by_the_hand, screws.fk_body, FK_BODY),
    "dh_link": _plain(_rows, Pose(), screws.dh_link, DH_LINK),
    "dh_fk": Ask(
        _tables,
        Pose(wrong_way="maps the world to the flange"),
        truth=_dh_fk,
        mistakes=DH_FK,
        near=NEAR,
        unnamed=places.unnamed_row,
        measured=places.measured,
    ),
}
