# task 7.9: another-gravity
# The standard gravity for g.
def heaviest_cube(grip, mu, acceleration):
    return 2 * mu * grip / (9.80665 + acceleration)
