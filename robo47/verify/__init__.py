"""MuJoCo as the oracle: what the simulator itself says of poses, forces and motion.

Nothing here composes a transform or a torque; this is what they are judged against.
Units: metres, radians, seconds, kilograms.
"""

from robo47.verify.answers import (
    each,
    in_the_hand,
    off_adjoint,
    off_cross,
    off_goal,
    off_least_squares,
    off_library,
    off_log,
    off_motion,
    off_null_vector,
    off_rotation,
    off_volume,
)
from robo47.verify.circle import CENTRE, LAP, circle, least_miss
from robo47.verify.ik import Ends, beyond, ends_of, miss, tries
from robo47.verify.oracle import (
    Worst,
    mujoco_acceleration,
    mujoco_bias,
    mujoco_inverse_dynamics,
    mujoco_mass_matrix,
    mujoco_poses,
    mujoco_push,
    mujoco_rotation,
    mujoco_screws,
    mujoco_site_bias,
    mujoco_site_jacobian,
    mujoco_step,
    random_q,
    verify_fk,
    worst_difference,
)

__all__ = [
    "CENTRE", "LAP", "Ends", "Worst", "beyond", "circle", "each", "ends_of",
    "in_the_hand", "least_miss", "miss", "mujoco_acceleration", "mujoco_bias",
    "mujoco_inverse_dynamics", "mujoco_mass_matrix", "mujoco_poses", "mujoco_push",
    "mujoco_rotation", "mujoco_screws", "mujoco_site_bias", "mujoco_site_jacobian",
    "mujoco_step",
    "off_adjoint", "off_cross", "off_goal", "off_least_squares", "off_library",
    "off_log", "off_motion", "off_null_vector", "off_rotation", "off_volume",
    "random_q", "tries", "verify_fk", "worst_difference",
]  # fmt: skip
