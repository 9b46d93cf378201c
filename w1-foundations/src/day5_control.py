"""Day 5: control of the joints. Predict the error, then simulate it.

    make day5                      in the clone: sets everything up, then runs this
    python src/day5_control.py     in w1-foundations/, once that is done

e = q_ref - q and ed = qd_ref - qd: a positive error asks for a positive torque.
Radians, rad/s, N m, seconds. The model (M, bias) comes from Day 4's library.
"""

import kit  # noqa: F401 (goes on in the kit's own Python)
import mujoco
import numpy as np

from robo47 import cli, panda, simulate, verify
from robo47 import control as library
from robo47.lesson.lab import Lab

READY_Q = panda.READY_Q  # the handout's home_q: seven joint angles, radians
DRIVE = "torque"  # motors, in N m; "servo" would take the same numbers for angles
INTEGRATOR = "mjINT_IMPLICITFAST"  # the model's; with mjINT_EULER nothing changes here
RATE = 250.0  # Hz; 500 fits the curve better, 100 misses it, 50: the springs buzz
OMEGA = 20.0  # rad/s; 5 tracks 7 times worse, above 224 RATE is too slow: it breaks
KP, KD = 100.0, 20.0  # N m/rad, N m s/rad of the plain springs; kp 1000 sags a tenth
KI, CLAMP = 4000.0, 0.02  # 1/s3, rad s; well above 2 OMEGA^3 the loop swings up
REACH = np.array([0.5, 0.4, 0.5, 0.4, 0.6, 0.5, 0.6])  # rad, of the tracking run
E0 = 0.1 * np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0])  # rad, the first error
TRIALS = 100  # random states that your functions are judged on in step 1
SEED = 47  # the same random states at every run
Gain = float | np.ndarray  # one number for all joints, or (7,)


def pd_torque(e: np.ndarray, ed: np.ndarray, kp: Gain, kd: Gain) -> np.ndarray:
    """Return the torque of a spring and a damper at every joint, (7,) in N m.

    An error e of 0.1 rad at kp = 100 gives 10 N m. A gain is one number or (7,).
    """
    # region 5.1
    return kp * e + kd * ed
    # endregion 5.1


def gains(omega: float, zeta: float) -> np.ndarray:
    """Return kp and kd, (2,), of edd + kd ed + kp e = 0 with this omega and zeta.

    omega = 20 rad/s and zeta = 1 need (400, 40).
    """
    # region 5.2
    return np.array([omega**2, 2.0 * zeta * omega])
    # endregion 5.2


def error_response(t: np.ndarray, omega: float, zeta: float) -> np.ndarray:
    """Return, at the times t, (n,), the error that was 1 and at rest at t = 0.

    At omega = 10 and zeta = 1 it is 0.7358 after 0.1 s. zeta may be under or over 1.
    """
    # region 5.3
    rate = zeta * omega
    if zeta == 1.0:
        return (1.0 + rate * t) * np.exp(-rate * t)
    if zeta < 1.0:
        w = omega * np.sqrt(1.0 - zeta**2)
        return np.exp(-rate * t) * (np.cos(w * t) + rate / w * np.sin(w * t))
    slow, fast = rate + omega * np.sqrt(zeta**2 - 1.0) * np.array([-1.0, 1.0])
    return (fast * np.exp(-slow * t) - slow * np.exp(-fast * t)) / (fast - slow)
    # endregion 5.3


def sag_step(q_goal: np.ndarray, g_at_q: np.ndarray, kp: Gain) -> np.ndarray:
    """Return where springs alone would rest if gravity's torque stayed g_at_q, (7,).

    With g = 10 N m and kp = 100 N m/rad: 0.1 rad below the goal.
    """
    # region 5.4
    return q_goal - g_at_q / kp
    # endregion 5.4


def gravity_pd(
    e: np.ndarray, ed: np.ndarray, kp: Gain, kd: Gain, g_at_q: np.ndarray
) -> np.ndarray:
    """Return the torque of springs that do not sag, (7,). Without error it is g."""
    # region 5.5
    return pd_torque(e, ed, kp, kd) + g_at_q
    # endregion 5.5


