"""Check a day: run the student's code where it can do no harm, and say what it shows.

    sandbox       runs the student's file in processes of its own
    process       one of them, from its start to its end
    replies       what is asked, and what comes back: plain arrays
    inside/       what runs in there: limits, guard, landlock, stand-ins, the runner
    resources     memory and processes of the sandbox, per platform
    model_copy    the Panda as plain data, for the sandbox's stand-in of MjModel
    variant       fresh angles and a longer arm: computed, looked up or typed in?
    tasks         from a student's file to one verdict per task
    deliverables  figure, worksheet, metrics rows, commit
    report        how it all reads

The student's code never judges itself: what comes back are arrays, and they are
compared here with MuJoCo's answers, by `robo47.diagnose`.
"""
