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
    J, T, qd, qdd, g, bracket=1.0,
    into=lambda T: adjoint(inverse(T)),
    back=lambda X: X.T,
    felt=lambda i: slice(0, i + 1),
    pose=lambda T, i: T[i],
    links=7, passed_on=1.0, late=False, both=True, gravity=1.0,
):  # fmt: skip
    """Return Y by the outward recursion along the arm, with other parts.

    `bracket` is a factor of ad(V) S qd; `into` returns X from a pose and `back` the
    matrix that returns the wrench; `felt` returns the joints that link i loads, `pose`
    its pose, and `links` is the number of links. `passed_on` is a factor of the A of
    the link before, `late` uses V before the link's own joint is added, and without
    `both` A stays in the world frame. `gravity` is a factor of the base's acceleration.
    """
    V = np.zeros(6)
    base = A = np.append(np.zeros(3), -gravity * g)
    Y = np.zeros((7, 70))
    for i, S in enumerate(J.T[:links]):
        before = V
        V = V + S * qd[i]
        A = base + passed_on * (A - base) + S * qdd[i] + bracket * ad(V) @ S * qd[i]
        X = into(pose(T, i))
        at = felt(i)
        own = X @ A if both else A
        costs = back(X) @ link_regressor(X @ (before if late else V), own)
        Y[at, 10 * i : 10 * i + 10] = J[:, at].T @ costs
    return Y


def below(corner, T):
    """Return R^T twice on the diagonal, with another lower left block."""
    X = np.kron(np.eye(2), T[:3, :3].T)
    X[3:, :3] = corner
    return X


