"""Day 4: dynamics. Mass matrix, gravity torque, recursive Newton-Euler, energy.

    make day4                        in the clone: sets everything up, then runs this
    python src/day4_dynamics.py      in w1-foundations/, once that is done

Twists (omega; v), wrenches (moment; force) and J_space (6, 7) are expressed in the
world frame, about the world's origin. Metres, radians, kilograms, newtons, seconds.
"""

import kit  # noqa: F401 (goes on in the kit's own Python)
import mujoco
import numpy as np

from robo47 import cli, panda, simulate
from robo47.lesson.lab import Lab
from robo47.screws import skew
from robo47.verify import each, random_q

import day4_mujoco

READY_Q = panda.READY_Q  # the handout's home_q: seven joint angles, radians
TRIALS = 100  # random motions with which your own code is compared
LIBRARY_TRIALS = 2_000  # the same for the library; MuJoCo takes most of the time
SEED = 47  # the same random motions at every run
FASTEST, HARDEST = 2.0, 10.0  # rad/s, rad/s^2: their limits, near the real motors'
PUSH = np.array([0.0, 10.0, 0.0])  # N on the hand; 50 N drive it to a joint limit
RATE = 50.0  # Hz, of the loops in step 7; a slower loop brakes the glide more


def spatial_inertia(m: float, c: np.ndarray, inertia: np.ndarray) -> np.ndarray:
    """Return the spatial inertia of a body about the world's origin, (6, 6).

    m is the mass, kg; c (3,) is the centre of mass, metres, and inertia (3, 3) is the
    inertia about the centre of mass, kg m^2, both expressed in the world frame. The
    result maps the twist (omega; v) to the momentum (angular; linear) about the origin.
    Source: Featherstone, Rigid Body Dynamics Algorithms, equation 2.63. For 2 kg at
    (0, 0, 1) with inertia 0 the diagonal is (2, 2, 0, 2, 2, 2).
    """
    # region 4.1
    C = skew(c)  # cross-product matrix of the centre of mass
    about_origin = inertia + m * C @ C.T  # inertia about the origin (parallel axes)
    return np.block([[about_origin, m * C], [m * C.T, m * np.eye(3)]])  # four blocks
    # endregion 4.1


def link_inertias(
    T_links: np.ndarray, masses: np.ndarray, coms: np.ndarray, inertias: np.ndarray
) -> np.ndarray:
    """Return the spatial inertia of each link about the world's origin, (7, 6, 6).

    T_links (7, 4, 4) are the poses T_world_link and masses (7,) the masses, kg. coms
    (7, 3) are the centres of mass, metres, and inertias (7, 3, 3) the inertias about
    them, kg m^2, both expressed in the frame of each link. Express them in the world
    frame and use `spatial_inertia`. If every T is the identity, the result is
    `spatial_inertia` of each link's own numbers. Source: Lynch and Park, Modern
    Robotics, section 8.2.3.
    """
    # region 4.2
    G = []  # the list of spatial inertias
    for T, m, c, inertia in zip(T_links, masses, coms, inertias, strict=True):
        R, p = T[:3, :3], T[:3, 3]  # rotation and translation of the link
        c_world = R @ c + p  # centre of mass in the world frame
        about_com = R @ inertia @ R.T  # inertia about the centre of mass
        G.append(spatial_inertia(m, c_world, about_com))  # one spatial inertia
    return np.array(G)  # the spatial inertias
    # endregion 4.2


def mass_matrix(J_space: np.ndarray, G: np.ndarray, armature: np.ndarray) -> np.ndarray:
    """Return the mass matrix M of the arm, kg m^2, (7, 7), with the armature.

    J_space (6, 7) is the space Jacobian with columns (omega; v); G (7, 6, 6) are the
    spatial inertias of `link_inertias`; armature (7,) is the inertia of each motor's
    rotor, kg m^2, as its joint experiences it. qd . M qd / 2 is the kinetic energy.
    Joint i moves link i and all later links. One hinge about z, with 2 kg at 1 m: its
    entry is 2 + armature. Source: Modern Robotics, section 8.4.
    """
    # region 4.3
    M = np.diag(armature)  # inertia of the rotors
    for i, G_i in enumerate(G):
        J_i = J_space.copy()  # Jacobian of link i
        J_i[:, i + 1 :] = 0.0  # the columns of the joints beyond link i
        M = M + J_i.T @ G_i @ J_i  # mass matrix of the links up to link i
    return M
    # endregion 4.3


