"""Tags in the head of a page about its card, for sites that show a link as a card."""

from collections.abc import Mapping
from html import escape
from typing import Any

SIZE = (1200, 630)  # pixels, as sites show a card


def meta(name: str, facts: Mapping[str, Any]) -> str:
    """Return what a page's head says of its card, which is a file beside it."""
    told = [f"{facts['functions']} functions", f"{facts['numbers']} numbers, run again"]
    told += [str(facts["capstone"])] if facts["capstone"] else []
    words = {
        "og:type": "website",
        "og:title": ": ".join(filter(None, (facts["name"], facts["heading"]))),
        "og:description": "; ".join(told),
        "og:image": name,
        "og:image:width": str(SIZE[0]),
        "og:image:height": str(SIZE[1]),
        "og:image:alt": "The arm, and these numbers.",
    }
    tags = [f'<meta property="{k}" content="{escape(v)}">' for k, v in words.items()]
    return "".join([*tags, '<meta name="twitter:card" content="summary_large_image">'])
