"""What is mended in built pages: names for who does not see, fewer bytes for all,
and charts that are dark on a dark page.
"""

import re
from collections.abc import Collection
from pathlib import Path

from PIL import Image

# The theme calls the captions of its margin headings, and not of which level.
_CAPTION = re.compile(r'<p class="caption" role="heading">')
_LEVEL = '<p class="caption" role="heading" aria-level="2">'
# A worksheet's box has its words beside it, and not as its label.
_BOX = re.compile(
    r'(<input class="task-list-item-checkbox"[^>]*>)(.*?)(?=</p>|</li>|\n<ul)',
    re.DOTALL,
)
# A picture that has another one for narrow screens; Sphinx takes one.
_PICTURE = re.compile(r'<img [^>]*src="((?:\.\./)*)_images/(\w+)\.\w+"[^>]*>')
TALL = "_tall"  # the end of the name of a tall picture
# A chart, black on white: style.css turns it round on a dark page. Pictures with an arm
# are dark themselves, and stand on either.
_CHART = re.compile(r'<img (?=[^>]*src="(?:\.\./)*_images/([\w.-]+)")')
_WHITE = (255, 255, 255)
# Where a name may be broken, so that it is broken nowhere else.
_CODE = re.compile(r'(?<=<span class="pre">)[^<]+(?=</span>)')
_JOINT = re.compile(r"(?<=\w[_/])(?=\w)")
# A line may end on either side of a formula: what belongs to it would stand alone.
_FORMULA = re.compile(
    r'([(“]*)(<math (?![^>]*display="block")[^>]*>.*?</math>)([.,;:!?)”’]*)', re.DOTALL
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
    tall = [path.name for path in (site / "_static").glob(f"*{TALL}.*")]
    charts = {path.name for path in (site / "_images").glob("*.png") if on_white(path)}
    for path in site.rglob("*.html"):
        if films not in path.relative_to(site).parts:
            made = page(path.read_text("utf-8"), tall, charts)
            path.write_text(made, "utf-8", newline="\n")


def on_white(path: Path) -> bool:
    """Return whether a picture is white in its four corners: a chart."""
    with Image.open(path) as opened:
        picture = opened.convert("RGB")
    right, low = (n - 1 for n in picture.size)
    corners = ((0, 0), (right, 0), (0, low), (right, low))
    return all(picture.getpixel(corner) == _WHITE for corner in corners)


def page(text: str, tall: Collection[str] = (), charts: Collection[str] = ()) -> str:
    """Return a page of the theme as it should be.

    Captions have a level, boxes a label; pictures after the first are fetched when the
    page is scrolled near them, and on a narrow screen its own where there is one; a
    chart is of the class `chart`, and no line ends between a formula and its comma.
    A long name in a table's code is broken at its underscores and slashes.

    Args:
        text: the page.
        tall: names of pictures for narrow screens, among the static files.
        charts: names of those that are charts.
    """
    narrow = {name.rpartition(TALL)[0]: name for name in tall}

    def both(found: re.Match[str]) -> str:
        if found[2] not in narrow:
            return found[0]
        source = f'media="(max-width: 600px)" srcset="{found[1]}_static/'
        return f'<picture><source {source}{narrow[found[2]]}">{found[0]}</picture>'

    def marked(found: re.Match[str]) -> str:
        return '<img class="chart" ' if found[1] in charts else found[0]

    def together(found: re.Match[str]) -> str:
        alone = not found[1] and not found[3]
        return found[0] if alone else f'<span class="kept">{found[0]}</span>'

    text = _CHART.sub(marked, _PICTURE.sub(both, text))
    text = _CODE.sub(lambda code: _JOINT.sub("<wbr>", code[0]), text)
    text = _FORMULA.sub(together, text)
    text = _BOX.sub(r"<label>\1\2</label>", _CAPTION.sub(_LEVEL, text))
    before, first, after = text.partition("<img ")
    return before + first + after.replace("<img ", '<img loading="lazy" ')


def film(text: str) -> str:
    """Return a film's page whose controls have names."""
    return text.replace(
        "</head>", _NAMER.replace("NAMES", str(_NAMELESS)) + "</head>", 1
    )
