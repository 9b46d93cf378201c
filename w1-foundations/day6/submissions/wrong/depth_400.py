# task 6.8: docstrings-numbers
# The stiffness of the lab typed in.


def set_point_for_force(force, k, surface):
    return surface - force / 400.0
