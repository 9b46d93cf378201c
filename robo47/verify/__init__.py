"""MuJoCo as the oracle: what the simulator itself says of poses, forces and motion.

Nothing here composes a transform or a torque; this is what they are judged against.
Units: metres, radians, seconds, kilograms.
"""

from robo47.verify.answers import each
from robo47.verify.oracle import (
    Worst,
    mujoco_acceleration,
    mujoco_bias,
    mujoco_bias_acceleration,
    mujoco_external_torque,
    mujoco_inverse_dynamics,
    mujoco_mass_matrix,
    mujoco_poses,
    mujoco_rotation,
    mujoco_screws,
    mujoco_site_jacobian,
    mujoco_step,
    random_q,
    verify_fk,
    worst_difference,
)

__all__ = [
    "Worst",
    "each",
    "mujoco_acceleration",
    "mujoco_bias",
    "mujoco_bias_acceleration",
    "mujoco_external_torque",
    "mujoco_inverse_dynamics",
    "mujoco_mass_matrix",
    "mujoco_poses",
    "mujoco_rotation",
    "mujoco_screws",
    "mujoco_site_jacobian",
    "mujoco_step",
    "random_q",
    "verify_fk",
    "worst_difference",
]  # fmt: skip
