"""Capstone of week 1, by functions of which one is wrong.

    make hunt ARGS=--run      do it
    make hunt                 say which function you suspect
"""

from __future__ import annotations

import kit  # noqa: F401 (goes on in the kit's own Python)
import numpy as np
from labkit.hunt.hunted import hunted

from robo47 import cli


def make_T(R: np.ndarray, t: np.ndarray) -> np.ndarray:
    """Return the pose [[R, t], [0, 1]] that turns by R, then moves by t metres.

    make_T(I, (1, 2, 3)) takes the origin to (1, 2, 3).
    """
    return hunted("make_T", R, t)  # closed: suspect it? Write it anew here


def inverse(T: np.ndarray) -> np.ndarray:
    """Return the pose that undoes T, without a matrix inverse.

    "Move by (1, 0, 0)" is undone by "move by (-1, 0, 0)".
    """
    return hunted("inverse", T)  # closed: suspect it? Write it anew here


def link_T(pos: np.ndarray, quat: np.ndarray) -> np.ndarray:
    """Return a body's pose on its parent, from its pos (metres) and quat in the file.

    pos (0, 0, 0.333) and quat (1, 0, 0, 0) put it 0.333 m above the parent.
    """
    return hunted("link_T", pos, quat)  # closed: suspect it? Write it anew here


def joint_T(q: float) -> np.ndarray:
    """Return what a Panda joint at q radians adds: a turn about its z. At 0, none."""
    return hunted("joint_T", q)  # closed: suspect it? Write it anew here


def joint_screws(T_zero: np.ndarray) -> np.ndarray:
    """Return the screws, (7, 6), of joints that turn about their links' z axes.

    From the links' poses in the world, (7, 4, 4). With the Panda at q = 0 joint2's is
    (0, 1, 0, -0.333, 0, 0).
    """
    return hunted("joint_screws", T_zero)  # closed: suspect it? Write it anew here


