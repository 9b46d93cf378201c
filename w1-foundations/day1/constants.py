"""What Day 1's numbers hang on: each constant turned by two, measured, explained."""

import mujoco
import numpy as np

from labkit.lesson.constants import Numbers, between, same, times
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47 import panda, verify

LAB = lab_of(find_day(1))

numbers = Numbers(
    metre="the unit of length, every pos in the file: × {}",
    quat="length of the file's quaternions: × {}",
    q="READY_Q: × {}",
    base="turn of joint 1: {} rad",
    angle="T_extra turns by {} degrees",
    step="T_extra moves by {} m",
    trials="random configurations: {}",
    seed="SEED: {}",
    gravity="gravity: × {}",
)


def arm(metre=1.0, quat=1.0):
    """Return the arm in another unit, its quaternions of another length."""
    model = panda.load("panda_nohand")
    model.body_pos[:] *= metre
    model.body_quat[:] *= quat
    return model


def at_ready(metre, quat, base, q=1.0):
    """Return the pose of the hand, composed by hand."""
    angles = q * LAB.READY_Q
    angles[0] += base
    return LAB.compose_fk(arm(metre, quat), angles)


@numbers.add(
    "height of the end effector at ready", "{:.4f} m",
    metre=times(2.0, "a pose is turns, which have no unit, and lengths"),
    quat=same("a quaternion of any length is the same turn"),
    base=same("joint 1 turns about the vertical", to=1.0),
    q=between(-1.0, 0.5, "twice the angles is another pose: the arm folds over"),
)  # fmt: skip
def height(metre=1.0, quat=1.0, base=0.0, q=1.0):
    """Return how high the hand is."""
    return at_ready(metre, quat, base, q)[2, 3]


@numbers.add(
    "largest |by hand - MuJoCo| at random configurations", "{:.1e}",
    trials=same("every one of them is rounding"),
    seed=same("and of other ones", to=48),
    metre=same("of longer links too"),
    gravity=same("a pose has no force in it"),
)  # fmt: skip
def by_hand(trials=100, seed=LAB.SEED, metre=1.0, gravity=1.0):
    """Return how far compose_fk is from MuJoCo; the lab asks for ten times as many."""
    model = arm(metre)
    model.opt.gravity[:] *= gravity
    return LAB.own_errors(model, verify.random_q(model, trials, seed)).max()


@numbers.add(
    "off, with quaternions read as (x, y, z, w), at ready", "{:.2f} m",
    metre=times(2.0, "wrong turns, of links that are twice as long"),
    quat=same("a quaternion of any length is the same turn"),
    base=same("link0 and link1 are turned over, so joint 1 is upright again", to=1.0),
)  # fmt: skip
def wrong_quat(metre=1.0, quat=1.0, base=0.0):
    """Return how far off the hand is with that mistake."""
    model = arm(metre, quat)
    right = at_ready(metre, quat, base)
    model.body_quat[:] = np.roll(model.body_quat, 1, axis=1)  # w, x, y, z of x, y, z, w
    angles = LAB.READY_Q + np.eye(7)[0] * base
    wrong = LAB.compose_fk(model, angles)
    return np.linalg.norm((wrong - right)[:3, 3])


def apart(angle, step, metre, base):
    """Return the way between the two products, and the hand's distance."""
    T = at_ready(metre, 1.0, base)
    turn = LAB.Rz(np.deg2rad(angle))
    T_extra = LAB.make_T(turn, np.array([step, 0.0, 0.0]))
    right, left = LAB.translations_both_orders(T, T_extra)
    return np.linalg.norm(right - left)


@numbers.add(
    "way between the two products", "{:.4f} m",
    step=between(1.1, 1.7, "0.2 m forwards and back, at an angle to the chord"),
    angle=between(1.2, 1.5, "the chord is 1.85 times as long, the step is as long"),
    metre=between(1.5, 2.0, "the chord is twice as long, the step is not"),
    base=between(0.5, 2.0, "the tool's x no longer points back along the world's",
                 to=1.0),
)  # fmt: skip
def order(angle=45.0, step=0.1, metre=1.0, base=0.0):
    """Return how far apart the two products are."""
    return apart(angle, step, metre, base)


@numbers.add(
    "the same with no turn", "{:.4f} m",
    step=times(2.0, "one step forwards and one back"),
    metre=same("the arm has no part in it"),
    base=times(np.cos(0.5), "the steps are no longer opposite: 0.2 m cos(q1 / 2)",
               to=1.0),
)  # fmt: skip
def no_turn(step=0.1, metre=1.0, base=0.0):
    """Return how far apart the two products are without a turn."""
    return apart(0.0, step, metre, base)


@numbers.add(
    "the same with no step", "{:.4f} m",
    angle=times(np.sin(np.pi / 4) / np.sin(np.pi / 8), "a chord: 2 r sin(angle / 2)"),
    metre=times(2.0, "r is the hand's distance from the base's axis"),
    base=same("a turn of the base keeps that distance", to=1.0),
)  # fmt: skip
def no_step(angle=45.0, metre=1.0, base=0.0):
    """Return how far apart the two products are without a step."""
    return apart(angle, 0.0, metre, base)


@numbers.add(
    "link4 in the file, along x of link3", "{:.4f} m",
    q=same("it is link4's place on its parent, whatever the joints do"),
    metre=times(2.0, "it is a length"),
)  # fmt: skip
def in_the_file(q=1.0, metre=1.0):
    """Return the first number of link4's pos, as MuJoCo has it when the arm is at q."""
    model = arm(metre)
    data = mujoco.MjData(model)
    data.qpos[:] = q * LAB.READY_Q
    mujoco.mj_kinematics(model, data)
    link3 = data.body("link3")
    return (link3.xmat.reshape(3, 3).T @ (data.body("link4").xpos - link3.xpos))[0]


@numbers.add(
    "link4 in the world, z", "{:.6f} m",
    q=between(0.1, 0.95, "the links before it have turned"),
    metre=times(2.0, "it is a length"),
)  # fmt: skip
def in_the_world(q=1.0, metre=1.0):
    """Return how high link4 is."""
    return LAB.link4_to_world(arm(metre), q * LAB.READY_Q)[2, 3]
