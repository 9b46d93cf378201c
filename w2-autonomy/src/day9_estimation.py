"""Day 9: what the arm can feel. Encoders, a filter that is tested, and a push.

    make day9                       in the clone: sets all up, then runs this
    python src/day9_estimation.py   in w2-autonomy/, once that is done

Time runs along the first axis. Twists (omega; v), wrenches (moment; force). Metres,
radians, seconds, kilograms, N m.
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

SEED = 9  # of noise and of random states
TRIALS = 20  # random states that the energy's slope is judged at
DT = 1.0 / RATE  # s, from sample to sample
BITS = 16  # of the encoder that is filtered; one bit more halves its error
JOINT = 3  # joint4 is the one whose speed is filtered
LATE = (0.030, 0.032, 0.034)  # s; how late readings are
SETTLED = 50  # samples that a filter has to settle
# The joint of step 4: the intensity of its acceleration's noise, rad^2/s^3, that of
# its readings, rad, and how many there are.
WANDERS, NOISE, SAMPLES = 0.5, 1e-4, 2000
GAIN = 50.0  # 1/s, of the observer; 2 / DT and more blows up
THRESHOLD = 0.5  # N m; under 0.01 the observer's own error is taken for a push
FORCE = np.array([0.0, 0.0, -10.0])  # N, on the flange, ...
SINCE = 0.3  # ... from this second on
PUSHES = (  # what the demo pushes, and with how many newtons
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
    """Return what an encoder with so many counts a turn says of q, (7,), in radians.

    Of 0.1 rad one with 4096 counts says 0.0997088: 65 counts.
    """
    # region 9.1
    step = 2.0 * np.pi / counts
    return np.round(q / step) * step
    # endregion 9.1


def backward_difference(q: np.ndarray, dt: float) -> np.ndarray:
    """Return the speed, (n,), by the sample before; the first, which has none, is 0.

    q is (n,), dt in seconds. Of (0, 0.1, 0.3) at 0.1 s: (0, 1, 2).
    """
    # region 9.1
    return np.append(0.0, np.diff(q) / dt)
    # endregion 9.1


def delay_margin(kp: float, kd: float) -> float:
    """Return how late a spring and a damper may act before they shake, in seconds.

    400 1/s^2 and 40 1/s: 0.03237. Critically damped it is 0.6474 / omega.
    """
    # region 9.2
    w = np.sqrt((kd**2 + np.sqrt(kd**4 + 4.0 * kp**2)) / 2.0)
    return np.arctan(kd * w / kp) / w
    # endregion 9.2


def low_pass(x: np.ndarray, dt: float, cutoff: float) -> np.ndarray:
    """Return x, (n,), smoother and later; it starts at x[0], the cutoff is in Hz.

    (0, 1, 1, 1) at 0.002 s through 20 Hz: (0, 0.22223, 0.39508, 0.52951).
    """
    # region 9.3
    alpha = 1.0 - np.exp(-2.0 * np.pi * cutoff * dt)
    y = [x[0]]
    for now in x[1:]:
        y.append(y[-1] + alpha * (now - y[-1]))
    return np.array(y)
    # endregion 9.3


def constant_velocity(dt: float, accel_psd: float) -> tuple[np.ndarray, np.ndarray]:
    """Return F and Q, (2, 2) each, of an angle whose acceleration is white noise.

    accel_psd is its intensity, rad^2/s^3. 1 s and 3: [[1, 1], [0, 1]] and
    [[1, 1.5], [1.5, 3]].
    """
    # region 9.4
    F = np.array([[1.0, dt], [0.0, 1.0]])
    Q = accel_psd * np.array([[dt**3 / 3.0, dt**2 / 2.0], [dt**2 / 2.0, dt]])
    return F, Q
    # endregion 9.4


def kalman_predict(
    x: np.ndarray, P: np.ndarray, F: np.ndarray, Q: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return what is believed a moment later: x, (2,), and its covariance, (2, 2).

    (0, 1), P = 1, F and Q as above: (1, 1) and [[3, 2.5], [2.5, 4]].
    """
    # region 9.4
    return F @ x, F @ P @ F.T + Q
    # endregion 9.4


def kalman_update(
    x: np.ndarray, P: np.ndarray, z: np.ndarray, H: np.ndarray, R: np.ndarray
) -> tuple[np.ndarray, np.ndarray, float]:
    """Return x, (n,), P, (n, n), after a reading z, (m,), and its NIS, how surprising.

    H is (m, n), R (m, m). x = 0, P = [[2, 1], [1, 2]], z = 3 of the first, R = 1:
    (2, 1), [[2/3, 1/3], [1/3, 5/3]] and 3.
    """
    # region 9.5
    y = z - H @ x
    S = H @ P @ H.T + R
    inverse = np.linalg.inv(S)
    K = P @ H.T @ inverse
    return x + K @ y, P - K @ S @ K.T, y @ inverse @ y
    # endregion 9.5


