"""Day 3: Jacobians, singularities, inverse kinematics. MuJoCo checks the Jacobian.

    make day3                         in the clone: sets everything up, then runs this
    python src/day3_jacobian_ik.py    in w1-foundations/, once that is done

A column of the Jacobian is a joint's screw, where it is now. Twists are (omega; v).
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
TRIALS = 500  # random configurations that your own code is judged on
LIBRARY_TRIALS = 2_000  # and the library; a hundred thousand take seconds
SEED = 47  # the same random configurations at every run
NEAR, FAR = 50, 20  # targets of your solve_ik: within 0.3 rad of its start, anywhere
TRIES = 20  # starts for one far target; with 1, 6 of the 20 are missed
SPEED = np.array([2.175] * 4 + [2.61] * 3)  # Franka's joint speed limits, rad/s
DOWN = np.array([0.0, 0.0, 0.0, 0.0, 0.0, -10.0])  # a wrench: no moment, 10 N down
# All of the first circle is in reach; the top of the second is not.
EASY, RADIUS = 0.36, 0.38
DT = 0.02  # seconds a step takes; what goes wrong changes with it
DAMPING = 0.05  # 0.1 is slower and less exact, 0 is the plain pseudo-inverse
GAIN = 10.0  # 1/s: how fast an error on the circle is corrected; over 2 / DT it grows


def space_jacobian(screws: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Return J_space, (6, 7): where each screw, (7, 6), is after those before it moved.

    At q = 0 nothing has moved: its columns are the screws themselves.
    """
    # region 3.1
    before = [np.eye(4)]
    for motion in exp_screw(screws, q)[:-1]:
        before.append(before[-1] @ motion)
    return (adjoint(np.array(before)) @ screws[:, :, None])[:, :, 0].T
    # endregion 3.1


def site_jacobian(J_space: np.ndarray, p: np.ndarray) -> np.ndarray:
    """Return J_site, (6, 7): v is the velocity of the hand's point p, (3,), world axes.

    Of a spin about z, (0, 0, 1, 0, 0, 0), the point (1, 0, 0) has v = (0, 1, 0).
    """
    # region 3.2
    omega, v = J_space[:3], J_space[3:]
    return np.vstack([omega, v - skew(p) @ omega])  # omega x p = -[p] omega
    # endregion 3.2


def log_rotation(R: np.ndarray) -> np.ndarray:
    """Return a rotation's axis times its angle, (3,), exact from 0 to pi.

    90 degrees about z is (0, 0, pi / 2). At exactly pi both signs mean the same: return
    the one whose largest entry is positive.
    """
    # region 3.3
    a = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2
    sine = np.linalg.norm(a)
    cosine = (np.trace(R) - 1) / 2
    angle = np.arctan2(sine, cosine)
    if cosine > -0.9:
        return a * (angle / sine if sine > 0 else 1.0)
    B = (R + R.T) / 2 - cosine * np.eye(3)  # (1 - cosine) axis axis^T
    column = B[:, np.argmax(np.diag(B))]
    axis = column / np.linalg.norm(column)
    return angle * axis * (-1.0 if a @ axis < 0 else 1.0)
    # endregion 3.3


def pose_error(T: np.ndarray, T_goal: np.ndarray) -> np.ndarray:
    """Return how far the goal is, (6,): a rotation above a translation, world axes.

    A goal 0.1 m higher is (0, 0, 0, 0, 0, 0.1).
    """
    # region 3.4
    R_error = T_goal[:3, :3] @ T[:3, :3].T
    return np.concatenate([log_rotation(R_error), T_goal[:3, 3] - T[:3, 3]])
    # endregion 3.4


def dls_step(J_site: np.ndarray, e: np.ndarray, damping: float) -> np.ndarray:
    """Return the dq, (7,), that makes |J dq - e|^2 + damping^2 |dq|^2 the smallest.

    With J_site = [I 0] and damping 1 it is half of e, and 0 for the seventh joint.
    """
    # region 3.5
    J = J_site
    return J.T @ np.linalg.solve(J @ J.T + damping**2 * np.eye(6), e)
    # endregion 3.5


def solve_ik(
    screws: np.ndarray,
    M_home: np.ndarray,
    T_goal: np.ndarray,
    q_start: np.ndarray,
    limits: np.ndarray,
) -> np.ndarray:
    """Return joint angles, (7,), within limits, (7, 2), that bring the hand to T_goal.

    From q_start on, with damping^2 = e.e / 2 + 1e-6; 60 steps (updates of q) will do.
    A start whose error is under 1e-8 comes back, as a copy; out of reach, return the q
    whose error was the shortest.
    """
    # region 3.6
    q = q_start.copy()
    best = q_start
    least = np.inf
    for _ in range(61):
        T = fk_space(screws, M_home, q)
        e = pose_error(T, T_goal)
        if e @ e < least:
            best = q
            least = e @ e
        if least < 1e-8**2:
            break
        J = site_jacobian(space_jacobian(screws, q), T[:3, 3])
        q = np.clip(q + dls_step(J, e, np.sqrt(e @ e / 2 + 1e-6)), *limits.T)
    return best
    # endregion 3.6


def joint_torques(J_space: np.ndarray, p: np.ndarray, F: np.ndarray) -> np.ndarray:
    """Return the torques, (7,), with which the hand pushes with F at its point p, (3,).

    F, (6,), is the moment about p and the force, world axes. A joint that turns about z
    pays 10 N m for -10 N along x at (0, 1, 0).
    """
    # region 3.7
    return site_jacobian(J_space, p).T @ F
    # endregion 3.7


