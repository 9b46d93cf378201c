"""Which mistake is it? From a student's answers to the one that was made.

    exchange    a question and its reply
    ask         a function's row: inputs, truth, kind of answer, mistakes; its questions
    kinds       what kind of thing an answer is, which decides the words
                (matrix_kinds: Jacobians and others; rigid_kinds: rotations, poses)
    draw        inputs for questions
    problems    did an answer come back, of the right shape and type? If not, the words
    mistake     a mistake that has a name, and the same mistake made on purpose
    finished    mistakes made with a finished rotation or pose
    near_miss   right in method, not in all digits
    judge       from questions with their replies to a verdict and its name
    chain       where along a serial chain a product goes wrong

The student's code is never run here, and nothing it computed is used as the truth.
What is special about a day stands in the day's own folder.
"""

from labkit.judge.ask import Ask, Case, HeldOut, Probe, Robot, Slip
from labkit.judge.kinds import Points, Scalar, Twist, Vector, Wrench
from labkit.judge.matrix_kinds import Jacobian, Matrix, Symmetric
from labkit.judge.mistake import Finding, Mistake, Verdict
from labkit.judge.rigid_kinds import Pose, Rotation

__all__ = [
    "Ask",
    "Case",
    "Finding",
    "HeldOut",
    "Jacobian",
    "Matrix",
    "Mistake",
    "Points",
    "Pose",
    "Probe",
    "Robot",
    "Rotation",
    "Scalar",
    "Slip",
    "Symmetric",
    "Twist",
    "Vector",
    "Verdict",
    "Wrench",
]
