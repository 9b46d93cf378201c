# task 7.9: weight-for-mass
# In newtons.
def heaviest_cube(grip, mu, acceleration):
    return 2 * mu * grip
