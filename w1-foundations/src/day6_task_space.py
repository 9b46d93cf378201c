"""Day 6: the hand. What it weighs, how soft it is, how hard it presses; all predicted.

    make day6                          in the clone: sets everything up, then runs this
    python src/day6_task_space.py      in w1-foundations/, once that is done

J_site qd = (omega; velocity of the hand's site), in world axes; J_space is Day 4's. A
wrench is (moment; force). M is with armature. Metres, radians, newtons, kilograms.
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
TRIALS = 50  # random states that your own code is judged on
SEED = 47
SIGMA = 0.05  # least singular value of J: at 0, a singularity, Lambda is infinite
# N m/rad and N/m. With 40 N/m the 10 N below are 250 mm, with 4,000 they are 2.5.
K = np.array([30.0, 30.0, 30.0, 400.0, 400.0, 400.0])
PUSH = np.array([0.0, 0.0, 1.0, 10.0, 0.0, 0.0])  # N m about z, N along x
PRESS, SINK = 20.0, 0.1  # N, wanted on the table; m/s: the faster, the higher the peak
ELBOW = (10.0, 4.0)  # N m/rad and N m s/rad that hold the elbow back; 0 lets it drift
RATE = 100.0  # Hz, of what comes to rest; the circle is drawn at 250
OMEGA = 20.0  # rad/s, back to the circle: 10 nearly doubles the error, 40 halves it
RADIUS, TURN = 0.12, 2.0  # m; s for a turn


def task_inertia(J_site: np.ndarray, M: np.ndarray) -> np.ndarray:
    """Return Lambda, (6, 6): the mass and inertia that you feel at the hand.

    With J_site the identity and M = 2 I it is 2 I.
    """
    # region 6.1
    return np.linalg.inv(J_site @ np.linalg.solve(M, J_site.T))
    # endregion 6.1


def bias_acceleration(J_space: np.ndarray, qd: np.ndarray, p: np.ndarray) -> np.ndarray:
    """Return the acceleration, (6,), of the hand's site at p while qdd is 0.

    J_space has the screws about the world's origin; p, (3,), is in world axes. A point
    at (1, 0, 0) that spins about z at 1 rad/s has (0, 0, 0, -1, 0, 0).
    """
    # region 6.2
    parts = (J_space * qd).T  # what each joint adds to the twists after it
    V = np.cumsum(parts, axis=0)
    A = (screws.ad(V) @ parts[..., None])[..., 0].sum(axis=0)
    omega, alpha = V[-1, :3], A[:3]
    velocity = V[-1, 3:] + np.cross(omega, p)
    linear = A[3:] + np.cross(alpha, p) + np.cross(omega, velocity)
    return np.append(alpha, linear)
    # endregion 6.2


def osc_torque(
    J_site: np.ndarray, Lambda: np.ndarray, bias: np.ndarray, bias_acc: np.ndarray,
    acc: np.ndarray,
) -> np.ndarray:  # fmt: skip
    """Return the torques, (7,), with which the hand accelerates by acc, (6,).

    bias_acc is what bias_acceleration gives; where acc is the same, they are bias.
    """
    # region 6.3
    return J_site.T @ Lambda @ (acc - bias_acc) + bias
    # endregion 6.3


def nullspace_torque(
    J_site: np.ndarray, M: np.ndarray, Lambda: np.ndarray, tau: np.ndarray
) -> np.ndarray:
    """Return the part of tau, (7,), that does not accelerate the hand.

    What is subtracted from tau is a push at the hand. If J_site takes only the first
    six of seven joints, and M and Lambda are identities, seven ones become six 0 and
    one 1.
    """
    # region 6.4
    return tau - J_site.T @ Lambda @ J_site @ np.linalg.solve(M, tau)
    # endregion 6.4


def impedance_wrench(
    e: np.ndarray, V_err: np.ndarray, K: np.ndarray, D: np.ndarray
) -> np.ndarray:
    """Return the wrench, (6,), of a spring and a damper between hand and target.

    e and V_err, (6,), are the target's minus the hand's; K and D are (6, 6). 25 mm away
    from a spring of 400 N/m it is 10 N.
    """
    # region 6.5
    return K @ e + D @ V_err
    # endregion 6.5


def set_point_for_force(force: float, k: float, surface: float) -> float:
    """Return the height to command so that a hand of k N/m presses down with a force.

    For 20 N at 400 N/m on a surface at 0.42 m it is 0.37 m.
    """
    # region 6.5
    return surface - force / k
    # endregion 6.5


def critical_damping(K: np.ndarray, Lambda: np.ndarray) -> np.ndarray:
    """Return D, (6, 6), with which a spring K, (6,), does not ring.

    It is made of the matrix square roots of Lambda and of K's diagonal matrix. With
    every K = 4 and Lambda the identity it is 4 I.
    """
    # region 6.6
    values, vectors = np.linalg.eigh(Lambda)
    root_Lambda = vectors @ np.diag(np.sqrt(values)) @ vectors.T
    root_K = np.diag(np.sqrt(K))
    return root_Lambda @ root_K + root_K @ root_Lambda
    # endregion 6.6


def impedance_torque(
    J_site: np.ndarray, wrench: np.ndarray, bias: np.ndarray, damping: np.ndarray,
    qd: np.ndarray, tau_null: np.ndarray,
) -> np.ndarray:  # fmt: skip
    """Return the torques, (7,), with which the hand pushes with a wrench.

    At rest, with wrench and tau_null 0, they are bias. damping, (7,), is the joints'.
    """
    # region 6.7
    return J_site.T @ wrench + bias + damping * qd + tau_null
    # endregion 6.7


def hybrid_wrench(
    e: np.ndarray, V_err: np.ndarray, K: np.ndarray, D: np.ndarray, force: float
) -> np.ndarray:
    """Return a wrench, (6,): a spring, but along z a force that pushes down.

    The first four as in `impedance_wrench`; with e and V_err 0: (0, 0, 0, 0, 0,
    -force). The damper stays in all six rows; along z there is nothing of K.
    """
    # region 6.9
    wrench = impedance_wrench(e, V_err, K, D)
    wrench[5] = D[5] @ V_err - force
    return wrench
    # endregion 6.9


def soft_hand(arm, q_rest: np.ndarray, height=None, stiffness: np.ndarray = K):
    """Return a controller: the hand hangs on a spring, the elbow is held back."""
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
    """Return a controller for servos: 10 mm above the table's top to 50 below it."""
    q_deep = day6_mujoco.above_table(scenes.press_table(), -0.05)
    return lambda t, q, qd: q_start + (q_deep - q_start) * min(t * SINK / 0.06, 1.0)


