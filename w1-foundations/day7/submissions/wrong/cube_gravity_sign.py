# task 7.9: gravity-negative
# g with its sign.
def heaviest_cube(grip, mu, acceleration):
    return 2 * mu * grip / (acceleration - 9.81)
