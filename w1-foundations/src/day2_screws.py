"""Day 2: screws. The Panda's pose as a product of exponentials; MuJoCo checks it.

    make day2                      in the clone: sets everything up, then runs this
    python src/day2_screws.py      in w1-foundations/, once that is done

Each joint is a screw axis: a line in the world, with the arm at q = 0. Screws and
twists are (omega; v). T_world_ee maps end-effector coordinates to the world. Metres,
radians.
"""

from typing import NamedTuple

import kit  # noqa: F401 (goes on in the kit's own Python)
import mujoco
import numpy as np

from robo47 import cli, panda, se3, verify
from robo47 import screws as library
from robo47.lesson.lab import Lab

READY_Q = panda.READY_Q  # the handout's home_q: seven joint angles, radians
TRIALS = 500  # random configurations at which your own code is tested
LIBRARY_TRIALS = 10_000  # for the library; a hundred thousand take it a second
SEED = 47  # the same random configurations at every run
# Franka's published table: alpha and theta rotate about x and z, a and d translate
# along them. A table means nothing without its convention. This one is Craig's; swap
# two columns or use another book's formula, and the flange is decimetres off.
FRANKA_DH = np.array([
    # alpha,         a,       d
    [0.0,            0.0,     0.333],
    [-np.pi / 2,     0.0,     0.0],
    [np.pi / 2,      0.0,     0.316],
    [np.pi / 2,      0.0825,  0.0],
    [-np.pi / 2,    -0.0825,  0.384],
    [np.pi / 2,      0.0,     0.0],
    [np.pi / 2,      0.088,   0.0],
    [0.0,            0.0,     0.107],  # the flange: its theta is always 0
])  # fmt: skip


def skew(w: np.ndarray) -> np.ndarray:
    """Return the skew-symmetric matrix [w] with [w] p = w x p for each p, (3, 3).

    w (3,) and p are vectors expressed in the same frame; the entries of [w] have the
    unit of w (Modern Robotics, section 3.2.2).
    skew([0, 0, 1]) -> [[0, -1, 0], [1, 0, 0], [0, 0, 0]]
    """
    # region 2.1
    x, y, z = w  # the components of w
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])  # the matrix of w x p
    # endregion 2.1


def exp_rotation(axis: np.ndarray, theta: float) -> np.ndarray:
    """Return the rotation matrix exp([axis] theta) about a unit axis, (3, 3).

    axis (3,) is a unit vector and theta the angle in radians; the right-hand rule gives
    the sense. Rodrigues' formula is the closed form of the matrix exponential (Modern
    Robotics, eq. 3.51). About (0, 0, 1) it is Day 1's Rz(theta).
    exp_rotation([1, 0, 0], pi / 2) -> [[1, 0, 0], [0, 0, -1], [0, 1, 0]]
    """
    # region 2.2
    K = skew(axis)  # the matrix of the cross product with the axis
    return np.eye(3) + np.sin(theta) * K + (1 - np.cos(theta)) * K @ K  # the rotation
    # endregion 2.2


def screw_axis(axis: np.ndarray, point: np.ndarray) -> np.ndarray:
    """Return the screw axis (omega; v) of a hinge, (6,).

    axis (3,) is the unit vector along the hinge and point (3,) any point on its line,
    in metres, both expressed in the world frame. omega is the axis, and v is the
    velocity of the body's point at the origin while the body rotates at 1 rad/s (Modern
    Robotics, section 3.3.2).
    screw_axis([0, 0, 1], [1, 0, 0]) -> [0, 0, 1, 0, -1, 0]
    """
    # region 2.3
    return np.concatenate([axis, -skew(axis) @ point])  # the screw axis of the hinge
    # endregion 2.3


