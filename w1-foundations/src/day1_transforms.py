"""Day 1: rigid transforms. Compose the Panda's pose by hand; MuJoCo checks it.

    make day1                        in the clone: sets everything up, then runs this
    python src/day1_transforms.py    in w1-foundations/, once that is done

T_world_ee maps end-effector coordinates to the world, and adjacent inner names
cancel: T_world_link7 @ T_link7_ee. Metres, radians, quaternions (w, x, y, z).
"""

import kit  # noqa: F401 (goes on in the kit's own Python)
import mujoco
import numpy as np

from robo47 import cli, panda, verify
from robo47.lesson.lab import Lab

READY_Q = panda.READY_Q  # the handout's home_q: seven joint angles, radians
TRIALS = 1_000  # random configurations that your own code is judged on in step 5
LIBRARY_TRIALS = 10_000  # and the library, in every frame; a million works too
SEED = 47  # the same random configurations at every run
# From the world to the end effector: each body, and the joint that turns it.
PATH = [
    ("link0", None),
    ("link1", "joint1"),
    ("link2", "joint2"),
    ("link3", "joint3"),
    ("link4", "joint4"),
    ("link5", "joint5"),
    ("link6", "joint6"),
    ("link7", "joint7"),
    ("attachment", None),
]


def make_T(R: np.ndarray, t: np.ndarray) -> np.ndarray:
    """Return the pose [[R, t], [0, 1]] that turns by R, then moves by t metres.

    make_T(I, (1, 2, 3)) takes the origin to (1, 2, 3).
    """
    # region 1.1
    T = np.eye(4)
    T[:3, :3] = R
    T[:3, 3] = t
    return T
    # endregion 1.1


def Rz(theta: float) -> np.ndarray:
    """Return the turn by theta radians about z. Rz(pi / 2) takes x to y."""
    # region 1.2
    c, s = np.cos(theta), np.sin(theta)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    # endregion 1.2


def inverse(T: np.ndarray) -> np.ndarray:
    """Return the pose that undoes T, without a matrix inverse.

    "Move by (1, 0, 0)" is undone by "move by (-1, 0, 0)".
    """
    # region 1.3
    R, t = T[:3, :3], T[:3, 3]
    return make_T(R.T, -R.T @ t)
    # endregion 1.3


def quat_to_R(quat: np.ndarray) -> np.ndarray:
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


def link_T(pos: np.ndarray, quat: np.ndarray) -> np.ndarray:
    """Return a body's pose on its parent, from its pos (metres) and quat in the file.

    pos (0, 0, 0.333) and quat (1, 0, 0, 0) put it 0.333 m above the parent.
    """
    # region 1.5
    return make_T(quat_to_R(quat), pos)
    # endregion 1.5


def joint_T(q: float) -> np.ndarray:
    """Return what a Panda joint at q radians adds: a turn about its z. At 0, none."""
    # region 1.5
    return make_T(Rz(q), np.zeros(3))
    # endregion 1.5


def compose_fk(model: mujoco.MjModel, q: np.ndarray, path: list = PATH) -> np.ndarray:
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


