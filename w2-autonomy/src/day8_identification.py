"""Day 8: what the model does not know. A robot is weighed by its own motors.

    make day8                            in the clone: sets everything up, then runs this
    python src/day8_identification.py    in w2-autonomy/, once that is done

phi of a body is (m, m c, Ixx, Iyy, Izz, Ixy, Ixz, Iyz), the inertia about its own
origin. Twists (omega; v), wrenches (moment; force). Metres, radians, kilograms, N m.
"""

import kit  # noqa: F401 (goes on in the kit's own Python)
import numpy as np

from robo47 import cli, dynamics, panda, secret, simulate, verify
from robo47 import identification as library
from robo47.lesson.lab import Lab
from robo47.screws import ad, adjoint, skew
from robo47.se3 import inverse

SEED = 47  # of the secret robot and of all that is random; another one is another robot
TRIALS = 100  # random states that a fit is judged on
NOISE = 0.1  # N m, of each measured torque; 1 of them moves the fit tenfold
SLOW = 0.1  # rad/s: below it a joint's dry friction is not yet that of its sign
RTOL = 1e-9  # of the largest singular value: smaller ones count as nothing
LOAD, AT = 0.5, np.array([0.02, -0.03, 0.06])  # kg and m: what the arm is to find
POSES = 5  # that the arm is held in; one shows m, and not all of c
RATE, FLOAT = 10.0, 2.0  # Hz and s, of the arm that floats


def inertia_of(phi: np.ndarray) -> np.ndarray:
    """Return the 6x6 inertia of a body, (6, 6), from its ten numbers phi, (10,).

    For (2, 0, 0, 2, 2, 2, 0, 0, 0, 0), 2 kg at (0, 0, 1), the diagonal is
    (2, 2, 0, 2, 2, 2), as in Day 4.
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

    V and A, (6,), are the body's twist and acceleration, in its own axes. At rest, with
    A = (0, 0, 0, 0, 0, 9.81), the column of m is A, that of m cx (0, -9.81, 0, 0, 0, 0).
    """
    # region 8.2
    G = np.array([inertia_of(unit) for unit in np.eye(10)])
    return (G @ A - G @ V @ ad(V)).T  # each row of G V times ad(V): ad(V)^T G V
    # endregion 8.2


def arm_regressor(
    J_space: np.ndarray,
    T_links: np.ndarray,
    qd: np.ndarray,
    qdd: np.ndarray,
    g: np.ndarray,
) -> np.ndarray:
    """Return Y, (7, 70), with which the torque of all links is Y phi.

    J_space is (6, 7), T_links (7, 4, 4). One hinge about +y with qdd 1, each T the
    identity: for every link its row is (0, -9.81, 0, 0, 0, 1, 0, 0, 0, 0).
    """
    # region 8.3
    V, A = np.zeros(6), np.append(np.zeros(3), -g)
    Y = np.zeros((7, 70))
    for i, (S, T) in enumerate(zip(J_space.T, T_links, strict=True)):
        V = V + S * qd[i]
        A = A + S * qdd[i] + ad(V) @ S * qd[i]
        X = adjoint(inverse(T))
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
    """Return how many combinations Y, (n, p), shows, and how unevenly: rank, condition.

    A singular value counts above rtol times the largest. For [[1, 1], [2, 2]]: (1, 1.0).
    """
    # region 8.5
    s = np.linalg.svd(Y, compute_uv=False)
    kept = s[s > rtol * s[0]]
    return len(kept), kept[0] / kept[-1]
    # endregion 8.5


