# task 6.9: damper-left-out
# No damper anywhere.


def hybrid_wrench(e, V_err, K, D, force):
    wrench = K @ e
    wrench[5] = -force
    return wrench
