"""What is mended in built pages: names for who does not see, fewer bytes for all."""

import re
from pathlib import Path

# The theme calls the captions of its margin headings, and not of which level.
_CAPTION = re.compile(r'<p class="caption" role="heading">')
_LEVEL = '<p class="caption" role="heading" aria-level="2">'
# A worksheet's box has its words beside it, and not as its label.
_BOX = re.compile(
    r'(<input class="task-list-item-checkbox"[^>]*>)(.*?)(?=</p>|</li>|\n<ul)',
    re.DOTALL,
)
# viser's player in a film: the parts without a name, and theirs.
_NAMELESS = {
    ".mantine-NumberInput-input": "time in seconds",
    ".mantine-Select-input": "speed",
    ".mantine-Notification-closeButton": "close",
    "button:has(.tabler-icon-player-pause-filled)": "pause",
    "button:has(.tabler-icon-player-play-filled)": "play",
    "[role=slider]": "time",
}
_NAMER = """<script>
new MutationObserver(() => {
  for (const [part, name] of Object.entries(NAMES))
    for (const one of document.querySelectorAll(part))
      one.setAttribute("aria-label", name);
}).observe(document, { childList: true, subtree: true });
</script>"""


def mend(site: Path, films: str) -> None:
    """Give names to parts of built pages, in place.

    Args:
        site: the folder of the site.
        films: the name of the folder that holds films, which are left as they are.
    """
    for path in site.rglob("*.html"):
        if films not in path.relative_to(site).parts:
            path.write_text(page(path.read_text("utf-8")), "utf-8", newline="\n")


def page(text: str) -> str:
    """Return a page of the theme as it should be.

    Captions have a level, boxes a label; pictures after the first are fetched when the
    page is scrolled near them.
    """
    text = _BOX.sub(r"<label>\1\2</label>", _CAPTION.sub(_LEVEL, text))
    before, first, after = text.partition("<img ")
    return before + first + after.replace("<img ", '<img loading="lazy" ')


def film(text: str) -> str:
    """Return a film's page whose controls have names."""
    return text.replace(
        "</head>", _NAMER.replace("NAMES", str(_NAMELESS)) + "</head>", 1
    )
