"""Day 2: screws. The Panda's pose as a product of exponentials; MuJoCo checks it.

    make day2                      in the clone: sets everything up, then runs this
    python src/day2_screws.py      in w1-foundations/, once that is done

A joint is a screw: a line in the world, with the arm at q = 0. Screws and twists are
(omega; v). T_world_ee maps end-effector coordinates to the world. Metres, radians.
"""

from typing import NamedTuple

import kit  # noqa: F401 (goes on in the kit's own Python)
import mujoco
import numpy as np

from robo47 import cli, panda, se3, verify
from robo47 import screws as library
from robo47.lesson.lab import Lab

READY_Q = panda.READY_Q  # the handout's home_q: seven joint angles, radians
TRIALS = 500  # random configurations that your own code is judged on
LIBRARY_TRIALS = 10_000  # and the library; a hundred thousand take it a second
SEED = 47  # the same random configurations at every run
# Franka's published table: alpha and theta turn about x and z, a and d move along them.
# A table means nothing without its convention. This one is Craig's; swap two columns
# or use another book's formula, and the arm ends up decimetres away.
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
    """Return [w], (3, 3), the matrix that takes p to w x p.

    skew((0, 0, 1)) takes (1, 0, 0) to (0, 1, 0).
    """
    # region 2.1
    x, y, z = w
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    # endregion 2.1


def exp_rotation(axis: np.ndarray, theta: float) -> np.ndarray:
    """Return the rotation by theta about an axis of length 1, (3, 3).

    About (0, 0, 1) it is Day 1's Rz(theta).
    """
    # region 2.2
    K = skew(axis)
    return np.eye(3) + np.sin(theta) * K + (1 - np.cos(theta)) * K @ K
    # endregion 2.2


def screw_axis(axis: np.ndarray, point: np.ndarray) -> np.ndarray:
    """Return a hinge's screw (omega; v), (6,), from its unit axis and a point on it.

    The z axis through (1, 0, 0) is (0, 0, 1, 0, -1, 0).
    """
    # region 2.3
    return np.concatenate([axis, -skew(axis) @ point])
    # endregion 2.3


def exp_screw(S: np.ndarray, theta: float) -> np.ndarray:
    """Return the pose after moving by theta along a screw (omega; v), (4, 4).

    omega has length 1, or is 0: then it is a slide by theta v. A quarter turn about
    (0, 0, 1, 0, -1, 0) takes the origin to (1, -1, 0).
    """
    # region 2.4
    K = skew(S[:3])
    c = np.cos(theta)
    s = np.sin(theta)
    T = np.eye(4)
    T[:3, :3] = exp_rotation(S[:3], theta)
    T[:3, 3] = (theta * np.eye(3) + (1 - c) * K + (theta - s) * K @ K) @ S[3:]
    return T
    # endregion 2.4


def joint_screws(T_zero: np.ndarray) -> np.ndarray:
    """Return the screws, (7, 6), of joints that turn about their links' z axes.

    From the links' poses in the world, (7, 4, 4). With the Panda at q = 0 joint2's is
    (0, 1, 0, -0.333, 0, 0).
    """
    # region 2.5
    return np.array([screw_axis(T[:3, 2], T[:3, 3]) for T in T_zero])
    # endregion 2.5


