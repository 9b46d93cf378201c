# task 6.8: half-a-spring
# The 2 of the energy.


def set_point_for_force(force, k, surface):
    return surface - 2 * force / k
