"""Which OpenGL backend draws: the choice, the memory of it, and the messages."""

import os

import pytest

from labkit.base import store
from labkit.figures import backends
from robo47.errors import Robo47Error

pytestmark = pytest.mark.kit


@pytest.fixture(autouse=True)
def clean_slate(monkeypatch, tmp_path):
    monkeypatch.delenv("MUJOCO_GL", raising=False)
    monkeypatch.setattr(backends, "ROOT", tmp_path)


@pytest.fixture
def on_linux(monkeypatch):
    monkeypatch.setattr("sys.platform", "linux")


@pytest.fixture
def probed(monkeypatch):
    """Replace the probe: only osmesa draws; return the list of what was tried."""
    tried = []

    def probe(variables):
        tried.append(variables.get("MUJOCO_GL", os.environ.get("MUJOCO_GL", "")))
        return "renders" if tried[-1] == "osmesa" else "ImportError: no library"

    monkeypatch.setattr(backends, "probe", probe)
    return tried


@pytest.mark.usefixtures("on_linux")
def test_the_first_backend_that_draws_is_taken_and_remembered(probed):
    for _ in range(2):
        assert backends.rendering_environment()["MUJOCO_GL"] == "osmesa"
        assert probed == ["egl", "osmesa"]


@pytest.mark.usefixtures("on_linux")
def test_it_is_looked_for_again_when_it_fails_or_the_machine_changes(
    probed, monkeypatch
):
    backends.rendering_environment()
    backends.rendering_environment(forget=True)
    assert probed == ["egl", "osmesa"] * 2
    monkeypatch.setattr("platform.node", lambda: "another machine")
    backends.rendering_environment()
    assert probed == ["egl", "osmesa"] * 3


@pytest.mark.usefixtures("on_linux")
@pytest.mark.parametrize("garbage", ["", "{", "[]", '{"key": 1}'])
def test_a_broken_memory_is_ignored(probed, garbage):
    store.write_text(backends.NAME, garbage, backends.ROOT)
    assert backends.rendering_environment()["MUJOCO_GL"] == "osmesa"
    assert probed == ["egl", "osmesa"]


@pytest.mark.usefixtures("on_linux", "probed")
def test_a_clone_that_cannot_be_written_to_is_no_obstacle(monkeypatch, tmp_path):
    (tmp_path / "file").write_text("")
    monkeypatch.setattr(backends, "ROOT", tmp_path / "file")
    assert backends.rendering_environment()["MUJOCO_GL"] == "osmesa"


@pytest.mark.usefixtures("on_linux")
def test_the_users_own_choice_is_the_only_one_tried(probed, monkeypatch):
    monkeypatch.setenv("MUJOCO_GL", "osmesa")
    assert backends.rendering_environment() == dict(os.environ)
    assert probed == ["osmesa"]


@pytest.mark.usefixtures("on_linux", "probed")
def test_the_users_own_choice_is_never_overruled(monkeypatch):
    monkeypatch.setenv("MUJOCO_GL", "egl")
    with pytest.raises(
        Robo47Error, match=r"MUJOCO_GL=egl .*apt install libegl1 libgl1"
    ):
        backends.rendering_environment()
    assert os.environ["MUJOCO_GL"] == "egl"


@pytest.mark.parametrize("system", ["darwin", "win32"])
def test_macos_and_windows_keep_their_default(monkeypatch, system):
    monkeypatch.setattr("sys.platform", system)
    monkeypatch.setattr(backends, "probe", lambda variables: "renders")
    assert "MUJOCO_GL" not in backends.rendering_environment()
    assert all(variables == {} for variables in backends.candidates().values())


@pytest.mark.parametrize(
    ("system", "says"),
    [("linux", r"libegl1 libgl1 \(or libosmesa6\)"), ("darwin", "no such driver")],
)
def test_where_nothing_draws_the_packages_or_the_reason_is_named(
    monkeypatch, system, says
):
    monkeypatch.setattr("sys.platform", system)
    monkeypatch.setattr(backends, "probe", lambda variables: "no such driver")
    with pytest.raises(Robo47Error, match=says) as found:
        backends.rendering_environment()
    assert "\n" not in str(found.value)


def test_a_backend_that_mujoco_refuses_is_a_reason_not_a_crash():
    assert "invalid value" in backends.probe({"MUJOCO_GL": "nonsense"})


def test_a_driver_that_hangs_or_dies_in_silence_is_told(monkeypatch):
    monkeypatch.setattr(backends, "PROBE", "import os; os._exit(3)")
    assert backends.probe({}) == "ended with exit code 3"
    monkeypatch.setattr(backends, "PROBE", "import time; time.sleep(60)")
    monkeypatch.setattr(backends, "TIMEOUT", 0.2)
    assert "no picture within" in backends.probe({})


@pytest.mark.usefixtures("on_linux", "probed")
def test_the_doctor_hears_about_every_backend():
    assert backends.probe_backends() == {
        "egl": "ImportError: no library",
        "osmesa": "renders",
        "glfw": "ImportError: no library",
    }
