"""Day 8: dynamic parameter identification from measured joint torques.

    make day8                            in the clone: sets all up, then runs this
    python src/day8_identification.py    in w2-autonomy/, once that is done

The inertial parameters of a body are phi = (m, m c, Ixx, Iyy, Izz, Ixy, Ixz, Iyz), with
the inertia about the origin of the body frame. Twists are (omega; v), wrenches (moment;
force). Metres, radians, kilograms, N m.
"""

import kit  # noqa: F401 (goes on in the kit's own Python)
import mujoco
import numpy as np

from robo47 import cli, panda, se3
from robo47 import identification as library
from robo47.lesson.lab import Lab
from robo47.screws import ad, adjoint, skew

import day8_mujoco

ROBOT_SEED = 47  # of the unknown robot; another seed makes another robot
NOISE_SEED = 47  # of the noise alone
NOISE = 0.1  # N m, standard deviation of each measured torque
TRIALS = 100  # random states, the test data of every fit
HARD = 5.0  # rad/s^2, the acceleration at which dry friction is examined
SLOW = 0.1  # rad/s; in slower rows dry friction may not have the sign of the velocity
RTOL = 1e-9  # of the largest singular value; smaller ones are rounding errors
CUT = 1e-3  # the same, for a truncated fit
LOAD = 0.5  # kg, the mass of the load
AT = np.array([0.02, -0.03, 0.06])  # m, its centre of mass in the hand frame
WAIT = 2.0  # s until a hold is measured; with 8 step 5 prints another number
# rad, (5, 7): the poses in which the arm is held
POSES = panda.READY_Q + np.random.default_rng(47).uniform(-0.5, 0.5, (5, 7))
# Your own motion is a sum of two harmonics. OFTEN holds their frequencies (Hz), FAR the
# amplitude of each joint (rad) and BEGIN its phase (rad).
OFTEN = (0.2, 0.5)
FAR = np.array([[0.3] * 7, [0.0] * 7])
BEGIN = np.array([[0.0] * 7, [0.0] * 7])


def rms(x: np.ndarray) -> float:
    """Return the root mean square."""
    return np.sqrt(np.mean(np.square(x)))


def spatial_inertia_from_params(phi: np.ndarray) -> np.ndarray:
    """Return the spatial inertia of a body, (6, 6), a linear function of phi.

    phi (10,) holds the inertial parameters of the body: mass, first moment of mass m c,
    and the inertia about the origin of the body frame as Ixx, Iyy, Izz, Ixy, Ixz, Iyz,
    entries of the matrix. The result maps a twist (omega; v) to the momentum (angular;
    linear), both in the body frame. A unit vector phi, whose mass may be 0, is allowed.
    (2, 0, 0, 2, 2, 2, 0, 0, 0, 0) is Day 4's point of 2 kg at (0, 0, 1); the result
    then has the diagonal (2, 2, 0, 2, 2, 2).
    """
    # region 8.1
    m, x, y, z, xx, yy, zz, xy, xz, yz = phi  # the mass, m c and the inertia
    return np.array([
        [xx, xy, xz, 0, -z, y],  # the angular momentum about x
        [xy, yy, yz, z, 0, -x],  # the angular momentum about y
        [xz, yz, zz, -y, x, 0],  # the angular momentum about z
        [0, z, -y, m, 0, 0],  # the linear momentum along x
        [-z, 0, x, 0, m, 0],  # the linear momentum along y
        [y, -x, 0, 0, 0, m],  # the linear momentum along z
    ])  # fmt: skip
    # endregion 8.1


def link_regressor(V: np.ndarray, Vd: np.ndarray) -> np.ndarray:
    """Return the regressor of one body, (6, 10): times phi it is the body's wrench.

    V (6,) is the twist of the body and Vd (6,) its acceleration, both expressed in the
    body frame; gravity is included in Vd as an acceleration -g of the base. The wrench
    (moment; force) that moves the body is G Vd - ad(V)^T G V (Modern Robotics, section
    8.2.2). Column k is this wrench for the k-th unit vector phi. At rest with Vd = (0,
    0, 0, 0, 0, 9.81), the column of m is Vd and the column of m cx is (0, -9.81, 0, 0,
    0, 0).
    """
    # region 8.2
    G = np.array(  # the spatial inertias of the ten unit vectors
        [spatial_inertia_from_params(unit) for unit in np.eye(10)]
    )
    # ad(V)^T G V, because each row of G V is multiplied by ad(V) from the right:
    return (G @ Vd - G @ V @ ad(V)).T  # the wrenches, one in each column
    # endregion 8.2