def nis_interval(n: int, m: int) -> np.ndarray:
    """Return the two numbers between which a mean of n NIS lies, 95 times in 100.

    m is the size of a reading; take 1.96 sigma. 1950 of one: (0.93821, 1.06374).
    """
    # region 9.6
    c = 2.0 / (9.0 * n * m)
    off = 1.96 * np.sqrt(c)
    return m * np.array([1.0 - c - off, 1.0 - c + off]) ** 3
    # endregion 9.6


def lag1_autocorrelation(y: np.ndarray) -> float:
    """Return how much each of y, (n,), looks like the one before: 0 for white noise.

    (1, -1, 1, -1): -0.75.
    """
    # region 9.7
    y = y - np.mean(y)
    return y[1:] @ y[:-1] / (y @ y)
    # endregion 9.7


def kinetic_energy_gradient(
    J_space: np.ndarray, G: np.ndarray, qd: np.ndarray
) -> np.ndarray:
    """Return how the kinetic energy changes with each angle, (7,), in N m.

    J_space is (6, 7), G (7, 6, 6) the links' inertias in the world, qd (7,). At rest 0.
    """
    # region 9.8
    S = J_space.T
    V = np.cumsum(S * qd[:, None], axis=0)  # the twist of each link
    momentum = (G @ V[:, :, None])[:, :, 0]
    carried = np.cumsum(momentum[::-1], axis=0)[::-1]  # of link i and all after it
    turned = (ad(S) @ V[:, :, None])[:, :, 0]
    return -np.sum(carried * turned, axis=1)
    # endregion 9.8


def momentum_observer_step(
    residual: np.ndarray, integral: np.ndarray, momentum: np.ndarray, tau: np.ndarray,
    energy_grad: np.ndarray, gravity: np.ndarray, damping: np.ndarray, qd: np.ndarray,
    gain: float, dt: float,
) -> tuple[np.ndarray, np.ndarray]:  # fmt: skip
    """Return the torque that nobody commanded, (7,), and the next integral, (7,).

    momentum is the momentum M qd now, the rest is of the sample before. All zero but
    momentum = 1, gain 50: 50 and 0.
    """
    # region 9.9
    known = tau + energy_grad - gravity - damping * qd
    integral = integral + (known + residual) * dt
    return gain * (momentum - integral), integral
    # endregion 9.9


def contact_link(residual: np.ndarray, threshold: np.ndarray) -> int:
    """Return the last joint that feels a push, from 1 to 7; 0 where none does.

    residual and threshold are (7,), N m. Only joint 4 over its threshold: 4.
    """
    # region 9.10
    felt = np.flatnonzero(np.abs(residual) > threshold)
    return int(felt[-1]) + 1 if len(felt) else 0
    # endregion 9.10


def speeds(q: np.ndarray) -> np.ndarray:
    """Return the differences of seven joints, rad/s, (n, 7)."""
    return np.transpose([backward_difference(one, DT) for one in q.T])


def encoder(q: np.ndarray, bits: int) -> np.ndarray:
    """Return what encoders of so many bits say of a motion, rad, (n, 7)."""
    return np.array([quantise(one, 2**bits) for one in q])


def track(z: np.ndarray, q: float, R: float) -> dict[str, np.ndarray]:
    """Run a filter over readings, (n,), and return what it said once it had settled.

    Its speed, rad/s, the sigma that it claims for it, NIS, and surprises in rad.
    """
    F, Q = constant_velocity(DT, q)
    H, R_matrix = np.array([[1.0, 0.0]]), np.array([[R]])
    x, P = np.array([z[0], 0.0]), np.diag([R, 1.0])
    said = []
    for now in z[1:]:
        x, P = kalman_predict(x, P, F, Q)
        surprise = now - x[0]
        x, P, nis = kalman_update(x, P, np.array([now]), H, R_matrix)
        said.append([x[1], np.sqrt(P[1, 1]), nis, surprise])
    names = ("speed", "sigma", "nis", "surprise")
    return dict(zip(names, np.transpose(said[SETTLED - 1 :]), strict=True))


def wandering(rng) -> tuple[np.ndarray, np.ndarray]:
    """Return a joint that is just what a filter takes it for: readings and speeds."""
    F, Q = library.constant_velocity(DT, WANDERS)
    kicks = rng.multivariate_normal(np.zeros(2), Q, SAMPLES, method="cholesky")
    x = np.zeros(2)
    states = []
    for kick in kicks:
        x = F @ x + kick
        states.append(x)
    q, qd = np.transpose(states)
    return q + NOISE * rng.normal(size=SAMPLES), qd


