# task 1.3: T-transposed
# R's inverse is its transpose, so T's must be too.


def inverse(T):
    return T.T
