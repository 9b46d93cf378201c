"""Check a day: ask the student's functions, judge what came back, report.

    tasks          from a student's file to one verdict per task
    lab_run        the day's lab, run with a file's functions
    memory         how tasks stood when last checked, which mistakes were met
    report         how it all reads
    own_functions  the student's functions, the library's where one fails

The student's code never judges itself: what comes back are arrays, and they are
compared here with MuJoCo's answers, by `labkit.judge`.
"""
