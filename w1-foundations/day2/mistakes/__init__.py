"""Day 2's named mistakes, each made again on purpose, the more general first.

moves     the formulas without checks, with parts that can be replaced by mistakes
turns     skew and exp_rotation         lines     screw_axis and joint_screws
motions   exp_screw                     frames    adjoint and body_screws
products  fk_space and fk_body          links, tables  dh_link and dh_fk
places    which single joint or row of a table is wrong
"""
