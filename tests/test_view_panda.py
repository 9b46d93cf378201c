"""`scripts/view_panda.py`: what it says and how it ends, whatever the machine has."""

import importlib.util
import re
import socket
import sys
from functools import partial

import numpy as np
import pytest
from inspection import Served

from conftest import need
from labkit.commands import view
from robo47.errors import Robo47Error

pytestmark = pytest.mark.kit

VIEW = "scripts/view_panda.py"
ON_LINUX = sys.platform.startswith("linux")


@pytest.fixture
def viser() -> None:
    need(importlib.util.find_spec("viser") is not None, "viser: make view")


@pytest.fixture
def look(monkeypatch):
    """Run the command in this process; return its exit code."""

    def called(*arguments: object) -> int:
        monkeypatch.setattr(sys, "argv", [VIEW, *map(str, arguments)])
        return view.main()

    return called


@pytest.fixture
def refused(look):
    """Run the command where it must refuse; return its one line."""

    def called(*arguments: object) -> str:
        with pytest.raises(Robo47Error) as error:
            look(*arguments)
        assert "\n" not in str(error.value)
        return str(error.value)

    return called


def test_help_shows_every_way_to_look_and_fits_80_columns(run):
    said = run(VIEW, "--help", COLUMNS=80).stdout
    for way in ("--clip", "--native", "--screenshot", "--port", "--task", "TASK=1.2"):
        assert way in said
    assert max(map(len, said.splitlines())) <= 80


@pytest.fixture(scope="module")
def first():
    need(importlib.util.find_spec("viser") is not None, "viser: make view")
    with Served("--port", "0") as server:
        yield server


def test_a_second_inspector_takes_the_next_free_port_and_says_so(first):
    with Served("--port", str(first.port)) as second:
        pass
    assert second.port > first.port
    assert f"port {first.port} is taken; using {second.port}\n" in second.said
    assert second.path != first.path  # every start has an address of its own
    assert len(second.path.strip("/")) >= 16


def test_it_prints_the_robot_the_address_one_ssh_line_and_ends_with_ctrl_c(first):
    assert first.press_ctrl_c() == 0
    lines = first.said.splitlines()
    assert lines[0].startswith("robot: Franka Panda (panda_nohand), ")
    assert lines[1].startswith(f"inspector: {first.url} ")
    ssh = [line.strip() for line in lines if line.strip().startswith("ssh ")]
    assert len(ssh) == 1
    end = f"{first.port}:127.0.0.1:{first.port}"
    assert re.fullmatch(rf"ssh -L {end} \S+@\S+", ssh[0])
    assert "viser" not in first.said  # its own banner would say it all twice
    assert first.said.endswith("\ninspector stopped\n")
    assert "Traceback" not in first.said


def test_no_free_port_at_all_is_one_clear_line(viser, monkeypatch):
    from labkit.inspector import serve

    monkeypatch.setattr(serve, "PORTS_TRIED", 1)
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        with pytest.raises(Robo47Error, match="choose another, such as --port"):
            serve.free_port(other.getsockname()[1])


@pytest.mark.parametrize("wrong", ["70000", "-1", "http"])
def test_a_port_that_is_none_is_refused(look, capsys, wrong):
    with pytest.raises(SystemExit, match="2"):
        look("--web", f"--port={wrong}")
    assert "argument --port" in capsys.readouterr().err


def test_without_viser_it_names_the_command_that_installs_it(refused, monkeypatch):
    find = importlib.util.find_spec
    hidden = lambda name, *more: None if name == "viser" else find(name, *more)  # noqa: E731
    monkeypatch.setattr(importlib.util, "find_spec", hidden)
    assert "`make view` installs it" in refused("--web")
    # the browser is the default, whatever display there is
    assert "the inspector needs viser" in refused()


@pytest.mark.skipif(not ON_LINUX, reason="only Linux tells by its environment")
@pytest.mark.parametrize(
    ("display", "says"),
    [("", "no display"), (":4747", "the display cannot open an OpenGL window")],
)
def test_without_a_display_the_window_is_refused_in_one_line_that_names_the_browser(
    refused, monkeypatch, display, says
):
    monkeypatch.setenv("DISPLAY", display)
    monkeypatch.setenv("WAYLAND_DISPLAY", "")
    line = refused("--native")
    assert says in line
    assert "make view" in line


def test_a_day_that_is_not_there_is_one_line(run):
    done = run(VIEW, "99")
    assert done.returncode == 2
    assert re.fullmatch("error: .*no day 99.*\n", done.stderr)


def test_a_clip_never_replaces_a_file_and_knows_its_endings(refused, tmp_path):
    path = tmp_path / "arm.gif"
    path.write_text("mine")
    assert "is there already" in refused("1", "--clip", path)
    assert path.read_text() == "mine"
    assert ".gif or .webp" in refused("1", "--clip", tmp_path / "arm.mp4")


def test_a_clip_of_a_file_that_is_not_there_is_one_line(refused, tmp_path):
    line = refused("1", "--clip", tmp_path / "a.gif", "--file", tmp_path / "no.py")
    assert "no.py is not there" in line


@pytest.mark.gl
@pytest.mark.usefixtures("gl")
def test_the_documented_screenshot_is_accepted_as_the_days_figure(run_in, clone):
    from labkit.handin.deliverables import check_deliverables
    from labkit.lesson.day import find_day

    need(importlib.util.find_spec("PIL") is not None, "Pillow: make figures")
    day = find_day(1, clone)
    done = run_in(VIEW, "--screenshot")
    assert (done.returncode, done.stderr) == (0, "")
    assert f"wrote w1-foundations/{day.figure}" in done.stdout
    items = {item.name: item for item in check_deliverables(day, clone)}
    assert items["figure"].passed, items["figure"].message


@pytest.mark.gl
@pytest.mark.usefixtures("gl")
@pytest.mark.parametrize("start", ["ready", "home", "zero"])
def test_a_screenshot_cuts_nothing_off(look, tmp_path, monkeypatch, start):
    image = pytest.importorskip("PIL.Image")
    from labkit.figures import portrait

    # the same camera, without shadows
    quick = partial(portrait.render_panda, fast=True)
    monkeypatch.setattr(portrait, "render_panda", quick)
    path = tmp_path / "new" / "arm.png"
    assert look("--screenshot", path, "--start", start) == 0
    picture = np.asarray(image.open(path).convert("L"))
    edges = [picture[:5], picture[-5:], picture[:, :5], picture[:, -5:]]
    assert picture.max() > 200
    assert max(int(edge.max()) for edge in edges) < 100  # floor and wall alone


def test_an_option_that_cannot_be_honoured_is_refused(refused, tmp_path):
    line = refused("--screenshot", tmp_path / "a.png", "--entry", "panda")
    assert "--entry is for --web" in line
    assert "--file is for --clip" in refused("--web", "--file", "a.py")


def test_a_screenshot_never_replaces_a_file(refused, tmp_path):
    path = tmp_path / "mine.png"
    path.write_text("mine")
    assert "is there already and stays as it is" in refused("--screenshot", path)
    assert path.read_text() == "mine"


def test_without_the_means_to_draw_a_screenshot_says_what_installs_them(
    refused, tmp_path, monkeypatch
):
    for module in [name for name in sys.modules if name.startswith("labkit.figures")]:
        monkeypatch.delitem(sys.modules, module)
    monkeypatch.setitem(sys.modules, "PIL", None)
    path = tmp_path / "arm.png"
    assert "make view ARGS=--screenshot" in refused("--screenshot", path)
    assert not path.exists()
