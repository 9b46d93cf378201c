"""`scripts/view_panda.py`: what it says and how it ends, whatever the machine has."""

import importlib.util
import re
import socket
import subprocess
import sys

import numpy as np
import pytest
from inspection import SCRIPT, Served

from conftest import ROOT, need

pytestmark = pytest.mark.kit

VIEW = "scripts/view_panda.py"
NO_DISPLAY = {"DISPLAY": "", "WAYLAND_DISPLAY": ""}
ON_LINUX = sys.platform.startswith("linux")


@pytest.fixture
def viser() -> None:
    need(importlib.util.find_spec("viser") is not None, "viser: make view")


def run_after(preparation: str, *arguments: object) -> subprocess.CompletedProcess[str]:
    """Run the script in a Python that was prepared first."""
    code = (
        f"import runpy, sys; sys.argv[:] = {[str(SCRIPT), *map(str, arguments)]!r}\n"
        f"sys.path.insert(0, {str(SCRIPT.parent)!r})\n"
        f"{preparation}\n"
        "runpy.run_path(sys.argv[0], run_name='__main__')"
    )
    return subprocess.run(
        [sys.executable, "-c", code],
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )


def is_refused(done, *says: str) -> bool:
    """Return whether it ended with exit code 2 and one line, which has these words."""
    line = done.stderr
    one = line.startswith("error: ") and line.count("\n") == 1
    return done.returncode == 2 and one and all(word in line for word in says)


def test_help_shows_every_way_to_look_and_fits_80_columns(run):
    said = run(VIEW, "--help", COLUMNS=80).stdout
    for way in ("--clip", "--native", "--screenshot", "--port", "make view"):
        assert way in said
    assert max(map(len, said.splitlines())) <= 80


def test_it_prints_the_robot_the_address_one_ssh_line_and_ends_with_ctrl_c(viser):
    with Served("--port", "0") as server:
        assert server.press_ctrl_c() == 0
    lines = server.said.splitlines()
    assert lines[0].startswith("robot: Franka Panda (panda_nohand), ")
    assert lines[1].startswith(f"inspector: {server.url} ")
    ssh = [line.strip() for line in lines if line.strip().startswith("ssh ")]
    assert len(ssh) == 1
    end = f"{server.port}:127.0.0.1:{server.port}"
    assert re.fullmatch(rf"ssh -L {end} \S+@\S+", ssh[0])
    assert "viser" not in server.said  # its own banner would say it all twice
    assert server.said.endswith("\ninspector stopped\n")
    assert "Traceback" not in server.said


def test_a_taken_port_moves_to_the_next_free_one_and_says_so(viser):
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        taken = other.getsockname()[1]
        with Served("--port", str(taken)) as server:
            pass
    assert server.port > taken
    assert f"port {taken} is taken; using {server.port}\n" in server.said


def test_two_inspectors_at_once_get_a_port_each(viser):
    with Served("--port", "0") as first, Served("--port", str(first.port)) as second:
        pass
    assert second.port != first.port


def test_no_free_port_at_all_is_one_clear_line(viser, monkeypatch):
    from labkit.inspector import serve
    from robo47.errors import Robo47Error

    monkeypatch.setattr(serve, "PORTS_TRIED", 1)
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        with pytest.raises(Robo47Error, match="choose another, such as --port"):
            serve.free_port(other.getsockname()[1])


@pytest.mark.parametrize("wrong", ["70000", "-1", "http"])
def test_a_port_that_is_none_is_refused(run, wrong):
    done = run(VIEW, "--web", f"--port={wrong}")
    assert done.returncode == 2
    assert "argument --port" in done.stderr


def test_without_viser_it_names_the_command_that_installs_it():
    hide = (
        "import importlib.util as u; find = u.find_spec\n"
        "u.find_spec = lambda name, *a: None if name == 'viser' else find(name, *a)"
    )
    assert is_refused(run_after(hide, "--web"), "`make view` installs it")
    # the browser is the default, whatever display there is
    assert is_refused(run_after(hide), "the inspector needs viser")


@pytest.mark.skipif(not ON_LINUX, reason="only Linux tells by its environment")
def test_without_a_display_the_window_is_refused_in_one_line_that_names_the_browser(
    run,
):
    done = run(VIEW, "--native", **NO_DISPLAY)
    assert is_refused(done, "no display", "make view")


@pytest.mark.skipif(not ON_LINUX, reason="only Linux tells by its environment")
def test_a_display_that_is_not_there_does_not_end_the_process_by_surprise(run):
    done = run(VIEW, "--native", DISPLAY=":4747", WAYLAND_DISPLAY="")
    assert is_refused(done, "make view")


def test_a_day_that_is_not_there_is_one_line(run):
    assert is_refused(run(VIEW, "99"), "no day 99")


def test_a_clip_never_replaces_a_file_and_knows_its_endings(run, tmp_path):
    path = tmp_path / "arm.gif"
    path.write_text("mine")
    assert is_refused(run(VIEW, "1", "--clip", path))
    assert path.read_text() == "mine"
    done = run(VIEW, "1", "--clip", tmp_path / "arm.mp4")
    assert is_refused(done, ".gif or .webp")


def test_a_clip_of_a_file_that_is_not_there_is_one_line(run, tmp_path):
    done = run(VIEW, "1", "--clip", tmp_path / "a.gif", "--file", tmp_path / "no.py")
    assert is_refused(done)


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
def test_a_screenshot_cuts_nothing_off(run, tmp_path, start):
    image = pytest.importorskip("PIL.Image")
    path = tmp_path / "new" / "arm.png"
    done = run(VIEW, "--screenshot", path, "--start", start)
    assert done.returncode == 0, done.stderr
    picture = np.asarray(image.open(path).convert("L"))
    edges = [picture[:5], picture[-5:], picture[:, :5], picture[:, -5:]]
    assert picture.min() < 60
    assert min(int(edge.min()) for edge in edges) > 150  # floor and sky alone


def test_an_option_that_cannot_be_honoured_is_refused(run, tmp_path):
    done = run(VIEW, "--screenshot", tmp_path / "a.png", "--entry", "panda")
    assert is_refused(done, "--entry is for --web")
    assert is_refused(run(VIEW, "--web", "--file", "a.py"), "--file is for --clip")


def test_a_screenshot_never_replaces_a_file(tmp_path):
    path = tmp_path / "mine.png"
    path.write_text("mine")
    assert is_refused(run_after("", "--screenshot", path))
    assert path.read_text() == "mine"


def test_without_the_means_to_draw_a_screenshot_says_what_installs_them(tmp_path):
    path = tmp_path / "arm.png"
    done = run_after("sys.modules['PIL'] = None", "--screenshot", path)
    assert is_refused(done, "make view ARGS=--screenshot")
    assert not path.exists()