def fk_space(screws: np.ndarray, M_home: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Return T_world_ee, (4, 4), from screws (7, 6), its pose at q = 0, and q, (7,).

    At q = 0 it is M_home: 0.088 m in front of the base and 0.926 m up.
    """
    return hunted("fk_space", screws, M_home, q)  # closed: suspect it? Write it anew here


def space_jacobian(screws: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Return J_space, (6, 7): where each screw, (7, 6), is after those before it moved.

    At q = 0 nothing has moved: its columns are the screws themselves.
    """
    return hunted("space_jacobian", screws, q)  # closed: suspect it? Write it anew here


def site_jacobian(J_space: np.ndarray, p: np.ndarray) -> np.ndarray:
    """Return J_site, (6, 7): v is the velocity of the hand's point p, (3,), world axes.

    Of a spin about z, (0, 0, 1, 0, 0, 0), the point (1, 0, 0) has v = (0, 1, 0).
    """
    return hunted("site_jacobian", J_space, p)  # closed: suspect it? Write it anew here


def pose_error(T: np.ndarray, T_goal: np.ndarray) -> np.ndarray:
    """Return how far the goal is, (6,): a rotation above a translation, world axes.

    A goal 0.1 m higher is (0, 0, 0, 0, 0, 0.1).
    """
    return hunted("pose_error", T, T_goal)  # closed: suspect it? Write it anew here


def solve_ik(
    screws: np.ndarray,
    M_home: np.ndarray,
    T_goal: np.ndarray,
    q_start: np.ndarray,
    limits: np.ndarray,
) -> np.ndarray:
    """Return joint angles, (7,), within limits, (7, 2), that bring the hand to T_goal.

    From q_start on, with damping^2 = e.e / 2 + 1e-6; 60 steps (updates of q) will do.
    A start whose error is under 1e-8 comes back, as a copy; out of reach, return the q
    whose error was the shortest.
    """
    return hunted("solve_ik", screws, M_home, T_goal, q_start, limits)  # closed: suspect it? Write it anew here


def manipulability(J: np.ndarray) -> float:
    """Return the product of J's singular values, which is 0 where J is singular.

    With 1, 2, 3, 1, 1, 1 on the diagonal of J it is 6. Never NaN.
    """
    return hunted("manipulability", J)  # closed: suspect it? Write it anew here


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
    return hunted("mass_matrix", J_space, G, armature)  # closed: suspect it? Write it anew here


def gravity_torque(
    J_space: np.ndarray, masses: np.ndarray, coms_world: np.ndarray, g: np.ndarray
) -> np.ndarray:
    """Return the torque that holds the arm, (7,); g is the vector (0, 0, -9.81).

    One hinge about +y, with 1 kg at (1, 0, 0): -9.81 N m.
    """
    return hunted("gravity_torque", J_space, masses, coms_world, g)  # closed: suspect it? Write it anew here


def bias_torque(
    J_space: np.ndarray, G: np.ndarray, qd: np.ndarray, g: np.ndarray
) -> np.ndarray:
    """Return the torque of Coriolis, centrifugal and gravity forces together, (7,).

    At qd = 0 it is gravity_torque.
    """
    return hunted("bias_torque", J_space, G, qd, g)  # closed: suspect it? Write it anew here


def pd_torque(e: np.ndarray, ed: np.ndarray, kp: Gain, kd: Gain) -> np.ndarray:
    """Return the torque of a spring and a damper at every joint, (7,) in N m.

    An error e of 0.1 rad at kp = 100 gives 10 N m. A gain is one number or (7,).
    """
    return hunted("pd_torque", e, ed, kp, kd)  # closed: suspect it? Write it anew here


def gains(omega: float, zeta: float) -> np.ndarray:
    """Return kp and kd, (2,), of edd + kd ed + kp e = 0 with this omega and zeta.

    omega = 20 rad/s and zeta = 1 need (400, 40).
    """
    return hunted("gains", omega, zeta)  # closed: suspect it? Write it anew here


def gravity_pd(
    e: np.ndarray, ed: np.ndarray, kp: Gain, kd: Gain, g_at_q: np.ndarray
) -> np.ndarray:
    """Return the torque of springs that do not sag, (7,). Without error it is g."""
    return hunted("gravity_pd", e, ed, kp, kd, g_at_q)  # closed: suspect it? Write it anew here


def computed_torque(
    M: np.ndarray, bias: np.ndarray, damping: np.ndarray, qd: np.ndarray,
    e: np.ndarray, ed: np.ndarray, qdd_ref: np.ndarray, kp: float, kd: float,
) -> np.ndarray:  # fmt: skip
    """Return the torque, (7,), that makes edd + kd ed + kp e = 0 at every joint.

    At rest, without an error or an acceleration to reach, it is bias.
    """
    return hunted("computed_torque", M, bias, damping, qd, e, ed, qdd_ref, kp, kd)  # closed: suspect it? Write it anew here


def saturate(tau: np.ndarray, limits: np.ndarray) -> np.ndarray:
    """Return what the motors can give, (7,). 100 N m where the limit is 87: 87."""
    return hunted("saturate", tau, limits)  # closed: suspect it? Write it anew here


def task_inertia(J_site: np.ndarray, M: np.ndarray) -> np.ndarray:
    """Return Lambda, (6, 6): the mass and inertia that you feel at the hand.

    With J_site the identity and M = 2 I it is 2 I.
    """
    return hunted("task_inertia", J_site, M)  # closed: suspect it? Write it anew here


def site_bias(J_space: np.ndarray, qd: np.ndarray, p: np.ndarray) -> np.ndarray:
    """Return the acceleration, (6,), of the hand's site at p while qdd is 0.

    J_space has the screws about the world's origin; p, (3,), is in world axes. A point
    at (1, 0, 0) that spins about z at 1 rad/s has (0, 0, 0, -1, 0, 0).
    """
    return hunted("site_bias", J_space, qd, p)  # closed: suspect it? Write it anew here


def osc_torque(
    J_site: np.ndarray, Lambda: np.ndarray, bias: np.ndarray, drift: np.ndarray,
    acc: np.ndarray,
) -> np.ndarray:  # fmt: skip
    """Return the torques, (7,), with which the hand accelerates by acc, (6,).

    drift is what site_bias gives; where acc is the same, they are bias.
    """
    return hunted("osc_torque", J_site, Lambda, bias, drift, acc)  # closed: suspect it? Write it anew here


def null_torque(
    J_site: np.ndarray, M: np.ndarray, Lambda: np.ndarray, tau: np.ndarray
) -> np.ndarray:
    """Return the part of tau, (7,), that does not accelerate the hand.

    What is subtracted from tau is a push at the hand. If J_site takes only the first
    six of seven joints, and M and Lambda are identities, seven ones become six 0 and
    one 1.
    """
    return hunted("null_torque", J_site, M, Lambda, tau)  # closed: suspect it? Write it anew here


def spring_wrench(
    e: np.ndarray, V_err: np.ndarray, K: np.ndarray, D: np.ndarray
) -> np.ndarray:
    """Return the wrench, (6,), of a spring and a damper between hand and target.

    e and V_err, (6,), are the target's minus the hand's; K and D are (6, 6). 25 mm away
    from a spring of 400 N/m it is 10 N.
    """
    return hunted("spring_wrench", e, V_err, K, D)  # closed: suspect it? Write it anew here


def set_point_for_force(force: float, k: float, surface: float) -> float:
    """Return the height to command so that a hand of k N/m presses down with a force.

    For 20 N at 400 N/m on a surface at 0.42 m it is 0.37 m.
    """
    return hunted("set_point_for_force", force, k, surface)  # closed: suspect it? Write it anew here


def critical_damping(K: np.ndarray, Lambda: np.ndarray) -> np.ndarray:
    """Return D, (6, 6), with which a spring K, (6,), does not ring.

    It is made of the matrix square roots of Lambda and of K's diagonal matrix. With
    every K = 4 and Lambda the identity it is 4 I.
    """
    return hunted("critical_damping", K, Lambda)  # closed: suspect it? Write it anew here


def impedance_torque(
    J_site: np.ndarray, wrench: np.ndarray, bias: np.ndarray, damping: np.ndarray,
    qd: np.ndarray, tau_null: np.ndarray,
) -> np.ndarray:  # fmt: skip
    """Return the torques, (7,), with which the hand pushes with a wrench.

    At rest, with wrench and tau_null 0, they are bias. damping, (7,), is the joints'.
    """
    return hunted("impedance_torque", J_site, wrench, bias, damping, qd, tau_null)  # closed: suspect it? Write it anew here


def quintic_scaling(t: float, duration: float) -> np.ndarray:
    """Return s, sd and sdd at time t of a soft move, (3,).

    duration is in seconds. At 0.6 of 2 s: 0.16308, 0.6615, 1.26. Before 0 and after
    the duration it stands still.
    """
    return hunted("quintic_scaling", t, duration)  # closed: suspect it? Write it anew here


def quintic_duration(dq: np.ndarray, v_max: np.ndarray, a_max: np.ndarray) -> float:
    """Return the shortest duration of a quintic over dq within every joint's limits.

    All are (7,); dq has either sign. 1 rad at 1.875 rad/s and any acceleration: 1 s.
    Where no joint moves: 0.
    """
    return hunted("quintic_duration", dq, v_max, a_max)  # closed: suspect it? Write it anew here


def joint_move(q0: np.ndarray, q1: np.ndarray, t: float, duration: float) -> np.ndarray:
    """Return q, qd and qdd at time t on the way from q0 to q1, three rows, (3, 7).

    After half the duration it is half way, at 1.875 (q1 - q0) / duration. Angles past
    pi stay as they are.
    """
    return hunted("joint_move", q0, q1, t, duration)  # closed: suspect it? Write it anew here


def straight_pose(T0: np.ndarray, T1: np.ndarray, s: float) -> np.ndarray:
    """Return the pose at s between two poses: a straight line, a turn at one rate.

    At s = 0 it is T0, at 1 it is T1, and half way the origin is in the middle. A turn
    of pi may go either way round, and no turn is too small.
    """
    return hunted("straight_pose", T0, T1, s)  # closed: suspect it? Write it anew here


def grasp_pose(T_world_cube: np.ndarray, above: float) -> np.ndarray:
    """Return T_world_tcp: `above` metres over the cube, z down, turned least.

    The cube stands upright. It looks the same after a quarter turn: at a yaw of 80
    degrees the tool turns by -10. At yaw 0 its x is the world's.
    """
    return hunted("grasp_pose", T_world_cube, above)  # closed: suspect it? Write it anew here


def carry(
    m1: float, c1: np.ndarray, I1: np.ndarray,
    m2: float, c2: np.ndarray, I2: np.ndarray,
) -> np.ndarray:  # fmt: skip
    """Return the one body that two are when the first holds the second, (10,).

    Given mass, centre of mass and inertia (3, 3) about it; returned mass, centre, and
    inertia about the common centre as xx, yy, zz, xy, xz, yz: entries of the matrix, so
    xy has the other sign than a textbook's product of inertia. Two points of 1 kg, 2 m
    apart along x: 2; (1, 0, 0); 0, 2, 2, 0, 0, 0.
    """
    return hunted("carry", m1, c1, I1, m2, c2, I2)  # closed: suspect it? Write it anew here


def heaviest_cube(grip: float, mu: float, acceleration: float) -> float:
    """Return the mass in kg that two fingers lift by friction alone.

    Each presses with `grip` newtons; the acceleration is positive upwards. 0.9247 N,
    mu 1, no acceleration: 0.189 kg.
    """
    return hunted("heaviest_cube", grip, mu, acceleration)  # closed: suspect it? Write it anew here


def main() -> int:
    """Do it with these functions, and with right ones."""
    return hunted.capstone(globals())


if __name__ == "__main__":
    cli.run(main)
