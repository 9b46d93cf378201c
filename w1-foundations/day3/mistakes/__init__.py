"""Day 3's named mistakes, each made again on purpose, the more general first.

jacobians  space_jacobian           points  site_jacobian and body_jacobian
errors     log_rotation, pose_error
steps      dls_step, manipulability and null_step
loops      solve_ik, with right and wrong parts
"""
