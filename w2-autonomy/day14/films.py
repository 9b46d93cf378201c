"""The film of Day 14, recorded by the site: one cube is held, another slips."""

import mujoco
import numpy as np

from labkit.inspector.recording import FRAMES, Recording
from labkit.lesson.day import find_day
from robo47 import panda, scenes, se3

import day14_mujoco

EVERY = 2  # samples of 10 ms in a frame: 0.4 times the real speed


def slip() -> Recording:
    """Return two lifts with the same policy, and the height of the cube."""
    figures = find_day(14).module("figures")
    T = panda.arm(panda.load("panda_nohand")).at(panda.READY_Q).T_world_ee
    tcp = (T @ se3.make_T(np.eye(3), scenes.TCP))[:3, 3]
    half = day14_mujoco.HALF

    def edit(spec: mujoco.MjSpec) -> None:
        box = mujoco.mjtGeom.mjGEOM_BOX
        cube = spec.worldbody.add_body(name="cube")
        cube.add_freejoint(name="cube")
        cube.add_geom(type=box, size=(half,) * 3, rgba=(0.9, 0.55, 0.1, 1))
        top = tcp - [0, 0, half + 0.005]
        spec.worldbody.add_geom(
            type=box, size=(0.15, 0.15, 0.005), pos=top, rgba=(0.5, 0.4, 0.3, 1)
        )

    film = Recording(panda.load("panda", meshes=True, edit=edit), back=1.0)
    for mu in figures.GRIPS:
        q, cube, _ = figures.lifted(mu)
        for k in range(0, len(q), EVERY):
            place = [*(tcp + cube[k] - cube[0]), 1.0, 0.0, 0.0, 0.0]
            film.pose([*q[k], *place])
            up = 1000 * (cube[k, 2] - cube[0, 2])
            film.say(f"friction {mu}: the cube is {up:.0f} mm up")
            film.wait(1.5 / FRAMES)
        film.wait(1.0)
    return film


FILMS = {"slip": slip}
