# task 6.5: docstrings-numbers
# The docstring's surface.


def set_point_for_force(force, k, surface):
    return 0.42 - force / k


def impedance_wrench(e, V_err, K, D):
    return K @ e + D @ V_err
