"""Day 5: joint control. PD, PID, computed torque; the error predicted, then simulated.

    make day5                      in the clone: sets everything up, then runs this
    python src/day5_control.py     in w1-foundations/, once that is done

e = q_ref - q and ed = qd_ref - qd: a positive error requires a positive torque.
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
DRIVE = "torque"  # motors, in N m; "servo" interprets the commands as angles
INTEGRATOR = "mjINT_IMPLICITFAST"  # as in the model; mjINT_EULER gives the same
RATE = 250.0  # Hz; 500 fits the curve better, 100 misses it; at 50 PD never rests
OMEGA = 20.0  # rad/s; 5 tracks 7 times worse; from 225 on the loop is unstable
KP, KD = 100.0, 20.0  # N m/rad, N m s/rad of PD alone; kp 1000 sags a tenth
KI, CLAMP = 4000.0, 0.02  # 1/s3, rad s; unstable for ki well above 2 OMEGA^3
REACH = np.array([0.5, 0.4, 0.5, 0.4, 0.6, 0.5, 0.6])  # rad, the amplitudes of step 4
E0 = 0.1 * np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0])  # rad, the first error
TRIALS, SEED = 100, 47  # number of random states in step 1, and their seed
Gain = float | np.ndarray  # one number for all joints, or (7,)


def pd_torque(e: np.ndarray, ed: np.ndarray, kp: Gain, kd: Gain) -> np.ndarray:
    """Return the torque of PD control at every joint, kp e + kd ed, (7,), N m.

    e (7,) is the error q_ref - q, rad, and ed (7,) its rate, rad/s. kp, N m/rad, and
    kd, N m s/rad, are the gains: one number for all joints or (7,), one per joint. An
    error e of 0.1 rad at kp = 100 gives 10 N m. Source: Modern Robotics, 11.4.1.
    """
    # region 5.1
    return kp * e + kd * ed  # proportional and derivative term
    # endregion 5.1


def pd_gains(omega: float, zeta: float) -> np.ndarray:
    """Return kp, 1/s^2, and kd, 1/s, of a unit mass: the array (kp, kd), (2,).

    With these gains edd + kd ed + kp e = 0 has the natural frequency omega, rad/s, and
    the damping ratio zeta. omega = 20 rad/s and zeta = 1 need (400, 40). Source:
    Modern Robotics, section 11.2.2.
    """
    # region 5.2
    return np.array([omega**2, 2.0 * zeta * omega])  # the two gains
    # endregion 5.2


def error_response(t: np.ndarray, omega: float, zeta: float) -> np.ndarray:
    """Return the error at the times t as a fraction of the first error, (n,).

    It solves edd + 2 zeta omega ed + omega^2 e = 0 with e = 1 and ed = 0 at t = 0. t,
    (n,), is in seconds; omega is the natural frequency, rad/s, and zeta the damping
    ratio, at least 0: under 1, equal to 1 and over 1 are three cases. At omega = 10 and
    zeta = 1 the error is 0.7358 after 0.1 s. Source: Modern Robotics, section 11.2.2.
    """
    # region 5.3
    rate = zeta * omega  # decay rate
    if zeta == 1.0:
        return (1.0 + rate * t) * np.exp(-rate * t)  # critically damped response
    if zeta < 1.0:
        w = omega * np.sqrt(1.0 - zeta**2)  # damped natural frequency
        shape = np.cos(w * t) + rate / w * np.sin(w * t)  # cosine that starts at rest
        return np.exp(-rate * t) * shape  # underdamped response
    half_gap = omega * np.sqrt(zeta**2 - 1.0)  # half the gap of the two decay rates
    slow = rate - half_gap  # smaller decay rate
    fast = rate + half_gap  # larger decay rate
    both = fast * np.exp(-slow * t) - slow * np.exp(-fast * t)  # sum of exponentials
    return both / (fast - slow)  # overdamped response
    # endregion 5.3


def pd_equilibrium_step(q_goal: np.ndarray, g_at_q: np.ndarray, kp: Gain) -> np.ndarray:
    """Return the next q of a fixed-point iteration to the PD equilibrium, (7,), rad.

    At rest the PD torque kp (q_goal - q) equals the gravity torque. q_goal (7,) is the
    commanded configuration, rad; g_at_q (7,) is the gravity torque at the present q,
    N m; kp, N m/rad, is one number or (7,). The result would be the equilibrium if
    the gravity torque did not depend on q. With g = 10 N m and kp = 100 N m/rad it is
    0.1 rad below the goal. Source: Modern Robotics, section 11.4.1.
    """
    # region 5.4
    return q_goal - g_at_q / kp  # goal minus the steady-state error
    # endregion 5.4


def gravity_pd(
    e: np.ndarray, ed: np.ndarray, kp: Gain, kd: Gain, g_at_q: np.ndarray
) -> np.ndarray:
    """Return the torque of PD control with gravity compensation, (7,), N m.

    e, ed, kp and kd are as in `pd_torque`; g_at_q (7,) is the gravity torque at the
    measured q, N m. If e and ed are 0, the result is g_at_q. Source: Modern Robotics,
    section 11.4.2.
    """
    # region 5.4
    return pd_torque(e, ed, kp, kd) + g_at_q  # PD torque plus gravity torque
    # endregion 5.4


def computed_torque(
    M: np.ndarray, bias: np.ndarray, damping: np.ndarray, qd: np.ndarray,
    e: np.ndarray, ed: np.ndarray, qdd_ref: np.ndarray, kp: float, kd: float,
) -> np.ndarray:  # fmt: skip
    """Return the computed torque, (7,), N m: every joint obeys edd + kd ed + kp e = 0.

    M (7, 7) is the mass matrix with armature, kg m^2; bias (7,) is the torque of
    gravity, Coriolis and centrifugal forces, N m; damping (7,) is the joints' damping,
    N m s/rad, which opposes the measured velocities qd (7,), rad/s; e (7,) and ed (7,)
    are the errors, rad and rad/s; qdd_ref (7,) is the acceleration of the reference,
    rad/s^2; kp, 1/s^2, and kd, 1/s, are the gains of a unit mass. At rest, without
    error and with qdd_ref = 0, the result is bias. Source: Modern Robotics, section
    11.4.2.
    """
    # region 5.6
    acc = qdd_ref + pd_torque(e, ed, kp, kd)  # commanded acceleration
    return M @ acc + bias + damping * qd  # inverse dynamics of that acceleration
    # endregion 5.6


def pid_step(
    e: np.ndarray, ed: np.ndarray, integral: np.ndarray,
    kp: float, kd: float, ki: float, dt: float, clamp: float,
) -> tuple[np.ndarray, np.ndarray]:  # fmt: skip
    """Return the acceleration of PID control, rad/s^2, and the new integral, (7,) each.

    e (7,) and ed (7,) are the errors, rad and rad/s; integral (7,) is the integral that
    the last step returned, rad s; kp, kd and ki are the gains, 1/s^2, 1/s and 1/s^3; dt
    is the time since the last step, s. Add e dt to the integral, clamp it to -clamp
    and clamp, rad s, and then use it. Do not change the argument. From 0, an error of
    1 makes the integral 0.1 in dt = 0.1 s. Source: Modern Robotics, section 11.4.1.
    """
    # region 5.7
    integral = np.clip(integral + e * dt, -clamp, clamp)  # clamped integral
    return pd_torque(e, ed, kp, kd) + ki * integral, integral  # PD plus integral term
    # endregion 5.7


def saturate(tau: np.ndarray, limits: np.ndarray) -> np.ndarray:
    """Return the torques that the motors can give, (7,), N m: each within its limits.

    tau (7,) are the wanted torques, N m, and limits (7,) the largest torques of the
    motors, N m, in both directions. The motors do not influence each other. 100 N m
    where the limit is 87: 87.
    """
    # region 5.7
    return np.clip(tau, -limits, limits)  # torque clamped joint by joint
    # endregion 5.7


def max_stable_omega(h: float) -> float:
    """Return the stability limit of omega at zeta = 1 with a new torque every h, rad/s.

    h, s, is the control period and also the time step of the simulator, which makes one
    semi-implicit step: qd += h qdd, then q += h qd. With qdd = -omega^2 q - 2 omega qd
    the loop is stable up to the omega at which the matrix of this step has the
    eigenvalue -1. For 0.002 s: 414.2 rad/s.
    """
    # region 5.9
    return 2.0 * (np.sqrt(2.0) - 1.0) / h  # positive root of the quadratic over h
    # endregion 5.9


def servo_ctrl(
    tau: np.ndarray, q: np.ndarray, qd: np.ndarray, kp: np.ndarray, kd: np.ndarray
) -> np.ndarray:
    """Return the commands at which position servos give the torques tau, (7,), rad.

    A servo gives kp (ctrl - q) - kd qd. tau (7,) are the wanted torques, N m; q (7,)
    and qd (7,) are measured, rad and rad/s; kp (7,) and kd (7,) are the gains of the
    servos, N m/rad and N m s/rad. For no torque at rest the result is q itself.
    """
    # region 5.9
    return q + (tau + kd * qd) / kp  # solution of the servo's law for its command
    # endregion 5.9


def springs(arm, q, qd, ref):
    """Return the torque of PD control alone, without a model."""
    return pd_torque(ref[0] - q, ref[1] - qd, KP, KD)


def springs_and_gravity(arm, q, qd, ref):
    """Return the torque of PD control with gravity compensation."""
    return gravity_pd(ref[0] - q, ref[1] - qd, KP, KD, arm.at(q).gravity_torque)


def with_model(arm, q, qd, ref, kp: float, kd: float) -> np.ndarray:
    """Return your computed torque, with the library's model of the arm (Day 4)."""
    now = arm.at(q)
    e = ref[0] - q
    ed = ref[1] - qd
    return computed_torque(now.M, now.bias(qd), arm.damping, qd, e, ed, ref[2], kp, kd)


