# task 6.9: damper-sign
# The damper drives on.


def hybrid_wrench(e, V_err, K, D, force):
    wrench = K @ e - D @ V_err
    wrench[5] = -D[5] @ V_err - force
    return wrench
