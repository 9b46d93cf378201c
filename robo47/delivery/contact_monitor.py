"""The contact monitor: Day 9's momentum observer, which can stop the arm.

N m, seconds.
"""

from typing import Any

import numpy as np

from robo47.checks import Array

GAIN = 40.0  # 1/s: a push is felt to 63 % after 25 ms
THRESHOLD = 0.35  # N m, of any joint


class ContactMonitor:
    """The external torque, sample by sample.

    Attributes:
        residual: N m, (7,), of the last sample.
        worst: the largest of any joint and sample so far, N m.
        link: the first link with a torque above the threshold, 1 to 7; 0 for none.
    """

    def __init__(self, fns: Any, damping: Array, dt: float):
        """Begin without a contact; `dt` is the time between two samples."""
        self.fns = fns
        self.damping = damping
        self.dt = dt
        self.worst = 0.0
        self.link = 0
        self.reset()

    def reset(self) -> None:
        """Forget the momentum: what the arm carries, or its reference, has changed."""
        self.residual = np.zeros(7)
        self.integral: Array | None = None
        self.known: tuple[Array, ...] = ()

    def update(self, M: Array, qd: Array) -> int:
        """Take a sample of the moving arm; return the link in contact, or 0."""
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

    def commanded(self, tau: Array, gradient: Array, gravity: Array, qd: Array) -> None:
        """Take what is known of the time until the next sample, (7,) each."""
        self.known = tau, gradient, gravity, self.damping, qd
