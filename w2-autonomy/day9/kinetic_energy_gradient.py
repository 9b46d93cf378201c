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


for slug, says, redone, other in (
    ("slope-sign", "every sign is reversed. Relative to the rotated links, V_i rotates "
     "in the opposite direction, so its derivative is -ad(S_i) V_i", "the negative",
     {"factor": 1.0}),
    ("halved", "the result is halved. The twist appears twice in the energy V . G V / "
     "2, so the factor 1/2 cancels in the derivative", "half of the gradient",
     {"factor": -0.5}),
    ("own-link-only", "only the momentum of link i is used; joint i also rotates all "
     "distal links, so sum their momenta", "the momentum of link i alone",
     {"felt": lambda i: slice(i, i + 1)}),
    ("later-links-only", "link i itself is omitted; the sum begins with link i",
     "the sum over k > i", {"felt": lambda i: slice(i + 1, None)}),
    ("last-link-left-out", "the momentum of link 7 is omitted: does your loop end one "
     "link too early?", "the sum over k < 7", {"felt": lambda i: slice(i, -1)}),
    ("last-link-only", "only the momentum of link 7 is used: does your loop overwrite "
     "entry i for each k instead of adding to it?", "the sum over k = 7",
     {"felt": lambda i: slice(-1, None)}),
    ("earlier-links", "the momenta of links 1 to i are summed; joint i rotates the "
     "links i to 7", "the sum over k <= i", {"felt": lambda i: slice(0, i + 1)}),
    ("all-links", "the momenta of all links are summed; joint i does not move the "
     "links before it", "the sum over all k", {"felt": lambda i: slice(0, None)}),
    ("omega-alone", "only the angular part of V_i is rotated; ad(S_i) acts on the "
     "linear part as well", "ad of the angular part alone",
     {"turned": lambda S, V: np.append(np.cross(S[:3], V[:3]), np.zeros(3))}),
    ("own-twist-only", "V_i contains the velocity of joint i only. Sum over the joints "
     "1 to i", "V_i = S_i qd_i",
     {"twists": lambda S, qd: S * qd[:, None]}),
    ("outer-twists", "V_i is the sum over the joints i to 7; link i is moved by the "
     "joints 1 to i", "the sum over the joints i to 7",
     {"twists": lambda S, qd: np.cumsum((S * qd[:, None])[::-1], axis=0)[::-1]}),
    ("twists-one-late", "V_i omits the velocity of joint i itself: is it added after "
     "V_i is used?", "V_(i-1) instead of V_i",
     {"twists": lambda S, qd: np.cumsum(S * qd[:, None], axis=0) - S * qd[:, None]}),
    ("one-late-for-all", "all links from i on have the twist V_(i-1); the momentum of "
     "link k is G_k V_k", "G_k V_(i-1)",
     {"carries": lambda V, i: V * 0 + (V[i - 1] if i else 0)}),
    ("twist-of-the-tip", "the twist of link 7 is rotated; joint i rotates the twist "
     "V_i that arrives at link i", "V_7 instead of V_i", {"at": lambda V, i: V[-1]}),
    ("one-twist-for-all", "all links from i on have the twist V_i; the momentum of "
     "link k is G_k V_k", "G_k V_i", {"carries": lambda V, i: V * 0 + V[i]}),
    ("tip-twist-for-all", "all links have the twist of link 7; the momentum of link k "
     "is G_k V_k", "G_k V_7", {"carries": lambda V, i: V * 0 + V[-1]}),
):  # fmt: skip
    row.wrong(slug, says, redone)(partial(gradient, **other))


@row.wrongs
def _(J_space, G, qd):
    """C-qd: the result is the Coriolis torque C qd; the gradient is C^T qd => C qd
    minus-C-qd: the result is the negative Coriolis torque -C qd; the gradient is C^T qd
      => -C qd
    each-its-own-twist: the twist V_k of each link is rotated; all links from i on
      receive the same change, -ad(S_i) V_i => ad(S_i) V_k
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
