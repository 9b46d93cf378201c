"""Frames near the flange that are mistaken for the end effector.

The chain is right, but ends in another frame than the one asked for:
inv(T_true) @ T_student is the same at every q, and that constant has a name.
"""

import numpy as np

from labkit.judge.matrices import pose, rigid_inverse
from robo47 import se3

from .panda_chain import FLANGE_POS, FLANGE_QUAT, PATH, fk

R = se3.quat_to_R(FLANGE_QUAT)
NOWHERE = np.zeros(3)
FLANGE = pose(R, FLANGE_POS)
TO_HAND = pose(se3.Rz(np.pi), NOWHERE)
BACK = rigid_inverse(FLANGE)  # to link7
# Along the z of `hand`, metres.
FINGER, TIP = (pose(np.eye(3), np.array([0.0, 0.0, z])) for z in (0.0584, 0.1034))
ENDS = {  # by slug, T_end_student
    "hand-for-attachment-site": TO_HAND,
    "finger-for-the-end": TO_HAND @ FINGER,
    "fingertip-for-the-end": TIP,
    "stops-at-link7": BACK,
    "flange-not-turned": BACK @ pose(np.eye(3), FLANGE_POS),
    "flange-turned-backwards": BACK @ pose(R.T, FLANGE_POS),
    "flange-turned-by-45": BACK @ pose(se3.Rz(np.pi / 4), FLANGE_POS),
    "flange-not-moved": BACK @ pose(R, NOWHERE),
    "flange-twice": FLANGE,
}
HANDS_TIP = TO_HAND @ TIP
ALL = [*ENDS.items(), ("fingertip-for-the-end", HANDS_TIP)]


def elsewhere(model, q, path=PATH):
    """hand-for-attachment-site: your code returns the pose of `hand`, which is a body
      of another model. Return the pose of `attachment_site` instead. The two frames
      differ by a rotation of 180 degrees about z
    finger-for-the-end: your code returns the pose of a finger. The model `panda_nohand`
      has no fingers, so the chain should end at `attachment`
    fingertip-for-the-end: your code returns the pose of the tool centre point between
      the fingertips. The model `panda_nohand` has no fingers, so the chain should end
      at `attachment`
    stops-at-link7: your code ends the chain at link7. Multiply by the fixed transform
      from link7 to the end effector as well
    flange-not-turned: your position is correct, but your code omits the rotation of
      `attachment` relative to link7
    flange-turned-backwards: your position is correct, but your code rotates
      `attachment` in the wrong direction. Use the rotation that the `quat` of
      `attachment` represents
    flange-turned-by-45: your position is correct, but your code rotates `attachment` by
      45 degrees. Use the rotation that the `quat` of `attachment` represents
    flange-not-moved: your rotation is correct, but your code omits the offset of
      `attachment` from link7
    flange-twice: your code applies the transform from link7 to the end effector twice.
      Apply it only once
    """
    T = fk(model, q, path)
    return {slug: T @ end for slug, end in ENDS.items()}


def fingertip_for_the_end(model, q, path=PATH):
    """your code returns the pose of the tool centre point between the fingertips. The
    model `panda_nohand` has no fingers, so the chain should end at `attachment`"""
    return fk(model, q, path) @ HANDS_TIP
