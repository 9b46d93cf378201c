"""The film of Day 2, recorded by the site: one screw motion after the other."""

import numpy as np
from day2_screws import READY_Q, fk_space, joint_screws

from labkit.inspector.recording import FRAMES, Recording
from robo47 import kinematics, panda

HALF, SECONDS = 0.22, 1.2  # m of an axis to either side; a screw's time
OVER = (0.0, 0.0, 1.3)  # m


def screws() -> Recording:
    """Return the arm from q = 0 to ready, the last joint's screw first."""
    model = panda.load("panda_nohand")
    at_zero = kinematics.fk_all(model, np.zeros(7))
    links = np.array([at_zero[f"body:link{i}"] for i in range(1, 8)])
    S = joint_screws(links)
    M_home = at_zero["site:attachment_site"]
    film = Recording(panda.load("panda", meshes=True), back=1.6)
    reach = HALF * S[:, None, :3] * np.array([[-1.0], [1.0]])
    axes = links[:, None, :3, 3] + reach  # (7, 2, 3)
    film.draw.arrows(axes, "grey")
    lit = film.draw.arrows(axes[6:], "orange", 0.012)
    end = film.draw.frame("", M_home)
    for done in np.arange(-0.4, 7.8, 1 / (SECONDS * FRAMES)):
        i = int(np.clip(6 - np.floor(done), 0, 6))
        q = np.clip(done - np.arange(7)[::-1], 0.0, 1.0) * READY_Q
        film.pose(q)
        end.place(fk_space(S, M_home, q))
        lit.points = axes[i : i + 1].astype(np.float32)
        film.say(f"screw {i + 1}: e^[S{i + 1}] q{i + 1} moves all distal to it", OVER)
        film.wait()
    return film


FILMS = {"screws": screws}
