"""Walkers of inverse kinematics, many at once in arrays; their walk is `walk.walk`.

Several may walk to one target: when one of them arrives, the others end. Who has ended
is left out of every array, so that those who go on are all that is computed.

Arrays are columns: q (joints, n), goals (3, 4, targets). Units: metres, radians.
"""

import numpy as np

from robo47.checks import Array
from robo47.fast.chains import Plan
from robo47.fast.jacobians import jacobian_columns
from robo47.fast.walk import NEAR_PI
from robo47.rotation_log import log_rotation


class Many:
    """Walkers towards their targets, within the limits.

    Attributes:
        best: the best place on each one's way, (joints, n).
        miss: the squared length of the pose error there, (n,).
    """

    def __init__(
        self, plan: Plan, goals: Array, limits: Array, q: Array, target: np.ndarray
    ) -> None:
        """Stand at q; `target` says which of the goals each walks to, (n,)."""
        self._plan = plan
        self._goals = goals
        self._low, self._high = limits
        self._q = q
        self._target = target
        self._walker = np.arange(q.shape[1])  # the walkers' indices at the start
        self._arrived = np.zeros(goals.shape[-1], dtype=bool)  # per target
        self.best = q.copy()
        self.miss = np.full(q.shape[1], np.inf)

    def look(self) -> Array:
        """As in `Walkers`."""
        self._J, self._e = self._errors()
        ee = np.einsum("in,in->n", self._e, self._e)
        better = ee < self.miss[self._walker]
        self.best[:, self._walker[better]] = self._q[:, better]
        self.miss[self._walker[better]] = ee[better]
        return ee

    def open(self, far: np.ndarray) -> np.ndarray:
        """As in `Walkers`."""
        self._arrived[self._target[~far]] = True
        return ~self._arrived[self._target]

    def any(self, some: np.ndarray) -> bool:
        """As in `Walkers`."""
        return bool(some.any())

    def only(self, on: np.ndarray, *numbers: Array) -> tuple[Array, ...]:
        """As in `Walkers`."""
        if on.all():
            return numbers
        self._walker = self._walker[on]
        self._target = self._target[on]
        self._q = self._q[:, on]
        self._J = self._J[..., on]
        self._e = self._e[:, on]
        return tuple(some[on] for some in numbers)

    def downhill(self, damping: Array) -> Array:
        """As in `Walkers`."""
        return _damped(self._J, self._e, damping)

    def stuck(self, step: Array) -> np.ndarray:
        """As in `Walkers`."""
        q = self._q
        new = q + step
        return ((new > self._high) & (q >= self._high)) | (
            (new < self._low) & (q <= self._low)
        )

    def without(self, stuck: np.ndarray, step: Array, damping: Array) -> Array:
        """As in `Walkers`."""
        some = stuck.any(axis=0)
        J = np.where(stuck[:, some], 0.0, self._J[..., some])
        step[:, some] = _damped(J, self._e[:, some], damping[some])
        return step

    def go(self, step: Array) -> None:
        """As in `Walkers`."""
        self._q = np.clip(self._q + step, self._low, self._high)

    def _errors(self) -> tuple[Array, Array]:
        """Return the site Jacobian, (6, joints, n), and the pose error, (6, n)."""
        J, end = jacobian_columns(self._plan, self._q, at_end=True)
        goal = self._goals[..., self._target]
        E = np.einsum("ikn,jkn->ijn", goal[:, :3], end[:, :3])
        e = np.empty((6, self._q.shape[1]))
        e[0], e[1], e[2] = E[2, 1] - E[1, 2], E[0, 2] - E[2, 0], E[1, 0] - E[0, 1]
        sine = 0.5 * np.sqrt(np.einsum("in,in->n", e[:3], e[:3]))
        cosine = 0.5 * (E[0, 0] + E[1, 1] + E[2, 2] - 1.0)
        angle = np.arctan2(sine, cosine)
        e[:3] *= 0.5 * np.divide(angle, sine, out=np.ones_like(sine), where=sine > 0.0)
        e[3:] = goal[:, 3] - end[:, 3]
        if (flipped := cosine < NEAR_PI).any():
            e[:3, flipped] = log_rotation(np.moveaxis(E[..., flipped], -1, 0)).T
        return J, e


def _damped(J: Array, e: Array, damping: Array) -> Array:
    """Return J^T (J J^T + damping I)^-1 e; damping is squared already, (n,)."""
    A = np.einsum("ikn,jkn->nij", J, J)
    A[:, range(6), range(6)] += damping[:, None]
    return np.einsum("ikn,ni->kn", J, np.linalg.solve(A, e.T[..., None])[..., 0])