def computed_torque(
    M: np.ndarray, bias: np.ndarray, damping: np.ndarray, qd: np.ndarray,
    e: np.ndarray, ed: np.ndarray, qdd_ref: np.ndarray, kp: float, kd: float,
) -> np.ndarray:  # fmt: skip
    """Return the torque, (7,), that makes edd + kd ed + kp e = 0 at every joint.

    At rest, without an error or an acceleration to reach, it is bias.
    """
    # region 5.6
    return M @ (qdd_ref + pd_torque(e, ed, kp, kd)) + bias + damping * qd
    # endregion 5.6


def pid_step(
    e: np.ndarray, ed: np.ndarray, integral: np.ndarray,
    kp: float, kd: float, ki: float, dt: float, clamp: float,
) -> tuple[np.ndarray, np.ndarray]:  # fmt: skip
    """Return PID's acceleration and its new integral, (7,) each.

    The integral of e is kept within +-clamp, and then used. From 0, an error of 1
    makes it 0.1 in dt = 0.1 s.
    """
    # region 5.7
    integral = np.clip(integral + e * dt, -clamp, clamp)
    return pd_torque(e, ed, kp, kd) + ki * integral, integral
    # endregion 5.7


def saturate(tau: np.ndarray, limits: np.ndarray) -> np.ndarray:
    """Return what the motors can give, (7,). 100 N m where the limit is 87: 87."""
    # region 5.8
    return np.clip(tau, -limits, limits)
    # endregion 5.8


def fastest(h: float) -> float:
    """Return the largest omega (zeta = 1) for a new torque every h seconds.

    Between two torques is one semi-implicit step: qd += h qdd, then q += h qd. For
    0.002 s: 414.2 rad/s.
    """
    # region 5.9
    return 2.0 * (np.sqrt(2.0) - 1.0) / h
    # endregion 5.9


def servo_ctrl(
    tau: np.ndarray, q: np.ndarray, qd: np.ndarray, kp: np.ndarray, kd: np.ndarray
) -> np.ndarray:
    """Return the angles, (7,), at which servos kp (ctrl - q) - kd qd give tau.

    For no torque at rest: q itself.
    """
    # region 5.9
    return q + (tau + kd * qd) / kp
    # endregion 5.9


def hold(q: np.ndarray):
    """Return the reference that stays at q: position, velocity, acceleration."""
    return lambda t: (q, np.zeros(7), np.zeros(7))


def raised_cosine(t: float):
    """Return the reference that swings by REACH and back in 2 s, from rest to rest."""
    c, s = np.cos(np.pi * t), np.sin(np.pi * t)
    qd, qdd = REACH * np.pi * s / 2, REACH * np.pi**2 * c / 2
    return READY_Q + REACH * (1 - c) / 2, qd, qdd


def springs(arm, q, qd, ref):
    """Give the torque of plain springs: no model at all."""
    return pd_torque(ref[0] - q, ref[1] - qd, KP, KD)


def springs_and_gravity(arm, q, qd, ref):
    """Give the torque of the same springs, with the arm's weight taken off them."""
    g = arm.at(q).gravity_torque
    return gravity_pd(ref[0] - q, ref[1] - qd, KP, KD, g)


def equal_springs(omega: float = OMEGA, zeta: float = 1.0):
    """Return computed torque with the gains of omega and zeta."""
    kp, kd = gains(omega, zeta)

    def law(arm, q, qd, ref):
        now, e, ed = arm.at(q), ref[0] - q, ref[1] - qd
        M, bias, damping = now.M, now.bias(qd), arm.damping
        return computed_torque(M, bias, damping, qd, e, ed, ref[2], kp, kd)

    return law


def feedforward(arm, q, qd, ref):
    """Give the model's torque for the reference's acceleration: no springs at all."""
    now, none = arm.at(q), np.zeros(7)
    M, bias, damping = now.M, now.bias(qd), arm.damping
    return computed_torque(M, bias, damping, qd, none, none, ref[2], 0.0, 0.0)


