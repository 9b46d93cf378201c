"""1.5 `link_T(pos, quat)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Pose, Row
from labkit.judge.matrices import pose
from robo47 import se3

from .panda_chain import NEAR
from .quat_to_R import quaternions

UNIT = "the lab's model has unit quaternions"

row = Row(
    Pose(), truth=lambda pos, quat: se3.make_T(se3.quat_to_R(quat), pos), near=NEAR
)


@row.inputs
def _(rng):
    quats = quaternions(rng)
    return list(zip(rng.numbers(-1, 1, len(quats), 3), quats, strict=True))


row.reached_by("make_T")
row.reached_by("quat_to_R", hidden={"not-normalised": UNIT})


@row.close("rounded-somewhere")  # float32 in one place, float64 around it.
def _(pos, quat):
    w, x, y, z = quat / np.linalg.norm(quat)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]], dtype=np.float32)
    return pose(np.eye(3) + 2 * (w * cross + cross @ cross), pos)


row.spans(  # as small, or as large, as in the lab
    pos=(lambda pos: 0.1 * pos,),
)
