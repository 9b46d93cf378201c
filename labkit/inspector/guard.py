"""Access to the inspector: on this machine, with its secret address, alone.

viser is made for trusted networks. Left alone it listens on every interface, accepts
WebSockets from any web page that the student has open (which could then move the
arm), and opens a public share tunnel for whichever client asks. Here:

- it listens on the loopback address alone;
- the address holds a secret, new at every start (`http://127.0.0.1:8080/SECRET/`):
  other users of the machine cannot know it. It stands in the path, so that the page,
  its WebSocket and its requests carry it, and no cookie does;
- a request must name this machine as its host (a page that rebinds its own DNS name
  to 127.0.0.1 still says its own name), and a WebSocket must come from the very page
  that this server served (same origin);
- in a GitHub codespace the host may also be the one under which GitHub forwards this
  port to the codespace's owner, and the origin one of the three that GitHub's proxy is
  known to send for that page; a foreign page's origin passes the proxy unchanged;
- share requests are refused;
- a client sets a widget's value and nothing else of it (viser sets any attribute).

viser's page gets our style and script (`client.css`, `client.js`): tabs that the server
opens, the pose in the address, buttons that copy.
"""

import contextlib
import hmac
import http
import logging
import os
import re
import secrets
import warnings
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial, wraps
from pathlib import Path
from typing import Any

import rich
import viser
import websockets.asyncio.server
from viser import _messages
from websockets.asyncio.server import ServerConnection
from websockets.datastructures import Headers
from websockets.http11 import Request, Response

from robo47.errors import Robo47Error

LOOPBACK = "127.0.0.1"
OWN_HOST = re.compile(r"(127\.0\.0\.1|localhost|\[::1\])(:\d+)?")
DOMAIN = "app.github.dev"  # the domain of forwarded ports, if the codespace names none
LONGEST = 2_000  # characters of a request's path
Receive = Callable[[str], int]  # where a page wants to go; the number of this word
Answers = Callable[[ServerConnection, Request], Response | None]
TITLE = "robo47 inspector"
HEAD = b"<head><style>%s</style><script>%s</script>" % tuple(
    Path(__file__).with_name(name).read_bytes() for name in ("client.css", "client.js")
)
PROTECTION = {
    "Referrer-Policy": "no-referrer",  # the address is the secret
    "X-Frame-Options": "DENY",
    "X-Content-Type-Options": "nosniff",
    "Cache-Control": "no-store",
}


class LocalServer(viser.ViserServer):
    """A viser server for this machine's browsers alone."""

    def __init__(self, port: int) -> None:
        """Listen on 127.0.0.1, at this port or the next free one; see `get_port()`.

        Raises:
            Robo47Error: this viser starts its web server in a way not known here, so
                that its doors cannot be watched.
        """
        rich.get_console().quiet = True  # the script says where to look, once
        # A broken client's message ends its connection; it is no news for the student.
        logging.getLogger("websockets.server").setLevel(logging.CRITICAL + 1)
        # Nor is what was still to be drawn when a page, or this server, was closed.
        warnings.filterwarnings("ignore", "Queued a .* on a closed connection")
        self.secret = secrets.token_urlsafe(12)
        self.receive: Receive = lambda query: 0
        self.first: Callable[[], str] = str  # the page that is shown before viser's
        self.plain: Callable[[], str] = str  # what a page without WebGL shows, as JSON
        with _watched_doors(self) as watched:
            super().__init__(host=LOOPBACK, port=port, verbose=False)
        if not watched:
            self.stop()
            raise Robo47Error(
                f"viser {viser.__version__} cannot be kept from answering other sites' "
                "pages. Install the pinned one: python3 scripts/setup_env.py view"
            )
        _values_only(self)
        self.gui.configure_theme(
            show_share_button=False, show_logo=False, control_width="large"
        )

    @property
    def url(self) -> str:
        """The page's address, secret included."""
        return f"http://{LOOPBACK}:{self.get_port()}/{self.secret}/"

    @property
    def forwarded_url(self) -> str:
        """The page's address under which a codespace forwards it; "" outside of one."""
        host = forwarded_host(self.get_port())
        return f"https://{host}/{self.secret}/" if host else ""

    def request_share_url(self, verbose: bool = True) -> str | None:
        """Refuse, whoever asks: the arm is not put on the internet."""
        return None

    def refusal(self, request: Request) -> str | None:
        """Return why a request is refused, or None for one that may pass."""
        headers = request.headers
        hosts, origins = headers.get_all("Host"), headers.get_all("Origin")
        port = self.get_port()
        forwarded = forwarded_host(port)
        via = headers.get_all("X-Forwarded-Host") if forwarded else []
        # Outside of a codespace `forwarded` is "", which an empty Host must not equal.
        named = [host for host in (*hosts, *via) if not forwarded or host != forwarded]
        if len(hosts) != 1 or not all(map(OWN_HOST.fullmatch, named)):
            return "this address is not the inspector's; open http://127.0.0.1:PORT"
        # Every browser sends Origin with a WebSocket; same port as well, since another
        # program's page on this machine is another origin.
        wanted = [[f"http://{hosts[0]}"]]
        if forwarded:
            wanted += [[f"{way}://localhost:{port}"] for way in ("http", "https")]
            wanted += [[f"https://{forwarded}"]]
        if origins not in wanted and (origins or headers.get_all("Upgrade")):
            return "only the inspector's own page may connect to it"
        if len(request.path) > LONGEST:
            return "that address is too long"
        given = request.path.partition("?")[0].strip("/").partition("/")[0]
        # A path's bytes beyond ASCII arrive as unpaired surrogates.
        told = given.encode("ascii", "backslashreplace")
        if not hmac.compare_digest(told, self.secret.encode()):
            return "open the whole address that `make view` printed"
        return None

    def answer(
        self, viser_answers: Answers, connection: ServerConnection, request: Request
    ) -> Response | None:
        """Return the answer, viser's own where all is well; None opens a WebSocket."""
        if why := self.refusal(request):
            return connection.respond(http.HTTPStatus.FORBIDDEN, f"robo47: {why}\n")
        path, _, query = request.path.partition("?")
        path = path.strip("/").removeprefix(self.secret)
        ours: dict[str, Callable[[], object]] = {
            "/go": partial(self.receive, query),
            "/here": lambda: "here",  # an open page asks whether its server still runs
            "/plain": self.plain,
        }
        if path in ours:
            return connection.respond(http.HTTPStatus.OK, str(ours[path]()))
        plain = Headers(request.headers)
        with contextlib.suppress(KeyError):
            del plain["Accept-Encoding"]  # the page is changed below
        asked = replace(request, path=path or "/", headers=plain)
        response = viser_answers(connection, asked)
        return response and _protected(response, None if path else self.first())


