"""The film of Day 11, recorded by the site: a motion whose samples all miss a wire."""

import mujoco
import numpy as np

from labkit.inspector.recording import FRAMES, Recording
from labkit.lesson.day import find_day
from robo47 import panda, shapes

import day11_mujoco

SECONDS = 5.0  # of the whole motion
PAUSE = 1.5  # s, at the contact


def strobe() -> Recording:
    """Return the motion: a pen stays behind at each sample, and the contact is red."""
    figures = find_day(11).module("figures")
    edge = figures.missed_edge()
    dots = np.linspace(0.0, 1.0, figures.POINTS + 2)
    s = np.sort(np.append(dots, np.linspace(0.0, 1.0, int(SECONDS * FRAMES))))
    far = day11_mujoco.far(edge, s)
    touch = int(np.argmin(far))

    def edit(spec: mujoco.MjSpec) -> None:
        shapes.World.of([edge.wire]).add_to(spec)
        shapes.add_arm(spec, [shapes.PEN])

    film = Recording(panda.load("panda_nohand", meshes=True, edit=edit), back=1.3)
    pens = day11_mujoco.pen(edge.q + dots[:, None] * edge.dq).astype(np.float32)
    left = film.draw.lines(pens[:1], (60, 150, 230), 4.0)
    hit = film.draw.lines(np.full((1, 2, 3), -50.0), (230, 60, 50), 9.0)
    film.say("")
    left.points, hit.points = pens[:1], np.full((1, 2, 3), -50.0, np.float32)
    for k, now in enumerate(s):
        q = edge.q + now * edge.dq
        film.pose(q)
        done = int(np.sum(dots <= now))
        left.points = pens[:done]
        film.say(f"samples: {done}, no contact; {1000 * far[k]:.0f} mm away")
        if k == touch:
            hit.points = day11_mujoco.pen(q)[None].astype(np.float32)
            film.say(f"contact between two samples: {1000 * far[k]:.0f} mm")
            film.wait(PAUSE)
        film.wait()
    film.say(f"{len(dots)} samples: no contact was found")
    film.wait(1.0)
    return film


FILMS = {"strobe": strobe}
