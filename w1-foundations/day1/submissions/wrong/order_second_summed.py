# task 1.7: only-summed
# The tool step is right; "the arm only moves" is not.


def predict_order(T_world_ee, T_extra):
    R, t, step = T_world_ee[:3, :3], T_world_ee[:3, 3], T_extra[:3, 3]
    return R @ step + t, t + step
