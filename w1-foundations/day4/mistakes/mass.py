"""Mistakes in task 4.3 `mass_matrix(J, G, armature)`."""

from collections.abc import Callable

import numpy as np

from labkit.judge.matrices import transposed
from labkit.judge.mistake import Mistake
from robo47.checks import Array


def cut(keep: Callable[[int, int], bool]) -> Array:
    """Return which joints, (7, 1, 7), count for which link."""
    table = [[keep(joint, link) for joint in range(7)] for link in range(7)]
    return np.array(table, dtype=float)[:, None, :]


BEFORE = cut(lambda joint, link: joint <= link)


def _summed(
    kept: Array = BEFORE, body: Callable[[Array], Array] = lambda G: G
) -> Callable[..., Array]:
    """Return the links' part of mass_matrix with other columns, other inertias."""

    def links(J: Array, G: Array) -> Array:
        J_i = J[:, None] * kept
        return np.sum(transposed(J_i) @ body(G) @ J_i, axis=1)

    return links


def _on_diagonal(armature: Array) -> Array:
    return armature[..., None] * np.eye(armature.shape[-1])


def _with(links: Callable[..., Array], times: float = 1.0) -> Callable[..., Array]:
    return lambda J, G, armature: links(J, G) + times * _on_diagonal(armature)


def _last_inertias(J: Array, G: Array) -> Array:
    """Return S_i . G_j S_j with j the outer of the two: composites never summed."""
    M = np.einsum("nai,njab,nbj->nij", J, G, J)
    return np.triu(M) + transposed(np.triu(M, 1))


def _no_corners(G: Array) -> Array:
    block = np.kron(np.eye(2), np.ones((3, 3)))
    return G * block


_CORNER = np.kron(np.diag([1.0, 0.0]), np.ones((3, 3)))
_FLIP = np.diag([1.0, 1.0, 1.0, -1.0, -1.0, -1.0])
LINKS = _summed()

MASS_MATRIX: list[Mistake] = [
    Mistake(
        "armature-forgotten",
        "the armature is missing on the diagonal: the motors' rotors have to be turned "
        "as well",
        lambda J, G, armature: LINKS(J, G),
        "M without it",
    ),
    Mistake(
        "armature-everywhere",
        "the armature is added to every entry; a rotor turns with its own joint alone, "
        "so it belongs on the diagonal",
        lambda J, G, armature: LINKS(J, G) + armature[:, None, :],
        "M plus the armature everywhere",
    ),
    Mistake(
        "armature-per-link",
        "the armature is added once for each link; each rotor counts once",
        _with(LINKS, 7.0),
        "M with seven times the armature",
    ),
    *(
        Mistake(slug, says, make(_summed(kept)), "M with those columns")
        for make in (_with, lambda links: lambda J, G, a: links(J, G))
        for slug, says, kept in (
            (
                "columns-not-cut",
                "every joint moves every link; the joints beyond a link do not move it",
                cut(lambda joint, link: True),
            ),
            (
                "own-joint-left-out",
                "a link's own joint is left out: the columns are cut one too early",
                cut(lambda joint, link: joint < link),
            ),
            (
                "next-joint-too",
                "the joint after each link counts for it: the columns are cut one too "
                "late",
                cut(lambda joint, link: joint <= link + 1),
            ),
            (
                "columns-cut-on-the-wrong-side",
                "the joints before a link are cut away; it is they that move it",
                cut(lambda joint, link: joint >= link),
            ),
            (
                "own-joint-only",
                "only a link's own joint counts for it; all joints before move it, too",
                cut(lambda joint, link: joint == link),
            ),
            (
                "J-overwritten",
                "only the first joint counts: the columns are set to 0 in J itself, "
                "and are gone for the next link. Work on a copy",
                cut(lambda joint, link: joint == 0),
            ),
            (
                "last-link-left-out",
                "the last link is left out: range(n - 1) ends one too early",
                cut(lambda joint, link: joint <= link < 6),
            ),
            (
                "last-link-only",
                "only the last link has a mass here",
                cut(lambda joint, link: link == 6),
            ),
        )
    ),
    Mistake(
        "halves-swapped",
        "J and G do not have the same order: omega comes first in both",
        _with(_summed(body=lambda G: np.roll(G, (3, 3), axis=(-2, -1)))),
        "M with the halves of G swapped",
    ),
    Mistake(
        "corners-swapped",
        "the corners of G count with the wrong sign. M is symmetric and positive "
        "definite all the same",
        _with(_summed(body=lambda G: _FLIP @ G @ _FLIP)),
        "M with those signs",
    ),
    Mistake(
        "corners-dropped",
        "turning and moving are added up separately: what ties them, the corners of G, "
        "is missing",
        _with(_summed(body=_no_corners)),
        "M without the corners of G",
    ),
    Mistake(
        "angular-half-only",
        "only the turning counts: the lower half of J, how fast the links move, is "
        "not used",
        _with(_summed(body=lambda G: G * _CORNER)),
        "M from the upper half of J and the top left block of G",
    ),
    Mistake(
        "linear-half-only",
        "only the lower half of J counts, and of G the mass; a link that turns has "
        "energy, too",
        _with(_summed(body=lambda G: G * _CORNER[::-1, ::-1])),
        "M from the lower half of J and the lower right block of G",
    ),
    Mistake(
        "not-mirrored",
        "only one half of M is filled; it is symmetric, so the other half is its "
        "mirror image",
        lambda *given: np.tril(_with(LINKS)(*given)),
        "the lower half of M",
    ),
    Mistake(
        "not-mirrored",
        "only one half of M is filled; it is symmetric, so the other half is its "
        "mirror image",
        lambda *given: np.triu(_with(LINKS)(*given)),
        "the upper half of M",
    ),
    Mistake(
        "mirrored-with-the-diagonal",
        "M and its transpose are added, so the diagonal counts twice",
        lambda *given: _with(LINKS)(*given) * (1.0 + np.eye(7)),
        "M with twice its diagonal",
    ),
    Mistake(
        "not-summed-back",
        "each entry knows one link only; a joint carries all links beyond it",
        _with(_last_inertias),
        "M from one link per entry",
    ),
    Mistake(
        "half",
        "the 1/2 of the kinetic energy is in M; it stands before M, in qd.M qd / 2",
        lambda J, G, armature: 0.5 * LINKS(J, G) + _on_diagonal(armature),
        "M with half of the links",
    ),
    Mistake(
        "half",
        "the 1/2 of the kinetic energy is in M; it stands before M, in qd.M qd / 2",
        lambda *given: 0.5 * _with(LINKS)(*given),
        "half of M",
    ),
]
MASS_MATRIX.append(
    Mistake(
        "inverse-returned",
        "this is the inverse of M: small where the arm is heavy",
        lambda *given: np.linalg.inv(_with(LINKS)(*given)),
        "the inverse of M",
    )
)