def gravity_torque(
    J_space: np.ndarray, masses: np.ndarray, coms_world: np.ndarray, g: np.ndarray
) -> np.ndarray:
    """Return the gravity torque g(q), (7,), N m, which holds the arm at rest.

    J_space (6, 7) is the space Jacobian with columns (omega; v), masses (7,) are in kg,
    and coms_world (7, 3) are the links' centres of mass, metres, expressed in the world
    frame. g is the acceleration of gravity, the vector (0, 0, -9.81) m/s^2. The torque
    is the gradient of the potential energy in the joint angles; joint i carries link i
    and all later links. One hinge about +y, with 1 kg at (1, 0, 0): -9.81 N m.
    Source: Modern Robotics, section 8.1.1.
    """
    # region 4.4
    tau = np.zeros(len(masses))  # the initial torques
    for i, (m, c) in enumerate(zip(masses, coms_world, strict=True)):
        J_com = J_space[3:] - skew(c) @ J_space[:3]  # velocity of c for each joint
        tau[: i + 1] -= m * g @ J_com[:, : i + 1]  # torque that holds one weight
    return tau
    # endregion 4.4


def ad(V: np.ndarray) -> np.ndarray:
    """Return ad(V), (6, 6), the matrix of the Lie bracket of twists.

    V (6,) is a twist (omega; v), rad/s and m/s. A twist W that moves with a body of
    twist V changes at the rate ad(V) @ W, which is (omega x omega2; v x omega2 +
    omega x v2) for W = (omega2; v2). ad(V) @ V = 0. Source: Modern Robotics, section
    8.2.2.
    """
    # region 4.5
    W = skew(V[:3])  # cross-product matrix of omega
    zero = np.zeros((3, 3))  # block above the diagonal
    return np.block([[W, zero], [skew(V[3:]), W]])  # the blocks of ad(V)
    # endregion 4.5


def inverse_dynamics(
    J_space: np.ndarray, G: np.ndarray, qd: np.ndarray, qdd: np.ndarray, g: np.ndarray
) -> np.ndarray:
    """Return the joint torques of a motion, (7,), N m: recursive Newton-Euler.

    J_space (6, 7) is the space Jacobian, whose columns are the screws S_i; G (7, 6, 6)
    are the spatial inertias of `link_inertias`; qd (7,) and qdd (7,) are the joint
    velocities, rad/s, and accelerations, rad/s^2; g is the vector (0, 0, -9.81).
    Outward, V_i = V_(i-1) + S_i qd_i and A_i = A_(i-1) + S_i qdd_i + ad(V_i) S_i qd_i,
    from V_0 = 0 and A_0 = (0; -g). Inward, add the wrenches of link i and all later
    links; tau_i is their product with S_i. Armature and damping are not included. The
    pendulum of task 4.4 with qdd = 1: -8.81 N m. Source: Modern Robotics, section 8.3.
    """
    # region 4.6
    V = np.zeros(6)  # twist of the base
    A = np.concatenate([np.zeros(3), -g])  # acceleration of the base, which carries g
    wrenches = []  # the list of wrenches on the links
    # Outward, from the base to the tip.
    for S, G_i, speed, acc in zip(J_space.T, G, qd, qdd, strict=True):
        V = V + S * speed  # twist of the link
        ad_V = ad(V)  # rate of whatever moves with the link
        A = A + S * acc + ad_V @ S * speed  # acceleration of the link
        wrenches.append(G_i @ A - ad_V.T @ G_i @ V)  # rate of the link's momentum
    F = np.zeros(6)  # wrench beyond the tip
    tau = np.zeros(len(qd))  # the initial torques
    for i in reversed(range(len(qd))):  # inward, from the tip to the base
        F = F + wrenches[i]  # wrench on link i and all later links
        tau[i] = J_space[:, i] @ F  # component of the wrench along the joint's screw
    return tau
    # endregion 4.6


