"""4.2 `link_inertias(T_links, masses, coms, inertias)`: its questions and mistakes."""
# ruff: noqa: E741 (I is what the field calls an inertia)

from itertools import accumulate

import numpy as np

from labkit.judge import draw
from labkit.judge.kinds import Kind
from labkit.judge.row import Row
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
        poses, masses = draw.poses(rng, 7), draw.numbers(rng, 0.2, 5, 7)
        yield poses, masses, draw.numbers(rng, -0.5, 0.5, 7, 3), solids(rng, 7)


def carried(
    T_links,
    masses,
    coms,
    inertias,
    com=lambda R, p, c: R @ c + p,
    about=lambda R, I: R @ I @ R.T,
):
    """Return link_inertias with another centre of mass, another inertia about it."""
    return np.array(
        [
            spatial_inertia(m, com(T[:3, :3], T[:3, 3], c), about(T[:3, :3], I))
            for T, m, c, I in zip(T_links, masses, coms, inertias)
        ]
    )


for slug, says, redone, other in (
    (
        "com-in-link-axes",
        "the centre of mass is used as it comes, in the link's own axes",
        "the answer with c as it comes",
        {"com": lambda R, p, c: c},
    ),
    (
        "com-not-turned",
        "the centre of mass is shifted by the link's place, but not turned with it",
        "the answer with c + p",
        {"com": lambda R, p, c: c + p},
    ),
    (
        "com-not-shifted",
        "the centre of mass is turned with the link, but the link's place is missing",
        "the answer with R c",
        {"com": lambda R, p, c: R @ c},
    ),
    (
        "com-turned-back",
        "the centre of mass is turned the wrong way, from the world to the link",
        "the answer with R^T c + p",
        {"com": lambda R, p, c: R.T @ c + p},
    ),
    (
        "com-seen-from-the-link",
        "the pose is used the wrong way round: it maps the link to the world",
        "the answer with R^T (c - p)",
        {"com": lambda R, p, c: R.T @ (c - p)},
    ),
    (
        "inertia-not-turned",
        "the inertia about the centre of mass is still in the link's axes",
        "the answer with I as it comes",
        {"about": lambda R, I: I},
    ),
    (
        "inertia-turned-back",
        "the inertia is turned the wrong way: this would take it from the world to the "
        "link",
        "the answer with R^T I R",
        {"about": lambda R, I: R.T @ I @ R},
    ),
    (
        "inertia-turned-once",
        "the inertia is multiplied by R on one side only; a matrix that takes one "
        "vector to another has both to turn",
        "the answer with R I",
        {"about": lambda R, I: R @ I},
    ),
    (
        "second-R-not-transposed",
        "the inertia is R I R; what takes a vector from the world to the link first "
        "is not R",
        "the answer with R I R",
        {"about": lambda R, I: R @ I @ R},
    ),
    (
        "R-transposed",
        "R is transposed, for the centre and for the inertia: this turns both the "
        "wrong way, from the world to the link",
        "the answer with R^T for R",
        {"com": lambda R, p, c: R.T @ c + p, "about": lambda R, I: R.T @ I @ R},
    ),
):

    @row.wrong(slug, says, redone)
    def _(T_links, masses, coms, inertias, other=other):
        return carried(T_links, masses, coms, inertias, **other)


@row.wrong
def left_in_link_axes(T_links, masses, coms, inertias):
    """the inertias are where the links' own frames are: T_links is not used =>
    spatial_inertia of what was given"""
    return spatial_inertia(masses, coms, inertias)


@row.wrong
def pose_inverted(T_links, masses, coms, inertias):
    """T is used the wrong way round, for the centre and for the inertia: it maps the
    link to the world. With adjoints: what stands on the right of G has to take a twist
    from the world to the link => the answer with the inverse of T, which is Ad(T)^T G
    Ad(T),"""
    return link_inertias(np.linalg.inv(T_links), masses, coms, inertias)


@row.wrong
def adjoint_not_inverted(T_links, masses, coms, inertias):
    """this is Ad(T) G Ad(T)^T; G takes a twist to a momentum, so what stands on its
    right has to take a twist from the world to the link => Ad(T) G Ad(T)^T"""
    G = spatial_inertia(masses, coms, inertias)
    return np.array([adjoint(T) @ G_i @ adjoint(T).T for T, G_i in zip(T_links, G)])


@row.wrong
def origin_for_com(T_links, masses, coms, inertias):
    """the mass sits at the link's origin; it sits at its centre of mass => the answer
    with p alone"""
    return link_inertias(T_links, masses, 0 * coms, inertias)


@row.wrong
def first_pose_for_all(T_links, masses, coms, inertias):
    """every link is taken to be where the first one is => the answer with the first
    pose seven times"""
    return link_inertias(T_links[[0] * 7], masses, coms, inertias)


FIRST = (lambda T: np.eye(4), "the identity"), (lambda T: T[-1], "link7's pose")
for first, whose in FIRST:
    row.wrong(
        "pose-of-the-link-before",
        "every link is taken to be where the link before it is: T_links[0] is link1's, "
        "as masses[0] is",
        f"the answer with {whose} for link1, its pose for link2 and so on",
    )(
        lambda T_links, *body, first=first: link_inertias(
            [first(T_links), *T_links[:-1]], *body
        )
    )


@row.wrong
def poses_multiplied(T_links, masses, coms, inertias):
    """the poses are multiplied along the arm; each T of T_links is seen from the world
    already => the answer with the product of the poses up to each link"""
    return link_inertias(list(accumulate(T_links, np.matmul)), masses, coms, inertias)


@row.wrong
def last_link_for_all(T_links, masses, coms, inertias):
    """all seven are link7's: is one array filled again for every link, and put into the
    list each time? Make a new one => link7's matrix seven times"""
    return link_inertias(T_links, masses, coms, inertias)[[6] * 7]


@row.wrong
def already_summed(T_links, masses, coms, inertias):
    """each matrix holds the links beyond it as well; here each stands for one link =>
    the sum from each link to the tip"""
    G = link_inertias(T_links, masses, coms, inertias)
    return np.array([G[i:].sum(axis=0) for i in range(7)])


row.reached_by("spatial_inertia", "in each link's matrix ")
