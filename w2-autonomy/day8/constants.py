"""Sensitivity of Day 8's numbers: each constant is doubled, measured and explained.

The lab's own functions compute everything, without noise unless stated otherwise.
"""

from copy import copy
from functools import cache

import mujoco
import numpy as np

from labkit.lesson.constants import Numbers, between, same, times, turned
from labkit.lesson.lab_module import complete_lab
from robo47 import identification, panda

LAB = complete_lab(8)
DAY = LAB.day8_mujoco
MODEL = panda.load("panda_nohand", drive="torque")
ARM = panda.arm(MODEL)

numbers = Numbers(
    LAB, DAY,
    reach="amplitude of the pendulum: {} rad",
    second="fraction of a second sine: {}",
    RTOL="RTOL: {}",
    CUT="CUT: {}",
    metre="units of length in a metre: {}",
    n="samples: {}",
    ROBOT_SEED="seed of the states: {}",
    speed="velocities of the states: × {}",
    swing="amplitude of the swing: × {}",
    NOISE="NOISE: {} N m",
    NOISE_SEED="NOISE_SEED: {}",
    slow="SLOW: {} rad/s",
    MASS="largest difference of a mass from the file: {}",
    friction="dry friction: × {}",
    WAIT="WAIT: {} s",
    timeconst="solref[0] of the friction: {} s",
    dmin="solimp[0] of the friction: {}",
    dmax="solimp[1] of the friction: {}",
    OMEGA="OMEGA of the springs that hold the arm: {} rad/s",
    step="time step: {} s",
    poses="poses: {}",
    qdd="acceleration: {} rad/s²",
    dry="dry friction: {} N m",
)


@numbers.add("condition number of the pendulum, one sine of 0.1 rad", "{:,.0f}",
    reach=times(1 / 8, "q'' = -q, and sin q differs from q by q³/6", within=0.1),
    second=between(0, 0.001, "with a second frequency q'' = -q no longer holds", to=0.2),
    RTOL=same("all five singular values are far above the threshold"))
def pendulum(reach=0.1, second=0.0):
    return LAB.rank_and_condition(LAB.pendulum(reach, second), LAB.RTOL)[1]


def regressor(motion):
    """Return Y, (n, 7, 91), by the library, which is quicker than the lab."""
    with turned(LAB, arm_regressor=identification.arm_regressor):
        return LAB.regressor(ARM, motion)


@cache
def anywhere(seed, n, speed):
    """Return random states, and their Y, (n, 7, 91)."""
    at = DAY.anywhere(MODEL, seed, n)
    at = at._replace(qd=speed * at.qd)
    return at, regressor(at)


@numbers.add("rank of the 70 columns of the links", "{:.0f}",
    n=same("nine random states already give this rank"),
    ROBOT_SEED=same("the axes of the arm determine the rank, not the states", to=48),
    speed=same("the axes of the arm are the same"),
    metre=same("scaling a column does not change the rank"),
    RTOL=same("the other singular values are rounding errors, at most 1e-14 of the largest"))
def links_show(n=LAB.TRIALS, speed=1.0, metre=1.0):
    Y = anywhere(LAB.ROBOT_SEED, n, speed)[1][..., :70].reshape(-1, 70)
    return LAB.rank_and_condition(Y / LAB.lengths(metre)[:70], LAB.RTOL)[0]


@numbers.add("condition number of random states, with motors", "{:.0f}",
    n=between(0.8, 1.1, "more states of the same kind"),
    ROBOT_SEED=between(0.7, 1.4, "other states of the same kind", to=48),
    speed=between(1.05, 2.0, "the largest singular value grows more than the smallest, because its inertial terms contain squares of the velocity"),
    metre=between(0.3, 0.8, "the largest singular value belongs to the links, whose columns for m c and I shrink; the smallest belongs to viscous friction, whose column stays the same"),
    RTOL=same("no singular value lies between 1e-14 and 1 / 230 of the largest"))
def condition(n=LAB.TRIALS, speed=1.0, metre=1.0):
    Y = anywhere(LAB.ROBOT_SEED, n, speed)[1].reshape(-1, 91)
    return LAB.rank_and_condition(Y / LAB.lengths(metre), LAB.RTOL)[1]


@numbers.add("condition number of Day 5's swing", "{:,.0f}",
    swing=between(1 / 200, 1 / 100, "it falls with about the seventh power of the amplitude, not with the third as for the pendulum"),
    metre=between(3.0, 10.0, "columns in kg m² shrink to 1/100, so the condition number depends on the unit", to=10.0),
    RTOL=same("no singular value is near this threshold; those below it are rounding errors"))
