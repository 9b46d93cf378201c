"""Day 3's named mistakes, each made again on purpose, the more general first.

jacobians  space_jacobian           points  site_jacobian and body_jacobian
logs       log_rotation; angles says where it is wrong, if no mistake is named
errors     pose_error
steps      dls_step
measures   manipulability and null_step
loops      solve_ik, with right and wrong parts
"""
