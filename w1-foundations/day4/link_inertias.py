"""4.2 `link_inertias(T_links, masses, coms, inertias)`: its questions and mistakes."""
# ruff: noqa: E741 (I is what the field calls an inertia)

from functools import partial
from itertools import accumulate

import numpy as np

from labkit.judge import Row
from labkit.judge.argument_mistakes import FIRST_FOR_ALL
from labkit.judge.kinds import Kind
from robo47.dynamics import link_inertias, spatial_inertia
from robo47.screws import adjoint

from .states import arm, solids, states

row = Row(Kind((7, 6, 6)))


@row.inputs
def _(rng):
    """Links that nobody has turned, the Panda's, then those of no robot."""
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
    """com-in-link-axes: the centre of mass is used as it comes, in the link's own axes
      => the answer with c as it comes
    com-not-turned: the centre of mass is shifted by the link's place, but not turned
      with it => the answer with c + p
    com-not-shifted: the centre of mass is turned with the link, but the link's place is
      missing => the answer with R c
    com-turned-back: the centre of mass is turned the wrong way, from the world to the
      link => the answer with R^T c + p
    com-seen-from-the-link: the pose is used the wrong way round: it maps the link to
      the world => the answer with R^T (c - p)
    inertia-not-turned: the inertia about the centre of mass is still in the link's axes
      => the answer with I as it comes
    inertia-turned-back: the inertia is turned the wrong way: this would take it from
      the world to the link => the answer with R^T I R
    inertia-turned-once: the inertia is multiplied by R on one side only; a matrix that
      takes one vector to another has both to turn => the answer with R I
    inertia-diagonal: only the diagonal of each inertia is used; a link's own axes need
      not be those in which the rest is 0 => the answer with the diagonal of I
    second-R-not-transposed: the inertia is R I R; what takes a vector from the world to
      the link first is not R => the answer with R I R
    R-transposed: R is transposed, for the centre and for the inertia: this turns both
      the wrong way, from the world to the link => the answer with R^T for R
    """

    def back(R, I):
        return R.T @ I @ R

    others = {
        "com-in-link-axes": {"com": lambda R, p, c: c},
        "com-not-turned": {"com": lambda R, p, c: c + p},
        "com-not-shifted": {"com": lambda R, p, c: R @ c},
        "com-turned-back": {"com": lambda R, p, c: R.T @ c + p},
        "com-seen-from-the-link": {"com": lambda R, p, c: R.T @ (c - p)},
        "inertia-not-turned": {"about": lambda R, I: I},
        "inertia-turned-back": {"about": back},
        "inertia-turned-once": {"about": lambda R, I: R @ I},
        "inertia-diagonal": {"about": lambda R, I: R @ np.diag(np.diag(I)) @ R.T},
        "second-R-not-transposed": {"about": lambda R, I: R @ I @ R},
        "R-transposed": {"com": lambda R, p, c: R.T @ c + p, "about": back},
    }
    given = partial(carried, T_links, masses, coms, inertias)
    return {slug: partial(given, **one) for slug, one in others.items()}


@row.wrongs
def _(T_links, masses, coms, inertias):
    """left-in-link-axes: the inertias are where the links' own frames are: T_links is
      not used => spatial_inertia of what was given
    pose-inverted: T is used the wrong way round, for the centre and for the inertia: it
      maps the link to the world. With adjoints: what stands on the right of G has to
      take a twist from the world to the link => the answer with the inverse of T, which
      is Ad(T)^T G Ad(T),
    adjoint-not-inverted: this is Ad(T) G Ad(T)^T; G takes a twist to a momentum, so
      what stands on its right has to take a twist from the world to the link
    origin-for-com: the mass sits at the link's origin; it sits at its centre of mass =>
      the answer with p alone
    poses-multiplied: the poses are multiplied along the arm; each T of T_links is seen
      from the world already => the answer with the product of the poses up to each link
    last-link-for-all: all seven are link7's: is one array filled again for every link,
      and put into the list each time? Make a new one => link7's matrix seven times
    already-summed: each matrix holds the links beyond it as well; here each stands for
      one link => the sum from each link to the tip
    """

    def placed(T, c=coms):
        return link_inertias(T, masses, c, inertias)

    own = spatial_inertia(masses, coms, inertias)
    Ad = adjoint(T_links)
    return {
        "left-in-link-axes": own,
        "pose-inverted": lambda: placed(np.linalg.inv(T_links)),
        "adjoint-not-inverted": Ad @ own @ np.swapaxes(Ad, 1, 2),
        "origin-for-com": lambda: placed(T_links, 0 * coms),
        "poses-multiplied": lambda: placed(list(accumulate(T_links, np.matmul))),
        "last-link-for-all": lambda: placed(T_links)[[6] * 7],
        "already-summed": lambda: np.cumsum(placed(T_links)[::-1], axis=0)[::-1],
    }


FIRST = (lambda T: np.eye(4), "the identity"), (lambda T: T[-1], "link7's pose")
for first, whose in FIRST:
    row.wrong(
        "pose-of-the-link-before",
        "every link is taken to be where the link before it is: T_links[0] is link1's, "
        "as masses[0] is",
        f"the answer with {whose} for link1, its pose for link2 and so on",
    )(lambda T, *body, first=first: link_inertias([first(T), *T[:-1]], *body))


row.of_argument("T_links", FIRST_FOR_ALL.called("first-pose-for-all"))
row.reached_by("spatial_inertia", "in each link's matrix ")

row.at_least_0(masses="a mass")
