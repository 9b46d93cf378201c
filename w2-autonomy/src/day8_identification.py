"""Day 8: what the model does not know. A robot is weighed by its own motors.

    make day8                            in the clone: sets all up, then runs this
    python src/day8_identification.py    in w2-autonomy/, once that is done

phi of a body is (m, m c, Ixx, Iyy, Izz, Ixy, Ixz, Iyz), the inertia about its own
origin. Twists (omega; v), wrenches (moment; force). Metres, radians, kilograms, N m.
"""

import kit  # noqa: F401 (goes on in the kit's own Python)
import mujoco
import numpy as np

from robo47 import cli, panda, se3
from robo47 import identification as library
from robo47.lesson.lab import Lab
from robo47.screws import ad, adjoint, skew

import day8_mujoco

ROBOT_SEED = 47  # of the robot that nobody knows: another one is another robot
NOISE_SEED = 47  # of the noise alone
NOISE = 0.1  # N m, of each measured torque; 0 is no sensor of this world
TRIALS = 100  # random states, elsewhere, that a fit is judged on
HARD = 5.0  # rad/s^2, at which dry friction is looked at
SLOW = 0.1  # rad/s: below it dry friction need not have the sign of the speed
RTOL = 1e-9  # of the largest singular value: smaller ones count as nothing
CUT = 1e-3  # the same, where a motion shows little
LOAD = 0.5  # kg that the arm is to find, and ...
AT = np.array([0.02, -0.03, 0.06])  # ... m, where its centre is in the hand's axes
WAIT = 2.0  # s until a hold counts as at rest; 8 make another number of step 5
# rad, (5, 7): where the arm is held
POSES = panda.READY_Q + np.random.default_rng(47).uniform(-0.5, 0.5, (5, 7))
# Your own motion, of two harmonics: how often a second each swings, how far each of
# the seven joints swings with it (rad), and where in its swing it begins (rad).
OFTEN = (0.2, 0.5)
FAR = np.array([[0.3] * 7, [0.0] * 7])
BEGIN = np.array([[0.0] * 7, [0.0] * 7])


def rms(x: np.ndarray) -> float:
    """Return the root of the mean square."""
    return np.sqrt(np.mean(np.square(x)))


def spatial_inertia_from_params(phi: np.ndarray) -> np.ndarray:
    """Return the 6x6 inertia of a body, (6, 6), from its ten numbers phi, (10,).

    (2, 0, 0, 2, 2, 2, 0, 0, 0, 0) is Day 4's 2 kg at (0, 0, 1), (2, 2, 0, 2, 2, 2).
    """
    # region 8.1
    m, x, y, z, xx, yy, zz, xy, xz, yz = phi  # x, y, z: m c
    return np.array([
        [xx, xy, xz, 0, -z, y],
        [xy, yy, yz, z, 0, -x],
        [xz, yz, zz, -y, x, 0],
        [0, z, -y, m, 0, 0],
        [-z, 0, x, 0, m, 0],
        [y, -x, 0, 0, 0, m],
    ])  # fmt: skip
    # endregion 8.1


def link_regressor(V: np.ndarray, Vd: np.ndarray) -> np.ndarray:
    """Return what each of the ten numbers costs in wrench, (6, 10).

    V and Vd, (6,), are the body's twist and acceleration, in its axes. At rest with Vd
    = (0, 0, 0, 0, 0, 9.81) the column of m is Vd, that of m cx (0, -9.81, 0, 0, 0, 0).
    """
    # region 8.2
    G = np.array([spatial_inertia_from_params(unit) for unit in np.eye(10)])
    return (G @ Vd - G @ V @ ad(V)).T  # each row of G V times ad(V): ad(V)^T G V
    # endregion 8.2


def arm_regressor(
    J_space: np.ndarray, T_links: np.ndarray, qd: np.ndarray, qdd: np.ndarray,
    g: np.ndarray,
) -> np.ndarray:  # fmt: skip
    """Return Y, (7, 70), with which the torque of all links is Y phi.

    J_space is (6, 7), T_links (7, 4, 4). One hinge about +y with qdd 1, each T the
    identity: for every link its row is (0, -9.81, 0, 0, 0, 1, 0, 0, 0, 0).
    """
    # region 8.3
    V = np.zeros(6)
    A = np.append(np.zeros(3), -g)  # the base, as if it accelerated upwards
    Y = np.zeros((7, 70))
    for i, (S, T) in enumerate(zip(J_space.T, T_links, strict=True)):
        V = V + S * qd[i]
        A = A + S * qdd[i] + ad(V) @ S * qd[i]
        X = adjoint(se3.inverse(T))
        costs = X.T @ link_regressor(X @ V, X @ A)  # of link i, at the world's origin
        Y[: i + 1, 10 * i : 10 * i + 10] = J_space[:, : i + 1].T @ costs
    return Y
    # endregion 8.3


