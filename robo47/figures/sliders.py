"""Joint sliders for a notebook: move a joint, see the arm and both matrices."""

import io

import ipywidgets
import mujoco
import numpy as np

from robo47 import figures, kinematics, panda, se3
from robo47.checks import Array
from robo47.figures.scene import Camera

AGREES = 1e-8
SIZE = (720, 540)  # pixels of the preview
CAMERA = Camera((0.1, 0.0, 0.5), 3.2)  # has the whole reach of the arm in view


def joint_sliders() -> ipywidgets.HBox:
    """Return seven sliders, a picture that follows them, and T_world_ee twice.

    Raises:
        Robo47Error: nothing draws here; the line names what to install.
    """
    model = panda.load("panda_nohand")
    joints = [model.joint(i) for i in range(model.njnt)]
    sliders = [
        ipywidgets.FloatSlider(
            value, min=joint.range[0], max=joint.range[1], step=0.01,
            description=joint.name, readout_format=".2f",
        )
        for joint, value in zip(joints, panda.READY_Q, strict=True)
    ]  # fmt: skip
    picture, numbers = ipywidgets.Image(format="jpeg"), ipywidgets.HTML()

    def follow(_change: object = None) -> None:
        q = np.array([slider.value for slider in sliders])
        file = io.BytesIO()
        figures.render_panda(q, SIZE, fast=True, camera=CAMERA).save(
            file, "JPEG", quality=90
        )
        picture.value, numbers.value = file.getvalue(), compare(model, q)

    for slider in sliders:
        slider.observe(follow, "value")
    follow()
    return ipywidgets.HBox([ipywidgets.VBox([*sliders, numbers]), picture])


def compare(model: mujoco.MjModel, q: Array) -> str:
    """Return T_world_ee by hand, and how far from MuJoCo's it is, as HTML.

    Args:
        model: "panda_nohand".
        q: the arm's configuration, (7,).
    """
    frame = panda.END_FRAME["panda_nohand"]
    by_hand = kinematics.fk(kinematics.chain_to(model, frame), q)
    data = mujoco.MjData(model)
    data.qpos[:] = q
    mujoco.mj_forward(model, data)  # fills site.xpos and site.xmat
    site = data.site(frame.removeprefix("site:"))
    off = np.abs(by_hand - se3.make_T(site.xmat.reshape(3, 3), site.xpos)).max()
    rows = "\n".join(" ".join(f"{x:8.4f}" for x in row) for row in by_hand + 0.0)
    colour = "green" if off < AGREES else "crimson"
    return (
        f"<pre>T_world_ee by hand\n{rows}\n"
        f"<b style='color:{colour}'>largest |by hand - MuJoCo|: {off:.1e}</b></pre>"
    )
