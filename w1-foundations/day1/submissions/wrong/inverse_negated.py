# task 1.3: all-signs
# As one undoes an addition.


def inverse(T):
    return -T
