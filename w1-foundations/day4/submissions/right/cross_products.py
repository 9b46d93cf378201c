# tasks 4.4 4.5: passed
# np.cross, column by column.
import numpy as np


def gravity_torque(J, masses, coms_world, g):
    tau = []
    for i in range(7):
        w, v = J[:3, i], J[3:, i]
        beyond = range(i, 7)
        climbs = [masses[k] * (v + np.cross(w, coms_world[k])) @ g for k in beyond]
        tau.append(-sum(climbs))
    return np.array(tau)


def ad(V):
    w, v = np.array(V[:3]), np.array(V[3:])
    columns = []
    for e in np.eye(6):
        a, b = e[:3], e[3:]
        columns.append(np.r_[np.cross(w, a), np.cross(v, a) + np.cross(w, b)])
    return np.stack(columns, axis=1)