def gains_outside(arm, q, qd, ref):
    """Give the public page's torque: the model's, and springs that M does not scale."""
    kp, kd = gains(OMEGA, 1.0)
    return feedforward(arm, q, qd, ref) + pd_torque(ref[0] - q, ref[1] - qd, kp, kd)


def with_integral(ki: float = KI, clamp: float = CLAMP, dt: float = 1.0 / RATE):
    """Return computed torque whose acceleration comes from PID."""
    (kp, kd), none, integral = gains(OMEGA, 1.0), np.zeros(7), np.zeros(7)

    def law(arm, q, qd, ref):
        nonlocal integral
        e, ed, now = ref[0] - q, ref[1] - qd, arm.at(q)
        acc, integral = pid_step(e, ed, integral, kp, kd, ki, dt, clamp)
        M, bias, damping, qdd = now.M, now.bias(qd), arm.damping, ref[2] + acc
        return computed_torque(M, bias, damping, qd, none, none, qdd, kp, kd)

    return law


def motors(edit=None) -> mujoco.MjModel:
    """Return the arm with the drive and the integrator from the top of this file."""
    model = panda.load("panda_nohand", drive=DRIVE, edit=edit)
    model.opt.integrator = getattr(mujoco.mjtIntegrator, INTEGRATOR)
    return model


def run(model, arm, law, reference, seconds: float, start=READY_Q, rate=RATE):
    """Close the loop: the law sees the measured q and qd, the motors their limits."""
    _, limits = simulate.limits(model)

    def controller(t, q, qd):
        return saturate(law(arm, q, qd, reference(t)), limits)

    data = simulate.start(model, start)
    return simulate.run(model, data, controller, seconds, rate=rate)


def rest(q_goal: np.ndarray, load, kp: float) -> np.ndarray:
    """Return where sag_step stays: it is asked again at its own answer."""
    q = q_goal
    for _ in range(100):
        q = sag_step(q_goal, load(q), kp)
    return q


def say(what: str, predicted: float, measured: float, unit: str) -> None:
    """Print a prediction, what came out, and how far apart they are."""
    apart = abs(predicted - measured)
    print(f"  {what}: predicted {predicted:.3f}, measured {measured:.3f}", end="")
    print(f" {unit}\n    difference {apart:.1e} {unit}")


def compare(lab: Lab, ours, theirs, *columns) -> None:
    """Check a function of yours against the library's, one call per row."""
    calls = list(zip(*columns, strict=True))
    pairs = [(np.array(ours(*one)), np.array(theirs(*one))) for one in calls]
    lab.check(ours.__name__, max(np.abs(a - b).max() for a, b in pairs))


def by_value(lab: Lab, model, arm) -> None:
    """Compare every function with MuJoCo, or with the library where it has none."""
    rng, n = np.random.default_rng(SEED), TRIALS
    q = verify.random_q(model, n, SEED)
    qd, e, ed, qdd = rng.uniform(-1, 1, (4, n, 7))
    K, D = rng.uniform(10, 100, (2, n, 7))
    tau, kp, kd = [], 400.0, 28.0  # omega 20, zeta 0.7
    for i, now in enumerate(map(arm.at, q)):
        known = now.M, now.bias(qd[i]), arm.damping, qd[i]
        tau.append(computed_torque(*known, e[i], ed[i], qdd[i], kp, kd))
    truth = verify.mujoco_inverse_dynamics(model, q, qd, qdd + kp * e + kd * ed)
    lab.check("computed_torque - MuJoCo's mj_inverse, N m", np.array(tau) - truth)
    print("  the library robo47.control in place of MuJoCo:")
    times, omega = np.tile(np.linspace(0, 0.5, 26), (n, 1)), rng.uniform(2, 30, n)
    zeta, clamp = np.resize([0.3, 0.7, 1.0, 1.5], n), np.resize([0.005, 0.2, 10], n)
    pid = np.tile([400.0, 40.0, 3000.0, 0.01], (n, 1)).T
    compare(lab, pd_torque, library.pd_torque, e, ed, K, D)
    compare(lab, gains, library.gains, omega, zeta)
    compare(lab, error_response, library.error_response, times, omega, zeta)
    compare(lab, sag_step, library.sag_step, q, 50 * e, K)
    compare(lab, gravity_pd, library.gravity_pd, e, ed, K, D, 50 * qd)
    compare(lab, pid_step, library.pid_step, e, ed, 0.2 * qd, *pid, clamp)
    compare(lab, saturate, library.saturate, 150 * e, np.abs(100 * ed))