def equal_springs(omega: float = OMEGA, zeta: float = 1.0):
    """Return the law of computed torque with the gains of omega and zeta."""
    kp, kd = pd_gains(omega, zeta)
    return lambda *now: with_model(*now, kp, kd)


def without_springs(arm, q, qd, ref):
    """Return the model's torque at the measured state, without PD terms."""
    return with_model(arm, q, qd, (q, qd, ref[2]), 0.0, 0.0)


def feedforward(arm, q, qd, ref):
    """Return the model's torque on the reference, without any measurement."""
    return without_springs(arm, ref[0], ref[1], ref)


def gains_outside(arm, q, qd, ref):
    """Return the public page's torque: the model's plus PD that M does not scale."""
    kp, kd = pd_gains(OMEGA, 1.0)
    return without_springs(arm, q, qd, ref) + pd_torque(ref[0] - q, ref[1] - qd, kp, kd)


def with_integral(ki: float = KI, clamp: float = CLAMP, dt: float = 1.0 / RATE):
    """Return the law of computed torque whose acceleration comes from PID."""
    kp, kd = pd_gains(OMEGA, 1.0)
    total = np.zeros(7)

    def law(arm, q, qd, ref):
        nonlocal total
        acc, total = pid_step(ref[0] - q, ref[1] - qd, total, kp, kd, ki, dt, clamp)
        return without_springs(arm, q, qd, (*ref[:2], ref[2] + acc))

    return law


