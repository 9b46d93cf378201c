"""Text that a stranger wrote, made safe to show: in a terminal, a file, a table."""

import re

# Controls (C0, C1), line breaks, what turns the direction of writing, what has no
# width, and surrogates that stand alone, which no UTF-8 file holds.
_HIDDEN = re.compile(
    "[\0-\x1f\x7f-\x9f\xad\u061c\u115f\u180e\u200b\u200e\u200f\u2028-\u202e"
    "\u2060-\u206f\ufeff\ufff9-\ufffb\ud800-\udfff]+"
)


def visible(text: object, most: int = 500) -> str:
    """Return a text on one line that shows all it holds, and no more than it holds.

    Args:
        text: anything; `str` of it is taken.
        most: characters; a longer one ends in three dots.
    """
    try:
        whole = str(text)
    except Exception:  # a stranger's class
        whole = "(a text that cannot be shown)"
    line = _HIDDEN.sub(" ", whole[: most + 1]).strip()
    return line if len(whole) <= most else f"{line[: most - 3].rstrip()}..."
