"""Who may talk to the inspector: this machine's own browsers, and nobody else."""

import contextlib
import importlib.util
import socket
import urllib.error
import urllib.request
from queue import Queue

import pytest
from inspection import SECONDS, Served

from conftest import need

pytestmark = pytest.mark.kit


def here(module: str) -> bool:
    return importlib.util.find_spec(module) is not None


@pytest.fixture(autouse=True)
def viser():
    need(here("viser"), "viser: make view")
    import viser

    return viser


@pytest.fixture(scope="module")
def served():
    need(here("viser"), "viser: make view")
    with Served("--port", "0") as server:
        yield server


@contextlib.contextmanager
def websocket(port: int, path: str, host: str | None = None, origin: str | None = None):
    """Open a WebSocket that names a host and an origin, and read the scene."""
    import viser
    from websockets.sync.client import connect

    with (
        socket.create_connection(("127.0.0.1", port)) as wire,
        connect(
            f"ws://{host or f'127.0.0.1:{port}'}{path}",
            sock=wire,
            origin=origin,
            subprotocols=[f"viser-v{viser.__version__}"],
            compression=None,
            max_size=None,
            close_timeout=0.1,  # the server does not take its leave
        ) as page,
    ):
        assert page.recv(timeout=30)  # the scene
        yield page


def connect(
    served: Served, host: str | None = None, origin: str | None = None, path: str = ""
) -> None:
    """Open a WebSocket as the page at some address would, and close it."""
    with websocket(served.port, path or served.path, host, origin):
        pass


def refused(*who: object, **how: str | None) -> bool:
    """Return whether such a WebSocket is refused, and as forbidden."""
    from websockets.exceptions import InvalidStatus

    with pytest.raises(InvalidStatus) as answer:
        connect(*who, **how)
    return answer.value.response.status_code == 403


def get(served: Served, host: str = "", path: str = "", **headers: str) -> int:
    """Return the status of a request for the page that names this host."""
    url = f"http://127.0.0.1:{served.port}{path or served.path}"
    named = {"Host": host or f"127.0.0.1:{served.port}", **headers}
    request = urllib.request.Request(url, headers=named)
    try:
        with urllib.request.urlopen(request, timeout=30) as answer:
            return answer.status
    except urllib.error.HTTPError as refused:
        with refused:
            return refused.code


def test_its_own_page_may_connect_by_every_name_of_this_machine(served):
    for name in ("127.0.0.1", "localhost", "[::1]"):
        host = f"{name}:{served.port}"
        connect(served, host, f"http://{host}")
        assert get(served, host) == 200


def test_a_tunnel_may_end_at_another_port(served):
    """As with ssh -L 9000:127.0.0.1:8080."""
    connect(served, "localhost:9000", "http://localhost:9000")
    assert get(served, "localhost:9000") == 200


@pytest.mark.parametrize(
    "origin",
    [
        "http://evil.example",
        "https://127.0.0.1",
        "http://127.0.0.1:1",  # another program's page on this machine
        "http://127.0.0.1.evil.example",
        "null",  # a file, or a sandboxed frame
        None,  # not a browser
    ],
)
def test_a_websocket_from_any_other_page_is_refused(served, origin):
    assert refused(served, origin=origin)


@pytest.mark.parametrize(
    "name", ["evil.example", "localhost.evil.example", "0.0.0.0", "evil@127.0.0.1"]
)
def test_a_page_that_rebinds_its_name_to_this_machine_is_refused(served, name):
    host = f"{name}:{served.port}"
    assert refused(served, host.rpartition("@")[2], f"http://{host}")
    assert get(served, host) == 403


def status_of_bytes(served, request: bytes) -> bytes:
    """Return the first line of the answer to a request that no library would send."""
    with socket.create_connection(("127.0.0.1", served.port), 30) as wire:
        wire.sendall(request)
        return wire.makefile("rb").readline()


def test_an_empty_host_is_no_name_of_this_machine(served):
    request = f"GET {served.path} HTTP/1.1\r\nHost: \r\n\r\n"
    assert b"403" in status_of_bytes(served, request.encode())


def test_bytes_beyond_ascii_in_the_place_of_the_secret_are_refused(served):
    own = b"\r\nHost: 127.0.0.1\r\n\r\n"
    assert b"403" in status_of_bytes(served, b"GET /\xe9/ HTTP/1.1" + own)


