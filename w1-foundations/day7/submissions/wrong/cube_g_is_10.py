# task 7.9: another-gravity
# 10 for g.
def heaviest_cube(grip, mu, acceleration):
    return 2 * mu * grip / (10 + acceleration)
