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
TRIALS = 1_000  # random configurations at which step 5 tests your own code
LIBRARY_TRIALS = 10_000  # for the library, in every frame; a million works too
SEED = 47  # the same random configurations at every run
# From the world to the end effector: each body, and the joint that moves it.
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
    """Return the homogeneous transform [[R, t], [0, 1]] of a pose, (4, 4).

    R (3, 3) is a rotation matrix and t (3,) a translation in metres. The last row is
    (0, 0, 0, 1), so the pose maps a point p to R p + t: it rotates first and then
    translates (Modern Robotics, section 3.3.1).
    make_T([[0, -1, 0], [1, 0, 0], [0, 0, 1]], [0.1, 0.2, 0.3]) ->
    [[0, -1, 0, 0.1], [1, 0, 0, 0.2], [0, 0, 1, 0.3], [0, 0, 0, 1]]
    """
    # region 1.1
    T = np.eye(4)  # the identity, whose last row is (0, 0, 0, 1)
    T[:3, :3] = R  # the rotation, in the upper left block
    T[:3, 3] = t  # the translation, in the last column
    return T
    # endregion 1.1


def Rz(theta: float) -> np.ndarray:
    """Return the rotation matrix of a rotation by theta about the z axis, (3, 3).

    theta is in radians; a positive angle rotates the x axis towards the y axis. The
    columns are the images of the three axes (Modern Robotics, section 3.2.1).
    Rz(pi / 2) -> [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
    """
    # region 1.2
    c, s = np.cos(theta), np.sin(theta)  # the cosine and the sine of the angle
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])  # images in columns
    # endregion 1.2


def inverse(T: np.ndarray) -> np.ndarray:
    """Return the inverse of a pose, which maps R p + t back to p, (4, 4).

    T (4, 4) is a homogeneous transform with the rotation R and the translation t in
    metres; the inverse of T_a_b is T_b_a. Compute it from R and t without a matrix
    inverse, because the inverse of R is its transpose (Modern Robotics, eq. 3.64).
    inverse([[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]]) ->
    [[1, 0, 0, -1], [0, 1, 0, -2], [0, 0, 1, -3], [0, 0, 0, 1]]
    """
    # region 1.3
    R, t = T[:3, :3], T[:3, 3]  # the rotation and the translation of the pose
    return make_T(R.T, -R.T @ t)  # the rotation and the translation of the inverse
    # endregion 1.3


def quat_to_R(quat: np.ndarray) -> np.ndarray:
    """Return the rotation matrix of a quaternion (w, x, y, z), (3, 3).

    quat (4,) has its scalar part w first, as in MuJoCo's files, and any norm except 0.
    It is normalised first, because only a unit quaternion represents a rotation. quat
    and -quat represent the same rotation (Modern Robotics, appendix B.3).
    quat_to_R([1, 1, 0, 0]) -> [[1, 0, 0], [0, 0, -1], [0, 1, 0]]
    """
    # region 1.4
    w, x, y, z = quat / np.linalg.norm(quat)  # the components of the unit quaternion
    row1 = [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)]  # row 1
    row2 = [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)]  # row 2
    row3 = [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]  # row 3
    return np.array([row1, row2, row3])  # the rotation matrix
    # endregion 1.4


def link_T(pos: np.ndarray, quat: np.ndarray) -> np.ndarray:
    """Return the pose of a body relative to its parent, (4, 4).

    pos (3,) is the origin of the body's frame, in metres, and quat (4,) its
    orientation, (w, x, y, z) with any norm except 0. Both are in the model file, and
    both are expressed in the frame of the parent (MuJoCo's XML reference, body).
    link_T([0, 0, 0.333], [2, 0, 0, 0]) ->
    [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0.333], [0, 0, 0, 1]]
    """
    # region 1.5
    return make_T(quat_to_R(quat), pos)  # the rotation and the translation of the file
    # endregion 1.5


def joint_T(q: float) -> np.ndarray:
    """Return the pose of a link at the joint angle q relative to q = 0, (4, 4).

    q is in radians. Each joint of the Panda is a hinge: it rotates its link about the
    z axis of the link and does not translate it (MuJoCo's XML reference, joint).
    joint_T(pi / 2) -> [[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
    """
    # region 1.5
    return make_T(Rz(q), np.zeros(3))  # a rotation about z without a translation
    # endregion 1.5


def compose_fk(model: mujoco.MjModel, q: np.ndarray, path: list = PATH) -> np.ndarray:
    """Return the forward kinematics: the world pose of a path's last body, (4, 4).

    model is MuJoCo's model; body = model.body(name) has body.pos and body.quat, as in
    link_T. q (7,) are the joint angles, in radians, and model.joint(name).qposadr[0] is
    the index of a joint's angle in q. path is a list of pairs (body, joint) from the
    world outwards, such as PATH; joint is None if no joint moves the body. The pose is
    the product of link_T of each body and joint_T of its joint, in this order (Modern
    Robotics, section 3.3.1). With every joint at 0 the translation of the Panda's end
    effector is (0.088, 0, 0.926).
    """
    # region 1.6
    T_world_body = np.eye(4)  # the pose of the world's own frame
    for name, joint in path:
        body = model.body(name)  # the body, with its pos and quat
        T_world_body = T_world_body @ link_T(body.pos, body.quat)  # the pose at angle 0
        if joint:
            angle = q[model.joint(joint).qposadr[0]]  # the angle of the body's joint
            T_world_body = T_world_body @ joint_T(angle)  # the body's pose at its angle
    return T_world_body
    # endregion 1.6


