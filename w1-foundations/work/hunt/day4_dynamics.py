"""Day 4: dynamics. Seven motors hold, move and drop the Panda; MuJoCo checks it.

    make day4                        in the clone: sets everything up, then runs this
    python src/day4_dynamics.py      in w1-foundations/, once that is done

All in world axes about the world's origin: twists (omega; v), wrenches (moment;
force), J_space (6, 7). Metres, radians, kilograms, newtons, seconds.
"""

import kit  # noqa: F401 (goes on in the kit's own Python)
from labkit.hunt.hunted import hunted
import mujoco
import numpy as np

from robo47 import cli, panda, simulate
from robo47.lesson.lab import Lab
from robo47.screws import skew
from robo47.verify import each, random_q

import day4_mujoco

READY_Q = panda.READY_Q  # the handout's home_q: seven joint angles, radians
TRIALS = 100  # random motions that your own code is judged on
LIBRARY_TRIALS = 2_000  # and the library; MuJoCo's own answers take most of the time
SEED = 47  # the same random motions at every run
FASTEST, HARDEST = 2.0, 10.0  # rad/s and rad/s^2 in them; real motors do about that
PUSH = np.array([0.0, 10.0, 0.0])  # newtons on the hand; 50 drive it into its limits
RATE = 50.0  # Hz, of the loops in step 7; slower ones brake the glide, 500 do not


def spatial_inertia(m: float, c: np.ndarray, inertia: np.ndarray) -> np.ndarray:
    """Return a body's 6x6 inertia about the origin, from its mass m and its centre c.

    inertia, (3, 3), is about c, in world axes. For 2 kg at (0, 0, 1) with inertia 0
    the diagonal is (2, 2, 0, 2, 2, 2).
    """
    return hunted("spatial_inertia", m, c, inertia)  # closed: suspect it? Write it anew here


def link_inertias(
    T_links: np.ndarray, masses: np.ndarray, coms: np.ndarray, inertias: np.ndarray
) -> np.ndarray:
    """Return every link's 6x6 inertia about the world's origin, (7, 6, 6).

    T_links (7, 4, 4) are T_world_link; coms (7, 3) and inertias (7, 3, 3) stand in the
    links' own axes. With every T the identity it is spatial_inertia of each.
    """
    return hunted("link_inertias", T_links, masses, coms, inertias)  # closed: suspect it? Write it anew here


def mass_matrix(J_space: np.ndarray, G: np.ndarray, armature: np.ndarray) -> np.ndarray:
    """Return M, (7, 7), kg m^2, from J_space (6, 7), G (7, 6, 6) and armature (7,).

    One hinge about z, with 2 kg at 1 m: its entry is 2 + armature.
    """
    # region 4.3
    M = np.diag(armature)
    for i, G_i in enumerate(G):
        J_i = J_space.copy()
        J_i[:, i + 1 :] = 0.0  # joints beyond link i do not move it
        M = M + J_i.T @ G_i @ J_i
    return M
    # endregion 4.3


def gravity_torque(
    J_space: np.ndarray, masses: np.ndarray, coms_world: np.ndarray, g: np.ndarray
) -> np.ndarray:
    """Return the torque that holds the arm, (7,); g is the vector (0, 0, -9.81).

    One hinge about +y, with 1 kg at (1, 0, 0): -9.81 N m.
    """
    return hunted("gravity_torque", J_space, masses, coms_world, g)  # closed: suspect it? Write it anew here


def ad(V: np.ndarray) -> np.ndarray:
    """Return ad(V), (6, 6): how a twist changes that is carried along by V, (6,).

    ad(V) @ V = 0: carried along by itself, a twist stays the same.
    """
    # region 4.5
    W = skew(V[:3])
    zero = np.zeros((3, 3))
    return np.block([[W, zero], [skew(V[3:]), W]])
    # endregion 4.5


def inverse_dynamics(
    J_space: np.ndarray, G: np.ndarray, qd: np.ndarray, qdd: np.ndarray, g: np.ndarray
) -> np.ndarray:
    """Return the torque, (7,), for an acceleration qdd, without armature and friction.

    The pendulum of task 4.4 with qdd = 1: -8.81 N m.
    """
    return hunted("inverse_dynamics", J_space, G, qd, qdd, g)  # closed: suspect it? Write it anew here


