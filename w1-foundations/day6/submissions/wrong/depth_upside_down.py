# task 6.8: k-over-force
# The fraction upside down.


def set_point_for_force(force, k, surface):
    return surface - k / force
