"""The sensitivity of Day 9's numbers: each constant is doubled, and its effect measured.

Everything is computed by the lab's own functions.
"""

from copy import copy
from functools import cache

import numpy as np

from labkit.lesson.constants import Numbers, between, same, times, turned
from labkit.lesson.lab_module import complete_lab
from robo47 import panda, simulate
from robo47.references import raised_cosine

LAB = complete_lab(9)
DAY = LAB.day9_mujoco
MODEL = panda.load("panda_nohand", drive="torque")
ARM = panda.arm(MODEL)

numbers = Numbers(
    LAB, DAY,
    BITS="bits of the encoder: {}",
    dt="time between samples: {} s",
    reach="amplitude of the swing, REACH: × {}",
    OMEGA="omega of the PD gains: {} 1/s",
    zeta="damping ratio: {}",
    late="delay: {} s",
    RATE="control rate: {} Hz",
    SMALL="initial error, SMALL: {} rad",
    cutoff="cutoff: {} Hz",
    WANDERS="WANDERS, of the joint and of the filter: {} rad²/s³",
    NOISE="NOISE, of the readings and of the filter: {} rad",
    SEED="SEED: {}",
    told_q="accel_psd of the filter: WANDERS × {}",
    told_R="R of the filter: NOISE² × {}",
    GAIN="GAIN: {} 1/s",
    DT="time step: {} s",
    share="factor of the energy's gradient: {}",
    force="the push: {} N",
    THRESHOLD="THRESHOLD: {} N m",
)


@cache
def swung(reach):
    """Return how the arm follows two seconds of the swing."""
    swing = raised_cosine(panda.READY_Q, reach * DAY.REACH)
    return DAY.moved(MODEL, ARM, swing, 2.0)


@numbers.add("noise of a 16-bit difference", "{:.4f} rad/s",
    BITS=times(0.5, "a count is half as large", to=17),
    dt=times(0.5, "the same two rounding errors, divided by twice the time", within=0.05),
    reach=between(0.98, 1.02, "the rounding error does not depend on the motion, as long as successive errors are uncorrelated"))
def difference_noise(dt=LAB.DT, reach=1.0):
    q = swung(reach).q[:: round(dt / LAB.DT)]
    with turned(LAB, DT=dt):
        off = LAB.speeds(LAB.encoder(q, LAB.BITS)) - LAB.speeds(q)
    return LAB.rms(off[1:])


@numbers.add("delay margin", "{:.2f} ms",
    OMEGA=times(0.5, "1 / omega is the only time in the formula"),
    zeta=between(0.4, 1.0, "the phase lead grows, but the crossover frequency grows more"))
def margin(zeta=1.0):
    return 1000 * LAB.delay_margin(DAY.OMEGA**2, 2 * zeta * DAY.OMEGA)


@numbers.add("fraction of an error left after 2 s, 34 ms late", "{:.3g}",
    late=between(1.5, 1e9, "the delay is far above the margin, and the error grows until the motors saturate"),
    OMEGA=times(0.0, "with omega = 10 1/s the margin is 65 ms", within=0.05, to=10.0),
    RATE=between(0.3, 0.8, "holding the torque adds 0.5 ms to the delay on average, not 1 ms: the limit is 31.9 ms, and 34 ms is still above it"),
    SMALL=same("the loop is linear as long as no motor saturates"))
def left(late=0.034):
    model = copy(MODEL)
    model.opt.timestep = 1 / DAY.RATE
    return DAY.left_over(model, ARM, late, DAY.OMEGA, DAY.RATE)


@numbers.add("error of joint 4's velocity after a low pass of 50 Hz", "{:.4f} rad/s",
    cutoff=between(1.3, 1.7, "above the cutoff of the minimum, noise dominates"),
    BITS=between(0.5, 0.75, "half the noise, the same lag", to=17),
    reach=between(1.1, 1.4, "twice the acceleration doubles the lag, and the noise is the same"))
