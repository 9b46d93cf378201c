"""What Day 1's functions are asked, and what a right answer is.

The truth comes from MuJoCo and `robo47.se3`, never from the lab script.
"""

import numpy as np

from labkit.base.exchange import Path
from labkit.judge import (
    Ask,
    Case,
    Finding,
    HeldOut,
    Points,
    Pose,
    Probe,
    Robot,
    Rotation,
    Slip,
    draw,
)
from labkit.judge.compare import difference
from labkit.judge.matrices import pose
from robo47 import se3, verify
from robo47.checks import Array

from .mistakes import factors, order, places
from .mistakes.arm import Arm, whole
from .mistakes.poses import INVERSE, MAKE_T
from .mistakes.rotations import QUAT_TO_R, RZ, UNNORMALISED

FLANGE_QUAT = np.array([0.3826834, 0.0, 0.0, 0.9238795])  # as the file rounds it
PATH = (
    ("link0", None),
    *((f"link{i}", f"joint{i}") for i in range(1, 8)),
    ("attachment", None),
)


def _longer(model) -> None:
    """Move link0, lengthen every link and turn one: no number can be typed in."""
    model.body_pos[:] *= 1.2
    model.body_pos[model.body("link0").id] = [0.1, -0.2, 0.3]
    model.body_quat[model.body("link3").id] = [0.6, 0.8, 0.0, 0.0]


PANDA, OTHER = Robot(), Robot(change=_longer)


def _make_T(rng):
    plain = [(np.eye(3), np.array([1.0, 2.0, 3.0]))]
    moves = draw.numbers(rng, -2, 2, 5, 3)
    return plain + list(zip(draw.rotations(rng, 5), moves, strict=True))


def _angles(rng):
    drawn = draw.numbers(rng, -np.pi, np.pi, 3)
    return [(x,) for x in (0.0, np.pi / 2, -0.785, 2.356, -7.1, *map(float, drawn))]


def _inverse(rng):
    move = np.eye(4)
    move[0, 3] = 1.0
    return [(move,), *((T,) for T in draw.poses(rng, 5))]


def _scaled(rng):
    """Return poses whose R is twice a rotation: R^T and an inverse then differ."""
    T = draw.poses(rng, 2)
    T[:, :3, :3] *= 2.0
    return [(one,) for one in T]


def _quaternions(rng) -> Array:
    """As in model files, unit ones, and ones of any length; some with w < 0."""
    written = [[1, 0, 0, 0], [1, 1, 0, 0], [1, -1, 0, 0], FLANGE_QUAT]
    q = rng.normal(size=(6, 4))
    q[:3] /= np.linalg.norm(q[:3], axis=1, keepdims=True)
    q[[1, 4], 0] = -np.abs(q[[1, 4], 0])
    return draw.rounded(np.vstack([np.array(written, dtype=np.float64), q]))


def _links(rng):
    quats = _quaternions(rng)
    return list(zip(draw.numbers(rng, -1, 1, len(quats), 3), quats, strict=True))


def _two_poses(rng):
    return list(zip(draw.poses(rng, 6), draw.poses(rng, 6), strict=True))


def _odd_bottom_rows(rng):
    """Return poses with 2 in the corner: a 4x4 product would carry it along."""
    pairs = _two_poses(rng)[:2]
    for pair in pairs:
        for T in pair:
            T[3, 3] = 2.0
    return pairs


def _by_4x4(T_ee, T_extra):
    products = (T_ee @ T_extra)[:, :3, 3], (T_extra @ T_ee)[:, :3, 3]
    return np.stack(products, axis=1)


def _on(robot, path=None, count=10):
    """Return inputs on a robot: zero, ready, then random configurations."""

    def inputs(rng):
        drawn = draw.configurations(rng, count)
        some = [draw.ZERO, draw.READY, *drawn] if path is None else drawn
        rest = () if path is None else (Path(path),)
        return [(robot, q, *rest) for q in some]

    return inputs


def _prefixes(rng):
    q = draw.configurations(rng, 1)[0]
    return [(PANDA, q, Path(PATH[: k + 1])) for k in range(1, len(PATH))]


def _frame(name):
    return lambda model, q, path=None: verify.mujoco_poses(model, q)[name]


