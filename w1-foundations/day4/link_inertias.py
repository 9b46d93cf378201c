"""4.2 `link_inertias(T_links, masses, coms, inertias)`: its questions and mistakes."""
# ruff: noqa: E741 (I is what the field calls an inertia)

from functools import partial
from itertools import accumulate

import numpy as np

from labkit.judge import Row
from labkit.judge.kinds import Kind
from robo47.dynamics import link_inertias, spatial_inertia
from robo47.screws import adjoint

from .states import arm, solids, states

row = Row(Kind((7, 6, 6)))


@row.inputs
def _(rng):
    """Give unrotated links, the Panda's links, then links of no robot."""
    body = (arm().masses, arm().coms, arm().inertias)
    yield np.tile(np.eye(4), (7, 1, 1)), *body
    yield from ((now.T_links, *body) for now in states(rng, 5))
    for _ in range(4):
        poses = rng.poses(7)
        masses = rng.numbers(0.2, 5, 7)
        yield poses, masses, rng.numbers(-0.5, 0.5, 7, 3), solids(rng, 7)


def carried(
    T_links,
    masses,
    coms,
    inertias,
    com=lambda R, p, c: R @ c + p,
    about=lambda R, I: R @ I @ R.T,
):
    """Return link_inertias with another centre of mass, another inertia about it."""
    bodies = zip(T_links[:, :3, :3], T_links[:, :3, 3], masses, coms, inertias)
    placed = [spatial_inertia(m, com(R, p, c), about(R, I)) for R, p, m, c, I in bodies]
    return np.array(placed)


@row.wrongs
def _(T_links, masses, coms, inertias):
    """com-in-link-axes: the centre of mass is used in the link frame; transform it to
      the world frame with T => the answer with c unchanged
    com-turned-back: the centre of mass is rotated with R^T, which rotates from the
      world frame to the link frame => the answer with R^T c + p
    com-seen-from-the-link: the centre of mass is transformed with the inverse of T; T
      maps the link frame to the world frame => the answer with R^T (c - p)
    inertia-not-turned: the inertia about the centre of mass is still expressed in the
      link frame; rotate it to the world frame => the answer with I unchanged
    inertia-turned-back: the inertia is R^T I R, which rotates from the world frame to
      the link frame => the answer with R^T I R
    inertia-diagonal: only the diagonal of each inertia is used; the link frame need not
      be aligned with the principal axes => the answer with the diagonal of I
    R-transposed: R is transposed for the centre of mass and for the inertia; R^T
      rotates from the world frame to the link frame => the answer with R^T for R
    """

    def back(R, I):
        return R.T @ I @ R

    others = {
        "com-in-link-axes": {"com": lambda R, p, c: c},
        "com-turned-back": {"com": lambda R, p, c: R.T @ c + p},
        "com-seen-from-the-link": {"com": lambda R, p, c: R.T @ (c - p)},
        "inertia-not-turned": {"about": lambda R, I: I},
        "inertia-turned-back": {"about": back},
        "inertia-diagonal": {"about": lambda R, I: R @ np.diag(np.diag(I)) @ R.T},
        "R-transposed": {"com": lambda R, p, c: R.T @ c + p, "about": back},
    }
    given = partial(carried, T_links, masses, coms, inertias)
    return {slug: partial(given, **one) for slug, one in others.items()}


@row.wrongs
def _(T_links, masses, coms, inertias):
    """left-in-link-axes: T_links is not used, so each matrix is expressed in its link
      frame => spatial_inertia of what was given
    adjoint-not-inverted: the result is Ad(T) G Ad(T)^T. G maps a twist to a momentum,
      so its right factor should map a twist from the world frame to the link frame
    origin-for-com: the mass is placed at the link's origin; it belongs at the centre of
      mass => the answer with p alone
    poses-multiplied: the poses are multiplied along the arm, but each T of T_links is
      already relative to the world => the answer with the product of the poses up to
      each link
    last-link-for-all: all seven matrices belong to link7. Does your loop fill the same
      array for every link and append it each time? Create a new array => link7's matrix
      seven times
    already-summed: each matrix also contains the links beyond its own; each should
      belong to one link => the sum from each link to the tip
    """

    def placed(T, c=coms):
        return link_inertias(T, masses, c, inertias)

    own = spatial_inertia(masses, coms, inertias)
    Ad = adjoint(T_links)
    return {
        "left-in-link-axes": own,
        "adjoint-not-inverted": Ad @ own @ np.swapaxes(Ad, 1, 2),
        "origin-for-com": lambda: placed(T_links, 0 * coms),
        "poses-multiplied": lambda: placed(list(accumulate(T_links, np.matmul))),
        "last-link-for-all": lambda: placed(T_links)[[6] * 7],
        "already-summed": lambda: np.cumsum(placed(T_links)[::-1], axis=0)[::-1],
    }


@row.wrong
def pose_of_the_link_before(T_links, *body):
    """each link uses the pose of the link before it: T_links[0] belongs to link1 => the
    answer with the identity for link1, its pose for link2 and so on"""
    return link_inertias([np.eye(4), *T_links[:-1]], *body)


row.reached_by("spatial_inertia", "in each link's matrix ")

row.at_least_0(masses="a mass")
