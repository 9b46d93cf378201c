"""6.9 `hybrid_wrench(e, V_err, K, D, force)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row

from .states import COUNT, WRENCH, springs

row = Row(WRENCH)


Z, MOMENT_Z = 5, 2  # of (moment; force)


@row.inputs
def _(rng):
    _, _, K, D = springs(rng)[0]
    case = (np.zeros(6), np.zeros(6), K, D, 10.0)
    forces = rng.numbers(5, 40, COUNT)
    drawn = springs(rng)[-COUNT:]
    asked = [(*drawn[0], 0.0), (*drawn[1], -12.0)]
    drawn = zip(drawn, forces, strict=True)
    return [case, *asked, *((*spring, float(force)) for spring, force in drawn)]


def at(row, value, wrench):
    """Return a wrench with another value in a row."""
    return np.where(np.arange(6) == row, value, wrench)


@row.wrongs
def _(e, V_err, K, D, force):
    """pushes-up: the force has the wrong sign: z points up, and the hand is to push
      down => the right one with +force
    spring-left-in: the spring along z is still there, and the force comes on top of it:
      the push then depends on how high the hand is => the right one with K e along z
    damper-left-out: along z the damper is gone with the spring; it stays
    damper-sign: the damper drives the hand on: V_err is the target's twist minus the
      hand's, so it is added => the right one with -D V_err
    moment-in-place-of-force: entry 2 is replaced: that is the moment about z; forces
      are the last three => the right one with entry 2 replaced
    force-only: only the force is left; the other five directions are held by the spring
      => the right one without K e
    spring-everywhere: force is not used: this is the spring in all six directions => K
      e + D V_err
    along-x: the force is along x; it is to push along z => the right one with entry 3
      replaced
    spring-couples-into-z: the other five directions of the spring still pull along z:
      the push there is the wanted force and the damper's part, and nothing of K => the
      right one with K[5, :5] @ e[:5] along z
    column-in-place-of-row: the error along z is left out, and with it K's last column;
      what is to go is what K makes along z, its last row => the right one with e[5] = 0
    """
    spring, damper = K @ e, D @ V_err
    both = spring + damper
    push = damper - force
    return {
        "pushes-up": at(Z, damper[Z] + force, both),
        "spring-left-in": at(Z, spring[Z] + push[Z], both),
        "damper-left-out": at(Z, -force, both),
        "damper-sign": at(Z, -damper[Z] - force, spring - damper),
        "moment-in-place-of-force": at(MOMENT_Z, push[MOMENT_Z], both),
        "force-only": at(Z, push[Z], damper),
        "spring-everywhere": both,
        "along-x": at(3, push[3], both),
        "spring-couples-into-z": at(Z, K[Z, :5] @ e[:5] + push[Z], both),
        "column-in-place-of-row": K @ at(Z, 0.0, e) + at(Z, push[Z], damper),
    }


@row.wrongs
def _(e, V_err, K, D, force):
    """damper-left-out: the damper is gone in all six directions; it stays
    moment-in-place-of-force: entry 2 is replaced, and the damper with it: that is
      the moment about z => the right one with entry 2 replaced
    column-in-place-of-row: K's last column is gone with its last row; what an error
      along z makes in the other five directions stays => the right one with row and
      column 5 of K at 0
    """
    return {
        "damper-left-out": at(Z, -force, K @ e),
        "moment-in-place-of-force": at(MOMENT_Z, -force, K @ e + D @ V_err),
        "column-in-place-of-row": (
            at(Z, 0.0, K @ at(Z, 0.0, e)) + at(Z, D[Z] @ V_err - force, D @ V_err)
        ),
    }


@row.right  # With a selection matrix, as Raibert and Craig write it.
def _(e, V_err, K, D, force):
    S = np.diag([1, 1, 1, 1, 1, 0])
    down = np.array([0, 0, 0, 0, 0, -1.0])
    return S @ K @ e + D @ V_err + force * down


row.spans(  # as small, or as large, as in the lab
    e=(lambda e: 40 * e,),
    V_err=(lambda V_err: 20 * V_err,),
    K=(lambda K: 0.005 * K,),
    force=(0.1,),
)
