# task 1.7: orders-swapped
# Right and left exchanged.


def predict_order(T_world_ee, T_extra):
    R, t = T_world_ee[:3, :3], T_world_ee[:3, 3]
    R_extra, t_extra = T_extra[:3, :3], T_extra[:3, 3]
    return R_extra @ t + t_extra, R @ t_extra + t
