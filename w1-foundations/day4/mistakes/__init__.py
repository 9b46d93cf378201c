"""Day 4's named mistakes, each made again on purpose, the more general first.

bodies   spatial_inertia          links     link_inertias
mass     mass_matrix              gravity   gravity_torque
brackets ad                       forces    inverse_dynamics
bias     bias_torque              forward   forward_dynamics
energy   energy                   passes    the algorithm whose parts forces replaces
"""
