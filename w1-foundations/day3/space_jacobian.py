"""3.1 `space_jacobian(screws, q)`: its questions and its mistakes."""

from itertools import accumulate

import numpy as np

from labkit.judge import Jacobian, Row
from robo47 import panda
from robo47 import screws as day2
from robo47.jacobian import space_jacobian
from robo47.screws import adjoint, exp_screw, fk_space, skew

from .jacobians import arm

row = Row(Jacobian())


@row.inputs
def _(rng):
    S, _, _ = arm()
    some = [np.zeros(7), panda.READY_Q, *rng.configurations(4)]
    nobody_has = [(_other_arm(rng), q) for q in rng.configurations(2)]
    last = rng.configurations(3)
    return [*((S, q) for q in some), *nobody_has, *((S, q) for q in last)]


def _other_arm(rng):
    """Return screws of an arm that nobody has: unit axes, points anywhere."""
    points = rng.numbers(-1, 1, 7, 3)
    return day2.screw_axis(rng.units(7), points)


def products(screws, q):
    """Return how the first 0 to 7 joints have moved what is behind them."""
    return list(accumulate([np.eye(4), *exp_screw(screws, q)], np.matmul))


def on_the_left(T, motion):
    """Return a pose with a motion on its left."""
    return motion @ T


def carried(screws, moved, adjoint=adjoint):
    """Return the Jacobian whose columns are screws carried by motions."""
    return np.array([adjoint(T) @ S for S, T in zip(screws, moved, strict=False)]).T


def own(blocks):
    """Return an adjoint made of blocks, a function of R and [p]."""
    return lambda T: np.block(blocks(T[:3, :3], skew(T[:3, 3])))


ZERO = np.zeros((3, 3))


@row.wrongs
def _(screws, q):
    """screws-constant: your code uses the screws at q = 0 as columns. Transform each
      screw by the motions of all joints before it
    last-joint-only: your code transforms each screw only by the motion of the joint
      directly before it. Use the motions of all joints before it
    product-reversed: your code transforms each screw by the motions of the joints
      before it in the reverse order. The exponential of joint 1 should be the leftmost
      factor
    one-joint-late: your code transforms each screw without the motion of the joint
      directly before it. Use the motions of all joints before it
    moved-by-the-next: your code also transforms each screw by the motion of the joint
      after it. Use only the motions of the joints before it
    moved-by-all: your code transforms every screw by the motions of all seven joints.
      Use only the motions of the joints before it
    moved-by-those-after: your code transforms each screw by the motions of the joints
      after it. Use the motions of the joints before it instead
    adjoint-of-the-inverse: your code transforms each screw by the inverse of the motion
      of the joints before it. Use the motion itself
    columns-reversed: your code returns the columns in reverse order. The column of
      joint 1 should come first
    """
    alone = [np.eye(4), *exp_screw(screws, q)]
    moved = products(screws, q)
    after = accumulate([np.eye(4), *alone[:0:-1]], on_the_left)
    motions = {
        "screws-constant": [np.eye(4)] * 7,
        "last-joint-only": alone,
        "product-reversed": accumulate(alone, on_the_left),
        "one-joint-late": [np.eye(4), *moved],
        "moved-by-the-next": [*moved[2:], moved[-1]],
        "moved-by-all": [moved[-1]] * 7,
        "moved-by-those-after": list(after)[6::-1],
        "adjoint-of-the-inverse": np.linalg.inv(moved),
    }
    found = {slug: carried(screws, some) for slug, some in motions.items()}
    return {**found, "columns-reversed": lambda: space_jacobian(screws, q)[:, ::-1]}


@row.wrongs
def _(screws, q):
    """bracket-top-right: your omega contains the term p x (R v), as from an adjoint
      with [p] R in the upper right. With the order (omega; v), v should contain the
      term p x (R omega) instead
    bracket-after-R: your v contains the term R (p x omega), as from an adjoint with the
      block R [p]. This term should be p x (R omega), because p is expressed in the
      world frame
    rotation-only: your code only rotates the screws. Their v should also contain the
      term p x (R omega), which is the block [p] R in the lower left of the adjoint
    translation-only: your code does not rotate the screws. Both halves of each screw
      should first be multiplied by R, so the term that is added to v is p x (R omega)
    """
    adjoints = {
        "bracket-top-right": lambda R, P: [[R, P @ R], [ZERO, R]],
        "bracket-after-R": lambda R, P: [[R, ZERO], [R @ P, R]],
        "rotation-only": lambda R, P: [[R, ZERO], [ZERO, R]],
        "translation-only": lambda R, P: [[np.eye(3), ZERO], [P, np.eye(3)]],
    }
    moved = products(screws, q)
    return {slug: carried(screws, moved, own(one)) for slug, one in adjoints.items()}


@row.wrong
def last_column_missing(screws, q):
    """your last column is 0. Does your loop end one joint early?"""
    J = space_jacobian(screws, q)
    J[:, 6] = 0.0
    return J


@row.wrong("shape")  # One row per joint: (7, 6).
def _(screws, q):
    return space_jacobian(screws, q).T


@row.right  # The rotation and the translation so far, without an adjoint.
def _(screws, q):
    R, p = np.eye(3), np.zeros(3)
    columns = []
    for S, T in zip(screws, exp_screw(screws, q), strict=True):
        omega = R @ S[:3]  # the present axis
        v = R @ S[3:] + np.cross(p, omega)  # v of the present screw
        columns.append(np.append(omega, v))
        p = p + R @ T[:3, 3]  # the translation of the joints so far
        R = R @ T[:3, :3]  # the rotation of the joints so far
    return np.array(columns).T


@row.close("rounded-somewhere")  # By central differences of the pose.
def _(screws, q):
    J = np.zeros((6, 7))
    back = np.linalg.inv(fk_space(screws, np.eye(4), q))
    for i, d in enumerate(1e-3 * np.eye(7)):
        ahead, behind = (fk_space(screws, np.eye(4), x) for x in (q + d, q - d))
        V = (ahead - behind) / 2e-3 @ back
        J[:, i] = V[2, 1], V[0, 2], V[1, 0], *V[:3, 3]
    return J


row.spans(  # as small, or as large, as in the lab
    q=(lambda q: 0.2 * q,),
)
