# task 6.8: whole-metres
# // in place of /.


def set_point_for_force(force, k, surface):
    return surface - force // k
