"""Day 5: control of the joints. Predict the error, then simulate it.

    make day5                      in the clone: sets everything up, then runs this
    python src/day5_control.py     in w1-foundations/, once that is done

e = q_ref - q and ed = qd_ref - qd: a positive error asks for a positive torque.
Radians, rad/s, N m, seconds. The model (M, bias) comes from Day 4's library.
"""

import kit  # noqa: F401 (goes on in the kit's own Python)
import mujoco
import numpy as np

from robo47 import cli, control, panda, references, scenes, simulate
from robo47.lesson.lab import Lab
from robo47.verify import each

import day5_mujoco

READY_Q = panda.READY_Q  # the handout's home_q: seven joint angles, radians
DRIVE = "torque"  # motors, in N m; "servo" would take the same numbers for angles
INTEGRATOR = "mjINT_IMPLICITFAST"  # the model's; with mjINT_EULER nothing changes here
RATE = 250.0  # Hz; 500 fits the curve better, 100 misses it, 50: the springs buzz
OMEGA = 20.0  # rad/s; 5 tracks 7 times worse; far above, RATE is too slow: it breaks
KP, KD = 100.0, 20.0  # N m/rad, N m s/rad of the plain springs; kp 1000 sags a tenth
KI, CLAMP = 4000.0, 0.02  # 1/s3, rad s; well above 2 OMEGA^3 the loop swings up
REACH = np.array([0.5, 0.4, 0.5, 0.4, 0.6, 0.5, 0.6])  # rad, of the tracking run
E0 = 0.1 * np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0])  # rad, the first error
TRIALS, SEED = 100, 47  # random states of step 1: how many, the same at every run
Gain = float | np.ndarray  # one number for all joints, or (7,)


def pd_torque(e: np.ndarray, ed: np.ndarray, kp: Gain, kd: Gain) -> np.ndarray:
    """Return the torque of a spring and a damper at every joint, (7,) in N m.

    An error e of 0.1 rad at kp = 100 gives 10 N m. A gain is one number or (7,).
    """
    # region 5.1
    return kp * e + kd * ed
    # endregion 5.1


def pd_gains(omega: float, zeta: float) -> np.ndarray:
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


def pd_equilibrium_step(q_goal: np.ndarray, g_at_q: np.ndarray, kp: Gain) -> np.ndarray:
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
    # region 5.4
    return pd_torque(e, ed, kp, kd) + g_at_q
    # endregion 5.4


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
    # region 5.7
    return np.clip(tau, -limits, limits)
    # endregion 5.7


def max_stable_omega(h: float) -> float:
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


def springs(arm, q, qd, ref):
    """Give the torque of plain springs: no model at all."""
    return pd_torque(ref[0] - q, ref[1] - qd, KP, KD)


def springs_and_gravity(arm, q, qd, ref):
    """Give the torque of the same springs, with the arm's weight taken off them."""
    return gravity_pd(ref[0] - q, ref[1] - qd, KP, KD, arm.at(q).gravity_torque)


def with_model(arm, q, qd, ref, kp: float, kd: float) -> np.ndarray:
    """Give your computed torque, with Day 4's model of the arm from the library."""
    now = arm.at(q)
    e = ref[0] - q
    ed = ref[1] - qd
    return computed_torque(now.M, now.bias(qd), arm.damping, qd, e, ed, ref[2], kp, kd)


def equal_springs(omega: float = OMEGA, zeta: float = 1.0):
    """Return computed torque with the gains of omega and zeta."""
    kp, kd = pd_gains(omega, zeta)
    return lambda *now: with_model(*now, kp, kd)


def without_springs(arm, q, qd, ref):
    """Give the model's torque for the reference's acceleration, where the arm is."""
    return with_model(arm, q, qd, (q, qd, ref[2]), 0.0, 0.0)


def feedforward(arm, q, qd, ref):
    """Give the model's torque on the reference: known beforehand, nothing measured."""
    return without_springs(arm, ref[0], ref[1], ref)


def gains_outside(arm, q, qd, ref):
    """Give the public page's torque: the model's, and springs that M does not scale."""
    kp, kd = pd_gains(OMEGA, 1.0)
    return without_springs(arm, q, qd, ref) + pd_torque(ref[0] - q, ref[1] - qd, kp, kd)


def with_integral(ki: float = KI, clamp: float = CLAMP, dt: float = 1.0 / RATE):
    """Return the model's torque for an acceleration that comes from PID."""
    kp, kd = pd_gains(OMEGA, 1.0)
    total = np.zeros(7)

    def law(arm, q, qd, ref):
        nonlocal total
        acc, total = pid_step(ref[0] - q, ref[1] - qd, total, kp, kd, ki, dt, clamp)
        return without_springs(arm, q, qd, (*ref[:2], ref[2] + acc))

    return law