def run(model, arm, law, reference, seconds: float, start=READY_Q, rate=RATE):
    """Simulate the closed loop: a law of the measured q and qd, and motor limits."""
    limits = simulate.limits(model)[1]

    def loop(t: float, q: np.ndarray, qd: np.ndarray) -> np.ndarray:
        return saturate(law(arm, q, qd, reference(t)), limits)

    data = simulate.start(model, start)
    # Each period calls the loop, writes data.ctrl and calls mujoco.mj_step.
    return simulate.run(model, data, loop, seconds, rate=rate)


def rest(torque_at, kp: Gain) -> np.ndarray:
    """Return the PD equilibrium, by 100 calls of pd_equilibrium_step."""
    q = READY_Q
    for _ in range(100):
        q = pd_equilibrium_step(READY_Q, torque_at(q), kp)
    return q


def tracking(log, reference) -> np.ndarray:
    """Return the absolute error of each joint at each instant, mrad, (N, 7)."""
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
    """Return the differences of the other functions and the library's."""
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
    """Return the errors of seven controllers on a motion of all joints, mrad."""
    laws = {
        "PD": springs,
        "PD and gravity": springs_and_gravity,
        "feedforward": feedforward,
        "model at q, no PD": without_springs,
        "gains outside M": gains_outside,
        "computed torque": equal_springs(),
    }
    logs = {"the model file's servos": day5_mujoco.servos_follow(swing, 2.0)}
    for name, law in laws.items():
        logs[name] = run(model, arm, law, swing, 2.0)
    return {name: tracking(log, swing) for name, log in logs.items()}


def off_servo(tau: np.ndarray) -> np.ndarray:
    """Return the torque of MuJoCo's servos minus the wanted torque, N m, (7,)."""
    model = panda.load("panda_nohand")
    data = simulate.start(model, READY_Q, [0.1, -0.1] * 3 + [0.1])
    servos = day5_mujoco.servos_of(model)
    data.ctrl[:] = servo_ctrl(tau, data.qpos, data.qvel, servos.kp, servos.kd)
    mujoco.mj_forward(model, data)  # fills actuator_force at this instant
    return data.actuator_force - tau


