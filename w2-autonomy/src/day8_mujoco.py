"""Day 8's use of MuJoCo: a robot that differs from its file, motions, and holds.

`robo47.identification` fits the parameters. Radians, seconds, kilograms, N m; twists
(omega; v), wrenches (moment; force).
"""

import copy
from collections.abc import Callable
from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks, identification, simulate, verify
from robo47.arm import Arm
from robo47.checks import Array
from robo47.errors import Robo47Error
from robo47.fast.arm_state import ArmState
from robo47.panda import READY_Q
from robo47.panda.loading import Edit
from robo47.panda.reading import joint_ids
from robo47.references import raised_cosine

MASS, CENTRE = 0.2, 0.01  # the largest differences: fraction of a mass; m
DAMPING, DRY = (0.4, 1.6), (0.2, 0.8)  # N m s/rad; N m, half for the small joints
BASE, HARMONICS, SECONDS = 0.1, 5, 10.0  # of the excitation; Hz, number, s
RANGE_SHARE, SPEED_SHARE = 0.8, 0.9  # fractions of the joints' ranges and velocities
REACH = np.array([0.5, 0.4, 0.5, 0.4, 0.6, 0.5, 0.6])  # rad, of Day 5's swing
RADIUS = 0.04  # m, of the payload, a sphere
OMEGA, RATE = 20.0, 100.0  # rad/s of the springs that hold the arm; Hz
SLOW_RATE = 10.0  # Hz, of the gravity compensation while the arm floats
AWAY = 0.1  # rad, the distance of a hold's start from its pose
FLOAT = 2.0  # s, the duration of floating


class Motion(NamedTuple):
    """n states of the arm: q, qd and qdd in rad, rad/s and rad/s^2, (n, 7) each."""

    q: Array
    qd: Array
    qdd: Array


class Body(NamedTuple):
    """One body in motion, expressed in its own frame."""

    phi: Array  # its inertial parameters, (10,)
    V: Array  # twist, rad/s and m/s, (6,)
    A: Array  # acceleration of that twist, rad/s^2 and m/s^2, (6,)


def bodies(n: int, seed: int) -> list[Body]:
    """Return n bodies that can exist, each of forty points, in random motion.

    Args:
        n: the number of bodies.
        seed: of the random numbers.
    """
    rng = np.random.default_rng(seed)
    found = []
    for _ in range(n):
        points = rng.normal(size=(40, 3))
        masses = rng.uniform(0.01, 0.1, 40)
        m = masses.sum()
        h = masses @ points
        P = points.T * masses @ points  # the sum of m r r^T
        about = np.trace(P) * np.eye(3) - P
        i, j = np.transpose([(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)])
        found.append(Body(np.hstack([m, h, about[i, j]]), *rng.normal(size=(2, 6))))
    return found


def mujoco_wrench(body: Body) -> Array:
    """Return the wrench (6,) that moves a free body, by MuJoCo's mj_inverse.

    The qvel of a free joint is (v; omega). Its qacc contains the acceleration of the
    origin as a point, which is the twist's plus omega x v.

    Args:
        body: its parameters, twist and acceleration.
    """
    m = body.phi[0]
    c = body.phi[1:4] / m
    xx, yy, zz, xy, xz, yz = body.phi[4:]
    about = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    about = about - m * (c @ c * np.eye(3) - np.outer(c, c))  # MuJoCo's is about c
    spec = mujoco.MjSpec()
    spec.option.gravity = [0.0, 0.0, 0.0]
    floats = spec.worldbody.add_body()
    floats.add_freejoint()
    floats.explicitinertial = True
    floats.mass = m
    floats.ipos = c
    # Its principal axes: MuJoCo 3.3 computes them to six digits only.
    floats.inertia, axes = np.linalg.eigh(about)
    axes[:, 0] *= np.sign(np.linalg.det(axes))  # right-handed
    mujoco.mju_mat2Quat(floats.iquat, axes.ravel())
    model = spec.compile()
    data = mujoco.MjData(model)
    omega, v = body.V.reshape(2, 3)
    alpha, a = body.A.reshape(2, 3)
    data.qvel[:] = [*v, *omega]
    data.qacc[:] = [*(a + np.cross(omega, v)), *alpha]
    mujoco.mj_inverse(model, data)  # fills qfrc_inverse: (force; moment)
    return np.roll(data.qfrc_inverse, 3)


def changed(model: mujoco.MjModel, seed: int) -> mujoco.MjModel:
    """Return a copy with other link masses, centres of mass and joint friction.

    Args:
        model: of the arm; it stays as it is.
        seed: of the random numbers; each seed makes one robot.
    """
    rng = np.random.default_rng(seed)
    secret = copy.copy(model)
    joints = joint_ids(secret)
    links, dofs = secret.jnt_bodyid[joints], secret.jnt_dofadr[joints]
    secret.body_mass[links] *= rng.uniform(1.0 - MASS, 1.0 + MASS, 7)
    secret.body_ipos[links] += rng.uniform(-CENTRE, CENTRE, (7, 3))
    secret.dof_damping[dofs] = rng.uniform(*DAMPING, 7)
    secret.dof_frictionloss[dofs] = rng.uniform(*DRY, 7) * [1, 1, 1, 1, 0.5, 0.5, 0.5]
    # MuJoCo scales friction with the masses that the model had when it was compiled.
    mujoco.mj_setConst(secret, mujoco.MjData(secret))
    return secret


