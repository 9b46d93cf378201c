"""Pictures of the Panda: MuJoCo draws the robot, we draw the frames."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike
from PIL import Image, ImageDraw, ImageFont

from labkit.figures import client, overlay
from labkit.figures.scene import Camera, Ghost, Scene
from robo47 import checks, kinematics, panda, se3
from robo47.checks import Array

LINKS = [f"link{i}" for i in range(8)]
SEEN = 1e-6  # a link whose pose differs by less would flicker through its ghost
REACH = 0.12  # metres: how far the arm's shapes go beyond their frames' origins
OPEN = (0.04, 0.04)  # the fingers of a configuration that is the arm's alone, metres
# The lessons show the arm from its right, a picture to hand in from its left.
FROM_THE_RIGHT = Camera()
FROM_THE_LEFT = Camera(azimuth=np.radians(58.0), elevation=np.radians(-18.0))


def render_panda(
    qpos: ArrayLike,
    size: tuple[int, int] = (1200, 800),
    frames: bool = True,
    *,
    fast: bool = False,
    camera: Camera = FROM_THE_RIGHT,
) -> Image.Image:
    """Return a picture of the Panda.

    Args:
        qpos: configuration, radians: the arm's (7,), or with the fingers' (9,) metres.
        size: width and height, pixels.
        frames: draw and name every link's frame, composed by hand.
        fast: a preview in a tenth of the time, without shadows and smooth edges.
        camera: it steps back as far as the arm reaches.

    Raises:
        ValueError: a configuration of another size, or not finite.
        Robo47Error: nothing draws here; the line names what to install.
    """
    q = with_fingers(qpos)
    poses = link_frames(q)
    camera = camera.stepped_back(corners(poses), size)
    return draw(Scene(q, size, camera, fast=fast), poses if frames else {})


def screenshot(qpos: ArrayLike, title: str) -> Image.Image:
    """Return a picture to hand in: from the left, q (7,) written in its corner."""
    picture = render_panda(qpos, camera=FROM_THE_LEFT)
    joints = " ".join(f"{angle:z.3f}" for angle in with_fingers(qpos)[:7])
    words = f"{title}: q = {joints} rad"
    font = ImageFont.load_default(24)
    ImageDraw.Draw(picture).text((36, 24), words, overlay.INK, font)
    return picture


def draw(scene: Scene, frames: Mapping[str, Array]) -> Image.Image:
    """Return the picture of a scene with frames over it, {name: (4, 4)}."""
    picture = Image.fromarray(client.draw(scene))
    return overlay.draw_frames(picture, scene.camera, frames) if frames else picture


def with_fingers(qpos: ArrayLike) -> Array:
    """Return a configuration of the Panda with its hand, (9,).

    Raises:
        ValueError: not the arm's joints (7,) or those and the fingers' (9,), finite.
    """
    q = np.asarray(qpos, dtype=np.float64)
    if q.shape == (len(panda.READY_Q),):
        q = np.concatenate([q, OPEN])
    return checks.array(q, "qpos", (len(panda.READY_Q) + len(OPEN),))


def link_frames(qpos: Array) -> dict[str, Array]:
    """Return the pose of every link's frame and of the end effector's, `ee`.

    They come from `robo47.kinematics`. `ee` is the frame whose matrix the lessons
    print, `attachment_site`: the hand's origin, turned by 180 degrees about z.
    """
    poses = kinematics.fk_all(panda.load("panda_nohand"), qpos[: len(panda.READY_Q)])
    found = {name: poses[f"body:{name}"] for name in LINKS}
    return {**found, "ee": poses[panda.END_FRAME["panda_nohand"]]}


def ghosts(
    here: Mapping[str, Array], there: Mapping[str, Array], *, wrong: bool = False
) -> tuple[Ghost, ...]:
    """Return ghosts of the links that are somewhere else.

    Args:
        here: {link: its pose where the arm is drawn, (4, 4)}.
        there: the same of another arm; link7 carries the hand along.
        wrong: red, not blue.
    """
    return tuple(
        Ghost(link, T @ se3.inverse(here[link]), alone=link != "link7", wrong=wrong)
        for link, T in there.items()
        if link in LINKS and np.abs(T - here[link]).max() > SEEN
    )


def corners(poses: Mapping[str, Array]) -> Array:
    """Return points that the whole arm lies between, (n, 3), metres."""
    origins = np.array([T[:3, 3] for T in poses.values()])
    sides = REACH * np.vstack([np.eye(3), -np.eye(3)])
    return (origins[:, None] + sides).reshape(-1, 3)
