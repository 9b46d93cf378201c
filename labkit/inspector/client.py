"""Our part of the page: a style sheet and a script, put into viser's page.

viser draws the scene and the widgets and carries HTML to the browser. `client.js` adds
what it lacks: tabs that the server opens, the pose in the address, buttons that copy.
"""

from functools import cache
from pathlib import Path

from robo47.errors import Robo47Error

HERE = Path(__file__).parent
TITLE = "robo47 inspector"


def with_client(page: bytes, first: str) -> bytes:
    """Return viser's page with our style and script at its head.

    Args:
        page: viser's `index.html`.
        first: HTML that stands there until viser has drawn something: seconds later.

    Raises:
        Robo47Error: it has no head or body where it is expected.
    """
    head, body = b"<head>", b"<body>"
    if page.count(head) != 1 or page.count(body) != 1:
        raise Robo47Error(
            "viser's page is not as expected. Install the pinned one: "
            "python3 scripts/setup_env.py view"
        )
    titled = page.replace(b"<title>Viser</title>", f"<title>{TITLE}</title>".encode())
    there = f'<div id="r47-first">{first}</div>'.encode()
    return titled.replace(head, head + _ours()).replace(body, body + there)


@cache
def _ours() -> bytes:
    style, script = (HERE / f"client.{kind}" for kind in ("css", "js"))
    return b"<style>%s</style><script>%s</script>" % (
        style.read_bytes(),
        script.read_bytes(),
    )
