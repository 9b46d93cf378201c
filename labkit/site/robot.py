"""What the site's pages know of the Panda: numbers from MuJoCo's model, no formula."""

from typing import Any

import mujoco

from labkit.site.meshes import END
from robo47 import panda, se3
from robo47.panda import ARM_JOINTS, READY_Q


def numbers() -> dict[str, Any]:
    """Return the arm as a page reads it.

    Returns:
        links: link1 to link7 and the end, each on the one before: its name, the first
            three rows of its pose there (12 numbers), mass (kg), centre of mass in its
            own frame (m).
        limits: of the joints, rad.
        ready: the arm at the ready, rad.
        gravity: m/s^2, upwards.
    """
    model = panda.load("panda_nohand")
    links = []
    for body in [model.body(f"link{i}") for i in range(1, 8)]:
        links.append(_link(body.name, body.pos, body.quat, body.mass[0], body.ipos))
    site = model.site("attachment_site")
    body = model.body(site.bodyid[0])
    assert not site.pos.any() and site.quat[0] == 1  # it sits on its body
    links.append(_link(END, *_on_link7(model, body.name), 0.0, [0.0, 0.0, 0.0]))
    return {
        "links": links,
        "limits": [model.joint(name).range.tolist() for name in ARM_JOINTS],
        "ready": READY_Q.tolist(),
        "gravity": -float(model.opt.gravity[2]),
    }


def _on_link7(model: mujoco.MjModel, name: str) -> tuple[Any, Any]:
    body = model.body(name)
    assert model.body(body.parentid[0]).name == "link7"
    return body.pos, body.quat


def _link(name: str, pos: Any, quat: Any, mass: float, centre: Any) -> dict[str, Any]:
    T = se3.make_T(se3.quat_to_R(quat), pos)
    rows = T[:3].ravel().tolist()
    return {"name": name, "T": rows, "mass": float(mass), "centre": list(map(float, centre))}
