"""Day 7's named mistakes, each made again on purpose, the more general first.

scalings  quintic_scaling          durations  quintic_duration
moves     joint_move               splines    quintic_coefficients
lines     straight_pose            grasps     grasp_pose
loads     carry                    ramps      trapezoid
cubes     heaviest_cube            turns      straight_pose, half turns and small ones
"""
