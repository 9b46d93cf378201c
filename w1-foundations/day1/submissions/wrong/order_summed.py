# task 1.7: only-summed
# As if nothing turned: then the order would not matter.


def predict_order(T_world_ee, T_extra):
    t = T_world_ee[:3, 3] + T_extra[:3, 3]
    return t, t