def arm_regressor(
    J_space: np.ndarray, T_links: np.ndarray, qd: np.ndarray, qdd: np.ndarray,
    g: np.ndarray,
) -> np.ndarray:  # fmt: skip
    """Return the regressor of the arm, (7, 70): the torque of its links is Y phi.

    J_space (6, 7) is the space Jacobian, T_links (7, 4, 4) are the poses T_world_link,
    qd (7,) and qdd (7,) are joint velocities, rad/s, and accelerations, rad/s^2, and
    g (3,) is the gravity vector such as (0, 0, -9.81), m/s^2. phi stacks the ten
    parameters of each link, expressed in the frame of the link. Rotors and friction are
    not included. A link causes no torque at the joints that are distal to it (Siciliano
    and others, Robotics, section 7.2.2). Example: only joint 1 has a screw other than
    0, (0, 1, 0, 0, 0, 0), qd is 0, qdd is (1, 0, ..., 0), each T is the identity and g
    is (0, 0, -9.81). Then row 1 is (0, -9.81, 0, 0, 0, 1, 0, 0, 0, 0) for every link,
    and all other rows are 0.
    """
    # region 8.3
    V = np.zeros(6)  # the twist, 0 at the base
    A = np.append(np.zeros(3), -g)  # the acceleration, which is -g at the base
    Y = np.zeros((7, 70))  # the regressor
    for i, (S, T) in enumerate(zip(J_space.T, T_links, strict=True)):
        V = V + S * qd[i]  # the twist of link i
        A = A + S * qdd[i] + ad(V) @ S * qd[i]  # the acceleration of link i
        X = adjoint(se3.inverse(T))  # the adjoint from the world to the link
        costs = X.T @ link_regressor(X @ V, X @ A)  # the wrenches in the world frame
        Y[: i + 1, 10 * i : 10 * i + 10] = J_space[:, : i + 1].T @ costs  # the torques
    return Y  # the regressor
    # endregion 8.3


def actuator_regressor(qd: np.ndarray, qdd: np.ndarray) -> np.ndarray:
    """Return the regressor of the motors, (7, 21).

    qd (7,) and qdd (7,) are joint velocities, rad/s, and accelerations, rad/s^2. The
    columns belong to seven rotor inertias (the torque is inertia times qdd), seven
    coefficients of viscous friction (times qd) and seven torques of dry friction (times
    the sign of qd). Each acts at its own joint only (Modern Robotics, section 8.9).
    With joint 1 at 0.5 rad/s and 2 rad/s^2, row 0 has 2, 0.5 and 1 in the columns 0, 7
    and 14.
    """
    # region 8.4
    return np.hstack([
        np.diag(qdd),  # the columns of the rotors
        np.diag(qd),  # the columns of viscous friction
        np.diag(np.sign(qd)),  # the columns of dry friction
    ])  # fmt: skip
    # endregion 8.4


def rank_and_condition(Y: np.ndarray, rtol: float) -> tuple[int, float]:
    """Return the numerical rank of a regressor and its condition number.

    Y (n, p) has a row for each measured torque and a column for each parameter. The
    rank is the number of singular values larger than rtol times the largest; the
    condition number is the largest of these over the smallest of these (Golub and Van
    Loan, Matrix Computations, section 5.5).

    rank_and_condition([[1, 1], [2, 2]], 1e-9) -> (1, 1.0)
    """
    # region 8.5
    s = np.linalg.svd(Y, compute_uv=False)  # the singular values, largest first
    kept = s[s > rtol * s[0]]  # the singular values above the limit
    return len(kept), kept[0] / kept[-1]  # the rank and the condition number
    # endregion 8.5


