# task 4.8: divided-entry-by-entry
# 1 / M is no inverse.


def forward_dynamics(M, bias, damping, qd, tau):
    return (1 / M) @ (tau - bias - damping * qd)
