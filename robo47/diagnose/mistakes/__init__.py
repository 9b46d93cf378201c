"""The named mistakes, one module per kind of function, the more general first."""

from robo47.diagnose.mistakes.factors import JOINT_T, LINK_T
from robo47.diagnose.mistakes.mistake import Mistake
from robo47.diagnose.mistakes.order import PREDICT_ORDER
from robo47.diagnose.mistakes.poses import INVERSE, MAKE_T
from robo47.diagnose.mistakes.rotations import QUAT_TO_R, RZ

__all__ = ["OF_FUNCTION", "Mistake"]

# Those of compose_fk and link4_to_world need the robot: `mistakes.products`.
OF_FUNCTION: dict[str, list[Mistake]] = {
    "make_T": MAKE_T,
    "Rz": RZ,
    "inverse": INVERSE,
    "quat_to_R": QUAT_TO_R,
    "link_T": LINK_T,
    "joint_T": JOINT_T,
    "predict_order": PREDICT_ORDER,
}
