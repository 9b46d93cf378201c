"""The Panda's numbers on the site's pages, from MuJoCo's model."""

from typing import Any

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
    end = model.body(model.site("attachment_site").bodyid[0])  # the site is its origin
    links.append(_link(END, end.pos, end.quat, 0.0, [0.0, 0.0, 0.0]))
    return {
        "links": links,
        "limits": [model.joint(name).range.tolist() for name in ARM_JOINTS],
        "ready": READY_Q.tolist(),
        "gravity": -float(model.opt.gravity[2]),
    }


def _link(name: str, pos: Any, quat: Any, mass: float, centre: Any) -> dict[str, Any]:
    T = se3.make_T(se3.quat_to_R(quat), pos)
    rows = T[:3].ravel().tolist()
    return {
        "name": name,
        "T": rows,
        "mass": float(mass),
        "centre": list(map(float, centre)),
    }
