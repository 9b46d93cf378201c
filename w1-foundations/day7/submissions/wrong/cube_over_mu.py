# task 7.9: divided-by-friction
# mu below the line.
def heaviest_cube(grip, mu, acceleration):
    return 2 * grip / (mu * (9.81 + acceleration))
