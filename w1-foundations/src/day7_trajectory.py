"""Day 7: trajectories within limits, and a cube that the arm picks up.

    make day7                          in the clone: sets everything up, then runs this
    python src/day7_trajectory.py      in w1-foundations/, once that is done

The path parameter s runs from 0 to 1; sd and sdd are its derivatives with respect to
time. T_world_x maps coordinates of frame x to the world. Metres, radians, seconds,
kilograms.
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
TRIALS = 200  # random motions, poses and bodies on which your code is tested
SEED = 47  # of the random inputs, the same at every run
OMEGA = 20.0  # rad/s, of the controller; with 10 the errors are twice as large
RATE = 250.0  # Hz, of the controller in step 7
PICK_RATE = 100.0  # Hz, in step 8; at 20 the arm still picks, at 12.5 the cube falls


def quintic_scaling(t: float, duration: float) -> np.ndarray:
    """Return s, sd and sdd of the quintic time scaling at time t, (3,).

    t and duration > 0 are in seconds. s is the polynomial of degree 5 in t / duration
    that rises from 0 to 1 with velocity and acceleration 0 at both ends (Modern
    Robotics, section 9.2.2). sd (1/s) and sdd (1/s^2) are derivatives with respect to
    t. Before 0 the result is (0, 0, 0), after the duration (1, 0, 0).

    quintic_scaling(0.6, 2.0) -> [0.16308, 0.6615, 1.26]
    """
    # region 7.1
    x = np.clip(t / duration, 0.0, 1.0)  # the fraction of the duration, 0 to 1
    s = 10 * x**3 - 15 * x**4 + 6 * x**5  # the path parameter
    sd = (30 * x**2 - 60 * x**3 + 30 * x**4) / duration  # the velocity of s
    sdd = (60 * x - 180 * x**2 + 120 * x**3) / duration**2  # the acceleration of s
    return np.array([s, sd, sdd])  # the vector of s, sd and sdd
    # endregion 7.1


def quintic_duration(
    delta_q: np.ndarray, v_max: np.ndarray, a_max: np.ndarray
) -> float:
    """Return the shortest duration, s, of a quintic motion within all joint limits.

    delta_q (7,) is the displacement of each joint, rad, of either sign; v_max (7,) and
    a_max (7,) are the limits of velocity, rad/s, and acceleration, rad/s^2, all above
    0. All joints share one time scaling, that of `quintic_scaling`. If no joint moves,
    the duration is 0. One joint that moves by 1 rad at up to 1.875 rad/s, with no
    limit of the acceleration, takes 1 s (Modern Robotics, section 9.2.2).
    """
    # region 7.2
    by_speed = 15 / 8 * np.abs(delta_q) / v_max  # the times for v_max
    by_accel = np.sqrt(10 / np.sqrt(3) * np.abs(delta_q) / a_max)  # the times for a_max
    return max(by_speed.max(), by_accel.max())  # the longest duration
    # endregion 7.2


def joint_trajectory(
    q0: np.ndarray, q1: np.ndarray, t: float, duration: float
) -> np.ndarray:
    """Return q, qd and qdd at time t of a straight line in joint space, rows, (3, 7).

    q0 (7,) and q1 (7,) are the first and the last configuration, rad; t and duration
    > 0 are in seconds. The time scaling is `quintic_scaling`, so the arm rests at q0
    before 0 and at q1 after the duration. Half way, q is (q0 + q1) / 2 and qd is 1.875
    (q1 - q0) / duration. Angles are not wrapped (Modern Robotics, section 9.2.1).
    """
    # region 7.3
    s, sd, sdd = quintic_scaling(t, duration)  # the time scaling at t
    return np.array([
        q0 + (q1 - q0) * s,  # the configuration
        (q1 - q0) * sd,  # the joint velocities
        (q1 - q0) * sdd,  # the joint accelerations
    ])  # fmt: skip
    # endregion 7.3


def trapezoidal_profile(t: float, L: float, v: float, a: float) -> np.ndarray:
    """Return position, velocity and acceleration of the trapezoidal profile, (3,).

    t is the time, s; L the distance, v the velocity limit and a the acceleration, all
    above 0 and in one unit of length. The motion accelerates with a, moves at v and
    decelerates with a. If L is too short to reach v, the profile is a triangle: it
    accelerates over the first half of L and decelerates over the second (Modern
    Robotics, section 9.2.2). Before 0 the result is (0, 0, 0), after the end (L, 0, 0).
    With L 1, v 0.5 and a 1 the motion takes 2.5 s; with L 0.1, v 1 and a 2, 0.4472 s.

    trapezoidal_profile(1.0, 1.0, 0.5, 1.0) -> [0.375, 0.5, 0]
    """
    # region 7.4
    top = min(v, np.sqrt(L * a))  # the highest velocity of the motion
    ramp = top / a  # the duration of one ramp
    duration = L / top + ramp  # the duration of the whole motion
    if t <= 0:
        return np.zeros(3)  # the state of rest before the start
    if t < ramp:
        return np.array([a * t**2 / 2, a * t, a])  # the state during acceleration
    if t < duration - ramp:
        return np.array([top * (t - ramp / 2), top, 0.0])  # the state at full velocity
    left = max(duration - t, 0.0)  # the remaining time until the end
    return np.array([
        L - a * left**2 / 2,  # the position during the deceleration
        a * left,  # the velocity during the deceleration
        -a if left else 0.0,  # the acceleration during the deceleration
    ])  # fmt: skip
    # endregion 7.4


def quintic_coefficients(
    start: np.ndarray, end: np.ndarray, duration: float
) -> np.ndarray:
    """Return the coefficients of 1, t, ..., t^5 of the quintic between states, (6,).

    start (3,) holds position, velocity and acceleration at the time 0, end (3,) the
    same at the time duration > 0, s. The six conditions are six linear equations for
    the six coefficients (Modern Robotics, section 9.3).

    quintic_coefficients([0, 0, 0], [1, 0, 0], 1.0) -> [0, 0, 0, 10, -15, 6]
    """
    # region 7.5
    d = duration  # the time at the end
    A = np.array([
        [1, 0, 0, 0, 0, 0],  # the position at the start
        [0, 1, 0, 0, 0, 0],  # the velocity at the start
        [0, 0, 2, 0, 0, 0],  # the acceleration at the start
        [1, d, d**2, d**3, d**4, d**5],  # the position at the end
        [0, 1, 2 * d, 3 * d**2, 4 * d**3, 5 * d**4],  # the velocity at the end
        [0, 0, 2, 6 * d, 12 * d**2, 20 * d**3],  # the acceleration at the end
    ])  # fmt: skip
    return np.linalg.solve(A, np.concatenate([start, end]))  # the coefficients
    # endregion 7.5


def interpolate_pose(T0: np.ndarray, T1: np.ndarray, s: float) -> np.ndarray:
    """Return the pose (4, 4) at the fraction s of a straight line from T0 to T1.

    T0 (4, 4) and T1 (4, 4) are poses in one frame, s is from 0 to 1. The origin moves
    on a straight line; the orientation rotates about one fixed axis at a constant rate
    (slerp), by the smaller of the two possible angles. At s = 0 the result is T0, at
    s = 1 it is T1. Equal orientations are allowed; after a rotation by pi either sense
    of rotation is correct (Modern Robotics, section 9.2.1, equation 9.8).
    """
    # region 7.6
    R0, p0 = T0[:3, :3], T0[:3, 3]  # the first orientation and the first position
    turn = jacobian.log_rotation(R0.T @ T1[:3, :3])  # the rotation vector from R0 to R1
    angle = np.linalg.norm(turn)  # the angle from R0 to R1
    axis = turn / angle if angle > 0 else np.array([0.0, 0.0, 1.0])  # the unit axis
    R = R0 @ screws.exp_rotation(axis, s * angle)  # the orientation at s
    return se3.make_T(R, p0 + s * (T1[:3, 3] - p0))  # the pose on the line
    # endregion 7.6


def grasp_pose(T_world_cube: np.ndarray, above: float) -> np.ndarray:
    """Return the grasp pose T_world_tcp (4, 4) of a tool over a cube.

    T_world_cube (4, 4) is the pose of a cube whose z axis points up. The origin of the
    tool is `above` metres over the centre of the cube, and its z axis points down. Its
    x axis is parallel to a side of the cube and within 45 degrees of the world's x
    axis, because a rotation by 90 degrees does not change a cube. For a yaw of 80
    degrees the yaw of the tool is therefore -10 degrees; for 0 its x axis is the
    world's.
    """
    # region 7.7
    yaw = np.arctan2(T_world_cube[1, 0], T_world_cube[0, 0])  # the yaw of the cube
    yaw -= np.round(yaw / (np.pi / 2)) * np.pi / 2  # the yaw within 45 degrees of 0
    tool_down = np.diag([1.0, -1.0, -1.0])  # the orientation with z down and x ahead
    return se3.make_T(
        se3.Rz(yaw) @ tool_down,  # the orientation of the tool
        T_world_cube[:3, 3] + [0, 0, above],  # the position of the tool
    )
    # endregion 7.7


def combine_bodies(
    m1: float, c1: np.ndarray, I1: np.ndarray,
    m2: float, c2: np.ndarray, I2: np.ndarray,
) -> np.ndarray:  # fmt: skip
    """Return mass, centre of mass and inertia of two bodies fixed together, (10,).

    m1 and m2 are masses, kg; c1 (3,) and c2 (3,) centres of mass, m; I1 (3, 3) and I2
    (3, 3) inertias, kg m^2, each about its own centre of mass; all expressed in one
    frame. The result holds the mass (1), the common centre of mass (3), and the inertia
    about that centre as xx, yy, zz, xy, xz, yz. These are entries of the matrix, so xy
    is the sum of -m x y (Modern Robotics, section 8.2.1). Two points of 1 kg at (0, 0,
    0) and (2, 0, 0): 2; (1, 0, 0); 0, 2, 2, 0, 0, 0.
    """
    # region 7.8
    m = m1 + m2  # the mass of both
    c = (m1 * c1 + m2 * c2) / m  # the common centre of mass
    moved = np.zeros((3, 3))  # the sum of the inertias about the common centre
    for mass, com, own in ((m1, c1, I1), (m2, c2, I2)):
        d = com - c  # the body's offset from the common centre of mass
        shift = d @ d * np.eye(3) - np.outer(d, d)  # the parallel-axis theorem
        moved += own + mass * shift  # the inertia about the common centre
    six = moved[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]  # xx, yy, zz, xy, xz, yz
    return np.concatenate([[m], c, six])  # the ten numbers in their order
    # endregion 7.8


def max_cube_mass(grip: float, mu: float, acceleration: float) -> float:
    """Return the largest mass, kg, that two fingers can lift by friction.

    grip >= 0 is the normal force of each finger, N, mu >= 0 the coefficient of Coulomb
    friction, acceleration > -9.81 the upward acceleration of the cube, m/s^2.

    max_cube_mass(0.9247, 1.0, 0.0) -> 0.189
    """
    # region 7.9
    return 2 * mu * grip / (acceleration - GRAVITY[2])  # the largest mass
    # endregion 7.9


def off_library(name: str, own, at: day7_mujoco.Moves) -> np.ndarray:
    """Return a function's differences from robo47's; MuJoCo has no trajectories."""
    columns = day7_mujoco.arguments(at, SEED)[name]
    truth = getattr(trajectory, name)(*columns)
    return verify.each(own, *columns) - truth


def limits_used(at: day7_mujoco.Moves) -> np.ndarray:
    """Return the largest fraction of any limit in each joint motion, (n,)."""
    limits = V_MAX, A_MAX
    inner = [0.5 - np.sqrt(3) / 6, 0.5, 0.5 + np.sqrt(3) / 6]  # at the maxima of both

    def share(q0: np.ndarray, q1: np.ndarray) -> float:
        duration = quintic_duration(q1 - q0, *limits)
        states = [
            joint_trajectory(q0, q1, x * duration, duration)
            for x in (*inner, *np.linspace(0, 1, 20))
        ]
        return float((np.abs(states).max(axis=0)[1:] / limits).max())

    return verify.each(share, at.q0, at.q1)


def missed_ends(at: day7_mujoco.Moves) -> np.ndarray:
    """Return the errors of your quintics in the conditions at both ends, (n, 6)."""
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
    """Return s, sd and sdd of the cubic time scaling from rest to rest, (3,)."""
    x = t / duration
    return np.array([3 * x**2 - 2 * x**3, 6 * x - 6 * x**2, 6 - 12 * x]) / [
        1,
        duration,
        duration**2,
    ]


def profiles(duration: float) -> dict:
    """Return {name: (s, sd, sdd at time t; seconds)} of five time scalings."""
    dq = np.abs(GOAL_Q - READY_Q)
    v = np.min(V_MAX / dq)  # of s: the slowest joint determines it
    a = np.min(A_MAX / dq)
    top = min(v, np.sqrt(a))  # a short motion never reaches v
    return {
        "step": (lambda t: np.array([1.0, 0.0, 0.0]), duration),
        "constant speed": (
            lambda t: np.array([t / duration, 1 / duration, 0.0]),
            duration,
        ),
        "cubic": (lambda t: cubic(t, duration), duration),
        "trapezoid": (lambda t: trapezoidal_profile(t, 1.0, v, a), 1 / top + top / a),
        "quintic": (lambda t: quintic_scaling(t, duration), duration),
    }


def pick(lab: Lab) -> None:
    """Pick the cube up and put it down, with your functions of today."""
    done = capstone.pick(capstone.with_own(globals()), rate=PICK_RATE)
    most = done.heaviest
    print(f"  predicted: the grip can lift up to {most:.3f} kg; the cube has 0.08 kg")
    lab.measured("heaviest cube while the lift speeds up, kg", most)
    print(f"  cube lifted to {done.lift:.3f} m; duration {done.seconds:.2f} s")
    print(f"  largest fraction of a torque limit {done.torque:.2f},", end=" ")
    print(f"of a velocity limit {done.speed:.2f}")
    print(f"  largest distance of the hand from its line: {done.line_mm:.2f} mm")
    lab.record("pick", done.place_mm, metric="place_mm",
               label="distance of the cube from its target, mm")  # fmt: skip
    lab.record("pick", done.joint_mrad, metric="joint_err_mrad",
               label="largest joint error, mrad")  # fmt: skip


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    model = panda.load("panda")  # the model with a hand
    at = day7_mujoco.moves(model, TRIALS, SEED)

    lab.step("1. A quintic time scaling, from rest to rest")
    lab.show("s, sd, sdd at 0.6 s of a motion of 2 s", quintic_scaling(0.6, 2.0))
    off = off_library("quintic_scaling", quintic_scaling, at)
    lab.check("|quintic_scaling - the library's|", off)
    off = off_library("joint_trajectory", joint_trajectory, at)
    lab.check("|joint_trajectory - the library's|", off)

    lab.step("2. The shortest duration: the slowest joint determines it")
    each = [quintic_duration(one, V_MAX, A_MAX) for one in np.diag(GOAL_Q - READY_Q)]
    lab.show("seconds that joint1 to joint7 each need alone", each, 3)
    T_move = quintic_duration(GOAL_Q - READY_Q, V_MAX, A_MAX)
    print(f"  The shortest duration of the motion is {T_move:.4f} s.")
    lab.measured("seconds that the move of step 2 takes", T_move)
    used = limits_used(at)
    lab.record("limits", used, label=f"largest fraction of a limit, {TRIALS} motions",
               config="random", seed=SEED)  # fmt: skip
    # A duration is the shortest one only if some joint reaches a limit.
    lab.check("largest unused fraction of the limits", 1 - used)

    lab.step("3. The trapezoidal profile: fastest, with discontinuous acceleration")
    off = off_library("trapezoidal_profile", trapezoidal_profile, at)
    lab.check("|trapezoidal_profile - the library's|", off)
    L, v, a = day7_mujoco.ramps(4 * TRIALS, SEED)
    short = np.mean(v**2 / a > L)
    print(f"  {short:.0%} of these motions are too short to reach the velocity limit.")

    lab.step("4. A quintic between two states: six conditions, six coefficients")
    lab.check("errors of the conditions at both ends", missed_ends(at))

    lab.step("5. Poses along a straight line, and the grasp pose over a cube")
    off = off_library("interpolate_pose", interpolate_pose, at)
    lab.check("|interpolate_pose - the library's|", off)
    off = off_library("grasp_pose", grasp_pose, at)
    lab.check("|grasp_pose - the library's|", off)
    cube = se3.make_T(se3.Rz(np.radians(80)), np.array([0.5, 0.2, 0.22]))
    lab.show("tool pose 0.12 m over a cube with a yaw of 80 degrees",
             grasp_pose(cube, 0.12), 4)  # fmt: skip

    lab.step("6. The last link with the hand, and the heaviest cube")
    off = off_carried(model, at.q0)
    lab.check("|bias torque with the hand - MuJoCo's|, N m", off)
    with lab.side_quest():
        off = off_library("max_cube_mass", max_cube_mass, at)
        lab.check("|max_cube_mass - the library's|", off)
    if lab.failed:
        # As on a real robot: the motors get no power before the checks pass.
        print("\n  The arm stays off until these checks pass.")
        return lab.finish()

    lab.step("7. One motion with five time scalings, simulated")
    print(f"  {'':16}{'duration':>10}{'joint error':>13}{'jerk':>9}{'of torque':>11}")
    print(f"  {'':16}{'s':>10}{'mrad':>13}{'rad/s3':>9}{'limit':>11}")
    for name, (scaling, seconds) in profiles(T_move).items():
        one = day7_mujoco.follow(scaling, seconds, READY_Q, GOAL_Q, OMEGA, RATE)
        print(f"  {name:16}{seconds:10.3f}{one.mrad:13.2f}"
              f"{one.jerk:9.0f}{one.torque:11.2f}")  # fmt: skip

    lab.step("8. Pick the cube up and place it")
    pick(lab)
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
