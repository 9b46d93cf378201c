"""Day 4: dynamics. Seven motors hold, move and drop the Panda; MuJoCo checks it.

    make day4                        in the clone: sets everything up, then runs this
    python src/day4_dynamics.py      in w1-foundations/, once that is done

All in world axes about the world's origin: twists (omega; v), wrenches (moment;
force), J the space Jacobian (6, 7). Metres, radians, kilograms, newtons, seconds.
"""

import kit  # noqa: F401 (goes on in the kit's own Python)
import mujoco
import numpy as np

from robo47 import cli, panda, simulate, verify
from robo47.fast import dynamics as dynamics_batch
from robo47.lesson.lab import Lab
from robo47.screws import skew

READY_Q = panda.READY_Q  # the handout's home_q: seven joint angles, radians
TRIALS = 100  # random motions that your own code is judged on
LIBRARY_TRIALS = 2_000  # and the library; MuJoCo's own answers take most of the time
SEED = 47  # the same random motions at every run
FASTEST, HARDEST = 2.0, 10.0  # rad/s and rad/s^2 in them; real motors do about that
PUSH = np.array([0.0, 10.0, 0.0])  # newtons on the hand; 50 drive it into its limits
RATE = 50.0  # Hz, of the loops in step 7; gravity is in no hurry: 10 will do


def spatial_inertia(m: float, c: np.ndarray, I: np.ndarray) -> np.ndarray:  # noqa: E741
    """Return a body's 6x6 inertia about the origin, from its mass m and its centre c.

    I, (3, 3), is about c, in world axes. For 2 kg at (0, 0, 1) with I = 0 the diagonal
    is (2, 2, 0, 2, 2, 2).
    """
    # region 4.1
    C = skew(c)
    return np.block([[I + m * C @ C.T, m * C], [m * C.T, m * np.eye(3)]])
    # endregion 4.1


def link_inertias(
    T_links: np.ndarray, masses: np.ndarray, coms: np.ndarray, inertias: np.ndarray
) -> np.ndarray:
    """Return every link's 6x6 inertia about the world's origin, (7, 6, 6).

    T_links (7, 4, 4) are T_world_link; coms (7, 3) and inertias (7, 3, 3) stand in the
    links' own axes. With every T the identity it is spatial_inertia of each.
    """
    # region 4.2
    G = []
    for T, m, c, I in zip(T_links, masses, coms, inertias, strict=True):  # noqa: E741
        R, p = T[:3, :3], T[:3, 3]
        G.append(spatial_inertia(m, R @ c + p, R @ I @ R.T))
    return np.array(G)
    # endregion 4.2


def mass_matrix(J: np.ndarray, G: np.ndarray, armature: np.ndarray) -> np.ndarray:
    """Return M, (7, 7), from J (6, 7), G (7, 6, 6) and the armature (7,), kg m^2.

    One hinge about z, with 2 kg at 1 m: its entry is 2 + armature.
    """
    # region 4.3
    M = np.diag(armature)
    for i, G_i in enumerate(G):
        J_i = J.copy()
        J_i[:, i + 1 :] = 0.0  # joints beyond link i do not move it
        M = M + J_i.T @ G_i @ J_i
    return M
    # endregion 4.3


def gravity_torque(
    J: np.ndarray, masses: np.ndarray, coms_world: np.ndarray, g: np.ndarray
) -> np.ndarray:
    """Return the torque that holds the arm, (7,); g is the vector (0, 0, -9.81).

    One hinge about +y, with 1 kg at (1, 0, 0): -9.81 N m.
    """
    # region 4.4
    tau = np.zeros(len(masses))
    for i, (m, c) in enumerate(zip(masses, coms_world, strict=True)):
        J_com = J[3:] - skew(c) @ J[:3]  # the velocity of c: Day 3's site_jacobian
        tau[: i + 1] -= m * g @ J_com[:, : i + 1]
    return tau
    # endregion 4.4


def ad(V: np.ndarray) -> np.ndarray:
    """Return ad(V), (6, 6): how a twist changes that is carried along by V, (6,).

    ad(V) @ V = 0: carried along by itself, a twist stays the same.
    """
    # region 4.5
    W, zero = skew(V[:3]), np.zeros((3, 3))
    return np.block([[W, zero], [skew(V[3:]), W]])
    # endregion 4.5