def without_friction(model: mujoco.MjModel) -> mujoco.MjModel:
    """Return a copy whose joints have no dry friction."""
    free = copy.copy(model)
    free.dof_frictionloss[:] = 0.0
    mujoco.mj_setConst(free, mujoco.MjData(free))
    return free


def load(mass: float, com: ArrayLike) -> Edit:
    """Return an edit for `panda.load` that fixes a sphere to the hand.

    Args:
        mass: kg.
        com: centre of mass in the site's frame, m, (3,).
    """

    def edit(spec: mujoco.MjSpec) -> None:
        site = spec.site("attachment_site")
        ball = site.parent.add_body(name="load", pos=site.pos, quat=site.quat)
        ball.mass = mass
        ball.ipos = com
        ball.explicitinertial = True
        ball.inertia = [0.4 * mass * RADIUS**2] * 3

    return edit


def turning_speed(model: mujoco.MjModel, qdd: float, dry: float = 0.5) -> float:
    """Return the speed, rad/s, below which MuJoCo's dry friction has the wrong sign.

    Joint 1 moves backwards at the ready configuration and accelerates forwards with
    qdd. Below that speed mj_inverse returns a larger torque with dry friction than
    without it.

    Args:
        model: of the arm; it stays as it is.
        qdd: acceleration, rad/s^2, above 0.
        dry: friction of joint 1, N m.
    """
    model = copy.copy(model)

    def torque(qd: float, loss: float) -> float:
        model.dof_frictionloss[0] = loss
        data = mujoco.MjData(model)
        data.qpos[:] = READY_Q
        data.qvel[0] = qd
        data.qacc[0] = qdd
        mujoco.mj_inverse(model, data)  # fills qfrc_inverse
        return float(data.qfrc_inverse[0])

    low, high = 0.0, 1.0
    for _ in range(30):
        middle = (low + high) / 2
        if torque(-middle, dry) > torque(-middle, 0.0):
            low = middle
        else:
            high = middle
    return high


def excitation(model: mujoco.MjModel, seed: int, n: int = 200) -> Motion:
    """Return an exciting motion of n samples over ten seconds: random harmonics.

    Args:
        model: its joint ranges limit the motion, and the Panda's velocity limits do.
        seed: of the random numbers.
        n: the number of samples.
    """
    sin, cos = np.random.default_rng(seed).normal(size=(2, HARMONICS, 7))
    w = 2.0 * np.pi * BASE * np.arange(1, HARMONICS + 1)

    def at(t: Array) -> Motion:
        s, c = np.sin(np.outer(t, w)), np.cos(np.outer(t, w))
        return Motion(
            s @ sin + c @ cos,
            (c * w) @ sin - (s * w) @ cos,
            -(s * w**2) @ sin - (c * w**2) @ cos,
        )

    low, high = simulate.limits(model)[0].T
    whole = at(np.linspace(0.0, SECONDS, 2000, endpoint=False))
    least, most = whole.q.min(axis=0), whole.q.max(axis=0)
    fastest = SPEED_SHARE * simulate.SPEED_LIMITS / np.abs(whole.qd).max(axis=0)
    scale = np.minimum(RANGE_SHARE * (high - low) / (most - least), fastest)
    q, qd, qdd = at(np.arange(n) * SECONDS / n)
    middle = (low + high) / 2.0 - scale * (least + most) / 2.0
    return Motion(middle + scale * q, scale * qd, scale * qdd)


def swing(n: int = 200) -> Motion:
    """Return n samples of Day 5's swing of all joints, over ten seconds."""
    reference = raised_cosine(READY_Q, REACH)
    return Motion(*np.stack([reference(t) for t in np.arange(n) * SECONDS / n], axis=1))


def harmonics(
    model: mujoco.MjModel, often: ArrayLike, far: ArrayLike, begin: ArrayLike,
    n: int = 200,
) -> Motion:  # fmt: skip
    """Return n samples of sines about the ready configuration, over ten seconds.

    Args:
        model: its joint ranges limit the motion, and the Panda's velocity limits do.
        often: frequencies of the sines, Hz, (k,).
        far: amplitudes of each joint, rad, (k, 7).
        begin: phases of each joint, rad, (k, 7).
        n: the number of samples.

    Raises:
        Robo47Error: a joint leaves its range, or exceeds its velocity limit.
    """
    w = 2.0 * np.pi * np.asarray(often)[:, None]
    far = checks.array(far, "far", (len(w), 7))
    angle = w * (np.arange(n) * SECONDS / n)[:, None, None]
    angle = angle + checks.array(begin, "begin", (len(w), 7))
    q = READY_Q + (far * np.sin(angle)).sum(axis=1)
    qd = (far * w * np.cos(angle)).sum(axis=1)
    qdd = -(far * w**2 * np.sin(angle)).sum(axis=1)
    low, high = simulate.limits(model)[0].T
    for j in range(7):
        if not (low[j] < q[:, j].min() and q[:, j].max() < high[j]):
            raise Robo47Error(
                f"your motion takes joint{j + 1} out of its range: reduce FAR"
            )
        if np.abs(qd[:, j]).max() > simulate.SPEED_LIMITS[j]:
            raise Robo47Error(
                f"your motion exceeds the velocity limit of joint{j + 1}: reduce FAR"
                " or OFTEN"
            )
    return Motion(q, qd, qdd)


