"""The judge: from a student's answers to the mistake that was made.

    row         a function as a day's author writes it down: a file of decorated
                functions, each a mistake or another way that is right
    ask         the same for the judge; the questions made of it
    draw        what inputs are drawn from
    fits        how many questions a task has time for
    results     what a function returns, result by result, as its row says
    written     what does not fit in a row, told to its author
    kinds       what kind of thing an answer is, which decides the words
                (matrix_kinds: Jacobians, covariances; other_kinds: twists, points,
                counts, indices, words, yes or no, paths, pixels)
    replies_read    did an answer come back, of the right shape and type? If not, the
                words
    guard       what a search that stops costs: the name alone
    failing_call    the call that failed, as a student can type it
    typed       calls and values as they are typed
    answers     made by a function; how far two sets of them are apart; in words
    mistake     a mistake that has a name, and the verdict that says so
    answer_mistakes      mistakes made with a finished answer
    argument_mistakes    mistakes made with an argument before it is used
    near_miss   right in method, not in all digits
    judge       from questions with their replies to a verdict and its name
    valid       answers that differ from the reference, and are right or of a method
    odd_answers a mistake that stops, or changes its shape, at some questions
    cases       in which of its row's cases a wrong function is right
    resized     the calls of a case with other sizes, which can only contradict
    carried     the same with arguments of calls that were answered wrongly
    merged      adjacent ranges of a list of cases, told as one
    unusual     what is said of a function that is right at ordinary inputs alone
    right_when  with which argument neutral a wrong function is right
    repair      which one change of a student's own text makes it right
    crossed     calls whose arguments are mixed, at their ends and between them
    chain       where along a serial chain a product goes wrong
    matrices    moves of matrices that need not be poses

The student's code is never run here, and nothing it computed is used as the truth.
What is special about a day stands in the day's own folder.
"""

from labkit.judge.ask import Ask, Case, HeldOut, Robot, Slip
from labkit.judge.draw import Draw, rounded
from labkit.judge.kinds import Scalar, Vector
from labkit.judge.matrix_kinds import Covariance, Jacobian, Matrix, Symmetric
from labkit.judge.mistake import Finding, Mistake, Verdict
from labkit.judge.other_kinds import (
    Count,
    Index,
    Mask,
    Pixels,
    Points,
    Twist,
    Waypoints,
    Word,
    Wrench,
)
from labkit.judge.rigid_kinds import Pose, Rotation
from labkit.judge.row import Row