for slug, says, other in (
    ("bracket-forgotten",
     "your result omits the term ad(V) S qd of the acceleration. Add this term, "
     "because the preceding joints move the axis of joint i",
                          {"bracket": 0.0}),
    ("bracket-sign",
     "in your result, the term ad(V) S qd of the acceleration has the wrong sign. Add "
     "ad(V) S qd and not ad(S) V qd, because swapping V and S reverses the sign",
     {"bracket": -1.0}),
    ("pose-not-inverted",
     "in your result, V and A are transformed with Ad(T), and the wrench with Ad(T)^T. "
     "Use Ad(T^-1) instead of Ad(T), because it maps from the world frame to the link "
     "frame",
     {"into": adjoint}),
    ("offset-left-out",
     "your result omits the position p of the link's origin, which is in the lower "
     "left block of Ad(T^-1). This block should be -R^T [p], which moves the reference "
     "point of V and A to the link's origin",
     {"into": lambda T: np.kron(np.eye(2), T[:3, :3].T)}),
    ("in-world-axes",
     "your code transforms neither V and A into the link frame nor the wrench back. "
     "Transform all three, because the parameters of a link are expressed in the "
     "link's own frame",
     {"into": lambda T: np.eye(6)}),
    ("wrench-back-with-the-inverse",
     "in your result, the wrench is transformed back to the world frame with Ad(T), as "
     "for a twist. Use Ad(T^-1)^T instead, because the power that the wrench delivers "
     "is the same in both frames",
                                     {"back": np.linalg.inv}),
    ("wrench-not-carried-back",
     "your result only rotates the wrench into the world frame. The transformation "
     "should be Ad(T^-1)^T, which also moves the reference point of the moment to the "
     "world origin",
     {"back": lambda X: np.kron(np.eye(2), X[:3, :3].T)}),
    ("every-joint-feels-every-link",
     "in your result, link i also loads the joints distal to it. Fill only the rows of "
     "joints 1 to i in the columns of link i, because a link causes no torque at the "
     "joints distal to it",
     {"felt": lambda i: slice(0, 7)}),
    ("cut-early",
     "in your result, the row of joint i is 0 in the columns of link i. Fill this row "
     "too, because a link also causes a torque at its own joint",
                  {"felt": lambda i: slice(0, i)}),
    ("cut-late", "your code also fills the row of joint i + 1 in the columns of link "
                 "i. Leave this row 0, because a link causes no torque at the joints "
                 "distal to it",
                 {"felt": lambda i: slice(0, i + 2)}),
    ("later-links-only", "your code fills the rows of joints i to 7 in the columns of "
                         "link i. Fill the rows of joints 1 to i instead, because "
                         "these joints carry link i",
     {"felt": lambda i: slice(i, 7)}),
    ("own-link-only", "your code fills only the row of joint i in the columns of link "
                      "i. Fill the rows of joints 1 to i, because all these joints "
                      "carry link i",
                      {"felt": lambda i: slice(i, i + 1)}),
    ("last-link-missing",
     "your code returns 0 in the columns of the last link. Include all seven links, "
     "because the last link also loads the joints", {"links": 6}),
    ("pose-of-the-link-before", "your code uses the pose of the previous link for each "
                                "link. T_links[0] is already the pose of link 1, and "
                                "T_links[6] is the pose of link 7",
     {"pose": lambda T, i: T[i - 1] if i else np.eye(4)}),
    ("pose-on-the-link-before",
     "your code uses the pose of each link relative to the previous link. Use the "
     "poses in T_links unchanged, because they are already relative to the world",
     {"pose": lambda T, i: inverse(T[i - 1]) @ T[i] if i else T[0]}),
    ("p-sign",
     "in your result, the position p has the wrong sign, as with R^T [p] in the lower "
     "left block of Ad(T^-1). This block should be -R^T [p]",
     {"into": lambda T: below(T[:3, :3].T @ skew(T[:3, 3]), T)}),
    ("p-before-R",
     "your result contains -[p] R^T, but the lower left block of Ad(T^-1) should be "
     "-R^T [p], because p is expressed in the world frame",
     {"into": lambda T: below(-skew(T[:3, 3]) @ T[:3, :3].T, T)}),
    ("p-before-R",
     "your result contains [p] R^T, but the lower left block of Ad(T^-1) should be "
     "-R^T [p], because p is expressed in the world frame",
     {"into": lambda T: below(skew(T[:3, 3]) @ T[:3, :3].T, T)}),
    ("acceleration-starts-anew",
     "your code computes A only from the acceleration of the base and the terms of "
     "joint i. Add the terms of the preceding joints as well",
     {"passed_on": 0.0}),
    ("gravity-forgotten",
     "your result does not depend on g. Begin the accelerations with the acceleration "
     "of the base, which is -g",
                          {"gravity": 0.0}),
    ("acceleration-not-turned",
     "in your result, V is expressed in the link frame, but A is in the world frame. "
     "Transform A as well, because the link regressor needs both in the link frame",
     {"both": False}),
    ("twist-too-late",
     "your result uses the twist of the previous link for each link. The twist of link "
     "i should include the velocity of joint i",
     {"late": True}),
):  # fmt: skip
    row.wrong(slug, says)(partial(walk, **other))


@row.wrong
def added_up_in_the_links(J, T, qd, qdd, g):
    """your code sums V and A in the link frames, so it adds vectors that are expressed
    in different frames. Sum V and A in the world frame instead, or transform the sums
    of the previous link to the next one"""
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
    """your code groups the columns by parameter, with all masses first. Group the
    columns by link instead, with ten columns for each link"""
    Y = arm_regressor(J_space, T_links, qd, qdd, g).reshape(7, 7, 10)
    return np.swapaxes(Y, 1, 2).reshape(7, 70)


TYPED_IN = Change(
    "gravity-typed-in",
    "your code uses the constant (0, 0, -9.81) for gravity. Use the argument g instead",
    lambda g: DOWN,
    hidden="the arm of the lab is upright",
)
row.of_argument("g", TYPED_IN)
row.reached_by(
    "link_regressor", "in `link_regressor`, ", but=["ad-not-transposed-plus"]
)


@row.right  # Seventy robots with one parameter each, through Day 4's inverse dynamics.
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
