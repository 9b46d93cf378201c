"""The film of Day 4, recorded by the site: let go, floating, floating and pushed."""

import numpy as np
from day4_dynamics import PUSH, RATE, READY_Q, gravity_torque

from labkit.inspector.recording import AWAY, FRAMES, Recording
from robo47 import panda, simulate

LENGTH = 0.02  # m of an arrow per newton
# Share of the weight that is held, seconds, newtons in the first half second.
PARTS = (
    ("let go", 0.0, 1.0, 0 * PUSH),
    ("floating on gravity_torque", 1.0, 2.0, 0 * PUSH),
    ("floating, pushed for half a second", 1.0, 4.0, PUSH),
)


def floating() -> Recording:
    """Return the arm on none of its gravity torque, on all of it, and pushed."""
    model = panda.load("panda_nohand", drive="torque")
    arm = panda.arm(model)
    film = Recording(panda.load("panda_nohand", meshes=True), back=1.4)
    arrow = film.draw.arrows([[np.zeros(3), np.full(3, 1e-3)]], "red", 0.012)
    for says, share, seconds, force in PARTS:

        def hold(t: float, q, qd, share=share):
            now = arm.at(q)
            given = now.J_space, arm.masses, now.coms_world, arm.gravity
            return share * gravity_torque(*given)

        data = simulate.start(model, READY_Q)
        for frame in range(int(seconds * FRAMES)):
            on = force * (frame < FRAMES / 2)
            push = simulate.push_at("attachment_site", [0.0, 0.0, 0.0, *on])
            until = (frame + 1) / FRAMES
            while data.time < until:
                simulate.run(model, data, hold, 1 / RATE, rate=RATE, push=push)
            film.pose(data.qpos)
            hand = arm.at(data.qpos).T_world_ee[:3, 3]
            end = hand if on.any() else AWAY[:3, 3]
            ends = np.array([[end - LENGTH * force - 1e-3, end]])
            arrow.points = ends.astype(np.float32)
            film.say(says)
            film.wait()
    return film


FILMS = {"float": floating}