def inverse_dynamics(
    J: np.ndarray, G: np.ndarray, qd: np.ndarray, qdd: np.ndarray, g: np.ndarray
) -> np.ndarray:
    """Return the torque, (7,), for an acceleration qdd, without armature and friction.

    The pendulum of task 4.4 with qdd = 1: -8.81 N m.
    """
    # region 4.6
    V, A = np.zeros(6), np.concatenate([np.zeros(3), -g])
    wrenches = []
    for S, G_i, speed, acc in zip(J.T, G, qd, qdd, strict=True):  # from the base out
        V = V + S * speed
        ad_V = ad(V)
        A = A + S * acc + ad_V @ S * speed
        wrenches.append(G_i @ A - ad_V.T @ G_i @ V)
    F, tau = np.zeros(6), np.zeros(len(qd))
    for i in reversed(range(len(qd))):  # from the tip back
        F = F + wrenches[i]
        tau[i] = J[:, i] @ F
    return tau
    # endregion 4.6


def bias_torque(
    J: np.ndarray, G: np.ndarray, qd: np.ndarray, g: np.ndarray
) -> np.ndarray:
    """Return the torque of Coriolis, centrifugal and gravity forces together, (7,).

    At qd = 0 it is gravity_torque.
    """
    # region 4.7
    return inverse_dynamics(J, G, qd, np.zeros(len(qd)), g)
    # endregion 4.7


def forward_dynamics(
    M: np.ndarray, bias: np.ndarray, damping: np.ndarray, qd: np.ndarray,
    tau: np.ndarray,
) -> np.ndarray:  # fmt: skip
    """Return the acceleration that a torque tau gives, (7,): what the simulator does.

    With tau = bias and qd = 0 nothing accelerates.
    """
    # region 4.8
    return np.linalg.solve(M, tau - bias - damping * qd)
    # endregion 4.8


def energy(
    M: np.ndarray, qd: np.ndarray, masses: np.ndarray, coms_world: np.ndarray,
    g: np.ndarray,
) -> np.ndarray:  # fmt: skip
    """Return (kinetic, potential) in joules; potential is 0 at the world's origin.

    One hinge with M = 2 and qd = 3: 9 J.
    """
    # region 4.9
    return np.array([0.5 * qd @ M @ qd, -np.sum(masses * (coms_world @ g))])
    # endregion 4.9


def cloud(rng: np.random.Generator) -> tuple:
    """Return eight random points, what each weighs, and their (m, c, I)."""
    points, weights = rng.uniform(-1, 1, (8, 3)), rng.uniform(0.1, 1, 8)
    c = weights @ points / weights.sum()
    d = points - c
    I = np.eye(3) * (weights @ d**2).sum() - (weights * d.T) @ d  # noqa: E741
    return points, weights, (weights.sum(), c, I)


def momentum(points: np.ndarray, weights: np.ndarray, V: np.ndarray) -> np.ndarray:
    """Return the momentum (angular; linear) of points that move with V, one by one."""
    p = weights[:, None] * (V[3:] + np.cross(V[:3], points))
    return np.concatenate([np.cross(points, p).sum(0), p.sum(0)])


def mujoco_inertias(model: mujoco.MjModel, q: np.ndarray) -> list:
    """Return spatial_inertia of link1 to link7 from where MuJoCo says they are."""
    data, G = mujoco.MjData(model), []
    data.qpos[:] = q
    mujoco.mj_kinematics(model, data)  # fills xipos, ximat: centre and principal axes
    for i in [model.body(f"link{n}").id for n in range(1, 8)]:
        R, c = data.ximat[i].reshape(3, 3), data.xipos[i]
        I = R @ np.diag(model.body_inertia[i]) @ R.T  # noqa: E741
        G.append(spatial_inertia(model.body_mass[i], c, I))
    return G


def mujoco_energy(model: mujoco.MjModel, q: np.ndarray, qd: np.ndarray) -> np.ndarray:
    """Return MuJoCo's kinetic and potential energy of link1 to link7, in joules."""
    model.opt.enableflags |= mujoco.mjtEnableBit.mjENBL_ENERGY  # else they stay 0
    potential, kinetic = simulate.start(model, q, qd).energy
    link0 = model.body("link0")  # never moves, but MuJoCo counts its weight
    still = -link0.mass[0] * model.opt.gravity @ link0.ipos
    return np.array([kinetic, potential - still])


def each(function, *columns: np.ndarray) -> np.ndarray:
    """Return a function's answers to each row of its arguments, (n, ...)."""
    return np.array([function(*row) for row in zip(*columns, strict=True)])


