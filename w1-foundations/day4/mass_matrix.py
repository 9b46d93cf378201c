"""4.3 `mass_matrix(J, G, armature)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Symmetric, draw
from labkit.judge.row import Row
from robo47.dynamics import mass_matrix

from .states import hinge, states

row = Row(Symmetric((7, 7), "kg m2"))


@row.inputs
def _(rng):
    J, G, _, _ = hinge([0.0, 0.0, 1.0], 2.0)
    rotors = [np.full(7, 0.1)] * 5 + list(draw.numbers(rng, 0.02, 0.3, 5, 7))
    now = zip(states(rng), rotors)
    return [(J, G, rotors[0]), *((at.J_space, at.G, a) for at, a in now)]


def links(J, G, moves):
    """Return M without the armature; `moves(joint, link)` says which columns count."""
    columns = [J * [moves(joint, link) for joint in range(7)] for link in range(7)]
    return sum(J_i.T @ G_i @ J_i for J_i, G_i in zip(columns, G))


@row.wrong
def armature_forgotten(J, G, armature):
    """the armature is missing on the diagonal: the motors' rotors have to be turned as
    well => M without it"""
    return mass_matrix(J, G, 0.0)


@row.wrong
def armature_everywhere(J, G, armature):
    """the armature is added to every entry; a rotor turns with its own joint alone, so
    it belongs on the diagonal => M plus the armature everywhere"""
    return mass_matrix(J, G, 0.0) + armature


@row.wrong
def armature_per_link(J, G, armature):
    """the armature is added once for each link; each rotor counts once => M with seven
    times the armature"""
    return mass_matrix(J, G, 7 * armature)


for slug, says, moves in (
    (
        "columns-not-cut",
        "every joint moves every link; the joints beyond a link do not move it",
        lambda joint, link: True,
    ),
    (
        "own-joint-left-out",
        "a link's own joint is left out: the columns are cut one too early",
        lambda joint, link: joint < link,
    ),
    (
        "next-joint-too",
        "the joint after each link counts for it: the columns are cut one too late",
        lambda joint, link: joint <= link + 1,
    ),
    (
        "columns-cut-on-the-wrong-side",
        "the joints before a link are cut away; it is they that move it",
        lambda joint, link: joint >= link,
    ),
    (
        "own-joint-only",
        "only a link's own joint counts for it; all joints before move it, too",
        lambda joint, link: joint == link,
    ),
    (
        "J-overwritten",
        "only the first joint counts: the columns are set to 0 in J itself, and are "
        "gone for the next link. Work on a copy",
        lambda joint, link: joint == 0,
    ),
    (
        "last-link-left-out",
        "the last link is left out: range(n - 1) ends one too early",
        lambda joint, link: joint <= link < 6,
    ),
    (
        "last-link-only",
        "only the last link has a mass here",
        lambda joint, link: link == 6,
    ),
):
    for rotors in (1, 0):  # The armature is forgotten, too.

        @row.wrong(slug, says, "M with those columns")
        def _(J, G, armature, moves=moves, rotors=rotors):
            return links(J, G, moves) + rotors * np.diag(armature)


@row.wrong
def halves_swapped(J, G, armature):
    """J and G do not have the same order: omega comes first in both => M with the
    halves of G swapped"""
    return mass_matrix(J[[3, 4, 5, 0, 1, 2]], G, armature)


@row.wrong
def corners_swapped(J, G, armature):
    """the corners of G count with the wrong sign. M is symmetric and positive definite
    all the same => M with those signs"""
    flip = np.diag([1, 1, 1, -1, -1, -1])
    return mass_matrix(J, flip @ G @ flip, armature)


@row.wrong
def corners_dropped(J, G, armature):
    """turning and moving are added up separately: what ties them, the corners of G, is
    missing => M without the corners of G"""
    return mass_matrix(J, G * np.kron(np.eye(2), np.ones((3, 3))), armature)


@row.wrong
def angular_half_only(J, G, armature):
    """only the turning counts: the lower half of J, how fast the links move, is not
    used => M from the upper half of J and the top left block of G"""
    return mass_matrix(np.vstack([J[:3], np.zeros((3, 7))]), G, armature)


@row.wrong
def linear_half_only(J, G, armature):
    """only the lower half of J counts, and of G the mass; a link that turns has energy,
    too => M from the lower half of J and the lower right block of G"""
    return mass_matrix(np.vstack([np.zeros((3, 7)), J[3:]]), G, armature)


for half, which in ((np.tril, "lower"), (np.triu, "upper")):
    row.wrong(
        "not-mirrored",
        "only one half of M is filled; it is symmetric, so the other half is its "
        "mirror image",
        f"the {which} half of M",
    )(lambda J, G, armature, half=half: half(mass_matrix(J, G, armature)))


@row.wrong
def mirrored_with_the_diagonal(J, G, armature):
    """M and its transpose are added, so the diagonal counts twice => M with twice its
    diagonal"""
    lower = np.tril(mass_matrix(J, G, armature))
    return lower + lower.T


@row.wrong
def not_summed_back(J, G, armature):
    """each entry knows one link only; a joint carries all links beyond it => M from one
    link per entry"""
    M = np.diag(armature)
    for i in range(7):
        for j in range(7):
            M[i, j] += J[:, i] @ G[max(i, j)] @ J[:, j]
    return M


for code, what in (
    (
        lambda J, G, armature: mass_matrix(J, G / 2, armature),
        "M with half of the links",
    ),
    (lambda J, G, armature: mass_matrix(J, G, armature) / 2, "half of M"),
):
    row.wrong(
        "half",
        "the 1/2 of the kinetic energy is in M; it stands before M, in qd.M qd / 2",
        what,
    )(code)


@row.wrong
def inverse_returned(J, G, armature):
    """this is the inverse of M: small where the arm is heavy => the inverse of M"""
    return np.linalg.inv(mass_matrix(J, G, armature))


@row.right  # Lists and loops, no matrix product.
def _(J, G, armature):
    M = [[armature[i] * (i == j) for j in range(7)] for i in range(7)]
    for link in range(7):
        for i in range(link + 1):
            for j in range(link + 1):
                for a in range(6):
                    for b in range(6):
                        M[i][j] += J[a][i] * G[link][a][b] * J[b][j]
    return M


@row.close("float32")
def _(J, G, armature):
    M = np.diag(armature).astype(np.float32)
    for i in range(7):
        J_i = J[:, : i + 1].astype(np.float32)
        M[: i + 1, : i + 1] += J_i.T @ G[i].astype(np.float32) @ J_i
    return M
