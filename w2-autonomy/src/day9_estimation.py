"""Day 9: encoders, a Kalman filter with two tests, and a momentum observer.

    make day9                       in the clone: sets all up, then runs this
    python src/day9_estimation.py   in w2-autonomy/, once that is done

Time runs along the first axis. Twists are (omega; v), wrenches (moment; force), both
expressed in the world frame. Metres, radians, seconds, kilograms, N m.
"""

import kit  # noqa: F401 (goes on in the kit's own Python)
import mujoco
import numpy as np

from robo47 import cli, panda, verify
from robo47 import estimation as library
from robo47.lesson.lab import Lab
from robo47.screws import ad

import day9_mujoco
from day9_mujoco import FLANGE, OMEGA, RATE, STAY, SWING

SEED = 9  # for noise and random states; the same at every run
TRIALS = 20  # random states at which the energy's gradient is compared
DT = 1.0 / RATE  # s, the sampling period
BITS = 16  # of the encoder that is filtered; one more bit halves its error
JOINT = 3  # the index of joint4, whose velocity is filtered
LATE = (0.030, 0.032, 0.034)  # s, the delays of the readings
SETTLED = 50  # samples that are left out while a filter converges
# The simulated joint of step 4: the power spectral density of its acceleration,
# rad^2/s^3, the standard deviation of its readings, rad, and their number.
WANDERS, NOISE, SAMPLES = 0.5, 1e-4, 2000
GAIN = 50.0  # 1/s, of the observer; unstable from 2 / DT on
THRESHOLD = 0.5  # N m; below 0.01 the observer's own error is reported as a contact
FORCE = np.array([0.0, 0.0, -10.0])  # N, on the flange
SINCE = 0.3  # s, when the push begins
GRADIENTS = (  # of the energy: the factor with which the observer uses it
    ("with the gradient", 1),
    ("without the gradient", 0),
    ("with the gradient negated", -1),
)
PUSHES = (  # the body or site that the side quest pushes, and the force, N
    (FLANGE, (0, 0, -10)),
    (FLANGE, (0, 20, 0)),
    ("link4", (0, 0, -20)),
    ("link4", (0, 20, 0)),
    ("link2", (0, 20, 0)),
)


def rms(x: np.ndarray) -> float:
    """Return the root of the mean square."""
    return np.sqrt(np.mean(np.square(x)))


def quantise(q: np.ndarray, counts: float) -> np.ndarray:
    """Return the angles (7,), rad, that an encoder reports: the nearest whole counts.

    q (7,) are the true angles, rad, and counts is the number of counts in a full
    revolution, so one count is 2 pi / counts.
    quantise([0.1], 4096) -> [0.0997088], which is 65 counts.
    """
    # region 9.1
    step = 2.0 * np.pi / counts  # the angle of one count
    return np.round(q / step) * step  # the angle of the whole counts
    # endregion 9.1


def backward_difference(q: np.ndarray, dt: float) -> np.ndarray:
    """Return the backward difference (n,) of samples, rad/s; the first velocity is 0.

    q (n,) are angles, rad, and dt is the sampling period, s. Entry k is the change
    since sample k - 1 divided by dt; no sample precedes the first.
    backward_difference([0, 0.1, 0.3], 0.1) -> [0, 1, 2]
    """
    # region 9.1
    return np.append(0.0, np.diff(q) / dt)  # the first 0 and the differences over dt
    # endregion 9.1


def delay_margin(kp: float, kd: float) -> float:
    """Return the delay margin of a PD loop on a unit mass, in seconds.

    kp, 1/s^2, and kd, 1/s, are its gains: the loop is e'' = -kp e - kd e', and with a
    longer delay of its readings it is unstable. The margin is the phase lead
    atan(kd w / kp) divided by the gain crossover frequency w, where
    w^4 = kp^2 + kd^2 w^2 (Astrom and Murray, Feedback Systems).
    delay_margin(400, 40) -> 0.03237. With critical damping it is 0.6474 / omega.
    """
    # region 9.2
    w = np.sqrt(  # the gain crossover frequency
        (kd**2 + np.sqrt(kd**4 + 4.0 * kp**2)) / 2.0
    )
    return np.arctan(kd * w / kp) / w  # the phase lead divided by w
    # endregion 9.2