def run(model, arm, law, reference, seconds: float, start=READY_Q, rate=RATE):
    """Close the loop: the law sees the measured q and qd, the motors their limits."""
    limits = simulate.limits(model)[1]

    def loop(t: float, q: np.ndarray, qd: np.ndarray) -> np.ndarray:
        return saturate(law(arm, q, qd, reference(t)), limits)

    data = simulate.start(model, start)
    # Every period asks the loop, writes data.ctrl and calls mujoco.mj_step.
    return simulate.run(model, data, loop, seconds, rate=rate)


def rest(torque_at, kp: Gain) -> np.ndarray:
    """Return where the springs rest, by 100 calls of pd_equilibrium_step."""
    q = READY_Q
    for _ in range(100):
        q = pd_equilibrium_step(READY_Q, torque_at(q), kp)
    return q


def tracking(log, reference) -> np.ndarray:
    """Return how far each joint is from a reference at every instant, mrad, (N, 7)."""
    return 1e3 * np.abs(log.q - np.array([reference(t)[0] for t in log.t]))


def off_inverse(model, arm, at: day5_mujoco.States) -> np.ndarray:
    """Return computed_torque minus MuJoCo's torque for that acceleration, (n, 7)."""
    kp = 400.0  # omega 20, zeta 0.7
    kd = 28.0
    data = mujoco.MjData(model)
    off = []
    for q, qd, e, ed, qdd_ref in zip(*at, strict=True):
        now = arm.at(q)
        known = now.M, now.bias(qd), arm.damping, qd
        tau = computed_torque(*known, e, ed, qdd_ref, kp, kd)
        data.qpos[:] = q
        data.qvel[:] = qd
        data.qacc[:] = qdd_ref + kp * e + kd * ed
        mujoco.mj_inverse(model, data)  # fills qfrc_inverse, with damping and armature
        off.append(tau - data.qfrc_inverse)
    return np.array(off)


def off_library(at: day5_mujoco.States) -> dict:
    """Return how far the others are from robo47.control: MuJoCo has none of them."""
    own = {
        "pd_torque": pd_torque,
        "pd_gains": pd_gains,
        "error_response": error_response,
        "pd_equilibrium_step": pd_equilibrium_step,
        "gravity_pd": gravity_pd,
        "pid_step": pid_step,
        "saturate": saturate,
    }
    given = day5_mujoco.arguments(at, SEED)
    return {
        name: each(own[name], *given[name]) - each(getattr(control, name), *given[name])
        for name in own
    }


def ladder(model, arm, swing) -> dict:
    """Return how far off a swing of all joints seven controllers are, mrad, (N, 7)."""
    laws = {
        "springs": springs,
        "springs and gravity": springs_and_gravity,
        "feedforward": feedforward,
        "model at q, no springs": without_springs,
        "gains outside M": gains_outside,
        "computed torque": equal_springs(),
    }
    logs = {"the model file's servos": day5_mujoco.servos_follow(swing, 2.0)}
    for name, law in laws.items():
        logs[name] = run(model, arm, law, swing, 2.0)
    return {name: tracking(log, swing) for name, log in logs.items()}


def off_servo(tau: np.ndarray) -> np.ndarray:
    """Return the torque of MuJoCo's servos minus the one that was asked for, (7,)."""
    model = panda.load("panda_nohand")
    data = simulate.start(model, READY_Q, [0.1, -0.1] * 3 + [0.1])
    servos = day5_mujoco.servos_of(model)
    data.ctrl[:] = servo_ctrl(tau, data.qpos, data.qvel, servos.kp, servos.kd)
    mujoco.mj_forward(model, data)  # fills actuator_force; mj_step would move on
    return data.actuator_force - tau


