"""`make update`: a clone on the kit's newest commit, with all that is the student's.

    merge    the commits, in a worktree of their own
    labs     the student's labs, by the newer kit's own code; what is new in a day

Nothing of the clone changes before all of it is done, and then in one step of git's.
"""
