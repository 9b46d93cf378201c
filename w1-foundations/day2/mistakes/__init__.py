"""Day 2's named mistakes, each made again on purpose, the more general first.

moves     the formulas without checks, with parts that can be replaced by mistakes
brackets  skew                          turns     exp_rotation
lines     screw_axis and joint_screws   halves    omega and v of a table of screws
motions   exp_screw; travels            frames    adjoint and body_screws
products  fk_space and fk_body; angles  links, tables  dh_link and dh_fk
places    which single joint or row of a table is wrong
"""
