"""Run the numerical tests as on other processors: no number depends on the last bit.

    make kernels                              Prescott, Haswell, SkylakeX
    python3 scripts/kernels.py Nehalem Zen    as on others known to OpenBLAS
    python3 scripts/kernels.py --others       all except this machine's

Each run executes the tests of the days and of the library. The first processor differs
most, so its run also includes the authors' tests, one of which compares the documents'
outputs.
Processors that OpenBLAS does not support here are named and left out. To find a number
that changes, set OPENBLAS_CORETYPE or NPY_DISABLE_CPU_FEATURES: all commands and the
sandbox use them.

Exit code: 0 the same everywhere, 1 something differs, 2 could not run.
"""

import os
import sys
from collections.abc import Iterator
from pathlib import Path

from labkit.base import cli, processes
from labkit.lesson.week import weeks
from robo47.paths import ROOT

THREE = ("Prescott", "Haswell", "SkylakeX")  # these have no AVX, AVX2 and AVX-512
MARKS = "not soak and not browser and not network"
DOCUMENTS = "tests/test_docs.py"  # one of them runs every command of the documents
# This setting is for NumPy's own loops.
NO_AVX = {"NPY_DISABLE_CPU_FEATURES": "X86_V3 X86_V4"}
# Prints whose kernels OpenBLAS takes, after it has used them; nothing without OpenBLAS.
PROBE = """
import ctypes, pathlib, numpy
numpy.ones((50, 50)) @ numpy.ones((50, 50))
for path in pathlib.Path(numpy.__file__).parents[1].glob("numpy.libs/*openblas*"):
    name = ctypes.CDLL(str(path)).scipy_openblas_get_corename64_
    name.restype = ctypes.c_char_p
    print(name().decode())
"""
OLDER = {"Katmai": "Prescott"}  # OpenBLAS's own name for a kernel that was requested


def environment(kernel: str) -> dict[str, str]:
    """Return the environment in which a process computes as on another processor.

    Args:
        kernel: a name that OpenBLAS knows; "" is this machine's own.
    """
    others = ("OPENBLAS_CORETYPE", "OPENBLAS_L2_SIZE", *NO_AVX)
    plain = {name: value for name, value in os.environ.items() if name not in others}
    asked = {"OPENBLAS_CORETYPE": kernel} if kernel else {}
    return plain | asked | (NO_AVX if kernel == "Prescott" else {})


def kernel_used(kernel: str) -> str:
    """Return whose kernels OpenBLAS takes where these are asked for; "" if none runs.

    Args:
        kernel: as `environment` has it.
    """
    done = processes.run([sys.executable, "-c", PROBE], env=environment(kernel))
    said = done.stdout.strip() if done.returncode == 0 else ""
    return OLDER.get(said, said)


def tests() -> Iterator[Path]:
    """Yield the days' folders, and the files that test the library alone."""
    yield from (week.folder for week in weeks())
    for path in sorted((ROOT / "tests").glob("test_*.py")):
        text = path.read_text("utf-8")
        if "labkit" not in text and "pytestmark = pytest.mark.kit" not in text:
            yield path


def command(*, whole: bool) -> list[str]:
    """Return what is run under one kernel.

    Args:
        whole: also the tests with the mark `kit`, and the documents.
    """
    where = [*([DOCUMENTS] if whole else []), *map(str, tests())]  # the slow ones first
    marks = MARKS if whole else f"{MARKS} and not kit"
    asked = ["-q", "-n", "2", "--dist", "worksteal", "-m", marks, *where]
    return [sys.executable, "-m", "pytest", *asked]


def differs(kernel: str, *, whole: bool) -> bool:
    """Return whether something fails under a kernel; print what, and a line of each.

    Args:
        kernel: a name that OpenBLAS knows.
        whole: as `command` has it.
    """
    done = processes.run(command(whole=whole), env=environment(kernel), cwd=ROOT)
    bad = bool(done.returncode)
    if bad:
        print(done.stdout + done.stderr)
    last = (done.stdout.splitlines() or ["it printed nothing"])[-1]
    print(f"{cli.verdict(not bad)}  {kernel}: {last}", flush=True)
    return bad


def main() -> int:
    """Run each kernel and print what differs."""
    parser = cli.parser(__doc__)
    parser.add_argument("kernels", nargs="*", default=THREE, metavar="KERNEL")
    parser.add_argument("--others", action="store_true", help="not this machine's own")
    options = parser.parse_args()
    own = kernel_used(os.environ.get("OPENBLAS_CORETYPE", "")) if options.others else ""
    bad = False
    whole = True
    for kernel in options.kernels:
        found = kernel_used(kernel)
        if found.lower() != kernel.lower():
            print(f"left out  {kernel}: here OpenBLAS takes {found or 'none'} for it")
        elif kernel == own:
            print(f"left out  {kernel}: this machine's own, which `make test` has run")
        else:
            bad = differs(kernel, whole=whole) or bad
            whole = False
    return cli.EXIT_FAILED if bad else cli.EXIT_OK
