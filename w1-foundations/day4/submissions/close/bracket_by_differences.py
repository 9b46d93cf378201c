# task 4.5: rounded-somewhere
# The derivative of the adjoint, by a difference.
import numpy as np

from robo47.screws import adjoint, exp_screw


def ad(V):
    h = 3e-4
    size = np.linalg.norm(V[:3]) or np.linalg.norm(V[3:])
    S = np.asarray(V) / size
    there, back = adjoint(exp_screw(S, h * size)), adjoint(exp_screw(S, -h * size))
    return (there - back) / (2 * h)
