# task 1.3: one-over-each-entry
# ** is elementwise for arrays.


def inverse(T):
    return T**-1
