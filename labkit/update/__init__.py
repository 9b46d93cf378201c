"""`make update`: a clone on the kit's newest commit, with all that is the student's.

    git        what is asked of git; the worktree beside the clone
    merge      the commits, in that worktree
    labs       the student's labs, by the newer kit's own code; what is new in a day
    last_step  the clone becomes what the worktree is, or stays as it was

Nothing of the clone changes before all of it is done. The last step can be interrupted
anywhere: the next run puts back what had moved, and begins anew.
"""
