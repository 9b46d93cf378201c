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
    """armature-per-link: your M contains 7 times the armature. Add the armature only
      once, because each joint has only one rotor
    mirrored-with-the-diagonal: the diagonal of your M is twice the correct diagonal. If
      your code adds a triangle of M to its transpose, mirror only the off-diagonal
      entries
    """
    M = mass_matrix(J, G, armature)
    return {
        "armature-per-link": mass_matrix(J, G, 7 * armature),
        "mirrored-with-the-diagonal": np.tril(M) + np.tril(M).T,
    }


def cut(J, G, armature):
    """columns-not-cut: each link contributes to all entries of your M. The entries of
      the joints after the link should not contain the link, because these joints do not
      move the link
    own-joint-left-out: each link in your M contributes only to the entries of earlier
      joints. Include the entries of its own joint, because this joint also moves the
      link
    next-joint-too: each link in your M also contributes to the entries of the next
      joint. Omit this contribution, because the next joint does not move the link
    columns-cut-on-the-wrong-side: each link in your M contributes to the entries of its
      own joint and of all later joints. Use its own joint and all earlier joints
      instead, because these joints move the link
    own-joint-only: each link in your M contributes only to the entry of its own joint.
      Include the entries of all earlier joints, because these joints also move the link
    """
    joint = np.arange(7)
    link = np.arange(7)[:, None]
    counts = {
        "columns-not-cut": joint <= 6,
        "own-joint-left-out": joint < link,
        "next-joint-too": joint <= link + 1,
        "columns-cut-on-the-wrong-side": joint >= link,
        "own-joint-only": joint == link,
    }
    return {slug: links(J, G, one) + np.diag(armature) for slug, one in counts.items()}


row.wrongs(cut)


@row.wrongs
def _(J, G, armature):
    """corners-swapped: the terms with the off-diagonal blocks of G have the wrong sign
      in your M. Use G and J_space unchanged. Your M is still symmetric and positive
      definite, so these two properties do not reveal the mistake
    corners-dropped: your code omits the off-diagonal blocks of G. Use all of G, because
      these blocks couple rotation and translation
    angular-half-only: your code uses only the angular half of J_space. Use all six
      rows, because the links' linear velocities also contribute to the kinetic energy
    linear-half-only: your code uses only the linear half of J_space and the masses. Use
      all six rows and all of G, because a rotating link also has rotational energy
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


@row.wrong
def not_summed_back(J, G, armature):
    """your code includes only one link in each entry of M. Each entry belongs to two
    joints, so sum over all links that both joints move"""
    M = np.diag(armature)
    for i in range(7):
        for j in range(7):
            M[i, j] += J[:, i] @ G[max(i, j)] @ J[:, j]
    return M


@row.wrong
def summed_from_the_base(J, G, armature):
    """your code sums over the links from the base up to the later of the two joints.
    Sum over the links from the later joint to the end instead, because both joints move
    these links"""
    M = np.diag(armature)
    for i in range(7):
        for j in range(7):
            M[i, j] += J[:, i] @ G[: max(i, j) + 1].sum(axis=0) @ J[:, j]
    return M


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


@row.right  # Pair by pair, over the links that both joints move.
def _(J, G, armature):
    M = np.diag(armature)
    for i in range(7):
        for j in range(i, 7):
            both = G[j:].sum(axis=0)  # inertia of the links that both joints move
            M[i, j] = M[i, j] + J[:, i] @ both @ J[:, j]  # an entry of M
            M[j, i] = M[i, j]  # M is symmetric
    return M


@row.close("float32")
def _(J, G, armature):
    M = np.diag(armature).astype(np.float32)
    for i in range(7):
        J_i = J[:, : i + 1].astype(np.float32)
        M[: i + 1, : i + 1] += J_i.T @ G[i].astype(np.float32) @ J_i
    return M


row.at_least_0(armature="a rotor's inertia")
