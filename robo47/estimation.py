"""Estimation: encoders, a Kalman filter with two tests, and a momentum observer.

An encoder's error is predicted from its bits. The Kalman filter's noise parameters are
tested without the truth: by the mean of its normalised innovation squared (NIS), and by
the lag-1 autocorrelation of its innovations. The momentum observer estimates the
external torque from the commanded torques and the arm's momentum. Conventions:

- Time runs along the first axis, one sample every `dt` seconds; no function uses later
  samples.
- A state x has a covariance P; accel_psd is the power spectral density of the white
  acceleration that drives a constant-velocity model, rad^2/s^3.
- Twists are (omega; v), expressed in the world frame; `J_space` is the space Jacobian,
  G are the links' spatial inertias about the world's origin, as in `robo47.dynamics`.
- Radians, seconds, N m. A wrong shape or a number that is not finite is a ValueError,
  in every function. No function draws random numbers: noise is an argument.

Sources: Bar-Shalom, Li and Kirubarajan, *Estimation with Applications to Tracking and
Navigation* (2001), chapters 5 and 6; Thrun, Burgard and Fox, *Probabilistic Robotics*
(2005), section 3.2; Astrom and Murray, *Feedback Systems* (2008), chapter 9; De Luca
and Mattone, "Actuator failure detection and isolation using generalized momenta" (2003)
and "Sensorless robot collision detection and hybrid force/motion control" (2005);
De Luca, Albu-Schaeffer, Haddadin and Hirzinger, "Collision detection and safe reaction
with the DLR-III lightweight manipulator arm" (2006); Haddadin, De Luca and
Albu-Schaeffer, "Robot collisions: a survey on detection, isolation, and identification"
(2017); Wilson and Hilferty, "The distribution of chi-square" (1931).
"""

import math

import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks
from robo47.checks import Array
from robo47.dynamics import ad
from robo47.fast.vectors import times

Z_95 = 1.96  # standard deviations; a Gaussian lies within them with 95 %


def quantise(q: ArrayLike, counts: float) -> Array:
    """Return the angle that an encoder reports: the nearest whole count.

    The result is round(q / step) step with step = 2 pi / counts; exactly between two
    counts it is the even one.

    Args:
        q: angles, rad, (...).
        counts: in a full revolution, above 0; 2**16 for 16 bits.

    Returns:
        rad, (...).
    """
    step = 2.0 * np.pi / float(checks.positive(counts, "counts"))
    return np.round(checks.array(q, "q", ()) / step) * step


def backward_difference(q: ArrayLike, dt: float) -> Array:
    """Return the velocities by a backward difference; the first one is 0.

    Args:
        q: angles, rad, (n, ...).
        dt: s, above 0.

    Returns:
        rad/s, (n, ...): (q_k - q_(k-1)) / dt, the mean since the sample before.
    """
    q = _samples(q, "q")
    dt = float(checks.positive(dt, "dt"))
    return np.diff(q, axis=0, prepend=q[:1]) / dt


def delay_margin(kp: ArrayLike, kd: ArrayLike) -> Array:
    """Return the delay margin of a PD controller on a unit mass, in seconds.

    The loop (kp + kd s) / s^2 has its gain crossover at w^2 = (kd^2 + sqrt(kd^4 + 4
    kp^2)) / 2, where its phase margin is atan(kd w / kp). A delay T reduces the phase
    by w T (Astrom and Murray, chapter 9).

    Args:
        kp: proportional gain, 1/s^2, (...), above 0.
        kd: derivative gain, 1/s, (...), above 0.

    Returns:
        s, (...).
    """
    kp, kd = checks.positive(kp, "kp"), checks.positive(kd, "kd")
    w = np.sqrt((kd**2 + np.sqrt(kd**4 + 4.0 * kp**2)) / 2.0)
    return np.arctan2(kd * w, kp) / w


