"""The film of Day 12, recorded by the site: plans with the hand omitted and without."""

import mujoco
import numpy as np

from labkit.inspector.recording import FRAMES, Recording
from labkit.lesson.day import find_day
from robo47 import panda, shapes

import day12_mujoco

SPEED = 1.2  # rad/s, of the joint that moves most
INSIDE = (200, 60, 50)


def hand() -> Recording:
    """Return both plans, one after the other, the path red if it collides."""
    figures = find_day(12).module("figures")
    wall = day12_mujoco.Wall()

    def edit(spec: mujoco.MjSpec) -> None:
        shapes.World.of(boxes=wall.boxes[:1]).add_to(spec)  # the roof would hide it
        shapes.add_arm(spec, [shapes.PEN])

    film = Recording(panda.load("panda_nohand", meshes=True, edit=edit), back=1.5)
    plans = [figures.planned(forget)[0] for forget in ((7,), ())]
    tips = [figures.pen(along)[:, 1] for along in plans]
    pens = [
        film.draw.curve(tip[:2], colour, 5.0)
        for tip, colour in zip(tips, (INSIDE, "blue"), strict=True)
    ]
    film.say("")
    for line, tip in zip(pens, tips, strict=True):  # also when it begins again
        line.points = np.stack([tip[:1], tip[1:2]], 1).astype(np.float32)
    names = "hand omitted", "whole arm"
    for name, along, tip, line in zip(names, plans, tips, pens, strict=True):
        for k in moments(along):
            film.pose(along[k])
            drawn = np.stack([tip[: k - 1 : 2], tip[2 : k + 1 : 2]], 1)
            line.points = drawn.astype(np.float32)
            far = 1000 * wall.apart(along[k], wall.pairs)
            where = f"{-far:.0f} mm INSIDE" if far < 0 else f"{far:.0f} mm away"
            film.say(f"{name}: {where}")
            film.wait()
        film.wait(1.0)
    return film


def moments(along: np.ndarray) -> np.ndarray:
    """Return even indices from 2 on, at which a joint has moved a frame further."""
    moved = np.concatenate([[0.0], np.abs(np.diff(along, axis=0)).max(axis=1).cumsum()])
    times = np.arange(0.0, moved[-1] / SPEED, 1 / FRAMES)
    found = np.searchsorted(moved, SPEED * times)
    return np.clip(found // 2 * 2, 2, (len(along) - 1) // 2 * 2)


FILMS = {"hand": hand}