def actuator_regressor(qd: np.ndarray, qdd: np.ndarray) -> np.ndarray:
    """Return the columns of rotors, viscous and dry friction, (7, 21).

    With joint 1 at 0.5 rad/s and 2 rad/s2 row 0 has 2, 0.5, 1 at columns 0, 7, 14.
    """
    # region 8.4
    return np.hstack([np.diag(qdd), np.diag(qd), np.diag(np.sign(qd))])
    # endregion 8.4


def rank_and_condition(Y: np.ndarray, rtol: float) -> tuple[int, float]:
    """Return (rank, condition): how much Y, (n, p), shows, and how unevenly.

    A singular value counts above rtol times the largest. Of [[1, 1], [2, 2]]: (1, 1.0).
    """
    # region 8.5
    s = np.linalg.svd(Y, compute_uv=False)
    kept = s[s > rtol * s[0]]
    return len(kept), kept[0] / kept[-1]
    # endregion 8.5


def truncated_svd_fit(Y: np.ndarray, tau: np.ndarray, rtol: float) -> np.ndarray:
    """Return the smallest parameters, (p,), that explain the torques tau, (n,), best.

    For [[1, 1], [2, 2]] and (2, 4): (1, 1). rtol is that of `rank_and_condition`.
    """
    # region 8.6
    U, s, Vt = np.linalg.svd(Y, full_matrices=False)
    kept = s > rtol * s[0]
    return Vt[kept].T @ (U[:, kept].T @ tau / s[kept])
    # endregion 8.6


def predict_with_sigma(
    Y: np.ndarray, tau: np.ndarray, Y_new: np.ndarray, rtol: float
) -> tuple[np.ndarray, np.ndarray]:
    """Return the torques of new motions, Y_new (m, p), and their sigma, (m,) each.

    Of what is fitted to Y (n, p) and tau. Four ones, measured 1, 3, 1 and 3: a new 1
    gives 2 with a sigma of 0.57735.
    """
    # region 8.7
    _, s, Vt = np.linalg.svd(Y, full_matrices=False)
    kept = s > rtol * s[0]
    phi = truncated_svd_fit(Y, tau, rtol)
    noise = np.linalg.norm(tau - Y @ phi) / np.sqrt(len(tau) - kept.sum())
    return Y_new @ phi, noise * np.linalg.norm(Y_new @ Vt[kept].T / s[kept], axis=1)
    # endregion 8.7


def identify_payload(
    J_site: np.ndarray, R_site: np.ndarray, extra: np.ndarray, g: np.ndarray
) -> np.ndarray:
    """Return m and m c, (4,), of what hangs on the hand; c is in the hand's axes.

    J_site is (k, 6, 7), R_site (k, 3, 3); extra (k, 7) is how much more torque the k
    poses take with it. A slide along z that takes 9.81 N more each time: (1, 0, 0, 0).
    """
    # region 8.8
    weight = np.zeros((len(R_site), 6, 4))  # (moment; force) of m and of m c
    weight[:, 3:, 0] = g
    weight[:, :3, 1:] = -skew(g) @ R_site
    rows = -np.swapaxes(J_site, 1, 2) @ weight
    return np.linalg.lstsq(rows.reshape(-1, 4), extra.ravel(), rcond=None)[0]
    # endregion 8.8


def min_pseudo_inertia_eig(phi: np.ndarray) -> float:
    """Return the least eigenvalue of [[tr(I)/2 1 - I, h], [h^T, m]], with h = m c.

    Of a body it is never below 0. (1, 0, 0, 0, 1, 1, 3, 0, 0, 0) has -0.5.
    """
    # region 8.9
    about = spatial_inertia_from_params(phi)[:3, :3]
    h = phi[1:4, None]
    spread = np.trace(about) / 2 * np.eye(3) - about
    return np.linalg.eigvalsh(np.block([[spread, h], [h.T, phi[0]]]))[0]
    # endregion 8.9


def pendulum(reach: float, second: float) -> np.ndarray:
    """Return Y, (200, 5), of one hinge: q'', cos q, sin q, q', sign q'.

    It swings by sin t, reach (rad) to either side; second is how much of sin 2.37 t
    is added to that.
    """
    t = np.arange(200) * 0.05
    q = reach * (np.sin(t) + second * np.sin(2.37 * t))
    qd = reach * (np.cos(t) + second * 2.37 * np.cos(2.37 * t))
    qdd = -reach * (np.sin(t) + second * 2.37**2 * np.sin(2.37 * t))
    return np.transpose([qdd, np.cos(q), np.sin(q), qd, np.sign(qd)])


