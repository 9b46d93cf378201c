"""Fetching the robot: every source, the order, and what is refused."""

import hashlib
import json
import shutil
import subprocess
import tarfile

import pytest

from conftest import ROOT
from robo47.panda import files as menagerie

pytestmark = pytest.mark.kit

SCRIPT = "scripts/fetch_menagerie.py"
NOWHERE = "http://127.0.0.1:9"  # the discard port: refused at once


@pytest.fixture
def fresh(tmp_path, monkeypatch):
    """A clone's worth of kit without a robot, in a folder of its own."""
    clone = tmp_path / "clone"
    for part in ("robo47", "labkit", "scripts"):
        ignore = shutil.ignore_patterns("__pycache__")
        shutil.copytree(ROOT / part, clone / part, ignore=ignore)
    monkeypatch.delenv("MENAGERIE_ROOT", raising=False)
    monkeypatch.setenv("PYTHONPATH", str(clone))
    monkeypatch.setenv("MENAGERIE_BASE_URL", NOWHERE)
    return clone


@pytest.fixture
def fetch(run, fresh):
    def fetch_script(*arguments, **environment):
        return run(fresh / SCRIPT, *arguments, cwd=fresh, **environment)

    return fetch_script


def no_index(**more):
    """Environment in which pip reaches no index at all."""
    offline = {
        "PIP_NO_INDEX": "1",
        "PIP_FIND_LINKS": "",
        "PIP_CONFIG_FILE": "/dev/null",
    }
    return offline | more


def robot(root):
    return root / menagerie.PANDA


def test_without_any_source_it_says_so_leaves_nothing_and_exits_2(fetch, fresh):
    done = fetch(**no_index())
    assert done.returncode == 2
    assert "Traceback" not in done.stderr
    assert "no source of the Panda answered" in done.stderr
    assert "embedded twin" in done.stderr
    assert list((fresh / "mujoco_menagerie").iterdir()) == []


def test_make_asks_once_a_day_where_nobody_answers(fetch, fresh):
    first = fetch("--daily", **no_index())
    assert (first.returncode, "asking" in first.stdout) == (2, True)
    again = fetch("--daily", **no_index())
    assert (again.returncode, again.stdout, again.stderr) == (0, "", "")
    asked = fetch(**no_index())
    assert "asking" in asked.stdout, "somebody who asks gets an answer"
    (fresh / ".robo47" / "robot-asked").write_text("1999-12-31")
    assert "asking" in fetch("--daily", **no_index()).stdout


@pytest.mark.parametrize("content", ["[]", "{}", '{"source": 1}', "", '{"sour', "nul"])
def test_a_broken_record_is_written_anew(fetch, fresh, real_panda, content):
    shutil.copytree(real_panda, robot(fresh / "mujoco_menagerie"))
    record = fresh / "mujoco_menagerie/PROVENANCE.json"
    record.write_text(content)
    done = fetch(**no_index())
    assert (done.returncode, done.stderr) == (0, "")
    assert json.loads(record.read_text())["source"] == "a copy of the Menagerie"


def test_what_a_killed_run_left_behind_is_cleared_away(fetch, fresh):
    left = fresh / "mujoco_menagerie" / ".fetch-1234"
    left.mkdir(parents=True)
    fetch(**no_index())
    assert not left.exists()


def test_a_copy_that_is_there_is_kept_and_recorded(fetch, fresh, real_panda):
    shutil.copytree(real_panda, robot(fresh / "mujoco_menagerie"))
    before = menagerie.hash_files(fresh / "mujoco_menagerie")
    done = fetch(**no_index())
    assert (done.returncode, done.stderr) == (0, "")
    assert "a copy of the Menagerie" in done.stdout
    record = json.loads((fresh / "mujoco_menagerie/PROVENANCE.json").read_text())
    assert record["files"] == menagerie.hash_files(robot(fresh / "mujoco_menagerie"))
    after = menagerie.hash_files(fresh / "mujoco_menagerie")
    after.pop("PROVENANCE.json")
    assert after == before


def test_a_clone_is_recorded_with_its_commit(fetch, fresh, real_panda):
    root = fresh / "mujoco_menagerie"
    shutil.copytree(real_panda, robot(root))
    git = ["git", "-C", str(root), "-c", "user.name=a", "-c", "user.email=a@b"]
    for command in (["init", "-q"], ["add", "."], ["commit", "-qm", "robots"]):
        subprocess.run([*git, *command], check=True)
    head = subprocess.run(
        [*git, "rev-parse", "HEAD"], capture_output=True, text=True, check=True
    )
    done = fetch(**no_index())
    assert "a clone of the Menagerie" in done.stdout
    assert head.stdout.strip() in done.stdout


