"""Which mistake is it? From a student's answers to the one that was made.

    questions = calls("1.4")                  # arguments, seeded
    answers = [...]                           # what the student's function returned
    verdict = judge("1.4", answers)           # passed, close, wrong or todo, and why

The student's code is never run here, and nothing it computed is used as the truth.
"""

from robo47.diagnose.cases import calls
from robo47.diagnose.judging import judge
from robo47.diagnose.verdict import MODEL, TASK_FUNCTIONS, Answer, Call, Verdict

__all__ = ["MODEL", "TASK_FUNCTIONS", "Answer", "Call", "Verdict", "calls", "judge"]
