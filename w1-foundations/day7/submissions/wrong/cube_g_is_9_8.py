# task 7.9: another-gravity
# 9.8 for g.
def heaviest_cube(grip, mu, acceleration):
    return 2 * mu * grip / (9.8 + acceleration)