def bias_torque(
    J_space: np.ndarray, G: np.ndarray, qd: np.ndarray, g: np.ndarray
) -> np.ndarray:
    """Return the torque of Coriolis, centrifugal and gravity forces together, (7,).

    At qd = 0 it is gravity_torque.
    """
    return hunted("bias_torque", J_space, G, qd, g)  # closed: suspect it? Write it anew here


def forward_dynamics(
    M: np.ndarray, bias: np.ndarray, damping: np.ndarray, qd: np.ndarray,
    tau: np.ndarray,
) -> np.ndarray:  # fmt: skip
    """Return the acceleration that a torque tau gives, (7,): what the simulator does.

    With tau = bias and qd = 0 nothing accelerates.
    """
    return hunted("forward_dynamics", M, bias, damping, qd, tau)  # closed: suspect it? Write it anew here


def energy(
    M: np.ndarray, qd: np.ndarray, masses: np.ndarray, coms_world: np.ndarray,
    g: np.ndarray,
) -> np.ndarray:  # fmt: skip
    """Return (kinetic, potential) in joules; potential is 0 at the world's origin.

    One hinge with M = 2 and qd = 3: 9 J.
    """
    return hunted("energy", M, qd, masses, coms_world, g)  # closed: suspect it? Write it anew here


def let_go(model, arm, share: float, *phases: tuple) -> np.ndarray:
    """Return the hand's way, (n, 3), on a share of your gravity_torque, in phases."""

    def hold(t: float, q: np.ndarray, qd: np.ndarray) -> np.ndarray:
        now = arm.at(q)  # J and the centres of mass, as Days 1 to 3 make them
        given = now.J_space, arm.masses, now.coms_world, arm.gravity
        return share * gravity_torque(*given)

    data = simulate.start(model, READY_Q)
    path = [READY_Q]
    for seconds, force in phases:  # s, and newtons on the hand
        push = simulate.push_at("attachment_site", np.append(np.zeros(3), force))
        run = simulate.run(model, data, hold, seconds, rate=RATE, push=push)
        path.extend(run.q[1:])
    p = np.array([arm.at(q).T_world_ee[:3, 3] for q in path])
    return p - p[0]


def float_and_push(lab: Lab, model, arm) -> None:
    """Let the arm go, let it float, and push it: on your gravity_torque alone."""
    for share, seconds in ((0.0, 0.5), (0.9, 2.0), (0.99, 2.0)):
        path = let_go(model, arm, share, (seconds, 0 * PUSH))
        moved = 1000 * np.linalg.norm(path[-1])
        print(f"  {share:4.0%} of gravity_torque: {moved:4.0f} mm in {seconds} s")
        lab.measured(f"way of the hand on {share:.0%} of gravity_torque, mm", moved)
    path = let_go(model, arm, 1.0, (5.0, 0 * PUSH))
    drift = np.linalg.norm(path, axis=1)
    lab.record("float_5s", drift, label="all of it: the hand's drift in 5 s, m")
    path = let_go(model, arm, 1.0, (0.5, PUSH), (4.5, 0 * PUSH))
    away = np.linalg.norm(path[-1])
    speed = np.linalg.norm(np.diff(path, axis=0), axis=1) * RATE
    print(f"  {np.linalg.norm(PUSH):.0f} N for 0.5 s: up to {speed.max():.2f} m/s; "
          f"{away:.2f} m in 5 s, then {speed[-1]:.3f} m/s")  # fmt: skip
    lab.measured("its speed 4.5 s after a push of 10 N for 0.5 s, m/s", speed[-1])


def mujoco_inertias(model: mujoco.MjModel, q: np.ndarray) -> np.ndarray:
    """Return spatial_inertia of links that are where MuJoCo has them, (7, 6, 6)."""
    data = mujoco.MjData(model)
    data.qpos[:] = q
    mujoco.mj_kinematics(model, data)  # fills xipos, ximat: centre and principal axes
    G = []
    for link in [model.body(f"link{i}").id for i in range(1, 8)]:
        R = data.ximat[link].reshape(3, 3)
        inertia = R @ np.diag(model.body_inertia[link]) @ R.T
        G.append(spatial_inertia(model.body_mass[link], data.xipos[link], inertia))
    return np.array(G)


