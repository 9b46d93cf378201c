# tasks 1.1 1.2 1.3: passed
# No array library at all: lists of lists, loops and the math module.
from math import cos, sin


def make_T(R, t):
    rows = [[*(float(x) for x in R[i]), float(t[i])] for i in range(3)]
    return [*rows, [0.0, 0.0, 0.0, 1.0]]


def Rz(theta):
    return [[cos(theta), -sin(theta), 0], [sin(theta), cos(theta), 0], [0, 0, 1]]


def inverse(T):
    R = [[T[j][i] for j in range(3)] for i in range(3)]
    t = [-sum(R[i][j] * T[j][3] for j in range(3)) for i in range(3)]
    return make_T(R, t)
