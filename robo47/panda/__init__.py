"""The Franka Emika Panda: load it, name its configurations, tell where it is from.

Entries, as the MuJoCo Menagerie names its files:

    panda_nohand   the arm, ending in `attachment_site` (7 numbers in qpos)
    panda          the arm with `hand` and two fingers (9 numbers)
    scene          `panda` on a floor, with lights: what a viewer opens

Where no Menagerie is to be had, the kit's own mesh-free twin takes its place. Each
entry has the Menagerie's servos (position drives), or seven motors that take torques.
Units: metres, radians, newton metres.
"""

from robo47.panda.loading import (
    ARM_JOINTS,
    DRIVES,
    END_FRAME,
    READY_Q,
    describe,
    home_q,
    load,
    provenance,
)
from robo47.panda.reading import arm, hand_inertia, home_pose, inertias, screws

__all__ = [
    "ARM_JOINTS", "DRIVES", "END_FRAME", "READY_Q", "arm", "describe", "hand_inertia",
    "home_pose", "home_q", "inertias", "load", "provenance", "screws",
]  # fmt: skip