def swing_condition(swing=1.0, metre=1.0):
    motion, Y = swung(swing)
    fast = np.abs(motion.qd) > LAB.SLOW
    return float(f"{LAB.rank_and_condition(Y[fast] / LAB.lengths(metre), LAB.RTOL)[1]:.3g}")


@cache
def swung(reach):
    """Return the swing and its Y."""
    with turned(DAY, REACH=reach * DAY.REACH):
        motion = DAY.swing()
    return motion, regressor(motion)


@cache
def excited(n):
    """Return the excitation and its Y."""
    motion = DAY.excitation(MODEL, LAB.ROBOT_SEED, n)
    return motion, regressor(motion)


@cache
def robot(masses=DAY.MASS, friction=1.0, load=0.0):
    """Return the unknown robot, with a load on its hand."""
    edit = DAY.load(load, LAB.AT) if load else None
    model = panda.load("panda_nohand", drive="torque", edit=edit)
    with turned(DAY, MASS=masses):
        model = DAY.changed(model, LAB.ROBOT_SEED)
    model.dof_frictionloss[:] *= friction
    mujoco.mj_setConst(model, mujoco.MjData(model))
    return model


def off_elsewhere(moved, drawn, secret, rtol, metre=1.0, slow=LAB.SLOW):
    """Return the test error of a fit at the lab's random states, in N m.

    Args:
        moved: a motion and its Y.
        drawn: the noise of its torques.
        secret: the robot.
        rtol: of the fit.
        metre: units of length to a metre.
        slow: slower rows are left out.
    """
    motion, Y = moved
    at, Y_new = anywhere(LAB.ROBOT_SEED, LAB.TRIALS, 1.0)
    new = np.abs(at.qd) > LAB.SLOW
    fast = np.abs(motion.qd) > slow
    unit = LAB.lengths(metre)
    tau = LAB.mujoco_torques(secret, motion) + drawn
    phi = LAB.truncated_svd_fit(Y[fast] / unit, tau[fast], rtol)
    return LAB.rms(Y_new[new] / unit @ phi - LAB.mujoco_torques(secret, at)[new])


@numbers.add("test error of the swing's fit, truncated, in metres", "{:.2f} N m",
    CUT=between(0.9, 1.1, "a few more combinations are truncated; the bias is similar"),
    metre=between(0.2, 0.4, "columns in kg m² shrink to 1/100, so other combinations are truncated", to=10.0),
    NOISE=between(0.9, 1.3, "without noise it is 4.8, which is the bias"),
    NOISE_SEED=between(0.7, 1.3, "different noise is added to the same bias", to=48),
    swing=between(0.8, 1.0, "more combinations are kept, and the others are still set to 0"),
    MASS=between(0.8, 1.2, "truncated combinations are set to 0, not to the file's values"))
def cut_fit(metre=1.0, swing=1.0):
    drawn = LAB.NOISE * np.random.default_rng(LAB.NOISE_SEED).normal(size=(200, 7))
    return off_elsewhere(swung(swing), drawn, robot(DAY.MASS), LAB.CUT, metre)


@numbers.add("test error of the excitation's fit", "{:.2f} N m",
    NOISE=times(2.0, "the noise is the only cause, and the fit is linear"),
    n=between(0.55, 0.85, "1/√2 for twice the samples, with other noise", to=400),
    NOISE_SEED=between(0.5, 1.5, "different noise", to=48),
    metre=same("without truncation the unit cancels"),
    RTOL=same("no singular value is near this threshold"),
    slow=between(0.8, 1.2, "fewer rows remain, and none of them is wrong"),
    MASS=same("the fit does not use the model file"),
    friction=same("dry friction has its own columns in Y"))
def excited_fit(n=200, metre=1.0, friction=1.0, slow=LAB.SLOW):
    rng = np.random.default_rng(LAB.NOISE_SEED)
    rng.normal(size=(200, 7))  # the lab's swing has these
    drawn = LAB.NOISE * rng.normal(size=(n, 7))
    secret = robot(DAY.MASS, friction)
    return off_elsewhere(excited(n), drawn, secret, LAB.RTOL, metre, slow)


@numbers.add("test error of the model file's parameters", "{:.2f} N m",
    MASS=between(1.05, 2.0, "the differences of the masses are twice as large"),
    friction=between(1.05, 2.0, "the file contains no dry friction"),
    NOISE=same("nothing is fitted, and the test data have no noise"))
