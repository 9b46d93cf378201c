"""Gravity on the ground, once for the whole library: a vector in world axes, z up."""

import numpy as np

GRAVITY = np.array([0.0, 0.0, -9.81])  # m/s^2
GRAVITY.flags.writeable = False  # shared by every importer