def smooth(cutoff=50.0, reach=1.0):
    run = swung(reach)
    z = LAB.encoder(run.q, LAB.BITS)[:, LAB.JOINT]
    raw = LAB.backward_difference(z, LAB.DT)
    off = LAB.low_pass(raw, LAB.DT, cutoff) - run.qd[:, LAB.JOINT]
    return LAB.rms(off[LAB.SETTLED :])


def tracked(told_q, told_R):
    """Return the output of a filter with these factors of accel_psd and R."""
    z, _ = LAB.wandering(np.random.default_rng(LAB.SEED))
    return LAB.track(z, told_q * LAB.WANDERS, told_R * LAB.NOISE**2)


@numbers.add("mean NIS of the correct filter", "{:.3f}",
    WANDERS=between(0.95, 1.05, "the innovations grow as the filter expects"),
    NOISE=between(0.95, 1.05, "the innovations grow as the filter expects"),
    SEED=between(0.9, 1.1, "another random sequence", to=10),
    told_q=between(0.7, 0.95, "the innovations are smaller than the filter expects"),
    told_R=between(0.5, 0.8, "the filter expects larger innovations"))
def nis(told_q=1.0, told_R=1.0):
    return tracked(told_q, told_R)["nis"].mean()


@numbers.add("lag-1 autocorrelation of the filter with two errors", "{:.3f}",
    WANDERS=between(0.9, 1.05, "the two parameters are still wrong by factors of 0.1 and 10"),
    NOISE=between(0.95, 1.1, "the two parameters are still wrong by factors of 0.1 and 10"),
    SEED=between(0.95, 1.05, "another random sequence", to=10),
    told_q=between(0.85, 0.99, "the ratio of accel_psd to R is wrong by a factor of 50, not of 100"),
    told_R=between(1.0, 1.1, "the ratio is wrong by a factor of 200"))
def white(told_q=0.1, told_R=10.0):
    return LAB.lag1_autocorrelation(tracked(told_q, told_R)["innovation"])


@numbers.add("largest residual in free motion", "{:.3f} N m",
    GAIN=between(1.0, 1.01, "the lag of the observer is not the cause"),
    DT=times(2.0, "the error of a first-order integrator doubles with the time step", within=0.02),
    reach=between(1.5, 4.5, "velocities double, and their products grow fourfold"),
    share=between(50, 200, "the residual then contains the gradient", to=0.0))
def free(reach=1.0, share=1.0):
    model = copy(MODEL)
    model.opt.timestep = LAB.DT
    law = DAY.tracking(ARM, raised_cosine(panda.READY_Q, reach * DAY.REACH))
    data = simulate.start(model, panda.READY_Q)
    run = simulate.run(model, data, law, 1.0, rate=1 / LAB.DT)
    return np.abs(LAB.felt(ARM, run, share)).max()


@numbers.cached
def pushed(force):
    """Return the run of step 6 with another push."""
    push = DAY.push(LAB.FLANGE, [0.0, 0.0, -force], LAB.SINCE)
    return DAY.moved(MODEL, ARM, DAY.STAY, 0.8, push)


@numbers.add("joint 4's residual of 10 N on the flange", "{:.3f} N m",
    force=times(2.0, "J^T F is linear in F; the arm yields a little more"),
    OMEGA=between(0.99, 1.01, "a stiffer controller yields less"),
    GAIN=same("the gain changes the time, not the final value"),
    share=same("at rest the gradient is zero", to=-1.0))
def steady(force=10.0, share=1.0):
    return LAB.felt(ARM, pushed(force), share)[-1, LAB.JOINT]


@numbers.add("detection time of 10 N on the flange", "{:.0f} ms",
    force=times(0.5, "the residual needs only 1.1 ms, so the first sample detects it"),
    GAIN=times(0.5, "the residual needs only 1.1 ms, so the first sample detects it"),
    THRESHOLD=times(1.5, "the residual needs 4.8 ms, so the third sample detects it"),
    share=same("at rest the gradient is zero", to=-1.0))
def noticed(force=10.0, share=1.0):
    return LAB.notices(LAB.felt(ARM, pushed(force), share))
