"""The SE(3) inspector: the arm, its frames and the proof, in a browser.

    arm      the numbers shown: MuJoCo's pose, the one by hand, the steps of the chain
    shapes   what MuJoCo's model looks like, as triangle meshes
    scene    draws arm, triads and labels
    joints   the tab with a slider per joint
    chain    the tab that steps through the chain
    order    the tab that puts T_extra left or right
    words    numbers as HTML
    app      the page: puts these together and keeps them in step
    guard    who may talk to the page: this machine's own browsers, nobody else
    serve    listens until Ctrl-C

`arm` and `words` need nothing new, `shapes` needs trimesh, and all the rest viser,
which brings trimesh (the extra `view`). Meshes are drawn where MuJoCo puts the bodies,
the triads where `robo47.kinematics` puts the frames: a wrong product would show.
"""
