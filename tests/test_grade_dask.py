"""A class on a Dask cluster of this machine, over TLS: two workers, one killed."""

import contextlib
import importlib.util
import json
import os
import shutil
import signal
import subprocess
import sys
import time

import pytest
from make_class import make_class
from test_grade_class import IN_TIME, command_of, grade, journalled, outputs, rows

from conftest import need

pytestmark = pytest.mark.kit


@pytest.fixture
def certificates(tmp_path, monkeypatch):
    """Make certificates as docs/cluster.md does, and tell Dask in the environment."""
    need(shutil.which("openssl") is not None, "openssl")
    ca, own = "-keyout ca.key -out ca.pem", "-keyout class.key -out class.csr"
    sign = "-in class.csr -CA ca.pem -CAkey ca.key -CAcreateserial -out class.pem"
    for command in (
        f"req -x509 -newkey rsa:2048 -nodes -days 2 -subj /CN=class-ca {ca}",
        f"req -newkey rsa:2048 -nodes -subj /CN=class {own}",
        f"x509 -req -days 2 {sign}",
    ):
        done = subprocess.run(
            ["openssl", *command.split()],
            cwd=tmp_path,
            capture_output=True,
            check=False,
        )
        assert done.returncode == 0, done.stderr
    prefix = "DASK_DISTRIBUTED__COMM__TLS"
    monkeypatch.setenv(f"{prefix}__CA_FILE", str(tmp_path / "ca.pem"))
    for role in ("CLIENT", "SCHEDULER", "WORKER"):
        monkeypatch.setenv(f"{prefix}__{role}__CERT", str(tmp_path / "class.pem"))
        monkeypatch.setenv(f"{prefix}__{role}__KEY", str(tmp_path / "class.key"))


@pytest.fixture
def cluster(tmp_path, certificates):
    """Start a scheduler and two workers on loopback; return its address and them."""
    need(importlib.util.find_spec("distributed") is not None, "the extra grade: Dask")
    with contextlib.ExitStack() as ends:
        log = ends.enter_context((tmp_path / "dask.log").open("wb"))

        def start(what, *arguments):
            command = [sys.executable, "-m", f"distributed.cli.dask_{what}", *arguments]
            command += ["--host", "127.0.0.1", "--no-dashboard"]
            process = subprocess.Popen(command, stdout=log, stderr=log, cwd=tmp_path)
            ends.enter_context(process)  # waits for it
            ends.callback(process.kill)
            return process

        found = tmp_path / "scheduler.json"
        tls = ("--protocol", "tls", "--port", "0", "--scheduler-file", str(found))
        start("scheduler", *tls)
        wait_for(lambda: found.exists() and found.read_text().rstrip().endswith("}"))
        address = json.loads(found.read_text())["address"]
        assert address.startswith("tls://")
        workers = []
        for i in range(2):
            own = tmp_path / f"worker{i}"
            arguments = ("--nthreads", "1", "--no-nanny", "--local-directory", str(own))
            workers.append(start("worker", address, *arguments))
        yield address, workers


def wait_for(condition):
    """Wait until something is so."""
    deadline = time.monotonic() + 90
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.05)


def grade_and_kill_one(clones, out, address, worker, number):
    """Grade on the cluster and kill a worker once so many are graded."""
    process = subprocess.Popen(
        command_of(clones, out, *IN_TIME, "--dask", address),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        encoding="utf-8",
        env={**os.environ, "PYTHONIOENCODING": "utf-8"},
    )
    journal = out / "grading.jsonl"
    wait_for(lambda: journal.exists() and journal.read_bytes().count(b"\n") > number)
    assert process.poll() is None
    worker.send_signal(getattr(signal, "SIGKILL", signal.SIGTERM))
    said, complained = process.communicate(timeout=600)
    assert process.returncode == 0, complained
    return said


@pytest.mark.parametrize(
    ("students", "killed_at"),
    [
        (8, 1),
        pytest.param(40, 3, marks=pytest.mark.soak),
        pytest.param(200, 60, marks=pytest.mark.soak),
    ],
)
def test_a_cluster_gives_the_same_bytes_though_a_worker_is_killed(
    tmp_path, cluster, students, killed_at
):
    address, (first, second) = cluster
    clones, here, there = (tmp_path / name for name in ("clones", "here", "there"))
    make_class(clones, students)
    grade(clones, here, *IN_TIME)
    said = grade_and_kill_one(clones, there, address, first, killed_at)
    assert f"graded now: {students};" in said
    assert second.poll() is None
    assert outputs(there) == outputs(here)
    assert len(rows(there)) == students
    assert max(n for folder, n in journalled(there).items() if folder) == 1


def test_who_has_no_certificate_reaches_nobody(tmp_path, cluster, monkeypatch):
    address, _ = cluster
    make_class(tmp_path / "clones", 1)
    for name in [n for n in os.environ if n.startswith("DASK_DISTRIBUTED__COMM__TLS")]:
        monkeypatch.delenv(name)
    for asked in (address, address.replace("tls:", "tcp:")):
        done = grade(tmp_path / "clones", tmp_path, "--dask", asked)
        assert done.returncode == 2
        assert "certificates" in done.stderr or "no Dask scheduler" in done.stderr


def test_without_a_scheduler_or_without_dask_it_is_said_in_a_line(tmp_path):
    make_class(tmp_path / "clones", 1)
    done = grade(tmp_path / "clones", tmp_path, "--dask", "tcp://127.0.0.1:1")
    assert done.returncode == 2
    installed = importlib.util.find_spec("distributed") is not None
    says = "no Dask scheduler at" if installed else "--dask needs the package"
    assert says in done.stderr