def low_pass(x: np.ndarray, dt: float, cutoff: float) -> np.ndarray:
    """Return samples (n,) behind a first-order low pass, which starts at x[0].

    x (n,) are the samples, dt is the sampling period, s, and cutoff the cutoff
    frequency, Hz: y += alpha (x - y) with alpha = 1 - exp(-2 pi cutoff dt).
    low_pass([0, 1, 1, 1], 0.002, 20) -> [0, 0.22223, 0.39508, 0.52951]
    """
    # region 9.3
    alpha = 1.0 - np.exp(-2.0 * np.pi * cutoff * dt)  # the weight of the new sample
    y = [x[0]]  # the outputs, from the first sample on
    for now in x[1:]:
        y.append(y[-1] + alpha * (now - y[-1]))  # the step towards the new sample
    return np.array(y)  # the outputs
    # endregion 9.3


def constant_velocity(dt: float, accel_psd: float) -> tuple[np.ndarray, np.ndarray]:
    """Return F and Q, (2, 2) each, of the constant-velocity model over dt.

    The state is (angle; velocity). dt is the sampling period, s; accel_psd is the power
    spectral density of the white acceleration, rad^2/s^3, which alone changes the
    velocity. F maps the state to the next one, and Q is accel_psd times the integral
    of (s, 1) (s, 1)^T over s from 0 to dt (Bar-Shalom and others, chapter 6).
    constant_velocity(1, 3) -> ([[1, 1], [0, 1]], [[1, 1.5], [1.5, 3]])
    """
    # region 9.4
    F = np.array([[1.0, dt], [0.0, 1.0]])  # the transition matrix
    Q = accel_psd * np.array(  # the integrals of s^2, s and 1
        [[dt**3 / 3.0, dt**2 / 2.0], [dt**2 / 2.0, dt]]
    )
    return F, Q  # the transition matrix and the noise's covariance
    # endregion 9.4


