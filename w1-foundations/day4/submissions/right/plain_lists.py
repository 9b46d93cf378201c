# tasks 4.3 4.4: passed
# Lists and loops, no matrix product.


def mass_matrix(J, G, armature):
    M = [[0.0] * 7 for _ in range(7)]
    for link in range(7):
        for i in range(link + 1):
            for j in range(link + 1):
                for a in range(6):
                    for b in range(6):
                        M[i][j] += J[a][i] * G[link][a][b] * J[b][j]
    for i in range(7):
        M[i][i] += armature[i]
    return M


def gravity_torque(J, masses, coms_world, g):
    tau = [0.0] * 7
    for i in range(7):
        wx, wy, wz, vx, vy, vz = [row[i] for row in J]
        for m, (x, y, z) in list(zip(masses, coms_world))[i:]:
            tau[i] -= m * g[0] * (vx + wy * z - wz * y)
            tau[i] -= m * g[1] * (vy + wz * x - wx * z)
            tau[i] -= m * g[2] * (vz + wx * y - wy * x)
    return tau