def on_purpose(T: np.ndarray, masses, coms, inertias) -> dict:
    """Return {what is wrong: every G by your own functions, given something wrong}."""
    G, R = link_inertias(T, masses, coms, inertias), T[:, :3, :3]
    R_T, flip = np.swapaxes(R, 1, 2), np.diag([1.0, 1.0, 1.0, -1.0, -1.0, -1.0])
    no_lever = G.copy()
    no_lever[:, :3, :3] = R @ inertias @ R_T
    c_still, I_still = (R_T @ coms[..., None])[..., 0], R_T @ inertias @ R
    return {
        "nothing": G,
        "m [c] with the wrong sign": flip @ G @ flip,
        "m [c] [c]^T forgotten": no_lever,
        "c not turned": link_inertias(T, masses, c_still, inertias),
        "I not turned": link_inertias(T, masses, coms, I_still),
    }


def let_go(model, arm, share: float, *phases: tuple) -> np.ndarray:
    """Return the hand's path, (n, 3), on that share of your own gravity_torque.

    Each phase is (seconds, force on the hand).
    """

    def hold(t: float, q: np.ndarray, qd: np.ndarray) -> np.ndarray:
        now = arm.at(q)  # J and the centres of mass, as Days 1 to 3 make them
        given = now.J_space, arm.masses, now.coms_world, arm.gravity
        return share * gravity_torque(*given)

    data, path = simulate.start(model, READY_Q), [READY_Q]
    for seconds, force in phases:
        push = simulate.push_at("attachment_site", np.append(np.zeros(3), force))
        path.extend(
            simulate.run(model, data, hold, seconds, rate=RATE, push=push).q[1:]
        )
    return np.array([arm.at(q).T_world_ee[:3, 3] for q in path])