def bias_torque(
    J_space: np.ndarray, G: np.ndarray, qd: np.ndarray, g: np.ndarray
) -> np.ndarray:
    """Return the bias: Coriolis, centrifugal and gravity torques together, (7,), N m.

    The arguments are defined as in `inverse_dynamics`: J_space (6, 7), G (7, 6, 6), the
    joint velocities qd (7,), rad/s, and the vector g. The bias is the torque of a
    motion with qdd = 0. At qd = 0 it is gravity_torque. Source: Modern Robotics,
    section 8.1.
    """
    # region 4.6
    return inverse_dynamics(J_space, G, qd, np.zeros(len(qd)), g)  # torque for qdd = 0
    # endregion 4.6


def forward_dynamics(
    M: np.ndarray, bias: np.ndarray, damping: np.ndarray, qd: np.ndarray,
    tau: np.ndarray,
) -> np.ndarray:  # fmt: skip
    """Return the joint accelerations that motor torques cause, (7,), rad/s^2.

    M (7, 7) is the mass matrix with armature, kg m^2; bias (7,) is the torque of
    `bias_torque`, N m; damping (7,) is the joints' damping, N m s/rad, which opposes
    the joint velocities qd (7,), rad/s; tau (7,) are the motor torques, N m. Solve
    M qdd + bias + damping qd = tau; M is always invertible. With tau = bias and qd = 0
    nothing accelerates. Source: Modern Robotics, section 8.5.
    """
    # region 4.8
    net = tau - bias - damping * qd  # torque for the acceleration
    return np.linalg.solve(M, net)  # solution of the linear system
    # endregion 4.8


def energy(
    M: np.ndarray, qd: np.ndarray, masses: np.ndarray, coms_world: np.ndarray,
    g: np.ndarray,
) -> np.ndarray:  # fmt: skip
    """Return the kinetic and the potential energy of the arm, (2,), joules.

    M (7, 7) is the mass matrix, kg m^2, and qd (7,) are the joint velocities, rad/s;
    masses (7,) are in kg, and coms_world (7, 3) are the centres of mass, metres,
    expressed in the world frame; g is the vector (0, 0, -9.81) m/s^2. The potential
    energy of a mass at the world's origin is 0. One hinge with M = 2 and qd = 3: 9 J.
    Source: Modern Robotics, section 8.1.1.
    """
    # region 4.9
    kinetic = 0.5 * qd @ M @ qd  # kinetic energy
    potential = -np.sum(masses * (coms_world @ g))  # potential energy
    return np.array([kinetic, potential])  # the kinetic and the potential energy
    # endregion 4.9


def let_go(model, arm, fraction: float, *phases: tuple) -> np.ndarray:
    """Return the hand's displacement, (n, 3), metres, over phases (seconds, force).

    The motors give a fraction of your gravity_torque.
    """

    def hold(t: float, q: np.ndarray, qd: np.ndarray) -> np.ndarray:
        now = arm.at(q)  # J and the centres of mass, as on Days 1 to 3
        given = now.J_space, arm.masses, now.coms_world, arm.gravity
        return fraction * gravity_torque(*given)

    data = simulate.start(model, READY_Q)
    path = [READY_Q]
    for seconds, force in phases:  # s, and newtons on the hand
        push = simulate.push_at("attachment_site", np.append(np.zeros(3), force))
        run = simulate.run(model, data, hold, seconds, rate=RATE, push=push)
        path.extend(run.q[1:])
    p = np.array([arm.at(q).T_world_ee[:3, 3] for q in path])
    return p - p[0]


def float_and_push(lab: Lab, model, arm) -> None:
    """Let the arm go, let it float, and push it, with your gravity_torque alone."""
    for fraction, seconds in ((0.0, 0.5), (0.9, 2.0), (0.99, 2.0)):
        path = let_go(model, arm, fraction, (seconds, 0 * PUSH))
        moved = 1000 * np.linalg.norm(path[-1])
        print(f"  {fraction:4.0%} of gravity_torque: the hand moves {moved:3.0f} mm "
              f"in {seconds} s")  # fmt: skip
        lab.measured(f"way of the hand on {fraction:.0%} of gravity_torque, mm", moved)
    path = let_go(model, arm, 1.0, (5.0, 0 * PUSH))
    drift = np.linalg.norm(path, axis=1)
    lab.record("float_5s", drift, label="all of it: drift of the hand in 5 s, m")
    path = let_go(model, arm, 1.0, (0.5, PUSH), (4.5, 0 * PUSH))
    away = np.linalg.norm(path[-1])
    speed = np.linalg.norm(np.diff(path, axis=0), axis=1) * RATE
    print(f"  pushed with {np.linalg.norm(PUSH):.0f} N for 0.5 s: up to "
          f"{speed.max():.2f} m/s; after 5 s {away:.2f} m away, "
          f"{speed[-1]:.3f} m/s")  # fmt: skip
    lab.measured("its speed 4.5 s after a push of 10 N for 0.5 s, m/s", speed[-1])


