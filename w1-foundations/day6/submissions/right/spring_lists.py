# task 6.5: passed
# Row by row, in plain Python.


def spring_wrench(e, V_err, K, D):
    return [
        sum(k * x for k, x in zip(K[i], e)) + sum(d * x for d, x in zip(D[i], V_err))
        for i in range(6)
    ]
