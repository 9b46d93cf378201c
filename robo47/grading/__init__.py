"""Grade a class: a folder of clones in, a table, a page and words for each student out.

On the teacher's machine, the coordinator:

    classroom   one class and one day, from start to end
    roster      who is in the class, and in which folder
    pull        clone and update, where asked to
    collect     from a clone to the few files that a grade depends on, as bytes
    history     what git says of a clone, asked without trusting its configuration
    package     those bytes: what travels, and its fingerprint
    engine      packages in, results out: on this machine, or on a Dask cluster
    journal     every result, kept as it comes; nothing is graded twice
    similar     whose submissions are alike
    kit         which kit this is

Wherever grading happens, here or on a worker:

    grader      a process of its own for the checker, with a time limit
    child       what runs in that process
    grade       from a package to a result, by the instructor's kit
    result      what a grade consists of

What comes out:

    sheet       the table, one row per student
    feedback    a file for each of them
    overview    what the class stumbles over, and who is stuck
    page, bars  the same as one HTML page

Student code only ever runs in the checker's sandbox, and nothing of a student's clone
(its robo47/, week.toml, conftest.py, Makefile or git configuration) takes part.
"""
