# task 6.8: half-a-depth
# Half a spring.


def set_point_for_force(force, k, surface):
    return surface - force / (2 * k)
