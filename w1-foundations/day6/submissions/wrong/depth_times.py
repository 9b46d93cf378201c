# task 6.8: force-times-k
# N times N/m.


def set_point_for_force(force, k, surface):
    return surface - force * k
