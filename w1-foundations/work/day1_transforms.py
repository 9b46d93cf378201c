"""Day 1: rigid transforms. Compose the Panda's pose by hand; MuJoCo checks it.

    make day1                        in the clone: sets everything up, then runs this
    python src/day1_transforms.py    in w1-foundations/, once that is done

T_world_ee maps end-effector coordinates to the world, and adjacent inner names
cancel: T_world_link7 @ T_link7_ee. Metres, radians, quaternions (w, x, y, z).
"""

import sys

try:
    import mujoco
    import numpy as np

    from robo47 import cli, panda, verify
    from robo47.lesson.lab import Lab
except ModuleNotFoundError as missing:
    sys.exit(f"{missing.name} is not in this Python: run `make day1`, or `make setup`")

Vec3 = Quat = Mat3 = Mat4 = np.ndarray  # shapes (3,), (4,), (3, 3) and (4, 4)

HOME_Q = panda.READY_Q  # the handout's home_q: seven joint angles, radians
CONFIGURATIONS, SEED = 10_000, 47  # random ones in step 5; a million works too
AGREES = 1e-8  # "the same to 8 decimals"; honest rounding leaves about 1e-15
# From the world to the end effector: each body, and the joint that turns it.
PATH = [("link0", None)] + [(f"link{i}", f"joint{i}") for i in range(1, 8)]
PATH += [("attachment", None)]


def make_T(R: Mat3, t: Vec3) -> Mat4:
    """Return the pose [[R, t], [0, 1]] that turns by R, then moves by t metres.

    make_T(I, (1, 2, 3)) takes the origin to (1, 2, 3).
    """
    # region 1.1
    T = np.eye(4)
    T[:3, :3] = R
    T[:3, 3] = t
    return T
    # endregion 1.1


def Rz(theta: float) -> Mat3:
    """Return the turn by theta radians about z. Rz(pi / 2) takes x to y."""
    # region 1.2
    c, s = np.cos(theta), np.sin(theta)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    # endregion 1.2


def inverse(T: Mat4) -> Mat4:
    """Return the pose that undoes T, without a matrix inverse.

    "Move by (1, 0, 0)" is undone by "move by (-1, 0, 0)".
    """
    # region 1.3
    R, t = T[:3, :3], T[:3, 3]
    return make_T(R.T, -R.T @ t)
    # endregion 1.3


def quat_to_R(quat: Quat) -> Mat3:
    """Return the turn that a quaternion (w, x, y, z) of any length stands for.

    (1, 1, 0, 0), as model files write it, is 90 degrees about x.
    """
    # region 1.4
    w, x, y, z = quat / np.linalg.norm(quat)
    row_x = [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)]
    row_y = [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)]
    row_z = [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]
    return np.array([row_x, row_y, row_z])
    # endregion 1.4


def link_T(pos: Vec3, quat: Quat) -> Mat4:
    """Return a body's pose on its parent, from its pos (metres) and quat in the file.

    pos (0, 0, 0.333) and quat (1, 0, 0, 0) put it 0.333 m above the parent.
    """
    # region 1.5
    return make_T(quat_to_R(quat), pos)
    # endregion 1.5


def joint_T(q: float) -> Mat4:
    """Return what a Panda joint at q radians adds: a turn about its z. At 0, none."""
    # region 1.5
    return make_T(Rz(q), np.zeros(3))
    # endregion 1.5


def compose_fk(model: mujoco.MjModel, q: np.ndarray, path: list = PATH) -> Mat4:
    """Return the pose in the world of a path's last body at joint angles q, (7,).

    With every joint at 0 the arm stands upright, its end 0.088 m in front of the base.
    """
    # region 1.6
    T_world_body = np.eye(4)
    for name, joint in path:
        body = model.body(name)
        T_world_body = T_world_body @ link_T(body.pos, body.quat)
        if joint:
            T_world_body = T_world_body @ joint_T(q[model.joint(joint).qposadr[0]])
    return T_world_body
    # endregion 1.6


