"""1.1 `make_T(R, t)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Pose, Row
from labkit.judge.answer_mistakes import of_a_pose
from labkit.judge.matrices import pose

from .panda_chain import NEAR

row = Row(Pose(), near=NEAR)


@row.inputs
def _(rng):
    moves = rng.numbers(-2, 2, 5, 3)
    yield np.eye(3), np.array([1.0, 2.0, 3.0])
    yield from zip(rng.rotations(5), moves, strict=True)


@row.wrongs
def _(R, t):
    """move-then-turn: the translation comes out turned by R: you move first and turn
      after, where a pose turns first
    t-turned-back: the translation comes out turned by R backwards: t is already in the
      outer frame
    """
    return {"move-then-turn": pose(R, R @ t), "t-turned-back": pose(R, R.T @ t)}


row.of_answer(of_a_pose())


@row.right  # In Fortran's order in memory, and through the transpose.
def _(R, t):
    T = np.zeros((4, 4), order="F")
    T.T[:3, :3] = np.transpose(R)
    T.T[3, :3] = t
    T.T[3, 3] = 1
    return T
