# task 6.7: bias-twice
# bias in both places.


def impedance_torque(J, wrench, bias, damping, qd, tau_null):
    held = bias + tau_null
    return J.T @ wrench + bias + damping * qd + held
