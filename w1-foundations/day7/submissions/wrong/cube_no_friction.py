# task 7.9: friction-forgotten
# mu left out.
def heaviest_cube(grip, mu, acceleration):
    return 2 * grip / (9.81 + acceleration)