def mujoco_masses(model: mujoco.MjModel, q: np.ndarray) -> np.ndarray:
    """Return MuJoCo's mass matrices at configurations q, (n, 7, 7)."""
    data = mujoco.MjData(model)
    M = np.empty((len(q), 7, 7))
    for one, rows in zip(q, M, strict=True):
        data.qpos[:] = one
        mujoco.mj_forward(model, data)  # fills M, in a form that only mj_mulM reads
        for unit, row in zip(np.eye(7), rows, strict=True):
            mujoco.mj_mulM(model, data, row, unit)  # fills row: M @ unit, of M = M^T
    return M


def mujoco_bias(model: mujoco.MjModel, q: np.ndarray, qd: np.ndarray) -> np.ndarray:
    """Return MuJoCo's Coriolis, centrifugal and gravity torques at states, (n, 7)."""
    data = mujoco.MjData(model)
    bias = []
    for position, velocity in zip(q, qd, strict=True):
        data.qpos[:] = position
        data.qvel[:] = velocity
        mujoco.mj_forward(model, data)  # fills qfrc_bias
        bias.append(data.qfrc_bias.copy())
    return np.array(bias)


def mujoco_inverse(model: mujoco.MjModel, now: day4_mujoco.Motions) -> np.ndarray:
    """Return the torques that MuJoCo finds for motions, (n, 7)."""
    data = mujoco.MjData(model)
    torques = []
    for q, qd, qdd in zip(now.q, now.qd, now.qdd, strict=True):
        data.qpos[:] = q
        data.qvel[:] = qd
        data.qacc[:] = qdd
        mujoco.mj_inverse(model, data)  # fills qfrc_inverse
        torques.append(data.qfrc_inverse.copy())
    return np.array(torques)


