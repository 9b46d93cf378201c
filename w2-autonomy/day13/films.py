"""The film of Day 13, recorded by the site: one circle, drawn with three methods."""

import day13_optimal as lab
import numpy as np

from labkit.inspector.recording import Recording
from labkit.lesson.day import find_day
from robo47 import panda

import day13_mujoco

EVERY = 3  # samples of a frame


def circles() -> Recording:
    """Return the clamped steps, then `qp_ik` with two weights of the orientation."""
    figures = find_day(13).module("figures")
    model = day13_mujoco.arm()
    times = np.arange(0.0, day13_mujoco.LAP, lab.DT)
    wanted = day13_mujoco.circle(model, lab.RADIUS, times)[0][:, :3, 3]
    methods = (
        ("Day 3's step, clamped", figures.clamped, "red"),
        ("qp_ik", lab.best_step(), "blue"),
        ("qp_ik, weight 0.01", lab.best_step(0.01), "green"),
    )
    film = Recording(panda.load("panda_nohand", meshes=True), back=1.4)
    film.draw.curve(wanted, "grey", 2.0)
    pens = [film.draw.curve(wanted[:2], colour, 5.0) for _, _, colour in methods]
    film.say("")
    for pen in pens:  # also when the film begins again
        pen.points = wanted[None, :2].astype(np.float32)
    for (name, step, _), pen in zip(methods, pens, strict=True):
        q, points, _ = figures.drawn(model, step)
        off = 1000 * np.linalg.norm(points[: len(wanted)] - wanted, axis=1)
        for k in range(EVERY, len(wanted), EVERY):
            film.pose(q[k])
            pen.points = np.stack([points[:k], points[1 : k + 1]], 1).astype(np.float32)
            film.say(f"{name}: at most {off[: k + 1].max():.0f} mm off")
            film.wait(EVERY * lab.DT / 1.5)
        film.wait(0.7)
    return film


FILMS = {"circles": circles}
