"""Check a day: run the student's code where it can do no harm, and say what it shows.

    sandbox       runs the student's file in processes of its own
    process       one of them, from its start to its end
    replies       what is asked, and what comes back: plain arrays
    inside/       what runs in there: the runner, its answers, imports, fakes and fences
    wall          which of bubblewrap, Landlock or nothing keeps it from this machine
    bubblewrap    the command for the first of these
    resources     memory and processes of the sandbox, per platform
    model_copy    the Panda as plain data, for the sandbox's fake of MjModel
    variant       fresh angles and a longer arm: computed, looked up or typed in?
    tasks         from a student's file to one verdict per task
    deliverables  figure, worksheet, metrics rows, commit
    report        how it all reads

The student's code never judges itself: what comes back are arrays, and they are
compared here with MuJoCo's answers, by `robo47.diagnose`.
"""