NEIGHBOURS = ["/", "/index.html", "/go?tab=Chain", "//", "/x/{secret}/",
              "/{secret}x/", "/%2e%2e/{secret}/", "/{short}/", "/{upper}/"]  # fmt: skip


@pytest.mark.parametrize("path", NEIGHBOURS)
def test_who_does_not_know_the_address_gets_nothing(served, path):
    """Another user of this machine may reach the port, and knows all but the secret."""
    secret = served.path.strip("/")
    guess = path.format(secret=secret, short=secret[:-1], upper=secret.swapcase())
    assert get(served, path=guess) == 403
    host = f"127.0.0.1:{served.port}"
    assert refused(served, origin=f"http://{host}", path=guess)


def test_a_foreign_page_cannot_press_a_button(served):
    """Even one that knew the address: its request names its own origin."""
    path = f"{served.path}go?tab=Chain"
    assert get(served, path=path) == 200
    assert get(served, path=path, Origin="http://evil.example") == 403
    assert get(served, host="evil.example", path=path) == 403


def test_the_address_stays_here_and_the_page_in_no_frame(served):
    with urllib.request.urlopen(served.url, timeout=30) as answer:
        headers, body = answer.headers, answer.read()
    assert headers["Referrer-Policy"] == "no-referrer"
    assert headers["X-Frame-Options"] == "DENY"
    assert headers["Cache-Control"] == "no-store"
    assert "Set-Cookie" not in headers
    assert b"data-r47-state" in body
    assert served.path.strip("/").encode() not in body


@pytest.mark.parametrize(
    "path", ["../pyproject.toml", "%2e%2e/%2e%2e/etc/passwd", "x" * 3000, "go/../.."]
)
def test_the_page_serves_no_other_file(served, path):
    assert get(served, path=served.path + path) in (403, 404)


@pytest.fixture
def server(viser):
    from labkit.inspector.guard import LocalServer

    made = LocalServer(0)
    yield made
    made.stop()


def test_a_client_sets_the_value_of_a_widget_and_nothing_else(server):
    """viser sets any attribute that a message names, and believes any option."""
    import asyncio

    from viser import _messages

    slider = server.gui.add_slider("s", 0.0, 1.0, 0.1, 0.5)
    pick = server.gui.add_dropdown("d", ("one", "two"))
    kind = _messages.GuiUpdateMessage
    (checked,) = server.gui._websock_interface._incoming_handlers[kind]

    def send(widget, **updates):
        message, loop = kind(widget._impl.uuid, updates), server.get_event_loop()
        asyncio.run_coroutine_threadsafe(checked(0, message), loop).result(30)

    callbacks = slider._impl.update_cb
    send(slider, update_cb=5)
    send(slider, value=0.9, removed=True)
    send(slider, nonsense=1)
    send(slider, value="not a number")
    send(slider, value=None)
    send(pick, value="nope")
    assert slider._impl.update_cb is callbacks
    assert (slider.value, pick.value) == (0.5, "one")
    send(slider, value=0.9)
    send(pick, value="two")
    assert (slider.value, pick.value) == (0.9, "two")


RUBBISH = [
    {"type": "Nope"},
    {"type": "GuiUpdateMessage"},
    {"type": "GuiUpdateMessage", "uuid": 5, "updates": []},
    {"type": "GuiUpdateMessage", "uuid": "x", "updates": {"value": float("nan")}},
    {"type": "ScenePointerMessage", "event_type": "click", "screen_pos": "x"},
    {"type": "TransformControlsUpdateMessage", "name": "/arm", "wxyz": [0] * 4,
     "position": [float("inf")] * 3},
    {"type": "ViewerCameraMessage", "wxyz": [float("nan")] * 4, "fov": "wide"},
    {"type": "ShareUrlRequest"},
    ["no", "map"],
    "x" * 2_000_000,
]  # fmt: skip


def test_rubbish_and_floods_through_the_websocket_do_not_stop_the_page(served):
    import msgspec
    from websockets.exceptions import ConnectionClosed

    own = f"http://127.0.0.1:{served.port}"
    raw = [b"", b"\xff" * 10_000, "text, not bytes"]
    flood = [msgspec.msgpack.encode(RUBBISH[3])] * 500
    packed = [[msgspec.msgpack.encode(each)] for each in RUBBISH]
    for messages in (*packed, *([each] for each in raw), flood):
        with (
            contextlib.suppress(ConnectionClosed),  # it may well hang up
            websocket(served.port, served.path, origin=own) as page,
        ):
            for message in messages:
                page.send(message)
    connect(served, origin=own)
    assert get(served) == 200
    assert served.process.poll() is None