def forwarded_host(port: int) -> str:
    """Return the host under which GitHub forwards a codespace's port, to its owner.

    "" outside of a codespace. What GitHub's proxy sends was read in public bug reports
    (symfony/demo #1542, vercel/chatbot #384, we-promise/sure #3610), not tried: a
    request names localhost or this host as its Host and this host as
    X-Forwarded-Host; the origin of its own page is rewritten to localhost with the
    port, and any other origin is left as it is.
    """
    name = os.environ.get("CODESPACE_NAME", "")
    if os.environ.get("CODESPACES") != "true" or not name:
        return ""
    domain = os.environ.get("GITHUB_CODESPACES_PORT_FORWARDING_DOMAIN") or DOMAIN
    return f"{name}-{port}.{domain}"


def _protected(response: Response, first: str | None) -> Response:
    """Return viser's response with our headers.

    Where there is something to see first it is viser's page: its head gets our style
    and script, and the first HTML stands there until viser draws, seconds later.
    """
    body = bytes(response.body)
    if first is not None:
        if body.count(b"<head>") != 1 or body.count(b"<body>") != 1:
            raise Robo47Error(
                "viser's page is not as expected. Install the pinned one: "
                "python3 scripts/setup_env.py view"
            )
        there = f'<body><div id="r47-first">{first}</div>'.encode()
        title = f"<title>{TITLE}</title>".encode()
        body = body.replace(b"<title>Viser</title>", title)
        body = body.replace(b"<head>", HEAD).replace(b"<body>", there)
    length = {"Content-Length": str(len(body))}
    headers = {**dict(response.headers.raw_items()), **PROTECTION, **length}
    return replace(response, headers=Headers(headers), body=body)


@contextlib.contextmanager
def _watched_doors(server: LocalServer) -> Iterator[list[bool]]:
    """Have any web server that is started meanwhile ask this one first."""
    serve = websockets.asyncio.server.serve
    watched = []

    @wraps(serve)
    def guarded(*args: Any, process_request: Answers, **options: Any) -> Any:
        watched.append(True)
        asked = partial(server.answer, process_request)
        return serve(*args, process_request=asked, **options)

    websockets.asyncio.server.serve = guarded  # type: ignore[assignment, misc]
    try:
        yield watched
    finally:
        websockets.asyncio.server.serve = serve  # type: ignore[misc]


def _values_only(server: viser.ViserServer) -> None:
    """Let a client's update through only where it is a value that the widget can have.

    viser sets whatever attribute a message names, and believes a drop-down's value.
    """
    gui, kind = server.gui, _messages.GuiUpdateMessage
    handle = gui._handle_gui_updates

    async def checked(client_id: Any, message: _messages.GuiUpdateMessage) -> None:
        widget = gui._gui_input_handle_from_uuid.get(message.uuid)
        value = message.updates.get("value")
        if widget is None or set(message.updates) != {"value"}:
            return
        options = getattr(widget, "options", None)
        if options is not None and value not in options:
            return
        with contextlib.suppress(TypeError, ValueError, AssertionError, OverflowError):
            await handle(client_id, message)

    interface = gui._websock_interface
    interface.unregister_handler(kind, handle)
    interface.register_handler(kind, checked)
