"""Day 3: Jacobians, singularities, inverse kinematics. MuJoCo checks the Jacobian.

    make day3                         in the clone: sets everything up, then runs this
    python src/day3_jacobian_ik.py    in w1-foundations/, once that is done

A column of the Jacobian is a joint's present screw. Twists are (omega; v).
J_space, J_site and J_body are three different matrices. Metres, radians, seconds.
"""

from itertools import pairwise

import kit  # noqa: F401 (goes on in the kit's own Python)
import mujoco
import numpy as np

from robo47 import cli, jacobian, panda, se3
from robo47.lesson.lab import Lab
from robo47.screws import adjoint, exp_screw, fk_space, skew
from robo47.verify import each, random_q

import day3_mujoco

READY_Q = panda.READY_Q  # the handout's home_q: seven joint angles, radians
TRIALS = 500  # random configurations at which your own code is tested
LIBRARY_TRIALS = 2_000  # for the library; a hundred thousand take seconds
SEED = 47  # the same random configurations at every run
NEAR, FAR = 50, 20  # targets of your solve_ik: within 0.3 rad of its start, anywhere
TRIES = 20  # starts for one far target; with 1, 6 of the 20 are missed
SPEED = np.array([2.175] * 4 + [2.61] * 3)  # Franka's joint speed limits, rad/s
DOWN = np.array([0.0, 0.0, 0.0, 0.0, 0.0, -10.0])  # a wrench: no moment, 10 N down
# The first circle is in reach; the top of the second one is not.
EASY, RADIUS = 0.36, 0.38
DT = 0.02  # seconds of a step; the errors out of reach depend on it
DAMPING = 0.05  # 0.1 is slower and less accurate, 0 is the plain pseudo-inverse
GAIN = 10.0  # 1/s: how fast an error on the circle is corrected; over 2 / DT it grows


