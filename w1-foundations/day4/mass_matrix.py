"""4.3 `mass_matrix(J_space, G, armature)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Symmetric
from labkit.judge.argument_mistakes import HALVES_SWAPPED
from robo47.dynamics import mass_matrix

from .states import hinge, states

row = Row(Symmetric((7, 7), "kg m2"))
row.of_argument("J_space", HALVES_SWAPPED)


@row.inputs
def _(rng):
    J, G, _, _ = hinge([0.0, 0.0, 1.0], 2.0)
    rotors = [np.full(7, 0.1)] * 5 + list(rng.numbers(0.02, 0.3, 5, 7))
    now = zip(states(rng), rotors)
    return [(J, G, rotors[0]), *((at.J_space, at.G, a) for at, a in now)]


def links(J, G, counts):
    """Return M without the armature; `counts[link, joint]`: does that column?"""
    columns = [J * row for row in np.broadcast_to(counts, (7, 7))]
    return sum(J_i.T @ G_i @ J_i for J_i, G_i in zip(columns, G))


@row.wrongs
def _(J, G, armature):
    """armature-forgotten: the armature is missing on the diagonal: the motors' rotors
      have to be turned as well => M without it
    armature-everywhere: the armature is added to every entry; a rotor turns with its
      own joint alone, so it belongs on the diagonal => M plus the armature everywhere
    armature-per-link: the armature is added once for each link; each rotor counts once
      => M with seven times the armature
    mirrored-with-the-diagonal: M and its transpose are added, so the diagonal counts
      twice => M with twice its diagonal
    inverse-returned: this is the inverse of M: small where the arm is heavy
    """
    M = mass_matrix(J, G, armature)
    links_alone = mass_matrix(J, G, 0.0)
    return {
        "armature-forgotten": links_alone,
        "armature-everywhere": links_alone + armature,
        "armature-per-link": mass_matrix(J, G, 7 * armature),
        "mirrored-with-the-diagonal": np.tril(M) + np.tril(M).T,
        "inverse-returned": np.linalg.inv(M),
    }


def cut(J, G, armature):
    """columns-not-cut: every joint moves every link; the joints beyond a link do not
      move it
    own-joint-left-out: a link's own joint is left out: the columns are cut one too
      early
    next-joint-too: the joint after each link counts for it: the columns are cut one too
      late
    columns-cut-on-the-wrong-side: the joints before a link are cut away; it is they
      that move it
    own-joint-only: only a link's own joint counts for it; all joints before move it,
      too
    J-overwritten: only the first joint counts: the columns are set to 0 in J_space
      itself, and are gone for the next link. Work on a copy
    last-link-left-out: the last link is left out: range(n - 1) ends one too early
    last-link-only: only the last link has a mass here
    """
    joint = np.arange(7)
    link = np.arange(7)[:, None]
    counts = {
        "columns-not-cut": joint <= 6,
        "own-joint-left-out": joint < link,
        "next-joint-too": joint <= link + 1,
        "columns-cut-on-the-wrong-side": joint >= link,
        "own-joint-only": joint == link,
        "J-overwritten": joint == 0,
        "last-link-left-out": (joint <= link) & (link < 6),
        "last-link-only": link == 6,
    }
    return {slug: links(J, G, one) + np.diag(armature) for slug, one in counts.items()}


row.wrongs(cut, "M with those columns")


@row.wrongs
def _(J, G, armature):
    """corners-swapped: the corners of G count with the wrong sign. M is symmetric and
      positive definite all the same => M with those signs
    corners-dropped: turning and moving are added up separately: what ties them, the
      corners of G, is missing => M without the corners of G
    angular-half-only: only the turning counts: the lower half of J_space, how fast the
      links move, is not used => M from the upper half of J_space and the top left block
      of G
    linear-half-only: only the lower half of J_space counts, and of G the mass; a link
      that turns has energy, too => M from the lower half of J_space and the lower right
      block of G
    """
    flip = np.diag([1, 1, 1, -1, -1, -1])
    upper = np.array([1, 1, 1, 0, 0, 0])[:, None]
    given = {
        "corners-swapped": (J, flip @ G @ flip),
        "corners-dropped": (J, G * np.kron(np.eye(2), np.ones((3, 3)))),
        "angular-half-only": (upper * J, G),
        "linear-half-only": ((1 - upper) * J, G),
    }
    return {slug: mass_matrix(*both, armature) for slug, both in given.items()}


for half, which in ((np.tril, "lower"), (np.triu, "upper")):
    row.wrong(
        "not-mirrored",
        "only one half of M is filled; it is symmetric, so the other half is its "
        "mirror image",
        f"the {which} half of M",
    )(lambda J, G, armature, half=half: half(mass_matrix(J, G, armature)))


@row.wrong
def not_summed_back(J, G, armature):
    """each entry knows one link only; a joint carries all links beyond it => M from one
    link per entry"""
    M = np.diag(armature)
    for i in range(7):
        for j in range(7):
            M[i, j] += J[:, i] @ G[max(i, j)] @ J[:, j]
    return M


for rotors, what in ((1, "M with half of the links"), (0.5, "half of M")):
    row.wrong(
        "half",
        "the 1/2 of the kinetic energy is in M; it stands before M, in qd.M qd / 2",
        what,
    )(lambda J, G, armature, r=rotors: mass_matrix(J, G / 2, r * armature))


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


row.at_least_0(armature="a rotor's inertia")