def exp_screw(S: np.ndarray, theta: float) -> np.ndarray:
    """Return the pose exp([S] theta) of a motion along a screw axis, (4, 4).

    S (6,) is a screw axis (omega; v) whose omega is a unit vector, or 0 for a slide;
    do not divide by its norm. theta is in radians, or in metres for a slide, whose pose
    is the translation theta v (Modern Robotics, eq. 3.88).
    exp_screw([0, 0, 1, 0, -1, 0], pi / 2) ->
    [[0, -1, 0, 1], [1, 0, 0, -1], [0, 0, 1, 0], [0, 0, 0, 1]]
    """
    # region 2.4
    K = skew(S[:3])  # the matrix of the cross product with omega
    c = np.cos(theta)  # the cosine of the angle
    s = np.sin(theta)  # the sine of the angle
    T = np.eye(4)  # the identity, whose last row is (0, 0, 0, 1)
    T[:3, :3] = exp_rotation(S[:3], theta)  # the rotation about omega
    G = theta * np.eye(3) + (1 - c) * K + (theta - s) * K @ K  # the integrated rotation
    T[:3, 3] = G @ S[3:]  # the translation, the integral of the rotated v
    return T
    # endregion 2.4


def joint_screws(T_zero: np.ndarray) -> np.ndarray:
    """Return the screw axes (omega; v) of joints, one in each row, (n, 6).

    T_zero (n, 4, 4) are the poses of the moving links in the world, in metres, with all
    joints at 0. Each joint rotates its link about the link's own z axis, and the origin
    of the link is on this axis (Modern Robotics, section 4.1.1).
    joint_screws([[[1, 0, 0, 1], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]]) ->
    [[0, 0, 1, 0, -1, 0]]. At q = 0 the Panda's joint2 has (0, 1, 0, -0.333, 0, 0).
    """
    # region 2.5
    return np.array([screw_axis(T[:3, 2], T[:3, 3]) for T in T_zero])  # the screws
    # endregion 2.5


def fk_space(screws: np.ndarray, M_home: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Return T_world_ee by the product of exponentials in the world frame, (4, 4).

    screws (n, 6) are the screw axes (omega; v) at q = 0, from the base outwards,
    M_home (4, 4) is the end effector's pose at q = 0, both expressed in the world frame
    and in metres, and q (n,) are the joint angles in radians. The pose is
    exp([S1] q1) ... exp([Sn] qn) M_home (Modern Robotics, section 4.1.1).
    fk_space([[0, 0, 1, 0, -1, 0]], [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0],
    [0, 0, 0, 1]], [pi / 2]) -> [[0, -1, 0, 1], [1, 0, 0, -1], [0, 0, 1, 0],
    [0, 0, 0, 1]]
    """
    # region 2.6
    T = np.eye(4)  # the motion before the first joint
    for S, theta in zip(screws, q, strict=True):
        T = T @ exp_screw(S, theta)  # the combined motion of the joints
    return T @ M_home  # the end effector's pose, moved by all joints
    # endregion 2.6


def adjoint(T: np.ndarray) -> np.ndarray:
    """Return the adjoint Ad(T), which expresses a twist in another frame, (6, 6).

    T (4, 4) is the pose T_a_b of frame b relative to frame a, in metres. If V is a
    twist (omega; v) expressed in b, then Ad(T) V is the same twist expressed in a
    (Modern Robotics, definition 3.20). With T the translation by (1, 0, 0), the twist
    (0, 0, 1, 0, 0, 0) becomes (0, 0, 1, 0, -1, 0).
    """
    # region 2.7
    R, p = T[:3, :3], T[:3, 3]  # the rotation and the translation of the pose
    return np.block([[R, np.zeros((3, 3))], [skew(p) @ R, R]])  # blocks of the adjoint
    # endregion 2.7


def body_screws(screws: np.ndarray, M_home: np.ndarray) -> np.ndarray:
    """Return the screw axes expressed in the end effector's frame at q = 0, (n, 6).

    screws (n, 6) are the screw axes (omega; v) at q = 0, one in each row, expressed in
    the world frame; M_home (4, 4) is T_world_ee at q = 0, in metres (Modern Robotics,
    section 4.1.3). The Panda's last joint has (0, 0, 1, 0, 0, 0).
    body_screws([[0, 0, 1, 0, -1, 0]], [[1, 0, 0, 1], [0, 1, 0, 0], [0, 0, 1, 0],
    [0, 0, 0, 1]]) -> [[0, 0, 1, 0, 0, 0]]
    """
    # region 2.7
    return screws @ adjoint(se3.inverse(M_home)).T  # the body screws
    # endregion 2.7


def fk_body(body_screws: np.ndarray, M_home: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Return T_world_ee by the product of exponentials in the hand frame, (4, 4).

    body_screws (n, 6) are the screw axes (omega; v) at q = 0, from the base outwards,
    expressed in the end effector's frame; M_home (4, 4) is T_world_ee at q = 0, in
    metres, and q (n,) are the joint angles in radians (Modern Robotics, section 4.1.3).
    fk_body([[0, 0, 1, 0, 0, 0]], [[1, 0, 0, 1], [0, 1, 0, 0], [0, 0, 1, 0],
    [0, 0, 0, 1]], [pi / 2]) -> [[0, -1, 0, 1], [1, 0, 0, 0], [0, 0, 1, 0],
    [0, 0, 0, 1]]
    """
    # region 2.8
    T = M_home  # the end effector's pose at q = 0
    for B, theta in zip(body_screws, q, strict=True):
        T = T @ exp_screw(B, theta)  # the pose after the motion of one joint
    return T
    # endregion 2.8


