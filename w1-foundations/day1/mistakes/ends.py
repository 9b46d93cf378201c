"""The chain is right, but ends in another frame than the one asked for.

inv(T_true) @ T_student is then the same at every q, and that constant has a name.
"""

from dataclasses import replace

import numpy as np

from labkit.judge.matrices import pose, rigid_inverse, split, transposed
from labkit.judge.mistake import Mistake
from robo47 import se3
from robo47.checks import Array

from .arm import Arm

FINGER_Z, FINGERTIP_Z = 0.0584, 0.1034  # metres from `hand`, along its z


def wrong_ends(arm: Arm) -> list[Mistake]:
    """Return the frames near the flange that are taken for the end effector.

    Args:
        arm: the chain to `attachment_site`.
    """
    return [
        Mistake(slug, says, lambda q, end=end: arm.fk(q) @ end, redone)
        for slug, says, end, redone in _frames(arm)
    ]


def wrong_lengths(arm: Arm, whole: Arm) -> list[Mistake]:
    """Return the chains that stop at, or go on to, another body than the last.

    Args:
        arm: the chain asked for.
        whole: the chain to the end effector.
    """
    out = []
    for k, name in enumerate(whole.names, start=1):
        to_there, unturned = whole.upto(k), replace(whole.upto(k), joints=k - 1)
        short = k < len(arm.names)
        slug, verb = (
            ("stops-early", "stops at") if short else ("too-long", "goes on to")
        )
        if k != len(arm.names):
            says = f"your chain {verb} {to_there.end}; it should end at {arm.end}"
            out.append(Mistake(slug, says, to_there.fk, f"the pose of {to_there.end}"))
        if short:
            says = f"your chain stops at {name}, before that one's joint turns it"
            out.append(Mistake(slug, says, unturned.fk, f"{name}, unturned"))
    return out


def _frames(arm: Arm) -> list[tuple[str, str, Array, str]]:
    """Return slug, words, T_end_student and what to call it, per frame."""
    R, t = split(pose(se3.quat_to_R(arm.quat[-1]), arm.pos[-1]))
    flange, nowhere = pose(R, t), np.zeros(3)
    back = rigid_inverse(flange)
    to_hand, ahead = pose(se3.Rz(np.pi), nowhere), np.array([0.0, 0.0, 1.0])
    tip = pose(np.eye(3), FINGERTIP_Z * ahead)
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
            to_hand @ pose(np.eye(3), FINGER_Z * ahead),
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
            back @ pose(transposed(R), t),
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