def tested(name: str, z: np.ndarray, qd: np.ndarray, q: float, R: float) -> dict:
    """Print and return how wrong a filter is, and what tells without the truth."""
    said = track(z, q, R)
    off = said["speed"] - qd[SETTLED:]
    low, high = nis_interval(len(off), 1)
    nis = np.mean(said["nis"])
    found = {
        "off": rms(off),
        "sigma": rms(said["sigma"]),
        "nis": nis,
        "whiteness": lag1_autocorrelation(said["surprise"]),
        "inside": np.mean(np.abs(off) < 1.96 * said["sigma"]),
    }
    verdict = "yes" if low < nis < high else "no"
    print(f"  {name:20}{found['off']:8.4f} {found['sigma']:8.4f} {nis:7.3f}"
          f" {verdict:>4} {found['whiteness']:z7.3f}"
          f" {found['inside']:7.1%}")  # fmt: skip
    return found


class Observer:
    """A momentum observer beside an arm, asked once a sample.

    share is how much of the energy's slope it takes: 1, or a mistake to be looked at.
    """

    def __init__(self, arm, share: float = 1.0) -> None:
        """Begin with nothing felt."""
        self.arm, self.share = arm, share
        self.residual = np.zeros(7)
        self.before = None  # tau, slope, gravity, damping and qd of the last sample

    def feel(self, now, qd: np.ndarray) -> np.ndarray:
        """Return the residual, N m, (7,), of the arm as it is now."""
        p = now.M @ qd
        if self.before is None:
            self.integral = p
        else:
            self.residual, self.integral = momentum_observer_step(
                self.residual, self.integral, p, *self.before, GAIN, DT
            )
        return self.residual

    def commanded(self, now, qd: np.ndarray, tau: np.ndarray) -> None:
        """Take what the motors get from now on, N m, (7,)."""
        slope = self.share * kinetic_energy_gradient(now.J_space, now.G, qd)
        self.before = tau, slope, now.gravity_torque, self.arm.damping, qd


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
    """Return differences of MuJoCo's kinetic energy, of fourth order, J/rad, (7,)."""
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
    """Return what a force makes in the joints, J^T F by MuJoCo, N m, (7,)."""
    data = mujoco.MjData(model)
    data.qpos[:] = q
    mujoco.mj_forward(model, data)
    day9_mujoco.torque_of(model, data, name, force)  # mujoco.mj_applyFT
    return data.qfrc_applied.copy()


def off_library() -> dict[str, np.ndarray]:
    """Return how far your functions are from robo47's: MuJoCo knows no filters."""
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
    """Return all numbers of an answer, which may have several parts, in one row."""
    parts = answer if isinstance(answer, tuple) else (answer,)
    return np.concatenate([np.ravel(part) for part in parts])


