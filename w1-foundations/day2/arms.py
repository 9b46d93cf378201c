"""Arms of seven hinges that Day 2 asks about: the Panda, and some nobody has seen."""

from functools import cache

import numpy as np

from labkit.judge import Matrix
from robo47 import kinematics, panda, screws

JOINTS = tuple(f"the screw of joint{i}" for i in range(1, 8))
TWIST = ("omega_x", "omega_y", "omega_z", "v_x", "v_y", "v_z")
SCREWS = Matrix((7, 6), rows=JOINTS, columns=TWIST)
FAR = np.array([0.3, -0.4, 0.5, -1.2, 0.6, 3.5, -0.7])  # joint6 goes to 3.75
LINKS = [f"body:link{i}" for i in range(1, 8)]
# Franka's published table: alpha, a, d.
FRANKA = np.array([
    [0.0, 0.0, 0.333],
    [-np.pi / 2, 0.0, 0.0],
    [np.pi / 2, 0.0, 0.316],
    [np.pi / 2, 0.0825, 0.0],
    [-np.pi / 2, -0.0825, 0.384],
    [np.pi / 2, 0.0, 0.0],
    [np.pi / 2, 0.088, 0.0],
    [0.0, 0.0, 0.107],
])  # fmt: skip


@cache
def the_panda():
    """Return the Panda's screws, M, and link poses at q = 0."""
    model = panda.load("panda_nohand")
    poses = kinematics.fk_all(model, np.zeros(7))
    links = np.array([poses[name] for name in LINKS])
    return panda.screws(model), panda.home_pose(model), links


def others(rng, n):
    """Return n arms of seven hinges: their screws and M."""
    return [
        (screws.screw_axis(rng.units(7), rng.numbers(-1, 1, 7, 3)), T)
        for T in rng.poses(n)
    ]


def arms(rng):
    """Return screws, M and q: the Panda at q = 0 and elsewhere, then other arms."""
    S, M, _ = the_panda()
    own = [(S, M, q) for q in (np.zeros(7), FAR, *rng.configurations(4))]
    q = rng.numbers(-2, 2, 5, 7)
    return own + [(*arm, x) for arm, x in zip(others(rng, 5), q, strict=True)]
