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
from test_grade_class import (
    IN_TIME,
    command_of,
    grade,
    grade_here,
    journalled,
    outputs,
    rows,
)

from conftest import need
from labkit.grade import engine

pytestmark = pytest.mark.kit


@pytest.fixture(scope="module")
def certificates(tmp_path_factory):
    """Make certificates as docs/cluster.md does, and tell Dask in the environment."""
    need(shutil.which("openssl") is not None, "openssl")
    folder = tmp_path_factory.mktemp("certificates")
    ca, own = "-keyout ca.key -out ca.pem", "-keyout class.key -out class.csr"
    sign = "-in class.csr -CA ca.pem -CAkey ca.key -CAcreateserial -out class.pem"
    for command in (
        f"req -x509 -newkey rsa:2048 -nodes -days 2 -subj /CN=class-ca {ca}",
        f"req -newkey rsa:2048 -nodes -subj /CN=class {own}",
        f"x509 -req -days 2 {sign}",
    ):
        done = subprocess.run(
            ["openssl", *command.split()],
            cwd=folder,
            capture_output=True,
            check=False,
        )
        assert done.returncode == 0, done.stderr
    prefix = "DASK_DISTRIBUTED__COMM__TLS"
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(f"{prefix}__CA_FILE", str(folder / "ca.pem"))
        for role in ("CLIENT", "SCHEDULER", "WORKER"):
            patch.setenv(f"{prefix}__{role}__CERT", str(folder / "class.pem"))
            patch.setenv(f"{prefix}__{role}__KEY", str(folder / "class.key"))
        yield


@contextlib.contextmanager
def start(folder, what, *arguments):
    """Run a program of Dask on loopback until the block ends."""
    command = [sys.executable, "-m", f"distributed.cli.dask_{what}", *arguments]
    command += ["--host", "127.0.0.1", "--no-dashboard"]
    with (folder / f"{what}.log").open("ab") as log:
        process = subprocess.Popen(command, stdout=log, stderr=log, cwd=folder)
        with process:  # waits for it
            try:
                yield process
            finally:
                process.kill()


@pytest.fixture(scope="module")
def scheduler(tmp_path_factory, certificates):
    """Start a scheduler; return its address."""
    need(importlib.util.find_spec("distributed") is not None, "the extra grade: Dask")
    folder = tmp_path_factory.mktemp("scheduler")
    found = folder / "scheduler.json"
    tls = ("--protocol", "tls", "--port", "0", "--scheduler-file", str(found))
    with start(folder, "scheduler", *tls):
        wait_for(lambda: found.exists() and found.read_text().rstrip().endswith("}"))
        address = json.loads(found.read_text())["address"]
        assert address.startswith("tls://")
        yield address


@pytest.fixture
def workers(tmp_path, scheduler):
    """Start two workers of it; return them."""
    with contextlib.ExitStack() as ends:
        workers = []
        for i in range(2):
            own = tmp_path / f"worker{i}"
            arguments = ("--nthreads", "1", "--no-nanny", "--local-directory", str(own))
            it = start(tmp_path, "worker", scheduler, *arguments)
            workers.append(ends.enter_context(it))
        yield workers


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
    tmp_path, scheduler, workers, students, killed_at
):
    first, second = workers
    clones, here, there = (tmp_path / name for name in ("clones", "here", "there"))
    make_class(clones, students)
    grade_here(clones, here, *IN_TIME)
    engine.close_graders()
    said = grade_and_kill_one(clones, there, scheduler, first, killed_at)
    assert f"graded now: {students};" in said
    assert second.poll() is None
    assert outputs(there) == outputs(here)
    assert len(rows(there)) == students
    assert max(n for folder, n in journalled(there).items() if folder) == 1


def test_who_has_no_certificate_reaches_nobody(tmp_path, scheduler, monkeypatch):
    make_class(tmp_path / "clones", 1)
    for name in [n for n in os.environ if n.startswith("DASK_DISTRIBUTED__COMM__TLS")]:
        monkeypatch.delenv(name)
    for asked in (scheduler, scheduler.replace("tls:", "tcp:")):
        done = grade(tmp_path / "clones", tmp_path, "--dask", asked)
        assert done.returncode == 2
        assert "certificates" in done.stderr or "no Dask scheduler" in done.stderr


@pytest.mark.parametrize(
    ("address", "why"),
    [("nonsense", "missing port"), ("http://127.0.0.1:1", "unknown address scheme")],
)
def test_an_address_that_is_none_leaves_no_half_a_client(tmp_path, address, why):
    pytest.importorskip("distributed", reason="the extra grade")
    (tmp_path / "clones" / "ada").mkdir(parents=True)
    done = grade(tmp_path / "clones", tmp_path, "--dask", address)
    assert done.returncode == 2
    (says,) = done.stderr.splitlines()
    assert says.startswith(f"error: no Dask scheduler at {address}: {why}")


def test_without_a_scheduler_or_without_dask_it_is_said_in_a_line(
    tmp_path, monkeypatch
):
    monkeypatch.setattr(engine, "REACHING", 0.3)
    make_class(tmp_path / "clones", 1)
    done = grade_here(tmp_path / "clones", tmp_path, "--dask", "tcp://127.0.0.1:1")
    assert done.returncode == 2
    installed = importlib.util.find_spec("distributed") is not None
    says = "no Dask scheduler at" if installed else "--dask needs the package"
    assert says in done.stderr
