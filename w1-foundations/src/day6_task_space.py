"""Day 6: the hand. What it weighs, how soft it is, how hard it presses; all predicted.

    make day6                          in the clone: sets everything up, then runs this
    python src/day6_task_space.py      in w1-foundations/, once that is done

J_site qd = (omega; velocity of the hand's site), in world axes; J_space is Day 4's. A
wrench is (moment; force). M is with armature. Metres, radians, newtons, kilograms.
"""

import kit  # noqa: F401 (goes on in the kit's own Python)
import numpy as np

from robo47 import cli, contact, control, panda, scenes, screws
from robo47 import task_space as library
from robo47.lesson.lab import Lab
from robo47.verify import hand

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


def site_bias(J_space: np.ndarray, qd: np.ndarray, p: np.ndarray) -> np.ndarray:
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
    J_site: np.ndarray, Lambda: np.ndarray, bias: np.ndarray, drift: np.ndarray,
    acc: np.ndarray,
) -> np.ndarray:  # fmt: skip
    """Return the torques, (7,), with which the hand accelerates by acc, (6,).

    drift is what site_bias gives; where acc is the same, they are bias.
    """
    # region 6.3
    return J_site.T @ Lambda @ (acc - drift) + bias
    # endregion 6.3


def null_torque(
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


def spring_wrench(
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

    The first four as in `spring_wrench`; with e and V_err 0: (0, 0, 0, 0, 0, -force).
    The damper stays in all six rows; along z there is nothing of K.
    """
    # region 6.9
    wrench = spring_wrench(e, V_err, K, D)
    wrench[5] = D[5] @ V_err - force
    return wrench
    # endregion 6.9


def soft_hand(arm, q_rest: np.ndarray, height=None, stiffness: np.ndarray = K):
    """Return a controller: the hand hangs on a spring, the elbow is held back."""
    T_goal = arm.at(q_rest).T_world_ee.copy()

    def law(t: float, q: np.ndarray, qd: np.ndarray) -> np.ndarray:
        now = arm.at(q)
        J, Lambda = now.J_site, task_inertia(now.J_site, now.M)
        if height:
            T_goal[2, 3] = height(t)
        e = contact.small_pose_error(now.T_world_ee, T_goal)
        D = critical_damping(stiffness, Lambda)
        wrench = spring_wrench(e, -J @ qd, np.diag(stiffness), D)
        back = control.pd_torque(q_rest - q, -qd, *ELBOW)
        idle = null_torque(J, now.M, Lambda, back)
        return impedance_torque(J, wrench, now.bias(qd), arm.damping, qd, idle)

    return law


def stiff_arm(arm, q_start: np.ndarray):
    """Return a controller for servos: 10 mm above the table's top to 50 below it."""
    q_deep = contact.above_table(scenes.press_table(), -0.05)
    return lambda t, q, qd: q_start + (q_deep - q_start) * min(t * SINK / 0.06, 1.0)


def press(lab: Lab, at: list[hand.State]) -> None:
    """Press on the table softly, with the force that was chosen; then stiffly."""
    hand.compare(lab.check, at, set_point_for_force=set_point_for_force)
    depth = set_point_for_force(PRESS, K[5], scenes.TOUCH)
    lab.show("height to command, m; the tip touches at 0.42", depth, 3)
    height = lambda t: max(depth, scenes.TOUCH + 0.01 - SINK * t)  # noqa: E731
    soft = contact.press(lambda arm, q: soft_hand(arm, q, height), rate=RATE)
    # The file's own servos, told to go 50 mm into the table, know of no force.
    stiff = contact.press(stiff_arm, drive="servo", seconds=3.0)
    for name, felt in (("soft", soft), ("stiff", stiff)):
        print(f"  {name:5} arm: {felt[-1]:6.1f} N in the end; peak {felt.max():.1f} N")
    lab.measured("force of the soft arm, told to go 50 mm into a table, N", soft[-1])
    lab.measured("force of the stiff arm, the model file's servos, N", stiff[-1])
    lab.record("press_predicted", soft[-1] / PRESS - 1, label="soft arm, part of 20 N")


def circling(arm, project):
    """Return a controller that draws the circle, with a way to project torques."""
    T_start = arm.at(READY_Q).T_world_ee

    def law(t: float, q: np.ndarray, qd: np.ndarray) -> np.ndarray:
        now, (T, V, A) = arm.at(q), contact.circle(t, T_start, RADIUS, TURN)
        J, Lambda = now.J_site, task_inertia(now.J_site, now.M)
        drift = site_bias(now.J_space, qd, now.T_world_ee[:3, 3])
        e = contact.small_pose_error(now.T_world_ee, T)
        acc = A + 2 * OMEGA * (V - J @ qd) + OMEGA**2 * e
        torque = osc_torque(J, Lambda, now.bias(qd), drift, acc) + arm.damping * qd
        back = control.pd_torque(READY_Q - q, -qd, *ELBOW)
        return torque + project(J, now.M, Lambda, back)

    return law


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    model = panda.load("panda_nohand", drive="torque")  # motors: ctrl is a torque
    arm = panda.arm(model)
    print(panda.describe("panda_nohand"))
    at = hand.states(model, TRIALS, SEED, SIGMA)

    lab.step("1. What the hand weighs: push it, and see how it accelerates")
    Lambda = task_inertia(arm.at(READY_Q).J_site, arm.at(READY_Q).M)
    lab.show("Lambda's lower right at ready, in kg", Lambda[3:, 3:], 3)
    free = 1 / np.diag(np.linalg.inv(Lambda))[3:]
    lab.show("and of a hand that nobody holds: what it weighs along x, y, z", free, 3)
    # Newton's law at the hand; MuJoCo pushes, and knows nothing of Lambda.
    off = np.linalg.norm(hand.mass_felt(model, at, task_inertia), axis=1)
    lab.record("task_inertia", off, label="|Lambda a - F| / |F|, worst push",
               config="random", seed=SEED)  # fmt: skip
    off = hand.mass_felt(model, at, library.task_inertia)
    lab.check("the library robo47.task_space, the same push", off)

    lab.step("2. Torques for a wanted acceleration of the hand")
    off = hand.drift(model, at, site_bias)
    lab.check("site_bias - MuJoCo's rate of J times qd", off)
    off = hand.asked_for(model, at, task_inertia, site_bias, osc_torque)
    lab.check("MuJoCo's hand accelerates as osc_torque asks", off)

    lab.step("3. What is left for the elbow")
    off = hand.unfelt(model, at, task_inertia, null_torque)
    lab.check("the hand's acceleration under null_torque", off)
    hand.compare(lab.check, at, null_torque=null_torque)
    odd = np.abs(hand.unfelt(model, at, task_inertia, hand.kinematic)).max(axis=1)
    print("  Day 3's projector in its place: "
          f"the hand feels {np.median(odd):.1f} rad/s2 or m/s2.")  # fmt: skip

    lab.step("4. A hand that is a spring")
    hand.compare(lab.check, at, spring_wrench=spring_wrench,
                 critical_damping=critical_damping)  # fmt: skip
    off = hand.held(model, at, impedance_torque)
    lab.check("impedance_torque against MuJoCo's push", off)
    lab.show("pushed with 10 N and 1 N m; predicted, rad and m", PUSH / K)
    moved = hand.rest_after(model, soft_hand(arm, READY_Q), PUSH, RATE)
    lab.show("where the hand came to rest", moved)
    lab.measured("way of a hand on 400 N/m, pushed with 10 N, mm", 1e3 * moved[3])
    lab.record("push_predicted", moved - PUSH / K, label="largest difference")

    lab.step("5. Pressing on a table, with a force that was chosen")
    press(lab, at)

    lab.step("6. An upright circle, 0.12 m in radius, in two seconds")
    for name, project in (("Day 3's", hand.kinematic), ("today's", null_torque)):
        off = 1e3 * hand.off_circle(model, circling(arm, project), RADIUS, TURN)
        print(f"  with {name} projector it is at most {off.max():.3f} mm off")
    lab.record("osc_circle", off, label="today's, mm")

    lab.step("7. Side quest: a spring sideways, a force downwards")
    with lab.side_quest():
        hand.compare(lab.check, at, hybrid_wrench=hybrid_wrench)
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