def swing(integrator: str, timestep: float) -> float:
    """Return the energy, J, that a free swing of 1 s gains: no motor, no friction."""
    model = panda.load("panda_nohand", drive="torque")
    model.opt.timestep, model.dof_damping[:], model.jnt_limited[:] = timestep, 0.0, 0
    model.opt.integrator = getattr(mujoco.mjtIntegrator, f"mjINT_{integrator}")
    data = simulate.start(model, READY_Q)
    mujoco.mj_step(model, data, round(1.0 / timestep))
    end, start = (data.qpos, data.qvel), (READY_Q, np.zeros(7))
    return (mujoco_energy(model, *end) - mujoco_energy(model, *start)).sum()


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    model = panda.load("panda_nohand", drive="torque")  # ctrl is a torque: no servos
    print(panda.describe("panda_nohand"))
    arm, rng = panda.arm(model), np.random.default_rng(SEED)
    q = np.vstack([READY_Q, verify.random_q(model, TRIALS - 1, SEED)])
    qd = rng.uniform(-FASTEST, FASTEST, q.shape)
    qdd = rng.uniform(-HARDEST, HARDEST, q.shape)
    now = [arm.at(x) for x in q]  # J and the links' poses, as Days 1 to 3 make them
    J, T = np.array([x.J_space for x in now]), np.array([x.T_links for x in now])
    com = np.array([x.coms_world for x in now])
    # What is the same at every q, once for each: masses, com and inertia of the links.
    body = [np.array([x] * TRIALS) for x in panda.inertias(model)]
    armature, damping, g = (
        np.array([x] * TRIALS) for x in (arm.armature, arm.damping, arm.gravity)
    )

    lab.step("1. A body is many points; ten numbers say how all of them move")
    points, weights, own = zip(*[cloud(rng) for _ in q], strict=True)
    V, W = rng.normal(size=(2, TRIALS, 6))
    off = each(lambda one, v: spatial_inertia(*one) @ v, own, V)
    off = off - each(momentum, points, weights, V)
    lab.check("largest |G V - the points' momentum|", off)

    lab.step("2. Every link of the arm, where it is now")
    lab.show("link1 to link7, kg", arm.masses, 3)
    G = each(link_inertias, T, *body)
    off = G - [mujoco_inertias(model, x) for x in q]
    lab.check("largest |G - from MuJoCo's centres and axes|", off)

    lab.step("3. The mass matrix: how heavy each joint feels")
    M, M_mujoco = each(mass_matrix, J, G, armature), verify.mujoco_mass_matrix(model, q)
    lab.show("M when the arm is ready, kg m2", M[0], 3)
    off = np.abs(M - M_mujoco).max(axis=(1, 2))
    lab.record("mass_matrix", off, label=f"mass_matrix at {TRIALS} q, kg m2",
               config="random", seed=SEED)  # fmt: skip
    # The lesson of the day: symmetric, positive definite, and wrong all the same.
    print(f"  {'what is wrong':28}   off by   asymmetric by   least eigenvalue")
    bad = [on_purpose(*one) for one in zip(T, *body, strict=True)]
    for what in bad[0]:
        M_bad = each(mass_matrix, J, [one[what] for one in bad], armature)
        off, skewed = M_bad - M_mujoco, np.abs(M_bad - np.swapaxes(M_bad, 1, 2)).max()
        least = np.linalg.eigvalsh(M_bad).min()
        print(f"  {what:28}{np.abs(off).max():9.3f}{skewed:16.0e}{least:19.3f}")
    more = verify.random_q(model, LIBRARY_TRIALS, SEED)
    off = dynamics_batch.mass_matrix(arm, more) - verify.mujoco_mass_matrix(model, more)
    lab.check(f"the library robo47.dynamics_batch at {LIBRARY_TRIALS:,}", off)

    lab.step("4. Gravity: what the motors give to hold the arm still")
    tau = each(gravity_torque, J, body[0], com, g)
    lab.show("gravity_torque when the arm is ready, N m", tau[0], 3)
    off = tau - verify.mujoco_bias(model, q, 0 * qd)
    lab.check("largest |by hand - MuJoCo's bias at rest|, N m", off)

    lab.step("5. The torque of a motion: out along the arm, and back")
    (w, v), (w2, v2) = np.split(V, 2, axis=1), np.split(W, 2, axis=1)
    cross = np.hstack([np.cross(w, w2), np.cross(v, w2) + np.cross(w, v2)])
    off = (each(ad, V) @ W[..., None])[..., 0] - cross
    lab.check("largest |ad(V) W - the cross products|", off)
    links = each(inverse_dynamics, J, G, qd, qdd, g)
    off = links - verify.mujoco_inverse_dynamics(model, q, qd, qdd)
    print(f"  Without armature and damping: off by {np.abs(off).max():.2f} N m")
    off = np.abs(off + armature * qdd + damping * qd).max(axis=1)
    lab.record("inverse_dynamics", off, label="with them, N m",
               config="random", seed=SEED)  # fmt: skip
    bias = each(bias_torque, J, G, qd, g)
    off = bias - verify.mujoco_bias(model, q, qd)
    lab.check("largest |bias_torque - MuJoCo's|, N m", off)

    lab.step("6. Forwards: what the simulator does with a torque")
    tau = simulate.limits(model)[1] * rng.uniform(-0.5, 0.5, q.shape)
    off = each(forward_dynamics, M, bias, damping, qd, tau)
    off = off - verify.mujoco_acceleration(model, q, qd, tau)
    lab.check("largest |qdd - MuJoCo's|, rad/s2", off)
    h = model.opt.timestep  # implicitfast brakes at the end of its step: M + h D
    slower = M + h * np.diag(arm.damping)
    after = qd + h * each(forward_dynamics, slower, bias, damping, qd, tau)
    off = after - verify.mujoco_step(model, q, qd, tau)
    lab.check("its next velocity, predicted, rad/s", off)

    lab.step("7. Let go, float, push")
    for share, seconds in ((0.0, 0.5), (0.9, 2.0), (0.99, 2.0)):
        hand = let_go(model, arm, share, (seconds, 0 * PUSH))
        moved = 1000 * np.linalg.norm(hand[-1] - hand[0])
        print(f"  {share:4.0%} of gravity_torque: {moved:4.0f} mm in {seconds} s")
    hand = let_go(model, arm, 1.0, (5.0, 0 * PUSH))
    drift = np.linalg.norm(hand - hand[0], axis=1)
    lab.record("float_5s", drift, label="all of it: the hand's drift in 5 s, m")
    hand = let_go(model, arm, 1.0, (0.5, PUSH), (4.5, 0 * PUSH))
    away = np.linalg.norm(hand[-1] - hand[0])
    speed = np.linalg.norm(np.diff(hand, axis=0), axis=1) * RATE
    print(f"  {np.linalg.norm(PUSH):.0f} N for 0.5 s: up to {speed.max():.2f} m/s; "
          f"{away:.2f} m in 5 s, then {speed[-1]:.3f} m/s")  # fmt: skip

    lab.step("8. Side quest: energy, and who makes it")
    with lab.side_quest():
        off = each(energy, M, qd, body[0], com, g)
        off = off - [mujoco_energy(model, *one) for one in zip(q, qd, strict=True)]
        lab.check("largest |energy - MuJoCo's|, J", off)
    for name, ms in (("IMPLICITFAST", 2), ("IMPLICITFAST", 1), ("RK4", 2)):
        gain = swing(name, ms / 1000)
        print(f"  {name:12} at {ms} ms: a free swing of 1 s gains {gain:.2g} J")
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
