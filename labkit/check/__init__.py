"""Check a day: ask the student's functions, judge what came back, report.

    tasks          from a student's file to one verdict per task
    lab_run        the day's lab, run with a file's functions
    source         the file as text: the slips that it shows, code put below it
    states         how tasks stood when the file as it is was last checked
    report         how it all reads
    journal        keeps which mistakes were met
    own_functions  the student's functions, the library's where one fails

The student's code never judges itself: what comes back are arrays, and they are
compared here with MuJoCo's answers, by `labkit.judge`.
"""
