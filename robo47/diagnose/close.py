"""Close but not equal: the method is right, and this is where the digits went."""

import numpy as np

from robo47 import se3
from robo47.checks import Array
from robo47.diagnose.compare import difference
from robo47.diagnose.form import Finding
from robo47.diagnose.matrices import pose
from robo47.diagnose.mistakes.rotations import UNNORMALISED

SINGLE = 5e-6  # what products in float32 may leave at worst
SINGLE_INSIDE = 1e-6  # and what one float32 in a float64 file leaves
FLANGE_QUAT = np.array([0.3826834, 0.0, 0.0, 0.9238795])  # as the file rounds it


def explain(function: str, S: Array, T: Array) -> Finding:
    """Return why answers agree with the right ones to some digits only.

    Args:
        function: whose answers they are.
        S: the student's answers, (n, ...), within CLOSE of the right ones.
        T: the right ones.
    """
    if found := rounded(S, T) or (_flange(S, T) if function == "compose_fk" else None):
        return found
    off = difference(S, T).max()
    why = (
        "as single precision leaves: is there a float32 somewhere?"
        if off < SINGLE_INSIDE
        else "so a number is rounded: is one typed by hand, such as 3.14 or 0.707?"
    )
    return Finding(
        "rounded-somewhere",
        f"Close, but not equal: off by {off:.1e} where 1e-15 is usual, {why}",
    )


def rounded(S: Array, T: Array) -> Finding | None:
    """Return to how many decimals the right answers are rounded, if they are.

    Args:
        S: the student's answers, (n, ...).
        T: the right ones.
    """
    for decimals in range(1, 8):
        if difference(S, np.round(T, decimals)).max() < 1e-12:
            return Finding(
                "rounded",
                f"Your answer is rounded to {decimals} decimals, which puts it "
                f"{difference(S, T).max():.0e} off. Round what you print, not what you "
                "return.",
            )
    return None


def _flange(S: Array, T: Array) -> Finding | None:
    """The file gives the flange's turn to seven digits; MuJoCo normalises it."""
    off = f"Close, but not equal: off by {difference(S, T).max():.1e}."
    for make in UNNORMALISED:
        if _ends_in(make(FLANGE_QUAT), S, T):
            return Finding(
                "flange-not-normalised",
                f"{off} The flange's quaternion as the file has it is not quite of "
                "length 1, and here it is not normalised.",
            )
    if _ends_in(se3.Rz(0.75 * np.pi), S, T):
        return Finding(
            "flange-turned-exactly",
            f"{off} The flange is turned by 135 degrees exactly; the file has its "
            "quaternion, rounded to seven digits.",
        )
    return None


def _ends_in(R_flange: Array, S: Array, T: Array) -> bool:
    """Return whether S is T with this rotation for the flange's."""
    R_right = se3.quat_to_R(FLANGE_QUAT)
    again = T @ pose(R_right.T @ R_flange, np.zeros(3))
    return bool(difference(S, again).max() < 0.01 * difference(S, T).max())
