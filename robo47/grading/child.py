"""The grader's process: packages come in on standard input, results go out as JSON.

Run as `python -m robo47.grading.child FOLDER`, where FOLDER is its own and goes with
it. A process of its own, so that a file that crashes the checker or keeps it busy for
ever costs one student's grade and not the whole class's.
"""

import json
import os
import pickle
import shutil
import sys

from robo47.grading.grade import grade
from robo47.grading.result import ungraded
from robo47.lesson.day import find_day


def main() -> None:
    """Grade until standard input ends."""
    folder = sys.argv[1]
    out = os.fdopen(os.dup(1), "wb")
    null = os.open(os.devnull, os.O_WRONLY)
    os.dup2(null, 1)  # libraries may print
    while True:
        try:
            package = pickle.load(sys.stdin.buffer)  # from our own parent
        except EOFError:
            break
        day = find_day(package.day)
        try:
            result = grade(package, day)
        except Exception as error:  # a hole in the checker costs one grade
            why = f"the checker stopped with {type(error).__name__}: {error}"
            result = ungraded(day, why)
        out.write(json.dumps(result.to_json()).encode("ascii") + b"\n")
        out.flush()
    shutil.rmtree(folder, ignore_errors=True)  # the parent may be gone


if __name__ == "__main__":
    main()