def fit(Y: np.ndarray, tau: np.ndarray, rtol: float) -> np.ndarray:
    """Return the smallest parameters, (p,), that explain the torques tau, (n,), best.

    For [[1, 1], [2, 2]] and (2, 4) it is (1, 1). rtol is that of `identifiable`.
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
    phi = fit(Y, tau, rtol)
    residual = tau - Y @ phi
    noise = np.sqrt(residual @ residual / (len(tau) - kept.sum()))
    return Y_new @ phi, noise * np.linalg.norm(Y_new @ Vt[kept].T / s[kept], axis=1)
    # endregion 8.7


def payload_from_holds(
    J_site: np.ndarray, R_site: np.ndarray, extra: np.ndarray, g: np.ndarray
) -> np.ndarray:
    """Return m and m c, (4,), of what hangs on the hand; c is in the hand's axes.

    In k poses J_site is (k, 6, 7), R_site (k, 3, 3), and holding still takes the
    torques extra, (k, 7), more than without. A slide along z that takes 9.81 N more in
    every pose: (1, 0, 0, 0), the smallest.
    """
    # region 8.8
    rows = []
    for J, R in zip(J_site, R_site, strict=True):
        weight = np.zeros((6, 4))  # (moment; force) of m and of m c
        weight[3:, 0], weight[:3, 1:] = g, -skew(g) @ R
        rows.append(-J.T @ weight)
    return np.linalg.lstsq(np.vstack(rows), extra.ravel(), rcond=None)[0]
    # endregion 8.8


def least_pseudo(phi: np.ndarray) -> float:
    """Return the least eigenvalue of [[tr(I)/2 1 - I, h], [h^T, m]], with h = m c.

    No body has it below 0. Of a point mass it is 0; (1, 0, 0, 0, 1, 1, 3, 0, 0, 0) has
    -0.5: its I is that of nothing.
    """
    # region 8.9
    G = inertia_of(phi)
    about, h = G[:3, :3], phi[1:4, None]
    spread = np.trace(about) / 2 * np.eye(3) - about
    return np.linalg.eigvalsh(np.block([[spread, h], [h.T, phi[0]]]))[0]
    # endregion 8.9


def by_value(rng: np.random.Generator) -> dict[str, np.ndarray]:
    """Return each small function's errors: against Day 4's formulas, or the library."""
    m, c, A = rng.uniform(1, 3), rng.uniform(-1, 1, 3), rng.uniform(-1, 1, (3, 3))
    phi, G = library.parameters(m, c, A @ A.T), dynamics.spatial_inertia(m, c, A @ A.T)
    V, acc, tau = *rng.uniform(-1, 1, (2, 6)), rng.uniform(-1, 1, 40)
    Y = rng.normal(size=(40, 4)) @ rng.normal(size=(4, 6))  # rank 4 of 6
    seen, known = identifiable(Y, RTOL), library.identifiable(Y, RTOL)
    given = Y, tau, rng.normal(size=(8, 6)), RTOL
    pairs = zip(predict_with_sigma(*given), library.predict_with_sigma(*given))
    features = motor_features(V, acc) - library.motor_features(V, acc)
    return {
        "inertia_of - Day 4's spatial_inertia": inertia_of(phi) - G,
        "link_regressor phi - its wrench": link_regressor(V, acc) @ phi
        - (G @ acc - ad(V).T @ G @ V),
        "motor_features - the library's": features,
        "rank and condition - the library's": np.subtract(seen, known),
        "fit - NumPy's lstsq": fit(Y, tau, RTOL) - np.linalg.lstsq(Y, tau)[0],
        "predict_with_sigma - the library's": [a - b for a, b in pairs],
    }


def regressor(arm, motion: secret.Motion) -> np.ndarray:
    """Return all 91 columns at each state of a motion, (n, 7, 91)."""
    Y = []
    for q, qd, qdd in zip(*motion, strict=True):
        now = arm.at(q)
        links = arm_regressor(now.J_space, now.T_links, qd, qdd, arm.gravity)
        Y.append(np.hstack([links, motor_features(qd, qdd)]))
    return np.array(Y)


def measured(robot, motion: secret.Motion, rng) -> np.ndarray:
    """Return MuJoCo's torques of a motion, (n, 7), with noise on each."""
    return verify.mujoco_inverse_dynamics(robot, *motion) + NOISE * rng.normal(
        size=motion.q.shape
    )


def rms(x: np.ndarray) -> float:
    """Return the root of the mean square."""
    return float(np.sqrt(np.mean(np.square(x))))


def judged(name: str, Y, tau, new: tuple, rtol: float = RTOL) -> tuple:
    """Fit, print how good it looks and how good it is; return phi, RMS and share."""
    (torque, sigma), phi = predict_with_sigma(Y, tau, new[0], rtol), fit(Y, tau, rtol)
    rank, condition = identifiable(Y, rtol)
    off, inside = rms(torque - new[1]), np.mean(np.abs(torque - new[1]) < 1.96 * sigma)
    print(f"  {name:20}{rank:4}{condition:13,.0f}{rms(tau - Y @ phi):10.4f}"
          f"{off:13,.3f}{rms(sigma):11,.3f}{inside:6.0%}")  # fmt: skip
    return phi, off, inside


def fits(model, robot, arm, new: tuple, rng) -> tuple:
    """Print a table of fits to motions of the secret robot; return the first."""
    print(
        "  fitted to          rank    condition  residual  new motions      sigma   in"
    )
    excited, swing = secret.excitation(model, SEED), secret.swing()
    first = regressor(arm, secret.Motion(*(x[:40] for x in swing)))  # then it repeats
    Y, Y_swing = regressor(arm, excited), np.tile(first, (5, 1, 1))
    tau, fast = measured(robot, excited, rng), np.abs(excited.qd) > SLOW
    tau_swing, moves = measured(robot, swing, rng), np.abs(swing.qd) > SLOW
    few = np.s_[::20]
    best = judged("excited", Y[fast], tau[fast], new)
    judged("and its slow rows", Y.reshape(-1, 91), tau.ravel(), new)
    judged("ten samples of it", Y[few][fast[few]], tau[few][fast[few]], new)
    judged("Day 5's swing", Y_swing[moves], tau_swing[moves], new)
    judged("swing, rtol 1e-3", Y_swing[moves], tau_swing[moves], new, 1e-3)
    return best


