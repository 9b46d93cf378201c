"""Serves the inspector on this machine until Ctrl-C, and says where to look."""

import getpass
import os
import signal
import socket
import time

from robo47 import cli
from robo47.errors import Robo47Error
from robo47.inspector.app import Inspector
from robo47.inspector.arm import Arm
from robo47.inspector.guard import LOOPBACK, LocalServer

PORTS_TRIED = 100


def serve(arm: Arm, about: str, port: int) -> int:
    """Serve the page until Ctrl-C.

    Args:
        arm: what to show.
        about: the line that says which robot this is.
        port: the wish; the next free one is taken where it is busy.

    Returns:
        The exit code.

    Raises:
        Robo47Error: no port is free.
    """
    # A shell that starts a job with & has it ignore Ctrl-C; `kill` ends as well.
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.default_int_handler)
    server = LocalServer(free_port(port))
    try:
        Inspector(server, arm, about)
        print("\n".join(where_to_look(port, server.get_port())), flush=True)
        while True:
            time.sleep(1.0)  # in pieces: on Windows a long sleep would sit out Ctrl-C
    except KeyboardInterrupt:
        print("\ninspector stopped")
        return cli.EXIT_OK
    finally:
        server.stop()


def where_to_look(wish: int, port: int) -> list[str]:
    """Return the lines that tell a person where the page is.

    Args:
        wish: the port that was asked for; 0 for any.
        port: the one that was free.
    """
    url = f"http://{LOOPBACK}:{port}"
    moved = [f"port {wish} is taken; using {port}"] if wish not in (0, port) else []
    return [
        *moved,
        f"inspector: {url}   (Ctrl-C here ends it)",
        "From another computer: run this on it, then open the same address there.",
        f"  {ssh_line(port)}",
    ]


def ssh_line(port: int) -> str:
    """Return the command that makes the page reachable from another machine.

    Args:
        port: where it is on this one, and will be on the other.
    """
    try:
        user = getpass.getuser()
    except (OSError, KeyError, ImportError):  # a container's user without a name
        user = "USER"
    return f"ssh -L {port}:{LOOPBACK}:{port} {user}@{socket.gethostname()}"


def free_port(wish: int) -> int:
    """Return the first free port from the wish on.

    viser would look for one too, but in silence, and past the last port for ever.

    Args:
        wish: 0 for whichever the system picks.

    Raises:
        Robo47Error: none of a hundred is free.
    """
    for port in range(wish, min(wish + PORTS_TRIED, 65536)):
        with socket.socket() as probe:
            if os.name == "posix":  # as asyncio: a port just closed is free again
                probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            try:
                probe.bind((LOOPBACK, port))
                probe.listen()
            except OSError:
                continue
            return port
    raise Robo47Error(
        f"no port from {wish} on can be used; choose another, such as --port 8900"
    )
