# task 6.8: depth-only
# How deep, not where.


def set_point_for_force(force, k, surface):
    return force / k