def truncated_svd_fit(Y: np.ndarray, tau: np.ndarray, rtol: float) -> np.ndarray:
    """Return the minimum-norm least-squares parameters, (p,), by truncated SVD.

    Y (n, p) is the regressor and tau (n,) the measured torques, N m. Singular values
    that are not larger than rtol times the largest are left out, as in
    `rank_and_condition`. Among all parameters with the same residual, the result has
    the smallest norm (Golub and Van Loan, section 5.5).

    truncated_svd_fit([[1, 1], [2, 2]], [2, 4], 1e-9) -> [1, 1]
    """
    # region 8.6
    U, s, Vt = np.linalg.svd(Y, full_matrices=False)  # the SVD of Y
    kept = s > rtol * s[0]  # the singular values above the limit
    return Vt[kept].T @ (U[:, kept].T @ tau / s[kept])  # the minimum-norm solution
    # endregion 8.6


def predict_with_sigma(
    Y: np.ndarray, tau: np.ndarray, Y_new: np.ndarray, rtol: float
) -> tuple[np.ndarray, np.ndarray]:
    """Return predicted torques and the standard deviation of each, (m,) both.

    Y (n, p), tau (n,) and rtol are as in `truncated_svd_fit`; Y_new (m, p) is the
    regressor of new motions. The variance of the noise is r . r / (n - rank), where r
    is the residual of the fit. The standard deviation is the noise that the fit
    transfers to a prediction; it includes neither the noise of a new measurement nor
    the bias of a truncated fit. Four rows of 1, measured as 1, 3, 1 and 3: for a new
    row of 1 the prediction is 2, with a standard deviation of 0.57735.
    """
    # region 8.7
    _, s, Vt = np.linalg.svd(Y, full_matrices=False)  # the SVD of Y
    kept = s > rtol * s[0]  # the singular values above the limit
    phi = truncated_svd_fit(Y, tau, rtol)  # the fitted parameters
    noise = np.linalg.norm(tau - Y @ phi) / np.sqrt(  # the noise level
        len(tau) - kept.sum()
    )
    return (
        Y_new @ phi,  # the predicted torques
        noise * np.linalg.norm(Y_new @ Vt[kept].T / s[kept], axis=1),  # the sigmas
    )
    # endregion 8.7


def identify_payload(
    J_site: np.ndarray, R_site: np.ndarray, extra: np.ndarray, g: np.ndarray
) -> np.ndarray:
    """Return the mass and the first moment of a payload, (4,): m in kg, m c in kg m.

    The arm holds still in k poses. J_site (k, 6, 7) are the site Jacobians, R_site (k,
    3, 3) the orientations of the hand in the world frame, extra (k, 7) the torques with
    the payload minus those without, N m, and g (3,) is the gravity vector, m/s^2. The
    centre of mass c is expressed in the hand frame, relative to the site. The result is
    the least-squares solution of all poses together. Poses whose orientations differ
    only by rotations about g do not determine the component of c along it. A slide
    along z that needs 9.81 N more in each pose carries (1, 0, 0, 0).
    """
    # region 8.8
    weight = np.zeros((len(R_site), 6, 4))  # the wrenches of a unit m and a unit m c
    weight[:, 3:, 0] = g  # the force of a unit mass
    weight[:, :3, 1:] = -skew(g) @ R_site  # the moments of a unit first moment
    rows = -np.swapaxes(J_site, 1, 2) @ weight  # the regressor of the payload
    return np.linalg.lstsq(  # the least-squares solution
        rows.reshape(-1, 4), extra.ravel(), rcond=None
    )[0]
    # endregion 8.8


def min_pseudo_inertia_eig(phi: np.ndarray) -> float:
    """Return the smallest eigenvalue of a body's pseudo-inertia matrix.

    phi (10,) holds the inertial parameters. The pseudo-inertia (4, 4) is
    [[Sigma, h], [h^T, m]] with h = m c and Sigma the sum of m r r^T over the points of
    the body. Sigma is equal to (tr(I) / 2) E - I, where I is the inertia about the
    origin and E the identity matrix (Wensing and others, 2018). For a body that can
    exist the eigenvalue is not negative.

    min_pseudo_inertia_eig([1, 0, 0, 0, 1, 1, 3, 0, 0, 0]) -> -0.5
    """
    # region 8.9
    about = spatial_inertia_from_params(phi)[:3, :3]  # the inertia about the origin
    h = phi[1:4, None]  # the first moment of mass
    spread = np.trace(about) / 2 * np.eye(3) - about  # Sigma, the sum of m r r^T
    return np.linalg.eigvalsh(  # the smallest eigenvalue
        np.block([[spread, h], [h.T, phi[0]]])
    )[0]
    # endregion 8.9


