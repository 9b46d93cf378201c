"""Day 3: Jacobians, singularities, inverse kinematics. MuJoCo checks the Jacobian.

    make day3                         in the clone: sets everything up, then runs this
    python src/day3_jacobian_ik.py    in w1-foundations/, once that is done

A column of the Jacobian is a joint's screw, where it is now. Twists are (omega; v).
J_space, J_site and J_body are three different matrices. Metres, radians, seconds.
"""

import kit  # noqa: F401 (goes on in the kit's own Python)
import numpy as np

from robo47 import cli, jacobian, panda, se3, verify
from robo47.lesson.lab import Lab
from robo47.screws import adjoint, exp_rotation, exp_screw, fk_space, skew

READY_Q = panda.READY_Q  # the handout's home_q: seven joint angles, radians
TRIALS = 500  # random configurations that your own code is judged on
LIBRARY_TRIALS = 2_000  # and the library; a hundred thousand take seconds
SEED = 47  # the same random configurations at every run
NEAR, FAR = 50, 20  # targets of your solve_ik: within 0.3 rad of its start, anywhere
TRIES = 10  # starts for one far target; with 1, a third of them is not reached
SPEED = np.array([2.175] * 4 + [2.61] * 3)  # Franka's joint speed limits, rad/s
# The hand draws a circle in the y-z plane, from START_Q on. With radius 0.36 all of it
# is in reach; the top of one of 0.38 is not, and its bottom is nearly singular.
CENTRE = np.array([0.28, -0.06, 0.55])
EASY, RADIUS = 0.36, 0.38
START_Q = np.array([0.5, -1.3, 0.0, -2.4, -0.5, 1.7, 1.2])  # its elbow: no limit is met
LAP, DT = 6.0, 0.02  # seconds a lap takes, and a step; what goes wrong changes with DT
DAMPING = 0.05  # 0.1 is slower and less exact, 0 is the plain pseudo-inverse
GAIN = 10.0  # 1/s: how fast an error on the circle is corrected; over 1 / DT it shakes


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
    sine, cosine = np.linalg.norm(a), (np.trace(R) - 1) / 2
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


def dls_step(J: np.ndarray, e: np.ndarray, damping: float) -> np.ndarray:
    """Return J^T (J J^T + damping^2 I)^-1 e, (7,): the damped step.

    With J = [I 0] and damping 1 it is half of e, and 0 for the seventh joint.
    """
    # region 3.5
    return J.T @ np.linalg.solve(J @ J.T + damping**2 * np.eye(6), e)
    # endregion 3.5


def solve_ik(
    screws: np.ndarray,
    M: np.ndarray,
    T_goal: np.ndarray,
    q_start: np.ndarray,
    limits: np.ndarray,
) -> np.ndarray:
    """Return joint angles, (7,), within limits, (7, 2), that bring the hand to T_goal.

    At most 60 steps (60 updates of q) from q_start, with damping^2 = e.e / 2 + 1e-6. A
    start whose error is under 1e-8 comes back, as a copy; out of reach, return the q
    whose error was the shortest.
    """
    # region 3.6
    q, best, least = q_start.copy(), q_start, np.inf
    for _ in range(61):
        T = fk_space(screws, M, q)
        e = pose_error(T, T_goal)
        if e @ e < least:
            best, least = q, e @ e
        if least < 1e-8**2:
            break
        J = site_jacobian(space_jacobian(screws, q), T[:3, 3])
        q = np.clip(q + dls_step(J, e, np.sqrt(e @ e / 2 + 1e-6)), *limits.T)
    return best
    # endregion 3.6


def manipulability(J: np.ndarray) -> float:
    """Return sqrt(det(J J^T)), which is 0 where J is singular (never NaN).

    With 1, 2, 3, 1, 1, 1 on the diagonal of J it is 6.
    """
    # region 3.7
    return np.sqrt(max(np.linalg.det(J @ J.T), 0.0))
    # endregion 3.7


def null_step(J: np.ndarray, dq: np.ndarray) -> np.ndarray:
    """Return the part of dq, (7,), that the hand does not feel: dq - J^+ J dq.

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


def each(function, *columns: np.ndarray) -> np.ndarray:
    """Return a function's answers to each row of its arguments, (n, ...)."""
    return np.array([function(*row) for row in zip(*columns, strict=True)])


def miss(arm: tuple, q: np.ndarray, T_goal: np.ndarray) -> float:
    """Return the length of the pose error at q, radians and metres together."""
    return float(np.linalg.norm(pose_error(fk_space(*arm, q), T_goal)))


def beyond(limits: np.ndarray, q: np.ndarray) -> float:
    """Return how far q, (..., 7), is beyond the joint limits at worst, radians."""
    return float(np.maximum(limits[:, 0] - q, q - limits[:, 1]).max().clip(0.0))


def tries(arm: tuple, T_goal: np.ndarray, limits: np.ndarray, rng) -> int:
    """Return at which try solve_ik reaches a target: 1 from READY_Q; 0 is never."""
    q = READY_Q
    for attempt in range(1, TRIES + 1):
        if miss(arm, solve_ik(*arm, T_goal, q, limits), T_goal) < 1e-8:
            return attempt
        q = rng.uniform(*limits.T)  # another start leads to another valley
    return 0