def regressor(arm, motion: day8_mujoco.Motion) -> np.ndarray:
    """Return Y, (n, 7, 91): 70 columns of the links and 21 of the motors, per state."""
    rows = []
    for q, qd, qdd in zip(motion.q, motion.qd, motion.qdd, strict=True):
        now = arm.at(q)
        links = arm_regressor(now.J_space, now.T_links, qd, qdd, arm.gravity)
        motors = actuator_regressor(qd, qdd)
        rows.append(np.hstack([links, motors]))
    return np.array(rows)


def mujoco_torques(model, motion: day8_mujoco.Motion) -> np.ndarray:
    """Return what MuJoCo says that a motion takes, N m, (n, 7)."""
    data = mujoco.MjData(model)
    torques = []
    for q, qd, qdd in zip(motion.q, motion.qd, motion.qdd, strict=True):
        data.qpos[:] = q
        data.qvel[:] = qd
        data.qacc[:] = qdd
        mujoco.mj_inverse(model, data)  # fills qfrc_inverse
        torques.append(data.qfrc_inverse.copy())
    return np.array(torques)


def off_library() -> dict[str, np.ndarray]:
    """Return how far your fits are from robo47's, by function: MuJoCo knows no fits."""
    rng = np.random.default_rng(ROBOT_SEED)
    shows = [1e3, 300, 100, 40, 0.1, 0.1]  # a cut of 4e-3 leaves two of six out,
    wide = [1e3, 900, 800, 700, 6.5, 6.5]  # and here none: the sum would, the norm too
    speeds = np.array([-0.4, 0.0, 3e-4, 0.02, 0.5])
    tau = rng.normal(size=40)
    Y, Y_wide = rng.normal(size=(2, 40, 6)) * [[shows], [wide]]
    Y_new = rng.normal(size=(8, 6))
    J_site = rng.normal(size=(5, 6, 7))
    R_site = np.linalg.qr(rng.normal(size=(5, 3, 3)))[0]
    extra = rng.normal(size=(5, 7))
    alike = R_site[0] @ se3.Rx(0.002 * np.arange(5))  # holds that hardly differ
    g = np.array([1.0, -2.0, -9.0])  # an arm may hang on a wall
    given = {
        "actuator_regressor": [(speeds, rng.normal(size=5))],
        "rank_and_condition": [(Y, 4e-3), (Y_wide, 4e-3), (Y[:, :4] / 1e3, 1e-9)],
        "truncated_svd_fit": [(Y, tau, 4e-3), (Y_wide, tau, 4e-3)],
        "predict_with_sigma": [(Y, tau, Y_new, 4e-3), (Y_wide, tau, Y_new, 4e-3)],
        "identify_payload": [(J_site, R, extra, g) for R in (R_site, alike)],
    }
    own = {"actuator_regressor": actuator_regressor,
           "rank_and_condition": rank_and_condition,
           "truncated_svd_fit": truncated_svd_fit,
           "predict_with_sigma": predict_with_sigma,
           "identify_payload": identify_payload}  # fmt: skip

    def off(name: str) -> np.ndarray:
        parts = []
        for one in given[name]:
            truth = np.asarray(getattr(library, name)(*one))
            size = max(1.0, np.abs(truth).max())  # a condition has a thousand's digits
            parts.append(np.ravel(own[name](*one) - truth) / size)
        return np.concatenate(parts)

    return {name: off(name) for name in own}


def lengths(per_metre: float) -> np.ndarray:
    """Return by what each of the 91 numbers is larger in a smaller unit of length."""
    body = [1.0] + [per_metre] * 3 + [per_metre**2] * 6  # kg, kg m, kg m^2
    return np.append(np.tile(body, 7), np.ones(21))


def judged(name: str, Y, tau, Y_new, truth, rtol: float) -> tuple[float, float]:
    """Fit, print how good it looks and how good it is; return RMS and share inside."""
    rank, condition = rank_and_condition(Y, rtol)
    condition = float(f"{condition:.3g}")
    phi = truncated_svd_fit(Y, tau, rtol)
    with np.errstate(divide="ignore"):  # as many rows as numbers: sigma is inf
        torque, sigma = predict_with_sigma(Y, tau, Y_new, rtol)
    off = rms(torque - truth)
    # Without noise both are rounding, of which no sigma tells.
    inside = np.mean(np.abs(torque - truth) < 1.96 * sigma + 1e-9)
    digits = 2 if condition < 1e6 else -3  # above, rounding reaches the last ones
    print(f"  {name:22}{rank:3}{condition:13,.0f}{rms(tau - Y @ phi):9.4f}"
          f"{round(off, digits):10,.{max(digits, 0)}f}"
          f"{round(rms(sigma), digits):10,.{max(digits, 0)}f}{inside:6.0%}"
          )  # fmt: skip
    return off, inside


