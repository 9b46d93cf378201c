"""8.3 `arm_regressor(J_space, T_links, qd, qdd, g)`: its questions and its mistakes."""

import itertools
from functools import partial

import numpy as np

from labkit.judge import Matrix, Row
from labkit.judge.argument_mistakes import Change
from robo47 import dynamics
from robo47.identification import (
    arm_regressor,
    link_regressor,
    spatial_inertia_from_params,
)
from robo47.screws import ad, adjoint, skew
from robo47.se3 import inverse

from .states import DOWN, NUMBERS, moving

ROWS = tuple(f"the row of joint{i}" for i in range(1, 8))
LINKS = tuple(f"link{i}" for i in range(1, 8))
row = Row(Matrix((7, 70), rows=ROWS, columns=NUMBERS, blocks=LINKS, scale=10.0))


@row.inputs
def _(rng):
    drawn = moving(rng)
    J, T, qd, qdd, g = drawn[0]
    hinge = np.outer(np.eye(6)[1], np.eye(7)[0])
    still = np.zeros(7)
    case = (hinge, np.array([np.eye(4)] * 7), still, np.eye(7)[0], g)
    alone = [(still, still, g), (still, qdd, 0 * g), (qd, still, 0 * g)]
    tipped = (J, T, qd, qdd, np.array([3.0, -5.0, 7.0]))
    return [case, *((J, T, *one) for one in alone), tipped, *drawn]


def walk(
    J, T, qd, qdd, g, falls=1.0, own=1.0, turned=1.0,
    into=lambda T: adjoint(inverse(T)),
    back=lambda X: X.T,
    felt=lambda i: slice(0, i + 1),
    pose=lambda T, i: T[i],
    links=7, carried=1.0, passed_on=1.0, per_speed=False, late=False, both=True,
):  # fmt: skip
    """Return Y by the walk out along the arm, with other parts.

    `falls`, `own` and `turned` are factors of the base's and a joint's acceleration;
    `into` makes X of a pose, `back` what the wrench comes back with of X; `felt` says
    which joints feel link i, `pose` where it is, `links` how many there are. `carried`
    and `passed_on` are factors of the V and A of the link before, `per_speed` leaves qd
    out of ad(V) S qd, `late` uses V before it is added to, and without `both` A is left
    in the world's axes.
    """
    V = np.zeros(6)
    base = A = falls * np.append(np.zeros(3), -g)
    Y = np.zeros((7, 70))
    for i, S in enumerate(J.T[:links]):
        before = V
        V = carried * V + S * qd[i]
        turns = turned * ad(V) @ S * (1.0 if per_speed else qd[i])
        A = base + passed_on * (A - base) + own * S * qdd[i] + turns
        X = into(pose(T, i))
        at = felt(i)
        turned_in = X @ A if both else A
        costs = back(X) @ link_regressor(X @ (before if late else V), turned_in)
        Y[at, 10 * i : 10 * i + 10] = J[:, at].T @ costs
    return Y


def below(corner, T):
    """Return R^T twice on the diagonal, with another lower corner."""
    X = np.kron(np.eye(2), T[:3, :3].T)
    X[3:, :3] = corner
    return X


