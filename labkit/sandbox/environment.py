"""The environment of student code: of this process's, what is named here and no more.

The two that choose among the kernels of OpenBLAS and NumPy are handed on, so that the
checker and the student's code compute alike: as on another processor (`make kernels`).
"""

import os
import re

THREADS = ("OPENBLAS", "OMP", "MKL", "VECLIB")
LIBRARIES = ("SYSTEMROOT", "SYSTEMDRIVE", "LD_LIBRARY_PATH", "DYLD_LIBRARY_PATH")
KERNELS = {  # names of processors and of their features: plain words, never a path
    "OPENBLAS_CORETYPE": re.compile(r"[A-Za-z0-9]{1,32}"),
    "NPY_DISABLE_CPU_FEATURES": re.compile(r"[A-Za-z0-9_ ,]{1,200}"),
}


def clean_environment() -> dict[str, str]:
    """Return what the sandbox's interpreter is told of this process's environment."""
    own = os.environ
    kernels = {
        name: own[name]
        for name, plain in KERNELS.items()
        if plain.fullmatch(own.get(name, ""))
    }
    return {
        **{name: own[name] for name in LIBRARIES if name in own},
        **kernels,
        **{f"{name}_NUM_THREADS": "1" for name in THREADS},
        "LANG": "C.UTF-8",
    }
