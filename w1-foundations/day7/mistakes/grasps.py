"""Mistakes in task 7.7 `grasp_pose(T_world_cube, above)`."""

from collections.abc import Callable

import numpy as np

from labkit.judge.mistake import Mistake
from robo47 import se3
from robo47.checks import Array

DOWN = np.diag([1.0, -1.0, -1.0])
QUARTER = np.pi / 2


def _folded(yaw: Array) -> Array:
    return yaw - np.round(yaw / QUARTER) * QUARTER


def _grasp(
    fold: Callable[[Array], Array] = _folded,
    tool: Array = DOWN,
    up: float = 1.0,
    place: float = 1.0,
    left: bool = False,
) -> Callable[[Array, Array], Array]:
    def redo(T_world_cube: Array, above: Array) -> Array:
        yaw = np.arctan2(T_world_cube[:, 1, 0], T_world_cube[:, 0, 0])
        turn = se3.Rz(fold(yaw))
        T = np.tile(np.eye(4), (len(above), 1, 1))
        T[:, :3, :3] = tool @ turn if left else turn @ tool
        T[:, :3, 3] = place * T_world_cube[:, :3, 3]
        T[:, 2, 3] += up * above
        return T

    return redo


GRASP = [
    Mistake(
        "yaw-not-folded",
        "the tool turns with the cube all the way; a cube looks the same after a "
        "quarter turn, and joint 7 has an end",
        _grasp(fold=lambda yaw: yaw),
        "the pose with the cube's own yaw",
    ),
    Mistake(
        "folded-to-90",
        "the yaw is folded into 0..90 degrees; into +-45 the tool turns less",
        _grasp(fold=lambda yaw: np.mod(yaw, QUARTER)),
        "the pose with yaw mod 90 degrees",
    ),
    Mistake(
        "rounded-towards-zero",
        "the number of quarter turns is cut off, not rounded: up to 90 degrees stay",
        _grasp(fold=lambda yaw: yaw - np.trunc(yaw / QUARTER) * QUARTER),
        "the pose with whole quarter turns cut off",
    ),
    Mistake(
        "folded-by-half-turns",
        "half turns are taken off; a cube looks the same after a quarter already",
        _grasp(fold=lambda yaw: yaw - np.round(yaw / np.pi) * np.pi),
        "the pose with half turns taken off",
    ),
    Mistake(
        "yaw-forgotten",
        "the tool does not turn with the cube: the fingers meet its edges",
        _grasp(fold=lambda yaw: 0.0 * yaw),
        "the pose at yaw 0",
    ),
    Mistake(
        "turned-the-wrong-way",
        "the tool turns the other way than the cube: look at the yaw (its sign, and "
        "which entries atan2 takes), then at the order of the turn and diag(1, -1, -1)",
        _grasp(fold=lambda yaw: -_folded(yaw)),
        "the pose with -yaw",
    ),
    Mistake(
        "tool-up",
        "the tool looks up: its z axis has to point down",
        _grasp(tool=np.eye(3)),
        "the pose with z up",
    ),
    Mistake(
        "about-y",
        "the tool is turned over about y: at yaw 0 its x points backwards",
        _grasp(tool=np.diag([-1.0, 1.0, -1.0])),
        "the pose turned over about y",
    ),
    Mistake(
        "left-handed",
        "turning only z over makes a mirror image: the determinant is -1",
        _grasp(tool=np.diag([1.0, 1.0, -1.0])),
        "the pose with diag(1, 1, -1)",
    ),
    Mistake(
        "height-subtracted",
        "the tool is below the cube: above counts up, and the tool's own z points down",
        _grasp(up=-1.0),
        "the pose below the cube",
    ),
    Mistake(
        "height-forgotten",
        "the tool is in the cube's centre: above is not added",
        _grasp(up=0.0),
        "the pose at the cube's centre",
    ),
    Mistake(
        "place-forgotten",
        "the tool is over the world's origin: the cube's place is missing",
        _grasp(place=0.0),
        "the pose over the origin",
    ),
]