def weigh(arm, q: np.ndarray, extra: np.ndarray) -> np.ndarray:
    """Return (m, m c) from holds at q, (k, 7), that took the torques extra, (k, 7)."""
    now = [arm.at(x) for x in q]
    J, R = [x.J_site for x in now], [x.T_world_ee[:3, :3] for x in now]
    return payload_from_holds(np.array(J), np.array(R), extra, arm.gravity)


def weighings(robot, loaded, arm, rng) -> dict[str, np.ndarray]:
    """Return what is found, (m, m c), by which holds: both robots, from either side."""
    poses = panda.READY_Q + rng.uniform(-0.5, 0.5, (POSES, 7))
    (_, empty), (q, full) = (
        np.array(
            [[secret.hold(one, arm, x, side) for x in poses] for side in (1, -1)]
        ).transpose(2, 0, 1, 3)
        for one in (robot, loaded)
    )
    return {
        "both held from one side": weigh(arm, q[0], full[0] - empty[0]),
        "one from either side": weigh(arm, q[1], full[1] - empty[0]),
        "each from both, averaged": weigh(
            arm, q.mean(axis=0), (full - empty).mean(axis=0)
        ),
    }


def rises(robot, arm, phi: np.ndarray, load: np.ndarray) -> float:
    """Return how far the hand rises, mm, while the arm floats on phi and the load."""

    def law(t: float, q: np.ndarray, qd: np.ndarray) -> np.ndarray:
        now, g, rest = arm.at(q), arm.gravity, np.zeros(7)
        h = now.T_world_ee[:3, :3] @ load[1:]
        weight = np.append(np.cross(h, g), load[0] * g)
        still = arm_regressor(now.J_space, now.T_links, rest, rest, g) @ phi[:70]
        return still - now.J_site.T @ weight

    start = simulate.start(robot, panda.READY_Q)
    run = simulate.run(robot, start, law, FLOAT, rate=RATE)
    return 1000 * (arm.at(run.q[-1]).T_world_ee - arm.at(run.q[0]).T_world_ee)[2, 3]


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab, rng = Lab(__file__, __doc__), np.random.default_rng(SEED)
    model = panda.load("panda_nohand", drive="torque")
    print(panda.describe("panda_nohand"))
    arm, robot = panda.arm(model), secret.changed(model, SEED)

    lab.step("1. A body in ten numbers, and a torque that is linear in them")
    for name, off in by_value(rng).items():
        lab.check(name, off)

    lab.step("2. The whole arm: what its motion shows, and what it hides")
    new = secret.anywhere(model, SEED, TRIALS)
    Y = regressor(arm, new)
    links = library.parameters(arm.masses, arm.coms, arm.inertias).ravel()
    file = np.concatenate([links, arm.armature, arm.damping, np.zeros(7)])
    off = Y @ file - verify.mujoco_inverse_dynamics(model, *new)
    lab.record("regressor", off, label="|Y phi - MuJoCo's torque|, N m",
               config="random", seed=SEED)  # fmt: skip
    for name, part in (("links", Y[..., :70]), ("with motors", Y)):
        rank, condition = identifiable(part.reshape(-1, part.shape[-1]), RTOL)
        print(f"  {name}: {rank} of {part.shape[-1]} show, condition {condition:.0f}")

    lab.step("3. A robot that nobody knows: five fits to its torques, N m")
    fast, truth = np.abs(new.qd) > SLOW, verify.mujoco_inverse_dynamics(robot, *new)
    new = Y[fast], truth[fast]
    phi, off, inside = fits(model, robot, arm, new, rng)
    print(f"  The model file's own numbers: {rms(new[0] @ file - new[1]):.3f} there.")
    lab.record("fit", off, metric="new_rms_nm", label="excited, new motions", seed=SEED)
    lab.record("fit", inside, metric="inside_95", label="of them within 1.96 sigma",
               seed=SEED)  # fmt: skip

    lab.step("4. What hangs on its hand")
    loaded = panda.load("panda_nohand", drive="torque", edit=secret.load(LOAD, AT))
    loaded = secret.changed(loaded, SEED)
    found = weighings(robot, loaded, arm, rng)
    for name, (m, *h) in found.items():
        c = ", ".join(f"{1000 * x / m:5.1f}" for x in h)
        print(f"  {name:25} {1000 * m:6.1f} g at ({c}) mm")
    lab.record("payload_g", 1000 * (m - LOAD), label="the last, g off", seed=SEED)

    lab.step("5. Float with it, without friction: how far the hand rises in 2 s")
    loaded.dof_frictionloss[:] = 0.0
    for name, load in ({"nothing": np.zeros(4)} | found).items():
        up = rises(secret.settled(loaded), arm, phi, load)
        print(f"  {name:25} {up:6.0f} mm")

    lab.step("6. Side quest: can a body have these ten numbers?")
    with lab.side_quest():
        own = phi[:70].reshape(7, 10)
        off = [least_pseudo(x) - library.least_pseudo(x) for x in own]
        lab.check("least_pseudo - the library's", off)
        print(
            f"  the least of the links that were found: {min(map(least_pseudo, own)):.2f}"
        )
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