def manipulability(J: np.ndarray) -> float:
    """Return the product of J's singular values, which is 0 where J is singular.

    With 1, 2, 3, 1, 1, 1 on the diagonal of J it is 6. Never NaN.
    """
    # region 3.8
    return np.linalg.svd(J, compute_uv=False).prod()
    # endregion 3.8


def nullspace_projection(J: np.ndarray, dq: np.ndarray) -> np.ndarray:
    """Return what is left of dq, (7,), without the smallest motion that the hand feels.

    With J = [I 0] and dq all 1 only the seventh joint moves. J may be singular.
    """
    # region 3.8
    return dq - np.linalg.pinv(J) @ (J @ dq)
    # endregion 3.8


def body_jacobian(J_space: np.ndarray, T: np.ndarray) -> np.ndarray:
    """Return J_body, (6, 7): the same motion as the hand itself, at pose T, sees it.

    A hand that has not turned, at the origin, sees J_space.
    """
    # region 3.9
    return adjoint(se3.inverse(T)) @ J_space
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
    """Return the torques, (n, 7), that stand for wrenches F, (n, 6), at the hand."""
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
    """Return how far off the hand is, mm, (n,), and joint speeds and angles, (n, 7)."""
    off, speeds, angles = [], [], []
    for T_now, T_next in pairwise(path):  # poses, DT apart
        T = fk_space(*arm, q)
        # The circle's own velocity, and a correction of what is off by now.
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
    lab.record("circle_dls", off, metric="max_err_mm", label="mm off the circle")
    lab.record("circle_dls", (speeds / SPEED).max(axis=1), metric="rate_over_limit",
               label="fastest joint, in parts of its limit")  # fmt: skip
    least = day3_mujoco.least_miss(arm, limits, path[:-1], q)
    print(f"  {np.sum(least > 1e-3)} of {len(least)} poses are out of reach,", end=" ")
    print(f"by up to {least.max():.2f} mm.")
    if RADIUS == 0.38:
        lab.measured("circle of 0.38 m, top: too far for the wrist by, mm", least.max())
    lab.check("mm farther off than the best joint angles", off - least, 15)

    lab.step("6. Without damping: another DT, other numbers")
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

    lab.step("1. The Jacobian: every column is a joint's screw, where it is now")
    J_space = each(lambda x: space_jacobian(arm[0], x), q)
    J_site = each(site_jacobian, J_space, p)
    lab.show("J_site when the arm is ready: rows (omega; v)", J_site[1], 3)
    lab.check("J_space at q = 0: the screws", J_space[0] - arm[0].T)
    lab.record("jacobian_by_hand", np.abs(J_site[2:] - J_mujoco[2:]).max(axis=(1, 2)),
               label=f"J_site - MuJoCo's at {TRIALS} random q",
               config="random", seed=SEED)  # fmt: skip
    with lab.side_quest():
        J_body = each(body_jacobian, J_space, T)
        # Both halves of MuJoCo's, seen from the hand: its axes are the columns of R.
        back = np.swapaxes(T[:, None, :3, :3], 2, 3)
        turned = back @ J_mujoco.reshape(-1, 2, 3, 7)
        lab.check("J_body - MuJoCo's, turned", J_body - turned.reshape(-1, 6, 7))
    many = random_q(model, LIBRARY_TRIALS, SEED)
    J_many = jacobian.space_jacobian(arm[0], many)
    ends = fk_space(*arm, many)[:, :3, 3]
    off = jacobian.site_jacobian(J_many, ends) - mujoco_J_site(model, many)
    lab.check(f"the library robo47.jacobian at {LIBRARY_TRIALS:,}", off)

    lab.step("2. How far is it to the goal? A rotation vector and a translation")
    known = day3_mujoco.turns(TRIALS, SEED)
    off = each(log_rotation, known.R) - known.logs
    lab.check(f"log_rotation of {TRIALS} turns, also near 0 and at pi", off)
    start = T[:-1]
    goal = T[1:]
    e = each(pose_error, start, goal)
    off = (day3_mujoco.moved(start, e) - goal)[:, :3]
    lab.check("moved by the error, the hand is at the goal", off)

    lab.step("3. Steps, damped and unfelt, and the torques that a push costs")
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
    J = J_mujoco[1:]  # of rank 6: one motion of the joints leaves the hand where it is
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
    lab.show(f"At q = 0 it is {abs(flat):.4f}; no motor feels the wrench", np.abs(u), 3)

    lab.step("4. Inverse kinematics")
    off = solve_ik(*arm, T[1], READY_Q, limits) - READY_Q
    lab.check("a start that is there already comes back", off)
    ends = day3_mujoco.ends_of(solve_ik, arm, limits, q[2 : NEAR + 2], SEED)
    lab.check(f"share of {NEAR} near targets not reached", ends.missed, 0.03)
    lab.check("2 m away, out of reach: error / the best", ends.out_of_reach, 1.01)
    lab.check("rad beyond the joint limits", ends.beyond)
    goals = T[2 : FAR + 2]
    at = day3_mujoco.tries(solve_ik, arm, limits, goals, READY_Q, TRIES, SEED)
    print(f"  Reached of {len(at)}: {sum(at == 1)} from ready, {sum(at > 0)} in all.")
    lab.record("ik_by_hand", np.mean(at == 0), label="share not reached", seed=SEED,
               n_trials=len(at), n_failures=int(np.sum(at == 0)))  # fmt: skip
    lab.step(f"5. A circle of {RADIUS} m, with damping: is all of it in reach?")
    circles(lab, arm, limits)
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
