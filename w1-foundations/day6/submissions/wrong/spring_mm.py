# task 6.5: millimetres
# The error in mm.


def spring_wrench(e, V_err, K, D):
    e = e.copy()
    e[3:] *= 1000
    return K @ e + D @ V_err
