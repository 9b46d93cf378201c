"""Rows of toys, which stand in no file, and what a function is told by them."""

from judged import round_of

from labkit.base.exchange import Reply
from labkit.judge import Row
from labkit.judge.judge import judge
from labkit.sandbox.inside import wire


def row_of(kind, truth, inputs, **more):
    """Return a toy row of its own, which stands in no file."""
    row = Row(kind, truth=truth, **more)
    row.inputs(inputs)
    return row


def told(row, function, names=("x", "y", "z")):
    """Return the verdict on a function; its answers travel as those of students do."""
    asked = round_of(row.ask)
    for one in asked.exchanges:
        try:
            value = function(*one.question.args)
            value = wire.unpack_value(wire.pack_value(value))
            one.reply = Reply(value=value, again=value)
        except ArithmeticError as error:
            one.reply = Reply(kind=type(error).__name__, error=str(error), line=3)
    return judge(asked, names=names[: len(asked.main[0].question.args)])


def explained(verdict, word):
    """Return the lines of --explain that begin with a word."""
    return [line for line in verdict.measured if line.startswith(f"{word}: ")]
