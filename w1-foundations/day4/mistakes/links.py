"""Mistakes in task 4.2 `link_inertias(T_links, masses, coms, inertias)`."""

from collections.abc import Callable

import numpy as np

from robo47.checks import Array
from robo47.diagnose.matrices import transposed
from robo47.diagnose.mistake import Mistake, lifted

from .bodies import RIGHT, SPATIAL_INERTIA


def _times(R: Array, x: Array) -> Array:
    return (R @ x[..., None])[..., 0]


def _carried(
    com: Callable[..., Array] = lambda R, p, c: _times(R, c) + p,
    about: Callable[..., Array] = lambda R, own: R @ own @ transposed(R),
    inertia: Callable[..., Array] = RIGHT,
) -> Callable[..., Array]:
    """Return link_inertias with other parts."""

    def redo(T: Array, masses: Array, coms: Array, inertias: Array) -> Array:
        R, p = T[..., :3, :3], T[..., :3, 3]
        return inertia(masses, com(R, p, coms), about(R, inertias))

    return redo


def _first_pose(T: Array, *body: Array) -> Array:
    return _carried()(np.repeat(T[:, :1], T.shape[1], axis=1), *body)


def _still(R: Array, I: Array) -> Array:  # noqa: E741
    return I


def _own_com(R: Array, p: Array, c: Array) -> Array:
    return c


LINK_INERTIAS = [
    Mistake(
        "left-in-link-axes",
        "the inertias are where the links' own frames are: T_links is not used",
        _carried(_own_com, _still),
        "spatial_inertia of what was given",
    ),
    Mistake(
        "com-in-link-axes",
        "the centre of mass is used as it comes, in the link's own axes",
        _carried(_own_com),
        "the answer with c as it comes",
    ),
    Mistake(
        "com-not-turned",
        "the centre of mass is shifted by the link's place, but not turned with it",
        _carried(lambda R, p, c: c + p),
        "the answer with c + p",
    ),
    Mistake(
        "com-not-shifted",
        "the centre of mass is turned with the link, but the link's place is missing",
        _carried(lambda R, p, c: _times(R, c)),
        "the answer with R c",
    ),
    Mistake(
        "com-turned-back",
        "the centre of mass is turned the wrong way, from the world to the link",
        _carried(lambda R, p, c: _times(transposed(R), c) + p),
        "the answer with R^T c + p",
    ),
    Mistake(
        "com-seen-from-the-link",
        "the pose is used the wrong way round: it maps the link to the world",
        _carried(lambda R, p, c: _times(transposed(R), c - p)),
        "the answer with R^T (c - p)",
    ),
    Mistake(
        "origin-for-com",
        "the mass sits at the link's origin; it sits at its centre of mass",
        _carried(lambda R, p, c: p),
        "the answer with p alone",
    ),
    Mistake(
        "inertia-not-turned",
        "the inertia about the centre of mass is still in the link's axes",
        _carried(about=_still),
        "the answer with I as it comes",
    ),
    Mistake(
        "inertia-turned-back",
        "the inertia is turned the wrong way: this would take it from the world to the "
        "link",
        _carried(about=lambda R, own: transposed(R) @ own @ R),
        "the answer with R^T I R",
    ),
    Mistake(
        "inertia-turned-once",
        "the inertia is multiplied by R on one side only; a matrix that takes one "
        "vector to another has both to turn",
        _carried(about=lambda R, own: R @ own),
        "the answer with R I",
    ),
    Mistake(
        "first-pose-for-all",
        "every link is taken to be where the first one is",
        _first_pose,
        "the answer with the first pose seven times",
    ),
    Mistake(
        "already-summed",
        "each matrix holds the links beyond it as well; here each stands for one link",
        lambda *given: np.cumsum(_carried()(*given)[:, ::-1], axis=1)[:, ::-1],
        "the sum from each link to the tip",
    ),
    *lifted(
        SPATIAL_INERTIA,
        "in each link's matrix ",
        lambda inertia: _carried(inertia=inertia),
    ),
]
