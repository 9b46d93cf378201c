# task 7.9: acceleration-forgotten
# At rest.
def heaviest_cube(grip, mu, acceleration):
    return 2 * mu * grip / 9.81