def space_jacobian(screws: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Return the space Jacobian J_space, (6, n), of the joints' present screws.

    screws (n, 6) are the screw axes (omega; v) at q = 0, from the base outwards, in the
    world frame and in metres; q (n,) are the joint angles in radians. Column i is screw
    i, transformed by the motion of the joints before it; v is the velocity of the
    hand's point at the world's origin (Modern Robotics, section 5.1.1). At q = 0 the
    columns are the screws.
    space_jacobian([[0, 0, 1, 0, 0, 0], [0, 0, 1, 0, -1, 0]], [pi / 2, 0]) ->
    [[0, 0], [0, 0], [1, 1], [0, 1], [0, 0], [0, 0]]
    """
    # region 3.1
    before = [np.eye(4)]  # the motion before the first joint
    for motion in exp_screw(screws, q)[:-1]:
        before.append(before[-1] @ motion)  # the motion before the next joint
    return (adjoint(np.array(before)) @ screws[:, :, None])[:, :, 0].T  # moved screws
    # endregion 3.1


def site_jacobian(J_space: np.ndarray, p: np.ndarray) -> np.ndarray:
    """Return the site Jacobian J_site, (6, n), of one point of the hand.

    J_space (6, n) is the space Jacobian, rows (omega; v), and p (3,) a point that moves
    with the hand, in metres, in the world frame. In J_site, v is the velocity of p;
    omega does not change (Modern Robotics, section 3.3.2). Both are expressed in the
    world frame.
    site_jacobian([[0], [0], [1], [0], [0], [0]], [1, 0, 0]) ->
    [[0], [0], [1], [0], [1], [0]]
    """
    # region 3.2
    omega, v = J_space[:3], J_space[3:]  # the rows of omega and the rows of v
    return np.vstack([omega, v - skew(p) @ omega])  # v of p: omega x p = -[p] omega
    # endregion 3.2


def log_rotation(R: np.ndarray) -> np.ndarray:
    """Return the rotation vector of a rotation, its axis times its angle, (3,).

    R (3, 3) is a rotation matrix. The angle is between 0 and pi radians, and the result
    is accurate to 1e-8 in this whole range, also near 0 and near pi. The identity gives
    (0, 0, 0). At exactly pi both signs represent the same rotation: return the vector
    whose entry of largest absolute value is positive (Modern Robotics, section
    3.2.3.3).
    log_rotation([[0, -1, 0], [1, 0, 0], [0, 0, 1]]) -> [0, 0, pi / 2]
    """
    # region 3.3
    # The axis times the sine of the angle:
    a = (  # the axis, times the sine of the angle
        np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2
    )
    sine = np.linalg.norm(a)  # the sine of the angle
    cosine = (np.trace(R) - 1) / 2  # the cosine of the angle
    angle = np.arctan2(sine, cosine)  # the angle, from 0 to pi
    if cosine > -0.9:  # angles up to 154 degrees
        return a * (angle / sine if sine > 0 else 1.0)  # the axis times the angle
    B = (R + R.T) / 2 - cosine * np.eye(3)  # (1 - cosine) axis axis^T
    column = B[:, np.argmax(np.diag(B))]  # the longest multiple of the axis
    axis = column / np.linalg.norm(column)  # the axis up to its sign
    return angle * axis * (-1.0 if a @ axis < 0 else 1.0)  # the rotation vector near pi
    # endregion 3.3


def pose_error(T: np.ndarray, T_goal: np.ndarray) -> np.ndarray:
    """Return the pose error from T to T_goal, rotation vector over translation, (6,).

    T (4, 4) and T_goal (4, 4) are poses of the hand in the world, in metres. The
    rotation vector, in radians, belongs to the rotation that, applied after the present
    one, gives the goal's; both halves are expressed in the world frame, so the error
    belongs to J_site (Modern Robotics, section 6.2.2, uses the hand frame).
    pose_error([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]], [[0, -1, 0,
    0.2], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) -> [0, 0, pi / 2, 0.2, 0, 0]
    """
    # region 3.4
    R_error = T_goal[:3, :3] @ T[:3, :3].T  # the rotation error in the world frame
    turn = log_rotation(R_error)  # the rotation vector of the error
    return np.append(turn, T_goal[:3, 3] - T[:3, 3])  # rotation vector, translation
    # endregion 3.4


def dls_step(J_site: np.ndarray, e: np.ndarray, damping: float) -> np.ndarray:
    """Return the damped least-squares step dq of the joints, (7,), in radians.

    It minimises |J dq - e|^2 + damping^2 |dq|^2. J_site (6, 7) is the site Jacobian, e
    (6,) the wanted motion of the hand, such as a pose error, and damping is 0 or more
    (Siciliano and others, section 3.5). With damping 0 it is the step of minimum norm.
    With J_site = [I 0] and damping 1 it is half of e, and 0 for the seventh joint.
    """
    # region 3.5
    J = J_site  # the Jacobian
    A = J @ J.T + damping**2 * np.eye(6)  # the matrix of the linear system
    return J.T @ np.linalg.solve(A, e)  # the step, from the solution for six unknowns
    # endregion 3.5


def solve_ik(
    screws: np.ndarray,
    M_home: np.ndarray,
    T_goal: np.ndarray,
    q_start: np.ndarray,
    limits: np.ndarray,
) -> np.ndarray:
    """Return joint angles that bring the hand to T_goal (inverse kinematics), (7,).

    screws (7, 6), M_home (4, 4): as in fk_space; T_goal (4, 4): the wanted pose;
    q_start (7,): the first joint angles in radians, which are not changed; limits
    (7, 2): the lower and the upper limit of each joint. Each of at most 60 iterations
    takes the damped least-squares step of the pose error e with damping^2 = e.e / 2 +
    1e-6 and clamps q to the limits (Sugihara, IEEE Trans. Robotics 27(5), 2011). Stop
    as soon as |e| is below 1e-8: a start at its goal is returned as a copy. Otherwise,
    for example for a target out of reach, return the configuration with the smallest
    |e| among q_start and the results of all 60 iterations, the last one included.
    """
    # region 3.6
    q = q_start.copy()  # the present joint angles
    best = q_start  # the joint angles with the smallest error
    least = np.inf  # the smallest squared error
    for _ in range(61):
        T = fk_space(screws, M_home, q)  # the present pose of the hand
        e = pose_error(T, T_goal)  # the pose error
        if e @ e < least:  # the comparison with the smallest squared error
            best = q  # the best known configuration
            least = e @ e  # the smallest squared error
        if least < 1e-8**2:  # the test of convergence
            break
        J = site_jacobian(space_jacobian(screws, q), T[:3, 3])  # J_site of the hand
        step = dls_step(J, e, np.sqrt(e @ e / 2 + 1e-6))  # a damped least-squares step
        q = np.clip(q + step, *limits.T)  # the next configuration, within the limits
    return best
    # endregion 3.6


def joint_torques(J_space: np.ndarray, p: np.ndarray, F: np.ndarray) -> np.ndarray:
    """Return the joint torques with which the hand exerts a wrench, (n,), in N m.

    J_space (6, n) is the space Jacobian; p (3,) the point at which the hand pushes, in
    metres; F (6,) the wrench that the hand exerts on the world, the moment about p in
    N m over the force in N. All are expressed in the world frame (Modern Robotics,
    section 5.2).
    joint_torques([[0], [0], [1], [0], [0], [0]], [0, 1, 0], [0, 0, 0, -10, 0, 0]) ->
    [10]
    """
    # region 3.7
    return site_jacobian(J_space, p).T @ F  # the wrench, mapped to the joints
    # endregion 3.7


def manipulability(J: np.ndarray) -> float:
    """Return the manipulability: the product of the singular values of J, a number.

    J (m, n) is a Jacobian with m <= n. The result is 0 where J is singular, and never
    NaN (Yoshikawa, Int. J. Robotics Research 4(2), 1985).
    manipulability([[2, 0, 0], [0, 3, 0]]) -> 6
    """
    # region 3.8
    return np.linalg.svd(J, compute_uv=False).prod()  # the product of singular values
    # endregion 3.8


def nullspace_projection(J: np.ndarray, dq: np.ndarray) -> np.ndarray:
    """Return the null-space projection of dq: its part that does not move the hand.

    J (m, n) is a Jacobian, which may be singular, and dq (n,) a motion of the joints.
    The result (n,) is the nearest motion to dq with J times it equal to 0: dq minus the
    motion of minimum norm with the same J dq (Modern Robotics, section 6.3).
    nullspace_projection([[1, 0, 0], [0, 1, 0]], [1, 2, 3]) -> [0, 0, 3]
    """
    # region 3.8
    return dq - np.linalg.pinv(J) @ (J @ dq)  # dq without the part that moves the hand
    # endregion 3.8


def body_jacobian(J_space: np.ndarray, T: np.ndarray) -> np.ndarray:
    """Return the body Jacobian J_body, (6, n), expressed in the hand frame.

    J_space (6, n) is the space Jacobian, and T (4, 4) is T_world_ee at the same joint
    angles, in metres. In J_body, v is the velocity of the hand's origin (Modern
    Robotics, section 5.1.4).
    body_jacobian([[0], [0], [1], [0], [-1], [0]], [[1, 0, 0, 1], [0, 1, 0, 0],
    [0, 0, 1, 0], [0, 0, 0, 1]]) -> [[0], [0], [1], [0], [0], [0]]
    """
    # region 3.9
    return adjoint(se3.inverse(T)) @ J_space  # the columns, in the hand frame
    # endregion 3.9


def mujoco_J_site(model: mujoco.MjModel, q: np.ndarray) -> np.ndarray:
    """Return MuJoCo's Jacobian of the hand's site at configurations q, (n, 6, 7)."""
    data = mujoco.MjData(model)
    site = data.site("attachment_site")
    J = np.zeros((len(q), 2, 3, 7))
    for one, (J_omega, J_v) in zip(q, J, strict=True):
        data.qpos[:] = one
        mujoco.mj_kinematics(model, data)  # fills where everything is
        mujoco.mj_comPos(model, data)  # fills cdof, which mj_jacSite reads: else zeros
        mujoco.mj_jacSite(model, data, J_v, J_omega, site.id)  # fills both; v is first
    return J.reshape(-1, 6, 7)


def mujoco_torques(model: mujoco.MjModel, q: np.ndarray, F: np.ndarray) -> np.ndarray:
    """Return MuJoCo's joint torques, (n, 7), of wrenches F, (n, 6), on the hand."""
    data = mujoco.MjData(model)
    site = data.site("attachment_site")
    link = model.site_bodyid[site.id]  # a wrench acts on a body, at a point
    torques = np.zeros((len(q), 7))
    for one, push, tau in zip(q, F, torques, strict=True):
        data.qpos[:] = one
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        moment = push[:3]
        force = push[3:]
        mujoco.mj_applyFT(model, data, force, moment, site.xpos, link, tau)  # adds
    return torques


