"""What the checker says of files as people save them: notebooks, imports, merges."""

import pytest

from labkit.lesson.day import find_day
from labkit.lesson.slips import no_python, other_packages, twice

SOURCE = find_day(1).source.read_text("utf-8")
IMPORT = "import numpy as np\n"


def with_top(text):
    """Return Day 1's lab with some lines before NumPy's import."""
    return SOURCE.replace(IMPORT, f"{text}\n{IMPORT}", 1)


@pytest.mark.parametrize(
    ("text", "at", "says"),
    [
        ("import x\n%matplotlib inline\n", 1, "command of a notebook"),
        ("!pip install numpy\n", 0, "command of a notebook"),
        ("In [3]:\n", 0, "label of a notebook"),
        (">>> x = 1\n", 0, "prompt of Python"),
        ("version https://git-lfs.github.com/spec/v1\noid sha256:4d\n", 1, "Git LFS"),
        ("x = (1,\n<<<<<<< HEAD\ny\n=======\nz\n>>>>>>> b\n", 0, "keep one side"),
        ('{\n "cells": [\n', 1, "is a notebook"),
        ("x = = 1\n", 0, ""),
    ],
)
def test_what_is_no_python_is_named(text, at, says):
    found = no_python(text.splitlines(), at)
    assert says in found
    assert bool(found) == bool(says)


@pytest.mark.kit
def test_a_line_of_a_notebook_is_named_where_the_file_does_not_load(check):
    found = check(with_top("%matplotlib inline"))["1.1"]
    assert found.mistake == "does-not-load"
    assert found.message.endswith("is a command of a notebook: delete it.")


def test_a_stub_below_ones_own_function_is_named(check):
    stub = '\n\ndef Rz(theta):\n    raise NotImplementedError("task 1.2: write Rz")\n'
    found = check(SOURCE + stub)["1.2"]
    at = SOURCE[: SOURCE.index("def Rz(")].count("\n") + 1
    last = (SOURCE + stub).count("\n") - 1
    assert (found.status, found.mistake) == ("todo", "defined-twice")
    assert f"defines Rz twice, on lines {at} and {last}." in found.message


@pytest.mark.kit
def test_a_wrong_second_definition_is_named_beside_what_is_wrong(check):
    found = check(f"{SOURCE}\n\ndef Rz(theta):\n    return 2 * np.eye(3)\n")["1.2"]
    assert found.status == "wrong"
    assert "Rz twice" in found.message
    assert twice(SOURCE, "Rz") == ""


def test_a_package_that_no_task_needs_may_be_imported_at_the_top(check):
    top = (
        "import matplotlib.pyplot as plt\nimport scipy.linalg\n"
        "from scipy.spatial.transform import Rotation\n"
        'plt.rcParams["figure.dpi"] = 100'
    )
    assert {one.status for one in check(with_top(top)).values()} == {"passed"}


@pytest.mark.kit
@pytest.mark.parametrize("top", [True, False])
def test_one_that_a_task_uses_is_refused_with_advice_that_works(check, top):
    line = "from scipy.spatial.transform import Rotation"
    uses = "    return Rotation.from_quat(quat).as_matrix()\n"
    inside = "" if top else f"    {line}\n"
    code = f"{SOURCE}\n\ndef quat_to_R(quat):\n{inside}{uses}"
    code = code.replace(IMPORT, f"{line}\n{IMPORT}", 1) if top else code
    found = check(code)
    assert found["1.4"].mistake == "other-package"
    assert "to call scipy.spatial.transform.Rotation.from_quat" in found["1.4"].message
    assert "Use others in main()" in found["1.4"].message
    assert found["1.1"].status == "passed"
    moved = SOURCE.replace(
        "def main() -> int:\n", f"def main() -> int:\n    {line}\n", 1
    )
    assert moved != SOURCE
    assert {one.status for one in check(moved).values()} == {"passed"}


def test_a_file_that_can_do_without_a_package_still_does():
    code = "try:\n    import numba\nexcept ImportError:\n    numba = None\n"
    assert other_packages(code) == ()
    assert other_packages(f"import scipy.linalg\n{code}") == ("scipy",)


@pytest.mark.kit
def test_what_asks_for_input_and_what_returns_none_is_told_what_to_do(check):
    asks = SOURCE + "\n\ndef Rz(theta):\n    return float(input('angle? '))\n"
    assert (
        "Does your function call input()? The checker provides no input"
        in check(asks)["1.2"].message
    )
    nothing = (
        "\n\n_R = Rz\ndef Rz(theta):\n    return _R(theta) if theta > 0 else None\n"
    )
    found = check(SOURCE + nothing)["1.2"].message
    assert (
        "Your function returns None in 5 of 12 calls; expected a 3x3 matrix." in found
    )
