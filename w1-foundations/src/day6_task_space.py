"""Day 6: the hand. Task-space inertia, operational-space and impedance control.

    make day6                          in the clone: sets everything up, then runs this
    python src/day6_task_space.py      in w1-foundations/, once that is done

J_site qd = (omega; velocity of the hand's site), expressed in the world frame; J_space
is Day 4's. A wrench is (moment; force). M includes the armature. Metres, radians,
newtons, kilograms.
"""

import kit  # noqa: F401 (goes on in the kit's own Python)
import mujoco
import numpy as np

from robo47 import cli, control, jacobian, panda, scenes, screws, simulate, verify
from robo47 import task_space as library
from robo47.lesson.lab import Lab
from robo47.rotation_log import small_pose_error

import day6_mujoco

READY_Q = panda.READY_Q
TRIALS = 50  # random states at which your own code is compared
SEED = 47
SIGMA = 0.05  # smallest singular value of J; at 0, a singularity, Lambda is infinite
# N m/rad and N/m. With 40 N/m 10 N move the hand by 250 mm, with 4,000 by 2.5 mm.
K = np.array([30.0, 30.0, 30.0, 400.0, 400.0, 400.0])
PUSH = np.array([0.0, 0.0, 1.0, 10.0, 0.0, 0.0])  # N m about z, N along x
PRESS, SINK = 20.0, 0.1  # N, wanted force on the table; m/s, approach velocity
ELBOW = (10.0, 4.0)  # N m/rad, N m s/rad: posture gains; with 0 the elbow drifts
RATE = 100.0  # Hz, of the controllers that come to rest; the circle uses 250
OMEGA = 20.0  # rad/s, feedback on the circle: 10 nearly doubles the error, 40 halves it
RADIUS, TURN = 0.12, 2.0  # m; s per revolution


def task_inertia(J_site: np.ndarray, M: np.ndarray) -> np.ndarray:
    """Return the task-space inertia Lambda of the hand, (6, 6).

    Lambda maps an acceleration (angular; linear) of the resting hand to the wrench
    (moment; force) that causes it. J_site (6, 7) is the site Jacobian, expressed in the
    world frame, with full rank; M (7, 7) is the mass matrix with armature, kg m^2. The
    unit of the lower right block is kg. With J_site the identity and M = 2 I it is 2 I.
    Source: Khatib (1987); Modern Robotics, section 8.6.
    """
    # region 6.1
    mobility = J_site @ np.linalg.solve(M, J_site.T)  # the mobility matrix
    return np.linalg.inv(mobility)  # the map from an acceleration to a wrench
    # endregion 6.1


def bias_acceleration(J_space: np.ndarray, qd: np.ndarray, p: np.ndarray) -> np.ndarray:
    """Return the bias acceleration of the hand, (6,): its acceleration with qdd = 0.

    The result is (angular; linear), rad/s^2 and m/s^2, of the hand's site at p, (3,),
    metres. J_space (6, 7) is the space Jacobian: its columns are the screws
    (omega; v) about the world's origin. qd (7,) are the joint velocities, rad/s. All is
    expressed in the world frame. A point at (1, 0, 0) that spins about z at 1 rad/s has
    (0, 0, 0, -1, 0, 0). Source: Featherstone, Rigid Body Dynamics Algorithms, section
    2.11.
    """
    # region 6.2
    parts = (J_space * qd).T  # contribution of each joint to the later twists
    V = np.cumsum(parts, axis=0)  # twist of each link
    rates = screws.ad(V) @ parts[..., None]  # rate of each contribution
    A = rates[..., 0].sum(axis=0)  # rate of the last link's twist
    omega = V[-1, :3]  # angular velocity of the hand
    alpha = A[:3]  # angular acceleration of the hand
    velocity = V[-1, 3:] + np.cross(omega, p)  # velocity of the site
    turning = np.cross(alpha, p) + np.cross(omega, velocity)  # part of the rotation
    linear = A[3:] + turning  # acceleration of the site
    return np.append(alpha, linear)  # the bias acceleration
    # endregion 6.2


