"""Set-up: does nothing when nothing changed, and names the missing thing."""

import importlib.util
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from conftest import ROOT


@pytest.fixture
def setup(monkeypatch, tmp_path):
    """The script as a module, pointed at an empty folder, running no real command."""
    path = ROOT / "scripts" / "setup_env.py"
    spec = importlib.util.spec_from_file_location("setup_env", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    for name in ("pyproject.toml", "constraints.txt"):
        (tmp_path / name).write_text((ROOT / name).read_text("utf-8"), "utf-8")
    monkeypatch.setattr(module, "ROOT", tmp_path)
    monkeypatch.setattr(module.shutil, "which", lambda name: None)
    module.commands = []
    module.answers = {}

    def run(command, doing):
        module.commands.append([str(part) for part in command])
        if "venv" in module.commands[-1]:
            Path(module.commands[-1][-1]).mkdir(exist_ok=True)
        for word, answer in module.answers.items():
            if word in module.commands[-1]:
                return answer
        return 0, ""

    monkeypatch.setattr(module, "run", run)
    monkeypatch.setattr(module, "works", lambda venv, version: venv.exists())
    return module


def call(setup, monkeypatch, *extras):
    monkeypatch.setattr(sys, "argv", ["setup_env.py", *extras])
    setup.commands.clear()
    setup.main()
    return setup.commands


def test_the_first_run_makes_and_fills_the_environment(setup, monkeypatch):
    make, install = call(setup, monkeypatch)
    assert make[1:3] == ["-m", "venv"]
    assert install[-2:] == ["--editable", "."]
    assert "constraints.txt" in install


def test_nothing_is_done_when_nothing_changed(setup, monkeypatch):
    call(setup, monkeypatch)
    assert call(setup, monkeypatch) == []


@pytest.mark.parametrize("name", ["pyproject.toml", "constraints.txt"])
def test_a_changed_list_is_installed_again_into_the_same_environment(
    setup, monkeypatch, name
):
    call(setup, monkeypatch)
    with (setup.ROOT / name).open("a") as file:
        file.write("# new\n")
    assert len(call(setup, monkeypatch)) == 1


def test_an_extra_is_installed_once_and_beside_the_core(setup, monkeypatch):
    call(setup, monkeypatch)
    (install,) = call(setup, monkeypatch, "test")
    assert install[-1] == ".[test]"
    assert call(setup, monkeypatch, "test") == []


def test_another_folder_is_another_environment(setup, monkeypatch):
    call(setup, monkeypatch)
    make, install = call(setup, monkeypatch, "--venv", ".venv-bench", "bench")
    assert make[-1].endswith(".venv-bench")
    assert install[-1] == ".[bench]"


def test_an_environment_that_does_not_start_or_is_too_old_is_made_anew(setup, tmp_path):
    spec = importlib.util.spec_from_file_location("real", ROOT / "scripts/setup_env.py")
    real = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(real)
    python = tmp_path / "v" / real.PYTHON_IN_VENV
    assert not real.works(tmp_path / "v", sys.version_info[:2])
    python.parent.mkdir(parents=True)
    python.symlink_to(sys.executable)
    assert real.works(tmp_path / "v", sys.version_info[:2])
    assert not real.works(tmp_path / "v", (3, 1))


def test_uv_is_used_where_it_is_installed(setup, monkeypatch):
    monkeypatch.setattr(setup.shutil, "which", lambda n: "/uv" if n == "uv" else None)
    make, install = call(setup, monkeypatch)
    assert make[:2] == ["/uv", "venv"]
    assert "--seed" in make, "fetching the robot needs pip"
    assert install[:3] == ["/uv", "pip", "install"]


def said(setup, monkeypatch):
    with pytest.raises(SystemExit) as caught:
        call(setup, monkeypatch)
    return str(caught.value.code)


def test_an_old_python_is_told_so(setup, monkeypatch):
    old = SimpleNamespace(version_info=(3, 9, 2), executable="python3", exit=sys.exit)
    monkeypatch.setattr(setup, "sys", old)
    with pytest.raises(SystemExit, match=r"this is Python 3\.9; the kit needs 3\.11"):
        setup.find_python()


def test_a_shim_that_starts_no_python_is_passed_over(setup, monkeypatch):
    old = SimpleNamespace(version_info=(3, 9, 2), executable="python3", exit=sys.exit)
    monkeypatch.setattr(setup, "sys", old)
    monkeypatch.setattr(setup.shutil, "which", lambda name: "/usr/bin/false")
    with pytest.raises(SystemExit, match=r"this is Python 3\.9"):
        setup.find_python()


def test_anew_replaces_an_environment_that_works(setup, monkeypatch):
    call(setup, monkeypatch)
    assert "venv" in call(setup, monkeypatch, "--anew")[0]


def test_a_newer_python_on_the_path_is_used(setup, monkeypatch):
    old = SimpleNamespace(version_info=(3, 9, 2), executable="python3", exit=sys.exit)
    monkeypatch.setattr(setup, "sys", old)
    paths = {"python3.12": "/usr/bin/python3.12"}
    monkeypatch.setattr(setup.shutil, "which", paths.get)
    monkeypatch.setattr(setup, "is_version", lambda python, version: True)
    assert setup.find_python() == ("/usr/bin/python3.12", (3, 12))


@pytest.mark.parametrize(
    ("step", "output", "words"),
    [
        (
            "venv",
            "The virtual environment ... ensurepip is not",
            "install python3-venv",
        ),
        (
            "pip",
            "Failed to establish a new connection",
            "package index cannot be reached",
        ),
        ("pip", "[Errno 28] No space left on device", "the disk is full"),
        ("pip", "ERROR: something else", "something else"),
    ],
)
def test_a_failure_names_what_is_missing_and_what_to_do(
    setup, monkeypatch, step, output, words
):
    setup.answers[step] = (1, output)
    message = said(setup, monkeypatch)
    assert words in message
    assert "run make again" in message


def test_a_failed_install_is_tried_again_next_time(setup, monkeypatch):
    setup.answers["pip"] = (1, "ERROR: something else")
    said(setup, monkeypatch)
    setup.answers.clear()
    assert len(call(setup, monkeypatch)) == 1
