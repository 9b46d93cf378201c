"""Frames near the flange that are taken for the end effector.

The chain is right, but ends in another frame than the one asked for:
inv(T_true) @ T_student is the same at every q, and that constant has a name.
"""

import numpy as np

from labkit.judge.matrices import pose, rigid_inverse
from robo47 import se3
from robo47.checks import Array

from .panda_chain import FLANGE_POS, FLANGE_QUAT

FINGER_Z, FINGERTIP_Z = 0.0584, 0.1034  # metres from `hand`, along its z


def ahead(z: float) -> Array:
    """Return a step along z, metres, (4, 4)."""
    return pose(np.eye(3), np.array([0.0, 0.0, z]))


def frames() -> list[tuple[str, str, Array, str]]:
    """Return slug, words, T_end_student and what to call it, per frame."""
    R, t, nowhere = se3.quat_to_R(FLANGE_QUAT), FLANGE_POS, np.zeros(3)
    flange = pose(R, t)
    back = rigid_inverse(flange)
    to_hand, tip = pose(se3.Rz(np.pi), nowhere), ahead(FINGERTIP_Z)
    placed = "your pose is in the right place, but "
    return [
        (
            "hand-for-attachment-site",
            "your pose is that of `hand`, which another model has; this one ends in "
            "`attachment_site`, half a turn about z from it at every q",
            to_hand,
            "the pose of `hand`",
        ),
        (
            "finger-for-the-end",
            "your pose is that of a finger; the chain ends at the flange",
            to_hand @ ahead(FINGER_Z),
            "the pose of a finger",
        ),
        *(
            (
                "fingertip-for-the-end",
                "your pose is where fingertips would be (a TCP); this Panda has no "
                "hand and ends at the flange",
                end,
                "the pose 103.4 mm further on",
            )
            for end in (tip, to_hand @ tip)
        ),
        (
            "stops-at-link7",
            "your chain stops at link7: from there to the end effector it is one more "
            "fixed step, the same at every q",
            back,
            "the pose of link7",
        ),
        (
            "flange-not-turned",
            f"{placed}the flange's own turn is missing at every q",
            back @ pose(np.eye(3), t),
            "the right one without that turn",
        ),
        (
            "flange-turned-backwards",
            f"{placed}the flange is turned the wrong way at every q",
            back @ pose(R.T, t),
            "the right one with that turn reversed",
        ),
        (
            "flange-turned-by-45",
            f"{placed}the flange is turned by 45 degrees, which is not its turn",
            back @ pose(se3.Rz(np.pi / 4), t),
            "the right one turned by 45 deg",
        ),
        (
            "flange-not-moved",
            "R is right, but the flange's distance from link7 is missing at every q",
            back @ pose(R, nowhere),
            "the right one without it",
        ),
        (
            "flange-twice",
            "the step from link7 to the end effector is in it twice",
            flange,
            "the right one with that step twice",
        ),
    ]


FRAMES = frames()
SLUGS = {slug for slug, *_ in FRAMES}