def osc_torque(
    J_site: np.ndarray, Lambda: np.ndarray, bias: np.ndarray, bias_acc: np.ndarray,
    acc: np.ndarray,
) -> np.ndarray:  # fmt: skip
    """Return the joint torques of operational-space control, (7,), N m.

    With these torques the hand has the acceleration acc. J_site (6, 7) is the site
    Jacobian; Lambda (6, 6) is the task-space inertia; bias (7,) is the torque of
    gravity, Coriolis and centrifugal forces, N m; bias_acc (6,) is the result of
    `bias_acceleration`; acc (6,) is (angular; linear), rad/s^2 and m/s^2. The joints'
    damping is not included. If acc equals bias_acc, the result is bias. Source: Khatib
    (1987).
    """
    # region 6.3
    wrench = Lambda @ (acc - bias_acc)  # wrench for the rest of the acceleration
    return J_site.T @ wrench + bias  # torques of the wrench plus bias
    # endregion 6.3


def nullspace_torque(
    J_site: np.ndarray, M: np.ndarray, Lambda: np.ndarray, tau: np.ndarray
) -> np.ndarray:
    """Return the part of tau that does not accelerate the hand, (7,), N m.

    J_site (6, 7) is the site Jacobian, M (7, 7) the mass matrix, kg m^2, Lambda (6, 6)
    the task-space inertia and tau (7,) a joint torque, N m. Subtract from tau the
    torques of the wrench that causes the same acceleration of the hand. If J_site takes
    only the first six of seven joints, and M and Lambda are identities, seven ones
    become six 0 and one 1. Source: Khatib (1987).
    """
    # region 6.4
    hand_acc = J_site @ np.linalg.solve(M, tau)  # acceleration of the hand under tau
    wrench = Lambda @ hand_acc  # wrench that causes the same acceleration
    return tau - J_site.T @ wrench  # torque without its effect on the hand
    # endregion 6.4


def impedance_wrench(
    e: np.ndarray, V_err: np.ndarray, K: np.ndarray, D: np.ndarray
) -> np.ndarray:
    """Return the wrench K e + D V_err of a spring and a damper at the hand, (6,).

    e (6,) is the pose error from the hand to its target, (rotation vector;
    displacement), rad and m; V_err (6,) is the target's twist minus the hand's. K
    (6, 6) is the stiffness, N m/rad and N/m, and D (6, 6) the damping, N m s/rad and
    N s/m. The wrench is (moment; force), N m and N. An error of 25 mm at 400 N/m gives
    10 N. Source: Modern Robotics, section 11.7.
    """
    # region 6.5
    return K @ e + D @ V_err  # wrench of the spring plus wrench of the damper
    # endregion 6.5


def set_point_for_force(force: float, k: float, surface: float) -> float:
    """Return the height to command so that a soft hand presses down with a force, m.

    force is the normal force on the surface, N; k is the stiffness of the hand along z,
    N/m, above 0; surface is the height of the surface, m. z points up. For 20 N at 400
    N/m on a surface at 0.42 m it is 0.37 m.
    """
    # region 6.5
    return surface - force / k  # height of the surface minus the spring's extension
    # endregion 6.5


def critical_damping(K: np.ndarray, Lambda: np.ndarray) -> np.ndarray:
    """Return the damping matrix D with which every mode is critically damped, (6, 6).

    K (6,) is the stiffness along each axis, N m/rad and N/m, at least 0; Lambda (6, 6)
    is the task-space inertia, symmetric and positive definite. D is symmetric: the sum
    of the two products, in both orders, of the matrix square root of Lambda and the
    root of the diagonal matrix of K. With every K = 4 and Lambda the identity it is
    4 I. Source: Albu-Schaeffer and others (2003).
    """
    # region 6.6
    values, vectors = np.linalg.eigh(Lambda)  # eigenvalues and eigenvectors of Lambda
    root_Lambda = vectors @ np.diag(np.sqrt(values)) @ vectors.T  # root of Lambda
    root_K = np.diag(np.sqrt(K))  # square root of the stiffness matrix
    return root_Lambda @ root_K + root_K @ root_Lambda  # sum of both orders
    # endregion 6.6


