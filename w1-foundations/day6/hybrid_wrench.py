"""6.9 `hybrid_wrench(e, V_err, K, D, force)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import draw
from labkit.judge.row import Row

from .states import (
    COUNT,
    WRENCH,
    springs,
)

row = Row(WRENCH)


Z, MOMENT_Z = 5, 2  # of (moment; force)


@row.inputs
def _(rng):
    _, _, K, D = springs(rng)[0]
    case = (np.zeros(6), np.zeros(6), K, D, 10.0)
    forces = draw.numbers(rng, 5, 40, COUNT)
    drawn = springs(rng)[-COUNT:]
    asked = [(*drawn[0], 0.0), (*drawn[1], -12.0)]
    drawn = zip(drawn, forces, strict=True)
    return [case, *asked, *((*spring, float(force)) for spring, force in drawn)]


def _at(wrench, row, value):
    out = wrench.copy()
    out[row] = value
    return out


@row.wrong
def pushes_up(e, V_err, K, D, force):
    """the force has the wrong sign: z points up, and the hand is to push down => the
    right one with +force"""
    return _at(K @ e + D @ V_err, Z, D[Z] @ V_err + force)


@row.wrong
def spring_left_in(e, V_err, K, D, force):
    """the spring along z is still there, and the force comes on top of it: the push
    then depends on how high the hand is => the right one with K e along z"""
    return _at(K @ e + D @ V_err, Z, K[Z] @ e + D[Z] @ V_err - force)


@row.wrong
def damper_left_out(e, V_err, K, D, force):
    """along z the damper is gone with the spring; it stays => the right one without
    it"""
    return _at(K @ e + D @ V_err, Z, -force)


@row.wrong
def damper_left_out(e, V_err, K, D, force):
    """the damper is gone in all six directions; it stays => the right one without any
    damper"""
    return _at(K @ e, Z, -force)


@row.wrong
def damper_sign(e, V_err, K, D, force):
    """the damper drives the hand on: V_err is the target's twist minus the hand's, so
    it is added => the right one with -D V_err"""
    return _at(K @ e - D @ V_err, Z, -D[Z] @ V_err - force)


@row.wrong
def moment_in_place_of_force(e, V_err, K, D, force):
    """entry 2 is replaced: that is the moment about z; forces are the last three => the
    right one with entry 2 replaced"""
    return _at(K @ e + D @ V_err, MOMENT_Z, D[MOMENT_Z] @ V_err - force)


@row.wrong
def moment_in_place_of_force(e, V_err, K, D, force):
    """entry 2 is replaced, and the damper with it: that is the moment about z => the
    right one with entry 2 replaced"""
    return _at(K @ e + D @ V_err, MOMENT_Z, -force)


@row.wrong
def force_only(e, V_err, K, D, force):
    """only the force is left; the other five directions are held by the spring => the
    right one without K e"""
    return _at(D @ V_err, Z, D[Z] @ V_err - force)


@row.wrong
def spring_everywhere(e, V_err, K, D, force):
    """force is not used: this is the spring in all six directions => K e + D V_err"""
    return K @ e + D @ V_err


@row.wrong
def along_x(e, V_err, K, D, force):
    """the force is along x; it is to push along z => the right one with entry 3
    replaced"""
    return _at(K @ e + D @ V_err, 3, D[3] @ V_err - force)


@row.wrong
def spring_couples_into_z(e, V_err, K, D, force):
    """the other five directions of the spring still pull along z: the push there is the
    wanted force and the damper's part, and nothing of K => the right one with K[5, :5]
    @ e[:5] along z"""
    wrench = K @ e + D @ V_err
    wrench[5] = K[5, :5] @ e[:5] + D[5] @ V_err - force
    return wrench


@row.wrong
def column_in_place_of_row(e, V_err, K, D, force):
    """the error along z is left out, and with it K's last column; what is to go is what
    K makes along z, its last row => the right one with e[5] = 0"""
    return _at(K[:, :5] @ e[:5] + D @ V_err, Z, K[Z, :5] @ e[:5] + D[Z] @ V_err - force)


@row.wrong
def column_in_place_of_row(e, V_err, K, D, force):
    """K's last column is gone with its last row; what an error along z makes in the
    other five directions stays => the right one with row and column 5 of K at 0"""
    return _at(K[:, :5] @ e[:5] + D @ V_err, Z, D[Z] @ V_err - force)


@row.right  # With a selection matrix, as Raibert and Craig write it.
def _(e, V_err, K, D, force):
    S = np.diag([1, 1, 1, 1, 1, 0])
    down = np.array([0, 0, 0, 0, 0, -1.0])
    return S @ K @ e + D @ V_err + force * down