def kalman_predict(
    x: np.ndarray, P: np.ndarray, F: np.ndarray, Q: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the Kalman filter's predicted state x (2,) and covariance P (2, 2).

    x (2,) is the estimate and P (2, 2) the covariance of its error; F (2, 2) maps the
    state to the next one, and Q (2, 2) is the covariance of the process noise.
    x = (0, 1), P = 1, F and Q of 1 s and 3: (1, 1) and [[3, 2.5], [2.5, 4]].
    """
    # region 9.4
    return F @ x, F @ P @ F.T + Q  # the predicted state and its covariance
    # endregion 9.4


def kalman_update(
    x: np.ndarray, P: np.ndarray, z: np.ndarray, H: np.ndarray, R: np.ndarray
) -> tuple[np.ndarray, np.ndarray, float]:
    """Return the Kalman filter's updated x (n,), P (n, n) and the NIS, a number.

    x (n,) is the predicted state and P (n, n) its covariance; z (m,) is the reading,
    H (m, n) the measurement matrix and R (m, m) the covariance of the reading's noise.
    The NIS (normalised innovation squared) is y . S^-1 y, with the innovation
    y = z - H x and its covariance S. x = 0, P = [[2, 1], [1, 2]], z = 3 of the first,
    R = 1: (2, 1), [[2/3, 1/3], [1/3, 5/3]] and 3.
    """
    # region 9.5
    y = z - H @ x  # the innovation
    S = H @ P @ H.T + R  # the covariance of the innovation
    inverse = np.linalg.inv(S)  # the inverse of S
    K = P @ H.T @ inverse  # the Kalman gain
    return x + K @ y, P - K @ S @ K.T, y @ inverse @ y  # state, covariance and NIS
    # endregion 9.5


def nis_interval(n: int, m: int) -> np.ndarray:
    """Return the interval (low, high) that holds the mean of n NIS with 95 %.

    m is the number of entries of a reading. n times the mean has the chi-square
    distribution with n m degrees of freedom: take 1.96 standard deviations of its cube
    root, which is nearly Gaussian (Wilson and Hilferty, 1931).
    nis_interval(1950, 1) -> [0.93821, 1.06374]
    """
    # region 9.6
    c = 2.0 / (9.0 * n * m)  # the variance of the cube root of chi-square / (n m)
    off = 1.96 * np.sqrt(c)  # the half-width of the interval
    return m * np.array([1.0 - c - off, 1.0 - c + off]) ** 3  # the interval's endpoints
    # endregion 9.6


def lag1_autocorrelation(y: np.ndarray) -> float:
    """Return the lag-1 autocorrelation of y (n,), which is near 0 for white noise.

    Subtract the mean, then divide the sum of the products of neighbours by the sum of
    all n squares.
    lag1_autocorrelation([1, -1, 1, -1]) -> -0.75
    """
    # region 9.7
    y = y - np.mean(y)  # the sequence without its mean
    return y[1:] @ y[:-1] / (y @ y)  # the sum of products over the sum of squares
    # endregion 9.7


def kinetic_energy_gradient(
    J_space: np.ndarray, G: np.ndarray, qd: np.ndarray
) -> np.ndarray:
    """Return the gradient dE/dq (7,) of the kinetic energy at constant qd, N m.

    J_space (6, 7) is the space Jacobian, whose columns are the screws S_i; G (7, 6, 6)
    are the links' spatial inertias about the world's origin, expressed in the world
    frame; qd (7,) are the joint velocities, rad/s. Rotating joint i rotates the links
    i to 7; seen from them, the twist V_i changes by -ad(S_i) V_i per radian. At rest 0.
    """
    # region 9.8
    S = J_space.T  # the screw of each joint
    V = np.cumsum(S * qd[:, None], axis=0)  # the twist of each link
    momentum = (G @ V[:, :, None])[:, :, 0]  # the momentum of each link
    carried = np.cumsum(momentum[::-1], axis=0)[::-1]  # the momentum of links i to 7
    turned = (ad(S) @ V[:, :, None])[:, :, 0]  # the product ad(S_i) V_i
    return -np.sum(carried * turned, axis=1)  # the gradient of the kinetic energy
    # endregion 9.8


def momentum_observer_step(
    residual: np.ndarray, integral: np.ndarray, momentum: np.ndarray, tau: np.ndarray,
    energy_grad: np.ndarray, gravity: np.ndarray, damping: np.ndarray, qd: np.ndarray,
    gain: float, dt: float,
) -> tuple[np.ndarray, np.ndarray]:  # fmt: skip
    """Return the residual (7,), N m, and the integral (7,) of the momentum observer.

    residual and integral (7,) are of the sample before; momentum (7,), kg m^2/s, is
    M qd of now. All others are of the sample before: the commanded torque tau, the
    kinetic energy's gradient energy_grad, the torque gravity that holds the arm, N m,
    the joints' damping, N m s/rad, and the velocities qd, rad/s, (7,) each. gain is in
    1/s, dt in s. First the integral advances, by dt times the known torques plus the
    residual; the residual is gain (momentum - integral). It follows the external torque
    as a first-order low pass (De Luca and Mattone, 2005). All zero but momentum = 1,
    gain 50: 50 and 0.
    """
    # region 9.9
    known = (  # the known torque of the previous sample
        tau + energy_grad - gravity - damping * qd
    )
    integral = integral + (known + residual) * dt  # the momentum without the contact
    return gain * (momentum - integral), integral  # the residual and the integral
    # endregion 9.9


def contact_link(residual: np.ndarray, threshold: np.ndarray) -> int:
    """Return the contact link, 1 to 7: the last joint over its threshold, 0 if none is.

    residual and threshold are (7,), N m; a residual of either sign counts.
    contact_link([0, 3, 0, -5, 0, 0, 0], [1, 1, 1, 1, 1, 1, 1]) -> 4
    """
    # region 9.10
    felt = np.flatnonzero(np.abs(residual) > threshold)  # the joints over the threshold
    return int(felt[-1]) + 1 if len(felt) else 0  # the last joint, counted from 1
    # endregion 9.10


def speeds(q: np.ndarray) -> np.ndarray:
    """Return the backward differences of seven joints, rad/s, (n, 7)."""
    return np.transpose([backward_difference(one, DT) for one in q.T])


def encoder(q: np.ndarray, bits: int) -> np.ndarray:
    """Return a motion as encoders with so many bits report it, rad, (n, 7)."""
    return np.array([quantise(one, 2**bits) for one in q])


def track(z: np.ndarray, accel_psd: float, R: float) -> dict[str, np.ndarray]:
    """Run a Kalman filter over readings (n,) and return its output once converged.

    The output has the estimated velocity, rad/s, the standard deviation sigma that the
    filter reports for it, the NIS, and the innovations, rad.
    """
    F, Q = constant_velocity(DT, accel_psd)
    H, R_matrix = np.array([[1.0, 0.0]]), np.array([[R]])
    x, P = np.array([z[0], 0.0]), np.diag([R, 1.0])
    rows = []
    for now in z[1:]:
        x, P = kalman_predict(x, P, F, Q)
        innovation = now - x[0]
        x, P, nis = kalman_update(x, P, np.array([now]), H, R_matrix)
        rows.append([x[1], np.sqrt(P[1, 1]), nis, innovation])
    names = ("velocity", "sigma", "nis", "innovation")
    return dict(zip(names, np.transpose(rows[SETTLED - 1 :]), strict=True))


def wandering(rng) -> tuple[np.ndarray, np.ndarray]:
    """Return readings and true velocities of a joint with a white acceleration."""
    F, Q = library.constant_velocity(DT, WANDERS)
    kicks = rng.multivariate_normal(np.zeros(2), Q, SAMPLES, method="cholesky")
    x = np.zeros(2)
    states = []
    for kick in kicks:
        x = F @ x + kick
        states.append(x)
    q, qd = np.transpose(states)
    return q + NOISE * rng.normal(size=SAMPLES), qd


def tested(
    name: str, z: np.ndarray, qd: np.ndarray, accel_psd: float, R: float
) -> dict[str, float]:
    """Print and return the error of a filter, and the results of its two tests."""
    output = track(z, accel_psd, R)
    error = output["velocity"] - qd[SETTLED:]
    low, high = nis_interval(len(error), 1)
    nis = np.mean(output["nis"])
    found = {
        "error": rms(error),
        "sigma": rms(output["sigma"]),
        "nis": nis,
        "lag1": lag1_autocorrelation(output["innovation"]),
        "inside": np.mean(np.abs(error) < 1.96 * output["sigma"]),
    }
    verdict = "yes" if low < nis < high else "no"
    print(f"  {name:24}{found['error']:8.4f} {found['sigma']:8.4f} {nis:7.3f}"
          f" {verdict:>4} {found['lag1']:z7.3f}"
          f" {found['inside']:7.1%}")  # fmt: skip
    return found


class Observer:
    """A momentum observer of an arm, which is called once per sample.

    share is the factor of the energy's gradient: 1, or a mistake to be measured.
    """

    def __init__(self, arm, share: float = 1.0) -> None:
        """Begin with a residual of zero."""
        self.arm, self.share = arm, share
        self.residual = np.zeros(7)
        self.before = None  # tau, gradient, gravity, damping and qd of the last sample

    def feel(self, now, qd: np.ndarray) -> np.ndarray:
        """Return the residual of this sample, N m, (7,)."""
        p = now.M @ qd
        if self.before is None:
            self.integral = p
        else:
            self.residual, self.integral = momentum_observer_step(
                self.residual, self.integral, p, *self.before, GAIN, DT
            )
        return self.residual

    def commanded(self, now, qd: np.ndarray, tau: np.ndarray) -> None:
        """Store the torques that are commanded from now on, N m, (7,)."""
        gradient = self.share * kinetic_energy_gradient(now.J_space, now.G, qd)
        self.before = tau, gradient, now.gravity_torque, self.arm.damping, qd


def felt(arm, run, share: float = 1.0) -> np.ndarray:
    """Return the residual at each sample of a run, N m, (n, 7)."""
    observer = Observer(arm, share)
    found = []
    for q, qd, tau in zip(run.q, run.qd, run.tau, strict=False):
        now = arm.at(q)
        found.append(observer.feel(now, qd))
        observer.commanded(now, qd, tau)
    return np.array(found)


def mujoco_slope(model, q: np.ndarray, qd: np.ndarray) -> np.ndarray:
    """Return finite differences of MuJoCo's kinetic energy, 4th order, (7,), N m."""
    data = mujoco.MjData(model)

    def kinetic(at: np.ndarray) -> float:
        data.qpos[:] = at
        data.qvel[:] = qd
        mujoco.mj_forward(model, data)
        mujoco.mj_energyVel(model, data)  # fills energy[1]
        return data.energy[1]

    h = 1e-3
    slopes = []
    for e in h * np.eye(7):
        near = kinetic(q + e) - kinetic(q - e)
        far = kinetic(q + 2 * e) - kinetic(q - 2 * e)
        slopes.append((8 * near - far) / (12 * h))
    return np.array(slopes)


def mujoco_external_torque(
    model, q: np.ndarray, name: str, force: np.ndarray
) -> np.ndarray:
    """Return the joint torques J^T F of a force by mj_applyFT, N m, (7,)."""
    data = mujoco.MjData(model)
    data.qpos[:] = q
    mujoco.mj_forward(model, data)
    day9_mujoco.torque_of(model, data, name, force)  # mujoco.mj_applyFT
    return data.qfrc_applied.copy()


def off_library() -> dict[str, np.ndarray]:
    """Return the differences from robo47's functions: MuJoCo contains no filters."""
    rng = np.random.default_rng(SEED)
    x, z, y = rng.normal(size=3), rng.normal(size=2), rng.normal(size=40)
    left, right = rng.normal(size=(3, 3)), rng.normal(size=(2, 2))
    P, R = left @ left.T + np.eye(3), right @ right.T + np.eye(2)
    H, F, Q = rng.normal(size=(2, 3)), rng.normal(size=(2, 2)), P[:2, :2]
    six, damping = rng.normal(size=(6, 7)), rng.uniform(1, 2, 7)
    given = {
        "quantise": (quantise, [(six[0], 4096), (six[1], 1000)]),
        "backward_difference": (backward_difference, [(y, DT)]),
        "delay_margin": (delay_margin, [(400.0, 40.0), (90.0, 7.0)]),
        "low_pass": (low_pass, [(y, DT, 20.0)]),
        "constant_velocity": (constant_velocity, [(DT, WANDERS), (0.3, 2.0)]),
        "kalman_predict": (kalman_predict, [(x[:2], R, F, Q)]),
        "kalman_update": (kalman_update, [(x, P, z, H, R)]),
        "nis_interval": (nis_interval, [(1950, 1), (100, 3)]),
        "lag1_autocorrelation": (lag1_autocorrelation, [(y,), (np.cumsum(y),)]),
        "momentum_observer_step": (
            momentum_observer_step,
            [(*six, damping, x[0] + six[0], GAIN, DT)],
        ),
    }
    found = {}
    for name, (own, calls) in given.items():
        ours = np.concatenate([flat(own(*one)) for one in calls])
        truth = np.concatenate([flat(getattr(library, name)(*one)) for one in calls])
        found[name] = (ours - truth) / max(1.0, np.abs(truth).max())
    return found


def flat(answer) -> np.ndarray:
    """Return all numbers of a result, which may be a tuple, in one row."""
    parts = answer if isinstance(answer, tuple) else (answer,)
    return np.concatenate([np.ravel(part) for part in parts])


def notices(residual: np.ndarray) -> float:
    """Return the detection time: from the push until a joint is over THRESHOLD, ms."""
    over = (np.abs(residual) > THRESHOLD).any(axis=1)
    return 1000 * (np.argmax(over) * DT - SINCE) if over.any() else np.inf


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    model = panda.load("panda_nohand", drive="torque")
    arm = panda.arm(model)
    rng = np.random.default_rng(SEED)
    print(panda.describe("panda_nohand"))

    lab.step("1. Encoder readings of a swing, and their backward difference")
    swing = day9_mujoco.moved(model, arm, SWING, 2.0)  # mujoco.mj_step, 1000 times
    # swing.q and swing.qd are MuJoCo's own qpos and qvel.
    lab.check("|difference of q - MuJoCo's qvel|, rad/s",
              speeds(swing.q)[1:] - swing.qd[1:])  # fmt: skip
    print("  bits      step, rad   predicted RMS    measured   largest / (step / dt)")
    for bits in (12, 14, 16, 18):
        step = 2 * np.pi / 2**bits
        off = speeds(encoder(swing.q, bits))[1:] - swing.qd[1:]
        predicted = step / np.sqrt(6) / DT
        print(f"  {bits:4}{step:15.3e}{predicted:16.4f}{rms(off):12.4f}"
              f"{np.abs(off).max() / (step / DT):24.2f}")  # fmt: skip
        if bits == BITS:
            lab.record("encoder", rms(off) / predicted - 1.0,
                       label="16 bits: measured / predicted - 1")  # fmt: skip
            lab.measured("noise of a 16-bit difference, rad/s", rms(off))
    for name, off in off_library().items():
        lab.check(f"{name} - the library's", off)

    lab.step("2. Readings that are late: fraction of an error that is left after 2 s")
    margin = delay_margin(OMEGA**2, 2 * OMEGA)
    print(f"  delay margin {1000 * margin:.2f} ms; minus half a control period:"
          f" {1000 * (margin - DT / 2):.2f} ms")  # fmt: skip
    for late in LATE:
        left = day9_mujoco.left_over(model, arm, late, OMEGA)  # mujoco.mj_step
        print(f"  delay {1000 * late:.0f} ms: {left:.3g}")

    lab.step("3. Low pass of the 16-bit velocity of joint 4: RMS error, rad/s")
    z, qd = encoder(swing.q, BITS)[:, JOINT], swing.qd[:, JOINT]
    raw = backward_difference(z, DT)
    print("  cutoff              error   lag alone")
    print(f"  no filter{rms(raw[SETTLED:] - qd[SETTLED:]):16.4f}")
    for cutoff in (5.0, 10.0, 20.0, 50.0, 100.0):
        off = low_pass(raw, DT, cutoff) - qd
        lag = low_pass(qd, DT, cutoff) - qd
        print(f"  {cutoff:5.0f} Hz{rms(off[SETTLED:]):17.4f}{rms(lag[SETTLED:]):12.4f}")

    lab.step("4. Kalman filters: RMS error of the velocity, rad/s, and two tests")
    columns = "   error    sigma     NIS   in   lag 1  inside"
    print(f"  {'simulated joint':24}{columns}")
    readings, truth = wandering(rng)
    found = tested("correct", readings, truth, WANDERS, NOISE**2)
    for name, accel_psd, R in (
        ("accel_psd / 100", WANDERS / 100, NOISE**2),
        ("accel_psd / 10, R x 10", WANDERS / 10, 10 * NOISE**2),
    ):
        tested(name, readings, truth, accel_psd, R)
    lab.record("kalman", abs(found["nis"] - 1.0), label="|mean NIS - 1|", seed=SEED)
    lab.check("|lag-1 autocorrelation| of 1950 innovations", found["lag1"],
              2 * 1.96 / np.sqrt(SAMPLES - SETTLED))  # fmt: skip
    print(f"  {'joint 4 in the swing':24}{columns}")
    R = (2 * np.pi / 2**BITS) ** 2 / 12  # the variance of the rounding error
    for accel_psd in (0.001, 0.01, 0.1, 1.0):
        tested(f"accel_psd = {accel_psd:g}", z, qd, accel_psd, R)

    lab.step("5. The momentum observer in free motion")
    off = []
    for q in verify.random_q(model, TRIALS, SEED):
        now, qd = arm.at(q), rng.uniform(-2, 2, 7)
        off.append(
            kinetic_energy_gradient(now.J_space, now.G, qd) - mujoco_slope(model, q, qd)
        )
    lab.record(
        "slope_by_hand",
        off,
        label="|kinetic_energy_gradient - MuJoCo's|, N m",
        seed=SEED,
    )
    print("  largest residual in the swing, without a contact, N m")
    way = swing._replace(q=swing.q[:500], qd=swing.qd[:500], tau=swing.tau[:500])
    for name, share in GRADIENTS:
        residual = np.abs(felt(arm, way, share)).max()
        print(f"  {name:28}{residual:8.3f}")
        if share == 1:
            lab.record("free_motion", residual, label="residual with the gradient, N m")

    lab.step("6. A push of 10 N on the flange of an arm at rest, N m")
    push = day9_mujoco.push(FLANGE, FORCE, SINCE)
    held = day9_mujoco.moved(model, arm, STAY, 0.8, push)
    truth = mujoco_external_torque(model, held.q[-1], FLANGE, FORCE)
    lab.show("J^T F, by mujoco.mj_applyFT", truth, 3)
    for name, share in GRADIENTS:
        residual = felt(arm, held, share)
        lab.show(f"residual {name}", residual[-1], 3)
        if share == 1:
            late = notices(residual)
            lab.check("|residual - J^T F|, N m", residual[-1] - truth, 0.01)
            lab.record("push_noticed", late, label="detection time, ms")
            lab.measured("detection time of a 10 N push, ms", late)
            lab.measured("residual of joint 4, N m", residual[-1][JOINT])

    lab.step("7. Side quest: which link was touched?")
    with lab.side_quest():
        rows = rng.normal(size=(20, 7)) * rng.uniform(0, 2, (20, 1))
        limits = rng.uniform(0.5, 1.5, (20, 7))
        pairs = list(zip(rows, limits, strict=True))
        off = [contact_link(*one) - library.contact_link(*one) for one in pairs]
        lab.check("contact_link - the library's", off)
        print("  pushed at, N            contact link   detected, ms   moves on, mm")
        limit = np.full(7, THRESHOLD)
        for name, force in PUSHES:
            push = day9_mujoco.push(name, force, SINCE)
            observer = Observer(arm)
            found = day9_mujoco.stopped(
                model, arm, observer, lambda r: contact_link(r, limit), push
            )  # mujoco.mj_step
            after = 1000 * (found.t - SINCE)
            words = f"{name}, {force}"
            print(f"  {words:30}{found.link:6}{after:15.0f}{found.moves_on:15.1f}")
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
