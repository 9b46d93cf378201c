"""What an arm can feel: encoders, filters that can be tested, and a momentum observer.

A sensor is a number with an error that can be predicted. A filter is a claim about
the motion and about that error, and two numbers test the claim: how large its
surprises are (NIS), and whether they are independent (whiteness). The observer finds
the torque that nobody commanded, from the motors' torques and the arm's momentum.
Conventions:

- Time runs along the first axis, one sample every `dt` seconds; nothing looks ahead.
- A state x has a covariance P; accel_psd is the intensity of the white acceleration
  that drives a constant-velocity model, (rad/s^2)^2 per Hz, that is rad^2/s^3.
- Twists are (omega; v); `J_space` is the space Jacobian, G are the links' inertias
  about the world's origin, as in `robo47.dynamics`.
- Radians, seconds, N m. A wrong shape or a number that is not finite is a ValueError,
  in every function. Nothing is drawn here: noise is an argument.

Sources: Bar-Shalom, Li and Kirubarajan, *Estimation with Applications to Tracking and
Navigation* (2001), chapters 5 and 6; Thrun, Burgard and Fox, *Probabilistic Robotics*
(2005), section 3.2; Astrom and Murray, *Feedback Systems* (2008), chapter 9; De Luca
and Mattone, "Actuator failure detection and isolation using generalized momenta"
(2003); Wilson and Hilferty, "The distribution of chi-square" (1931).
"""

import math

import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks
from robo47.checks import Array
from robo47.dynamics import ad
from robo47.fast.vectors import times

Z_95 = 1.96  # a normal number lies within it 95 times in 100


def quantise(q: ArrayLike, counts: float) -> Array:
    """Return the angle that an encoder reports: the nearest of `counts` in a turn.

    round(q / step) step, with step = 2 pi / counts. Half-way it is the even count.

    Args:
        q: angles, rad, (...).
        counts: in a full turn, above 0; 2**16 for 16 bits.

    Returns:
        rad, (...).
    """
    step = 2.0 * np.pi / float(checks.positive(counts, "counts"))
    return np.round(checks.array(q, "q", ()) / step) * step


def backward_difference(q: ArrayLike, dt: float) -> Array:
    """Return the speed since the sample before, which the first one does not have: 0.

    Args:
        q: angles, rad, (n, ...).
        dt: s, above 0.

    Returns:
        rad/s, (n, ...): (q_k - q_(k-1)) / dt, half a sample old.
    """
    q = _samples(q, "q")
    dt = float(checks.positive(dt, "dt"))
    return np.diff(q, axis=0, prepend=q[:1]) / dt


def delay_margin(kp: ArrayLike, kd: ArrayLike) -> Array:
    """Return how late a spring and a damper may act before they shake a unit mass.

    The loop kp + kd s over s^2 has gain 1 at w^2 = (kd^2 + sqrt(kd^4 + 4 kp^2)) / 2,
    where its phase is atan(kd w / kp) short of -180 degrees; a delay T takes w T of
    that (Astrom and Murray, chapter 9).

    Args:
        kp: 1/s^2, (...), above 0.
        kd: 1/s, (...), above 0.

    Returns:
        s, (...).
    """
    kp, kd = checks.positive(kp, "kp"), checks.positive(kd, "kd")
    w = np.sqrt((kd**2 + np.sqrt(kd**4 + 4.0 * kp**2)) / 2.0)
    return np.arctan2(kd * w, kp) / w


def low_pass(x: ArrayLike, dt: float, cutoff: float) -> Array:
    """Return x without what is faster than the cutoff, and later than it.

    y += alpha (x - y), from y_0 = x_0, with alpha = 1 - exp(-2 pi cutoff dt): exact
    for an x that stays between samples, at any cutoff.

    Args:
        x: samples, (n, ...).
        dt: s, above 0.
        cutoff: Hz, above 0: there a slow signal's amplitude is down to 0.71.

    Returns:
        (n, ...).
    """
    x = _samples(x, "x")
    turns = float(checks.positive(dt, "dt")) * float(checks.positive(cutoff, "cutoff"))
    alpha = -math.expm1(-2.0 * np.pi * turns)
    y = np.empty_like(x)
    y[0] = x[0]
    for k in range(1, len(x)):
        y[k] = y[k - 1] + alpha * (x[k] - y[k - 1])
    return y


