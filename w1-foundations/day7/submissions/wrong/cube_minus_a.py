# task 7.9: acceleration-sign
# g - a.
def heaviest_cube(grip, mu, acceleration):
    return 2 * mu * grip / (9.81 - acceleration)