def sag(lab: Lab, model, arm) -> None:
    """Predict how far plain springs sag; then let them."""
    goal = hold(READY_Q)
    predicted = rest(READY_Q, lambda q: arm.at(q).gravity_torque, KP)
    log = run(model, arm, springs, goal, 6.0)
    low = [1e3 * (READY_Q - q)[3] for q in (predicted, log.q[-1])]
    say("joint 4 hangs low by", *low, "mrad")
    low = [arm.at(q).T_world_ee[2, 3] for q in (READY_Q, predicted, log.q[-1])]
    say("the hand by", *(1e3 * (low[0] - z) for z in low[1:]), "mm")
    lab.record("sag_predicted", log.q[-1] - predicted, label="sag, worst joint, rad")
    log = run(model, arm, springs_and_gravity, goal, 0.5)
    lab.check("with gravity's torque added, rad", log.q - READY_Q)


def decay(lab: Lab, model, arm) -> None:
    """Predict the whole curve of an error; then let it decay, in seven joints."""
    apart, k = [], round(0.3 * RATE)
    for zeta in (0.5, 1.0, 2.0):
        law = equal_springs(10.0, zeta)
        log = run(model, arm, law, hold(READY_Q), 1.0, READY_Q - E0)
        e = (READY_Q - log.q) / E0
        predicted = error_response(log.t, 10.0, zeta)
        apart.append(np.abs(e - predicted[:, None]).max())
        say(f"zeta {zeta:g}: after 0.3 s", predicted[k], e[k].mean(), "of e0")
    lab.record("error_dynamics", apart, label="curve - predicted, of e0", seed=0)
    log = run(model, arm, gains_outside, hold(READY_Q), 0.5, READY_Q - E0)
    e, predicted = (READY_Q - log.q) / E0, error_response(log.t, OMEGA, 1.0)
    off = np.abs(e.T - predicted).max()
    print(f"  gains outside M miss their curve by {off:.3f} of e0")


def ladder(lab: Lab, model, arm) -> None:
    """Follow a swing of all joints with one controller after the other."""
    servos = panda.load("panda_nohand")
    data = simulate.start(servos, READY_Q)
    log = simulate.run(servos, data, lambda t, q, qd: raised_cosine(t)[0], 2.0)
    rows = {"the model file's servos": log}
    for name, law in {
        "springs": springs,
        "springs and gravity": springs_and_gravity,
        "feedforward, no springs": feedforward,
        "gains outside M": gains_outside,
        "computed torque": equal_springs(),
    }.items():
        rows[name] = run(model, arm, law, raised_cosine, 2.0)
    for name, log in rows.items():
        error = 1e3 * np.abs(log.q - np.array([raised_cosine(t)[0] for t in log.t]))
        print(f"  {name:24} {error.max():8.2f} mrad")
    lab.record("tracking", error.max(axis=1), label="computed torque, mrad")


def kilogram(lab: Lab, arm) -> None:
    """Hang on 1 kg that the model does not know: predict the sag, then integrate."""
    model, goal, lift = motors(hang), hold(READY_Q), [0, 0, 0, 0, 0, 9.81]

    def load(q):  # what the springs, of unit inertia, have to hold
        return np.linalg.solve(arm.at(q).M, arm.at(q).J_site.T @ lift)

    kp, _ = gains(OMEGA, 1.0)
    predicted = rest(READY_Q, load, kp)
    log = run(model, arm, equal_springs(), goal, 1.5)
    low = [1e3 * (READY_Q - q)[3] for q in (predicted, log.q[-1])]
    say("joint 4 hangs low by", *low, "mrad")
    lab.check("sag under 1 kg, worst joint, rad", log.q[-1] - predicted)
    log = run(model, arm, with_integral(), goal, 2.0)
    lab.check("with an integral, after 2 s, rad", log.q[-1] - READY_Q, limit=1e-5)