def predict_order(T_world_ee: Mat4, T_extra: Mat4) -> tuple[Vec3, Vec3]:
    """Return the translations of T_world_ee @ T_extra and of T_extra @ T_world_ee.

    From R and t alone, no 4x4 product. Two plain moves give the same one twice.
    """
    # region 1.7
    R_ee, t_ee = T_world_ee[:3, :3], T_world_ee[:3, 3]
    R_extra, t_extra = T_extra[:3, :3], T_extra[:3, 3]
    return R_ee @ t_extra + t_ee, R_extra @ t_ee + t_extra
    # endregion 1.7


def link4_to_world(model: mujoco.MjModel, q: np.ndarray) -> Mat4:
    """Return T_world_link4: link4's pos and quat in the file only lead to link3.

    With every joint at 0 link4 hovers at (0.0825, 0, 0.649).
    """
    # region 1.8
    return compose_fk(model, q, PATH[:5])
    # endregion 1.8


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(1, "day1_transforms", __doc__)
    model = panda.load("panda_nohand")  # ends in attachment_site; panda.xml has no site
    data = mujoco.MjData(model)
    print(panda.describe("panda_nohand"))

    lab.step("1. What MuJoCo says")
    data.qpos[:] = HOME_Q
    mujoco.mj_forward(model, data)  # fills xpos and xmat: before it they are all zeros
    site = data.site("attachment_site")
    T_mujoco = make_T(site.xmat.reshape(3, 3), site.xpos)
    lab.show("MuJoCo's T_world_ee at home", T_mujoco)

    lab.step("2. The same by hand: one factor per link, one per joint")
    T_world_ee = compose_fk(model, HOME_Q)  # the site sits right on the last body
    lab.show("T_world_ee composed by hand", T_world_ee)
    lab.check("largest |by hand - MuJoCo|", np.abs(T_world_ee - T_mujoco), AGREES)

    lab.step("3. It is a rigid transform")
    R = T_world_ee[:3, :3]
    inv_err = np.abs(T_world_ee @ inverse(T_world_ee) - np.eye(4))
    lab.check("largest |T @ inv(T) - I|", inv_err, 1e-10)
    lab.check("largest |R @ R.T - I|", np.abs(R @ R.T - np.eye(3)), 1e-10)
    lab.check("|det R - 1|", abs(np.linalg.det(R) - 1), 1e-10)

    lab.step("4. Order matters: T_extra turns 45 degrees about z, 0.1 m along x")
    T_extra = make_T(Rz(np.pi / 4), np.array([0.1, 0.0, 0.0]))
    right, left = (T_world_ee @ T_extra)[:3, 3], (T_extra @ T_world_ee)[:3, 3]
    lab.show("T_world_ee @ T_extra: the tool steps along its own x, to", right)
    lab.show("T_extra @ T_world_ee: the whole arm turns and moves, to", left)
    print(f"  The same two factors, {np.linalg.norm(right - left):.4f} m apart.")
    predicted = np.array(predict_order(T_world_ee, T_extra))
    lab.check("predicted from R and t", np.abs(predicted - [right, left]), AGREES)

    lab.step(f"5. Every named frame at {CONFIGURATIONS:,} random configurations")
    errors = []
    for entry, robot in {"panda_nohand": model, "panda": panda.load("panda")}.items():
        worst = verify.verify_fk(robot, CONFIGURATIONS, SEED)
        lab.check(f"{entry}, worst at {worst.frame}", worst.error, AGREES)
        print(f"        where q = {np.round(worst.q, 2)}")
        errors.append(worst.error)

    lab.step("6. Side quest: link4 as the file has it, and link4 in the world")
    link4, T_world_link4 = model.body("link4"), link4_to_world(model, HOME_Q)
    lab.show("in the file: T_link3_link4", link_T(link4.pos, link4.quat))
    lab.show("data.xpos, in the world", data.body("link4").xpos)
    lab.show("composed up to the world: T_world_link4", T_world_link4)
    gap = np.abs(T_world_link4[:3, 3] - data.body("link4").xpos)
    lab.check("largest |by hand - data.xpos|", gap, AGREES)

    lab.record("fk_identity_check", "inv_err", inv_err, 1e-10, config="panda_home")
    lab.record("fk_by_hand", "max_abs_err", max(errors), AGREES, config="random",
               seed=SEED, n_trials=2 * CONFIGURATIONS)  # fmt: skip
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
