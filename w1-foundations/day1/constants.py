"""Measure how Day 1's numbers depend on their constants, and explain each change."""

import mujoco
import numpy as np

from labkit.lesson.constants import Numbers, altered, between, same, times
from labkit.lesson.lab_module import complete_lab
from robo47 import panda, verify

LAB = complete_lab(1)

numbers = Numbers(
    LAB,
    metre="the unit of length, every pos in the file: × {}",
    quat="norm of the file's quaternions: × {}",
    q="READY_Q: × {}",
    base="angle of joint 1: {} rad",
    angle="T_extra rotates by {} degrees",
    step="T_extra translates by {} m",
    trials="random configurations: {}",
    SEED="SEED: {}",
    gravity="gravity: × {}",
)


def arm(metre=1.0, quat=1.0):
    """Return the arm in another unit of length, with quaternions of another norm."""
    model = altered(panda.load("panda_nohand"), metre)
    model.body_quat[:] *= quat
    return model


def at_ready(metre, quat, base, q=1.0):
    """Return the pose of the hand, composed by hand."""
    angles = q * LAB.READY_Q
    angles[0] += base
    return LAB.compose_fk(arm(metre, quat), angles)


@numbers.add("height of the end effector in the ready configuration", "{:.4f} m",
    metre=times(2.0, "the height is a sum of lengths"),
    quat=same("a quaternion is normalised before it is used"),
    base=same("joint 1 rotates about the vertical axis", to=1.0),
    q=between(-1.0, 0.5, "with twice the joint angles the hand is below the base"))
def height(metre=1.0, quat=1.0, base=0.0, q=1.0):
    return at_ready(metre, quat, base, q)[2, 3]


@numbers.add("largest |by hand - MuJoCo| at random configurations", "{:.1e}",
    trials=same("each of the errors is a rounding error"),
    SEED=same("the same holds for other random configurations", to=48),
    metre=same("with longer links all errors are still rounding errors"),
    gravity=same("the pose is a function of the joint angles alone"))
def by_hand(trials=100, metre=1.0, gravity=1.0):
    model = arm(metre)
    model.opt.gravity[:] *= gravity
    return LAB.own_errors(model, verify.random_q(model, trials, LAB.SEED)).max()


@numbers.add("position error with quaternions read as (x, y, z, w)", "{:.2f} m",
    metre=times(2.0, "the rotations are wrong in the same way, and the links are twice as long"),
    quat=same("a quaternion is normalised before it is used"),
    base=same("the misread quaternions turn link0 upside down and link1 upright again, so joint 1 still rotates about the vertical axis", to=1.0))
def wrong_quat(metre=1.0, quat=1.0, base=0.0):
    model = arm(metre, quat)
    right = at_ready(metre, quat, base)
    model.body_quat[:] = np.roll(model.body_quat, 1, axis=1)  # w, x, y, z of x, y, z, w
    angles = LAB.READY_Q + np.eye(7)[0] * base
    wrong = LAB.compose_fk(model, angles)
    return np.linalg.norm((wrong - right)[:3, 3])


def apart(angle, step, metre, base):
    """Return the distance between the hand's positions in the two products."""
    T = at_ready(metre, 1.0, base)
    turn = LAB.Rz(np.deg2rad(angle))
    T_extra = LAB.make_T(turn, np.array([step, 0.0, 0.0]))
    right, left = LAB.translations_both_orders(T, T_extra)
    return np.linalg.norm(right - left)


@numbers.add("distance between the two products", "{:.4f} m",
    step=between(1.1, 1.7, "the translation is twice as long, and the chord does not change"),
    angle=between(1.2, 1.5, "the chord is 1.85 times as long, and the translation does not change"),
    metre=between(1.5, 2.0, "the chord is twice as long, and the translation does not change"),
    base=between(0.5, 2.0, "the tool's x axis is no longer opposite to the world's", to=1.0))
def order(angle=45.0, step=0.1, metre=1.0, base=0.0):
    return apart(angle, step, metre, base)


@numbers.add("distance between the products without the rotation", "{:.4f} m",
    step=times(2.0, "one translation is forwards and one is backwards"),
    metre=same("without the rotation the position of the hand cancels"),
    base=times(np.cos(0.5), "the two translations are no longer opposite: the distance is 0.2 m cos(q1 / 2)", to=1.0))
def no_turn(step=0.1, metre=1.0, base=0.0):
    return apart(0.0, step, metre, base)


@numbers.add("distance between the products without the translation", "{:.4f} m",
    angle=times(np.sin(np.pi / 4) / np.sin(np.pi / 8), "the length of the chord is 2 r sin(angle / 2)"),
    metre=times(2.0, "r is the distance between the hand and the axis of the base"),
    base=same("a rotation about this axis does not change r", to=1.0))
def no_step(angle=45.0, metre=1.0, base=0.0):
    return apart(angle, 0.0, metre, base)


@numbers.add("link4 in the file, along x of link3", "{:.4f} m",
    q=same("the position relative to link3 does not depend on the joint angles"),
    metre=times(2.0, "the coordinate is a length"))
def in_the_file(q=1.0, metre=1.0):
    model = arm(metre)
    data = mujoco.MjData(model)
    data.qpos[:] = q * LAB.READY_Q
    mujoco.mj_kinematics(model, data)
    link3 = data.body("link3")
    return (link3.xmat.reshape(3, 3).T @ (data.body("link4").xpos - link3.xpos))[0]


@numbers.add("link4 in the world, z", "{:.6f} m",
    q=between(0.1, 0.95, "the joints between the base and link4 have rotated"),
    metre=times(2.0, "the coordinate is a length"))
def in_the_world(q=1.0, metre=1.0):
    return LAB.link4_to_world(arm(metre), q * LAB.READY_Q)[2, 3]
