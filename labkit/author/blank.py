"""An empty worksheet: what a day's manifest and lab ask for, to be filled in."""

import ast

from labkit.lesson.day import Day

HEAD = """\
# Day {number} worksheet

Write below each heading and replace the text in *(italics)*. `make check DAY={number}`
reports what is still open.
"""
GLOSSARY = """\
## Glossary

Explain each term, or the difference between two terms, in one or two sentences of your
own. Text copied from the lab guide is not accepted.
"""
DRAWINGS = """\
## Drawings

A photo of a paper drawing is enough: `![the arm](../figures/day{number}_drawing1.jpg)`.
You can also draw in text, with at least three lines between two lines of three
backquotes.
"""
PREDICTIONS = """\
## Predictions

Fill in the first column before you run the lab. `make run` hides a measured number
until you have predicted it, writes it next to your prediction and changes nothing else.
The last column is yours: explain the difference, or why your prediction was right.

| number | predicted | measured | why different |
|---|---|---|---|
"""
PREDICTION = "| {} | *(your prediction)* | *(your number)* | *(your reason)* |\n"


def worksheet_of(day: Day) -> str:
    """Return an empty worksheet: its terms, drawings, predictions and questions."""
    parts = [HEAD.format(number=day.number)]
    parts += [GLOSSARY] * bool(day.terms)
    parts += [f"### {term}\n\n*(your words)*\n" for term in day.terms]
    parts += [DRAWINGS.format(number=day.number)] * (day.drawings > 0)
    drawn = "### Drawing {}: what it shows\n\n*(your drawing)*\n"
    parts += [drawn.format(i + 1) for i in range(day.drawings)]
    parts.append(PREDICTIONS + "".join(map(PREDICTION.format, measured_in(day))))
    parts.append("## Can you explain?\n")
    asked = "{}. What do you want to ask?\n\n   *(your answer)*\n"
    parts += [asked.format(i + 1) for i in range(day.questions)]
    return "\n".join(parts)


def measured_in(day: Day) -> list[str]:
    """Return the numbers that a day's lab measures, as it names them."""
    try:
        tree = ast.parse(day.source.read_bytes())
    except (OSError, SyntaxError):
        return []
    calls = (node for node in ast.walk(tree) if isinstance(node, ast.Call))
    names = (
        call.args[0].value
        for call in calls
        if getattr(call.func, "attr", "") == "measured"
        and call.args
        and isinstance(call.args[0], ast.Constant)
    )
    return list(dict.fromkeys(map(str, names)))