def _flange(case: Case) -> Finding | None:
    """The file gives the flange's rotation to seven digits; MuJoCo normalises it."""
    off = difference(case.S, case.T).max()
    right = se3.quat_to_R(FLANGE_QUAT).T

    def ends_in(R_flange: Array) -> bool:
        again = case.T @ pose(right @ R_flange, np.zeros(3))
        return bool(difference(case.S, again).max() < 0.01 * off)

    says = f"Close, but not equal: off by {off:.1e}. The flange"
    if any(ends_in(make(FLANGE_QUAT)) for make in UNNORMALISED):
        says += (
            "'s quaternion as the file has it is not quite of length 1, and here it "
        )
        return Finding("flange-not-normalised", f"{says}is not normalised.")
    if ends_in(se3.Rz(0.75 * np.pi)):
        says += (
            " is turned by 135 degrees exactly; the file has its quaternion, rounded"
        )
        return Finding("flange-turned-exactly", f"{says} to seven digits.")
    return None


TYPED_IN = HeldOut(
    "typed-in",
    "Right for this Panda. On one whose links are longer and turned it would not be: "
    "it does not take every pos and quat, link0's included, from the given model.",
    _on(OTHER, count=2),
)
NO_INDEX = Slip(
    r"inhomogeneous|only (length-1|0-dimensional) arrays|sequence|ambiguous",
    r"\.qposadr\b(?!\s*\[)",
    "qposadr-is-an-array",
    "model.joint(name).qposadr is an array of one number, so q[...] of it is an array "
    "too; take the number out: qposadr[0].",
)  # fmt: skip


PATH_IGNORED = HeldOut(
    "path-ignored",
    "Right for the whole arm, but it does not look at path: asked for the path to "
    "link4, it goes on to the end effector all the same.",
    _on(PANDA, PATH[:5], count=2),
    mistaken=_frame("site:attachment_site"),
)


def _chain(arm: Arm, frame: str, **more) -> Ask:
    return Ask(
        _on(PANDA),
        Pose(wrong_way=f"maps the world to {arm.end}"),
        truth=_frame(frame),
        mistakes=lambda: places.mistakes_of(arm),
        unnamed=places.unnamed(arm),
        measured=places.measured,
        slips=[NO_INDEX],
        **more,
    )


QUESTIONS = {
    "make_T": Ask(_make_T, Pose(), truth=se3.make_T, mistakes=MAKE_T),
    "Rz": Ask(_angles, Rotation(), truth=se3.Rz, mistakes=RZ),
    "inverse": Ask(
        _inverse,
        Pose(),
        truth=se3.inverse,
        mistakes=INVERSE,
        held_out=[
            HeldOut(
                "general-inverse",
                "The numbers are right, by way of a matrix inverse. The task asks to "
                "do without: what is special about the columns of R?",
                _scaled,
                mistaken=np.linalg.inv,
                status="close",
            )
        ],
    ),
    "quat_to_R": Ask(
        lambda rng: [(quat,) for quat in _quaternions(rng)],
        Rotation(),
        truth=se3.quat_to_R,
        mistakes=QUAT_TO_R,
    ),
    "link_T": Ask(_links, Pose(), truth=factors.link, mistakes=factors.LINK_T),
    "joint_T": Ask(_angles, Pose(), truth=factors.turn, mistakes=factors.JOINT_T),
    "predict_order": Ask(
        _two_poses,
        Points((2, 3)),
        truth=order.both(order.right),
        mistakes=order.PREDICT_ORDER,
        held_out=[
            HeldOut(
                "by-4x4-products",
                "The numbers are right, by way of 4x4 products. The docstring asks for "
                "R and t alone: which of them acts on which?",
                _odd_bottom_rows,
                mistaken=_by_4x4,
                status="close",
            )
        ],
    ),
    "compose_fk": _chain(
        whole(),
        "site:attachment_site",
        held_out=[PATH_IGNORED, TYPED_IN],
        probe=Probe(_prefixes),
        near_miss=_flange,
    ),
    "link4_to_world": _chain(whole().upto(4), "body:link4", held_out=[TYPED_IN]),
}
# One thing with two names: the numbers are the same, and what is said of either is true
# of both. A joint's pose has no translation, so its inverse is its transpose.
_BACKWARDS = {"turns-backwards", "R-transposed", "inverse-returned", "T-transposed"}
_CHAIN = [_BACKWARDS, {"joints-left-out", "R-lost"}]
ALIKE = {
    "Rz": [_BACKWARDS],
    "joint_T": [_BACKWARDS],
    "compose_fk": [*_CHAIN, {"stops-at-link7", "stops-early"}],
    "link4_to_world": _CHAIN,
    "inverse": [
        {"R-kept", "R-transposed"},
        {"unchanged", "inverse-returned"},
        {"t-not-negated", "t-negated"},
    ],
}
