"""Who may talk to the inspector: the browsers of this machine, and nobody else.

viser is made for trusted networks. Left alone it listens on every interface, accepts
WebSockets from any web page that the student has open (which could then move the
arm), and opens a public share tunnel for whichever client asks. Here:

- it listens on the loopback address alone;
- a request must name this machine as its host (a page that rebinds its own DNS name
  to 127.0.0.1 still says its own name), and a WebSocket must come from the very page
  that this server served (same origin);
- share requests are refused.
"""

import contextlib
import http
import re
from collections.abc import Callable, Iterator
from functools import wraps
from typing import Any

import rich
import viser
import websockets.asyncio.server
from websockets.asyncio.server import ServerConnection
from websockets.datastructures import Headers
from websockets.http11 import Request, Response

from robo47.errors import Robo47Error

LOOPBACK = "127.0.0.1"
OWN_HOST = re.compile(r"(127\.0\.0\.1|localhost|\[::1\])(:\d+)?")


class LocalServer(viser.ViserServer):
    """A viser server for this machine's browsers alone."""

    def __init__(self, port: int) -> None:
        """Listen on 127.0.0.1, at this port or the next free one.

        Args:
            port: the wish; `get_port()` tells what it became.

        Raises:
            Robo47Error: this viser starts its web server in a way not known here, so
                that its doors cannot be watched.
        """
        rich.get_console().quiet = True  # the script says where to look, once
        with _watched_doors() as watched:
            super().__init__(host=LOOPBACK, port=port, verbose=False)
        if not watched:
            self.stop()
            raise Robo47Error(
                f"viser {viser.__version__} cannot be kept from answering other sites' "
                "pages. Install the pinned one: python scripts/setup_env.py view"
            )
        self.gui.configure_theme(
            show_share_button=False, show_logo=False, control_width="large"
        )

    def request_share_url(self, verbose: bool = True) -> str | None:
        """Refuse, whoever asks: the arm is not put on the internet."""
        return None


def refusal(headers: Headers) -> str | None:
    """Return why a request is refused, or None for one that may pass.

    Args:
        headers: of the request.
    """
    hosts, origins = headers.get_all("Host"), headers.get_all("Origin")
    if len(hosts) != 1 or not OWN_HOST.fullmatch(hosts[0]):
        return "this address is not the inspector's; open http://127.0.0.1:PORT"
    # Every browser sends Origin with a WebSocket; same port as well, since another
    # program's page on this machine is another origin.
    wanted = [f"http://{hosts[0]}"]
    if origins != wanted and (origins or headers.get_all("Upgrade")):
        return "only the inspector's own page may connect to it"
    return None


@contextlib.contextmanager
def _watched_doors() -> Iterator[list[bool]]:
    """Make any web server that is started meanwhile ask `refusal` first."""
    serve, watched = websockets.asyncio.server.serve, []

    @wraps(serve)
    def guarded(*args: Any, process_request: Any, **options: Any) -> Any:
        watched.append(True)
        return serve(*args, process_request=_asking(process_request), **options)

    websockets.asyncio.server.serve = guarded  # type: ignore[assignment, misc]
    try:
        yield watched
    finally:
        websockets.asyncio.server.serve = serve  # type: ignore[misc]


def _asking(
    answer: Callable[[ServerConnection, Request], Response | None],
) -> Callable[[ServerConnection, Request], Response | None]:
    """Return viser's answer to a request, given only to those who may have it."""

    def process_request(
        connection: ServerConnection, request: Request
    ) -> Response | None:
        if why := refusal(request.headers):
            return connection.respond(http.HTTPStatus.FORBIDDEN, f"robo47: {why}\n")
        return answer(connection, request)

    return process_request
