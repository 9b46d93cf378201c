"""Day 7: trajectories. When is the arm where? Then it picks up a cube.

    make day7                          in the clone: sets everything up, then runs this
    python src/day7_trajectory.py      in w1-foundations/, once that is done

s is the part of a path that is done, 0 to 1; sd and sdd are its derivatives. T_world_x
maps x coordinates to the world. Metres, radians, seconds, kilograms.
"""

from dataclasses import replace

import kit  # noqa: F401 (goes on in the kit's own Python)
import mujoco
import numpy as np

from robo47 import (
    capstone,
    cli,
    jacobian,
    panda,
    screws,
    se3,
    simulate,
    trajectory,
    verify,
)
from robo47.lesson.lab import Lab

import day7_mujoco

READY_Q = panda.READY_Q  # the handout's home_q: seven joint angles, radians
GRAVITY = np.array([0.0, 0.0, -9.81])  # m/s2
GOAL_Q = np.array([0.9, 0.3, -0.4, -1.6, 0.5, 2.2, -0.6])  # radians, steps 2 and 7
V_MAX = simulate.SPEED_LIMITS  # rad/s, as Franka publishes them
A_MAX = simulate.ACC_LIMITS  # rad/s2, likewise
TRIALS = 200  # random moves, poses and bodies that your own code is judged on
SEED = 47  # the same random ones at every run
OMEGA = 20.0  # rad/s, how stiff the arm follows; with 10 the errors are twice as large
RATE = 250.0  # Hz, of the controller in step 7
PICK_RATE = 100.0  # Hz, in step 8; at 20 the arm still picks, at 12.5 the cube falls


def quintic_scaling(t: float, duration: float) -> np.ndarray:
    """Return s, sd and sdd at time t of a soft move, (3,).

    duration is in seconds. At 0.6 of 2 s: 0.16308, 0.6615, 1.26. Before 0 and after
    the duration it stands still.
    """
    # region 7.1
    x = np.clip(t / duration, 0.0, 1.0)
    s = 10 * x**3 - 15 * x**4 + 6 * x**5
    sd = (30 * x**2 - 60 * x**3 + 30 * x**4) / duration
    sdd = (60 * x - 180 * x**2 + 120 * x**3) / duration**2
    return np.array([s, sd, sdd])
    # endregion 7.1


def quintic_duration(
    delta_q: np.ndarray, v_max: np.ndarray, a_max: np.ndarray
) -> float:
    """Return the shortest duration of a quintic over delta_q within all joints' limits.

    All are (7,); delta_q has either sign. 1 rad at 1.875 rad/s and any acceleration:
    1 s. Where no joint moves: 0.
    """
    # region 7.2
    by_speed = 15 / 8 * np.abs(delta_q) / v_max
    by_acceleration = np.sqrt(10 / np.sqrt(3) * np.abs(delta_q) / a_max)
    return max(by_speed.max(), by_acceleration.max())
    # endregion 7.2


def joint_trajectory(
    q0: np.ndarray, q1: np.ndarray, t: float, duration: float
) -> np.ndarray:
    """Return q, qd and qdd at time t on the way from q0 to q1, three rows, (3, 7).

    After half the duration it is half way, at 1.875 (q1 - q0) / duration. Angles past
    pi stay as they are.
    """
    # region 7.3
    s, sd, sdd = quintic_scaling(t, duration)
    return np.array([q0 + (q1 - q0) * s, (q1 - q0) * sd, (q1 - q0) * sdd])
    # endregion 7.3


def trapezoidal_profile(t: float, L: float, v: float, a: float) -> np.ndarray:
    """Return position, speed and acceleration of ramp, cruise, ramp over L, (3,).

    L 1, v 0.5, a 1 takes 2.5 s; at 1 s: 0.375, 0.5, 0. Where L is too short to reach v
    there is no cruise: L 0.1, v 1, a 2 takes 0.4472 s. Before 0 it stands at 0, after
    the end at L, without speed or acceleration. L, v and a are above 0.
    """
    # region 7.4
    top = min(v, np.sqrt(L * a))
    ramp = top / a
    duration = L / top + ramp
    if t <= 0:
        return np.zeros(3)
    if t < ramp:
        return np.array([a * t**2 / 2, a * t, a])
    if t < duration - ramp:
        return np.array([top * (t - ramp / 2), top, 0.0])
    left = max(duration - t, 0.0)
    return np.array([L - a * left**2 / 2, a * left, -a if left else 0.0])
    # endregion 7.4


