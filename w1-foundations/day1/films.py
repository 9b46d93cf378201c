"""The film of Day 1, recorded by the site: one motion on the left, on the right."""

import numpy as np
from day1_transforms import READY_Q, Rz, compose_fk, inverse, make_T

from labkit.inspector.recording import AWAY, FRAMES, Recording
from robo47 import panda

HAND = ("hand", "left_finger", "right_finger")


def order() -> Recording:
    """Return T_extra growing on the left of T_world_ee, then on its right."""
    film = Recording(panda.load("panda", meshes=True))
    film.pose(READY_Q)
    there = film.poses(READY_Q)
    T_ee = compose_fk(panda.load("panda_nohand"), READY_Q)
    film.draw.frame("T_world_ee", T_ee)
    film.draw.frame("world", np.eye(4))
    ghost = film.draw.ghost("blue")
    end = film.draw.frame("", T_ee)
    for left in (True, False):
        for s in np.clip(np.arange(-0.3, 1.5, 0.5 / FRAMES), 0.0, 1.0):
            T_extra = make_T(Rz(s * np.pi / 4), np.array([s * 0.1, 0.0, 0.0]))
            # Seen from the world, a step in the tool's own axes is this motion.
            moved = T_extra if left else T_ee @ T_extra @ inverse(T_ee)
            ghost.pose({
                name: moved @ T if left or name in HAND else AWAY
                for name, T in there.items()
            })  # fmt: skip
            end.place(moved @ T_ee)
            film.say("T_extra @ T_world_ee" if left else "T_world_ee @ T_extra")
            film.wait()
    return film


FILMS = {"order": order}
