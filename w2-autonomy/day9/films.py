"""The film of Day 9, recorded by the site: a push, and the residual of each joint."""

import day9_estimation as lab
import numpy as np

from labkit.inspector.recording import FRAMES, Recording
from robo47 import panda

import day9_mujoco

BEFORE, AFTER = 0.06, 0.16  # s, of the push
SLOWER = 25.0  # times
LENGTH = 0.06  # m per N m
BASE = 0.08  # m, of a bar without a residual


def pushed() -> Recording:
    """Return the push of 10 N on the flange, slowed down, with a bar per joint."""
    model = panda.load("panda_nohand", drive="torque")
    arm = panda.arm(model)
    push = day9_mujoco.push(lab.FLANGE, lab.FORCE, lab.SINCE)
    run = day9_mujoco.moved(
        model, arm, day9_mujoco.STAY, lab.SINCE + AFTER + 0.01, push
    )
    residual = lab.felt(arm, run)
    film = Recording(panda.load("panda_nohand", meshes=True), back=1.2)
    nothing = np.zeros((7, 2, 3), np.float32) - 50
    quiet = film.draw.lines(nothing, (90, 170, 230), 6.0)
    loud = film.draw.lines(nothing, (240, 150, 40), 8.0)
    arrow = film.draw.arrows(nothing[:1] + np.array([[0], [0.1]]), "red", 0.012)
    film.say("")
    for t in np.arange(lab.SINCE - BEFORE, lab.SINCE + AFTER, 1 / FRAMES / SLOWER):
        k = round(t / lab.DT)
        film.pose(run.q[k])
        now = arm.at(run.q[k])
        bars = bars_of(now, residual[k])
        high = np.abs(residual[k]) > lab.THRESHOLD
        quiet.points = np.where(high[:, None, None], nothing, bars)
        loud.points = np.where(high[:, None, None], bars, nothing)
        at = now.T_world_ee[:3, 3] + [0, 0, 0.16]
        ends = np.array([[at - 0.02 * lab.FORCE, at]], np.float32)
        arrow.points = ends if t >= lab.SINCE else nothing[:1]
        largest = int(np.abs(residual[k]).argmax())
        told = f"joint {largest + 1}: {residual[k, largest]:.1f} N m"
        ms = 1000 * (t - lab.SINCE)
        film.say(f"{ms:.0f} ms after the push, {told}" if ms >= 0 else "no push yet")
        film.wait()
    film.wait(1.0)
    return film


def bars_of(now, residual: np.ndarray) -> np.ndarray:
    """Return a bar along each joint's axis, longer with its residual, (7, 2, 3)."""
    long = BASE + LENGTH * np.abs(residual)
    axes = now.T_links[:, :3, 2] * long[:, None]
    places = now.T_links[:, :3, 3]
    return np.stack([places - axes, places + axes], axis=1).astype(np.float32)


FILMS = {"pushed": pushed}