def quintic_coefficients(
    start: np.ndarray, end: np.ndarray, duration: float
) -> np.ndarray:
    """Return the factors of 1, t, ..., t^5 of the quintic between two states, (6,).

    start and end are position, speed and acceleration, (3,).
    From (0, 0, 0) to (1, 0, 0) in 1 s: (0, 0, 0, 10, -15, 6).
    """
    # region 7.5
    d = duration
    A = np.array([
        [1, 0, 0, 0, 0, 0],
        [0, 1, 0, 0, 0, 0],
        [0, 0, 2, 0, 0, 0],
        [1, d, d**2, d**3, d**4, d**5],
        [0, 1, 2 * d, 3 * d**2, 4 * d**3, 5 * d**4],
        [0, 0, 2, 6 * d, 12 * d**2, 20 * d**3],
    ])  # fmt: skip
    return np.linalg.solve(A, np.concatenate([start, end]))
    # endregion 7.5


def interpolate_pose(T0: np.ndarray, T1: np.ndarray, s: float) -> np.ndarray:
    """Return the pose at s between two poses: a straight line, a turn at one rate.

    At s = 0 it is T0, at 1 it is T1, and half way the origin is in the middle. A turn
    of pi may go either way round, and no turn is too small.
    """
    # region 7.6
    R0, p0 = T0[:3, :3], T0[:3, 3]
    turn = jacobian.log_rotation(R0.T @ T1[:3, :3])
    angle = np.linalg.norm(turn)
    axis = turn / angle if angle > 0 else np.array([0.0, 0.0, 1.0])
    R = R0 @ screws.exp_rotation(axis, s * angle)
    return se3.make_T(R, p0 + s * (T1[:3, 3] - p0))
    # endregion 7.6


def grasp_pose(T_world_cube: np.ndarray, above: float) -> np.ndarray:
    """Return T_world_tcp: `above` metres over the cube, z down, turned least.

    The cube stands upright. It looks the same after a quarter turn: at a yaw of 80
    degrees the tool turns by -10. At yaw 0 its x is the world's.
    """
    # region 7.7
    yaw = np.arctan2(T_world_cube[1, 0], T_world_cube[0, 0])
    yaw -= np.round(yaw / (np.pi / 2)) * np.pi / 2
    tool_down = np.diag([1.0, -1.0, -1.0])
    return se3.make_T(se3.Rz(yaw) @ tool_down, T_world_cube[:3, 3] + [0, 0, above])
    # endregion 7.7


