# task 6.8: millimetres
# 50 for 0.05.


def set_point_for_force(force, k, surface):
    return surface - 1000 * force / k