def translations_both_orders(
    T_world_ee: np.ndarray, T_extra: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the translations of T_world_ee @ T_extra and of T_extra @ T_world_ee.

    From R and t alone, no 4x4 product. Two plain moves give the same one twice.
    """
    # region 1.7
    R_ee, t_ee = T_world_ee[:3, :3], T_world_ee[:3, 3]
    R_extra, t_extra = T_extra[:3, :3], T_extra[:3, 3]
    return R_ee @ t_extra + t_ee, R_extra @ t_ee + t_extra
    # endregion 1.7


def link4_to_world(model: mujoco.MjModel, q: np.ndarray) -> np.ndarray:
    """Return T_world_link4: link4's pos and quat in the file only lead to link3.

    With every joint at 0 link4 hovers at (0.0825, 0, 0.649).
    """
    # region 1.8
    return compose_fk(model, q, PATH[:5])
    # endregion 1.8


def own_errors(model: mujoco.MjModel, q: np.ndarray) -> np.ndarray:
    """Return how far compose_fk is from MuJoCo at configurations q, (n, 7): (n,)."""
    data = mujoco.MjData(model)
    site = data.site("attachment_site")
    errors = []
    for one in q:
        data.qpos[:] = one
        mujoco.mj_kinematics(model, data)  # fills xpos and xmat, and no forces
        T_mujoco = np.eye(4)
        T_mujoco[:3, :3] = site.xmat.reshape(3, 3)
        T_mujoco[:3, 3] = site.xpos
        errors.append(np.abs(compose_fk(model, one) - T_mujoco).max())
    return np.array(errors)


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    model = panda.load("panda_nohand")  # ends in attachment_site; panda.xml has no site
    data = mujoco.MjData(model)
    print(panda.describe("panda_nohand"))

    lab.step("1. What MuJoCo says")
    data.qpos[:] = READY_Q
    mujoco.mj_forward(model, data)  # fills xpos and xmat: before it they are all zeros
    site = data.site("attachment_site")
    T_mujoco = make_T(site.xmat.reshape(3, 3), site.xpos)
    lab.show("MuJoCo's T_world_ee when the arm is ready", T_mujoco)

    lab.step("2. The same by hand: one factor per link, one per joint")
    T_world_ee = compose_fk(model, READY_Q)  # the site sits right on the last body
    lab.show("T_world_ee composed by hand", T_world_ee)
    lab.check("largest |by hand - MuJoCo|", T_world_ee - T_mujoco)
    lab.measured(
        "height of the end effector in the ready configuration, m", T_world_ee[2, 3]
    )

    lab.step("3. It is a rigid transform: true of any pose, also of a wrong one")
    T_hand_ee = make_T(Rz(1.0), np.array([0.1, 0.2, 0.3]))  # R.T == R when ready
    poses = [T_world_ee, T_hand_ee, T_world_ee @ T_hand_ee]
    inv_err = [np.abs(T @ inverse(T) - np.eye(4)).max() for T in poses]
    lab.record("fk_identity_check", inv_err, label="largest |T @ inv(T) - I|")
    R = quat_to_R(np.array([1.0, -1.0, 0.5, 0.0]))  # of length 1.5, as files may write
    lab.check("largest |R @ R.T - I|", R @ R.T - np.eye(3))
    lab.check("|det R - 1|", np.linalg.det(R) - 1)

    lab.step("4. Order matters: T_extra turns 45 degrees about z, 0.1 m along x")
    T_extra = make_T(Rz(np.pi / 4), np.array([0.1, 0.0, 0.0]))
    right = (T_world_ee @ T_extra)[:3, 3]
    left = (T_extra @ T_world_ee)[:3, 3]
    lab.show("T_world_ee @ T_extra: the tool steps along its own x, to", right)
    lab.show("T_extra @ T_world_ee: the whole arm turns and moves, to", left)
    apart = np.linalg.norm(right - left)
    print(f"  The same two factors, {apart:.4f} m apart.")
    says = "distance between T_world_ee @ T_extra and T_extra @ T_world_ee, m"
    lab.measured(says, apart)
    predicted = np.array(translations_both_orders(T_world_ee, T_extra))
    lab.check("predicted from R and t", predicted - [right, left])

    lab.step(f"5. Your compose_fk at {TRIALS:,} random configurations")
    errors = own_errors(model, verify.random_q(model, TRIALS, SEED))
    lab.record("fk_by_hand", errors, label="worst entry of any pose, by hand",
               config="random", seed=SEED)  # fmt: skip
    says = "largest error of an entry of your compose_fk at 1,000 q"
    lab.measured(says, errors.max())
    print(f"  The library robo47.kinematics at {LIBRARY_TRIALS:,}, in every frame:")
    for entry in ("panda_nohand", "panda"):
        worst = verify.verify_fk(panda.load(entry), LIBRARY_TRIALS, SEED)
        lab.check(f"{entry}, worst at {worst.frame}", worst.error)

    lab.step("6. Side quest: link4 as the file has it, and link4 in the world")
    link4 = model.body("link4")
    T_world_link4 = link4_to_world(model, READY_Q)
    lab.show("in the file: T_link3_link4", link_T(link4.pos, link4.quat))
    lab.show("data.xpos, in the world", data.body("link4").xpos)
    lab.show("composed up to the world: T_world_link4", T_world_link4)
    # Still those of step 1's mj_forward: nothing has changed data since.
    seen = data.body("link4")
    T_mujoco = make_T(seen.xmat.reshape(3, 3), seen.xpos)
    lab.check("largest |by hand - MuJoCo|", T_world_link4 - T_mujoco)
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