def dh_link(alpha: float, a: float, d: float, theta: float) -> np.ndarray:
    """Return the pose of a link's frame relative to the frame before it, (4, 4).

    alpha (radians) and a (metres) rotate about x and translate along x; theta (radians)
    and d (metres) rotate about z and translate along z. This is Craig's convention:
    the pose is Rot_x(alpha) Trans_x(a) Rot_z(theta) Trans_z(d), in this order (Craig,
    Introduction to Robotics, eq. 3.6).
    dh_link(pi / 2, 0, 0.316, 0) ->
    [[1, 0, 0, 0], [0, 0, -1, -0.316], [0, 1, 0, 0], [0, 0, 0, 1]]
    """
    # region 2.9
    ca = np.cos(alpha)  # the cosine of alpha
    sa = np.sin(alpha)  # the sine of alpha
    c = np.cos(theta)  # the cosine of theta
    s = np.sin(theta)  # the sine of theta
    row_x = [c, -s, 0.0, a]  # the first row of the pose
    row_y = [s * ca, c * ca, -sa, -d * sa]  # the second row of the pose
    row_z = [s * sa, c * sa, ca, d * ca]  # the third row of the pose
    last = [0.0, 0.0, 0.0, 1.0]  # the last row of a homogeneous transform
    return np.array([row_x, row_y, row_z, last])  # the pose of the link
    # endregion 2.9


