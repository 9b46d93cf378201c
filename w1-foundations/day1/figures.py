"""The pictures of Day 1, made with the lab's own functions; drawn by `make figures`.

reference   the Panda at ready, every link's frame and `ee` drawn and named
order       step 4: T_extra on the left of T_world_ee, and on its right
fk_error    step 5: how far the library's poses are from MuJoCo's, link by link
"""

import numpy as np
from day1_transforms import READY_Q, SEED, Rz, compose_fk, inverse, make_T
from PIL import Image

from labkit import figures
from labkit.figures import cards, errorplot, portrait, sheet
from labkit.figures.scene import Camera, Ghost, Scene
from labkit.lesson.day import find_day
from robo47 import kinematics, panda, verify

LIMIT = find_day(1).limit
T_EXTRA = make_T(Rz(np.pi / 4), np.array([0.1, 0.0, 0.0]))  # as in step 4
FROM_ABOVE = Camera((0.27, 0.1, 0.34), 2.0, np.radians(127.0), np.radians(-35.0))
CONFIGURATIONS, CHUNK = 100_000, 10_000
MOVING_LINKS = [f"link{i}" for i in range(1, 8)] + ["hand"]


def reference() -> Image.Image:
    """Return the Panda at ready with its frames."""
    return figures.render_panda(READY_Q)


def order() -> Image.Image:
    """Return what T_extra does on the left, and on the right, side by side."""
    T_world_ee = compose_fk(panda.load("panda_nohand"), READY_Q)
    # Seen from the world, stepping in the tool's own axes is this motion of the tool.
    T_world_step = T_world_ee @ T_EXTRA @ inverse(T_world_ee)
    left = _after(T_world_ee, "T_extra @ T_world_ee", T_EXTRA, "link0")
    right = _after(T_world_ee, "T_world_ee @ T_extra", T_world_step, "hand")
    return sheet.side_by_side(
        (
            left,
            "T_extra on the left",
            "the arm rotates and moves, in the world frame",
        ),
        (right, "T_extra on the right", "the tool moves and rotates, in its own frame"),
    )


def fk_error() -> Image.Image:
    """Return the distribution of the library's error over random configurations."""
    model = panda.load("panda")
    q = verify.random_q(model, CONFIGURATIONS, SEED)
    errors: dict[str, list[np.ndarray]] = {name: [] for name in MOVING_LINKS}
    for chunk in np.split(q, len(q) // CHUNK):  # bounds the memory
        by_hand = kinematics.fk_all(model, chunk)
        truth = verify.mujoco_poses(model, chunk)
        for name in MOVING_LINKS:
            off = np.abs(by_hand[f"body:{name}"] - truth[f"body:{name}"])
            errors[name].append(off.max(axis=(1, 2)))
    return errorplot.ridges({k: np.concatenate(v) for k, v in errors.items()}, LIMIT)


def _after(
    T_world_ee: np.ndarray, name: str, T_world_moved: np.ndarray, body: str
) -> Image.Image:
    """Return the arm, a ghost of a body moved away, and the frames at both ends."""
    q = portrait.with_fingers(READY_Q)
    ghost = Ghost(body, T_world_moved)
    T_moved_ee = T_world_moved @ T_world_ee
    return portrait.draw(
        Scene(q, (800, 680), FROM_ABOVE, (ghost,)),
        {"world": np.eye(4), "T_world_ee": T_world_ee, name: T_moved_ee},
    )


def small() -> Image.Image:
    """Return the arm at ready, the world's frame and the one that is composed."""
    T_world_ee = compose_fk(panda.load("panda_nohand"), READY_Q)
    frames = [*cards.triad(np.eye(4), 0.35), *cards.triad(T_world_ee, 0.28)]
    return cards.arm(READY_Q, boxes=frames)


FIGURES = {"reference": reference, "order": order, "fk_error": fk_error}
SMALL = (small, "")  # of a table of days, and its number
