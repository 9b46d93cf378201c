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
    """com-in-link-axes: your code uses the centre of mass in the link frame. Transform
      the centre of mass into the world frame with T
    com-turned-back: your code rotates the centre of mass with R^T, which rotates from
      the world frame to the link frame. The correct rotation is R, which rotates from
      the link frame to the world frame
    com-seen-from-the-link: your code transforms the centre of mass with the inverse of
      T. Use T itself, which maps link coordinates to world coordinates
    inertia-not-turned: your inertia about the centre of mass is still expressed in the
      link frame. Rotate the inertia into the world frame
    inertia-turned-back: your matrices contain R^T I R instead of R I R^T, which
      expresses the inertia in the world frame
    inertia-diagonal: your code uses only the diagonal of each inertia matrix. Use all
      entries, because the axes of the link frame are in general not the principal axes
    R-transposed: your code transposes R for the centre of mass and for the inertia. The
      correct rotation is R itself, which rotates from the link frame to the world frame
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
    """left-in-link-axes: each of your matrices is expressed in its link frame.
      Transform each matrix into the world frame with T_links
    adjoint-not-inverted: your code returns Ad(T) G Ad(T)^T. The factor on the right of
      G should map a twist from the world frame to the link frame. The factor on the
      left should be the transpose of the factor on the right
    origin-for-com: your code places each link's mass at the origin of the link frame.
      Place this mass at the link's centre of mass
    poses-multiplied: your code multiplies the poses along the arm. Use each pose
      unchanged, because the poses in T_links are already relative to the world
    last-link-for-all: all seven of your matrices belong to link7. Each matrix should
      belong to its own link. Does your loop overwrite one array and append this array
      for every link?
    already-summed: your code adds the inertias of all later links to each link's
      matrix. Each matrix should contain only the inertia of its own link
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
    """your code uses the pose of the previous link for each link. The pose of link1 is
    `T_links[0]`, so use `T_links[i]` for the matrix with index i"""
    return link_inertias([np.eye(4), *T_links[:-1]], *body)


row.reached_by("spatial_inertia", "in each link's matrix, ")

row.at_least_0(masses="a mass")
