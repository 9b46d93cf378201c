"""What the published handout's Day 1 script does, fixed so that it runs.

Only what it takes to run is fixed: `panda_nohand.xml`, which has the site, instead of
`scene.xml`. It loads the robot with its meshes, checks T @ inv(T) = I, multiplies in
both orders, and looks at link4. It never composes a pose by hand.
"""

import sys

import mujoco
import numpy as np

model = mujoco.MjModel.from_xml_path(sys.argv[1])
data = mujoco.MjData(model)
data.qpos[:7] = [0, -0.785, 0, -2.356, 0, 1.571, 0.785]
mujoco.mj_forward(model, data)

T = np.eye(4)
T[:3, :3] = data.site("attachment_site").xmat.reshape(3, 3)
T[:3, 3] = data.site("attachment_site").xpos
print(T)
print("inverse error", np.linalg.norm(T @ np.linalg.inv(T) - np.eye(4)))

c = np.cos(np.pi / 4)
T_extra = np.array([[c, -c, 0, 0.1], [c, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
print((T @ T_extra)[:3, 3], (T_extra @ T)[:3, 3])
print(model.body("link4").pos, data.body("link4").xpos)
