"""As on other processors: what reaches the student's code, and what is run there."""

import subprocess
import sys

import numpy as np
import pytest

from labkit.commands import kernels
from labkit.judge import near_miss
from labkit.judge.kinds import Kind
from labkit.sandbox.environment import clean_environment

pytestmark = pytest.mark.kit

CODE = """
    import numpy as np

    def f():
        x = np.random.default_rng(47).normal(size=(40, 40))
        return x @ x.T @ x
"""
SHOWN = "import sys; sys.stdout.buffer.write(f().tobytes())"


def test_of_the_environment_go_on_the_kernels_and_nothing_else(monkeypatch):
    before = clean_environment()
    known = {"OPENBLAS_CORETYPE": "Prescott", "NPY_DISABLE_CPU_FEATURES": "X86_V3"}
    others = {"SECRET": "x", "OPENBLAS_VERBOSE": "2", "PYTHONPATH": "/", "HOME": "/"}
    for name, value in (known | others).items():
        monkeypatch.setenv(name, value)
    assert clean_environment() == before | known


@pytest.mark.parametrize("value", ["", "/lib/x.so", "Zen;x", "Zen\nA=b", "Z" * 33])
def test_what_is_no_name_of_a_processor_stays_outside(monkeypatch, value):
    for name in ("OPENBLAS_CORETYPE", "NPY_DISABLE_CPU_FEATURES"):
        monkeypatch.setenv(name, value if len(value) < 33 else 7 * value)
        assert name not in clean_environment()


def test_a_students_code_computes_to_the_last_bit_as_the_checkers(ask, monkeypatch):
    code = "\n".join(line[4:] for line in CODE.splitlines()) + "\n"
    found = []
    for kernel in ("Prescott", "Haswell"):
        monkeypatch.setenv("OPENBLAS_CORETYPE", kernel)
        monkeypatch.setenv("OMP_NUM_THREADS", "1")
        (reply,) = ask(CODE)
        outside = [sys.executable, "-c", code + SHOWN]
        done = subprocess.run(outside, capture_output=True, check=True)
        assert reply.value.tobytes() == done.stdout
        found.append(reply.value)
    assert np.allclose(*found, rtol=1e-12, atol=1e-10)


def test_a_number_that_hangs_on_the_processor_is_found_and_named(
    monkeypatch, tmp_path, capsys
):
    code = "import os\ndef test_a(): assert os.environ['OPENBLAS_CORETYPE'] != 'Zen'\n"
    (tmp_path / "test_a_number.py").write_text(code)
    monkeypatch.setattr(kernels, "tests", lambda: [tmp_path])
    monkeypatch.setattr(kernels, "kernel_used", lambda kernel: kernel)
    monkeypatch.setattr(sys, "argv", ["kernels", "Haswell", "Zen"])
    monkeypatch.setattr(kernels, "DOCUMENTS", str(tmp_path))
    assert kernels.main() == 1
    haswell, *said, zen = capsys.readouterr().out.splitlines()
    assert haswell.startswith("PASS  Haswell: 1 passed")
    assert any(line.startswith("FAILED") and "::test_a" in line for line in said)
    assert zen.startswith("FAIL  Zen: 1 failed")


def test_what_openblas_does_not_take_and_what_ran_already_are_left_out(
    monkeypatch, capsys
):
    own = {"": "Haswell", "Haswell": "Haswell", "NoSuch": "Haswell"}
    monkeypatch.delenv("OPENBLAS_CORETYPE", raising=False)
    monkeypatch.setattr(kernels, "kernel_used", own.__getitem__)
    monkeypatch.setattr(sys, "argv", ["kernels", "--others", "NoSuch", "Haswell"])
    assert kernels.main() == 0
    first, second = capsys.readouterr().out.splitlines()
    assert first == "left out  NoSuch: here OpenBLAS takes Haswell for it"
    assert second.startswith("left out  Haswell: this machine's own")


def test_another_processors_environment_is_this_one_but_for_its_kernels(monkeypatch):
    monkeypatch.setenv("OPENBLAS_CORETYPE", "Zen")
    monkeypatch.setenv("ROBO47_SAID", "kept")
    haswell = kernels.environment("Haswell")
    assert haswell["OPENBLAS_CORETYPE"] == "Haswell"
    assert haswell["ROBO47_SAID"] == "kept"
    assert "NPY_DISABLE_CPU_FEATURES" not in haswell
    assert kernels.environment("Prescott").items() >= kernels.NO_AVX.items()
    assert "OPENBLAS_CORETYPE" not in kernels.environment("")


def test_days_and_library_are_run_and_nothing_of_the_machines():
    found = {path.name for path in kernels.tests()}
    assert {"w1-foundations", "w2-autonomy", "test_se3.py", "test_arm.py"} <= found
    assert not found & {"test_sandbox.py", "test_kit.py", "test_days_catalogue.py"}


@pytest.mark.parametrize(
    ("one", "other", "says"),
    [
        (1.4e-7, 1.7e-7, "Largest error: about 1e-07. Rounding"),
        (1.4e-4, 1.4e-4, "Largest error: 1.4e-04."),
    ],
)
def test_a_near_miss_says_the_size_of_rounding_and_the_digits_of_more(one, other, says):
    T = np.full((3, 2), np.pi)
    found = [near_miss.explain(T + off, T) for off in (one, other)]
    assert found[0] == found[1]
    assert says in found[0].message


def test_rounding_divided_by_nothing_is_told_without_its_digits():
    T = np.ones((3, 2))
    said = [Kind((2,)).apart(off * T, T) for off in (3.04e15, 1.11e16, 3.0)]
    assert said == ["more than 1e+12"] * 2 + ["2"]