def test_a_flood_of_requests_leaves_the_page_its_answers(served):
    waiting = [socket.create_connection(("127.0.0.1", served.port)) for _ in range(100)]
    try:  # a hundred that never say what they want
        path = f"{served.path}go?tab=Chain"
        assert {get(served, path=path) for _ in range(100)} == {200}
        assert get(served) == 200
    finally:
        for each in waiting:
            each.close()


REACHING = """
def compose_fk(model, q, path=None):
    reached = []
    def attempt(what, call):
        try:
            call()
        except BaseException:
            return
        reached.append(what)
    os = __import__("os")
    def connect():
        __import__("socket").create_connection(("127.0.0.1", {port}), 2).close()
    attempt("its port", connect)
    attempt("its process", lambda: os.kill({pid}, 0))
    attempt("its memory", lambda: open("/proc/{pid}/mem", "rb").close())
    attempt("its command line", lambda: open("/proc/{pid}/cmdline").read())
    attempt("the kit", lambda: open({file!r}).read())
    guard = "labkit.inspector.guard"
    attempt("its code", lambda: __import__(guard).inspector.guard.LocalServer(0))
    raise ValueError(f"reached {{reached}}")
"""


def test_the_students_code_reaches_neither_the_server_nor_its_files(served, tmp_path):
    from labkit.base.exchange import Question
    from labkit.inspector import student
    from labkit.inspector.arm import Arm
    from labkit.lesson.day import find_day
    from labkit.sandbox.process import wall
    from labkit.sandbox.sandbox import Sandbox
    from robo47 import panda

    need(wall().name != "none", "bubblewrap or Landlock")
    file, pid = student.__file__, served.process.pid
    script = tmp_path / "day1_transforms.py"
    script.write_text(REACHING.format(port=served.port, pid=pid, file=file))
    connect(served, origin=f"http://127.0.0.1:{served.port}")  # from here it is reached
    with Sandbox() as sandbox:
        arm = Arm(panda.load(), panda.END_FRAME["panda_nohand"])
        own = student.Student(find_day(1), arm, None, sandbox, script, seconds=9)
        own.look()
        (reply,) = own.ask([Question("ghost", "compose_fk", (1, 2))])
    assert reply.error == "reached []", (reply.kind, reply.error)


def test_it_listens_on_the_loopback_address_alone(served):
    need(here("psutil"), "psutil: scripts/setup_env.py browser")
    import psutil

    tree = [psutil.Process(served.process.pid)]
    tree += tree[0].children(recursive=True)
    listening = [
        c.laddr
        for process in tree
        for c in process.net_connections(kind="all")
        if c.status == psutil.CONN_LISTEN
    ]
    assert listening == [("127.0.0.1", served.port)]


@pytest.fixture
def tunnels(viser, monkeypatch) -> Queue:
    """Record every share tunnel that viser would open, and open none."""
    opened: Queue = Queue()

    class Recorded:
        def __init__(self, *_: object) -> None:
            opened.put("a tunnel")
            raise RuntimeError("recorded, not opened")

    monkeypatch.setattr("viser._viser.ViserTunnel", Recorded)
    return opened


def ask_to_share(port: int, path: str = "/") -> None:
    """Ask for a public share link, as any client can, and wait for an answer."""
    import msgspec

    with websocket(port, path, origin=f"http://127.0.0.1:{port}") as page:
        page.send(msgspec.msgpack.encode({"type": "ShareUrlRequest"}))


def test_no_client_can_have_it_open_a_public_tunnel(server, tunnels, monkeypatch):
    answers: Queue = Queue()
    kind = type(server)
    refuse = kind.request_share_url
    monkeypatch.setattr(
        kind, "request_share_url", lambda self: answers.put(refuse(self))
    )
    ask_to_share(server.get_port(), f"/{server.secret}")
    assert answers.get(timeout=SECONDS) is None
    assert tunnels.empty()


def test_the_same_request_does_open_one_in_viser_left_alone(viser, tunnels):
    """Without this the test above could pass for want of a real request."""
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    try:
        ask_to_share(server.get_port())
        assert tunnels.get(timeout=SECONDS) == "a tunnel"
    finally:
        server.stop()


def test_a_viser_whose_doors_cannot_be_watched_is_not_used(viser, monkeypatch):
    from contextlib import nullcontext

    from labkit.inspector import guard
    from robo47.errors import Robo47Error

    monkeypatch.setattr(guard, "_watched_doors", lambda door: nullcontext([]))
    with pytest.raises(Robo47Error, match="Install the pinned one"):
        guard.LocalServer(0)


