"""Day 1's named mistakes, each made again on purpose, the more general first.

rotations  Rz and quat_to_R           poses  make_T and inverse
factors    link_T and joint_T         order  predict_order
arm        the Panda's product in factors
products   compose_fk and link4_to_world; ends: chains that end somewhere else
places     which single link or joint, or from which on
"""