def low_pass(x: ArrayLike, dt: float, cutoff: float) -> Array:
    """Return samples behind a first-order low pass, which starts at the first sample.

    y += alpha (x - y), from y_0 = x_0, with alpha = 1 - exp(-2 pi cutoff dt): exact
    for an x that is constant between samples, at any cutoff.

    Args:
        x: samples, (n, ...).
        dt: s, above 0.
        cutoff: cutoff frequency, Hz, above 0. An oscillation of this frequency keeps
            0.71 of its amplitude if the cutoff is far below 1 / dt, and more otherwise:
            0.72 at a tenth of 1 / dt, 0.75 at a fifth.

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
    """Return F and Q of the constant-velocity model with a white acceleration.

    The integral over dt gives Q = accel_psd [[dt^3/3, dt^2/2], [dt^2/2, dt]]
    (Bar-Shalom, chapter 6).

    Args:
        dt: s, above 0.
        accel_psd: power spectral density of the acceleration, rad^2/s^3, not below 0.

    Returns:
        (F, Q), (2, 2) each: x = (angle; velocity) becomes F x plus noise with the
        covariance Q.
    """
    dt = float(checks.positive(dt, "dt"))
    accel_psd = float(checks.not_negative(accel_psd, "accel_psd"))
    F = np.array([[1.0, dt], [0.0, 1.0]])
    Q = accel_psd * np.array([[dt**3 / 3.0, dt**2 / 2.0], [dt**2 / 2.0, dt]])
    return F, Q


def kalman_predict(
    x: ArrayLike, P: ArrayLike, F: ArrayLike, Q: ArrayLike
) -> tuple[Array, Array]:
    """Return the Kalman filter's prediction: the state F x, covariance F P F^T + Q.

    Args:
        x: state, (..., n).
        P: its covariance, (..., n, n).
        F: maps the state to the next one, (..., n, n).
        Q: covariance of the process noise, (..., n, n).

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
    """Return the Kalman filter's update by a reading: state, covariance and NIS.

    y = z - H x is the innovation, S = H P H^T + R its covariance and K = P H^T S^-1 the
    Kalman gain: the state x + K y, the covariance P - K S K^T, and the normalised
    innovation squared NIS = y . S^-1 y, whose mean is m if the model is correct
    (Bar-Shalom, chapter 5).

    Args:
        x, P: as in `kalman_predict`.
        z: reading, (..., m).
        H: measurement matrix, (..., m, n).
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
    """Return the interval that holds the mean of n NIS with a probability of 95 %.

    n times this mean has the chi-square distribution with n m degrees of freedom. The
    interval is m (1 - c -+ 1.96 sqrt(c))^3 with c = 2 / (9 n m) (Wilson and Hilferty).

    Args:
        n: number of readings, above 0.
        m: number of entries of a reading, above 0.

    Returns:
        (low, high), (2,): within 2e-6 of SciPy's chi2 at n m = 1950, 0.003 at 10. At
        n m = 1 low is slightly below 0, which no NIS is.
    """
    n, m = float(checks.positive(n, "n")), float(checks.positive(m, "m"))
    c = 2.0 / (9.0 * n * m)
    return m * (1.0 - c + np.array([-Z_95, Z_95]) * np.sqrt(c)) ** 3


def lag1_autocorrelation(y: ArrayLike) -> float:
    """Return the lag-1 autocorrelation of a sequence: near 0 for white noise.

    Subtract the mean from y; then the sum of y_k y_(k+1) over the sum of y_k^2
    (Bar-Shalom, chapter 5). For n independent values it is within 1.96 / sqrt(n) of 0
    with a probability of 95 %. A correlation at a larger lag is not measured.

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
    """Return the gradient of the kinetic energy by the angles, at constant velocities.

    Rotating joint i rotates the links from i on together with their inertias. Seen from
    these links the twist V_i changes by -ad(S_i) V_i per radian, so the energy changes
    by minus the sum of G_k V_k over k >= i, times ad(S_i) V_i. The gradient equals
    C^T qd for a Coriolis matrix with dM/dt = C + C^T, as `dynamics.coriolis_matrix`.

    Args:
        J_space: space Jacobian, (..., 6, n).
        G: inertias of the links about the world's origin, (..., n, 6, 6).
        qd: joint velocities, rad/s, (..., n).

    Returns:
        dE/dq, N m, (..., n). A rotor's energy does not depend on the angles.
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
    """Return the momentum observer's residual (external torque estimate) and integral.

    The momentum M qd changes by tau + energy_grad - gravity - damping qd and by the
    external torque. `integral` advances by dt times the known torques plus the residual
    of the sample before; the residual gain (momentum - integral) then follows the
    external torque as a first-order low pass, 63 % of it after 1 / gain (De Luca and
    Mattone 2003, 2005). An error of the model is part of the residual. Begin with
    integral = momentum and residual = 0.

    Args:
        residual: of the sample before, N m, (..., n).
        integral: of the sample before, kg m^2/s, (..., n).
        momentum: M qd of now, kg m^2/s, (..., n).
        tau: commanded torque since the sample before, N m, (..., n).
        energy_grad: `kinetic_energy_gradient` of the sample before, N m, (..., n).
        gravity: torque that holds the arm, of the sample before, N m, (..., n).
        damping: of the joints, N m s/rad, a number or (n,).
        qd: joint velocities of the sample before, rad/s, (..., n).
        gain: 1/s, above 0; it overshoots from 1 / dt and is unstable from 2 / dt on.
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
    """Return the contact link: the last joint over its threshold, from 1; 0 if none is.

    This is collision isolation. The contact is on this link or on a distal one, if the
    model is correct: a force whose line meets a joint's axis causes no torque there.

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
    """Return a state and its covariance, whose shapes must agree."""
    x = checks.array(x, "x", ("n",))
    return x, checks.array(P, "P", (x.shape[-1], x.shape[-1]))
