# task 6.5: docstrings-numbers
# The docstring's surface.


def set_point_for_force(force, k, surface):
    return 0.42 - force / k
