"""A watch on the arm: Day 9's observer beside the controller, which stops it.

N m, seconds.
"""

from typing import Any

import numpy as np

from robo47.checks import Array

GAIN = 40.0  # 1/s: a push is felt to 63 % after 25 ms
THRESHOLD = 0.35  # N m, of any joint


class ContactMonitor:
    """The torque that nobody commanded, sample by sample.

    Attributes:
        residual: N m, (7,), of the last sample.
        worst: the largest of any joint and sample so far, N m.
        link: which link felt something over the threshold first, 1 to 7; 0 for none.
    """

    def __init__(self, fns: Any, damping: Array, dt: float):
        """Begin with nothing felt; `dt` is the time between two samples."""
        self.fns = fns
        self.damping = damping
        self.dt = dt
        self.worst = 0.0
        self.link = 0
        self.begin()

    def begin(self) -> None:
        """Forget the momentum: what the arm carries, or its reference, has changed."""
        self.residual = np.zeros(7)
        self.integral: Array | None = None
        self.known: tuple[Array, ...] = ()

    def feel(self, M: Array, qd: Array) -> int:
        """Take a sample of the arm as it moves now; return the link that feels it."""
        p = M @ qd
        if self.integral is None:
            self.integral = p
        else:
            self.residual, self.integral = self.fns.momentum_observer_step(
                self.residual, self.integral, p, *self.known, GAIN, self.dt
            )
        self.worst = max(self.worst, float(np.abs(self.residual).max()))
        link = int(self.fns.contact_link(self.residual, THRESHOLD))
        if link and not self.link:
            self.link = link
        return link

    def commanded(self, tau: Array, slope: Array, gravity: Array, qd: Array) -> None:
        """Take what is known of the time until the next sample, (7,) each."""
        self.known = tau, slope, gravity, self.damping, qd