def anywhere(model: mujoco.MjModel, seed: int, n: int = 200) -> Motion:
    """Return n random states, up to 2 rad/s and 10 rad/s^2 in each joint.

    Args:
        model: its joint ranges are used.
        seed: of the random numbers.
        n: the number of states.
    """
    rng = np.random.default_rng(seed)
    q = verify.random_q(model, n, seed)
    return Motion(q, rng.uniform(-2, 2, q.shape), rng.uniform(-10, 10, q.shape))


def numbers(known: Arm) -> Array:
    """Return a model's 91 parameters: links, armature, damping, no dry friction, (91,).

    Args:
        known: the arm as its model file describes it.
    """
    links = identification.inertial_parameters(known.masses, known.coms, known.inertias)
    return np.concatenate([links.ravel(), known.armature, known.damping, np.zeros(7)])


def holds(
    model: mujoco.MjModel, known: Arm, poses: ArrayLike, wait: float
) -> tuple[Array, Array]:
    """Return the configurations in which springs hold the arm, and their torques.

    The controller compensates gravity, Coriolis forces and damping of the known arm, so
    the springs supply the torque of everything unknown: other masses, a load, dry
    friction. On the first side every joint approaches its pose in the direction that
    lowers the hand, on the second in the direction that lifts it, and dry friction has
    the opposite sign.

    Args:
        model: the robot, with motors.
        known: the model that its controller uses.
        poses: configurations to hold, rad, (k, 7).
        wait: time until the measurement, s. MuJoCo's dry friction does not stick but
            creeps, so its torque decays.

    Returns:
        (q at rest in rad, torque of the springs in N m), (2, k, 7) each, by side.
    """
    poses = checks.array(poses, "poses", (7,))
    found = [
        [_hold(model, known, q, side, wait) for q in poses] for side in (1.0, -1.0)
    ]
    at, torque = np.moveaxis(np.array(found), 2, 0)
    return at, torque


def _hold(
    model: mujoco.MjModel, known: Arm, q: Array, side: float, wait: float
) -> list[Array]:
    def law(t: float, q_now: Array, qd: Array) -> Array:
        now = known.at(q_now)
        pull = OMEGA**2 * (q - q_now) - 2.0 * OMEGA * qd
        return now.M @ pull + now.bias(qd) + known.damping * qd

    lifts = np.where(known.at(q).J_site[5] < -1e-9, -1.0, 1.0)
    data = simulate.start(model, q + side * AWAY * lifts)
    run = simulate.run(model, data, law, wait, rate=RATE)  # mujoco.mj_step
    return [run.q[-2], run.tau[-1] - known.at(run.q[-2]).gravity_torque]


def hands(known: Arm, q: ArrayLike) -> tuple[Array, Array]:
    """Return J_site, (k, 6, 7), and R_world_site, (k, 3, 3), at k configurations.

    Args:
        known: the arm.
        q: configurations, rad, (k, 7).
    """
    now = [known.at(x) for x in checks.array(q, "q", (7,))]
    R = [x.T_world_ee[:3, :3] for x in now]
    return np.array([x.J_site for x in now]), np.array(R)


def rises(
    model: mujoco.MjModel, known: Arm, still: Callable[[ArmState], Array],
    load: ArrayLike,
) -> float:  # fmt: skip
    """Return the rise of the hand, m, in two seconds of gravity compensation alone.

    It is negative if the hand sinks. The arguments are the same as for `floats`.
    """
    run = floats(model, known, still, load)
    before, *_, end = (known.at(q).T_world_ee[2, 3] for q in run.q)
    return float(end - before)


def floats(
    model: mujoco.MjModel, known: Arm, still: Callable[[ArmState], Array],
    load: ArrayLike,
) -> simulate.Run:  # fmt: skip
    """Return two seconds of gravity compensation alone, from ready.

    The robot's dry friction is removed, so that only the motors hold it.

    Args:
        model: the robot, with motors.
        known: the kinematics of the arm.
        still: maps the arm at a configuration to its gravity torque without load, (7,).
        load: (m, m c) of the load that is compensated, in the site's frame, (4,).
    """
    load = checks.array(load, "load", (4,))
    free = without_friction(model)

    def law(t: float, q: Array, qd: Array) -> Array:
        now = known.at(q)
        hand = now.J_site, now.T_world_ee[:3, :3]
        return still(now) + identification.load_regressor(*hand, known.gravity) @ load

    return simulate.run(free, simulate.start(free, READY_Q), law, FLOAT, rate=SLOW_RATE)
