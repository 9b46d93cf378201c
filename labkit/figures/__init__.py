"""Pictures of the robot and its frames, on machines with and without a display.

    from robo47 import figures
    figures.render_panda(panda.READY_Q).save("ready.png")

MuJoCo draws the robot in a process of its own (`studio`), with the first OpenGL backend
that really renders here (`backends`). The frames are drawn over it (`overlay`) at the
poses that `robo47.kinematics` composes by hand, so that the two can be compared by eye.

Importing this package imports no MuJoCo: that fails where MUJOCO_GL names a backend
that is not there, and the message about it has to come first.
"""

from typing import TYPE_CHECKING

from labkit.figures.backends import probe_backends

if TYPE_CHECKING:
    from numpy.typing import ArrayLike
    from PIL.Image import Image

    from labkit.figures.scene import Camera

__all__ = ["probe_backends", "render_panda"]


def render_panda(
    qpos: "ArrayLike",
    size: tuple[int, int] = (1200, 800),
    frames: bool = True,
    *,
    fast: bool = False,
    camera: "Camera | None" = None,
) -> "Image":
    """Return a picture of the Panda.

    Args:
        qpos: configuration, radians: the arm's (7,), or with the fingers' (9,) metres.
        size: width and height, pixels.
        frames: draw and name every link's frame, composed by hand.
        fast: a preview in a tenth of the time, without shadows and smooth edges.
        camera: by default from its right, as far away as the arm reaches.

    Raises:
        ValueError: a configuration of another size, or not finite.
        Robo47Error: nothing draws here; the line names what to install.
    """
    from labkit.figures.portrait import portrait

    return portrait(qpos, size, frames, fast, camera)