def translations_both_orders(
    T_world_ee: np.ndarray, T_extra: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the translations, (3,) each, of the two products of two poses.

    The first belongs to T_world_ee @ T_extra and the second to T_extra @ T_world_ee, in
    metres. T_world_ee (4, 4) and T_extra (4, 4) are poses. Compute both translations
    from the rotations and the translations of the two poses, without a 4x4 product
    (Modern Robotics, section 3.3.1). The two are equal if neither pose rotates.
    translations_both_orders([[0, -1, 0, 1], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]],
    [[1, 0, 0, 2], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) -> ([1, 2, 0], [3, 0, 0])
    """
    # region 1.7
    R_ee, t_ee = T_world_ee[:3, :3], T_world_ee[:3, 3]  # the blocks of T_world_ee
    R_extra, t_extra = T_extra[:3, :3], T_extra[:3, 3]  # the blocks of T_extra
    return R_ee @ t_extra + t_ee, R_extra @ t_ee + t_extra  # the two translations
    # endregion 1.7


def link4_to_world(model: mujoco.MjModel, q: np.ndarray) -> np.ndarray:
    """Return T_world_link4, the pose of link4 in the world, (4, 4).

    model and q (7,) are as in compose_fk. The pos and quat of link4 in the file are
    relative to link3, so the bodies and joints between the world and link3 contribute
    as well. With every joint at 0 the translation is (0.0825, 0, 0.649).
    """
    # region 1.8
    return compose_fk(model, q, PATH[:5])  # the pose of link4, the fifth body
    # endregion 1.8


def own_errors(model: mujoco.MjModel, q: np.ndarray) -> np.ndarray:
    """Return the largest error of an entry of compose_fk at each q (n, 7), (n,)."""
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

    lab.step("1. MuJoCo's pose of the end effector")
    data.qpos[:] = READY_Q
    mujoco.mj_forward(model, data)  # fills xpos and xmat: before it they are all zeros
    site = data.site("attachment_site")
    T_mujoco = make_T(site.xmat.reshape(3, 3), site.xpos)
    lab.show("MuJoCo's T_world_ee in the ready configuration", T_mujoco)

    lab.step("2. The same pose by hand: one factor per link, one per joint")
    T_world_ee = compose_fk(model, READY_Q)  # the site is at the last body's frame
    lab.show("T_world_ee composed by hand", T_world_ee)
    lab.check("largest |by hand - MuJoCo|", T_world_ee - T_mujoco)
    lab.measured(
        "height of the end effector in the ready configuration, m", T_world_ee[2, 3]
    )

    lab.step("3. Is it a rigid transform? A wrong pose passes these checks too")
    T_hand_ee = make_T(Rz(1.0), np.array([0.1, 0.2, 0.3]))  # R.T == R when ready
    poses = [T_world_ee, T_hand_ee, T_world_ee @ T_hand_ee]
    inv_err = [np.abs(T @ inverse(T) - np.eye(4)).max() for T in poses]
    lab.record("fk_identity_check", inv_err, label="largest |T @ inv(T) - I|")
    R = quat_to_R(np.array([1.0, -1.0, 0.5, 0.0]))  # its norm is 1.5, as files may have
    lab.check("largest |R @ R.T - I|", R @ R.T - np.eye(3))
    lab.check("|det R - 1|", np.linalg.det(R) - 1)

    lab.step("4. The order matters. T_extra: 45 degrees about z, then 0.1 m along x")
    T_extra = make_T(Rz(np.pi / 4), np.array([0.1, 0.0, 0.0]))
    right = (T_world_ee @ T_extra)[:3, 3]
    left = (T_extra @ T_world_ee)[:3, 3]
    lab.show("T_world_ee @ T_extra: the tool moves along its own x axis, to", right)
    lab.show("T_extra @ T_world_ee: the whole arm rotates and moves, to", left)
    apart = np.linalg.norm(right - left)
    print(f"  The distance between the two positions is {apart:.4f} m.")
    says = "distance between T_world_ee @ T_extra and T_extra @ T_world_ee, m"
    lab.measured(says, apart)
    predicted = np.array(translations_both_orders(T_world_ee, T_extra))
    lab.check("your two translations - the products", predicted - [right, left])

    lab.step(f"5. Your compose_fk at {TRIALS:,} random configurations")
    errors = own_errors(model, verify.random_q(model, TRIALS, SEED))
    lab.record("fk_by_hand", errors, label="largest error of an entry of your pose",
               config="random", seed=SEED)  # fmt: skip
    says = "largest error of an entry of your compose_fk at 1,000 q"
    lab.measured(says, errors.max())
    print(f"  The library robo47.kinematics at {LIBRARY_TRIALS:,} configurations:")
    for entry in ("panda_nohand", "panda"):
        worst = verify.verify_fk(panda.load(entry), LIBRARY_TRIALS, SEED)
        lab.check(f"{entry}, every frame, worst at {worst.frame}", worst.error)

    lab.step("6. Side quest: link4 relative to its parent, and in the world")
    link4 = model.body("link4")
    T_world_link4 = link4_to_world(model, READY_Q)
    lab.show("T_link3_link4, from the file", link_T(link4.pos, link4.quat))
    lab.show("MuJoCo's data.xpos, in the world frame", data.body("link4").xpos)
    lab.show("T_world_link4, composed by hand", T_world_link4)
    # The data are from step 1's mj_forward: nothing has changed them since.
    seen = data.body("link4")
    T_mujoco = make_T(seen.xmat.reshape(3, 3), seen.xpos)
    lab.check("largest |by hand - MuJoCo|", T_world_link4 - T_mujoco)
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
