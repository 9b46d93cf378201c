# task 1.7: wrong-vector-turned
# Each R turns its own t.


def predict_order(T_world_ee, T_extra):
    R, t = T_world_ee[:3, :3], T_world_ee[:3, 3]
    R_extra, t_extra = T_extra[:3, :3], T_extra[:3, 3]
    return R @ t + t_extra, R_extra @ t_extra + t
