"""Serves the inspector on this machine until Ctrl-C, and says where to look.

The page is there before the arm's meshes are: numbers and triads first, then simple
meshes, then the fine ones.
"""

import asyncio
import contextlib
import getpass
import os
import signal
import socket
import time
from collections.abc import Callable
from functools import partial
from typing import NoReturn, TypeVar

import mujoco
import viser

from labkit.base import cli, store
from labkit.check.tasks import TaskResult, check_tasks
from labkit.inspector import plain
from labkit.inspector.app import Inspector
from labkit.inspector.arm import Arm
from labkit.inspector.failing import failing_tab
from labkit.inspector.guard import LOOPBACK, LocalServer
from labkit.inspector.shapes import GRID, shapes, simple_links, thinned
from labkit.inspector.standing import Standing, standing
from labkit.inspector.student import Student
from labkit.inspector.tab import day_tabs
from labkit.lesson.day import Day
from labkit.sandbox.sandbox import Sandbox, deadline_of
from robo47.errors import Robo47Error

MEMORY = "view.json"  # remembers the port of each day's page
PORTS_TRIED = 100
T = TypeVar("T")
WINDOW = 8  # messages viser sends at once; by its 128 the meshes delay the numbers


def serve(
    day: Day,
    arm: Arm,
    about: str,
    dressed: Callable[[], mujoco.MjModel],
    port: int,
    *,
    simple: bool,
    back: bool,
    failing: TaskResult | None = None,
) -> NoReturn:
    """Serve the page until Ctrl-C, at this port or the next free one.

    Args:
        day: whose tabs and whose file.
        arm: what to show, without its looks; the numbers need none.
        about: what to say of the robot on the page; "" for nothing.
        dressed: loads the arm's model with its meshes; takes seconds.
        port: where to listen.
        simple: without the fine meshes, for a computer without a GPU.
        back: begin in the tab and the pose where the day's last page ended.
        failing: a task that fails: its call is shown first, in a tab of its own.

    Raises:
        Robo47Error: no port is free, or the day's tabs do not load.
    """
    # A shell that starts a job with & has it ignore Ctrl-C; `kill` ends as well.
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.default_int_handler)
    tabs = day_tabs(day)
    if failing:
        tabs = tabs._replace(tabs=[failing_tab(day, failing), *tabs.tabs])
    server = LocalServer(free_port(port))
    with contextlib.ExitStack() as ends:
        ends.callback(server.stop)
        sandbox = ends.enter_context(Sandbox())
        student = Student(day, arm, tabs.ghost, sandbox, day.work)
        try:
            server._websock_server.get_message_buffer().max_window_size = WINDOW
            page = on_loop(
                server, lambda: Inspector(server, arm, about, tabs, student, simple)
            )
            ends.callback(on_loop, server, page.close)
            server.receive, server.first = page.receive, page.first
            server.plain = partial(plain.page_of, page)
            before = store.read(MEMORY).get(str(day.number), "")
            if back and isinstance(before, str):
                on_loop(server, partial(page.receive, before))
            print("\n".join(where_to_look(port, server)), flush=True)
            checks = Checks(day, failing.task.id if failing else "")
            for work in (page.watch(checks.ask, checks.stop), dress(page, dressed)):
                loop = server.get_event_loop()
                ends.callback(asyncio.run_coroutine_threadsafe(work, loop).cancel)
            while True:
                time.sleep(1.0)  # short pieces: on Windows a long sleep delays Ctrl-C
                remember(day, page.address)
        except KeyboardInterrupt:
            print("\ninspector stopped", flush=True)
    # Python itself would wait for a check or a simulation at work on a thread.
    os._exit(cli.EXIT_OK)


class Checks:
    """What the checker says of the student's file of a day, save after save."""

    def __init__(self, day: Day, task: str = "") -> None:
        """Take the day, and the task that is told first while it is wrong."""
        self.day = day
        self.task = task
        self.deadline = deadline_of(day)

    def ask(self) -> Standing:
        """Return how the tasks stand; it waits for the checker."""
        self.deadline = deadline_of(self.day)
        try:
            with Sandbox() as sandbox:
                file, until = self.day.work, self.deadline
                found = check_tasks(self.day, file, sandbox, deadline=until)
                return standing(found, self.task)
        except Exception as error:  # the page goes on, whatever the file is like
            return Standing(str(error), "bad")

    def stop(self) -> None:
        """Let the check at work end: nobody waits for what it finds."""
        self.deadline.seconds = 0.0


def remember(day: Day, address: str) -> None:
    """Keep where a day's page is, for the next start."""
    memory = store.read(MEMORY)
    key = str(day.number)
    if memory.get(key) != address:
        store.write(MEMORY, {**memory, key: address})


def on_loop(server: viser.ViserServer, call: Callable[[], T]) -> T:
    """Call something on the server's event loop, where the page lives."""

    async def called() -> T:
        return call()

    return asyncio.run_coroutine_threadsafe(called(), server.get_event_loop()).result()


async def dress(page: Inspector, dressed: Callable[[], mujoco.MjModel]) -> None:
    """Load the meshes and put them on: the simple ones, then the fine ones."""
    try:
        model = await asyncio.to_thread(dressed)
    except Robo47Error as error:
        print(f"the arm stays without its meshes: {error}", flush=True)
        return
    if coarse := await asyncio.to_thread(simple_links, model):
        page.dress(model, coarse, coarse)
    if not (coarse and page.simple):
        fine = await asyncio.to_thread(shapes, model)
        page.dress(model, fine)
        ghosts = await asyncio.to_thread(lambda: [thinned(one, GRID) for one in fine])
        page.dress(model, fine, ghosts)


def where_to_look(wish: int, server: LocalServer) -> list[str]:
    """Return the lines that tell where the page is, and if the wished port is not."""
    port = server.get_port()
    moved = [f"port {wish} is taken; using {port}"] if wish not in (0, port) else []
    try:
        user = getpass.getuser()
    except (OSError, KeyError, ImportError):  # a container's user without a name
        user = "USER"
    if forwarded := server.forwarded_url:
        return [
            *moved,
            f"inspector: {forwarded}   (Ctrl-C here ends it)",
            f"In VS Code on your own computer: {server.url}",
        ]
    return [
        *moved,
        f"inspector: {server.url}   (Ctrl-C here ends it)",
        "From another computer: run this on it, then open the same address there.",
        f"  ssh -L {port}:{LOOPBACK}:{port} {user}@{socket.gethostname()}",
    ]


def free_port(wish: int) -> int:
    """Return the first free port from the wish on; 0 for whichever the system picks.

    viser would look for one too, but in silence, and past the last port for ever.

    Raises:
        Robo47Error: none of a hundred is free.
    """
    for port in range(wish, min(wish + PORTS_TRIED, 65536)):
        with socket.socket() as probe:
            if os.name == "posix":  # as asyncio does: a port just closed is free again
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