for slug, says, other in (
    ("base-acceleration-sign", "the base accelerates with +g: to stand on the ground "
     "feels like a lift that starts upwards, -g", {"falls": -1.0}),
    ("gravity-forgotten", "gravity is missing: A starts at 0 at the base",
     {"falls": 0.0}),
    ("acceleration-forgotten", "S qdd is missing: the joints' own acceleration costs "
     "nothing", {"own": 0.0}),
    ("bracket-forgotten", "A lacks ad(V) S qd: a joint that is carried round changes "
     "its direction", {"turned": 0.0}),
    ("bracket-sign", "A has ad(S) V qd, which is minus ad(V) S qd", {"turned": -1.0}),
    ("pose-not-inverted", "V and A are turned with Ad(T); from the world into the link "
     "it takes Ad(T^-1)", {"into": adjoint}),
    ("offset-left-out", "V and A are turned, but not shifted: the link's p is not in X",
     {"into": lambda T: np.kron(np.eye(2), T[:3, :3].T)}),
    ("in-world-axes", "nothing is turned into the links; phi of a link is in its own "
     "axes, about its own origin", {"into": lambda T: np.eye(6)}),
    ("wrench-back-with-X", "the wrench comes back with X; power is the same from both "
     "sides, so it takes X^T", {"back": lambda X: X}),
    ("wrench-left-in-the-link", "the wrench is left in the link's axes, about its "
     "origin; J_space's screws are in the world's, so it takes X^T first",
     {"back": lambda X: np.eye(6)}),
    ("wrench-back-with-the-inverse", "the wrench comes back with X^-1, as a twist "
     "does; power is the same from both sides, so a wrench takes X^T",
     {"back": np.linalg.inv}),
    ("wrench-not-carried-back", "the wrench is turned back, but not carried to the "
     "world's origin: its force has a moment there",
     {"back": lambda X: np.kron(np.eye(2), X[:3, :3].T)}),
    ("every-joint-feels-every-link", "joints feel links before their own; a joint "
     "carries its own link and those after it", {"felt": lambda i: slice(0, 7)}),
    ("cut-early", "the joint that carries a link as its own does not feel it: the "
     "slice ends one too early", {"felt": lambda i: slice(0, i)}),
    ("later-links-only", "link i is felt by the joints from its own on; a joint "
     "carries its own link and those after it", {"felt": lambda i: slice(i, 7)}),
    ("own-link-only", "each joint feels its own link only; it carries those after it, "
     "too", {"felt": lambda i: slice(i, i + 1)}),
    ("cut-late", "a joint feels the link before its own as well: the slice ends one "
     "too late", {"felt": lambda i: slice(0, i + 2)}),
    ("last-link-missing", "the last link's columns are empty: the loop ends one too "
     "early", {"links": 6}),
    ("pose-of-the-link-before", "each link has the pose of the one before it; "
     "T_links[0] is link1's already", {"pose": lambda T, i: T[max(i - 1, 0)]}),
    ("pose-of-the-link-before", "each link has the pose of the one before it; "
     "T_links[0] is link1's already", {"pose": lambda T, i: T[i - 1]}),
    ("pose-of-the-link-before", "each link has the pose of the one before it; "
     "T_links[0] is link1's already",
     {"pose": lambda T, i: T[i - 1] if i else np.eye(4)}),
    ("pose-on-the-link-before", "T_links are poses in the world; they are taken for "
     "those of one link on the one before, or made into them",
     {"pose": lambda T, i: inverse(T[i - 1]) @ T[i] if i else T[0]}),
    ("p-sign", "p has the wrong sign in X: below stands -R^T [p] in Ad(T^-1)",
     {"into": lambda T: below(T[:3, :3].T @ skew(T[:3, 3]), T)}),
    ("p-before-R", "in X [p] stands on the wrong side of R^T: p is in world axes, so "
     "-R^T [p]", {"into": lambda T: below(-skew(T[:3, 3]) @ T[:3, :3].T, T)}),
    ("p-before-R", "in X [p] stands on the wrong side of R^T: p is in world axes, so "
     "-R^T [p]", {"into": lambda T: below(skew(T[:3, 3]) @ T[:3, :3].T, T)}),
    ("twist-starts-anew", "each link's V is its own joint's alone; those before it "
     "carry it along", {"carried": 0.0}),
    ("acceleration-starts-anew", "each link's A is the base's and its own joint's; "
     "those before it carry it along", {"passed_on": 0.0}),
    ("bracket-without-qd", "ad(V) S is not multiplied by qd", {"per_speed": True}),
    ("acceleration-not-turned", "V is turned into the link, A is not", {"both": False}),
    ("twist-too-late", "V is used before the link's own S qd is added: it is the link "
     "before's", {"late": True}),
):  # fmt: skip
    row.wrong(slug, says, "the Y so")(partial(walk, **other))


@row.wrong
def added_up_in_the_links(J, T, qd, qdd, g):
    """each joint's screw is turned into its own link and added to V and A there; those
    of the link before are in other axes, so add up in the world's => the Y so"""
    V = np.zeros(6)
    A = np.append(np.zeros(3), -g)
    Y = np.zeros((7, 70))
    for i, S in enumerate(J.T):
        X = adjoint(inverse(T[i]))
        V = V + X @ S * qd[i]
        A = A + X @ S * qdd[i] + ad(V) @ X @ S * qd[i]
        costs = X.T @ link_regressor(V, A)
        Y[: i + 1, 10 * i : 10 * i + 10] = J[:, : i + 1].T @ costs
    return Y


@row.wrong
def grouped_by_number(J_space, T_links, qd, qdd, g):
    """the columns are grouped by number, all masses first; they are grouped by link,
    ten each => the right one with its columns in that order"""
    Y = arm_regressor(J_space, T_links, qd, qdd, g).reshape(7, 7, 10)
    return np.swapaxes(Y, 1, 2).reshape(7, 70)


TYPED_IN = Change(
    "gravity-typed-in",
    "9.81 downwards is typed in; gravity is the argument g, and 0 in space",
    lambda g: DOWN,
    hidden="the lab's robot stands upright",
)
row.of_argument("g", TYPED_IN)
row.reached_by("link_regressor", "in link_regressor, ", but=["ad-not-transposed-plus"])


@row.right  # Seventy robots with one number each, through Day 4's inverse dynamics.
def _(J_space, T_links, qd, qdd, g):
    Y = []
    for i, unit in itertools.product(range(7), spatial_inertia_from_params(np.eye(10))):
        G = np.zeros((7, 6, 6))
        X = adjoint(inverse(T_links[i]))
        G[i] = X.T @ unit @ X
        Y.append(dynamics.inverse_dynamics(J_space, G, qd, qdd, g))
    return np.array(Y).T


row.spans(  # as small, or as large, as in the lab
    qd=(lambda qd: 0.01 * qd,),
    qdd=(lambda qdd: 0.003 * qdd,),
)
