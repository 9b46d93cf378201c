"""Joint sliders for a notebook: move a joint, see the arm and both matrices."""

import io
from collections.abc import Callable

import ipywidgets
import mujoco
import numpy as np

from labkit.figures import portrait
from labkit.figures.scene import Camera, Scene
from robo47 import panda
from robo47.checks import Array
from robo47.verify import mujoco_poses

AGREES = 1e-8
SIZE = (720, 540)  # pixels of the preview
CAMERA = Camera((0.1, 0.0, 0.5), 3.2)  # has the whole reach of the arm in view
FRAME = panda.END_FRAME["panda_nohand"]

ForwardKinematics = Callable[[mujoco.MjModel, Array], Array]


def joint_sliders(by_hand: ForwardKinematics | None = None) -> ipywidgets.HBox:
    """Return seven sliders, a picture that follows them, and T_world_ee twice.

    Args:
        by_hand: takes the model and q (7,), radians, and returns T_world_ee (4, 4);
            its answer is shown and drawn as `ee`. By default the library's.

    Raises:
        Robo47Error: nothing draws here; the line names what to install.
    """
    model = panda.load("panda_nohand")
    joints = [model.joint(i) for i in range(model.njnt)]
    sliders = [
        ipywidgets.FloatSlider(
            value, min=joint.range[0], max=joint.range[1], step=0.01,
            description=f"{joint.name}, rad", readout_format=".2f",
        )
        for joint, value in zip(joints, panda.READY_Q, strict=True)
    ]  # fmt: skip
    picture = ipywidgets.Image(format="jpeg")
    numbers = ipywidgets.HTML()

    def follow(_change: object = None) -> None:
        q = np.array([slider.value for slider in sliders])
        scene = Scene(portrait.with_fingers(q), SIZE, CAMERA, fast=True)
        frames = portrait.link_frames(scene.qpos)
        who = "robo47.kinematics"
        if by_hand is not None:
            frames["ee"] = np.asarray(by_hand(model, q))
            who = by_hand.__name__
        file = io.BytesIO()
        portrait.draw(scene, frames).save(file, "JPEG", quality=90)
        picture.value = file.getvalue()
        T_mujoco = mujoco_poses(model, q[None])[FRAME][0]
        numbers.value = compare(frames["ee"], who, T_mujoco)

    for slider in sliders:
        slider.observe(follow, "value")
    follow()
    return ipywidgets.HBox([ipywidgets.VBox([*sliders, numbers]), picture])


def compare(T_world_ee: Array, who: str, T_mujoco: Array) -> str:
    """Return the matrix of `who` and MuJoCo's, and how far apart they are, as HTML."""
    off = float(np.abs(T_world_ee - T_mujoco).max())
    colour = "green" if off < AGREES else "crimson"
    return (
        f"<pre>T_world_ee, {who}\n{as_rows(T_world_ee)}\n"
        f"T_world_ee, MuJoCo (last column in metres)\n{as_rows(T_mujoco)}\n"
        f"<b style='color:{colour}'>largest |{who} - MuJoCo|: {off:.1e}</b></pre>"
    )


def as_rows(T: Array) -> str:
    """Return a matrix in four lines, without "-0.0000"."""
    return "\n".join(" ".join(f"{x:z8.4f}" for x in row) for row in T)
