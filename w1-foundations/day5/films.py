"""The film of Day 5, recorded by the site: an error decays, and a loop breaks."""

import numpy as np
from day5_control import E0, OMEGA, RATE, READY_Q, equal_springs, run

from labkit.inspector.recording import AWAY, FRAMES, Recording
from robo47 import panda, references

BROKEN = 240.0  # rad/s: RATE is too slow for it
SEEN = 1e-3  # of a pose: a link that is off by less would flicker through its ghost


def chatter() -> Recording:
    """Return 0.1 rad of error going away at OMEGA; then springs that are too stiff."""
    model = panda.load("panda_nohand", drive="torque")
    arm, hold = panda.arm(model), references.hold(READY_Q)
    film = Recording(panda.load("panda_nohand", meshes=True))
    there, ghost = film.poses(READY_Q), film.draw.ghost("blue")
    for omega, start in ((OMEGA, READY_Q - E0), (BROKEN, READY_Q - 0.1 * E0)):
        log = run(model, arm, equal_springs(omega), hold, 2.5, start=start)
        for t in np.arange(0.0, 2.5, 1 / FRAMES):
            k = int(t * RATE)
            film.pose(log.q[k])
            here = film.poses(log.q[k])
            ghost.pose({
                link: T if np.abs(T - here[link]).max() > SEEN else AWAY
                for link, T in there.items()
            })  # fmt: skip
            off = 1e3 * np.abs(log.q[k] - READY_Q).max()
            film.say(f"omega {omega:.0f} rad/s, {RATE:.0f} Hz: error {off:.1f} mrad")
            film.wait()
    return film


FILMS = {"error_curves": chatter}