def file_off(friction=1.0):
    at, Y = anywhere(LAB.ROBOT_SEED, LAB.TRIALS, 1.0)
    new = np.abs(at.qd) > LAB.SLOW
    truth = LAB.mujoco_torques(robot(DAY.MASS, friction), at)
    return LAB.rms((Y @ DAY.numbers(ARM) - truth)[new])


@numbers.add("b, which shifts the sign of MuJoCo's dry friction", "{:.0f} 1/s",
    timeconst=times(0.5, "b = 2 / (solimp[1] solref[0])"),
    dmax=times(1 / 0.95, "b = 2 / (solimp[1] solref[0])", to=0.9025),
    dmin=same("b depends only on solimp[1] and solref[0]", to=0.45),
    qdd=same("with twice the acceleration the sign changes at twice the speed"),
    dry=same("the sign does not depend on the magnitude"))
def sign_rule(timeconst=0.02, dmax=0.95, dmin=0.9, qdd=5.0, dry=0.5):
    model = panda.load("panda_nohand", drive="torque")
    model.dof_solref[0] = timeconst, 1.0
    model.dof_solimp[0, :2] = dmin, dmax
    return qdd / DAY.turning_speed(model, qdd, dry)


@cache
def held(load, side, i, wait, friction, timeconst, dmin, step, springs):
    """Return q at rest and the springs' torque at one of the poses, (7,) each."""
    model = copy(robot(friction=friction, load=load))
    model.dof_solref[:7, 0] = timeconst
    model.dof_solimp[:7, :2] = dmin, max(dmin, 0.95)
    model.opt.timestep = step
    # The lab's five poses, and five more of the same distribution.
    away = np.random.default_rng(47).uniform(-0.5, 0.5, (10, 7))
    with turned(DAY, OMEGA=springs):
        return DAY._hold(model, ARM, panda.READY_Q + away[i], side, wait)


def holds(load, side, n, *how):
    """Return q at rest and the springs' torques at n poses, (n, 7) each."""
    return np.swapaxes([held(load, side, i, *how) for i in range(n)], 0, 1)


@numbers.add("error of the mass, one from either side, no noise", "{:.0f} g",
    WAIT=between(0.0, 0.2, "dry friction creeps, and after 4 s hardly any is left"),
    timeconst=between(0.0, 0.2, "b is halved, so friction creeps twice as fast"),
    dmin=between(6.0, 10.0, "with solimp[0] close to 1 friction hardly creeps", to=0.999),
    friction=times(2.0, "twice the friction leaves twice the error", within=0.1),
    OMEGA=between(-0.2, 0.2, "the springs are four times as stiff, so friction creeps faster"),
    step=times(1.0, "creep does not depend on the time step", within=0.05, to=0.001))
def either_side(friction=1.0, timeconst=0.02, dmin=0.9, step=0.002):
    how = 5, LAB.WAIT, friction, timeconst, dmin, step, DAY.OMEGA
    q, full = holds(LAB.LOAD, -1.0, *how)
    load, _ = LAB.weighed(ARM, q, full - holds(0.0, 1.0, *how)[1])
    return 1000 * (load[0] - LAB.LOAD)


@numbers.add("sigma of the load, each from both sides", "{:.0f} g",
    NOISE=times(2.0, "the residual is noise, with hardly any friction", within=0.05),
    NOISE_SEED=between(0.7, 1.4, "sigma is estimated from 35 torques only", to=48),
    poses=between(0.6, 0.85, "1/√2 for twice as many poses; the rest is chance, because sigma is estimated from the residual"))
def load_sigma(poses=5):
    rng = np.random.default_rng(LAB.NOISE_SEED)
    rng.normal(size=(600, 7))  # the lab's three motions have these
    off = LAB.NOISE * rng.normal(size=(2, 2, poses, 7))  # empty and loaded, by side
    how = poses, LAB.WAIT, 1.0, 0.02, 0.9, 0.002, DAY.OMEGA
    empty, full = (
        [holds(m, side, *how) for side in (1.0, -1.0)] for m in (0, LAB.LOAD)
    )
    extra = np.mean([f[1] - e[1] for f, e in zip(full, empty, strict=True)], axis=0)
    extra += (off[1] - off[0]).mean(axis=0)
    return 1000 * LAB.weighed(ARM, (full[0][0] + full[1][0]) / 2, extra)[1][0]