def dh_fk(table: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Return T_world_flange from a table of DH parameters, (4, 4).

    table (n + 1, 3) has rows (alpha, a, d) in radians and metres, in Craig's
    convention, from the base outwards; q (n,) are the joint angles in radians, the
    theta of the first n rows. The last row belongs to the flange, which no joint moves:
    its theta is 0. The pose is the product of dh_link of all rows, in their order.
    dh_fk([[0, 0, 0.333], [0, 0, 0.107]], [pi / 2]) ->
    [[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0.44], [0, 0, 0, 1]]
    """
    # region 2.9
    T = np.eye(4)  # the pose of the world's own frame
    for (alpha, a, d), theta in zip(table, [*q, 0.0], strict=True):
        T = T @ dh_link(alpha, a, d, theta)  # the pose of the next link's frame
    return T
    # endregion 2.9


class Seen(NamedTuple):
    """MuJoCo's poses and joint axes of the arm at n configurations."""

    T_ee: np.ndarray  # T_world_ee, (n, 4, 4)
    T_links: np.ndarray  # of link1 to link7, (n, 7, 4, 4); the axes are their z
    axes: np.ndarray  # the joints' axes in the world, as screws, (n, 7, 6)


def mujoco_sees(model: mujoco.MjModel, q: np.ndarray) -> Seen:
    """Return MuJoCo's poses and joint axes at configurations q, (n, 7)."""
    data = mujoco.MjData(model)
    site = data.site("attachment_site")
    links = [model.body(f"link{i}").id for i in range(1, 8)]
    T_ee = []
    T_links = []
    axes = []
    for one in q:
        data.qpos[:] = one
        mujoco.mj_kinematics(model, data)  # fills xpos, xmat, xanchor and xaxis
        T_ee.append(se3.make_T(site.xmat.reshape(3, 3), site.xpos))
        T_links.append(se3.make_T(data.xmat[links].reshape(7, 3, 3), data.xpos[links]))
        # xanchor is a point on the axis: Day 2's own formula, with NumPy's cross.
        axes.append(np.hstack([data.xaxis, np.cross(data.xanchor, data.xaxis)]))
    return Seen(np.array(T_ee), np.array(T_links), np.array(axes))


def mujoco_rotation(axis: np.ndarray, theta: float) -> np.ndarray:
    """Return MuJoCo's rotation matrix by theta about a unit axis, (3, 3)."""
    quat = np.empty(4)
    R = np.empty(9)
    mujoco.mju_axisAngle2Quat(quat, axis, theta)  # fills quat: (w, x, y, z)
    mujoco.mju_quat2Mat(R, quat)  # fills R, row by row
    return R.reshape(3, 3)


def random_screws(n: int) -> tuple[np.ndarray, np.ndarray]:
    """Return n screws, (n, 6), of which every fourth is a slide, and angles, (n,)."""
    rng = np.random.default_rng(SEED)
    S = rng.normal(size=(n, 6))
    S[:, :3] /= np.linalg.norm(S[:, :3], axis=1, keepdims=True)
    S[::4, :3] = 0.0
    return S, rng.uniform(-np.pi, np.pi, n)


def bracket(S: np.ndarray) -> np.ndarray:
    """Return [S], (4, 4), the matrix form of a screw, with NumPy's cross product."""
    bracketed = np.zeros((4, 4))
    bracketed[:3, :3] = np.cross(np.eye(3), S[:3])
    bracketed[:3, 3] = S[3:]
    return bracketed


def on_purpose(screws: np.ndarray, M_home: np.ndarray) -> dict:
    """Return {mistake: q -> your own fk_space with this mistake}."""
    omega, v = screws[:, :3], screws[:, 3:]
    M_ready = fk_space(screws, M_home, READY_Q)
    return {
        "no mistake": lambda q: fk_space(screws, M_home, q),
        "v = +omega x point": lambda q: fk_space(np.hstack([omega, -v]), M_home, q),
        "v forgotten": lambda q: fk_space(np.hstack([omega, 0 * v]), M_home, q),
        "(v; omega)": lambda q: fk_space(np.hstack([v, omega]), M_home, q),
        "product in reverse order": lambda q: fk_space(screws[::-1], M_home, q[::-1]),
        "M on the left": lambda q: M_home @ fk_space(screws, np.eye(4), q),
        "q in degrees": lambda q: fk_space(screws, M_home, np.rad2deg(q)),
        "M of the ready pose": lambda q: fk_space(screws, M_ready, q),
    }


def how_far_off(lab: Lab, ways: dict, q: np.ndarray, T_ee: np.ndarray) -> None:
    """Print the position errors at q = 0, in the ready pose, and a random median."""
    print(f"  {'position error, mm':24}{'q = 0':>8}{'ready':>8}{'random':>8}")
    for what, fk in ways.items():
        off = [fk(x)[:3, 3] for x in q] - T_ee[:, :3, 3]
        zero, ready, *others = 1000 * np.linalg.norm(off, axis=1)
        print(f"  {what:24}{zero:8.1f}{ready:8.1f}{np.median(others):8.1f}")
        lab.measured(f"position error at q = 0 with {what}, mm", zero)


def lost_motion(lab: Lab, screws: np.ndarray) -> None:
    """Print the rank of the screws of q = 0."""
    rank = np.linalg.matrix_rank(screws)
    print(f"  The seven screws have rank {rank}; free motion of the hand needs rank 6.")
    lab.measured("independent motions that the seven screws of q = 0 span", rank)
    print("  Which motion of the hand is impossible there? (Day 3 answers.)")


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    model = panda.load("panda_nohand")
    print(panda.describe("panda_nohand"))
    q = np.vstack([np.zeros(7), READY_Q, verify.random_q(model, TRIALS, SEED)])
    mujocos = mujoco_sees(model, q)

    lab.step("1. A rotation about any axis, not only about z")
    a, b = np.random.default_rng(SEED).normal(size=(2, TRIALS, 3))
    off = [skew(x) @ y for x, y in zip(a, b, strict=True)] - np.cross(a, b)
    lab.check("largest |[a] b - a x b|", off)
    S, theta = random_screws(2 * TRIALS)
    turns = S[1::2, :3], theta[1::2]  # every other screw: none of them is a slide
    off = verify.each(exp_rotation, *turns) - verify.each(mujoco_rotation, *turns)
    lab.check("largest |exp_rotation - MuJoCo's|", off)

    lab.step("2. Seven joints: seven screw axes in the world, at q = 0")
    screws = joint_screws(mujocos.T_links[0])  # the first q is 0
    M_home = mujocos.T_ee[0]
    lab.show("(omega; v) of joint1 to joint7", screws, 4)
    lab.measured("third number of v of joint4's screw, m", screws[3, 5])
    # The function gets no q, so it has to find the axes at any configuration.
    off = verify.each(joint_screws, mujocos.T_links) - mujocos.axes
    lab.check(f"largest |by hand - MuJoCo's axes| at {len(q)} q", off)

    lab.step("3. The exponential of one screw: hinges, slides, screws with a pitch")
    # MuJoCo has no call for the motion along a screw, so the library is the reference.
    S, theta = random_screws(TRIALS)
    off = verify.each(exp_screw, S, theta) - library.exp_screw(S, theta)
    lab.check("largest |exp_screw - library|", off)

    lab.step("4. The product of exponentials, and its error with one mistake")
    how_far_off(lab, on_purpose(screws, M_home), q[:22], mujocos.T_ee[:22])
    # The lesson of the day: at q = 0 nearly all mistakes are invisible.
    off = [fk_space(screws, M_home, x) for x in q] - mujocos.T_ee
    lab.check("fk_space at q = 0, where most mistakes are invisible", off[0])
    lab.record("poe_by_hand", np.abs(off[2:]).max(axis=(1, 2)),
               label=f"fk_space at {TRIALS} random configurations",
               config="random", seed=SEED)  # fmt: skip

    lab.step("5. The same pose from screws in the end effector's frame")
    S, _ = random_screws(len(q))
    told = [adjoint(T) @ one for T, one in zip(mujocos.T_ee, S, strict=True)]
    moved = mujocos.T_ee @ verify.each(bracket, S) @ se3.inverse(mujocos.T_ee)
    off = verify.each(bracket, np.array(told)) - moved
    lab.check("largest |[Ad(T) S] - T [S] inv(T)|", off)
    B = body_screws(screws, M_home)
    lab.show("body screws of joint1 to joint7", B, 4)
    off = [fk_body(B, M_home, x) for x in q] - mujocos.T_ee
    lab.check("largest |fk_body - MuJoCo|", off)
    many = verify.random_q(model, LIBRARY_TRIALS, SEED)
    by_library = library.fk_space(panda.screws(model), panda.home_pose(model), many)
    off = by_library - mujoco_sees(model, many).T_ee
    lab.check(f"the library, at {LIBRARY_TRIALS:,} configurations", off)

    lab.step("6. Denavit and Hartenberg: four parameters per link, not six")
    T_flange = mujocos.T_ee.copy()  # the site is the flange, rotated by 135 degrees
    T_flange[:, :3, :3] = mujocos.T_links[:, 6, :3, :3]
    off = [dh_fk(FRANKA_DH, x) for x in q] - T_flange
    lab.show("row 4 of Franka's table, at theta = 0", dh_link(*FRANKA_DH[3], 0.0), 4)
    link4 = model.body("link4")
    in_the_file = se3.make_T(se3.quat_to_R(link4.quat), link4.pos)
    lab.show("link4's pos and quat in the file, as a pose", in_the_file, 4)
    lab.record("dh_by_hand", np.abs(off[2:]).max(axis=(1, 2)),
               label=f"dh_fk at {TRIALS} random configurations",
               config="random", seed=SEED)  # fmt: skip

    lab.step("7. Side quest: the axes of joints 1, 3 and 5 coincide at q = 0")
    lost_motion(lab, screws)
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