def all_tries(arm: tuple, goals: np.ndarray, limits: np.ndarray, rng) -> np.ndarray:
    """Return `tries` of each target, (n,); after three failures the rest is spared."""
    found: list[int] = []
    for T_goal in goals:
        if found.count(0) < 3:
            found.append(tries(arm, T_goal, limits, rng))
    return np.array(found)


def on_the_circle(radius: float, time: float) -> np.ndarray:
    """Return where the hand should be, (4, 4); the tool points down all the way."""
    phi, T = 2 * np.pi * time / LAP, np.diag([-1.0, 1.0, -1.0, 1.0])
    T[:3, 3] = CENTRE + radius * np.array([0.0, np.cos(phi), np.sin(phi)])
    return T


def first_q(arm: tuple, radius: float, limits: np.ndarray) -> np.ndarray:
    """Return where the circle starts; the library's, so that all draw the same one."""
    return jacobian.solve_ik(*arm, on_the_circle(radius, 0.0), START_Q, limits)


def best_miss(arm: tuple, q: np.ndarray, radius: float, limits: np.ndarray):
    """Return how far off the circle the hand must be, mm, (n,): the library's best."""
    goals = np.array([on_the_circle(radius, t - DT) for t in np.arange(DT, LAP, DT)])
    best = fk_space(*arm, jacobian.solve_ik(*arm, goals, q, limits))
    return 1000 * np.linalg.norm(best[:, :3, 3] - goals[:, :3, 3], axis=1)


