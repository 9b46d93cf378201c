# task 6.8: surface-only
# At the surface there is no push.


def set_point_for_force(force, k, surface):
    return surface
