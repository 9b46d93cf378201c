"""The catalogue: what each of these students' files is told, against what it must be.

    python tests/submissions/catalogue.py              the table and the totals
    python tests/submissions/catalogue.py fk_hand      with messages, names like this

Each file opens with `# task 1.4: SLUG` (or `# tasks 1.1 1.3: passed`) and, below it,
what the student did. Files are run in this process: they are ours. The checker runs a
real student's file in a sandbox instead.
"""

import contextlib
import io
import re
import sys
import textwrap
import traceback
from pathlib import Path
from typing import Any, NamedTuple

import mujoco
import numpy as np

from robo47 import panda
from robo47.diagnose import MODEL, Answer, Call, Verdict, calls, judge

FOLDER = Path(__file__).resolve().parent
_HEADER = re.compile(r"# tasks? ((?:\d\.\d )*\d\.\d): ([a-z0-9A-Z+-]+)\n# (.+)\n")


class Submission(NamedTuple):
    """One file and one of its tasks.

    Attributes:
        path: the file; the folder says whether it is right, close or wrong.
        task: "1.4".
        expected: the mistake's name, or "passed".
        about: what the student did.
    """

    path: Path
    task: str
    expected: str
    about: str

    @property
    def name(self) -> str:
        """Return "wrong/quat_xyzw 1.4"."""
        return f"{self.path.parent.name}/{self.path.stem} {self.task}"


def submissions(*folders: str) -> list[Submission]:
    """Return every file and task in the folders "right", "close" and "wrong"."""
    found = []
    for folder in folders:
        for path in sorted((FOLDER / folder).glob("*.py")):
            header = _HEADER.match(path.read_text(encoding="utf-8"))
            if header is None:
                raise ValueError(f"{path} does not say its task and mistake on top")
            tasks, expected, about = header.groups()
            found += [Submission(path, t, expected, about) for t in tasks.split()]
    return found


def verdict_of(submission: Submission, model: mujoco.MjModel) -> Verdict:
    """Run the submission's functions for its task and judge what they answer."""
    file: dict[str, Any] = {"__name__": submission.path.stem}
    source = submission.path.read_text(encoding="utf-8")
    exec(compile(source, submission.path.name, "exec"), file)
    with contextlib.redirect_stdout(io.StringIO()):
        answers = [_answer(file, call, model) for call in calls(submission.task)]
    return judge(submission.task, answers)


def _answer(file: dict[str, Any], call: Call, model: mujoco.MjModel) -> Answer:
    args = [
        model if isinstance(arg, str) and arg == MODEL else arg for arg in call.args
    ]
    try:
        with np.errstate(all="ignore"):
            value = file[call.function](*args)
    except Exception as error:
        line = traceback.extract_tb(error.__traceback__)[-1].lineno
        return Answer(None, f"{type(error).__name__}: {error} (line {line})")
    if isinstance(value, list):
        value = np.array(value)
    return Answer(value)


def main() -> int:
    """Print the table; return 1 if any file is not told what it must be."""
    wanted = sys.argv[1] if len(sys.argv) > 1 else ""
    model, wrong = panda.load("panda_nohand"), 0
    for folder in ("wrong", "close", "right"):
        rows = [s for s in submissions(folder) if wanted in s.name]
        verdicts = [verdict_of(s, model) for s in rows]
        named = 0
        for s, verdict in zip(rows, verdicts, strict=True):
            told = verdict.mistake or verdict.status
            named += told == s.expected
            mark = "" if told == s.expected else f"   <- {s.expected}"
            print(f"{s.name:42} {told}{mark}")
            if wanted:
                for line in (verdict.message, *verdict.measured):
                    print(textwrap.indent(textwrap.fill(line, 74), "    "))
        caught = sum(v.status != "passed" for v in verdicts)
        print(
            f"{folder}: {len(rows)} judged, {caught} not passed, {named} told right\n"
        )
        wrong += len(rows) - named
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
