"""As on other processors: what reaches the student's code, and what is run there."""

import subprocess
import sys

import numpy as np
import pytest

from labkit.sandbox.environment import clean_environment

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


@pytest.mark.kit
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