def circling(arm, project):
    """Return a controller that draws the circle, with a way to project torques."""
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
    """Return tau through Day 3's projector, which is for speeds: tau - J^+ J tau."""
    return jacobian.nullspace_projection(J, tau)


def pushed(model, q, qd, tau: np.ndarray, wrench: np.ndarray):
    """Return MuJoCo's data of an arm under torques, (7,), and a push at its hand."""
    data = simulate.start(model, q, qd)
    data.qfrc_applied[:] = tau
    push = simulate.push_at(day6_mujoco.SITE, wrench)
    push(model, data)  # mujoco.mj_applyFT adds J^T F to qfrc_applied
    mujoco.mj_forward(model, data)  # fills qacc, the joints' acceleration
    return data


def hand_acceleration(model, data) -> np.ndarray:
    """Return how MuJoCo's hand accelerates, (6,): J qdd, and the rate of J times qd."""
    J = verify.mujoco_site_jacobian(model, data.qpos)  # mujoco.mj_jacSite
    drift = verify.mujoco_bias_acceleration(
        model, data.qpos, data.qvel
    )  # differences of it
    return J @ data.qacc + drift


def mass_felt(model, at: list, inertia) -> np.ndarray:
    """Return |Lambda a - F| / |F| of MuJoCo's resting hand, pushed by F, (n,)."""
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
        truth = verify.mujoco_bias_acceleration(
            model, s.now.q, s.qd
        )  # of mujoco.mj_jacSite
        off.append(
            bias_acceleration(s.now.J_space, s.qd, s.now.T_world_ee[:3, 3]) - truth
        )
    return np.array(off)


def off_asked(model, arm, at: list) -> np.ndarray:
    """Return how MuJoCo's hand accelerates minus what osc_torque was asked, (n, 6)."""
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
    """Return how MuJoCo's resting hand accelerates under projected torques, (n, 6)."""
    felt = []
    for s in at:
        J = s.now.J_site
        idle = project(J, s.now.M, task_inertia(J, s.now.M), s.torque)
        data = pushed(model, s.now.q, 0.0, s.now.gravity_torque + idle, np.zeros(6))
        felt.append(hand_acceleration(model, data))
    return np.array(felt)


def off_held(model, arm, at: list) -> np.ndarray:
    """Return the joints' qdd in MuJoCo when a hand is pushed back as it pushes, (n, 7).

    The arm's own motion is held by bias and damping, so nothing is left.
    """
    off = []
    for s in at:
        given = s.now.bias(s.qd), arm.damping, s.qd
        tau = impedance_torque(s.now.J_site, s.wrench, *given, s.torque) - s.torque
        off.append(pushed(model, s.now.q, s.qd, tau, -s.wrench).qacc)
    return np.array(off)


def off_library(name: str, own, at: list) -> np.ndarray:
    """Return how far a function is from robo47.task_space: MuJoCo has none of them."""
    columns = day6_mujoco.arguments(at)[name]
    truth = getattr(library, name)(*columns)
    return verify.each(own, *columns) - truth


