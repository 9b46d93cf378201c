# task 7.9: acceleration-without-sign
# No acceleration under 0.
def heaviest_cube(grip, mu, acceleration):
    return 2 * mu * grip / (9.81 + max(acceleration, 0))