def impedance_torque(
    J_site: np.ndarray, wrench: np.ndarray, bias: np.ndarray, damping: np.ndarray,
    qd: np.ndarray, tau_null: np.ndarray,
) -> np.ndarray:  # fmt: skip
    """Return the joint torques of impedance control, (7,), N m.

    With these torques the hand exerts the wrench on its surroundings. J_site (6, 7) is
    the site Jacobian; wrench (6,) is (moment; force), N m and N; bias (7,) is the
    torque of gravity, Coriolis and centrifugal forces, N m; damping (7,) is the joints'
    damping, N m s/rad, which opposes the joint velocities qd (7,), rad/s, and is
    compensated; tau_null (7,) is a torque that does not accelerate the hand, N m. At
    rest, with wrench and tau_null 0, the result is bias. Source: Modern
    Robotics, sections 5.2 and 11.7.
    """
    # region 6.7
    return J_site.T @ wrench + bias + damping * qd + tau_null  # sum of four torques
    # endregion 6.7


def hybrid_wrench(
    e: np.ndarray, V_err: np.ndarray, K: np.ndarray, D: np.ndarray, force: float
) -> np.ndarray:
    """Return the wrench of hybrid control, (6,): a spring, but along z a chosen force.

    e (6,), V_err (6,), K (6, 6) and D (6, 6) are as in `impedance_wrench`; force is
    the normal force on a level surface, N, along -z. The first five rows are equal to
    `impedance_wrench`. The last row is -force plus the damper's part, without any term
    of K. With e and V_err 0 the result is (0, 0, 0, 0, 0, -force). Source: Modern
    Robotics, section 11.6.
    """
    # region 6.9
    wrench = impedance_wrench(e, V_err, K, D)  # wrench of the spring and the damper
    wrench[5] = D[5] @ V_err - force  # force along z: the damper's part minus the push
    return wrench
    # endregion 6.9


def soft_hand(arm, q_rest: np.ndarray, height=None, stiffness: np.ndarray = K):
    """Return the impedance controller of the hand, with a torque for the elbow."""
    T_goal = arm.at(q_rest).T_world_ee.copy()

    def law(t: float, q: np.ndarray, qd: np.ndarray) -> np.ndarray:
        now = arm.at(q)
        J = now.J_site
        Lambda = task_inertia(J, now.M)
        if height:
            T_goal[2, 3] = height(t)
        e = small_pose_error(now.T_world_ee, T_goal)
        D = critical_damping(stiffness, Lambda)
        wrench = impedance_wrench(e, -J @ qd, np.diag(stiffness), D)
        back = control.pd_torque(q_rest - q, -qd, *ELBOW)
        idle = nullspace_torque(J, now.M, Lambda, back)
        return impedance_torque(J, wrench, now.bias(qd), arm.damping, qd, idle)

    return law


def stiff_arm(arm, q_start: np.ndarray):
    """Return servo commands from 10 mm above the table's surface to 50 mm below it."""
    q_deep = day6_mujoco.above_table(scenes.press_table(), -0.05)
    return lambda t, q, qd: q_start + (q_deep - q_start) * min(t * SINK / 0.06, 1.0)


def circling(arm, project):
    """Return a controller that follows the circle, with a given torque projector."""
    T_start = arm.at(READY_Q).T_world_ee

    def law(t: float, q: np.ndarray, qd: np.ndarray) -> np.ndarray:
        now = arm.at(q)
        to = day6_mujoco.circle(t, T_start, RADIUS, TURN)
        J = now.J_site
        Lambda = task_inertia(J, now.M)
        drift = bias_acceleration(now.J_space, qd, now.T_world_ee[:3, 3])
        e = small_pose_error(now.T_world_ee, to.T)
        acc = to.A + 2 * OMEGA * (to.V - J @ qd) + OMEGA**2 * e
        torque = osc_torque(J, Lambda, now.bias(qd), drift, acc) + arm.damping * qd
        back = control.pd_torque(READY_Q - q, -qd, *ELBOW)
        return torque + project(J, now.M, Lambda, back)

    return law


def kinematic(J: np.ndarray, M, Lambda, tau: np.ndarray) -> np.ndarray:
    """Return tau - J^+ J tau: Day 3's projector, which is for joint velocities."""
    return jacobian.nullspace_projection(J, tau)


