"""How far a reader follows a command through the kit: its files, and its switches.

    python tests/switches.py scripts/check_day.py --task 1.4 --file FILE

A switch is a call into a function of another file than the last call. What is called
while a file is imported does not count.
"""

import runpy
import sys
from collections import Counter
from itertools import pairwise
from pathlib import Path

ROOT = str(Path(__file__).parents[1])
OWN = ("robo47", "labkit", "scripts", "w")  # what the folders' names begin with
route = []  # files by their paths from the top; each differs from the one before


def ours(file):
    top, _, rest = file.removeprefix(f"{ROOT}/").partition("/")
    return file.startswith(ROOT) and bool(rest) and top.startswith(OWN)


def imported(frame):
    while frame:
        code, frame = frame.f_code, frame.f_back
        if code.co_name == "<module>" and ours(code.co_filename):
            return code.co_filename != sys.argv[0]
    return False


def follow(frame, event, _):
    code = frame.f_code
    body = code.co_name == "<module>" or "__module__" in frame.f_locals  # or a class's
    if event == "call" and not body and ours(code.co_filename):
        file = code.co_filename.removeprefix(f"{ROOT}/")
        if (not route or file != route[-1]) and not imported(frame):
            route.append(file)


if __name__ == "__main__":
    sys.argv[:] = [str(Path(sys.argv[1]).resolve()), *sys.argv[2:]]
    sys.path.insert(0, str(Path(sys.argv[0]).parent))
    sys.setprofile(follow)
    try:
        runpy.run_path(sys.argv[0], run_name="__main__")
    finally:
        sys.setprofile(None)
        for (one, other), count in Counter(pairwise(route)).most_common(40):
            print(f"{count:4} {one} -> {other}", file=sys.stderr)
        print(*sorted(set(route)), sep="\n", file=sys.stderr)
        print(f"{len(set(route))} files, {len(route)} switches", file=sys.stderr)
