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
    yield np.eye(3, dtype=int), np.array([0.5, 0.2, -1.7])  # R holds whole numbers
    yield from zip(rng.rotations(5), moves, strict=True)


@row.wrongs(hidden={"type-of-R": "the lab's rotations hold no whole numbers alone"})
def _(R, t):
    """move-then-turn: your translation is R t. The translation should be t, because a
      pose first rotates a point and then translates it by t
    t-turned-back: your translation is R^T t. The translation should be t, because t is
      already expressed in the frame to which T maps
    type-of-R: your array has the dtype of R. If R has an integer dtype, as `np.eye(3,
      dtype=int)` does, NumPy truncates the entries of t to whole numbers. Create an
      array of floats instead
    """
    whole = np.array_equal(R, np.round(R))
    return {
        "move-then-turn": pose(R, R @ t),
        "t-turned-back": pose(R, R.T @ t),
        "type-of-R": pose(R, np.trunc(t) if whole else t),
    }


row.of_answer(of_a_pose())


@row.right  # In Fortran's order in memory, and through the transpose.
def _(R, t):
    T = np.zeros((4, 4), order="F")
    T.T[:3, :3] = np.transpose(R)
    T.T[3, :3] = t
    T.T[3, 3] = 1
    return T


row.spans(  # as small, or as large, as in the lab
    t=(lambda t: 0.06 * t,),
)
