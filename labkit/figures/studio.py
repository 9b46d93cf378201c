"""The process that draws: reads scenes from stdin, writes pictures to stdout.

    python -m labkit.figures.studio     started by labkit.figures.client, not by hand

A process of its own, since MuJoCo takes its OpenGL backend once and for all when it is
imported, and since a broken driver ends the process that called it.
"""

import os
import pickle
import sys
from functools import lru_cache
from typing import Any

import mujoco
import numpy as np

from labkit.figures.scene import FOVY, NOBODY, Box, Camera, Ghost, Scene
from robo47 import panda
from robo47.checks import Array
from robo47.errors import Robo47Error
from robo47.panda.reading import is_descendant

# The room is dark: a picture of it stands on a light page and on a dark one.
SKY, FLOOR, GRID = (0.106, 0.122, 0.141), (0.15, 0.17, 0.19), (0.24, 0.27, 0.30)
# Metres behind what the camera looks at: there the floor begins to fade into the sky,
# and there it is gone. Nearer, the robot and its ghosts would fade, too.
FADES, GONE = 1.2, 3.2
NOTCH = 0.5  # metres, of the camera's distance: a renderer for each
GHOST_COLOUR = np.array([0.36, 0.52, 0.78, 0.36], dtype=np.float32)
WRONG_COLOUR = np.array([0.85, 0.16, 0.16, 0.5], dtype=np.float32)
VISIBLE = (0, 2)  # geom groups: the twin's shapes, the Menagerie's (3 is collision)


def light_up(spec: mujoco.MjSpec) -> None:
    """Put a robot into a room: a sky of one colour, a floor like it, soft shadows."""
    _add_sky_and_floor(spec)
    for light in spec.lights:  # the Panda brings one that would glare
        light.active = False
    spec.worldbody.add_light(
        pos=[1.7, -1.6, 4.0], dir=[-1.4, 1.6, -3.6], cutoff=60, exponent=0,
        diffuse=[0.42] * 3, specular=[0.1] * 3,
    )  # fmt: skip
    look = spec.visual
    look.headlight.ambient, look.headlight.diffuse = [0.42] * 3, [0.25] * 3
    look.headlight.specular = [0.0] * 3
    look.rgba.fog = [*SKY, 1.0]
    look.map.shadowscale = 0.3  # spend the shadow map on the robot, not the room


def _add_sky_and_floor(spec: mujoco.MjSpec) -> None:
    texture = mujoco.mjtTexture
    flat = mujoco.mjtBuiltin.mjBUILTIN_FLAT
    spec.add_texture(
        name="sky", type=texture.mjTEXTURE_SKYBOX, builtin=flat,
        rgb1=SKY, rgb2=SKY, width=8, height=48,
    )  # fmt: skip
    spec.add_texture(
        name="floor", type=texture.mjTEXTURE_2D, builtin=flat, width=512, height=512,
        mark=mujoco.mjtMark.mjMARK_EDGE, markrgb=GRID,
        rgb1=FLOOR, rgb2=FLOOR,
    )  # fmt: skip
    material = spec.add_material(
        name="floor", texuniform=True, texrepeat=[4, 4], emission=0.36
    )
    material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = "floor"
    plane = mujoco.mjtGeom.mjGEOM_PLANE
    spec.worldbody.add_geom(
        name="floor", type=plane, size=[0, 0, 0.05], material="floor"
    )


@lru_cache(maxsize=2)
def renderer_for(
    size: tuple[int, int], fast: bool, robot: str, far: float
) -> mujoco.Renderer:
    """Return a renderer, kept for the next picture of the same kind.

    Args:
        size, fast, robot: as a scene has them.
        far: from the camera to what it looks at, metres.
    """
    if robot:
        nobody = robot == NOBODY
        spec = mujoco.MjSpec() if nobody else mujoco.MjSpec.from_file(robot)
        light_up(spec)
        if nobody:
            spec.visual.rgba.haze = [*SKY, 1.0]  # it would be white at the horizon
        model = spec.compile()
    else:
        model = panda.load("panda", meshes=True, edit=light_up)
    look = model.vis.map  # read once, by the renderer
    look.fogstart = (far + FADES) / model.stat.extent
    look.fogend = (far + GONE) / model.stat.extent
    model.vis.global_.offwidth, model.vis.global_.offheight = size
    model.vis.global_.fovy = np.degrees(FOVY)
    model.vis.quality.offsamples = 0 if fast else 8
    model.vis.quality.shadowsize = 4096
    return mujoco.Renderer(model, size[1], size[0])


