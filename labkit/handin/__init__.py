"""A day's deliverables beside its code. Read here, never edited.

    deliverables  all of them, in order; all of it in git
    handin        which files, read without trusting the folder
    figure        the student's picture
    worksheet     definitions, answers, drawings
    rows          the numbers in the metrics log

Each check returns an `Item`: how it stands, and what to do about it.
"""