def through_servos(law, reference) -> float:
    """Return how far off servos are that are commanded torques, at 500 Hz, in mrad."""
    model = panda.load("panda_nohand")
    arm = panda.arm(model)
    servos = day5_mujoco.servos_of(model)

    def loop(t: float, q: np.ndarray, qd: np.ndarray) -> np.ndarray:
        tau = law(arm, q, qd, reference(t))
        return servo_ctrl(tau, q, qd, servos.kp, servos.kd)

    data = simulate.start(model, READY_Q)
    log = simulate.run(model, data, loop, 2.0, rate=500)  # at 250: 94 mrad
    return tracking(log, reference).max()


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    model = day5_mujoco.motors(DRIVE, INTEGRATOR)
    arm = panda.arm(model)  # Day 4's M, bias and gravity torque, of the library
    goal = references.hold(READY_Q)
    swing = references.raised_cosine(READY_Q, REACH)  # out and back in 2 s
    print(panda.describe("panda_nohand"))

    lab.step(f"1. Your functions by value, at {TRIALS} random states")
    # A loop hides mistakes: with the gains outside M it tracks as well.
    at = day5_mujoco.states(model, TRIALS, SEED)
    lab.check("computed_torque - MuJoCo's mj_inverse, N m", off_inverse(model, arm, at))
    print("  the library robo47.control instead of MuJoCo:")
    for name, off in off_library(at).items():
        lab.check(name, off)

    lab.step("2. Springs sag: predicted by gravity over stiffness")
    predicted = rest(lambda q: arm.at(q).gravity_torque, KP)
    log = run(model, arm, springs, goal, 6.0)
    low = [1e3 * (READY_Q - q)[3] for q in (predicted, log.q[-1])]
    lab.predict("joint 4 hangs low by", *low, "mrad")
    top, *low = (arm.at(q).T_world_ee[2, 3] for q in (READY_Q, predicted, log.q[-1]))
    lab.predict("the hand by", *(1e3 * (top - z) for z in low), "mm")
    lab.record("sag_predicted", log.q[-1] - predicted, label="sag, worst joint, rad")
    log = run(model, arm, springs_and_gravity, goal, 0.5)
    lab.check("with gravity's torque added, rad", log.q - READY_Q)

    lab.step("3. Computed torque: seven equal springs, one curve")
    apart = []
    k = round(0.3 * RATE)
    for zeta in (0.5, 1.0, 2.0):
        log = run(model, arm, equal_springs(10.0, zeta), goal, 1.0, READY_Q - E0)
        wanted = error_response(log.t, 10.0, zeta)
        e = (READY_Q - log.q) / E0
        apart.append(np.abs(e.T - wanted).max())
        lab.predict(f"zeta {zeta:g}: after 0.3 s", wanted[k], e[k].mean(), "of e0")
    lab.record("error_dynamics", apart, label="curve - predicted, of e0", seed=0)
    log = run(model, arm, gains_outside, goal, 0.5, READY_Q - E0)
    off = (READY_Q - log.q) / E0 - error_response(log.t, OMEGA, 1.0)[:, None]
    print(f"  gains outside M miss their curve by {np.abs(off).max():.3f} of e0")

    lab.step("4. Seven controllers follow a swing of all joints, largest error")
    for name, off in ladder(model, arm, swing).items():
        print(f"  {name:24} {off.max():8.2f} mrad")
    lab.record("tracking", off.max(axis=1), label="computed torque, mrad")

    lab.step("5. 1 kg nobody told the model about")
    heavy = day5_mujoco.motors(DRIVE, INTEGRATOR, scenes.hang_kilogram)
    # What the springs, of unit inertia, have to hold: M^-1 J^T F.
    load = lambda q: np.linalg.solve(arm.at(q).M, arm.at(q).J_site[5] * 9.81)  # noqa: E731
    predicted = rest(load, pd_gains(OMEGA, 1.0)[0])
    log = run(heavy, arm, equal_springs(), goal, 1.5)
    low = [1e3 * (READY_Q - q)[3] for q in (predicted, log.q[-1])]
    lab.predict("joint 4 under 1 kg hangs low by", *low, "mrad")
    lab.check("sag under 1 kg, worst joint, rad", log.q[-1] - predicted)
    log = run(heavy, arm, with_integral(), goal, 2.0)
    lab.check("with an integral, after 2 s, rad", log.q[-1] - READY_Q, limit=1e-5)

    lab.step("6. Side quest: how stiff can it be?")
    with lab.side_quest():
        start = READY_Q - 1e-8 * E0
        h = model.opt.timestep
        limit = max_stable_omega(h)
        found = day5_mujoco.breaking(model, equal_springs, 1 / h, start)
        lab.predict("torque every 2 ms, loop breaks at", limit, found, "rad/s")
        lab.check("largest omega, rad/s", limit - found, limit=2.0)
        n = simulate.steps_per_period(model, RATE)
        limit = control.max_stable_omega(h, n)
        found = day5_mujoco.breaking(model, equal_springs, RATE, start)
        what = f"torque every {1e3 / RATE:g} ms, loop breaks at"
        lab.predict(what, limit, found, "rad/s")
        whose = f"the library's, at the day's {RATE:g} Hz, rad/s"
        lab.check(whose, limit - found, limit=2.0)
        off = off_servo(np.array([5.0, -20, 3, 15, 1, 2, -1]))
        lab.check("a servo's torque as asked, N m", off)
        off = through_servos(equal_springs(), swing)
        print(f"  and yet computed torque through servos is {off:.1f} mrad off. Why?")
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
