# task 6.5: spring-and-damper-swapped
# K and D in each other's place.
import numpy as np


def spring_wrench(e, V_err, K, D):
    return D @ e + K @ V_err