def constant_velocity(dt: float, accel_psd: float) -> tuple[Array, Array]:
    """Return the model of an angle whose speed is changed by nothing but white noise.

    Over dt the noise adds up to accel_psd [[dt^3/3, dt^2/2], [dt^2/2, dt]] (Bar-Shalom,
    chapter 6).

    Args:
        dt: s, above 0.
        accel_psd: intensity of the acceleration's noise, rad^2/s^3, not below 0.

    Returns:
        (F, Q), (2, 2) each: x = (angle; speed) becomes F x, and is less sure by Q.
    """
    dt = float(checks.positive(dt, "dt"))
    accel_psd = float(checks.not_negative(accel_psd, "accel_psd"))
    F = np.array([[1.0, dt], [0.0, 1.0]])
    Q = accel_psd * np.array([[dt**3 / 3.0, dt**2 / 2.0], [dt**2 / 2.0, dt]])
    return F, Q


def kalman_predict(
    x: ArrayLike, P: ArrayLike, F: ArrayLike, Q: ArrayLike
) -> tuple[Array, Array]:
    """Return what is believed a moment later: (F x, F P F^T + Q).

    Args:
        x: state, (..., n).
        P: its covariance, (..., n, n).
        F: what a moment does to the state, (..., n, n).
        Q: covariance of what it adds, (..., n, n).

    Returns:
        (x, P), as given.
    """
    x, P = _belief(x, P)
    n = x.shape[-1]
    F = checks.array(F, "F", (n, n))
    Q = checks.array(Q, "Q", (n, n))
    return times(F, x), F @ P @ np.swapaxes(F, -1, -2) + Q


def kalman_update(
    x: ArrayLike, P: ArrayLike, z: ArrayLike, H: ArrayLike, R: ArrayLike
) -> tuple[Array, Array, Array]:
    """Return what a reading changes, and how surprising it was.

    y = z - H x is the surprise, S = H P H^T + R its covariance, K = P H^T S^-1 what it
    is worth: x + K y, P - K S K^T, and NIS = y . S^-1 y, whose mean is m if the
    filter's claims are true (Bar-Shalom, chapter 5).

    Args:
        x, P: as in `kalman_predict`.
        z: reading, (..., m).
        H: how the state is read, (..., m, n).
        R: covariance of the reading's noise, (..., m, m), positive definite.

    Returns:
        (x, P, nis): as given, and (...).

    Raises:
        ValueError: a wrong shape, or S cannot be inverted.
    """
    x, P = _belief(x, P)
    z = checks.array(z, "z", ("m",))
    H = checks.array(H, "H", (z.shape[-1], x.shape[-1]))
    R = checks.array(R, "R", (z.shape[-1], z.shape[-1]))
    y = z - times(H, x)
    PHt = P @ np.swapaxes(H, -1, -2)
    S = H @ PHt + R
    try:
        worth = np.linalg.solve(S, np.swapaxes(PHt, -1, -2))  # S^-1 H P = K^T
        weighed = np.linalg.solve(S, y[..., None])[..., 0]
    except np.linalg.LinAlgError:
        raise ValueError("H P H^T + R cannot be inverted: is R zero?") from None
    K = np.swapaxes(worth, -1, -2)
    nis = (y * weighed).sum(axis=-1)
    return x + times(K, y), P - K @ S @ worth, nis


def nis_interval(n: float, m: float) -> Array:
    """Return between what the mean of n NIS lies 95 times in 100.

    n times it is chi-square of n m degrees of freedom, by Wilson and Hilferty
    m (1 - c -+ 1.96 sqrt(c))^3 with c = 2 / (9 n m).

    Args:
        n: how many, above 0.
        m: size of a reading, above 0.

    Returns:
        (low, high), (2,): within 2e-6 of SciPy's chi2 at n m = 1950, 0.003 at 10.
    """
    n, m = float(checks.positive(n, "n")), float(checks.positive(m, "m"))
    c = 2.0 / (9.0 * n * m)
    return m * (1.0 - c + np.array([-Z_95, Z_95]) * np.sqrt(c)) ** 3


def lag1_autocorrelation(y: ArrayLike) -> float:
    """Return how much each number looks like the one before: 0 for independent ones.

    The correlation at a lag of one sample, of y less its mean: the sum of y_k y_(k+1)
    over the sum of y_k^2 (Bar-Shalom, chapter 5). Of n independent numbers it lies
    within 1.96 / sqrt(n) 95 times in 100.

    Args:
        y: (n,), not all the same.

    Raises:
        ValueError: wrong shape, or all numbers are the same.
    """
    numbers = checks.array(y, "y", ("n",))
    if numbers.ndim != 1:
        raise ValueError(f"y has shape {numbers.shape}; expected (n,)")
    if np.ptp(numbers) == 0.0:
        raise ValueError("all numbers of y are the same: nothing varies")
    off = numbers - numbers.mean()
    return float(off[1:] @ off[:-1]) / float(off @ off)


