"""An empty worksheet: what a day's manifest asks for, to be filled in."""

from labkit.lesson.day import Day

HEAD = """\
# Day {number} worksheet

Write below each heading; what is in *(italics)* is yours to replace. `make check
DAY={number}` looks at what you have so far.
"""
PREDICTIONS = """\
## Predictions

Write the first column before you run anything: `make run` then writes what it measures
beside it, and leaves what you wrote alone. The last column is yours; if your prediction
was right, say why it could be.

| number | predicted | measured | why apart |
|---|---|---|---|
"""
PREDICTION = "| {} | *(your prediction)* | *(your number)* | *(your reason)* |\n"


def worksheet_of(day: Day) -> str:
    """Return an empty worksheet: its terms, drawings, numbers, questions, checklist."""
    parts = [HEAD.format(number=day.number), "## Glossary\n"]
    parts += [f"### {term}\n\n*(your words)*\n" for term in day.terms]
    parts += ["## Drawings\n"] * (day.drawings > 0)
    drawn = "### Drawing {}: what it shows\n\n*(your drawing)*\n"
    parts += [drawn.format(i + 1) for i in range(day.drawings)]
    checks = dict.fromkeys(metric.check for metric in day.metrics)
    parts.append(PREDICTIONS + "".join(map(PREDICTION.format, checks)))
    parts.append("## Can you explain?\n")
    asked = "{}. What do you want to ask?\n\n   *(your answer)*\n"
    parts += [asked.format(i + 1) for i in range(day.questions)]
    boxes = [f"I ran `make run DAY={day.number}` and saw `All checks PASSED.`"]
    boxes.append(f"All tasks of `make check DAY={day.number}` pass")
    boxes += [f"My picture is `{day.files['figure']}`"] if day.figure else []
    boxes.append("The words above are mine")
    boxes += ["`metrics/metrics.csv` has my rows for the day"] if day.metrics else []
    lines = "".join(f"- [ ] {box}\n" for box in [*boxes, "I committed all of it"])
    return "\n".join([*parts, f"## Checklist\n\n{lines}"])
