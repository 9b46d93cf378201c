"""The steps of inverse kinematics, their damping, and the stopping rule.

Levenberg-Marquardt steps with the joint limits kept; the damping follows the error
(Sugihara, "Solvability-unconcerned inverse kinematics by the Levenberg-Marquardt
method", IEEE Trans. Robotics 27(5), 2011). A step that would push a joint through its
limit is taken again without that joint. A walker that no longer gains ends.

The walk is stated here, once; the arithmetic is `ik_one`'s, in plain floats, or
of `ik_many`, in arrays.
"""

from typing import Any, NamedTuple, Protocol

STOP = 1e-9  # the length of the error where a walker stops: a tenth of what is asked
# Squared damping that is left where the error is 0: at a singularity J J^T has no
# inverse, however small the error is.
FLOOR = 1e-8
# Cosine of the angle beyond which R - R^T does not give the axis: it is 2 sin(angle)
# times the axis, and nothing at half a turn. `log_rotation` knows more, and costs more.
NEAR_PI = -0.9


class Patience(NamedTuple):
    """The parameters of a walker, and the limits at which it gives up."""

    steps: int  # the largest number of steps
    every: int  # steps between two looks at the squared error
    enough: float  # the walker gives up if a larger share of the error is left
    damping: float  # the squared damping as a share of the squared error


class Walkers(Protocol):
    """One walker, whose numbers are floats and its truths bools; or many, in arrays."""

    def look(self) -> Any:
        """Return the squared error where each stands; remember the best so far."""

    def open(self, far: Any) -> Any:
        """Return who goes on: who is far, as is all that share the target."""

    def any(self, some: Any) -> bool:
        """Return whether some are meant at all."""

    def only(self, on: Any, *numbers: Any) -> tuple[Any, ...]:
        """Let those go on alone; return their numbers of these."""

    def downhill(self, damping: Any) -> Any:
        """Return each one's damped step, J^T (J J^T + damping I)^-1 e."""

    def stuck(self, step: Any) -> Any:
        """Return which joints stand at a limit and would go through it."""

    def without(self, stuck: Any, step: Any, damping: Any) -> Any:
        """Return the step, where joints are stuck the one of the others alone."""

    def go(self, step: Any) -> None:
        """Take the step, no joint farther than its limit."""


def walk(walkers: Walkers, patience: Patience) -> None:
    """Walk until each has arrived, gains no longer, or has taken all its steps.

    Args:
        walkers: where they stand; they remember the best place on their way.
        patience: how they go.
    """
    before: Any = None
    for i in range(patience.steps):
        ee = walkers.look()
        on = walkers.open(ee > STOP**2)
        if i % patience.every == 0:  # not at each step: the error may rise for a while
            if i:
                on = on & (ee < patience.enough * before)
            before = ee
        if not walkers.any(on):
            break
        ee, before = walkers.only(on, ee, before)
        damping = patience.damping * ee + FLOOR
        step = walkers.downhill(damping)
        stuck = walkers.stuck(step)
        if walkers.any(stuck):
            step = walkers.without(stuck, step, damping)
        walkers.go(step)
