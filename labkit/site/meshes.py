"""The Panda's looks, small enough for a page: one file of triangles.

The robot's own meshes have 34 MB as text. `site/meshes.mjs` takes triangles away where
the shape hardly changes; what is left has three whole numbers a corner.
"""

import json
import tempfile
from pathlib import Path

import numpy as np
import trimesh

from labkit.base import processes
from labkit.inspector.shapes import Shape, shapes
from robo47 import panda, se3
from robo47.checks import Array
from robo47.errors import Robo47Error
from robo47.paths import ROOT

SCRIPT = ROOT / "site" / "meshes.mjs"
LARGEST = 500_000  # bytes of the file
END = "ee"  # the frame of attachment_site, as pages name it
FINGERS = {"left_finger": "finger_joint1", "right_finger": "finger_joint2"}
OPEN = 0.03  # m, of the 0.04 that a finger has
# Where the hand sits on the arm's end: the same point, turned (robo47.panda.END_FRAME).
T_EE_HAND = se3.make_T(se3.Rz(np.pi), np.zeros(3))


def arm() -> list[Shape]:
    """Return the Panda's shapes, each in its link's frame; the hand's in the end's."""
    model = panda.load("panda", meshes=True)
    moves = {"hand": T_EE_HAND}
    for name, joint in FINGERS.items():
        T = se3.make_T(se3.quat_to_R(model.body(name).quat), model.body(name).pos)
        opened = se3.make_T(np.eye(3), OPEN * model.joint(joint).axis)
        moves[name] = T_EE_HAND @ T @ opened
    return [_transformed(_whole(one), moves.get(one.body)) for one in shapes(model)]


def _transformed(shape: Shape, T: Array | None) -> Shape:
    if T is None:
        return shape
    vertices = shape.vertices @ T[:3, :3].T + T[:3, 3]
    return shape._replace(body=END, vertices=vertices)


def _whole(shape: Shape) -> Shape:
    """Return a shape whose triangles share corners; the page finds the sharp edges."""
    mesh = trimesh.Trimesh(shape.vertices, shape.faces, process=False)
    mesh.merge_vertices(merge_norm=True)
    return shape._replace(vertices=mesh.vertices, faces=mesh.faces)


def write(path: Path) -> None:
    """Write the file that site/stage.js reads.

    Raises:
        Robo47Error: it was not made, or is too large.
    """
    with tempfile.TemporaryDirectory(prefix="robo47-meshes-") as name:
        work = Path(name)
        _write_raw(work, arm())
        done = processes.run(["node", str(SCRIPT), name, str(path)], cwd=ROOT)
    if done.returncode:
        raise Robo47Error(f"the arm's meshes: {done.stderr.strip()[-500:]}")
    if path.stat().st_size > LARGEST:
        raise Robo47Error(f"the arm's meshes have {path.stat().st_size:,} bytes")


def _write_raw(work: Path, made: list[Shape]) -> None:
    """Write shapes for `site/meshes.mjs`: corners and faces, and a list of them."""
    with (work / "arm.raw").open("wb") as file:
        for shape in made:
            file.write(shape.vertices.astype("<f4").tobytes())
            file.write(shape.faces.astype("<u4").tobytes())
    listed = [
        {
            "body": shape.body,
            "rgba": [round(x, 3) for x in shape.rgba],
            "vertices": len(shape.vertices),
            "faces": len(shape.faces),
        }
        for shape in made
    ]
    (work / "arm.json").write_text(json.dumps(listed), "utf-8")
