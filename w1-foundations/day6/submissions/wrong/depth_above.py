# task 6.8: above-the-surface
# The wrong sign: 0 N.


def set_point_for_force(force, k, surface):
    return surface + force / k
