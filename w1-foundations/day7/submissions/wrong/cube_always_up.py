# task 7.9: acceleration-without-sign
# abs of the acceleration.
def heaviest_cube(grip, mu, acceleration):
    return 2 * mu * grip / (9.81 + abs(acceleration))