def draw_circle(arm: tuple, q: np.ndarray, radius: float, damping: float) -> tuple:
    """Return how far off the hand is, mm, (n,), and joint speeds and angles, (n, 7)."""
    off, speeds, angles = [], [], []
    T_now = on_the_circle(radius, 0.0)
    for time in np.arange(DT, LAP, DT):
        T, T_next = fk_space(*arm, q), on_the_circle(radius, time)
        # The circle's own velocity, and a correction of what is off by now.
        twist = pose_error(T_now, T_next) / DT + GAIN * pose_error(T, T_now)
        J = site_jacobian(space_jacobian(arm[0], q), T[:3, 3])
        q_dot = dls_step(J, twist, damping)
        off.append(1000 * np.linalg.norm(T_now[:3, 3] - T[:3, 3]))
        speeds.append(np.abs(q_dot))
        angles.append(q)
        q, T_now = q + DT * q_dot, T_next
    return np.array(off), np.array(speeds), np.array(angles)


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    model = panda.load("panda_nohand")
    print(panda.describe("panda_nohand"))
    screws = panda.screws(model)
    arm = (screws, panda.home_pose(model))
    limits, rng = model.jnt_range, np.random.default_rng(SEED)
    q = np.vstack([np.zeros(7), READY_Q, verify.random_q(model, TRIALS, SEED)])
    J_mujoco, T = verify.mujoco_site_jacobian(model, q), fk_space(*arm, q)

    lab.step("1. The Jacobian: every column is a joint's screw, where it is now")
    J_space = each(lambda x: space_jacobian(screws, x), q)
    J_site = each(site_jacobian, J_space, T[:, :3, 3])
    lab.show("J_site when the arm is ready: rows (omega; v)", J_site[1], 3)
    lab.check("J_space at q = 0: the screws", J_space[0] - screws.T)
    lab.record("jacobian_by_hand", np.abs(J_site[2:] - J_mujoco[2:]).max(axis=(1, 2)),
               label=f"J_site - MuJoCo's at {TRIALS} random q",
               config="random", seed=SEED)  # fmt: skip
    R_back = np.swapaxes(T[:, :3, :3], 1, 2)  # turns both halves into the hand's axes
    seen = np.hstack([R_back @ J_mujoco[:, :3], R_back @ J_mujoco[:, 3:]])
    with lab.side_quest():
        lab.check("J_body - MuJoCo's, turned", each(body_jacobian, J_space, T) - seen)
    many = verify.random_q(model, LIBRARY_TRIALS, SEED)
    p = fk_space(*arm, many)[:, :3, 3]
    theirs = jacobian.site_jacobian(jacobian.space_jacobian(screws, many), p)
    off = theirs - verify.mujoco_site_jacobian(model, many)
    lab.check(f"the library robo47.jacobian at {LIBRARY_TRIALS:,}", off)

    lab.step("2. How far is it to the goal? A rotation vector and a translation")
    axes = rng.normal(size=(TRIALS, 3))
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    angles = np.pi * rng.uniform(size=TRIALS)
    angles[:40] = [
        0.0,
        1e-9,
        1e-5,
        *(np.pi - 10.0 ** -np.arange(1, 10)),
        *angles[12:40],
    ]
    off = each(log_rotation, exp_rotation(axes, angles)) - angles[:, None] * axes
    lab.check(f"log_rotation of {TRIALS} known turns, also near 0 and pi", off)
    half_turn = log_rotation(np.diag([-1.0, 1.0, -1.0]))
    lab.check("and of half a turn about y", half_turn - [0.0, np.pi, 0.0])
    e = each(pose_error, T[:-1], T[1:])
    size = np.linalg.norm(e[:, :3], axis=1)
    arrives = exp_rotation(e[:, :3] / size[:, None], size) @ T[:-1, :3, :3]
    lab.check("turned by the error, the hand has the goal's R", arrives - T[1:, :3, :3])
    lab.check(
        "moved by it, it has the goal's p", T[:-1, :3, 3] + e[:, 3:] - T[1:, :3, 3]
    )

    lab.step("3. Steps: damped, and those that the hand does not feel")
    U, sigma, Vt = np.linalg.svd(J_mujoco)
    lab.check("manipulability, from the singular values",
              each(manipulability, J_mujoco) - sigma.prod(axis=1), 1e-7)  # fmt: skip
    print(f"  At q = 0 it is {manipulability(J_mujoco[0]):.4f}, so a motion is lost.")
    lab.show("Day 2 asked which: (omega; v) is", np.abs(U[0, :, -1]), 3)
    e, J = e[:12], np.vstack([J_mujoco[:6], J_mujoco[:6]])  # q = 0 among them
    damping = np.repeat([DAMPING, 1.0], 6)
    padded = [np.vstack([A, d * np.eye(7)]) for A, d in zip(J, damping, strict=True)]
    best = [np.linalg.lstsq(A, np.append(x, np.zeros(7)))[0]
            for A, x in zip(padded, e, strict=True)]  # fmt: skip
    off = each(dls_step, J, e, damping) - best
    lab.check("dls_step - least squares with 7 more rows", off)
    dq, null = rng.normal(size=(len(q) - 1, 7)), Vt[1:, 6]
    off = each(null_step, J_mujoco[1:], dq) - np.sum(dq * null, 1, keepdims=True) * null
    lab.check("null_step - the part along the null vector", off)

    lab.step("4. Inverse kinematics")
    stayed = solve_ik(*arm, T[1], READY_Q, limits)
    lab.check("a start that is there already comes back", stayed - READY_Q)
    middle = limits.mean(axis=1)
    starts = middle + 0.7 * (q[2 : NEAR + 2] - middle)
    near = np.clip(starts + rng.uniform(-0.3, 0.3, starts.shape), *limits.T)
    goals = fk_space(*arm, near)
    found = each(lambda goal, x: solve_ik(*arm, goal, x, limits), goals, starts)
    left = each(lambda goal, x: miss(arm, x, goal), goals, found) > 1e-8
    lab.check(f"share of {NEAR} near targets not reached", left.mean(), 0.03)
    out = goals[:4].copy()
    out[:, :3, 3] *= 2.0 / np.linalg.norm(out[:, :3, 3], axis=1)[:, None]
    far = each(lambda goal, x: solve_ik(*arm, goal, x, limits), out, starts[:4])
    best = jacobian.solve_ik(*arm, out, starts[:4], limits)  # hundreds of starts each
    ratio = each(lambda goal, x: miss(arm, x, goal), out, far) / each(
        lambda goal, x: miss(arm, x, goal), out, best
    )
    lab.check("2 m away, out of reach: error / the library's", ratio, 1.01)
    goals = fk_space(*arm, many[:FAR])
    some = each(lambda goal: solve_ik(*arm, goal, READY_Q, limits), goals[:5])
    ends = np.vstack([found, far, some])
    lab.check("rad beyond the joint limits", beyond(limits, ends))
    at = all_tries(arm, goals, limits, rng)
    print(
        f"  {len(at)} targets anywhere: {np.sum(at == 1)} reached from the ready pose,"
    )
    print(f"  {np.sum(at > 0)} with up to {TRIES} starts.")
    lab.record("ik_by_hand", np.mean(at == 0), label="share not reached", seed=SEED,
               n_trials=len(at), n_failures=int(np.sum(at == 0)))  # fmt: skip

    lab.step(f"5. A circle of {RADIUS} m, out of reach at its top, with damping")
    start = first_q(arm, RADIUS, limits)
    off, speeds, _ = draw_circle(arm, start, RADIUS, DAMPING)
    lab.record("circle_dls", off, metric="max_err_mm", label="mm off the circle")
    lab.record("circle_dls", (speeds / SPEED).max(axis=1), metric="rate_over_limit",
               label="fastest joint, in parts of its limit")  # fmt: skip
    least = best_miss(arm, start, RADIUS, limits)
    out = np.sum(least > 1e-3)
    print(f"  {out} of {len(least)} poses are out of reach, by up to", end=" ")
    print(f"{least.max():.2f} mm.")
    lab.check("mm farther off than the best joint angles", off - least, 15)

    lab.step("6. Without damping: another DT, other numbers")
    for radius in (EASY, RADIUS):
        off, speeds, _ = draw_circle(arm, first_q(arm, radius, limits), radius, 0.0)
        print(f"  {radius:.2f} m: {off.max():8.2f} mm off, {speeds.max():8.2f} rad/s, "
              f"{(speeds / SPEED).max():.2f} of the limit")  # fmt: skip
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
