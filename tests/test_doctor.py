"""The doctor: it answers on any machine, and says nothing of who asks."""

import getpass
import json
import subprocess
import sys
from pathlib import Path

import pytest

from labkit.commands import doctor
from robo47.paths import ROOT

pytestmark = pytest.mark.kit


@pytest.fixture
def answers(monkeypatch):
    """Let the doctor's probes answer what is given: {probe: (value, why)}."""

    def use(given):
        monkeypatch.setattr(
            doctor, "probe", lambda _, code, gl=False: given.get(code, (None, "?"))
        )

    return use


def test_it_has_a_line_on_everything_and_names_no_home_or_user(
    run, monkeypatch, capsys
):
    done = run("scripts/doctor.py", "--json")
    lines = json.loads(done.stdout)
    about = "kit Python platform shell MuJoCo robot lessons names wall pictures"
    about += " display disk git"
    assert [line["about"] for line in lines] == about.split()
    assert done.returncode == any(line["status"] == "todo" for line in lines)
    assert not done.stderr
    # The same as text, without looking at everything once more.
    monkeypatch.setattr(doctor, "examine", lambda: [doctor.Line(**x) for x in lines])
    monkeypatch.setattr(sys, "argv", ["doctor.py"])
    monkeypatch.setenv("COLUMNS", "80")
    assert doctor.main() == done.returncode
    said = capsys.readouterr().out
    assert max(map(len, said.splitlines())) <= 80
    assert said.count("\n") >= len(lines)
    assert str(Path.home()) + "/" not in said
    assert str(ROOT) not in said


@pytest.mark.parametrize(
    ("bare", "broken", "says"),
    [
        (["-I", "-S"], False, "Set up: make day1"),
        ([], True, ".venv does not start: make setup"),
    ],
)
def test_it_runs_on_a_bare_python_and_tells_a_broken_one(clone, bare, broken, says):
    if broken:
        python = clone / doctor.VENV_PYTHON.relative_to(ROOT)
        python.parent.mkdir(parents=True)
        python.write_text("gone")
    command = [sys.executable, *bare, str(clone / "scripts" / "doctor.py")]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert says in done.stdout
    assert "Traceback" not in done.stdout + done.stderr


def test_a_reader_that_leaves_early_gets_no_traceback(clone):
    with subprocess.Popen(
        [sys.executable, "-I", "-S", str(clone / "scripts" / "doctor.py")],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    ) as process:
        process.stdout.close()
        assert process.stderr.read() == b""


FOUR = {"mujoco": "4.0.0", "mujoco-core": "4.0.0"}
REPAIR = "--force-reinstall --no-deps mujoco mujoco-core"
COPY = {"source": "s", "commit": None, "content": "c", "files": 3, "folder": "here"}
CHANGED = {**COPY, "changed": ["link1.stl: changed"], "missing": []}
LAB = "w1-foundations/src/day1_transforms.py"


@pytest.mark.parametrize(
    ("check", "probe", "answer", "found", "remedy"),
    [
        ("mujoco", "VERSIONS", {**FOUR, "numpy": "2.4.6"}, "not work", REPAIR),
        ("mujoco", "VERSIONS", FOUR, "not work", "make setup"),  # NumPy is missing
        ("mujoco", "VERSIONS", {"numpy": "2.0"}, "not installed", "make setup"),
        ("python", "PYTHON", "3.9.2", "3.9.2", "3.11 or newer"),
        ("robot", "ROBOT", CHANGED, "link1.stl", "Delete here, then: "),
        ("gl", "GL", {"egl": "no library"}, "nothing draws", ""),
        ("lessons", "LESSONS", {"days": 1, "others": [LAB]}, "not the kit's",
         f"git checkout -- {LAB}"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_told_with_its_repair(
    answers, check, probe, answer, found, remedy
):
    answers({getattr(doctor, f"{probe}_PROBE"): (answer, "")})
    line = getattr(doctor, f"check_{check}")("python")
    assert line.status == "todo"
    assert found in line.found
    assert remedy in line.remedy


def test_the_back_ends_that_draw_are_named(answers):
    answers({doctor.GL_PROBE: ({"egl": "renders", "osmesa": "no library"}, "")})
    assert doctor.check_gl("python").found == "drawn with egl"


def test_a_mujoco_gl_that_does_not_draw_is_told_with_its_cure(answers, monkeypatch):
    monkeypatch.setenv("MUJOCO_GL", "nonsense")
    answers({doctor.GL_PROBE: ({"nonsense": "invalid value"}, "")})
    line = doctor.check_gl("python")
    assert (line.status, "MUJOCO_GL=nonsense" in line.found) == ("todo", True)
    assert line.remedy == "Unset it: unset MUJOCO_GL"


def test_a_wrong_mujoco_gl_is_no_fault_of_mujocos(monkeypatch):
    monkeypatch.setenv("MUJOCO_GL", "nonsense")
    assert doctor.check_mujoco(sys.executable).status == "good"


def test_a_check_that_fails_itself_is_one_line_of_the_findings(answers, monkeypatch):
    answers({})
    monkeypatch.setattr(doctor, "check_disk", lambda: 1 / 0)
    lines = doctor.examine()
    assert len(lines) == 13
    assert "ZeroDivisionError" in lines[11].found


@pytest.mark.parametrize(
    "text",
    [
        f"{ROOT}/.venv is broken",
        f"{Path.home()}/x: no",
        "No such file: '/home/ada/kit/x.py'",
        "/Users/ada/kit",
        "C:\\Users\\ada\\kit",
    ],
)
def test_paths_say_nothing_of_who_asks(text):
    said = doctor.discreet(text)
    assert "ada" not in said
    assert str(ROOT) not in said
    assert f"/{getpass.getuser()}/" not in said
