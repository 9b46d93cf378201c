# task 7.9: one-factor-off
# In grams.
def max_cube_mass(grip, mu, acceleration):
    return 2000 * mu * grip / (9.81 + acceleration)