def through_servos(law, reference) -> float:
    """Return the largest error of servos that are used as motors at 500 Hz, mrad."""
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
    # A closed loop hides mistakes: with the gains outside M it tracks as well.
    at = day5_mujoco.states(model, TRIALS, SEED)
    lab.check("computed_torque - MuJoCo's mj_inverse, N m", off_inverse(model, arm, at))
    print("  Differences from the library robo47.control:")
    for name, off in off_library(at).items():
        lab.check(name, off)

    lab.step("2. The steady-state error of PD control: gravity over stiffness")
    predicted = rest(lambda q: arm.at(q).gravity_torque, KP)
    log = run(model, arm, springs, goal, 6.0)
    low = [1e3 * (READY_Q - q)[3] for q in (predicted, log.q[-1])]
    lab.predict("joint 4 hangs low by", *low, "mrad")
    top, *low = (arm.at(q).T_world_ee[2, 3] for q in (READY_Q, predicted, log.q[-1]))
    lab.predict("the hand hangs low by", *(1e3 * (top - z) for z in low), "mm")
    lab.record("sag_predicted", log.q[-1] - predicted, label="|sag - predicted|, rad")
    log = run(model, arm, springs_and_gravity, goal, 0.5)
    lab.check("error with the gravity torque added, rad", log.q - READY_Q)

    lab.step("3. Computed torque: the same error dynamics in every joint")
    apart = []
    k = round(0.3 * RATE)
    for zeta in (0.5, 1.0, 2.0):
        log = run(model, arm, equal_springs(10.0, zeta), goal, 1.0, READY_Q - E0)
        wanted = error_response(log.t, 10.0, zeta)
        e = (READY_Q - log.q) / E0
        apart.append(np.abs(e.T - wanted).max())
        lab.predict(f"zeta {zeta:g}: after 0.3 s", wanted[k], e[k].mean(), "of e0")
    lab.record("error_dynamics", apart, label="|curve - predicted|, of e0", seed=0)
    log = run(model, arm, gains_outside, goal, 0.5, READY_Q - E0)
    off = (READY_Q - log.q) / E0 - error_response(log.t, OMEGA, 1.0)[:, None]
    print(f"  Gains outside M: |curve - predicted| is {np.abs(off).max():.3f} of e0.")

    lab.step("4. Largest error of seven controllers that track the same motion")
    for name, off in ladder(model, arm, swing).items():
        print(f"  {name:24} {off.max():8.2f} mrad")
    lab.record("tracking", off.max(axis=1), label="computed torque, mrad")

    lab.step("5. A load of 1 kg that the model omits")
    heavy = day5_mujoco.motors(DRIVE, INTEGRATOR, scenes.hang_kilogram)
    # The load per unit inertia, M^-1 J^T F, which the PD terms balance.
    load = lambda q: np.linalg.solve(arm.at(q).M, arm.at(q).J_site[5] * 9.81)  # noqa: E731
    predicted = rest(load, pd_gains(OMEGA, 1.0)[0])
    log = run(heavy, arm, equal_springs(), goal, 1.5)
    low = [1e3 * (READY_Q - q)[3] for q in (predicted, log.q[-1])]
    lab.predict("joint 4 under 1 kg hangs low by", *low, "mrad")
    lab.check("|sag under 1 kg - predicted|, rad", log.q[-1] - predicted)
    log = run(heavy, arm, with_integral(), goal, 2.0)
    lab.check("error with an integral after 2 s, rad", log.q[-1] - READY_Q, limit=1e-5)

    lab.step("6. Side quest: the largest stable natural frequency")
    with lab.side_quest():
        start = READY_Q - 1e-8 * E0
        h = model.opt.timestep
        limit = max_stable_omega(h)
        found = day5_mujoco.breaking(model, equal_springs, 1 / h, start)
        lab.predict("torque every 2 ms, loop breaks at", limit, found, "rad/s")
        lab.check("|predicted limit - measured|, rad/s", limit - found, limit=2.0)
        n = simulate.steps_per_period(model, RATE)
        limit = control.max_stable_omega(h, n)
        found = day5_mujoco.breaking(model, equal_springs, RATE, start)
        what = f"torque every {1e3 / RATE:g} ms, loop breaks at"
        lab.predict(what, limit, found, "rad/s")
        whose = f"the same for the library's limit at {RATE:g} Hz, rad/s"
        lab.check(whose, limit - found, limit=2.0)
        off = off_servo(np.array([5.0, -20, 3, 15, 1, 2, -1]))
        lab.check("|torque of a servo - wanted torque|, N m", off)
        off = through_servos(equal_springs(), swing)
        print(f"  Computed torque through servos has an error of {off:.1f} mrad. Why?")
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