def kinetic_energy_gradient(J_space: ArrayLike, G: ArrayLike, qd: ArrayLike) -> Array:
    """Return how the kinetic energy changes with each angle, the speeds kept.

    Turn all links from i on by S_i. Their inertias turn with them, so seen from them
    it is V_i that turns back, by -ad(S_i) V_i, and energy changes by momentum times
    that: minus the sum of G_k V_k over k >= i, times ad(S_i) V_i. It is C^T qd.

    Args:
        J_space: space Jacobian, (..., 6, n).
        G: inertias of the links about the world's origin, (..., n, 6, 6).
        qd: joint velocities, rad/s, (..., n).

    Returns:
        dT/dq, N m, (..., n). A rotor's energy changes with no angle.
    """
    J = checks.array(J_space, "J_space", (6, "n"))
    n = J.shape[-1]
    G = checks.array(G, "G", (n, 6, 6))
    qd = checks.array(qd, "qd", (n,))
    S = np.swapaxes(J, -1, -2)
    V = np.cumsum(S * qd[..., None], axis=-2)
    momenta = np.cumsum(times(G, V)[..., ::-1, :], axis=-2)[..., ::-1, :]
    return -(momenta * times(ad(S), V)).sum(axis=-1)


def momentum_observer_step(
    residual: ArrayLike, integral: ArrayLike, momentum: ArrayLike, tau: ArrayLike,
    energy_grad: ArrayLike, gravity: ArrayLike, damping: ArrayLike, qd: ArrayLike,
    gain: float, dt: float,
) -> tuple[Array, Array]:  # fmt: skip
    """Return the torque that nobody commanded, as it is felt one sample later.

    The momentum M qd changes by tau + energy_grad - gravity - damping qd and by
    what nobody commanded. `integral` adds up what is known, with the residual fed back;
    gain (momentum - integral) then follows the unknown torque, 63 % of it after 1 /
    gain (De Luca and Mattone 2003). Begin with integral = momentum and residual 0.

    Args:
        residual: the last one, N m, (..., n).
        integral: the last one, kg m^2/s, (..., n).
        momentum: momentum now, kg m^2/s, (..., n).
        tau: of the motors since the last sample, N m, (..., n).
        energy_grad: `kinetic_energy_gradient`, N m, (..., n).
        gravity: torque that holds the arm still, N m, (..., n).
        damping: of the joints, N m s/rad, a number or (n,).
        qd: joint velocities, rad/s, (..., n).
        gain: 1/s, above 0; it blows up from 2 / dt on.
        dt: s, above 0.

    Returns:
        (residual in N m, integral in kg m^2/s), (..., n) each.
    """
    residual, integral, momentum, tau, energy_grad, gravity, qd = checks.same_size(
        residual=residual, integral=integral, momentum=momentum, tau=tau,
        energy_grad=energy_grad, gravity=gravity, qd=qd,
    )  # fmt: skip
    gain, dt = float(checks.positive(gain, "gain")), float(checks.positive(dt, "dt"))
    brake = checks.per_joint(damping, "damping", qd) * qd
    integral = integral + (tau + energy_grad - gravity - brake + residual) * dt
    return gain * (momentum - integral), integral


def contact_link(residual: ArrayLike, threshold: ArrayLike) -> int:
    """Return the last joint that feels a push, counted from 1; 0 where none does.

    The push is on its link or on one after it: a force whose line meets a joint's axis
    makes no torque there.

    Args:
        residual: N m, (n,).
        threshold: N m, a number or (n,), not below 0.
    """
    residual = checks.array(residual, "residual", ("n",))
    threshold = checks.not_negative(threshold, "threshold")
    threshold = checks.per_joint(threshold, "threshold", residual)
    felt = np.flatnonzero(np.abs(residual) > threshold)
    return int(felt[-1]) + 1 if len(felt) else 0


def _samples(x: ArrayLike, name: str) -> Array:
    """Return samples in time, at least one, as float64."""
    x = checks.array(x, name, ())
    if not x.ndim or not len(x):
        raise ValueError(f"{name} has shape {x.shape}; expected (n, ...): samples")
    return x


def _belief(x: ArrayLike, P: ArrayLike) -> tuple[Array, Array]:
    """Return a state and its covariance, checked together."""
    x = checks.array(x, "x", ("n",))
    return x, checks.array(P, "P", (x.shape[-1], x.shape[-1]))
