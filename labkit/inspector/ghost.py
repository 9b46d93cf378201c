"""The student's own forward kinematics, as poses to draw and as one sentence.

A day says in its `inspector.py` which function is the chain and what to ask it:

    GHOST = Ghost("fk", frames=("link0", ..., "ee"), questions=ask)

What comes back is compared with MuJoCo here; the code that gave it ran in the checker's
sandbox (`student`). Metres, radians.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import mujoco
import numpy as np

from labkit.inspector.arm import AGREES
from robo47 import se3
from robo47.checks import Array

Arguments = tuple[Any, ...]
FARTHEST = 1e3  # metres; a frame further away is not drawn


@dataclass(frozen=True)
class Ghost:
    """Which function of the student's draws the ghost arm, and how."""

    function: str  # its name in the student's file
    frames: tuple[str, ...]  # short names, from the base to the end
    # `questions(model, q)` returns the function's arguments for each of the frames, in
    # that order; `model` itself may be among them.
    questions: Callable[[mujoco.MjModel, Array], Sequence[Arguments]]
    # `whole(model, q)` returns those for the last frame alone, asked where the function
    # answers none of the questions; None for never.
    whole: Callable[[mujoco.MjModel, Array], Arguments] | None = None


@dataclass(frozen=True)
class Seen:
    """What the student's function said of a configuration."""

    sentence: str  # how the student's arm compares, or why there is none
    # "good", "bad", "quiet" where nothing is written or begun, "asking" until it is
    # known, "" where nobody asked.
    kind: str
    poses: Mapping[str, Array] = field(default_factory=dict)  # {short name: (4, 4)}
    truth: Mapping[str, Array] = field(default_factory=dict)  # MuJoCo's of all frames
    drawn: Mapping[str, Array] = field(default_factory=dict)  # rigid, where they differ


def asked(ghost: Ghost | None) -> Seen:
    """Return that nothing is known of a file that was saved a moment ago."""
    return Seen(f"asking YOUR {ghost.function} ..." if ghost else "", "asking")


def nothing(why: str) -> Seen:
    """Return that there is no pose, and why."""
    return Seen(why, "quiet" if "Not written yet" in why else "bad")


def compare(
    ghost: Ghost, poses: Mapping[str, Array], problem: str, truth: Mapping[str, Array]
) -> Seen:
    """Return how what a ghost's function said differs from MuJoCo.

    Args:
        ghost: whose function it is.
        poses: what it said, {short name: (4, 4)}, from the base on.
        problem: why there are none, or fewer than asked for; else "".
        truth: MuJoCo's poses, {short name: (4, 4)}.
    """
    whose = f"YOUR {ghost.function}"
    last = ghost.frames[-1]
    apart = {name: float(np.abs(T - truth[name]).max()) for name, T in poses.items()}
    wrong = [name for name, difference in apart.items() if not difference < AGREES]
    if wrong:
        end = last if last in wrong else wrong[-1]
        how = _how_far(poses[end], truth[end])
        says = f"{whose} is off by {how} at {end}; first frame that differs: {wrong[0]}"
        if bent := [name for name in wrong if not se3.is_pose(poses[name])]:
            says += f". {bent[0]} has no rotation in it; drawn is the nearest one"
        drawn = {name: nearest_pose(poses[name]) for name in wrong}
        return Seen(f"{says}. {problem}".strip(), "bad", poses, truth, drawn)
    if last not in apart:
        return nothing(problem or f"{whose} gave no pose")
    worst = max(apart.values())
    where = "at every frame" if len(apart) == len(ghost.frames) else "here"
    says = f"{whose} agrees with MuJoCo {where}: largest difference {worst:.1e}"
    return Seen(f"{says}. {problem}".rstrip(". "), "good", poses, truth)


def _how_far(T: Array, truth: Array) -> str:
    """Return a distance, or an angle where the place is right."""
    metres, radians = se3.pose_distance(nearest_pose(T), truth)
    if metres >= 1e-3:
        return f"{1000 * metres:.0f} mm"
    if (degrees := np.degrees(radians)) >= 0.05:
        return f"{degrees:.1f} degrees"
    return f"{float(np.abs(T - truth).max()):.1e} (largest entry)"


def nearest_pose(T: Array) -> Array:
    """Return the rigid transform nearest to a finite matrix, (4, 4), for drawing it.

    The rotation is the nearest in the least-squares sense (Kabsch 1976).
    """
    U, _, Vt = np.linalg.svd(T[:3, :3])
    U[:, 2] *= np.sign(np.linalg.det(U @ Vt)) or 1.0
    nearest = np.eye(4)
    nearest[:3, :3] = U @ Vt
    nearest[:3, 3] = T[:3, 3]
    return nearest


def no_pose(function: str, value: Any) -> str:
    """Return why a function's value cannot be drawn as a pose; "" where it can."""
    if not isinstance(value, np.ndarray):
        got = "nothing" if value is None else type(value).__name__
        return f"{function} returned {got}; a pose is an array of shape (4, 4)."
    if value.dtype.kind not in "fiub":
        return f"{function} returned {value.dtype}; a pose is made of real numbers."
    if value.shape != (4, 4):
        return f"{function} returned shape {value.shape}; a pose has shape (4, 4)."
    if not np.isfinite(value).all():
        return f"{function} returned numbers that are not finite."
    if np.abs(value[:3, 3]).max() > FARTHEST:
        return f"{function} returned a place over a kilometre away."
    return ""
