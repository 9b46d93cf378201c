# task 1.2: degrees-into-cos
# Converted to degrees "because cos needs degrees".
import numpy as np


def Rz(theta):
    theta = theta * 180 / np.pi
    c, s = np.cos(theta), np.sin(theta)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