def fk_space(screws: np.ndarray, M_home: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Return T_world_ee, (4, 4), from screws (7, 6), its pose at q = 0, and q, (7,).

    At q = 0 it is M_home: 0.088 m in front of the base and 0.926 m up.
    """
    # region 2.6
    T = np.eye(4)
    for S, theta in zip(screws, q, strict=True):
        T = T @ exp_screw(S, theta)
    return T @ M_home
    # endregion 2.6


def adjoint(T: np.ndarray) -> np.ndarray:
    """Return Ad(T), (6, 6), of T_a_b: it takes a twist seen from b to one seen from a.

    With T the move by (1, 0, 0), a spin about b's z axis has v = (0, -1, 0) in a.
    """
    # region 2.7
    R, p = T[:3, :3], T[:3, 3]
    return np.block([[R, np.zeros((3, 3))], [skew(p) @ R, R]])
    # endregion 2.7


def body_screws(screws: np.ndarray, M_home: np.ndarray) -> np.ndarray:
    """Return the screws, (7, 6), as the end effector sees them at q = 0.

    The Panda's last joint turns it about its own z: (0, 0, 1, 0, 0, 0).
    """
    # region 2.7
    return screws @ adjoint(se3.inverse(M_home)).T
    # endregion 2.7


def fk_body(body_screws: np.ndarray, M_home: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Return T_world_ee, (4, 4), from body screws (7, 6). At q = 0 it is M_home."""
    # region 2.8
    T = M_home
    for B, theta in zip(body_screws, q, strict=True):
        T = T @ exp_screw(B, theta)
    return T
    # endregion 2.8


def dh_link(alpha: float, a: float, d: float, theta: float) -> np.ndarray:
    """Return a link's pose on the one before, (4, 4), as Craig does: Rx, Tx, Rz, Tz.

    dh_link(pi / 2, 0, 0.316, 0) puts it at (0, -0.316, 0), as the file puts link3.
    """
    # region 2.9
    ca = np.cos(alpha)
    sa = np.sin(alpha)
    c = np.cos(theta)
    s = np.sin(theta)
    row_x = [c, -s, 0.0, a]
    row_y = [s * ca, c * ca, -sa, -d * sa]
    row_z = [s * sa, c * sa, ca, d * ca]
    return np.array([row_x, row_y, row_z, [0.0, 0.0, 0.0, 1.0]])
    # endregion 2.9


def dh_fk(table: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Return T_world_flange, (4, 4), from rows (alpha, a, d), (8, 3), and q, (7,).

    The eighth row is the flange, which does not turn: its theta is 0.
    """
    # region 2.9
    T = np.eye(4)
    for (alpha, a, d), theta in zip(table, [*q, 0.0], strict=True):
        T = T @ dh_link(alpha, a, d, theta)
    return T
    # endregion 2.9


class Seen(NamedTuple):
    """What MuJoCo says of the arm at n configurations."""

    T_ee: np.ndarray  # T_world_ee, (n, 4, 4)
    T_links: np.ndarray  # of link1 to link7: each turns about its own z, (n, 7, 4, 4)
    axes: np.ndarray  # the joints' axes in the world, as screws, (n, 7, 6)


def mujoco_sees(model: mujoco.MjModel, q: np.ndarray) -> Seen:
    """Return what MuJoCo says of configurations q, (n, 7)."""
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
    """Return MuJoCo's rotation by theta about an axis of length 1, (3, 3)."""
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
    """Return [S], (4, 4): a screw as the rate of a pose. NumPy's cross, not yours."""
    bracketed = np.zeros((4, 4))
    bracketed[:3, :3] = np.cross(np.eye(3), S[:3])
    bracketed[:3, 3] = S[3:]
    return bracketed


def on_purpose(screws: np.ndarray, M_home: np.ndarray) -> dict:
    """Return {what is wrong: q -> your own fk_space, given something wrong}."""
    omega, v = screws[:, :3], screws[:, 3:]
    M_ready = fk_space(screws, M_home, READY_Q)
    return {
        "nothing": lambda q: fk_space(screws, M_home, q),
        "v = +omega x point": lambda q: fk_space(np.hstack([omega, -v]), M_home, q),
        "v forgotten": lambda q: fk_space(np.hstack([omega, 0 * v]), M_home, q),
        "(v; omega)": lambda q: fk_space(np.hstack([v, omega]), M_home, q),
        "joint7 on the left": lambda q: fk_space(screws[::-1], M_home, q[::-1]),
        "M on the left": lambda q: M_home @ fk_space(screws, np.eye(4), q),
        "q in degrees": lambda q: fk_space(screws, M_home, np.rad2deg(q)),
        "M of the ready pose": lambda q: fk_space(screws, M_ready, q),
    }


def how_far_off(lab: Lab, ways: dict, q: np.ndarray, T_ee: np.ndarray) -> None:
    """Print how far off the hand is: at the first q, 0; at ready; at the others."""
    print(f"  {'millimetres':24}{'q = 0':>8}{'ready':>8}{'random':>8}")
    for what, fk in ways.items():
        off = [fk(x)[:3, 3] for x in q] - T_ee[:, :3, 3]
        zero, ready, *others = 1000 * np.linalg.norm(off, axis=1)
        print(f"  {what:24}{zero:8.1f}{ready:8.1f}{np.median(others):8.1f}")
        lab.measured(f"position error at q = 0 with {what}, mm", zero)


def lost_motion(lab: Lab, screws: np.ndarray) -> None:
    """Print how many independent motions the screws of q = 0 span."""
    rank = np.linalg.matrix_rank(screws)
    print(f"  The seven screws have rank {rank}; a hand that can move freely needs 6.")
    lab.measured("independent motions that the seven screws of q = 0 span", rank)
    print("  Which motion has it lost there? (Day 3 answers.)")


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

    lab.step("2. Seven joints, seven lines in the world, with the arm at q = 0")
    screws = joint_screws(mujocos.T_links[0])  # the first q is 0
    M_home = mujocos.T_ee[0]
    lab.show("(omega; v) of joint1 to joint7", screws, 4)
    lab.measured("third number of v of joint4's screw, m", screws[3, 5])
    # The function knows nothing of q = 0: elsewhere it has to find the lines too.
    off = verify.each(joint_screws, mujocos.T_links) - mujocos.axes
    lab.check(f"largest |by hand - MuJoCo's axes| at {len(q)} q", off)

    lab.step("3. The motion along one screw: hinges, slides, and both in one")
    # MuJoCo has no call for the motion along a screw: the library's stands in for it.
    S, theta = random_screws(TRIALS)
    off = verify.each(exp_screw, S, theta) - library.exp_screw(S, theta)
    lab.check("largest |exp_screw - library|", off)

    lab.step("4. Seven motions, then M: what is wrong, and how far off is the hand?")
    how_far_off(lab, on_purpose(screws, M_home), q[:22], mujocos.T_ee[:22])
    # The lesson of the day: at q = 0 nearly all of them are right. Never judge there.
    off = [fk_space(screws, M_home, x) for x in q] - mujocos.T_ee
    lab.check("fk_space at q = 0, which says little", off[0])
    lab.record("poe_by_hand", np.abs(off[2:]).max(axis=(1, 2)),
               label=f"fk_space at {TRIALS} random q, which says all",
               config="random", seed=SEED)  # fmt: skip

    lab.step("5. The same arm as the end effector sees it")
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
    lab.check(f"the library robo47.screws at {LIBRARY_TRIALS:,}", off)

    lab.step("6. Denavit and Hartenberg: four numbers per link instead of six")
    T_flange = mujocos.T_ee.copy()  # the site sits on the flange, turned by 135 degrees
    T_flange[:, :3, :3] = mujocos.T_links[:, 6, :3, :3]
    off = [dh_fk(FRANKA_DH, x) for x in q] - T_flange
    lab.show("row 4 of Franka's table, at theta = 0", dh_link(*FRANKA_DH[3], 0.0), 4)
    link4 = model.body("link4")
    in_the_file = se3.make_T(se3.quat_to_R(link4.quat), link4.pos)
    lab.show("link4's pos and quat in the file, as a pose", in_the_file, 4)
    lab.record("dh_by_hand", np.abs(off[2:]).max(axis=(1, 2)),
               label=f"dh_fk at {TRIALS} random q",
               config="random", seed=SEED)  # fmt: skip

    lab.step("7. Side quest: joint1, joint3 and joint5 are one line at q = 0")
    lost_motion(lab, screws)
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