SPACE = "curly-guide-94xq"
FORWARDED = f"{SPACE}-{{port}}.app.github.dev"
BY_GITHUB = [  # Host, X-Forwarded-Host, Origin, as public reports have them
    ("localhost:{port}", FORWARDED, "http://localhost:{port}"),
    ("localhost:{port}", FORWARDED, "https://localhost:{port}"),
    ("localhost:{port}", FORWARDED, f"https://{FORWARDED}"),
    ("localhost:{port}", "", "https://localhost:{port}"),
    (FORWARDED, "", f"https://{FORWARDED}"),
    (FORWARDED, FORWARDED, "http://localhost:{port}"),
]
FOREIGN = [
    ("localhost:{port}", FORWARDED, "https://evil.example"),
    ("localhost:{port}", FORWARDED, ""),
    ("localhost:{port}", FORWARDED, "null"),
    ("localhost:{port}", FORWARDED, "https://other-{port}.app.github.dev"),
    ("localhost:{port}", FORWARDED, f"https://{SPACE}-1.app.github.dev"),  # a neighbour
    ("localhost:{port}", FORWARDED, f"http://{FORWARDED}"),
    ("localhost:{port}", FORWARDED, f"https://{FORWARDED}.evil.example"),
    ("localhost:{port}", FORWARDED, "https://localhost:1"),
    ("localhost:{port}", "evil.example", "http://localhost:{port}"),
    ("other-{port}.app.github.dev", "", "https://other-{port}.app.github.dev"),
    ("evil.example", FORWARDED, f"https://{FORWARDED}"),
]


@pytest.fixture
def codespace(monkeypatch):
    monkeypatch.setenv("CODESPACES", "true")
    monkeypatch.setenv("CODESPACE_NAME", SPACE)
    monkeypatch.delenv("GITHUB_CODESPACES_PORT_FORWARDING_DOMAIN", raising=False)


def why_refused(server, host, via, origin, *, secret=""):
    """Return why a WebSocket with these headers is refused, None where it may pass."""
    from websockets.datastructures import Headers
    from websockets.http11 import Request

    headers = {"Host": host, "X-Forwarded-Host": via, "Origin": origin}
    told = Headers({"Upgrade": "websocket"})
    for name, value in headers.items():
        if value:
            told[name] = value.format(port=server.get_port())
    return server.refusal(Request(f"/{secret or server.secret}/", told))


@pytest.mark.parametrize(("host", "via", "origin"), BY_GITHUB)
def test_in_a_codespace_its_own_forwarded_page_may_connect(
    server, codespace, host, via, origin
):
    assert why_refused(server, host, via, origin) is None
    assert "whole address" in why_refused(server, host, via, origin, secret="guessed")


@pytest.mark.parametrize(("host", "via", "origin"), FOREIGN)
def test_in_a_codespace_any_other_page_is_refused(server, codespace, host, via, origin):
    assert why_refused(server, host, via, origin)


@pytest.mark.parametrize(("host", "via", "origin"), BY_GITHUB)
def test_outside_of_a_codespace_nothing_is_accepted_that_it_would_send(
    server, monkeypatch, host, via, origin
):
    """But the one that is the same with every tunnel: http://localhost and its port."""
    monkeypatch.delenv("CODESPACES", raising=False)
    monkeypatch.setenv("CODESPACE_NAME", SPACE)
    plain = (host, origin) == ("localhost:{port}", "http://localhost:{port}")
    assert (why_refused(server, host, via, origin) is None) == plain


def test_in_a_codespace_its_websocket_opens_and_its_address_is_the_forwarded_one(
    server, codespace, monkeypatch
):
    from labkit.inspector import serve

    port = server.get_port()
    host, origin = f"localhost:{port}", f"https://localhost:{port}"
    with websocket(port, f"/{server.secret}", host, origin):
        pass
    forwarded = f"https://{FORWARDED.format(port=port)}/{server.secret}/"
    said = serve.where_to_look(port, server)
    assert said[0].startswith(f"inspector: {forwarded} ")
    assert server.url in said[1]
    assert "ssh" not in " ".join(said)
    monkeypatch.setenv("GITHUB_CODESPACES_PORT_FORWARDING_DOMAIN", "ports.example.org")
    assert server.forwarded_url.startswith(f"https://{SPACE}-{port}.ports.example.org/")
