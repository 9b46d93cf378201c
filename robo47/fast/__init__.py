"""The fast layer of the library: the same formulas for many configurations at once.

    moves         elementary motions of a frame
    chains        products of frames or exponentials, for many q or for one, in floats
    jacobians     Jacobian columns for many q
    ik            inverse kinematics: who walks to which target, and from where
    walk          the walk: damped steps within the limits, until nothing is gained
    ik_many       its arithmetic for many at once;  ik_one: for one, in plain floats
    vectors       vectors as three arrays
    dynamics      mass matrix and torque for many q
    arm_state     all that a control loop asks for at one q

Read the formulas in `robo47.kinematics`, `jacobian` and `dynamics` first; nothing here
is another truth. Labs do without it, but for one that compares the two.
"""