def pendulum(reach: float, second: float) -> np.ndarray:
    """Return the regressor of a pendulum, (200, 5): q'', cos q, sin q, q', sign q'.

    The motion is q = reach (sin t + second sin 2.37 t), with the amplitude reach, rad,
    and the fraction second of another frequency, over 10 s.
    """
    t = np.arange(200) * 0.05
    q = reach * (np.sin(t) + second * np.sin(2.37 * t))
    qd = reach * (np.cos(t) + second * 2.37 * np.cos(2.37 * t))
    qdd = -reach * (np.sin(t) + second * 2.37**2 * np.sin(2.37 * t))
    return np.transpose([qdd, np.cos(q), np.sin(q), qd, np.sign(qd)])


def regressor(arm, motion: day8_mujoco.Motion) -> np.ndarray:
    """Return the regressor of n states, (n, 7, 91): 70 columns of links, 21 more."""
    rows = []
    for q, qd, qdd in zip(motion.q, motion.qd, motion.qdd, strict=True):
        now = arm.at(q)
        links = arm_regressor(now.J_space, now.T_links, qd, qdd, arm.gravity)
        motors = actuator_regressor(qd, qdd)
        rows.append(np.hstack([links, motors]))
    return np.array(rows)


def mujoco_torques(model, motion: day8_mujoco.Motion) -> np.ndarray:
    """Return the torques of a motion by MuJoCo's inverse dynamics, N m, (n, 7)."""
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
    """Return the errors of your fits against robo47's, by function.

    MuJoCo has no least-squares fits to compare with.
    """
    rng = np.random.default_rng(ROBOT_SEED)
    shows = [1e3, 300, 100, 40, 0.1, 0.1]  # rtol 4e-3 leaves two of six out
    wide = [1e3, 900, 800, 700, 6.5, 6.5]  # none; 4e-3 of the sum or norm leaves some
    speeds = np.array([-0.4, 0.0, 3e-4, 0.02, 0.5])
    tau = rng.normal(size=40)
    Y, Y_wide = rng.normal(size=(2, 40, 6)) * [[shows], [wide]]
    Y_new = rng.normal(size=(8, 6))
    J_site = rng.normal(size=(5, 6, 7))
    R_site = np.linalg.qr(rng.normal(size=(5, 3, 3)))[0]
    extra = rng.normal(size=(5, 7))
    alike = R_site[0] @ se3.Rx(0.002 * np.arange(5))  # nearly equal orientations
    g = np.array([1.0, -2.0, -9.0])  # of an arm that is mounted on a wall
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
            size = max(1.0, np.abs(truth).max())  # condition numbers are large
            parts.append(np.ravel(own[name](*one) - truth) / size)
        return np.concatenate(parts)

    return {name: off(name) for name in own}


def lengths(per_metre: float) -> np.ndarray:
    """Return the factors of the 91 parameters for a smaller unit of length, (91,).

    per_metre is the number of units in a metre, 10 for decimetres.
    """
    body = [1.0] + [per_metre] * 3 + [per_metre**2] * 6  # kg, kg m, kg m^2
    return np.append(np.tile(body, 7), np.ones(21))


def judged(name: str, Y, tau, Y_new, truth, rtol: float) -> tuple[float, float]:
    """Fit, print residual and test error, and return the test error and a fraction.

    It is the fraction of the test torques within 1.96 sigma of the prediction.
    """
    rank, condition = rank_and_condition(Y, rtol)
    condition = float(f"{condition:.3g}")
    phi = truncated_svd_fit(Y, tau, rtol)
    with np.errstate(divide="ignore"):  # with as many rows as parameters sigma is inf
        torque, sigma = predict_with_sigma(Y, tau, Y_new, rtol)
    off = rms(torque - truth)
    # Without noise both are rounding errors, which sigma does not cover.
    inside = np.mean(np.abs(torque - truth) < 1.96 * sigma + 1e-9)
    digits = 2 if condition < 1e6 else -3  # above, the last ones are rounding errors
    print(f"  {name:22}{rank:3}{condition:13,.0f}{rms(tau - Y @ phi):10.4f}"
          f"{round(off, digits):12,.{max(digits, 0)}f}"
          f"{round(rms(sigma), digits):9,.{max(digits, 0)}f}{inside:8.0%}"
          )  # fmt: skip
    return off, inside