def mujoco_inertias(model: mujoco.MjModel, q: np.ndarray) -> np.ndarray:
    """Return spatial_inertia of the links at the poses that MuJoCo has, (7, 6, 6)."""
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
        mujoco.mj_forward(model, data)  # computes M in a sparse form
        for unit, row in zip(np.eye(7), rows, strict=True):
            mujoco.mj_mulM(model, data, row, unit)  # fills row with M @ unit
    return M


def mujoco_bias(model: mujoco.MjModel, q: np.ndarray, qd: np.ndarray) -> np.ndarray:
    """Return MuJoCo's bias (Coriolis, centrifugal, gravity), N m, (n, 7)."""
    data = mujoco.MjData(model)
    bias = []
    for position, velocity in zip(q, qd, strict=True):
        data.qpos[:] = position
        data.qvel[:] = velocity
        mujoco.mj_forward(model, data)  # fills qfrc_bias
        bias.append(data.qfrc_bias.copy())
    return np.array(bias)


def mujoco_inverse(model: mujoco.MjModel, now: day4_mujoco.Motions) -> np.ndarray:
    """Return MuJoCo's inverse dynamics of motions, N m, (n, 7)."""
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
    """Return MuJoCo's accelerations and next velocities under tau, (n, 7) each."""
    data = mujoco.MjData(model)
    qdd = []
    after = []
    for q, qd, ctrl in zip(now.q, now.qd, tau, strict=True):
        mujoco.mj_resetData(model, data)  # removes the previous state
        data.qpos[:] = q
        data.qvel[:] = qd
        data.ctrl[:] = ctrl  # the command of a motor is its torque
        mujoco.mj_forward(model, data)  # fills qacc and does not advance time
        qdd.append(data.qacc.copy())
        mujoco.mj_step(model, data)  # advances qpos and qvel by one time step
        after.append(data.qvel.copy())
    return np.array(qdd), np.array(after)


def mujoco_energies(model: mujoco.MjModel, q: np.ndarray, qd: np.ndarray) -> np.ndarray:
    """Return MuJoCo's kinetic and potential energy of link1 to link7, J, (n, 2)."""
    model.opt.enableflags |= mujoco.mjtEnableBit.mjENBL_ENERGY  # energies are off
    data = mujoco.MjData(model)
    link0 = model.body("link0")  # never moves, but MuJoCo includes its weight
    still = -link0.mass[0] * model.opt.gravity @ link0.ipos
    energies = []
    for position, velocity in zip(q, qd, strict=True):
        data.qpos[:] = position
        data.qvel[:] = velocity
        mujoco.mj_forward(model, data)  # fills energy: potential, then kinetic
        potential, kinetic = data.energy
        energies.append([kinetic, potential - still])
    return np.array(energies)


