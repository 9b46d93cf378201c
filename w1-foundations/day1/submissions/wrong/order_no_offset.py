# task 1.7: left-translation-lost
# Directions are turned; points are also moved.


def predict_order(T_world_ee, T_extra):
    return T_world_ee[:3, :3] @ T_extra[:3, 3], T_extra[:3, :3] @ T_world_ee[:3, 3]
