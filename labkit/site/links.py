"""Links of built pages: every file and every anchor must be there."""

from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class _Page(HTMLParser):
    """The links and the anchors of a page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.links: list[tuple[str, str]] = []
        self.anchors = {"", "top"}
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Keep what a tag leads to, and what leads to it."""
        for name, value in attrs:
            if name in ("href", "src") and value:
                self.links.append((tag, value))
            elif name == "id" and value:
                self.anchors.add(value)


def faults(site: Path) -> list[str]:
    """Return links of a built site that lead nowhere, or fetch from another host."""
    found = {path: _Page(path.read_text("utf-8")) for path in site.rglob("*.html")}
    wrong = []
    for path, page in sorted(found.items()):
        for tag, link in page.links:
            if says := _fault(path, tag, link, found):
                wrong.append(f"{path.relative_to(site)}: {link}: {says}")
    return wrong


def _fault(path: Path, tag: str, link: str, found: dict[Path, _Page]) -> str:
    parts = urlsplit(link)
    if parts.scheme or parts.netloc:
        loads = tag != "a" and parts.scheme != "data"
        return "comes from another host" if loads else ""
    target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
    if not target.is_file():
        return "no such file"
    page = found.get(target)
    missing = page and unquote(parts.fragment) not in page.anchors
    return f"no anchor #{parts.fragment}" if missing else ""
