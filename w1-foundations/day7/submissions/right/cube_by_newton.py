# task 7.9: passed
# Forces first.
def heaviest_cube(grip, mu, acceleration):
    gravity = [0.0, 0.0, -9.81]
    friction = mu * grip + mu * grip
    return friction / (acceleration - gravity[2])
