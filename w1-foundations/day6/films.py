"""The film of Day 6, recorded by the site: a soft arm and a stiff one, pressing."""

import day6_task_space as lab
import numpy as np

from labkit.inspector.recording import FRAMES, Recording
from robo47 import panda, scenes, simulate

SECONDS = 3.0


def press() -> Recording:
    """Return both arms, one after the other, and what the table feels."""
    depth = lab.set_point_for_force(lab.PRESS, lab.K[5], scenes.TOUCH)
    height = lambda t: max(depth, scenes.TOUCH + 0.01 - lab.SINK * t)  # noqa: E731
    film = Recording(scenes.press_table(meshes=True), back=1.1)
    arrow = film.draw.arrows([[np.zeros(3), np.full(3, 1e-3)]], "red", 0.012)
    for drive, rate in (("torque", lab.RATE), ("servo", simulate.RATE)):
        model = scenes.press_table(drive=drive)
        q = lab.day6_mujoco.above_table(model, 0.01)
        arm = panda.arm(model)
        soft = drive == "torque"
        law = lab.soft_hand(arm, q, height) if soft else lab.stiff_arm(arm, q)
        data = simulate.start(model, q)
        felt = []
        log = simulate.run(
            model, data, law, SECONDS, rate=rate,
            watch=lambda m, d, to=felt: to.append(
                scenes.contact_force(m, d, "tip", "table_top")
            ),
        )  # fmt: skip
        for t in np.arange(0.0, SECONDS, 1 / FRAMES):
            k = int(t * rate)
            film.pose(log.q[k])
            tip = arm.at(log.q[k]).T_world_ee[:3, 3]
            tip = tip - [0.0, 0.0, scenes.TIP_RADIUS]
            up = [0.0, 0.0, 0.002 * felt[k] + 1e-3]
            arrow.points = np.array([[tip, tip + up]], dtype=np.float32)
            name = "a spring of 400 N/m" if drive == "torque" else "the model's servos"
            film.say(f"{name}: {felt[k]:.0f} N on the table")
            film.wait()
    return film


FILMS = {"press": press}
