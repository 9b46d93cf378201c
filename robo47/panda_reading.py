"""What the formulas need to know of the Panda, read from a compiled model by name.

MuJoCo is used to read the file (where each body sits on its parent, where each joint
turns), never to compute the answer. Only the seven arm joints, whatever else the
model holds. Units: metres, radians; screws are (omega; v).
"""

import mujoco
import numpy as np

from robo47 import kinematics
from robo47.checks import Array
from robo47.errors import Robo47Error
from robo47.screws import screw_axis

ARM_JOINTS = tuple(f"joint{i}" for i in range(1, 8))
# Where the arm ends, by entry: the same point, turned by 180 degrees about z.
ENDS = ("site:attachment_site", "body:hand")


def screws(model: mujoco.MjModel) -> Array:
    """Return the space screws of the seven arm joints, with the arm at q = 0.

    Args:
        model: any entry of `robo47.panda.load`.

    Returns:
        Screws (omega; v), (7, 6): no unit; metres.

    Raises:
        Robo47Error: the model has no joint1 to joint7.
    """
    rows = []
    poses = kinematics.fk_all(model, np.zeros(model.nq))
    for name in ARM_JOINTS:
        joint = _joint(model, name)
        T = poses[f"body:{model.body(int(model.jnt_bodyid[joint.id])).name}"]
        R, p = T[:3, :3], T[:3, 3]
        rows.append(screw_axis(R @ joint.axis, p + R @ joint.pos))
    return np.array(rows) + 0.0  # no -0. where people read it


def home_pose(model: mujoco.MjModel) -> Array:
    """Return M: the pose of the arm's end with every joint at 0.

    Args:
        model: any entry of `robo47.panda.load`.

    Returns:
        T_world_ee, (4, 4): of `attachment_site`, or of `hand` where there is one.

    Raises:
        Robo47Error: the model has neither.
    """
    poses = kinematics.fk_all(model, np.zeros(model.nq))
    for frame in ENDS:
        if frame in poses:
            return poses[frame] + 0.0
    raise Robo47Error(f"the model has no {' and no '.join(ENDS)}; load the Panda")


def _joint(model: mujoco.MjModel, name: str):
    try:
        return model.joint(name)
    except KeyError:
        raise Robo47Error(f"the model has no joint {name!r}; load the Panda") from None