def notices(residual: np.ndarray) -> float:
    """Return how long after the push a joint is over its threshold, ms."""
    over = (np.abs(residual) > THRESHOLD).any(axis=1)
    return 1000 * (np.argmax(over) * DT - SINCE) if over.any() else np.inf


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    model = panda.load("panda_nohand", drive="torque")
    arm = panda.arm(model)
    rng = np.random.default_rng(SEED)
    print(panda.describe("panda_nohand"))

    lab.step("1. What an encoder says of a swing, and what its difference makes of it")
    swing = day9_mujoco.moved(model, arm, SWING, 2.0)  # mujoco.mj_step, 1000 times
    # swing.q and swing.qd are MuJoCo's own qpos and qvel.
    lab.check("|difference of q - MuJoCo's qvel|, rad/s",
              speeds(swing.q)[1:] - swing.qd[1:])  # fmt: skip
    print("  bits      step, rad   predicted    measured     largest, of step / dt")
    for bits in (12, 14, 16, 18):
        step = 2 * np.pi / 2**bits
        off = speeds(encoder(swing.q, bits))[1:] - swing.qd[1:]
        predicted = step / np.sqrt(6) / DT
        print(f"  {bits:4}{step:15.3e}{predicted:12.4f}{rms(off):12.4f}"
              f"{np.abs(off).max() / (step / DT):17.2f}")  # fmt: skip
        if bits == BITS:
            lab.record("encoder", rms(off) / predicted - 1.0,
                       label="16 bits: measured / predicted - 1")  # fmt: skip
            lab.measured("noise of a 16-bit difference, rad/s", rms(off))
    for name, off in off_library().items():
        lab.check(f"{name} - the library's", off)

    lab.step("2. How late a reading may be: what is left of an error after 2 s")
    margin = delay_margin(OMEGA**2, 2 * OMEGA)
    print(f"  margin {1000 * margin:.2f} ms; half a sample of holding leaves"
          f" {1000 * (margin - DT / 2):.2f} ms")  # fmt: skip
    for late in LATE:
        left = day9_mujoco.left_over(model, arm, late, OMEGA)  # mujoco.mj_step
        print(f"  {1000 * late:.0f} ms late: {left:.3g}")

    lab.step("3. Filters of a 16-bit encoder: joint 4's speed, rad/s")
    z, qd = encoder(swing.q, BITS)[:, JOINT], swing.qd[:, JOINT]
    raw = backward_difference(z, DT)
    print(f"  difference        {rms(raw[SETTLED:] - qd[SETTLED:]):.4f}")
    print("  low pass              all   lag alone")
    for cutoff in (5.0, 10.0, 20.0, 50.0, 100.0):
        off = low_pass(raw, DT, cutoff) - qd
        lag = low_pass(qd, DT, cutoff) - qd
        print(f"  {cutoff:5.0f} Hz{rms(off[SETTLED:]):17.4f}{rms(lag[SETTLED:]):12.4f}")
    print("  Kalman, R = step²/12      off    sigma     NIS   in   white  inside")
    R = (2 * np.pi / 2**BITS) ** 2 / 12
    for q in (0.001, 0.01, 0.1, 1.0):
        tested(f"q = {q:g}", z, qd, q, R)

    lab.step("4. A claim that can be tested: a joint that is what the filter believes")
    z, qd = wandering(rng)
    print("  told                     off    sigma     NIS   in   white  inside")
    found = tested("the truth", z, qd, WANDERS, NOISE**2)
    for name, q, R in (
        ("q / 100", WANDERS / 100, NOISE**2),
        ("q / 10 and R x 10", WANDERS / 10, 10 * NOISE**2),
    ):
        tested(name, z, qd, q, R)
    lab.record("kalman", abs(found["nis"] - 1.0), label="|mean NIS - 1|", seed=SEED)
    lab.check("|whiteness| of 1950 surprises", found["whiteness"],
              2 * 1.96 / np.sqrt(SAMPLES - SETTLED))  # fmt: skip

    lab.step("5. What the arm's motion alone does to its momentum")
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
    print("  the swing, which nobody pushes: largest residual, N m")
    way = swing._replace(q=swing.q[:500], qd=swing.qd[:500], tau=swing.tau[:500])
    for name, share in (
        ("kinetic_energy_gradient", 1),
        ("none", 0),
        ("its sign turned", -1),
    ):
        residual = np.abs(felt(arm, way, share)).max()
        print(f"  {name:18}{residual:8.3f}")
        if share == 1:
            lab.record("free_motion", residual, label="the first, N m")

    lab.step("6. A push of 10 N on the flange of an arm that holds still, N m")
    push = day9_mujoco.push(FLANGE, FORCE, SINCE)
    held = day9_mujoco.moved(model, arm, STAY, 0.8, push)
    truth = mujoco_external_torque(model, held.q[-1], FLANGE, FORCE)
    lab.show("J^T F, by mujoco.mj_applyFT", truth, 3)
    for name, share in (
        ("kinetic_energy_gradient", 1),
        ("none", 0),
        ("its sign turned", -1),
    ):
        residual = felt(arm, held, share)
        lab.show(f"residual with {name}", residual[-1], 3)
        if share == 1:
            late = notices(residual)
            lab.check("|residual - J^T F|, N m", residual[-1] - truth, 0.01)
            lab.record("push_noticed", late, label="noticed, ms")
            lab.measured("a push of 10 N is noticed after, ms", late)
            lab.measured("residual of joint 4, N m", residual[-1][JOINT])

    lab.step("7. Side quest: push it anywhere; it says which link, and stops")
    with lab.side_quest():
        rows = rng.normal(size=(20, 7)) * rng.uniform(0, 2, (20, 1))
        limits = rng.uniform(0.5, 1.5, (20, 7))
        pairs = list(zip(rows, limits, strict=True))
        off = [contact_link(*one) - library.contact_link(*one) for one in pairs]
        lab.check("contact_link - the library's", off)
        print("  pushed with, N                   link   after, ms   moves on, mm")
        limit = np.full(7, THRESHOLD)
        for name, force in PUSHES:
            push = day9_mujoco.push(name, force, SINCE)
            observer = Observer(arm)
            found = day9_mujoco.stopped(
                model, arm, observer, lambda r: contact_link(r, limit), push
            )  # mujoco.mj_step
            after = 1000 * (found.t - SINCE)
            words = f"{name}, {force}"
            print(f"  {words:30}{found.link:7}{after:10.0f}{found.moves_on:13.1f}")
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
