"""The door to the proofs: one page that leads to the page of each week.

A week's page carries its facts in a comment at its end, so the door says of each page
that stands beside it what it holds, and nothing is run again for it.
"""

import datetime
import json
import re
from collections.abc import Sequence
from html import escape
from pathlib import Path
from typing import Any

from labkit.base import html

PAGE = "proof-week{}.html"
_FACTS = re.compile(r"<!-- robo47 proof (\{[^\n]*\}) -->")


def with_facts(page: str, facts: dict[str, Any]) -> str:
    """Return a page with its facts at its end, where no reader sees them.

    Args:
        page: the whole HTML text.
        facts: what the door is to say of it; texts, numbers and truth values.
    """
    text = json.dumps(facts)
    for letter in "<>-":  # none of them may end the comment
        text = text.replace(letter, f"\\u{ord(letter):04x}")
    return f"{page}<!-- robo47 proof {text} -->\n"


def facts_in(path: Path) -> dict[str, Any]:
    """Return what a page carries; {} where it carries nothing that can be read."""
    try:
        found = _FACTS.findall(path.read_text("utf-8", errors="replace"))
        facts = json.loads(found[-1]) if found else {}
    except (OSError, ValueError, RecursionError):
        return {}
    return facts if isinstance(facts, dict) else {}


def pages_beside(folder: Path) -> list[tuple[Path, dict[str, Any]]]:
    """Return the pages of weeks in a folder with their facts, by number."""
    known = [(path, facts_in(path)) for path in folder.glob(PAGE.format("*"))]
    right = [(path, facts) for path, facts in known if type(facts.get("week")) is int]
    return sorted(right, key=lambda pair: pair[1]["week"])


def render(pages: Sequence[tuple[Path, dict[str, Any]]]) -> str:
    """Return the door.

    Args:
        pages: of weeks, in the order to show them.
    """
    name = str(pages[-1][1].get("name", "")) if pages else ""
    return html.page(
        escape(f"{name}: the proofs" if name else "The proofs"),
        f"A page a week; each was run when it says. {datetime.date.today()}",
        *(_card(path, facts) for path, facts in pages),
    )


def _card(path: Path, facts: dict[str, Any]) -> str:
    link = f'<a href="{escape(path.name)}">{escape(str(facts.get("heading", "")))}</a>'
    parts = (
        ("functions", "functions by the student"),
        ("numbers", "numbers, computed again"),
    )
    told = [f"{escape(str(facts[k]))} {what}" for k, what in parts if facts.get(k)]
    told += [escape(str(facts["capstone"]))] if facts.get("capstone") else []
    told += [f"made on: {escape(str(facts['date']))}"] if facts.get("date") else []
    return html.card(link, f"<p>{'; '.join(told)}</p>")
