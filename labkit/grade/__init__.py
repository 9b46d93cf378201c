"""Grade a class: a folder of clones in, a table, a page and words for each student out.

On the teacher's machine, the coordinator:

    classroom   one class, from start to end, for a day
    roster      who is in the class, in which folder, and their files' names
    pull        clone and update, where asked to
    package     from a clone to what travels: a few files as bytes, and its fingerprint
    engine      packages in, results out: on this machine, or on a Dask cluster
    journal     every result, kept as it comes; nothing is graded twice
    similar     whose submissions are alike

Wherever grading happens, here or on a worker:

    child       a process of its own for the checker: from a package to a result
    result      what a grade consists of

What comes out:

    course      everybody's grades for a day, and the mistakes that they share
    sheet       the tables, one row per student, as Canvas and Moodle import them, too
    page        a day, or several, as one HTML page, with charts

Student code only ever runs in the checker's sandbox, and nothing of a student's clone
(its robo47/, manifests, conftest.py, Makefile or git configuration) takes part. What a
machine does wrong (a full disk, a process that was killed, a limit under load) is never
a student's result: it is counted apart and tried again at the next run.
"""