def test_menagerie_root_is_used_and_nothing_is_written_there(
    fetch, tmp_path, real_panda
):
    root = tmp_path / "mine"
    shutil.copytree(real_panda, robot(root))
    before = menagerie.hash_files(root)
    done = fetch(**no_index(MENAGERIE_ROOT=root))
    assert done.returncode == 0
    assert menagerie.hash_files(root) == before


def test_a_menagerie_root_without_a_panda_is_refused(fetch, tmp_path):
    done = fetch(**no_index(MENAGERIE_ROOT=tmp_path))
    assert done.returncode == 2
    assert "has no folder franka_emika_panda" in done.stderr


def test_an_incomplete_copy_is_refused_and_left_as_it_is(fetch, fresh, real_panda):
    folder = robot(fresh / "mujoco_menagerie")
    shutil.copytree(real_panda, folder)
    (folder / "assets" / "link1.obj").unlink()
    done = fetch(**no_index())
    assert done.returncode == 2
    assert "lacks 1 file(s)" in done.stderr
    assert "link1.obj" in done.stderr
    assert (folder / "panda.xml").exists()
    assert not (fresh / "mujoco_menagerie/PROVENANCE.json").exists()


def test_verify_names_every_file_that_changed(fetch, fresh, real_panda):
    folder = robot(fresh / "mujoco_menagerie")
    shutil.copytree(real_panda, folder)
    assert fetch(**no_index()).returncode == 0
    total = len(menagerie.hash_files(folder))
    assert f"{total} of {total} files match" in fetch("--verify").stdout
    with (folder / "hand.xml").open("a") as file:
        file.write("<!-- mine -->")
    done = fetch("--verify")
    assert done.returncode == 1
    assert "hand.xml: changed" in done.stdout
    assert "fetch it anew" in done.stdout


def test_show_and_verify_without_a_robot_say_what_to_do(fetch):
    for option in ("--show", "--verify"):
        done = fetch(option)
        assert done.returncode == 2
        assert "first: make robot" in done.stderr


@pytest.fixture
def official(tmp_path, monkeypatch, real_panda):
    """A stand-in for the official server, and the package pinned to its archive."""
    import mujoco_menagerie as mm

    served = tmp_path / "served"
    served.mkdir()
    archive = served / mm.get(menagerie.PANDA).asset
    with tarfile.open(archive, "w:xz", preset=0) as tar:
        tar.add(real_panda, arcname=menagerie.PANDA)
    monkeypatch.setenv("MENAGERIE_BASE_URL", served.as_uri())
    return archive


def test_an_archive_that_does_not_match_its_sha256_is_refused(fetch, fresh, official):
    done = fetch(**no_index(MENAGERIE_BASE_URL=official.parent.as_uri()))
    assert done.returncode == 2
    assert "does not match" in done.stdout
    assert not robot(fresh / "mujoco_menagerie").exists()


def test_the_official_package_fills_the_folder(fetch, fresh, official, tmp_path):
    # The real archive is out of reach of a test without a network, so the package's
    # registry is told the hash of ours: everything else is the package's own code.
    sitecustomize = tmp_path / "pin"
    sitecustomize.mkdir()
    digest = hashlib.sha256(official.read_bytes()).hexdigest()
    (sitecustomize / "sitecustomize.py").write_text(f"""
import dataclasses, mujoco_menagerie as mm
real = mm.get
mm.get = lambda name: dataclasses.replace(
    real(name), sha256={digest!r}, download_size={official.stat().st_size})
""")
    done = fetch(
        **no_index(
            MENAGERIE_BASE_URL=official.parent.as_uri(),
            PYTHONPATH=f"{sitecustomize}:{fresh}",
        )
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "mujoco-menagerie 20" in done.stdout
    record = json.loads((fresh / "mujoco_menagerie/PROVENANCE.json").read_text())
    assert len(record["commit"]) == 40
    assert record["files"] == menagerie.hash_files(robot(fresh / "mujoco_menagerie"))
    assert [p.name for p in sorted((fresh / "mujoco_menagerie").iterdir())] == [
        "PROVENANCE.json",
        menagerie.PANDA,
    ]


@pytest.mark.network
def test_the_package_index_alone_is_enough_and_the_second_run_does_nothing(
    fetch, fresh
):
    done = fetch()
    assert done.returncode == 0, done.stdout + done.stderr
    assert "genesis-world" in done.stdout
    files = set(menagerie.hash_files(robot(fresh / "mujoco_menagerie")))
    xml = {name for name in files if name.endswith(".xml")}
    assert xml == {"panda.xml", "panda_nohand.xml", "hand.xml", "scene.xml"}
    again = fetch(**no_index())
    assert again.returncode == 0
    assert "asking" not in again.stdout
    assert fetch("--verify").returncode == 0
