"""The film of Day 3, recorded by the site: a circle that leaves the workspace."""

import numpy as np
from day3_jacobian_ik import DAMPING, DT, RADIUS, draw_circle, fk_space

from labkit.inspector.recording import Recording
from robo47 import panda

import day3_mujoco

COLOURS = ("blue", "red")
WILD = 12.0  # rad/s, of any joint: faster than the eye


def singularity() -> Recording:
    """Return the circle with damping; without it, until the joints are too fast."""
    model = panda.load("panda_nohand")
    arm = panda.screws(model), panda.home_pose(model)
    limits = model.jnt_range[:7]
    path, q = day3_mujoco.circle(
        arm, limits, RADIUS, np.arange(0.0, day3_mujoco.LAP, DT)
    )
    film = Recording(panda.load("panda", meshes=True), back=1.5)
    film.draw.curve(path[:, :3, 3], "grey", 2.0)
    pens = [film.draw.curve(path[:2, :3, 3], colour, 5.0) for colour in COLOURS]
    film.say("")
    for pen in pens:  # also when the film begins again
        pen.points = path[None, :2, :3, 3].astype(np.float32)
    for damping, line in zip((DAMPING, 0.0), pens, strict=True):
        off, speeds, angles = draw_circle(arm, path, q, damping)
        wild = np.flatnonzero(speeds.max(axis=1) > WILD)
        end = min(len(angles), wild[0] + 15) if len(wild) else len(angles)
        drawn = np.array([fk_space(*arm, one)[:3, 3] for one in angles[:end]])
        for k in range(2, end, 2):
            film.pose(angles[k])
            line.points = np.stack([drawn[:k], drawn[1 : k + 1]], 1).astype(np.float32)
            fastest = speeds[k].max()
            how = f"damping {damping:g}" if damping else "no damping"
            film.say(f"{how}: {off[k]:.0f} mm off, {fastest:.1f} rad/s")
            film.wait(2 * DT)
        film.wait(1.0)
    return film


FILMS = {"singularity": singularity}
