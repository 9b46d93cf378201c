# task 1.3: t-kept
# A copy with the rotation transposed, and nothing else.


def inverse(T):
    out = T.copy()
    out[:3, :3] = T[:3, :3].T
    return out