def hang(spec) -> None:
    """Hang a ball of 1 kg on the end of the arm."""
    ball = {"mass": 1.0, "inertia": [1e-4, 1e-4, 1e-4], "explicitinertial": True}
    spec.body("attachment").add_body(name="load", **ball)


def breaking(model, arm, rate: float) -> float:
    """Return the omega from which a tiny error grows, found by halving an interval."""
    low, high = 0.75 * rate, 1.05 * rate
    nudge = READY_Q - 1e-8 * E0  # no motor is at its limit before 60 torques
    while high - low > 0.1:
        omega = (low + high) / 2
        law = equal_springs(omega)
        log = run(model, arm, law, hold(READY_Q), 60 / rate, nudge, rate)
        e = np.abs(READY_Q - log.q)
        grows = e[-10:].max() > e[20:30].max()
        low, high = (low, omega) if grows else (omega, high)
    return (low + high) / 2


def side_quest(lab: Lab, model, arm) -> None:
    """Find the gain at which the loop breaks, and abuse a servo as a motor."""
    h, n = model.opt.timestep, simulate.steps_per_period(model, RATE)
    for every, predicted, whose in (
        (1, fastest(h), "largest omega"),
        (n, library.fastest(h, n), f"the library's, at the day's {RATE:g} Hz"),
    ):
        measured = breaking(model, arm, 1 / (every * h))
        what = f"torque every {1e3 * every * h:g} ms, loop breaks at"
        say(what, predicted, measured, "rad/s")
        lab.check(f"{whose}, rad/s", predicted - measured, limit=2.0)
    servos = panda.load("panda_nohand")
    kp, kd = servos.actuator_gainprm[:, 0], -servos.actuator_biasprm[:, 2]
    data = simulate.start(servos, READY_Q, 0.1 * E0)
    tau = np.array([5.0, -20.0, 3.0, 15.0, 1.0, 2.0, -1.0])
    data.ctrl[:] = servo_ctrl(tau, data.qpos, data.qvel, kp, kd)
    mujoco.mj_forward(servos, data)  # the force now; mj_step would move on
    lab.check("a servo's torque as asked, N m", data.actuator_force - tau)
    law = equal_springs()

    def inverted(t, q, qd):
        return servo_ctrl(law(arm, q, qd, raised_cosine(t)), q, qd, kp, kd)

    data = simulate.start(servos, READY_Q)
    log = simulate.run(servos, data, inverted, 2.0, rate=500)  # at 250: 94 mrad
    error = 1e3 * np.abs(log.q - np.array([raised_cosine(t)[0] for t in log.t])).max()
    print(f"  and yet computed torque through servos is {error:.1f} mrad off. Why?")


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    model = motors()
    arm = panda.arm(model)  # Day 4's M, bias and gravity torque, of the library
    print(panda.describe("panda_nohand"))

    lab.step(f"1. Your functions by value, at {TRIALS} random states")
    by_value(lab, model, arm)  # a loop hides mistakes: augmented PD tracks as well

    lab.step("2. Springs sag: predicted by gravity over stiffness")
    sag(lab, model, arm)  # statics needs no simulation; the simulation needs 6 s

    lab.step("3. Computed torque: seven equal springs, one curve")
    decay(lab, model, arm)  # from 0.1 rad off, at rest, in every joint

    lab.step("4. Six controllers follow a swing of all joints, largest error")
    ladder(lab, model, arm)  # the more the model does, the less is left to the springs

    lab.step("5. 1 kg nobody told the model about")
    kilogram(lab, arm)  # M^-1 J^T F over kp, and what an integral makes of it

    lab.step("6. Side quest: how stiff can it be?")
    with lab.side_quest():
        side_quest(lab, model, arm)
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
