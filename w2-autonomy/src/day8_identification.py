"""Day 8: what the model does not know. A robot is weighed by its own motors.

    make day8                            in the clone: sets all up, then runs this
    python src/day8_identification.py    in w2-autonomy/, once that is done

phi of a body is (m, m c, Ixx, Iyy, Izz, Ixy, Ixz, Iyz), the inertia about its own
origin. Twists (omega; v), wrenches (moment; force). Metres, radians, kilograms, N m.
"""

import kit  # noqa: F401 (goes on in the kit's own Python)
import day8_mujoco
import numpy as np

from robo47 import cli, panda, se3
from robo47 import identification as library
from robo47.lesson.lab import Lab
from robo47.screws import ad, adjoint, skew

SEED = 47  # of the secret robot and of all that is random; another one is another robot
TRIALS = 100  # random states that a fit is judged on
NOISE = 0.1  # N m, of each measured torque; 1 of them moves the fit tenfold
SLOW = 0.1  # rad/s: below it a joint's dry friction is not yet that of its sign
RTOL = 1e-9  # of the largest singular value: smaller ones count as nothing
LOAD, AT = 0.5, np.array([0.02, -0.03, 0.06])  # kg and m: what the arm is to find
rms = lambda x: np.sqrt(np.mean(np.square(x)))  # noqa: E731


def inertia_of(phi: np.ndarray) -> np.ndarray:
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


def link_regressor(V: np.ndarray, A: np.ndarray) -> np.ndarray:
    """Return what each of the ten numbers costs in wrench, (6, 10).

    V and A, (6,), are the body's twist and acceleration, in its axes. At rest with A =
    (0, 0, 0, 0, 0, 9.81) the column of m is A, that of m cx (0, -9.81, 0, 0, 0, 0).
    """
    # region 8.2
    G = np.array([inertia_of(unit) for unit in np.eye(10)])
    return (G @ A - G @ V @ ad(V)).T  # each row of G V times ad(V): ad(V)^T G V
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
    V, A, Y = np.zeros(6), np.append(np.zeros(3), -g), np.zeros((7, 70))
    for i, (S, T) in enumerate(zip(J_space.T, T_links, strict=True)):
        V = V + S * qd[i]
        A = A + S * qdd[i] + ad(V) @ S * qd[i]
        X = adjoint(se3.inverse(T))
        costs = X.T @ link_regressor(X @ V, X @ A)  # of link i, at the world's origin
        Y[: i + 1, 10 * i : 10 * i + 10] = J_space[:, : i + 1].T @ costs
    return Y
    # endregion 8.3


def motor_features(qd: np.ndarray, qdd: np.ndarray) -> np.ndarray:
    """Return the columns of rotors, viscous and dry friction, (7, 21).

    With joint 1 at 0.5 rad/s and 2 rad/s2 row 0 has 2, 0.5, 1 at columns 0, 7, 14.
    """
    # region 8.4
    return np.hstack([np.diag(qdd), np.diag(qd), np.diag(np.sign(qd))])
    # endregion 8.4


def identifiable(Y: np.ndarray, rtol: float) -> tuple[int, float]:
    """Return (rank, condition): how much Y, (n, p), shows, and how unevenly.

    A singular value counts above rtol times the largest. Of [[1, 1], [2, 2]]: (1, 1.0).
    """
    # region 8.5
    s = np.linalg.svd(Y, compute_uv=False)
    kept = s[s > rtol * s[0]]
    return len(kept), kept[0] / kept[-1]
    # endregion 8.5


