"""The site's home: an arm that answers to a typed mistake, then a card for each day.

The first paragraph is README's own, and the cards read the days' manifests, so no text
is written twice.
"""

import re

from labkit.lesson.day import Day, days_of
from labkit.lesson.week import Week, weeks

FIRST = re.compile(r"\A# [^\n]+\n\n(.+?)\n\n", re.DOTALL)  # README's first paragraph
SMALL = "figures/day{}_small.png"  # of a week's folder
PAGE = """\
---
hide-toc: true
---
# Robotics by hand, in Python

{intro}

**[Try it now, nothing to install](arm.md)**, or
[start Day 1 on your computer](README.md).

```{{raw}} html
<figure class="live" data-figure="mistake"></figure>
```

The checker compares your function with the correct one and with known mistakes, and
names the mistake that you made. [The arm's own page](arm.md) has more mistakes, all
seven joints, and MuJoCo for comparison.

{weeks}
"""
WEEK = """\
## [{heading}]({page})

`````{{container}} cards
{cards}
`````
"""
CARD = """\
````{{container}} card
![A picture of day {number}]({picture})

```{{container}} number
{number}
```

[{title}]({guide})

```{{container}} method
{method}
```

{result}
````
"""


def page(readme: str) -> str:
    """Return the home page in Markdown.

    Args:
        readme: the text of the repository's README.
    """
    found = FIRST.search(readme)
    assert found, "README begins with a title and a paragraph"
    return PAGE.format(intro=found[1], weeks="\n".join(map(_week, weeks())))


def _week(week: Week) -> str:
    folder = week.folder.name
    cards = [_card(day) for day in days_of(week)]
    return WEEK.format(
        heading=week.heading, page=f"{folder}/README.md", cards="\n".join(cards)
    )


def _card(day: Day) -> str:
    """Return a day's card: picture, number, title, method and one line."""
    return CARD.format(
        number=day.number,
        title=day.title,
        method=_sentence(day.method),
        result=f"{_sentence(day.result)}.",
        guide=f"{day.folder.name}/{day.guide}",
        picture=f"{day.folder.name}/{SMALL.format(day.number)}",
    )


def _sentence(words: str) -> str:
    return words[:1].upper() + words[1:]
