# task 4.8: multiplied-by-M
# M @ for solve.


def forward_dynamics(M, bias, damping, qd, tau):
    return M @ (tau - bias - damping * qd)
