"""The film of Day 10, recorded by the site: a camera that joint 7 cannot judge."""

import day10_camera as lab
import mujoco
import numpy as np

from labkit.inspector.recording import FRAMES, Recording
from labkit.lesson.day import find_day
from robo47 import camera as library
from robo47 import panda, scenes

import day10_mujoco

SECONDS = 0.8  # from pose to pose
AWAY = np.full((1, 2, 3), -50.0, np.float32)


def calibrated() -> Recording:
    """Return eight poses of joint 7 alone, then eight of all joints.

    Blue is the ray of the true camera to the middle of the table, and red is where the
    wrong camera puts this point.
    """
    figures = find_day(10).module("figures")
    wrong = library.apply_twist(day10_mujoco.ON_HAND, lab.FREE)

    def edit(spec: mujoco.MjSpec) -> None:
        top = (*scenes.TABLE_CENTRE, day10_mujoco.TABLE - 0.005)
        box = mujoco.mjtGeom.mjGEOM_BOX
        half = (*scenes.TABLE_HALF, 0.005)
        spec.worldbody.add_geom(type=box, size=half, pos=top, rgba=(0.5, 0.4, 0.3, 1))

    film = Recording(panda.load("panda_nohand", meshes=True, edit=edit), back=1.3)
    true = film.draw.lines(AWAY, (90, 170, 230), 4.0)
    said = film.draw.lines(AWAY, (230, 60, 50), 4.0)
    film.say("")
    tries = (
        ("joint 7 alone", np.eye(7)[6], lab.SEED),
        ("all joints", np.ones(7), lab.SEED + 1),
    )
    for name, joints, seed in tries:
        q, hands, eyes = figures.poses(joints, seed)
        points = lab.said(hands, eyes, wrong)
        for k in range(len(q) - 1):
            for part in np.linspace(0.0, 1.0, int(SECONDS * FRAMES)):
                film.pose(q[k] + part * (q[k + 1] - q[k]))
                film.wait()
            hand = hands[k + 1]
            ends = [(hand @ day10_mujoco.ON_HAND)[:3, 3], day10_mujoco.TO]
            true.points = np.array([ends], np.float32)
            ends = [(hand @ wrong)[:3, 3], points[k + 1]]
            said.points = np.array([ends], np.float32)
            mm = 1000 * np.linalg.norm(points[k + 1] - points[0])
            film.say(f"{name}: the point has moved by {mm:.0f} mm")
            film.wait(0.5)
            true.points = said.points = AWAY
    return film


FILMS = {"calibrated": calibrated}
