"""The film of Day 8, recorded by the site: the arm floats, with two models of it."""

import mujoco
import numpy as np

from labkit.inspector.recording import FRAMES, Recording
from labkit.lesson.day import find_day
from robo47 import panda


def floats() -> Recording:
    """Return two seconds of floating, for both loads in the model of gravity."""
    figures = find_day(8).module("figures")
    arm = panda.arm(panda.load("panda_nohand"))

    def edit(spec: mujoco.MjSpec) -> None:
        site = spec.site("attachment_site")
        box = mujoco.mjtGeom.mjGEOM_BOX
        at = np.array([0.0, 0.0, figures.lab.AT[2]]) + site.pos
        site.parent.add_geom(
            type=box, size=(0.035,) * 3, pos=at, rgba=(0.9, 0.55, 0.1, 1), mass=0
        )

    film = Recording(panda.load("panda_nohand", meshes=True, edit=edit), back=1.2)
    for name, run in figures.floating().items():
        start = arm.at(run.q[0]).T_world_ee[2, 3]
        step = max(1, round(len(run.q) / (2.0 * FRAMES)))
        for q in run.q[::step]:
            film.pose(q)
            rise = 1000 * (arm.at(q).T_world_ee[2, 3] - start)
            film.say(f"{name}: the hand has moved by {rise:.0f} mm")
            film.wait()
        film.wait(1.0)
    return film


FILMS = {"floats": floats}
