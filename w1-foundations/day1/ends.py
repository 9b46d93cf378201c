"""Frames near the flange that are taken for the end effector.

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
    """hand-for-attachment-site: your pose is that of `hand`, which another model has;
      this one ends in `attachment_site`, half a turn about z from it at every q => the
      pose of `hand`
    finger-for-the-end: your pose is that of a finger; the chain ends at the flange =>
      the pose of a finger
    fingertip-for-the-end: your pose is where fingertips would be (a TCP); this Panda
      has no hand and ends at the flange => the pose 103.4 mm further on
    stops-at-link7: your chain stops at link7: from there to the end effector it is one
      more fixed step, the same at every q => the pose of link7
    flange-not-turned: your pose is in the right place, but the flange's own turn is
      missing at every q => the right one without that turn
    flange-turned-backwards: your pose is in the right place, but the flange is turned
      the wrong way at every q => the right one with that turn reversed
    flange-turned-by-45: your pose is in the right place, but the flange is turned by 45
      degrees, which is not its turn => the right one turned by 45 deg
    flange-not-moved: R is right, but the flange's distance from link7 is missing at
      every q => the right one without it
    flange-twice: the step from link7 to the end effector is in it twice => the right
      one with that step twice
    """
    T = fk(model, q, path)
    return {slug: T @ end for slug, end in ENDS.items()}


def fingertip_for_the_end(model, q, path=PATH):
    """your pose is where fingertips would be (a TCP); this Panda has no hand and ends
    at the flange => the pose 103.4 mm further on"""
    return fk(model, q, path) @ HANDS_TIP