def mujoco_forward(
    model: mujoco.MjModel, now: day4_mujoco.Motions, tau: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the accelerations that motors give, (n, 7), and the next velocities."""
    data = mujoco.MjData(model)
    qdd = []
    after = []
    for q, qd, ctrl in zip(now.q, now.qd, tau, strict=True):
        mujoco.mj_resetData(model, data)  # nothing is left of the state before
        data.qpos[:] = q
        data.qvel[:] = qd
        data.ctrl[:] = ctrl  # of a motor it is the torque itself
        mujoco.mj_forward(model, data)  # fills qacc, and moves nothing
        qdd.append(data.qacc.copy())
        mujoco.mj_step(model, data)  # moves on by one time step: new qpos and qvel
        after.append(data.qvel.copy())
    return np.array(qdd), np.array(after)


def mujoco_energies(model: mujoco.MjModel, q: np.ndarray, qd: np.ndarray) -> np.ndarray:
    """Return MuJoCo's kinetic and potential energy of link1 to link7, J, (n, 2)."""
    model.opt.enableflags |= mujoco.mjtEnableBit.mjENBL_ENERGY  # else they stay 0
    data = mujoco.MjData(model)
    link0 = model.body("link0")  # never moves, but MuJoCo counts its weight
    still = -link0.mass[0] * model.opt.gravity @ link0.ipos
    energies = []
    for position, velocity in zip(q, qd, strict=True):
        data.qpos[:] = position
        data.qvel[:] = velocity
        mujoco.mj_forward(model, data)  # fills energy: potential first, then kinetic
        potential, kinetic = data.energy
        energies.append([kinetic, potential - still])
    return np.array(energies)


def weigh(lab: Lab, model, now: day4_mujoco.Motions, G: np.ndarray) -> np.ndarray:
    """Compare your mass matrices with MuJoCo's, and return them, (n, 7, 7)."""
    M = each(mass_matrix, now.J, G, now.armature)
    lab.show("M when the arm is ready, kg m2", M[0], 3)
    truth = mujoco_masses(model, now.q)
    off = np.abs(M - truth).max(axis=(1, 2))
    lab.record("mass_matrix", off, label=f"mass_matrix at {TRIALS} q, kg m2",
               config="random", seed=SEED)  # fmt: skip
    # The lesson of the day: symmetric, positive definite, and wrong all the same.
    print(f"  {'what is wrong':28}   off by   asymmetric by   least eigenvalue")
    found = day4_mujoco.wrong_masses(link_inertias, mass_matrix, now, truth)
    for what, bad in found.items():
        print(f"  {what:28}{bad.off:9.3f}{bad.asymmetric:16.0e}{bad.least:19.3f}")
    many = random_q(model, LIBRARY_TRIALS, SEED)
    off = day4_mujoco.library_masses(model, many) - mujoco_masses(model, many)
    lab.check(f"the library robo47.dynamics_batch at {LIBRARY_TRIALS:,}", off)
    return M


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    model = panda.load("panda_nohand", drive="torque")  # ctrl is a torque: no servos
    print(panda.describe("panda_nohand"))
    arm = panda.arm(model)
    rng = np.random.default_rng(SEED)
    now = day4_mujoco.motions(model, TRIALS, SEED, FASTEST, HARDEST)

    lab.step("1. A body is many points; ten numbers say how all of them move")
    body = day4_mujoco.clouds(TRIALS, rng)
    G = each(spatial_inertia, body.m, body.c, body.inertia)
    off = (G @ body.V[..., None])[..., 0] - body.momentum
    lab.check("largest |G V - the points' momentum|", off)

    lab.step("2. Every link of the arm, where it is now")
    lab.show("link1 to link7, kg", arm.masses, 3)
    G = each(link_inertias, now.T, *now.links)
    off = G - [mujoco_inertias(model, x) for x in now.q]
    lab.check("largest |G - from MuJoCo's centres and axes|", off)

    lab.step("3. The mass matrix: how heavy each joint feels")
    M = weigh(lab, model, now, G)

    lab.step("4. Gravity: what the motors give to hold the arm still")
    tau = each(gravity_torque, now.J, now.links[0], now.coms, now.g)
    lab.show("gravity_torque when the arm is ready, N m", tau[0], 3)
    lab.measured("torque that holds joint4 at ready, N m", tau[0, 3])
    off = tau - mujoco_bias(model, now.q, 0 * now.qd)
    lab.check("largest |by hand - MuJoCo's bias at rest|, N m", off)

    lab.step("5. The torque of a motion: out along the arm, and back")
    V, W = rng.normal(size=(2, TRIALS, 6))
    (w, v), (w2, v2) = np.split(V, 2, axis=1), np.split(W, 2, axis=1)
    truth = np.hstack([np.cross(w, w2), np.cross(v, w2) + np.cross(w, v2)])
    off = (each(ad, V) @ W[..., None])[..., 0] - truth
    lab.check("largest |ad(V) W - the cross products|", off)
    off = each(inverse_dynamics, now.J, G, now.qd, now.qdd, now.g)
    off = off - mujoco_inverse(model, now)
    print(f"  Without armature and damping: off by {np.abs(off).max():.2f} N m")
    off = np.abs(off + now.armature * now.qdd + now.damping * now.qd).max(axis=1)
    lab.record("inverse_dynamics", off, label="with them, N m",
               config="random", seed=SEED)  # fmt: skip
    bias = each(bias_torque, now.J, G, now.qd, now.g)
    off = bias - mujoco_bias(model, now.q, now.qd)
    lab.check("largest |bias_torque - MuJoCo's|, N m", off)

    lab.step("6. Forwards: what the simulator does with a torque")
    share = np.random.default_rng(TRIALS).uniform(-0.5, 0.5, now.q.shape)
    tau = share * simulate.limits(model)[1]
    qdd, qd_next = mujoco_forward(model, now, tau)
    off = each(forward_dynamics, M, bias, now.damping, now.qd, tau) - qdd
    lab.check("largest |qdd - MuJoCo's|, rad/s2", off)
    # MuJoCo's implicitfast takes the damping at the end of its step: M + h D, not M.
    h = model.opt.timestep
    M_step = M + h * np.diag(arm.damping)
    qdd = each(forward_dynamics, M_step, bias, now.damping, now.qd, tau)
    lab.check("its next velocity, predicted, rad/s", now.qd + h * qdd - qd_next)

    lab.step("7. Let go, float, push")
    float_and_push(lab, model, arm)

    lab.step("8. Side quest: energy, and who makes it")
    with lab.side_quest():
        off = each(energy, M, now.qd, now.links[0], now.coms, now.g)
        off = off - mujoco_energies(model, now.q, now.qd)
        lab.check("largest |energy - MuJoCo's|, J", off)
    for name, ms in (("IMPLICITFAST", 2), ("IMPLICITFAST", 1), ("RK4", 2)):
        gain = day4_mujoco.swing(name, ms / 1000)
        print(f"  {name:12} at {ms} ms: a free swing of 1 s gains {gain:.2g} J")
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