def weigh(lab: Lab, model, now: day4_mujoco.Motions, G: np.ndarray) -> np.ndarray:
    """Compare your mass matrices with MuJoCo's and return yours, (n, 7, 7)."""
    M = each(mass_matrix, now.J, G, now.armature)
    lab.show("M in the ready configuration, kg m2", M[0], 3)
    truth = mujoco_masses(model, now.q)
    off = np.abs(M - truth).max(axis=(1, 2))
    label = f"|M - MuJoCo's M| at {TRIALS} configurations, kg m2"
    lab.record("mass_matrix", off, label=label, config="random", seed=SEED)
    # The lesson of the day: symmetric and positive definite, and nevertheless wrong.
    print(f"  {'mistake':28}    error   asymmetry   smallest eigenvalue")
    found = day4_mujoco.wrong_masses(link_inertias, mass_matrix, now, truth)
    for what, bad in found.items():
        print(f"  {what:28}{bad.off:9.3f}{bad.asymmetric:12.0e}{bad.least:22.3f}")
    many = random_q(model, LIBRARY_TRIALS, SEED)
    off = day4_mujoco.library_masses(model, many) - mujoco_masses(model, many)
    lab.check(f"the library's M at {LIBRARY_TRIALS:,} configurations", off)
    return M


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    model = panda.load("panda_nohand", drive="torque")  # ctrl is a torque: no servos
    print(panda.describe("panda_nohand"))
    arm = panda.arm(model)
    rng = np.random.default_rng(SEED)
    now = day4_mujoco.motions(model, TRIALS, SEED, FASTEST, HARDEST)

    lab.step("1. The spatial inertia of a body: ten parameters for all of its points")
    body = day4_mujoco.clouds(TRIALS, rng)
    G = each(spatial_inertia, body.m, body.c, body.inertia)
    off = (G @ body.V[..., None])[..., 0] - body.momentum
    lab.check("largest |G V - sum of the points' momenta|", off)

    lab.step("2. The spatial inertias of the links, in the world frame")
    lab.show("masses of link1 to link7, kg", arm.masses, 3)
    G = each(link_inertias, now.T, *now.links)
    off = G - [mujoco_inertias(model, x) for x in now.q]
    lab.check("|G - G of MuJoCo's centres and principal axes|", off)

    lab.step("3. The mass matrix")
    M = weigh(lab, model, now, G)

    lab.step("4. The gravity torques, which hold the arm at rest")
    tau = each(gravity_torque, now.J, now.links[0], now.coms, now.g)
    lab.show("gravity_torque in the ready configuration, N m", tau[0], 3)
    lab.measured("torque that holds joint4 at ready, N m", tau[0, 3])
    off = tau - mujoco_bias(model, now.q, 0 * now.qd)
    lab.check("|gravity_torque - MuJoCo's bias at rest|, N m", off)

    lab.step("5. Inverse dynamics: outward along the arm, then inward")
    V, W = rng.normal(size=(2, TRIALS, 6))
    (w, v), (w2, v2) = np.split(V, 2, axis=1), np.split(W, 2, axis=1)
    truth = np.hstack([np.cross(w, w2), np.cross(v, w2) + np.cross(w, v2)])
    off = (each(ad, V) @ W[..., None])[..., 0] - truth
    lab.check("largest |ad(V) W - the cross products|", off)
    off = each(inverse_dynamics, now.J, G, now.qd, now.qdd, now.g)
    off = off - mujoco_inverse(model, now)
    print(f"  Without armature and damping the error is {np.abs(off).max():.2f} N m.")
    off = np.abs(off + now.armature * now.qdd + now.damping * now.qd).max(axis=1)
    label = "|inverse dynamics - MuJoCo's| with both, N m"
    lab.record("inverse_dynamics", off, label=label, config="random", seed=SEED)
    bias = each(bias_torque, now.J, G, now.qd, now.g)
    off = bias - mujoco_bias(model, now.q, now.qd)
    lab.check("largest |bias_torque - MuJoCo's bias|, N m", off)

    lab.step("6. Forward dynamics, as in the simulator")
    fraction = np.random.default_rng(TRIALS).uniform(-0.5, 0.5, now.q.shape)
    tau = fraction * simulate.limits(model)[1]
    qdd, qd_next = mujoco_forward(model, now, tau)
    off = each(forward_dynamics, M, bias, now.damping, now.qd, tau) - qdd
    lab.check("largest |qdd - MuJoCo's qacc|, rad/s2", off)
    # MuJoCo's implicitfast evaluates the damping at the end of the step: M + h D.
    h = model.opt.timestep
    M_step = M + h * np.diag(arm.damping)
    qdd = each(forward_dynamics, M_step, bias, now.damping, now.qd, tau)
    lab.check(
        "|next velocity, predicted - MuJoCo's|, rad/s",
        now.qd + h * qdd - qd_next,
    )

    lab.step("7. Gravity compensation: let go, float, push")
    float_and_push(lab, model, arm)

    lab.step("8. Side quest: the energy, and the integrator that changes it")
    with lab.side_quest():
        off = each(energy, M, now.qd, now.links[0], now.coms, now.g)
        off = off - mujoco_energies(model, now.q, now.qd)
        lab.check("largest |energy - MuJoCo's energy|, J", off)
    for name, ms in (("IMPLICITFAST", 2), ("IMPLICITFAST", 1), ("RK4", 2)):
        gain = day4_mujoco.swing(name, ms / 1000)
        print(
            f"  {name:12} at {ms} ms per step: a free swing of 1 s gains {gain:.2g} J"
        )
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