def weighed(arm, q, extra) -> tuple[np.ndarray, np.ndarray]:
    """Return the payload (m, m c) from holds at q (k, 7), and its sigma, (4,) each."""
    J_site, R_site = day8_mujoco.hands(arm, q)
    load = identify_payload(J_site, R_site, extra, arm.gravity)
    rows = library.load_regressor(J_site, R_site, arm.gravity).reshape(-1, 4)
    _, sigma = predict_with_sigma(rows, extra.ravel(), np.eye(4), RTOL)
    return load, sigma


def weighings(robot, loaded, arm, rng) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Return the payload and its sigma by the sides from which the arm was held."""
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
    """Identify the payload, then let the arm float with each of the results."""
    hung = panda.load("panda_nohand", drive="torque", edit=day8_mujoco.load(LOAD, AT))
    loaded = day8_mujoco.changed(hung, ROBOT_SEED)
    rest = np.zeros(7)

    def still(now):
        links = arm_regressor(now.J_space, now.T_links, rest, rest, arm.gravity)
        return links @ phi[:70]

    nothing = np.zeros(4)
    truth = LOAD * np.append(1.0, AT)
    found = weighings(robot, loaded, arm, rng)
    tried = {"none": (nothing, nothing), **found, "true load": (truth, nothing)}
    print("  load in the model       grams  sigma   centre of mass, mm  rise, mm")
    for name, (load, sigma) in tried.items():
        x, y, z = 1000 * load[1:] / max(load[0], 1e-9)
        up = 1000 * day8_mujoco.rises(loaded, arm, still, load)
        print(f"  {name:22}{1000 * load[0]:7.1f}{1000 * sigma[0]:7.1f}"
              f"{x:z8.1f}{y:z7.1f}{z:z6.1f}{up:z10.0f}")  # fmt: skip
    for name, (load, _) in found.items():
        lab.measured(f"grams off, of 500: {name}", 1000 * abs(load[0] - LOAD))
    load, sigma = found["each from both sides"]
    lab.measured("sigma of the load, g: each from both sides", 1000 * sigma[0])
    lab.record("payload_g", (load[0] - LOAD) / max(sigma[0], 1e-6),
               label="error of the mass, from both sides, in sigmas",
               seed=ROBOT_SEED)  # fmt: skip


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    model = panda.load("panda_nohand", drive="torque")
    arm = panda.arm(model)
    rng = np.random.default_rng(NOISE_SEED)
    print(panda.describe("panda_nohand"))

    lab.step("1. The regressor of one body, compared with a free body in MuJoCo")
    off = []
    for body in day8_mujoco.bodies(TRIALS, ROBOT_SEED):
        truth = day8_mujoco.mujoco_wrench(body)  # mujoco.mj_inverse of one free body
        off.append(link_regressor(body.V, body.A) @ body.phi - truth)
    lab.check("|link_regressor phi - MuJoCo's wrench|, N and N m", off)

    lab.step("2. The regressor of the arm: rank and condition number")
    elsewhere = day8_mujoco.anywhere(model, ROBOT_SEED, TRIALS)
    Y_elsewhere = regressor(arm, elsewhere)
    phi_file = day8_mujoco.numbers(arm)  # the 91 parameters of the model file
    off = Y_elsewhere @ phi_file - mujoco_torques(model, elsewhere)
    lab.record("regressor", off, label="|Y phi - MuJoCo's torque|, N m",
               seed=ROBOT_SEED)  # fmt: skip
    for p, name in ((70, "links"), (91, "with motors")):
        rank, condition = rank_and_condition(Y_elsewhere[..., :p].reshape(-1, p), RTOL)
        print(f"  {name}: rank {rank} of {p}, condition number {condition:.0f}")
        lab.measured(f"how many of {p} numbers show: {name}", rank)

    for name, off in off_library().items():
        lab.check(f"|{name} - the library's|", off)

    lab.step("3. A pendulum with five parameters: the condition number of its motion")
    print("  amplitude, rad   one sine   and 0.2 of a second sine")
    for reach in (0.1, 0.3, 0.6):
        _, alone = rank_and_condition(pendulum(reach, 0.0), RTOL)
        _, both = rank_and_condition(pendulum(reach, 0.2), RTOL)
        print(f"  {reach:14.1f}{alone:11,.0f}{both:24,.0f}")

    lab.step("4. Fits to the torques of an unknown robot, N m")
    robot = day8_mujoco.changed(model, ROBOT_SEED)
    # MuJoCo's dry friction changes its sign late; mujoco.mj_inverse shows how late.
    turns = day8_mujoco.turning_speed(model, HARD)
    lab.measured("up to which speed dry friction has the wrong sign, rad/s", turns)
    # Each fit is tested on states that it was not fitted to, without the slow rows ...
    new = np.abs(elsewhere.qd) > SLOW
    Y_new = Y_elsewhere[new]
    truth = mujoco_torques(robot, elsewhere)[new]
    print("  fitted to           rank    condition  residual  test error    sigma"
          "  within")  # fmt: skip
    # ... first a fit to Day 5's swing, from torques with noise, without the slow rows,
    swing = day8_mujoco.swing()
    tau_swing = mujoco_torques(robot, swing) + NOISE * rng.normal(size=swing.q.shape)
    fast = np.abs(swing.qd) > SLOW
    Y_swing = regressor(arm, swing)[fast]
    judged("Day 5's swing", Y_swing, tau_swing[fast], Y_new, truth, RTOL)
    # then the same fit truncated, which depends on the unit of length,
    for name, per_metre in (("m", 1.0), ("dm", 10.0), ("cm", 100.0)):
        unit = lengths(per_metre)
        judged(f"  truncated, in {name}", Y_swing / unit, tau_swing[fast],
               Y_new / unit, truth, CUT)  # fmt: skip
    # then fits to a motion that was designed to excite all parameters,
    excited = day8_mujoco.excitation(robot, ROBOT_SEED)
    tau = mujoco_torques(robot, excited) + NOISE * rng.normal(size=excited.q.shape)
    Y = regressor(arm, excited)
    fast = np.abs(excited.qd) > SLOW
    judged("excitation, 10 samples", Y[::20][fast[::20]], tau[::20][fast[::20]],
           Y_new, truth, RTOL)  # fmt: skip
    off, inside = judged("excitation", Y[fast], tau[fast], Y_new, truth, RTOL)
    phi = truncated_svd_fit(Y[fast], tau[fast], RTOL)
    # and a fit to your own motion: FAR, OFTEN and BEGIN at the top of this file.
    own = day8_mujoco.harmonics(robot, OFTEN, FAR, BEGIN)
    tau_own = mujoco_torques(robot, own) + NOISE * rng.normal(size=own.q.shape)
    fast = np.abs(own.qd) > SLOW
    Y_own = regressor(arm, own)[fast]
    judged("your two harmonics", Y_own, tau_own[fast], Y_new, truth, RTOL)
    print(f"  the model file's parameters{rms(Y_new @ phi_file - truth):33.2f}")
    lab.record("fit", off, metric="new_rms_nm", seed=ROBOT_SEED,
               label="test error of the excitation's fit, N m")  # fmt: skip
    lab.record("fit", inside, metric="inside_95", seed=ROBOT_SEED,
               label="fraction of the test torques within 1.96 sigma")  # fmt: skip

    lab.step("5. The payload, and the rise of the hand in 2 s of floating")
    weigh_the_load(lab, robot, arm, phi, rng)

    lab.step("6. Side quest: physical consistency of the fitted parameters")
    with lab.side_quest():
        # The fitted links, which need not be able to exist, and the file's, which are.
        both = np.concatenate([phi[:70], phi_file[:70]]).reshape(14, 10)
        off = [
            min_pseudo_inertia_eig(x) for x in both
        ] - library.min_pseudo_inertia_eig(both)
        found = library.min_pseudo_inertia_eig(both[:7])
        lab.check("|min_pseudo_inertia_eig - the library's|", off)
        print(f"  smallest eigenvalue of the fitted links: {found.min():.2f}")
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
