# task 7.9: one-finger
# One face.
def heaviest_cube(grip, mu, acceleration):
    return mu * grip / (9.81 + acceleration)