def draw(scene: Scene) -> Array:
    """Return the picture of a scene, (height, width, 3), bytes."""
    far = np.ceil(scene.camera.distance / NOTCH) * NOTCH
    renderer = renderer_for(scene.size, scene.fast, scene.robot, far)
    model = renderer.model
    data = mujoco.MjData(model)
    data.qpos[:] = scene.qpos
    mujoco.mj_forward(model, data)  # lights and cameras too; before it all is black
    option = mujoco.MjvOption()
    option.geomgroup[:] = [group in VISIBLE for group in range(6)]
    renderer.update_scene(data, free_camera(scene.camera), option)
    for flag in (mujoco.mjtRndFlag.mjRND_SHADOW, mujoco.mjtRndFlag.mjRND_REFLECTION):
        renderer.scene.flags[flag] = not scene.fast
    renderer.scene.flags[mujoco.mjtRndFlag.mjRND_FOG] = True
    for ghost in scene.ghosts:
        add_ghost(renderer.scene, model, ghost)
    for box in scene.boxes:
        add_box(renderer.scene, box)
    return renderer.render()


def free_camera(camera: Camera) -> mujoco.MjvCamera:
    """Return MuJoCo's camera, in degrees, for ours, in radians."""
    theirs = mujoco.MjvCamera()
    mujoco.mjv_defaultCamera(theirs)
    theirs.lookat[:] = camera.lookat
    theirs.distance = camera.distance
    theirs.azimuth, theirs.elevation = np.degrees([camera.azimuth, camera.elevation])
    return theirs


def add_ghost(scene: mujoco.MjvScene, model: mujoco.MjModel, ghost: Ghost) -> None:
    """Add translucent copies of the shapes that a body carries to what is drawn."""
    R = ghost.T_world_moved[:3, :3]
    t = ghost.T_world_moved[:3, 3]
    carrier = model.body(ghost.body).id
    for original in list(scene.geoms[: scene.ngeom]):
        body = model.geom_bodyid[original.objid]
        if body != carrier and (ghost.alone or not is_descendant(model, body, carrier)):
            continue
        colour = WRONG_COLOUR if ghost.wrong else GHOST_COLOUR
        size = original.size
        pos = R @ original.pos + t
        mat = R @ original.mat
        copy = add_shape(scene, original.type, size, pos, mat, colour)
        copy.objtype, copy.objid = original.objtype, original.objid
        copy.dataid, copy.camdist = original.dataid, original.camdist
        copy.transparent = 1


def add_box(scene: mujoco.MjvScene, box: Box) -> None:
    """Add a box, or another solid, to what is drawn."""
    R = box.T_world_box[:3, :3]
    t = box.T_world_box[:3, 3]
    colour = np.array(box.colour, dtype=np.float32)
    kind = getattr(mujoco.mjtGeom, f"mjGEOM_{box.kind.upper()}")
    shape = add_shape(scene, kind, np.array(box.half), t, R, colour)
    shape.objtype = mujoco.mjtObj.mjOBJ_UNKNOWN
    shape.objid = -1
    shape.dataid, shape.transparent = -1, int(colour[3] < 1.0)


def add_shape(
    scene: mujoco.MjvScene, kind: int, size: Array, pos: Array, R: Array, colour: Any
) -> mujoco.MjvGeom:
    """Return a shape that is drawn besides.

    What mjv_initGeom leaves as it was in memory, and drawing depends on, is to be set.
    """
    geom = scene.geoms[scene.ngeom]
    mujoco.mjv_initGeom(geom, kind, size, pos, R.ravel(), colour)
    geom.segid = -1
    geom.category = mujoco.mjtCatBit.mjCAT_DECOR
    scene.ngeom += 1
    return geom


def serve() -> None:
    """Answer each pickled Scene with its picture or an error, until stdin ends."""
    replies = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # drivers print to stdout; they shall not garble the pictures
    while True:
        try:
            scene = pickle.load(sys.stdin.buffer)
        except EOFError:
            return
        try:
            reply: Array | Robo47Error = draw(scene)
        except Robo47Error as error:
            reply = error
        pickle.dump(reply, replies)
        replies.flush()


if __name__ == "__main__":
    serve()
