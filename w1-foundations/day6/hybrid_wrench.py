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
    """pushes-up: your code uses `force` with the wrong sign. The z axis points up, but
      with a positive `force` the hand should push down
    spring-left-in: your code keeps the spring force along z, so the normal force
      depends on the height of the hand. Remove the spring force along z
    damper-left-out: your code omits the damping force along z. Remove only the spring
      force along z
    moment-in-place-of-force: your code changes entry 2, which is the moment about z.
      Change entry 5 instead, which is the force along z
    spring-everywhere: your result does not depend on `force`, because it is the
      impedance wrench in all six directions. Replace the spring force along z with
      `-force`
    along-x: your code applies `force` along x. The force should act along z
    spring-couples-into-z: your code removes only the contribution of the error along z
      from the spring force along z. The other five errors also contribute to this
      force, so remove the whole last entry of K e
    column-in-place-of-row: your result ignores the error along z in all six directions,
      so the last column of K has no effect. Remove the spring force along z instead,
      which is `K[5] @ e`
    """
    spring, damper = K @ e, D @ V_err
    both = spring + damper
    push = damper - force
    return {
        "pushes-up": at(Z, damper[Z] + force, both),
        "spring-left-in": at(Z, spring[Z] + push[Z], both),
        "damper-left-out": at(Z, -force, both),
        "moment-in-place-of-force": at(MOMENT_Z, push[MOMENT_Z], both),
        "spring-everywhere": both,
        "along-x": at(3, push[3], both),
        "spring-couples-into-z": at(Z, K[Z, :5] @ e[:5] + push[Z], both),
        "column-in-place-of-row": K @ at(Z, 0.0, e) + at(Z, push[Z], damper),
    }


@row.wrongs
def _(e, V_err, K, D, force):
    """moment-in-place-of-force: your result has the force in entry 2, which is the
      moment about z, and omits the damping term of this entry. Change entry 5 instead,
      which is the force along z, and keep the damping term
    column-in-place-of-row: your result omits the spring force along z and also ignores
      the error along z in the other five directions. Remove only the spring force along
      z, because an error along z should still contribute to the other five directions
    """
    return {
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