def fit(Y: np.ndarray, tau: np.ndarray, rtol: float) -> np.ndarray:
    """Return the smallest parameters, (p,), that explain the torques tau, (n,), best.

    For [[1, 1], [2, 2]] and (2, 4): (1, 1). rtol is that of `identifiable`.
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
    kept, phi = s > rtol * s[0], fit(Y, tau, rtol)
    noise = np.linalg.norm(tau - Y @ phi) / np.sqrt(len(tau) - kept.sum())
    return Y_new @ phi, noise * np.linalg.norm(Y_new @ Vt[kept].T / s[kept], axis=1)
    # endregion 8.7


def payload_from_holds(
    J_site: np.ndarray, R_site: np.ndarray, extra: np.ndarray, g: np.ndarray
) -> np.ndarray:
    """Return m and m c, (4,), of what hangs on the hand; c is in the hand's axes.

    J_site is (k, 6, 7), R_site (k, 3, 3); extra (k, 7) is how much more torque the k
    poses take with it. A slide along z that takes 9.81 N more each time: (1, 0, 0, 0).
    """
    # region 8.8
    weight = np.zeros((len(R_site), 6, 4))  # (moment; force) of m and of m c
    weight[:, 3:, 0], weight[:, :3, 1:] = g, -skew(g) @ R_site
    rows = -np.swapaxes(J_site, 1, 2) @ weight
    return np.linalg.lstsq(rows.reshape(-1, 4), extra.ravel(), rcond=None)[0]
    # endregion 8.8


def least_pseudo(phi: np.ndarray) -> float:
    """Return the least eigenvalue of [[tr(I)/2 1 - I, h], [h^T, m]], with h = m c.

    Of a body it is never below 0. (1, 0, 0, 0, 1, 1, 3, 0, 0, 0) has -0.5.
    """
    # region 8.9
    about, h = inertia_of(phi)[:3, :3], phi[1:4, None]
    spread = np.trace(about) / 2 * np.eye(3) - about
    return np.linalg.eigvalsh(np.block([[spread, h], [h.T, phi[0]]]))[0]
    # endregion 8.9


def arguments() -> dict[str, tuple]:
    """Return random arguments for what is compared with the library."""
    rng, rtol = np.random.default_rng(SEED), 4e-3
    Y = rng.normal(size=(40, 6)) * [1e3, 300, 100, 40, 0.1, 0.1]  # two hardly show
    tau, Y_new, (V, A) = (rng.normal(size=n) for n in (40, (8, 6), (2, 6)))
    J, R, extra = (rng.normal(size=(5, *n)) for n in ((6, 7), (3, 3), (7,)))
    return {
        "inertia_of": (rng.normal(size=10),), "link_regressor": (V, A),
        "motor_features": (np.maximum(V, 0.0), A), "identifiable": (Y, rtol),
        "fit": (Y, tau, rtol), "predict_with_sigma": (Y, tau, Y_new, rtol),
        "payload_from_holds": (J, R, extra, A[3:]),
    }  # fmt: skip


def regressor(arm, motion: day8_mujoco.Motion) -> np.ndarray:
    """Return all 91 columns at each state of a motion, (n, 7, 91)."""
    Y = []
    for q, qd, qdd in zip(*motion, strict=True):
        now = arm.at(q)
        links = arm_regressor(now.J_space, now.T_links, qd, qdd, arm.gravity)
        Y.append(np.hstack([links, motor_features(qd, qdd)]))
    return np.array(Y)


def judged(name: str, Y, tau, new: tuple, rtol: float = RTOL) -> tuple:
    """Fit, print how good it looks and how good it is; return phi, RMS and share."""
    (torque, sigma), phi = predict_with_sigma(Y, tau, new[0], rtol), fit(Y, tau, rtol)
    rank, condition = identifiable(Y, rtol)
    off, inside = rms(torque - new[1]), np.mean(np.abs(torque - new[1]) < 1.96 * sigma)
    condition = float(f"{condition:.4g}")
    some = condition < 1e6  # above, rounding reaches the decimals
    print(f"  {name:20}{rank:4}{condition:13,.0f}{rms(tau - Y @ phi):10.4f}"
          f"{off:12,.{3 * some}f}{rms(sigma):10,.{2 * some}f}{inside:5.0%}"
          )  # fmt: skip
    return phi, off, inside


def fits(robot, arm, new: tuple) -> tuple:
    """Print how fits to two motions of the secret robot do; return the last."""
    print("  fitted to          rank    condition  residual   elsewhere     sigma   in")
    rng, found = np.random.default_rng(SEED), []
    for motion in (day8_mujoco.swing(), day8_mujoco.excitation(robot, SEED)):
        tau = day8_mujoco.torques(robot, motion) + NOISE * rng.normal(size=motion.q.shape)
        found += [regressor(arm, motion), tau, np.abs(motion.qd) > SLOW]
    Y, tau, fast = found[:3]
    judged("Day 5's swing", Y[fast], tau[fast], new)
    judged("the same, rtol 1e-3", Y[fast], tau[fast], new, 1e-3)
    Y, tau, fast = found[3:]
    judged("ten samples, excited", Y[::20][fast[::20]], tau[::20][fast[::20]], new)
    judged("excited, slow rows", Y.reshape(-1, 91), tau.ravel(), new)
    return judged("excited", Y[fast], tau[fast], new)


def weighings(robot, loaded, arm) -> dict[str, np.ndarray]:
    """Return (m, m c), (4,), by how the arm was held with a load and without."""
    poses = panda.READY_Q + np.random.default_rng(SEED).uniform(-0.5, 0.5, (5, 7))
    (_, empty), (q, full) = (day8_mujoco.holds(one, arm, poses) for one in (robot, loaded))
    see, g = day8_mujoco.hands, arm.gravity
    weigh = lambda q, extra: payload_from_holds(*see(arm, q), extra, g)  # noqa: E731
    return {
        "told of no load": np.zeros(4),
        "both held from one side": weigh(q[0], full[0] - empty[0]),
        "one from either side": weigh(q[1], full[1] - empty[0]),
        "each from both, averaged": weigh(q.mean(axis=0), (full - empty).mean(axis=0)),
    }


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab, model = Lab(__file__, __doc__), panda.load("panda_nohand", drive="torque")
    print(panda.describe("panda_nohand"))
    arm, robot = panda.arm(model), day8_mujoco.changed(model, SEED)

    lab.step("1. A body in ten numbers, and a torque that is linear in them")
    for name, given in arguments().items():
        off = np.subtract(globals()[name](*given), getattr(library, name)(*given))
        lab.check(f"{name} - the library's", off)

    lab.step("2. The whole arm: what its motion shows, and what it hides")
    new = day8_mujoco.anywhere(model, SEED, TRIALS)
    Y = regressor(arm, new)
    file = day8_mujoco.numbers(arm)  # the 91 as the model file has them
    off = Y @ file - day8_mujoco.torques(model, new)
    lab.record("regressor", off, label="|Y phi - MuJoCo's torque|, N m", seed=SEED)
    for p, name in ((70, "links"), (91, "with motors")):
        rank, condition = identifiable(Y[..., :p].reshape(-1, p), RTOL)
        print(f"  {name}: {rank} of {p} show, condition {condition:.0f}")
        lab.measured(f"how many of {p} numbers show: {name}", rank)

    lab.step("3. A robot that nobody knows: five fits to its torques, N m")
    fast, truth = np.abs(new.qd) > SLOW, day8_mujoco.torques(robot, new)
    phi, off, inside = fits(robot, arm, (Y[fast], truth[fast]))
    print(f"  the model file's own numbers{rms((Y @ file - truth)[fast]):31.3f}")
    lab.record("fit", off, metric="new_rms_nm", label="excited, elsewhere", seed=SEED)
    lab.record("fit", inside, metric="inside_95", label="in 1.96 sigma", seed=SEED)

    lab.step("4. What hangs on its hand; how far it rises in 2 s when it floats so")
    loaded = panda.load("panda_nohand", drive="torque", edit=day8_mujoco.load(LOAD, AT))
    loaded, rest = day8_mujoco.changed(loaded, SEED), (np.zeros(7), np.zeros(7), arm.gravity)
    still = lambda now: arm_regressor(now.J_space, now.T_links, *rest) @ phi[:70]  # noqa: E731
    for name, (m, *h) in weighings(robot, loaded, arm).items():
        x, y, z = 1000 * np.array(h) / max(m, 1e-9)
        grams, up = 1000 * m, 1000 * day8_mujoco.rises(loaded, arm, still, (m, *h))
        at = f"{x:z4.1f} {y:z5.1f} {z:z5.1f} mm"
        print(f"  {name:25}{grams:6.1f} g at {at}{up:8.1f} mm")
        lab.measured(f"grams off, of 500: {name}", abs(grams - 1000 * LOAD))
    lab.record("payload_g", 1000 * (m - LOAD), label="the last, g off", seed=SEED)

    lab.step("5. Side quest: can a body have these ten numbers?")
    with lab.side_quest():
        found = np.array([least_pseudo(x) for x in phi[:70].reshape(7, 10)])
        off = found - library.least_pseudo(phi[:70].reshape(7, 10))
        lab.check("least_pseudo - the library's", off)
        print(f"  the least of the links found: {found.min():.2f}")
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