def pushed(model, q, qd, tau: np.ndarray, wrench: np.ndarray):
    """Return MuJoCo's data of the arm under torques, (7,), and a wrench at its hand."""
    data = simulate.start(model, q, qd)
    data.qfrc_applied[:] = tau
    push = simulate.push_at(day6_mujoco.SITE, wrench)
    push(model, data)  # mujoco.mj_applyFT adds J^T F to qfrc_applied
    mujoco.mj_forward(model, data)  # fills qacc, the joints' acceleration
    return data


def hand_acceleration(model, data) -> np.ndarray:
    """Return the acceleration of MuJoCo's hand, (6,): J qdd + bias acceleration."""
    J = verify.mujoco_site_jacobian(model, data.qpos)  # mujoco.mj_jacSite
    # Finite differences of mujoco.mj_jacSite.
    drift = verify.mujoco_bias_acceleration(model, data.qpos, data.qvel)
    return J @ data.qacc + drift


def mass_felt(model, at: list, inertia) -> np.ndarray:
    """Return |Lambda a - F| / |F| of MuJoCo's resting hand under a wrench F, (n,)."""
    off = []
    for s in at:
        data = pushed(model, s.now.q, 0.0, s.now.gravity_torque, s.wrench)
        felt = inertia(s.now.J_site, s.now.M) @ hand_acceleration(model, data)
        off.append(np.linalg.norm(felt - s.wrench) / np.linalg.norm(s.wrench))
    return np.array(off)


def off_drift(model, at: list) -> np.ndarray:
    """Return bias_acceleration minus the rate of MuJoCo's Jacobian times qd, (n, 6)."""
    off = []
    for s in at:
        # Finite differences of mujoco.mj_jacSite.
        truth = verify.mujoco_bias_acceleration(model, s.now.q, s.qd)
        p = s.now.T_world_ee[:3, 3]
        off.append(bias_acceleration(s.now.J_space, s.qd, p) - truth)
    return np.array(off)


def off_asked(model, arm, at: list) -> np.ndarray:
    """Return the acceleration of MuJoCo's hand minus the wanted one, (n, 6)."""
    off = []
    for s in at:
        J = s.now.J_site
        Lambda = task_inertia(J, s.now.M)
        drift = bias_acceleration(s.now.J_space, s.qd, s.now.T_world_ee[:3, 3])
        tau = osc_torque(J, Lambda, s.now.bias(s.qd), drift, s.acc)
        data = pushed(model, s.now.q, s.qd, tau + arm.damping * s.qd, np.zeros(6))
        off.append(hand_acceleration(model, data) - s.acc)
    return np.array(off)


def felt_of(model, at: list, project) -> np.ndarray:
    """Return the accelerations of MuJoCo's hand under projected torques, (n, 6)."""
    felt = []
    for s in at:
        J = s.now.J_site
        idle = project(J, s.now.M, task_inertia(J, s.now.M), s.torque)
        data = pushed(model, s.now.q, 0.0, s.now.gravity_torque + idle, np.zeros(6))
        felt.append(hand_acceleration(model, data))
    return np.array(felt)


def off_held(model, arm, at: list) -> np.ndarray:
    """Return MuJoCo's qdd when the opposite wrench acts on the hand, (n, 7).

    The torques include bias and damping, so qdd should be 0.
    """
    off = []
    for s in at:
        given = s.now.bias(s.qd), arm.damping, s.qd
        tau = impedance_torque(s.now.J_site, s.wrench, *given, s.torque) - s.torque
        off.append(pushed(model, s.now.q, s.qd, tau, -s.wrench).qacc)
    return np.array(off)


def off_library(name: str, own, at: list) -> np.ndarray:
    """Return the differences of a function that MuJoCo lacks and the library's."""
    columns = day6_mujoco.arguments(at)[name]
    truth = getattr(library, name)(*columns)
    return verify.each(own, *columns) - truth


