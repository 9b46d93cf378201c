"""9.8 `kinetic_energy_gradient(J_space, G, qd)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Row, Vector
from robo47 import dynamics
from robo47.screws import ad

from .signals import JOINTS, moving

row = Row(Vector((7,), "N m", names=JOINTS))


@row.inputs
def _(rng):
    drawn = moving(rng)
    J, G, qd = drawn[0]
    rest = (J, G, np.zeros(7))
    two = (J, G, np.array([1.0, 0.0, 0.0, -1.5, 0.0, 0.0, 0.0]))
    return [rest, two, (J, G, np.eye(7)[0]), (J, G, -2.0 * qd), *drawn]


def gradient(
    J_space, G, qd, *, factor=-1.0, felt=lambda i: slice(i, None),
    turned=lambda S, V: ad(S) @ V, at=lambda V, i: V[i], carries=lambda V, i: V,
    twists=lambda S, qd: np.cumsum(S * qd[:, None], axis=0),
):  # fmt: skip
    """Return the gradient with other links, another twist or another rotation."""
    S = J_space.T
    V = twists(S, qd)
    found = []
    for i in range(len(S)):
        momenta = (G @ carries(V, i)[:, :, None])[:, :, 0]
        turns = turned(S[i], at(V, i))
        found.append(factor * momenta[felt(i)].sum(axis=0) @ turns)
    return np.array(found)


for slug, says, other in (
    ("slope-sign",
     "your code returns the gradient with the wrong sign. The derivative of V_i is "
     "-ad(S_i) V_i, because, seen from the rotated links, V_i rotates in the opposite "
     "direction",
     {"factor": 1.0}),
    ("halved",
     "your code halves the result. Omit the factor of 1/2, because the derivative of V "
     ". G V / 2 has two equal terms",
     {"factor": -0.5}),
    ("own-link-only",
     "your code uses only the contribution of link i. Sum the contributions of links i "
     "to 7 instead, because joint i rotates all these links",
     {"felt": lambda i: slice(i, i + 1)}),
    ("later-links-only",
     "your code omits the contribution of link i. Begin the sum with link i, because "
     "joint i also rotates link i",
     {"felt": lambda i: slice(i + 1, None)}),
    ("last-link-left-out",
     "your code omits the contribution of link 7. Sum the contributions of links i to "
     "7, because joint i rotates all these links",
     {"felt": lambda i: slice(i, -1)}),
    ("last-link-only",
     "your code uses only the contribution of link 7. Sum the contributions of links i "
     "to 7 instead, because joint i rotates all these links",
     {"felt": lambda i: slice(-1, None)}),
    ("earlier-links", "your code sums the contributions of links 1 to i. Sum the "
                      "contributions of links i to 7 instead, because joint i rotates "
                      "these links",
     {"felt": lambda i: slice(0, i + 1)}),
    ("links-before", "your code sums the contributions of links 1 to i - 1. Sum the "
                     "contributions of links i to 7 instead, because joint i rotates "
                     "these links",
     {"felt": lambda i: slice(0, i)}),
    ("all-links",
     "your code sums the contributions of all links. Sum only the contributions of "
     "links i to 7, because joint i does not move links 1 to i - 1",
     {"felt": lambda i: slice(0, None)}),
    ("omega-alone",
     "your code uses only the angular part of ad(S_i) V_i. Use the whole product, "
     "because the rotation also changes the linear part of the twist",
     {"turned": lambda S, V: np.append(np.cross(S[:3], V[:3]), np.zeros(3))}),
    ("own-twist-only",
     "your code uses only the velocity of joint i in V_i, so ad(S_i) V_i is 0. The "
     "twist V_i should be the sum of the velocities of joints 1 to i, because these "
     "joints move link i",
     {"twists": lambda S, qd: S * qd[:, None]}),
    ("outer-twists",
     "your code sums the velocities of joints i to 7 in V_i. Sum the velocities of "
     "joints 1 to i instead, because these joints move link i",
     {"twists": lambda S, qd: np.cumsum((S * qd[:, None])[::-1], axis=0)[::-1]}),
    ("twists-one-late",
     "your code omits the velocity of joint i in V_i. The twist V_i should be the sum "
     "of the velocities of joints 1 to i, because joint i also moves link i",
     {"twists": lambda S, qd: np.cumsum(S * qd[:, None], axis=0) - S * qd[:, None]}),
    ("one-late-for-all",
     "your code uses the twist V_(i-1) for all links from i to 7. Use the twist V_k "
     "for link k instead, because the momentum of link k is G_k V_k",
     {"carries": lambda V, i: V * 0 + (V[i - 1] if i else 0)}),
    ("twist-of-the-tip",
     "your code uses the twist of link 7 instead of V_i in ad(S_i) V_i. Use V_i, which "
     "is the twist of link i",
                         {"at": lambda V, i: V[-1]}),
    ("one-twist-for-all",
     "your code uses the twist V_i for all links from i to 7. Use the twist V_k for "
     "link k instead, because the momentum of link k is G_k V_k",
                          {"carries": lambda V, i: V * 0 + V[i]}),
    ("tip-twist-for-all",
     "your code uses the twist of link 7 for all links. Use the twist V_k for link k "
     "instead, because the momentum of link k is G_k V_k",
                          {"carries": lambda V, i: V * 0 + V[-1]}),
):  # fmt: skip
    row.wrong(slug, says)(partial(gradient, **other))


@row.wrongs
def _(J_space, G, qd):
    """C-qd: your code returns the Coriolis torque C qd. Return C^T qd instead, where
      the matrix C satisfies dM/dt = C + C^T
    minus-C-qd: your code returns -C qd, the negative Coriolis torque. Return C^T qd
      instead, where the matrix C satisfies dM/dt = C + C^T
    each-its-own-twist: your code uses -ad(S_i) V_k for each link k. Use -ad(S_i) V_i
      instead, because the twists of links i to 7 change by the same amount
    """
    C = dynamics.coriolis_matrix(J_space, G, qd)
    S = J_space.T
    V = np.cumsum(S * qd[:, None], axis=0)
    momenta = (G @ V[:, :, None])[:, :, 0]
    return {
        "C-qd": C @ qd,
        "minus-C-qd": -C @ qd,
        "each-its-own-twist": -np.array(
            [np.sum(momenta[i:] * (V[i:] @ ad(S[i]).T)) for i in range(len(S))]
        ),
    }


@row.right  # The transposed Coriolis matrix.
def _(J_space, G, qd):
    return dynamics.coriolis_matrix(J_space, G, qd).T @ qd


@row.right  # A loop from the tip, with V of the link before: ad(S) S is 0.
def _(J_space, G, qd):
    found = np.zeros(7)
    momentum = np.zeros(6)
    for i in range(6, -1, -1):
        V = J_space[:, : i + 1] @ qd[: i + 1]
        momentum = momentum + G[i] @ V
        found[i] = -momentum @ ad(J_space[:, i]) @ (J_space[:, :i] @ qd[:i])
    return found


row.spans(  # as small, or as large, as in the lab
    qd=(lambda qd: 8e-05 * qd,),
)
