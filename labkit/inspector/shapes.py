"""Shapes of a MuJoCo model: its visible geoms as triangle meshes per body.

Geoms of the groups that MuJoCo's own viewer shows at start (0 to 2; collision shapes
are in group 3), meshes as well as primitives. Metres.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import mujoco
import numpy as np
import trimesh
from numpy.typing import NDArray

from robo47 import se3
from robo47.checks import Array

VISIBLE_GROUPS = (0, 1, 2)
COLLISION_GROUPS = (3,)
WHITE = (0.92, 0.92, 0.92, 1.0)  # collision shapes have no colour
PACKED = 4096  # steps per metre of a corner's coordinates, which a film packs well
GRID = 1 / 256  # m: the grid of a ghost's corners, see `thinned`
LARGER = 0.0015  # m, of a ghost than its arm, and of a second one than the first
Rgba = tuple[float, ...]  # four


class Shape(NamedTuple):
    """Everything of one body that has one colour."""

    body: str  # its name
    rgba: Rgba  # colour and opacity, 0 to 1
    vertices: Array  # in the body's frame, metres, (n, 3)
    faces: NDArray[np.int32]  # indices into vertices, (m, 3)


def shapes(
    model: mujoco.MjModel, groups: tuple[int, ...] = VISIBLE_GROUPS
) -> list[Shape]:
    """Return a model's looks, one shape per body and colour, of some groups of geoms.

    Planes and height fields are left out; collision shapes are some 60 times simpler.
    """
    parts: dict[tuple[str, Rgba], tuple[Any, Any]] = {}
    for geom in np.flatnonzero(np.isin(model.geom_group, groups)):
        kind = mujoco.mjtGeom(model.geom_type[geom])
        if kind == mujoco.mjtGeom.mjGEOM_MESH:
            made = _mesh(model, model.geom_dataid[geom])
        elif kind in _PRIMITIVES:
            made = _PRIMITIVES[kind](model.geom_size[geom])
        else:  # an endless one
            continue
        body, material = model.geom_bodyid[geom], model.geom_matid[geom]
        rgba = model.mat_rgba[material] if material >= 0 else model.geom_rgba[geom]
        look = (model.body(body).name, tuple(rgba.tolist()))
        vertices, faces = parts.setdefault(look, ([], []))
        R = se3.quat_to_R(model.geom_quat[geom])
        vertices.append(made.vertices @ R.T + model.geom_pos[geom])
        faces.append(made.faces)
    found = []
    append: Any = trimesh.util.append_faces
    for (name, rgba), part in parts.items():
        vertices, faces = append(*part)
        found.append(Shape(name, rgba, vertices, faces))
    return found


def simple_links(model: mujoco.MjModel) -> list[Shape]:
    """Return the shapes that a model collides with, in the colour of the links."""
    return [s._replace(rgba=WHITE) for s in shapes(model, COLLISION_GROUPS)]


def thinned(shape: Shape, grid: float) -> Shape:
    """Return a shape with a quarter of its bytes, for a file that is sent to others.

    Corners that share a cell of a grid, in metres, and look the same way become one in
    their middle; triangles without an area go.
    """
    sides = shape.vertices[shape.faces]
    facing = np.cross(sides[:, 1] - sides[:, 0], sides[:, 2] - sides[:, 0])
    normals = np.zeros_like(shape.vertices)
    np.add.at(normals, shape.faces, facing[:, None])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.round(normals / np.maximum(lengths, 1e-12))
    _, cell, count = _distinct(np.round(shape.vertices / grid))
    middles = np.zeros((len(count), 3))
    np.add.at(middles, cell, shape.vertices / count[cell, None])
    middles = np.round(middles * PACKED) / PACKED
    # A sharp edge has two corners at a place.
    at, became, _ = _distinct(np.column_stack([cell, normals]))
    middles = middles[cell[at]]
    a, b, c = np.moveaxis(middles[became[shape.faces]], 1, 0)
    solid = np.linalg.norm(np.cross(b - a, c - a), axis=1) > 0
    if not solid.any():  # a film of paint on a link
        return shape
    faces = became[shape.faces][solid]
    used, faces = np.unique(faces[_distinct(faces)[0]], return_inverse=True)
    faces = faces.reshape(-1, 3).astype(np.int32)
    return shape._replace(vertices=middles[used], faces=faces)


def larger(shape: Shape, by: float) -> Shape:
    """Return a shape that is larger all around, by metres.

    Two equal surfaces in one place would flicker: a ghost is larger than its arm.
    """
    sides = shape.vertices[shape.faces]
    facing = np.cross(sides[:, 1] - sides[:, 0], sides[:, 2] - sides[:, 0])
    normals = np.zeros_like(shape.vertices)
    for corner in range(3):
        np.add.at(normals, shape.faces[:, corner], facing)
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
    vertices = np.round((shape.vertices + by * normals) * PACKED) / PACKED
    return shape._replace(vertices=vertices)


def _distinct(rows: Array) -> list[NDArray[np.intp]]:
    """Return where whole-numbered rows stand first, which each one is, how many of it.

    As np.unique does with axis=0, several times faster: a row is made one number.
    """
    rows = (rows - rows.min(axis=0)).astype(np.int64)
    keys = np.ravel_multi_index(tuple(rows.T), tuple(rows.max(axis=0) + 1))
    return [*np.unique(keys, True, True, True)[1:]]


def _mesh(model: mujoco.MjModel, mesh: int) -> trimesh.Trimesh:
    """Return a mesh whose corners are split where the file's normals differ.

    The browser smooths normals over shared corners; without the split every sharp
    edge of the robot would look melted.
    """
    item = model.mesh(mesh)
    first, count = int(item.faceadr[0]), int(item.facenum[0])
    corners = model.mesh_face[first : first + count].ravel()
    normals = model.mesh_facenormal[first : first + count].ravel()
    at, faces, _ = _distinct(np.column_stack([corners, normals]))
    vertices = model.mesh_vert[int(item.vertadr[0]) + corners[at]]
    return trimesh.Trimesh(vertices, faces.reshape(-1, 3), process=False)


def _box(size: Array) -> trimesh.Trimesh:
    made = trimesh.creation.box(extents=2 * size)
    made.unmerge_vertices()  # else the browser would round its edges off
    return made


def _ellipsoid(size: Array) -> trimesh.Trimesh:
    made = trimesh.creation.icosphere(subdivisions=3)
    made.vertices *= size
    return made


_PRIMITIVES: dict[mujoco.mjtGeom, Callable[[Array], trimesh.Trimesh]] = {
    mujoco.mjtGeom.mjGEOM_SPHERE: lambda s: _ellipsoid(np.full(3, s[0])),
    mujoco.mjtGeom.mjGEOM_ELLIPSOID: _ellipsoid,
    mujoco.mjtGeom.mjGEOM_BOX: _box,
    mujoco.mjtGeom.mjGEOM_CAPSULE: lambda s: trimesh.creation.capsule(
        radius=s[0], height=2 * s[1]
    ),
    mujoco.mjtGeom.mjGEOM_CYLINDER: lambda s: trimesh.creation.cylinder(
        radius=s[0], height=2 * s[1], sections=48
    ),
}
