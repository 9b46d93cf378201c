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


@row.wrong(
    "pushes-up",
    "the force has the wrong sign: z points up, and the hand is to push down",
    "the right one with +force",
)
def _(e, V_err, K, D, force):
    return _at(K @ e + D @ V_err, Z, D[Z] @ V_err + force)


@row.wrong(
    "spring-left-in",
    "the spring along z is still there, and the force comes on top of it: the push "
    "then depends on how high the hand is",
    "the right one with K e along z",
)
def _(e, V_err, K, D, force):
    return _at(K @ e + D @ V_err, Z, K[Z] @ e + D[Z] @ V_err - force)


@row.wrong(
    "damper-left-out",
    "along z the damper is gone with the spring; it stays",
    "the right one without it",
)
def _(e, V_err, K, D, force):
    return _at(K @ e + D @ V_err, Z, -force)


@row.wrong(
    "damper-left-out",
    "the damper is gone in all six directions; it stays",
    "the right one without any damper",
)
def _(e, V_err, K, D, force):
    return _at(K @ e, Z, -force)


@row.wrong(
    "damper-sign",
    "the damper drives the hand on: V_err is the target's twist minus the hand's, "
    "so it is added",
    "the right one with -D V_err",
)
def _(e, V_err, K, D, force):
    return _at(K @ e - D @ V_err, Z, -D[Z] @ V_err - force)


@row.wrong(
    "moment-in-place-of-force",
    "entry 2 is replaced: that is the moment about z; forces are the last three",
    "the right one with entry 2 replaced",
)
def _(e, V_err, K, D, force):
    return _at(K @ e + D @ V_err, MOMENT_Z, D[MOMENT_Z] @ V_err - force)


@row.wrong(
    "moment-in-place-of-force",
    "entry 2 is replaced, and the damper with it: that is the moment about z",
    "the right one with entry 2 replaced",
)
def _(e, V_err, K, D, force):
    return _at(K @ e + D @ V_err, MOMENT_Z, -force)


@row.wrong(
    "force-only",
    "only the force is left; the other five directions are held by the spring",
    "the right one without K e",
)
def _(e, V_err, K, D, force):
    return _at(D @ V_err, Z, D[Z] @ V_err - force)


@row.wrong(
    "spring-everywhere",
    "force is not used: this is the spring in all six directions",
    "K e + D V_err",
)
def _(e, V_err, K, D, force):
    return K @ e + D @ V_err


@row.wrong(
    "along-x",
    "the force is along x; it is to push along z",
    "the right one with entry 3 replaced",
)
def _(e, V_err, K, D, force):
    return _at(K @ e + D @ V_err, 3, D[3] @ V_err - force)


@row.wrong(
    "spring-couples-into-z",
    "the other five directions of the spring still pull along z: the push there is "
    "the wanted force and the damper's part, and nothing of K",
    "the right one with K[5, :5] @ e[:5] along z",
    hidden="the lab's springs are not coupled",
)
def _(e, V_err, K, D, force):
    wrench = K @ e + D @ V_err
    wrench[5] = K[5, :5] @ e[:5] + D[5] @ V_err - force
    return wrench


@row.right  # With a selection matrix, as Raibert and Craig write it.
def _(e, V_err, K, D, force):
    S = np.diag([1, 1, 1, 1, 1, 0])
    down = np.array([0, 0, 0, 0, 0, -1.0])
    return S @ K @ e + D @ V_err + force * down