def press(lab: Lab) -> None:
    """Press on the table softly, with the force that was chosen; then stiffly."""
    depth = set_point_for_force(PRESS, K[5], scenes.TOUCH)
    lab.show("height to command, m; the tip touches at 0.42", depth, 3)

    def soft_arm(arm, q: np.ndarray):
        sink = lambda t: max(depth, scenes.TOUCH + 0.01 - SINK * t)  # noqa: E731
        return soft_hand(arm, q, sink)

    # After every mujoco.mj_step: mujoco.mj_contactForce, of tip and table.
    soft = day6_mujoco.press(soft_arm, rate=RATE)
    # The file's own servos, told to go 50 mm into the table, know of no force.
    stiff = day6_mujoco.press(stiff_arm, drive="servo", seconds=3.0)
    for name, felt in (("soft", soft), ("stiff", stiff)):
        print(f"  {name:5} arm: {felt[-1]:6.1f} N in the end; peak {felt.max():.1f} N")
    lab.measured("force of the soft arm, told to go 50 mm into a table, N", soft[-1])
    lab.measured("force of the stiff arm, the model file's servos, N", stiff[-1])
    lab.record("press_predicted", soft[-1] / PRESS - 1, label="soft arm, part of 20 N")


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    model = panda.load("panda_nohand", drive="torque")  # motors: ctrl is a torque
    arm = panda.arm(model)
    print(panda.describe("panda_nohand"))
    at = day6_mujoco.states(model, TRIALS, SEED, SIGMA)

    lab.step("1. What the hand weighs: push it, and see how it accelerates")
    Lambda = task_inertia(arm.at(READY_Q).J_site, arm.at(READY_Q).M)
    lab.show("Lambda's lower right at ready, in kg", Lambda[3:, 3:], 3)
    free = 1 / np.diag(np.linalg.inv(Lambda))[3:]
    lab.show("and the apparent mass of an unconstrained hand, along x, y, z", free, 3)
    # Newton's law at the hand; MuJoCo pushes, and knows nothing of Lambda.
    lab.record("task_inertia", mass_felt(model, at, task_inertia),
               label="|Lambda a - F| / |F|, worst push",
               config="random", seed=SEED)  # fmt: skip
    off = mass_felt(model, at, library.task_inertia)
    lab.check("the library robo47.task_space, the same push", off)

    lab.step("2. Torques for a wanted acceleration of the hand")
    lab.check("bias_acceleration - MuJoCo's rate of J times qd", off_drift(model, at))
    off = off_asked(model, arm, at)
    lab.check("MuJoCo's hand accelerates as osc_torque asks", off)

    lab.step("3. What is left for the elbow")
    off = felt_of(model, at, nullspace_torque)
    lab.check("the hand's acceleration under nullspace_torque", off)
    off = off_library("nullspace_torque", nullspace_torque, at)
    lab.check("nullspace_torque - the library's", off)
    odd = np.abs(felt_of(model, at, kinematic)).max(axis=1)
    print("  Day 3's projector in its place: "
          f"the hand feels {np.median(odd):.1f} rad/s2 or m/s2.")  # fmt: skip

    lab.step("4. A hand that is a spring")
    off = off_library("impedance_wrench", impedance_wrench, at)
    lab.check("impedance_wrench - the library's", off)
    off = off_library("critical_damping", critical_damping, at)
    lab.check("critical_damping - the library's", off)
    off = off_held(model, arm, at)
    lab.check("impedance_torque against MuJoCo's push", off)
    lab.show("pushed with 10 N and 1 N m; predicted, rad and m", PUSH / K)
    moved = day6_mujoco.rest_after(model, soft_hand(arm, READY_Q), PUSH, RATE)
    lab.show("where the hand came to rest", moved)
    lab.measured("way of a hand on 400 N/m, pushed with 10 N, mm", 1e3 * moved[3])
    lab.record("push_predicted", moved - PUSH / K, label="largest difference")

    lab.step("5. Pressing on a table, with a force that was chosen")
    off = off_library("set_point_for_force", set_point_for_force, at)
    lab.check("set_point_for_force - the library's", off)
    press(lab)

    lab.step("6. An upright circle, 0.12 m in radius, in two seconds")
    for name, project in (("Day 3's", kinematic), ("today's", nullspace_torque)):
        off = 1e3 * day6_mujoco.off_circle(model, circling(arm, project), RADIUS, TURN)
        print(f"  with {name} projector it is at most {off.max():.3f} mm off")
    lab.record("osc_circle", off, label="today's, mm")

    lab.step("7. Side quest: a spring sideways, a force downwards")
    with lab.side_quest():
        off = off_library("hybrid_wrench", hybrid_wrench, at)
        lab.check("hybrid_wrench - the library's", off)
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
