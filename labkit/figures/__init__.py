"""Pictures of the robot and its frames, on machines with and without a display.

    from labkit import figures
    figures.render_panda(panda.READY_Q).save("ready.png")

MuJoCo draws the robot in a process of its own (`studio`), with the first OpenGL backend
that really renders here (`backends`). The frames are drawn over it (`overlay`) at the
poses that `robo47.kinematics` composes by hand, so that the two can be compared by eye.

Importing this package imports no MuJoCo: that fails where MUJOCO_GL names a backend
that is not there, and the message about it has to come first.
"""

from typing import Any

from labkit.figures.backends import probe_backends

__all__ = ["probe_backends", "render_panda"]


def __getattr__(name: str) -> Any:
    """Return `render_panda`, imported once it is asked for."""
    if name != "render_panda":
        raise AttributeError(name)
    from labkit.figures.portrait import render_panda

    return render_panda
