# task 1.7: shape
# Homogeneous points, with their fourth entry.


def predict_order(T_world_ee, T_extra):
    return T_world_ee @ T_extra[:, 3], T_extra @ T_world_ee[:, 3]
