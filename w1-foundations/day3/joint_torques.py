"""3.7 `joint_torques(J_space, p, F)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector
from robo47.jacobian import site_jacobian

from .jacobians import JOINTS

row = Row(Vector((7,), "N m", names=JOINTS))


@row.inputs
def _(rng):
    """Return the docstring's call, then random ones."""
    spin = np.zeros((6, 7))
    spin[2, 0] = 1.0
    first = (spin, np.array([0.0, 1.0, 0.0]), np.array([0.0, 0, 0, -10, 0, 0]))
    drawn = rng.numbers(-1, 1, 9, 6, 7)
    points, wrenches = (rng.numbers(-1, 1, 9, n) for n in (3, 6))
    return [first, *zip(drawn, points, wrenches, strict=True)]


@row.wrongs
def _(J_space, p, F):
    """at-the-origin: your code uses J_space^T, which requires the moment about the
      world origin. The given moment is about p, so use the site Jacobian of p, or
      convert the moment to the world origin
    what-balances-it: your code returns the negative of the correct torques. F is the
      wrench that the hand exerts, so the motor power should equal the power of F
    pseudo-inverse: your code returns J^+ F, which does not conserve power. Which matrix
      makes the motor power equal to the power of F at the hand?
    moment-forgotten: your code omits the moment in F. The power of F also includes the
      dot product of the moment and omega
    force-forgotten: your code omits the force in F. The power of F also includes the
      dot product of the force and v
    arm-the-wrong-way: your torques contain f x p instead of p x f as the moment of the
      force f about the world origin. In the site Jacobian, the same mistake is p x
      omega instead of omega x p
    arm-twice: your torques contain the moment p x f of the force f twice. Use the
      moment about the world origin with J_space, or the given moment with the site
      Jacobian of p => both
    """
    J = site_jacobian(J_space, p)
    moment = F[:3]
    force = F[3:]
    return {
        "at-the-origin": J_space.T @ F,
        "what-balances-it": -J.T @ F,
        "pseudo-inverse": np.linalg.pinv(J) @ F,
        "moment-forgotten": J[3:].T @ force,
        "force-forgotten": J[:3].T @ moment,
        "arm-the-wrong-way": site_jacobian(J_space, -p).T @ F,
        "arm-twice": J.T @ np.append(moment + np.cross(p, force), force),
    }
