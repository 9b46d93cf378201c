"""What Day 10 asks of MuJoCo: a table with a cube, an eye above it, one on the hand.

No picture is drawn: MuJoCo's `camprojection` sensor says where a point is seen, and
`robo47.depth_camera.depth` casts rays. Camera axes x right, y down, z forward. Metres,
radians.
"""

import itertools

import mujoco
import numpy as np

from robo47 import depth_camera, panda, scenes, se3
from robo47.checks import Array

WIDTH = 320  # pixels
HEIGHT = 240
FOVY = 45.0  # degrees, as MuJoCo has it
AT = np.array([1.15, 0.0, 0.9])  # m, where the eye hangs, and ...
TO = np.array([0.5, 0.0, 0.2])  # ... m, what it looks at: the middle of the table
TABLE = scenes.TABLE_HEIGHT  # m
CUBE_HEIGHT = TABLE + scenes.CUBE_HALF  # m, of its middle
ASIDE = se3.make_T(np.eye(3), (0.0, 0.0, -9.0))  # where no eye sees the cube
# The cube's eight corners in its own axes, m, (8, 3).
CORNERS = scenes.CUBE_HALF * np.array(list(itertools.product((-1, 1), repeat=3)))
# Where the camera sits on the hand, `T_hand_cam`: nobody tells the arm.
ON_HAND = se3.make_T(se3.Rz(0.4) @ se3.Rx(0.2), (0.06, -0.02, 0.05))


def table() -> tuple[mujoco.MjModel, mujoco.MjData]:
    """Return Day 7's table with its cube, the eye above it, and what the eye measures.

    Each corner of the cube is a site with a `camprojection` sensor, "corner0" on.
    """
    spec = mujoco.MjSpec()
    top = (*scenes.TABLE_CENTRE, TABLE - 0.01)
    half = (*scenes.TABLE_HALF, 0.01)
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, pos=top, size=half)
    depth_camera.add(spec.worldbody, "eye", AT, TO, FOVY, (WIDTH, HEIGHT))
    cube = spec.worldbody.add_body(name="cube", mocap=True)
    cube.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(scenes.CUBE_HALF,) * 3)
    for i, corner in enumerate(CORNERS):
        cube.add_site(name=f"corner{i}", pos=corner)
        spec.add_sensor(
            name=f"corner{i}", type=mujoco.mjtSensor.mjSENS_CAMPROJECTION,
            objtype=mujoco.mjtObj.mjOBJ_SITE, objname=f"corner{i}",
            reftype=mujoco.mjtObj.mjOBJ_CAMERA, refname="eye",
        )  # fmt: skip
    model = spec.compile()
    return model, mujoco.MjData(model)


def place(model: mujoco.MjModel, data: mujoco.MjData, T_world_cube: Array) -> None:
    """Put the cube somewhere, before mj_forward."""
    data.mocap_pos[0] = T_world_cube[:3, 3]
    data.mocap_quat[0] = se3.R_to_quat(T_world_cube[:3, :3])


def cubes(n: int, seed: int) -> Array:
    """Return n places of the cube on the table, turned about z: `T_world_cube`."""
    rng = np.random.default_rng(seed)
    xy = rng.uniform((0.4, -0.25), (0.6, 0.25), (n, 2))
    turned = se3.Rz(rng.uniform(-np.pi / 4, np.pi / 4, n))
    return se3.make_T(turned, np.column_stack([xy, np.full(n, CUBE_HEIGHT)]))


def corners_seen(model: mujoco.MjModel, data: mujoco.MjData) -> Array:
    """Return the pixels at which MuJoCo sees the cube's corners, (8, 2)."""
    return np.array([data.sensor(f"corner{i}").data for i in range(len(CORNERS))])


def handheld() -> mujoco.MjModel:
    """Return the Panda with an eye on its hand, `ON_HAND` from attachment_site."""

    def edit(spec: mujoco.MjSpec) -> None:
        site = spec.site("attachment_site")
        T = se3.make_T(se3.quat_to_R(site.quat), site.pos) @ ON_HAND
        quat = se3.R_to_quat(T[:3, :3] @ depth_camera.FLIP)
        site.parent.add_camera(
            name="hand_eye", pos=T[:3, 3], quat=quat, fovy=FOVY,
            resolution=(WIDTH, HEIGHT),
        )  # fmt: skip

    return panda.load("panda_nohand", edit=edit)


def looks(model: mujoco.MjModel, q: Array) -> tuple[Array, Array]:
    """Return `T_world_hand` and `T_world_cam`, (k, 4, 4), of the arm held at q, (k, 7).

    MuJoCo's own: what the arm's encoders and a perfect eye would say.
    """
    data = mujoco.MjData(model)
    hands, eyes = [], []
    for one in q:
        data.qpos[:] = one
        mujoco.mj_forward(model, data)  # fills site_xpos, site_xmat, cam_xpos, cam_xmat
        hand = data.site("attachment_site")
        hands.append(se3.make_T(hand.xmat.reshape(3, 3), hand.xpos))
        eyes.append(depth_camera.camera(model, data, "hand_eye")[1])
    return np.array(hands), np.array(eyes)


def on_top(points: Array) -> Array:
    """Return which points of the world, (n, 3), are 10 mm and more within the table."""
    beside = np.abs(points[:, :2] - scenes.TABLE_CENTRE)
    return (beside < np.array(scenes.TABLE_HALF) - 0.01).all(axis=1)


def faces(n: int = 7) -> Array:
    """Return points on the cube's top and four sides, in its own axes, (5 n n, 3)."""
    line = scenes.CUBE_HALF * (np.arange(n) + 0.5 - n / 2) / (n / 2)
    u, v = (x.ravel() for x in np.meshgrid(line, line))
    out = np.full(u.size, scenes.CUBE_HALF)
    return np.vstack(
        [
            np.column_stack([u, v, out]),
            np.column_stack([u, out, v]),
            np.column_stack([u, -out, v]),
            np.column_stack([out, u, v]),
            np.column_stack([-out, u, v]),
        ]
    )