def weighed(arm, q, extra) -> tuple[np.ndarray, np.ndarray]:
    """Return (m, m c), (4,), from holds at q, (k, 7), and the sigma of each, (4,)."""
    J_site, R_site = day8_mujoco.hands(arm, q)
    load = identify_payload(J_site, R_site, extra, arm.gravity)
    rows = library.load_regressor(J_site, R_site, arm.gravity).reshape(-1, 4)
    _, sigma = predict_with_sigma(rows, extra.ravel(), np.eye(4), RTOL)
    return load, sigma


def weighings(robot, loaded, arm, rng) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Return load and sigma by how the arm was held, with the load and without."""
    _, empty = day8_mujoco.holds(robot, arm, POSES, WAIT)
    q, full = day8_mujoco.holds(loaded, arm, POSES, WAIT)
    empty = empty + NOISE * rng.normal(size=empty.shape)
    full = full + NOISE * rng.normal(size=full.shape)
    one_side = full[0] - empty[0]
    either_side = full[1] - empty[0]
    averaged = (full - empty).mean(axis=0)
    return {
        "both from one side": weighed(arm, q[0], one_side),
        "one from either side": weighed(arm, q[1], either_side),
        "each from both sides": weighed(arm, q.mean(axis=0), averaged),
    }


def weigh_the_load(lab: Lab, robot, arm, phi: np.ndarray, rng) -> None:
    """Hold the arm with a load and without; float with what was found."""
    hung = panda.load("panda_nohand", drive="torque", edit=day8_mujoco.load(LOAD, AT))
    loaded = day8_mujoco.changed(hung, ROBOT_SEED)
    rest = np.zeros(7)

    def still(now):
        links = arm_regressor(now.J_space, now.T_links, rest, rest, arm.gravity)
        return links @ phi[:70]

    nothing = np.zeros(4)
    truth = LOAD * np.append(1.0, AT)
    found = weighings(robot, loaded, arm, rng)
    told = {"nothing": (nothing, nothing), **found, "the truth": (truth, nothing)}
    print("  told to the arm         grams  sigma       centre, mm    rises, mm")
    for name, (load, sigma) in told.items():
        x, y, z = 1000 * load[1:] / max(load[0], 1e-9)
        up = 1000 * day8_mujoco.rises(loaded, arm, still, load)
        print(f"  {name:22}{1000 * load[0]:7.1f}{1000 * sigma[0]:7.1f}"
              f"{x:z7.1f}{y:z6.1f}{z:z6.1f}{up:z10.0f}")  # fmt: skip
    for name, (load, _) in found.items():
        lab.measured(f"grams off, of 500: {name}", 1000 * abs(load[0] - LOAD))
    load, sigma = found["each from both sides"]
    lab.measured("sigma of the load, g: each from both sides", 1000 * sigma[0])
    lab.record("payload_g", (load[0] - LOAD) / max(sigma[0], 1e-6),
               label="the last, off in sigmas", seed=ROBOT_SEED)  # fmt: skip


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    model = panda.load("panda_nohand", drive="torque")
    arm = panda.arm(model)
    rng = np.random.default_rng(NOISE_SEED)
    print(panda.describe("panda_nohand"))

    lab.step("1. A body in ten numbers: what it takes to move one that floats")
    off = []
    for body in day8_mujoco.bodies(TRIALS, ROBOT_SEED):
        truth = day8_mujoco.mujoco_wrench(body)  # mujoco.mj_inverse of one free body
        off.append(link_regressor(body.V, body.A) @ body.phi - truth)
    lab.check("|link_regressor phi - MuJoCo's wrench|, N and N m", off)

    lab.step("2. The whole arm: what its motion shows, and what it hides")
    elsewhere = day8_mujoco.anywhere(model, ROBOT_SEED, TRIALS)
    Y_elsewhere = regressor(arm, elsewhere)
    phi_file = day8_mujoco.numbers(arm)  # the 91 as the model file has them
    off = Y_elsewhere @ phi_file - mujoco_torques(model, elsewhere)
    lab.record("regressor", off, label="|Y phi - MuJoCo's torque|, N m",
               seed=ROBOT_SEED)  # fmt: skip
    for p, name in ((70, "links"), (91, "with motors")):
        rank, condition = rank_and_condition(Y_elsewhere[..., :p].reshape(-1, p), RTOL)
        print(f"  {name}: {rank} of {p} show, condition {condition:.0f}")
        lab.measured(f"how many of {p} numbers show: {name}", rank)

    for name, off in off_library().items():
        lab.check(f"{name} - the library's", off)

    lab.step("3. One pendulum, five numbers: how evenly a swing shows them")
    print("  reach, rad    one sine    with a fifth of a second one")
    for reach in (0.1, 0.3, 0.6):
        _, alone = rank_and_condition(pendulum(reach, 0.0), RTOL)
        _, both = rank_and_condition(pendulum(reach, 0.2), RTOL)
        print(f"  {reach:10.1f}{alone:12,.0f}{both:32,.0f}")

    lab.step("4. A robot that nobody knows: fits to its torques, N m")
    robot = day8_mujoco.changed(model, ROBOT_SEED)
    # MuJoCo's dry friction changes its sign late; mujoco.mj_inverse says how late.
    turns = day8_mujoco.turning_speed(model, HARD)
    lab.measured("up to which speed dry friction has the wrong sign, rad/s", turns)
    # All are judged at states that no fit has seen, in rows that are fast enough ...
    new = np.abs(elsewhere.qd) > SLOW
    Y_new = Y_elsewhere[new]
    truth = mujoco_torques(robot, elsewhere)[new]
    print("  fitted to           rank    condition residual elsewhere     sigma    in")
    # ... first a fit to Day 5's swing: torques measured with noise, slow rows left out,
    swing = day8_mujoco.swing()
    tau_swing = mujoco_torques(robot, swing) + NOISE * rng.normal(size=swing.q.shape)
    fast = np.abs(swing.qd) > SLOW
    Y_swing = regressor(arm, swing)[fast]
    judged("Day 5's swing", Y_swing, tau_swing[fast], Y_new, truth, RTOL)
    # with the small values cut off, which depends on the unit of length,
    for name, per_metre in (("metres", 1.0), ("decimetres", 10.0), ("cm", 100.0)):
        unit = lengths(per_metre)
        judged(f"  cut, in {name}", Y_swing / unit, tau_swing[fast],
               Y_new / unit, truth, CUT)  # fmt: skip
    # then to a motion that was chosen to show much,
    excited = day8_mujoco.excitation(robot, ROBOT_SEED)
    tau = mujoco_torques(robot, excited) + NOISE * rng.normal(size=excited.q.shape)
    Y = regressor(arm, excited)
    fast = np.abs(excited.qd) > SLOW
    judged("excited, ten samples", Y[::20][fast[::20]], tau[::20][fast[::20]],
           Y_new, truth, RTOL)  # fmt: skip
    off, inside = judged("excited", Y[fast], tau[fast], Y_new, truth, RTOL)
    phi = truncated_svd_fit(Y[fast], tau[fast], RTOL)
    # and to yours: FAR, OFTEN and BEGIN on top of this file.
    own = day8_mujoco.harmonics(robot, OFTEN, FAR, BEGIN)
    tau_own = mujoco_torques(robot, own) + NOISE * rng.normal(size=own.q.shape)
    fast = np.abs(own.qd) > SLOW
    Y_own = regressor(arm, own)[fast]
    judged("your two harmonics", Y_own, tau_own[fast], Y_new, truth, RTOL)
    print(f"  the model file's own numbers{rms(Y_new @ phi_file - truth):29.2f}")
    lab.record("fit", off, metric="new_rms_nm", label="excited, elsewhere",
               seed=ROBOT_SEED)  # fmt: skip
    lab.record("fit", inside, metric="inside_95", label="in 1.96 sigma",
               seed=ROBOT_SEED)  # fmt: skip

    lab.step("5. What hangs on its hand; how far it rises in 2 s when it floats so")
    weigh_the_load(lab, robot, arm, phi, rng)

    lab.step("6. Side quest: can a body have these ten numbers?")
    with lab.side_quest():
        # The links of the fit, which need not exist, and those of the file, which do.
        both = np.concatenate([phi[:70], phi_file[:70]]).reshape(14, 10)
        off = [
            min_pseudo_inertia_eig(x) for x in both
        ] - library.min_pseudo_inertia_eig(both)
        found = library.min_pseudo_inertia_eig(both[:7])
        lab.check("min_pseudo_inertia_eig - the library's", off)
        print(f"  the least of the links found: {found.min():.2f}")
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
