"""Check a day: run the student's code where it can do no harm, and say what it shows.

    source        the script and the files beside it, as they travel
    library       what of the kit they may import: what earlier days brought
    sandbox       runs the student's file in processes of its own
    session       the same, loaded once and asked again and again
    process       one of them, from its start to its end; whose fault the end is
    replies       what is asked, and what comes back: plain arrays
    inside/       what runs in there: the runner, its answers, imports, fakes and fences
    wall          which of bubblewrap, Landlock or nothing keeps it from this machine
    bubblewrap    the command for the first of these
    resources     memory, time and end of a process, per platform
    model_copy    the Panda as plain data, for the sandbox's fake of MjModel
    tasks         from a student's file to one verdict per task
    verdicts      what never was an answer; slips that show in the text
    deliverables  figure, worksheet, metrics rows, commit
    report        how it all reads; journal keeps which mistakes were met

The student's code never judges itself: what comes back are arrays, and they are
compared here with MuJoCo's answers, by `labkit.judge`.
"""