def draw_circle(arm: tuple, path: np.ndarray, q: np.ndarray, damping: float) -> tuple:
    """Return position errors in mm, (n,), joint speeds and angles, (n, 7) each."""
    off, speeds, angles = [], [], []
    for T_now, T_next in pairwise(path):  # poses, DT apart
        T = fk_space(*arm, q)
        # The circle's own velocity, and a correction of the present error.
        twist = pose_error(T_now, T_next) / DT + GAIN * pose_error(T, T_now)
        J = site_jacobian(space_jacobian(arm[0], q), T[:3, 3])
        q_dot = dls_step(J, twist, damping)
        off.append(1000 * np.linalg.norm(T_now[:3, 3] - T[:3, 3]))
        speeds.append(np.abs(q_dot))
        angles.append(q)
        q = q + DT * q_dot
    return np.array(off), np.array(speeds), np.array(angles)


def circles(lab: Lab, arm: tuple, limits: np.ndarray) -> None:
    """Draw the larger circle with damping, then both without."""
    times = np.arange(0.0, day3_mujoco.LAP, DT)
    path, q = day3_mujoco.circle(arm, limits, RADIUS, times)
    off, speeds, _ = draw_circle(arm, path, q, DAMPING)
    lab.record(
        "circle_dls",
        off,
        metric="max_err_mm",
        label="largest distance from the circle, mm",
    )
    lab.record("circle_dls", (speeds / SPEED).max(axis=1), metric="rate_over_limit",
               label="fastest joint, as a fraction of its limit")  # fmt: skip
    least = day3_mujoco.least_miss(arm, limits, path[:-1], q)
    print(f"  {np.sum(least > 1e-3)} of {len(least)} poses are out of reach,", end=" ")
    print(f"by up to {least.max():.2f} mm.")
    if RADIUS == 0.38:
        lab.measured("circle of 0.38 m, top: too far for the wrist by, mm", least.max())
    lab.check("largest distance beyond the smallest possible one, mm", off - least, 15)

    lab.step("6. Without damping, where the errors out of reach depend on DT")
    for radius in (EASY, RADIUS):
        path, q = day3_mujoco.circle(arm, limits, radius, times)
        off, speeds, _ = draw_circle(arm, path, q, 0.0)
        print(f"  {radius:.3f} m: {off.max():8.2f} mm off, {speeds.max():8.2f} rad/s, "
              f"{(speeds / SPEED).max():.2f} of the limit")  # fmt: skip


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    model = panda.load("panda_nohand")
    print(panda.describe("panda_nohand"))
    arm = panda.screws(model), panda.home_pose(model)
    limits = model.jnt_range
    q = np.vstack([np.zeros(7), READY_Q, random_q(model, TRIALS, SEED)])
    T = fk_space(*arm, q)  # Day 2's
    p = T[:, :3, 3]
    J_mujoco = mujoco_J_site(model, q)

    lab.step("1. The Jacobian: each column is the present screw of a joint")
    J_space = each(lambda x: space_jacobian(arm[0], x), q)
    J_site = each(site_jacobian, J_space, p)
    lab.show("J_site in the ready configuration: rows (omega; v)", J_site[1], 3)
    lab.check("J_space at q = 0 - the screws", J_space[0] - arm[0].T)
    lab.record("jacobian_by_hand", np.abs(J_site[2:] - J_mujoco[2:]).max(axis=(1, 2)),
               label=f"J_site - MuJoCo's at {TRIALS} random q",
               config="random", seed=SEED)  # fmt: skip
    with lab.side_quest():
        J_body = each(body_jacobian, J_space, T)
        # Both halves of MuJoCo's, expressed in the hand frame, whose axes are R's.
        back = np.swapaxes(T[:, None, :3, :3], 2, 3)
        turned = back @ J_mujoco.reshape(-1, 2, 3, 7)
        lab.check(
            "J_body - MuJoCo's, expressed in the hand frame",
            J_body - turned.reshape(-1, 6, 7),
        )
    many = random_q(model, LIBRARY_TRIALS, SEED)
    J_many = jacobian.space_jacobian(arm[0], many)
    ends = fk_space(*arm, many)[:, :3, 3]
    off = jacobian.site_jacobian(J_many, ends) - mujoco_J_site(model, many)
    lab.check(f"the library's J_site at {LIBRARY_TRIALS:,} configurations", off)

    lab.step("2. The pose error: a rotation vector and a translation")
    known = day3_mujoco.turns(TRIALS, SEED)
    off = each(log_rotation, known.R) - known.logs
    lab.check(f"log_rotation of {TRIALS} rotations, also near 0 and at pi", off)
    start = T[:-1]
    goal = T[1:]
    e = each(pose_error, start, goal)
    off = (day3_mujoco.moved(start, e) - goal)[:, :3]
    lab.check("the pose, moved by the error - the goal", off)

    lab.step("3. Damped steps, null-space motions, and the torques of a push")
    # |J dq - e|^2 + damping^2 |dq|^2 is one plain sum of squares, with 7 more rows.
    J = J_mujoco[:12]  # singular at q = 0, the first
    e = np.random.default_rng(SEED).normal(size=(len(J), 6))
    damping = np.resize([0.05, 1.0], len(J))
    rows = np.concatenate([J, damping[:, None, None] * np.eye(7)], axis=1)
    right = np.hstack([e, np.zeros((len(J), 7))])
    truth = each(lambda A, b: np.linalg.lstsq(A, b)[0], rows, right)
    off = each(dls_step, J, e, damping) - truth
    lab.check("dls_step - least squares with 7 more rows", off)
    F = np.random.default_rng(SEED).normal(size=(len(q), 6))  # N m and N
    off = each(joint_torques, J_space, p, F) - mujoco_torques(model, q, F)
    lab.check("joint_torques - MuJoCo's", off)
    tau = joint_torques(J_space[1], p[1], DOWN)
    lab.measured("joint 2's torque at ready, pushing down with 10 N, N m", tau[1])
    J = J_mujoco[1:]  # of rank 6: one motion of the joints does not move the hand
    dq = np.random.default_rng(SEED).normal(size=(len(J), 7))
    null = np.linalg.svd(J)[2][:, 6]
    along = np.sum(dq * null, axis=1, keepdims=True) * null
    off = each(nullspace_projection, J, dq) - along
    lab.check("nullspace_projection - the part along the null vector", off)
    squared = np.linalg.det(J_mujoco @ np.swapaxes(J_mujoco, 1, 2))
    off = each(manipulability, J_mujoco) ** 2 - squared
    lab.check("manipulability squared - det(J J^T)", off)
    flat = manipulability(J_mujoco[0])
    u = np.linalg.svd(J_mujoco[0])[0][:, -1]
    lab.show(
        f"Manipulability {abs(flat):.4f} at q = 0: a wrench without motor torques",
        np.abs(u),
        3,
    )

    lab.step("4. Inverse kinematics")
    off = solve_ik(*arm, T[1], READY_Q, limits) - READY_Q
    lab.check("a start at its goal comes back unchanged", off)
    ends = day3_mujoco.ends_of(solve_ik, arm, limits, q[2 : NEAR + 2], SEED)
    lab.check(f"fraction of {NEAR} near targets not reached", ends.missed, 0.03)
    lab.check("2 m away, out of reach: error / smallest error", ends.out_of_reach, 1.01)
    lab.check("largest angle beyond a joint limit, rad", ends.beyond)
    goals = T[2 : FAR + 2]
    at = day3_mujoco.tries(solve_ik, arm, limits, goals, READY_Q, TRIES, SEED)
    print(f"  Targets reached of {len(at)}: {sum(at == 1)} from ready,", end=" ")
    print(f"{sum(at > 0)} with more starts.")
    lab.record("ik_by_hand", np.mean(at == 0), label="fraction of targets missed",
               seed=SEED, n_trials=len(at),
               n_failures=int(np.sum(at == 0)))  # fmt: skip
    lab.step(f"5. A circle of {RADIUS} m, with damping: is the whole circle in reach?")
    circles(lab, arm, limits)
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
