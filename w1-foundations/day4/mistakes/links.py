"""Mistakes in task 4.2 `link_inertias(T_links, masses, coms, inertias)`."""

from collections.abc import Callable

import numpy as np

from labkit.judge.matrices import transposed
from labkit.judge.mistake import Mistake, lifted
from robo47.checks import Array
from robo47.screws import skew

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


def _pose_before(first: Callable[[Array], Array]) -> Callable[..., Array]:
    """Return link_inertias with T of the link before; the first gets `first` of T."""

    def redo(T: Array, *body: Array) -> Array:
        return _carried()(np.concatenate([first(T), T[:, :-1]], axis=1), *body)

    return redo


def _chained(T: Array, *body: Array) -> Array:
    """Return link_inertias where each T is taken as one seen from the link before."""
    so_far = [T[:, 0]]
    for i in range(1, T.shape[1]):
        so_far.append(so_far[-1] @ T[:, i])
    return _carried()(np.stack(so_far, axis=1), *body)


def _adjoint_outside(T: Array, *body: Array) -> Array:
    """Return Ad(T) G Ad(T)^T of each link."""
    R, p = T[..., :3, :3], T[..., :3, 3]
    Ad = np.zeros((*T.shape[:-2], 6, 6))
    Ad[..., :3, :3] = Ad[..., 3:, 3:] = R
    Ad[..., 3:, :3] = skew(p) @ R
    return Ad @ RIGHT(*body) @ transposed(Ad)


def _last_of_all(T: Array, *body: Array) -> Array:
    G = _carried()(T, *body)
    return np.repeat(G[:, -1:], G.shape[1], axis=1)


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
        "pose-inverted",
        "T is used the wrong way round, for the centre and for the inertia: it maps "
        "the link to the world. With adjoints: what stands on the right of G has to "
        "take a twist from the world to the link",
        _carried(
            lambda R, p, c: _times(transposed(R), c - p),
            lambda R, own: transposed(R) @ own @ R,
        ),
        "the answer with the inverse of T, which is Ad(T)^T G Ad(T),",
    ),
    Mistake(
        "adjoint-not-inverted",
        "this is Ad(T) G Ad(T)^T; G takes a twist to a momentum, so what stands on its "
        "right has to take a twist from the world to the link",
        _adjoint_outside,
        "Ad(T) G Ad(T)^T",
    ),
    Mistake(
        "R-transposed",
        "R is transposed, for the centre and for the inertia: this turns both the "
        "wrong way, from the world to the link",
        _carried(
            lambda R, p, c: _times(transposed(R), c) + p,
            lambda R, own: transposed(R) @ own @ R,
        ),
        "the answer with R^T for R",
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
        "second-R-not-transposed",
        "the inertia is R I R; what takes a vector from the world to the link first "
        "is not R",
        _carried(about=lambda R, own: R @ own @ R),
        "the answer with R I R",
    ),
    Mistake(
        "first-pose-for-all",
        "every link is taken to be where the first one is",
        _first_pose,
        "the answer with the first pose seven times",
    ),
    *(
        Mistake(
            "pose-of-the-link-before",
            "every link is taken to be where the link before it is: T_links[0] is "
            "link1's, as masses[0] is",
            _pose_before(first),
            f"the answer with {called} for link1, its pose for link2 and so on",
        )
        for called, first in (
            ("the identity", lambda T: np.broadcast_to(np.eye(4), T[:, :1].shape)),
            ("link7's pose", lambda T: T[:, -1:]),
        )
    ),
    Mistake(
        "poses-multiplied",
        "the poses are multiplied along the arm; each T of T_links is seen from the "
        "world already",
        _chained,
        "the answer with the product of the poses up to each link",
    ),
    Mistake(
        "last-link-for-all",
        "all seven are link7's: is one array filled again for every link, and put "
        "into the list each time? Make a new one",
        _last_of_all,
        "link7's matrix seven times",
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