def combine_bodies(
    m1: float, c1: np.ndarray, I1: np.ndarray,
    m2: float, c2: np.ndarray, I2: np.ndarray,
) -> np.ndarray:  # fmt: skip
    """Return the one body that two are when the first holds the second, (10,).

    Given mass, centre of mass and inertia (3, 3) about it; returned mass, centre, and
    inertia about the common centre as xx, yy, zz, xy, xz, yz: entries of the matrix, so
    xy has the other sign than a textbook's product of inertia. Two points of 1 kg, 2 m
    apart along x: 2; (1, 0, 0); 0, 2, 2, 0, 0, 0.
    """
    # region 7.8
    m = m1 + m2
    c = (m1 * c1 + m2 * c2) / m
    moved = np.zeros((3, 3))
    for mass, com, own in ((m1, c1, I1), (m2, c2, I2)):
        d = com - c
        moved += own + mass * (d @ d * np.eye(3) - np.outer(d, d))
    six = moved[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    return np.concatenate([[m], c, six])
    # endregion 7.8


def max_cube_mass(grip: float, mu: float, acceleration: float) -> float:
    """Return the mass in kg that two fingers lift by friction alone.

    Each presses with `grip` newtons; the acceleration is positive upwards. 0.9247 N,
    mu 1, no acceleration: 0.189 kg.
    """
    # region 7.9
    return 2 * mu * grip / (acceleration - GRAVITY[2])
    # endregion 7.9


def off_library(name: str, own, at: day7_mujoco.Moves) -> np.ndarray:
    """Return how far a function is from robo47's: MuJoCo knows no trajectories."""
    columns = day7_mujoco.arguments(at, SEED)[name]
    truth = getattr(trajectory, name)(*columns)
    return verify.each(own, *columns) - truth


def limits_used(at: day7_mujoco.Moves) -> np.ndarray:
    """Return the largest share of any limit that each joint move uses, (n,)."""
    limits = V_MAX, A_MAX
    inner = [0.5 - np.sqrt(3) / 6, 0.5, 0.5 + np.sqrt(3) / 6]  # where both are largest

    def share(q0: np.ndarray, q1: np.ndarray) -> float:
        duration = quintic_duration(q1 - q0, *limits)
        way = [
            joint_trajectory(q0, q1, x * duration, duration)
            for x in (*inner, *np.linspace(0, 1, 20))
        ]
        return float((np.abs(way).max(axis=0)[1:] / limits).max())

    return verify.each(share, at.q0, at.q1)


def missed_ends(at: day7_mujoco.Moves) -> np.ndarray:
    """Return how far your quintics miss what they had to be at both ends, (n, 6)."""
    wanted = np.random.default_rng(SEED).uniform(-1, 1, (2, len(at.T), 3))

    def ends(start: np.ndarray, end: np.ndarray, duration: float) -> list[float]:
        p = np.polynomial.Polynomial(quintic_coefficients(start, end, duration))
        return [f(t) for t in (0.0, duration) for f in (p, p.deriv(), p.deriv(2))]

    return verify.each(ends, *wanted, at.T) - np.concatenate(wanted, axis=1)


def off_carried(model, configurations: np.ndarray) -> np.ndarray:
    """Return the bias of an arm whose link 7 carries the hand minus MuJoCo's, N m."""
    heavier = panda.inertias(model).carrying(combine_bodies, *panda.hand_inertia(model))
    arm = replace(panda.arm(model), **heavier._asdict())  # seven links, no hand
    data = mujoco.MjData(model)  # the hand is a body of its own, with two fingers
    rng = np.random.default_rng(SEED)
    off = []
    for q, qd in zip(
        configurations, rng.uniform(-2, 2, configurations.shape), strict=True
    ):
        data.qpos[:7] = q
        data.qvel[:7] = qd
        mujoco.mj_forward(model, data)  # fills qfrc_bias
        off.append(arm.at(q).bias(qd) - data.qfrc_bias[:7])
    return np.array(off)


def cubic(t: float, duration: float) -> np.ndarray:
    """Return s, sd and sdd of the softest scaling with four coefficients, (3,)."""
    x = t / duration
    return np.array([3 * x**2 - 2 * x**3, 6 * x - 6 * x**2, 6 - 12 * x]) / [
        1,
        duration,
        duration**2,
    ]


def profiles(duration: float) -> dict:
    """Return {name: (s, sd, sdd at time t; seconds)} of five ways to go from 0 to 1."""
    dq = np.abs(GOAL_Q - READY_Q)
    v = np.min(V_MAX / dq)  # of s: the slowest joint decides
    a = np.min(A_MAX / dq)
    return {
        "step": (lambda t: np.array([1.0, 0.0, 0.0]), duration),
        "constant speed": (
            lambda t: np.array([t / duration, 1 / duration, 0.0]),
            duration,
        ),
        "cubic": (lambda t: cubic(t, duration), duration),
        "trapezoid": (lambda t: trapezoidal_profile(t, 1.0, v, a), 1 / v + v / a),
        "quintic": (lambda t: quintic_scaling(t, duration), duration),
    }


def pick(lab: Lab) -> None:
    """Pick the cube up and put it down, with your functions of today."""
    done = capstone.pick(capstone.with_own(globals()), rate=PICK_RATE)
    most = done.heaviest
    print(f"  predicted: this lift takes up to {most:.3f} kg; the cube has 0.08")
    lab.measured("heaviest cube while the lift speeds up, kg", most)
    print(f"  lifted to {done.lift:.3f} m; {done.seconds:.2f} s in all; at most")
    print(f"  {done.torque:.2f} of the torque limits, {done.speed:.2f} of the speed's;")
    print(f"  the hand never more than {done.line_mm:.2f} mm off its straight lines")
    lab.record("pick", done.place_mm, metric="place_mm", label="cube off its place, mm")
    lab.record("pick", done.joint_mrad, metric="joint_err_mrad",
               label="joints off their way, mrad")  # fmt: skip


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    model = panda.load("panda")  # the one with a hand
    at = day7_mujoco.moves(model, TRIALS, SEED)

    lab.step("1. A soft start and a soft stop: one number from 0 to 1")
    lab.show("s, sd, sdd at 0.6 s of a move of 2 s", quintic_scaling(0.6, 2.0))
    off = off_library("quintic_scaling", quintic_scaling, at)
    lab.check("quintic_scaling, off the library", off)
    off = off_library("joint_trajectory", joint_trajectory, at)
    lab.check("joint_trajectory, off the library", off)

    lab.step("2. How long: the slowest joint decides")
    each = [quintic_duration(one, V_MAX, A_MAX) for one in np.diag(GOAL_Q - READY_Q)]
    lab.show("seconds that joint1 to joint7 need, each alone", each, 3)
    T_move = quintic_duration(GOAL_Q - READY_Q, V_MAX, A_MAX)
    print(f"  So the move takes {T_move:.4f} s.")
    lab.measured("seconds that the move of step 2 takes", T_move)
    used = limits_used(at)
    lab.record("limits", used, label=f"largest share of a limit, {TRIALS} moves",
               config="random", seed=SEED)  # fmt: skip
    # Slow is no art: a duration is right when some joint is at its limit.
    lab.check("largest share left unused", 1 - used)

    lab.step("3. The trapezoid: as fast as the limits allow, with corners")
    off = off_library("trapezoidal_profile", trapezoidal_profile, at)
    lab.check("trapezoid, off the library", off)
    L, v, a = day7_mujoco.ramps(4 * TRIALS, SEED)
    short = np.mean(v**2 / a > L)
    print(f"  {short:.0%} of those moves are too short to reach their top speed.")

    lab.step("4. Any start, any end: six conditions, six coefficients")
    lab.check("position, speed, acceleration at both ends", missed_ends(at))

    lab.step("5. The hand on a straight line, and over a cube")
    off = off_library("interpolate_pose", interpolate_pose, at)
    lab.check("interpolate_pose, off the library", off)
    off = off_library("grasp_pose", grasp_pose, at)
    lab.check("grasp_pose, off the library", off)
    cube = se3.make_T(se3.Rz(np.radians(80)), np.array([0.5, 0.2, 0.22]))
    lab.show("the tool 0.12 m over a cube at a yaw of 80 degrees",
             grasp_pose(cube, 0.12), 4)  # fmt: skip

    lab.step("6. What the last link carries, and how much it can lift")
    off = off_carried(model, at.q0)
    lab.check("torque to carry the hand, off MuJoCo's", off)
    with lab.side_quest():
        off = off_library("max_cube_mass", max_cube_mass, at)
        lab.check("max_cube_mass, off the library", off)
    if lab.failed:
        # The habit of every real robot: no power before the checks are green.
        print("\n  The arm stays off until these checks pass.")
        return lab.finish()

    lab.step("7. The same move with five time scalings, simulated")
    print(f"  {'':16}{'seconds':>9}{'mrad off':>10}{'rad/s3':>9}{'of the torque':>15}")
    for name, (scaling, seconds) in profiles(T_move).items():
        one = day7_mujoco.follow(scaling, seconds, READY_Q, GOAL_Q, OMEGA, RATE)
        print(f"  {name:16}{seconds:9.3f}{one.mrad:10.2f}"
              f"{one.jerk:9.0f}{one.torque:15.2f}")  # fmt: skip

    lab.step("8. Pick the cube up and put it down")
    pick(lab)
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
