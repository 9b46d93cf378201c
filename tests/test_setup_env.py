"""Set-up: does nothing when nothing changed, and names the missing thing."""

import errno
import importlib.util
import os
import re
import subprocess
import sys
import tomllib
from types import SimpleNamespace

import pytest

from conftest import ROOT
from labkit.base import shell
from labkit.commands import pins
from robo47.errors import Robo47Error

pytestmark = pytest.mark.kit

NOW = sys.version_info[:2]


def load():
    path = ROOT / "scripts" / "setup_env.py"
    spec = importlib.util.spec_from_file_location("setup_env", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def setup(monkeypatch, tmp_path):
    """The script as a module, pointed at an empty folder, running no real command."""
    module = load()
    for name in ("pyproject.toml", "constraints.txt"):
        (tmp_path / name).write_text((ROOT / name).read_text("utf-8"), "utf-8")
    monkeypatch.setattr(module, "ROOT", tmp_path)
    monkeypatch.setattr(module.shutil, "which", lambda name: None)
    module.commands = []
    module.answers = {}
    module.version = NOW
    module.imported = NOW

    def run(command, doing):
        module.commands.append([str(part) for part in command])
        if "venv" in module.commands[-1]:
            inside = os.path.join(module.commands[-1][-1], module.processes.IN_VENV)
            os.makedirs(os.path.dirname(inside), exist_ok=True)
            open(inside, "w").close()
        for word, answer in module.answers.items():
            if word in module.commands[-1]:
                if isinstance(answer, BaseException):
                    raise answer
                return answer
        return 0, ""

    monkeypatch.setattr(module, "run", run)
    known = {module.IMPORTED: lambda: module.imported}
    monkeypatch.setattr(
        module,
        "ask",
        lambda python, imports: known.get(imports, lambda: module.version)(),
    )
    return module


def call(setup, monkeypatch, *extras):
    monkeypatch.setattr(sys, "argv", ["setup_env.py", *extras])
    setup.commands.clear()
    setup.main()
    return setup.commands


def test_the_first_run_makes_and_fills_the_environment_the_next_does_nothing(
    setup, monkeypatch
):
    make, install = call(setup, monkeypatch)
    assert make[1:3] == ["-m", "venv"]
    assert install[-2:] == ["--editable", "."]
    assert "constraints.txt" in install
    assert call(setup, monkeypatch) == []


@pytest.mark.parametrize("name", ["pyproject.toml", "constraints.txt"])
def test_a_changed_list_is_installed_again_into_the_same_environment(
    setup, monkeypatch, name
):
    call(setup, monkeypatch)
    with open(os.path.join(setup.ROOT, name), "a") as file:
        file.write("# new\n")
    assert len(call(setup, monkeypatch)) == 1


def test_an_extra_is_installed_once_and_another_folder_is_another_environment(
    setup, monkeypatch
):
    call(setup, monkeypatch)
    (install,) = call(setup, monkeypatch, "test")
    assert install[-1] == ".[test]"
    assert call(setup, monkeypatch, "test") == []
    make, install = call(setup, monkeypatch, "--venv", ".venv-bench", "bench")
    assert make[-1].endswith(".venv-bench")
    assert install[-1] == ".[bench]"


def test_an_environment_without_a_stamp_or_a_python_or_pip_is_not_whole(tmp_path):
    real, venv = load(), tmp_path / "v"
    python = venv / real.processes.IN_VENV
    assert real.made_with(venv) is None
    python.parent.mkdir(parents=True)
    python.symlink_to(sys.executable)
    assert real.made_with(venv) is None
    (venv / ".made").write_bytes(b"")
    assert real.made_with(venv) == NOW
    python.unlink()
    assert real.made_with(venv) is None
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", venv], check=True)
    assert real.made_with(venv) is None


def test_an_environment_that_uv_filled_is_whole_and_one_that_it_began_is_not(tmp_path):
    real, venv = load(), tmp_path / "v"
    subprocess.run([sys.executable, "-m", "venv", venv], check=True)
    assert real.made_with(venv) is None
    with (venv / "pyvenv.cfg").open("a") as file:
        file.write("uv = 0.13.9\n")
    assert real.made_with(venv) is None
    (package,) = venv.rglob("site-packages")
    (package / "mujoco.py").touch()
    assert real.made_with(venv) == NOW


def test_what_uv_and_pip_install_are_the_same_versions():
    constraints = (ROOT / "constraints.txt").read_text("utf-8")
    text = (ROOT / "pyproject.toml").read_text("utf-8")
    listed = tomllib.loads(text)["tool"]["uv"]["constraint-dependencies"]
    pinned = [line.partition("#")[0] for line in constraints.splitlines()]
    bare = [re.sub(r"\s", "", pin).replace('"', "'") for pin in pinned]
    assert {re.sub(r"\s", "", pin) for pin in listed} == set(bare) - {""}
    assert pins.with_pins(text, constraints) == text
    assert pins.with_pins(text, "numpy==1.0 # old") != text
    with pytest.raises(Robo47Error, match="0 lists"):
        pins.with_pins("[tool.uv]\n", constraints)


def test_uv_brings_all_that_make_may_put_into_the_environment():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
    extras = set(project["project"]["optional-dependencies"]) - {"bench"}
    (own,) = [d for d in project["dependency-groups"]["dev"] if d.startswith("robo47")]
    assert set(own.removeprefix("robo47[").removesuffix("]").split(",")) == extras


@pytest.mark.parametrize("step", ["venv", "pip"])
def test_what_is_killed_halfway_is_healed_by_the_next_run(setup, monkeypatch, step):
    setup.answers[step] = KeyboardInterrupt()
    with pytest.raises(KeyboardInterrupt):
        call(setup, monkeypatch)
    setup.answers.clear()
    again = call(setup, monkeypatch)
    assert len(again) == (2 if step == "venv" else 1)
    assert ("--force-reinstall" in again[-1]) == (step == "pip")
    assert call(setup, monkeypatch) == []


@pytest.mark.parametrize("content", [b"", b"\xff\xfe", b"old"])
def test_a_broken_stamp_is_no_stamp(setup, monkeypatch, content):
    call(setup, monkeypatch)
    with open(os.path.join(setup.ROOT, ".venv", ".ready-core"), "wb") as file:
        file.write(content)
    assert len(call(setup, monkeypatch)) == 1
    assert call(setup, monkeypatch) == []


def test_an_environment_that_works_keeps_its_python_and_says_so(
    setup, monkeypatch, capsys
):
    call(setup, monkeypatch)
    setup.version = (3, 99)
    assert call(setup, monkeypatch) == []
    said = capsys.readouterr().out
    assert ".venv keeps its Python 3.99; to change that:" in said
    assert "make setup PYTHON=" in said


def test_another_python_is_said_before_anything_is_made_anew(
    setup, monkeypatch, capsys
):
    call(setup, monkeypatch)
    with open(os.path.join(setup.ROOT, ".venv", "pyvenv.cfg"), "w") as file:
        file.write("home = /usr/bin\nversion = 3.99.1\n")
    setup.version = None
    assert len(call(setup, monkeypatch)) == 2
    said = capsys.readouterr().out
    assert ".venv (Python 3.99) is not whole; making it anew" in said
    assert ".venv had Python 3.99; it gets {}.{} now".format(*NOW) in said


def test_a_full_disk_is_told(setup, monkeypatch):
    full = OSError(errno.ENOSPC, "No space left on device")

    def write(path):
        raise full

    monkeypatch.setattr(setup, "write_stamp", write)
    assert "the disk is full" in said(setup, monkeypatch)


def test_two_at_once_wait_for_each_other(tmp_path):
    script = tmp_path / "hold.py"
    script.write_text(
        f"import pathlib, sys; sys.path.insert(0, {str(ROOT)!r})\n"
        "from labkit.base.store import alone\n"
        f"with alone('setup', pathlib.Path({str(tmp_path)!r})):\n"
        "    print('in', flush=True); sys.stdin.readline(); print('out', flush=True)\n"
    )

    def start():
        return subprocess.Popen(
            [sys.executable, script],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )

    with start() as first:
        assert first.stdout.readline() == "in\n"
        with start() as second:
            assert "waiting" in second.stdout.readline()
            first.kill()  # a killed one lets go
            assert second.stdout.readline() == "in\n"
            second.kill()


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


@pytest.fixture
def old(monkeypatch):
    """The script as a module, in a Python as if it were too old."""
    module = load()
    it = SimpleNamespace(version_info=(3, 9, 2), executable="python3", exit=sys.exit)
    monkeypatch.setattr(module, "sys", it)
    return module


@pytest.mark.parametrize("found", [None, "/usr/bin/false"])
def test_an_old_python_is_told_so_and_a_shim_is_none(old, monkeypatch, found):
    monkeypatch.setattr(old.shutil, "which", lambda name: found)
    with pytest.raises(SystemExit, match=r"this is Python 3\.9; the kit needs 3\.11"):
        old.find_python()


def test_anew_replaces_an_environment_that_works(setup, monkeypatch):
    call(setup, monkeypatch)
    assert "venv" in call(setup, monkeypatch, "--anew")[0]


def test_a_newer_python_on_the_path_is_used(old, monkeypatch):
    paths = {"python3.12": "/usr/bin/python3.12"}
    monkeypatch.setattr(old.shutil, "which", paths.get)
    monkeypatch.setattr(old, "ask", lambda python, imports: (3, 12))
    assert old.find_python() == ("/usr/bin/python3.12", (3, 12))


@pytest.mark.parametrize(
    ("step", "output", "words"),
    [
        ("venv", "The ... ensurepip is not", "install python3-venv"),
        ("pip", "Failed to establish a new connection", "index cannot be reached"),
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
    setup.answers.clear()
    assert "install" in call(setup, monkeypatch)[-1], "the next run tries again"


@pytest.mark.parametrize("ended", [(-9, "Collecting numpy"), (137, "")])
def test_an_install_that_was_killed_says_so(setup, monkeypatch, ended):
    setup.answers["pip"] = ended
    message = said(setup, monkeypatch)
    assert "killed" in message
    assert "memory" in message
    assert "run make again" in message


def test_what_was_installed_is_imported_before_it_is_ready(setup, monkeypatch):
    """pip may have put it elsewhere and been content."""
    setup.imported = None
    monkeypatch.setattr(setup, "failure", lambda venv: "No module named 'numpy'")
    message = said(setup, monkeypatch)
    assert "cannot be imported:\nNo module named 'numpy'" in message
    assert not os.path.exists(os.path.join(setup.ROOT, ".venv", ".ready-core"))
    setup.imported = NOW
    assert len(call(setup, monkeypatch)) == 1
    assert call(setup, monkeypatch) == []


NO_MATCH = "ERROR: No matching distribution found for mujoco==4.0.0"


@pytest.mark.parametrize(("version", "older"), [((3, 11), False), ((3, 99), True)])
def test_an_older_python_is_advised_only_where_it_is_older(
    setup, monkeypatch, version, older
):
    setup.version = version
    setup.answers["pip"] = (1, "noise\n" * 50 + NO_MATCH + "\n")
    monkeypatch.setattr(setup, "provide", lambda venv, anew, uv: made(venv, version))
    message = said(setup, monkeypatch)
    assert NO_MATCH in message
    assert message.count("noise") == 7
    assert ("An older Python has all: make setup PYTHON=python3.14" in message) == older
    assert "run make again" in message


def made(venv, version):
    venv.mkdir(exist_ok=True)
    return version


def test_pip_is_told_how_to_reach_its_packages_and_nothing_else():
    listed = (
        ":env:.user='1'\n"
        "global.cert='/ca.pem'\n"
        "global.constraint='/old.txt'\n"
        "global.extra-index-url='\\nhttps://a\\nhttps://b'\n"
        "global.index-url='https://global'\n"
        "global.user='true'\n"
        "install.index-url='https://install'\n"
    )
    variables = {
        "HOME": "/home/me",
        "HTTPS_PROXY": "http://proxy",
        "PIP_CACHE_DIR": "/cache",
        "PIP_CONFIG_FILE": "/theirs",
        **dict.fromkeys(
            [
                "PIP_USER",
                "PIP_TARGET",
                "PIP_PREFIX",
                "PIP_ROOT",
                "PIP_CONSTRAINT",
                "PIP_REQUIREMENT",
                "PIP_REQUIRE_HASHES",
                "PIP_NO_BINARY",
                "PIP_NO_DEPS",
                "PIP_PYTHON",
                "PIP_DRY_RUN",
                "UV_CONSTRAINT",
                "UV_SYSTEM_PYTHON",
            ],
            "1",
        ),
    }
    assert shell.for_installer(variables, listed) == {
        "HOME": "/home/me",
        "HTTPS_PROXY": "http://proxy",
        "PIP_CACHE_DIR": "/cache",
        "PIP_CERT": "/ca.pem",
        "PIP_EXTRA_INDEX_URL": "https://a https://b",
        "PIP_INDEX_URL": "https://install",
        "PIP_CONFIG_FILE": os.devnull,
    }
    own = {"PIP_INDEX_URL": "https://mine", "UV_INDEX_URL": "https://mine"}
    assert shell.for_installer(own, listed)["PIP_INDEX_URL"] == "https://mine"
    assert shell.for_installer(own) == own


@pytest.mark.network
def test_settings_for_other_work_do_not_reach_a_real_pip(tmp_path):
    """Each of them broke set-up, or put its packages elsewhere."""
    real, venv = load(), tmp_path / "v"
    subprocess.run([sys.executable, "-m", "venv", venv], check=True)
    python = str(venv / real.processes.IN_VENV)
    config = tmp_path / "pip.conf"
    config.write_text("[global]\nuser = true\nrequire-hashes = true\n")
    (tmp_path / "old.txt").write_text("tqdm<4\n")
    others = {
        "PIP_CONFIG_FILE": str(config),
        "PIP_CONSTRAINT": str(tmp_path / "old.txt"),
        "PIP_PREFIX": str(tmp_path / "prefix"),
        "PIP_TARGET": str(tmp_path / "target"),
        "PIP_NO_BINARY": ":all:",
    }
    with pytest.MonkeyPatch.context() as patch:
        for name, value in others.items():
            patch.setenv(name, value)
        code, said = real.run([python, "-m", "pip", "install", "tqdm"], "trying")
    assert code == 0, said
    assert real.ask(python, "import tqdm") == NOW
