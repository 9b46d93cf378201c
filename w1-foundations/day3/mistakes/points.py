"""Mistakes in tasks 3.2 and 3.9: `site_jacobian` and `body_jacobian`.

`redo` takes J_space (n, 6, 7) with p (n, 3) or T (n, 4, 4).
"""

import numpy as np

from labkit.judge.matrices import transposed
from labkit.judge.mistake import Mistake
from robo47 import jacobian
from robo47.checks import Array
from robo47.screws import adjoint


def site(J: Array, p: Array, sign: float = 1.0, v: float = 1.0) -> Array:
    """Return J with v replaced by v + sign omega x p, (n, 6, 7)."""
    cross = np.cross(J[:, :3], p[:, :, None], axis=1)
    return np.concatenate([J[:, :3], v * J[:, 3:] + sign * cross], axis=1)


SITE = [
    Mistake(
        "space-for-site",
        "this is J_space still: its v is the velocity at the world's origin, not at p",
        lambda J, p: J,
        "J_space itself",
    ),
    Mistake(
        "cross-sign",
        "the sign of the cross product is wrong: a spin about z takes (1, 0, 0) to +y",
        lambda J, p: site(J, p, -1.0),
        "the Jacobian with v - omega x p",
    ),
    Mistake(
        "v-dropped",
        "v is only omega x p; the v that J_space has is left out",
        lambda J, p: site(J, p, 1.0, 0.0),
        "the Jacobian with omega x p alone",
    ),
    Mistake(
        "halves-read-as-v-omega",
        "the upper rows of J_space are taken for v, and the lower ones for omega",
        lambda J, p: np.roll(site(np.roll(J, 3, axis=1), p), 3, axis=1),
        "the Jacobian with the halves read the other way",
    ),
    Mistake(
        "v-cross-p",
        "v x p is added, where omega x p belongs",
        lambda J, p: np.concatenate(
            [J[:, :3], J[:, 3:] + np.cross(J[:, 3:], p[:, :, None], axis=1)], axis=1
        ),
        "the Jacobian with v + v x p",
    ),
    Mistake(
        "omega-changed",
        "omega is changed by v x p; all points of a body have the same omega",
        lambda J, p: np.concatenate(
            [J[:, :3] + np.cross(J[:, 3:], p[:, :, None], axis=1), J[:, 3:]], axis=1
        ),
        "the Jacobian with the cross product above",
    ),
]


def _turned(J: Array, T: Array) -> Array:
    """Return both halves in the hand's axes."""
    back = transposed(T[:, :3, :3])
    return np.concatenate([back @ J[:, :3], back @ J[:, 3:]], axis=1)


BODY = [
    Mistake(
        "adjoint-of-T",
        "T leads from the hand to the world; here the twists are to be taken back",
        lambda J, T: adjoint(T) @ J,
        "the Jacobian with Ad(T)",
    ),
    Mistake(
        "space-for-body",
        "this is J_space still, as the world sees it",
        lambda J, T: J,
        "J_space itself",
    ),
    Mistake(
        "site-for-body",
        "this is J_site: the velocity of the right point, but in the world's axes",
        lambda J, T: jacobian.site_jacobian(J, T[:, :3, 3]),
        "J_site",
    ),
    Mistake(
        "rotation-only",
        "J_space is turned into the hand's axes, but v is still that of the point at "
        "the world's origin",
        _turned,
        "J_space in the hand's axes",
    ),
    Mistake(
        "transposed-adjoint",
        "this is Ad(T) transposed; the inverse of an adjoint is not its transpose",
        lambda J, T: transposed(adjoint(T)) @ J,
        "the Jacobian with that transpose",
    ),
    Mistake(
        "turned-by-R",
        "J_site is turned by R, which leads from the hand's axes to the world's; the "
        "way back is R^T",
        lambda J, T: _turned(jacobian.site_jacobian(J, T[:, :3, 3]), transposed(T)),
        "J_site turned by R",
    ),
]
