"""9.8 `kinetic_energy_gradient(J_space, G, qd)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Row, Vector
from robo47 import dynamics
from robo47.estimation import kinetic_energy_gradient
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


def slope(
    J_space, G, qd, *, factor=-1.0, felt=lambda i: slice(i, None),
    turned=lambda S, V: ad(S) @ V, at=lambda V, i: V[i], carries=lambda V, i: V,
    twists=lambda S, qd: np.cumsum(S * qd[:, None], axis=0),
    momentum=lambda G, V: (G @ V[:, :, None])[:, :, 0],
):  # fmt: skip
    """Return the slope with other parts: whose momentum, and which twist turns how."""
    S = J_space.T
    V = twists(S, qd)
    found = []
    for i in range(len(S)):
        momenta = momentum(G, carries(V, i))
        turns = turned(S[i], at(V, i))
        found.append(factor * momenta[felt(i)].sum(axis=0) @ turns)
    return np.array(found)


for slug, says, redone, other in (
    ("slope-sign", "the sign is the other one: seen from the links that turn, V turns "
     "back; and ad(V) S is minus ad(S) V", "the right one with +", {"factor": 1.0}),
    ("halved", "it is halved: energy is half of momentum times twist, but both change "
     "with the twist", "half of the right one", {"factor": -0.5}),
    ("doubled", "it is doubled: energy is half of momentum times twist, so its slope "
     "is momentum times the twist's", "twice the right one", {"factor": -2.0}),
    ("own-link-only", "each joint turns its own link only; all links after it turn "
     "along", "with the momentum of link i alone", {"felt": lambda i: slice(i, i + 1)}),
    ("later-links-only", "link i itself is left out; k starts at i", "with k > i",
     {"felt": lambda i: slice(i + 1, None)}),
    ("last-link-left-out", "the last link's momentum is left out: the loop ends one "
     "too early", "with k < 7", {"felt": lambda i: slice(i, -1)}),
    ("last-link-only", "only the last link's momentum is taken: is out[i] written "
     "anew for each k, where it is added up?", "with k = 7",
     {"felt": lambda i: slice(-1, None)}),
    ("earlier-links", "the momenta of the links up to i are added; those from i on "
     "turn", "with k <= i", {"felt": lambda i: slice(0, i + 1)}),
    ("all-links", "the momenta of all links are added; those before i stay where they "
     "are", "with all k", {"felt": lambda i: slice(0, None)}),
    ("ad-transposed", "ad is transposed: that is how a wrench turns; V is a twist",
     "with ad^T", {"turned": lambda S, V: ad(S).T @ V}),
    ("omega-alone", "only omega is turned; v turns along", "with ad of omega alone",
     {"turned": lambda S, V: np.append(np.cross(S[:3], V[:3]), np.zeros(3))}),
    ("own-twist-only", "V_i is that of its own joint, S_i qd_i; the twists of all "
     "joints before it add up", "with V_i = S_i qd_i",
     {"twists": lambda S, qd: S * qd[:, None]}),
    ("outer-twists", "the twists are added up from the tip; link i is moved by the "
     "joints up to i", "with V_i of the joints from i on",
     {"twists": lambda S, qd: np.cumsum((S * qd[:, None])[::-1], axis=0)[::-1]}),
    ("twists-in-reverse", "the twists are added up from the tip and read in that "
     "order: V_1 is then what joint 7 gives", "with joint 7 first",
     {"twists": lambda S, qd: np.cumsum((S * qd[:, None])[::-1], axis=0)}),
    ("no-inertia", "twists are added up, without G; momentum is G V", "with G = 1",
     {"momentum": lambda G, V: V}),
    ("inertia-twice", "G stands twice; momentum is G V", "with G G V",
     {"momentum": lambda G, V: (G @ G @ V[:, :, None])[:, :, 0]}),
    ("twists-one-late", "V_i lacks joint i's own speed: it is added after it is used",
     "with V_(i-1)", {"twists": lambda S, qd: np.cumsum(S * qd[:, None], axis=0)
                      - S * qd[:, None]}),
    ("one-late-for-all", "all links from i on are given the twist that comes to link "
     "i, without joint i's speed; each has its own, V_k", "with G_k V_(i-1)",
     {"carries": lambda V, i: V * 0 + (V[i - 1] if i else 0)}),
    ("summed-down-the-columns", "the six numbers of a twist are added up; a twist is "
     "the sum of the joints' own", "with the sum along the other axis",
     {"twists": lambda S, qd: np.cumsum(S * qd[:, None], axis=1)}),
    ("speeds-left-out", "V is made without qd, as if every joint turned with 1 rad/s",
     "with qd = 1", {"twists": lambda S, qd: np.cumsum(S, axis=0)}),
    ("twist-of-the-tip", "it is V of the last link that turns; that of link i does, "
     "for links after it turn along as they are", "with V_7 for V_i",
     {"at": lambda V, i: V[-1]}),
    ("one-twist-for-all", "all links from i on are given the twist of link i; each has "
     "its own, V_k", "with G_k V_i", {"carries": lambda V, i: V * 0 + V[i]}),
    ("tip-twist-for-all", "all links are given the twist of the last; each has its "
     "own, V_k", "with G_k V_7", {"carries": lambda V, i: V * 0 + V[-1]}),
):  # fmt: skip
    row.wrong(slug, says, redone)(partial(slope, **other))


@row.wrongs
def _(J_space, G, qd):
    """C-qd: this is C qd, the Coriolis torque itself; asked for is C^T qd, how the
      energy changes with the angle
    minus-C-qd: this is minus C qd, the Coriolis torque; asked for is C^T qd
    inverse-order: the answer is backwards: joint1 comes first
    each-its-own-twist: it is the twist of link k that turns, for each k; asked for is
      that of link i, which the links after it take along => with ad(S_i) V_k
    times-qd: it is multiplied by qd: that is a power
    """
    C = dynamics.coriolis_matrix(J_space, G, qd)
    right = kinetic_energy_gradient(J_space, G, qd)
    S = J_space.T
    V = np.cumsum(S * qd[:, None], axis=0)
    momenta = (G @ V[:, :, None])[:, :, 0]
    return {
        "C-qd": C @ qd,
        "minus-C-qd": -C @ qd,
        "inverse-order": right[::-1].copy(),
        "each-its-own-twist": -np.array(
            [np.sum(momenta[i:] * (V[i:] @ ad(S[i]).T)) for i in range(len(S))]
        ),
        "times-qd": right * qd,
    }


@row.right  # Christoffel's matrix, transposed.
def _(J_space, G, qd):
    return dynamics.coriolis_matrix(J_space, G, qd).T @ qd


@row.right  # V of the link before, for ad(S) S is 0; a loop from the tip.
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