def press(lab: Lab) -> None:
    """Press on the table with a soft hand and a chosen force, then with servos."""
    depth = set_point_for_force(PRESS, K[5], scenes.TOUCH)
    lab.show("height to command, m; the tip touches the table at 0.42", depth, 3)

    def soft_arm(arm, q: np.ndarray):
        sink = lambda t: max(depth, scenes.TOUCH + 0.01 - SINK * t)  # noqa: E731
        return soft_hand(arm, q, sink)

    # After every mujoco.mj_step: mujoco.mj_contactForce, of tip and table.
    soft = day6_mujoco.press(soft_arm, rate=RATE)
    # The model file's servos, commanded 50 mm into the table, control no force.
    stiff = day6_mujoco.press(stiff_arm, drive="servo", seconds=3.0)
    for name, felt in (("soft", soft), ("stiff", stiff)):
        print(f"  {name:5} arm: {felt[-1]:6.1f} N at the end, peak {felt.max():.1f} N")
    lab.measured("force of the soft arm, told to go 50 mm into a table, N", soft[-1])
    lab.measured("force of the stiff arm, the model file's servos, N", stiff[-1])
    lab.record(
        "press_predicted", soft[-1] / PRESS - 1, label="soft arm, |force / 20 N - 1|"
    )


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    model = panda.load("panda_nohand", drive="torque")  # motors: ctrl is a torque
    arm = panda.arm(model)
    print(panda.describe("panda_nohand"))
    at = day6_mujoco.states(model, TRIALS, SEED, SIGMA)

    lab.step("1. The task-space inertia of the hand, measured by pushing it")
    Lambda = task_inertia(arm.at(READY_Q).J_site, arm.at(READY_Q).M)
    masses = Lambda[3:, 3:]
    lab.show("lower right block of Lambda in the ready configuration, kg", masses, 3)
    free = 1 / np.diag(np.linalg.inv(Lambda))[3:]
    lab.show("apparent mass of an unconstrained hand along x, y, z, kg", free, 3)
    # Newton's law at the hand: MuJoCo applies the wrench and does not use Lambda.
    lab.record("task_inertia", mass_felt(model, at, task_inertia),
               label="|Lambda a - F| / |F|, worst wrench",
               config="random", seed=SEED)  # fmt: skip
    off = mass_felt(model, at, library.task_inertia)
    lab.check("the same with the library's task_inertia", off)

    lab.step("2. Operational-space control: torques for a wanted acceleration")
    lab.check("bias_acceleration - MuJoCo's rate of J times qd", off_drift(model, at))
    off = off_asked(model, arm, at)
    lab.check("acceleration of MuJoCo's hand - wanted acceleration", off)

    lab.step("3. Null-space torques, which do not accelerate the hand")
    off = felt_of(model, at, nullspace_torque)
    lab.check("acceleration of the hand under nullspace_torque", off)
    off = off_library("nullspace_torque", nullspace_torque, at)
    lab.check("nullspace_torque - the library's", off)
    odd = np.abs(felt_of(model, at, kinematic)).max(axis=1)
    print("  With Day 3's projector instead, the hand accelerates by "
          f"{np.median(odd):.1f} rad/s2 or m/s2.")  # fmt: skip

    lab.step("4. Impedance control: the hand is a spring")
    off = off_library("impedance_wrench", impedance_wrench, at)
    lab.check("impedance_wrench - the library's", off)
    off = off_library("critical_damping", critical_damping, at)
    lab.check("critical_damping - the library's", off)
    off = off_held(model, arm, at)
    lab.check("joint accelerations under the opposite wrench", off)
    lab.show("displacement for 10 N and 1 N m, predicted, rad and m", PUSH / K)
    moved = day6_mujoco.rest_after(model, soft_hand(arm, READY_Q), PUSH, RATE)
    lab.show("displacement of the hand at rest, measured", moved)
    lab.measured("way of a hand on 400 N/m, pushed with 10 N, mm", 1e3 * moved[3])
    lab.record("push_predicted", moved - PUSH / K, label="|measured - predicted|")

    lab.step("5. A chosen force on a table")
    off = off_library("set_point_for_force", set_point_for_force, at)
    lab.check("set_point_for_force - the library's", off)
    press(lab)

    lab.step("6. A vertical circle of 0.12 m radius in two seconds")
    for name, project in (("Day 3's", kinematic), ("today's", nullspace_torque)):
        off = 1e3 * day6_mujoco.off_circle(model, circling(arm, project), RADIUS, TURN)
        print(f"  largest error with {name} projector: {off.max():.3f} mm")
    lab.record("osc_circle", off, label="largest error with today's projector, mm")

    lab.step("7. Side quest: hybrid control, a chosen force along z")
    with lab.side_quest():
        off = off_library("hybrid_wrench", hybrid_wrench, at)
        lab.check("hybrid_wrench - the library's", off)
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
