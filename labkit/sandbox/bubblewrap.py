"""The command that runs Python behind bubblewrap, with next to nothing in sight.

Inside are the interpreter, its standard library, the system's libraries, NumPy and the
checker's own `inside/`, all read-only; no process but itself, no network, no folder to
write to. See bwrap(1).
"""

import os
import shutil
import sys
from pathlib import Path

NAMESPACES = "--unshare-all --die-with-parent --new-session --as-pid-1 --cap-drop ALL"
DEVICES = ("/dev/null", "/dev/zero", "/dev/urandom")
SYSTEM = ("/lib", "/lib32", "/lib64", "/usr/lib", "/usr/lib32", "/usr/lib64")
OTHERS = ("python*/site-packages", "python*/dist-packages")  # packages of this machine


def there() -> bool:
    """Return whether this machine has bubblewrap."""
    return sys.platform.startswith("linux") and shutil.which("bwrap") is not None


def command(inside: Path, libraries: Path, flags: list[str], wall: str) -> list[str]:
    """Return the command that runs the sandbox's program.

    Args:
        inside: the folder of that program.
        libraries: the folder where NumPy is.
        flags: for Python.
        wall: its first argument.
    """
    binds = _read_only(inside, "/checker")
    for name in ("numpy", "numpy.libs"):
        if (libraries / name).is_dir():
            binds += _read_only(libraries / name, f"/libraries/{name}")
    return [*prefix(binds), *flags, "/checker", wall, "/libraries"]


def prefix(binds: list[str] | None = None) -> list[str]:
    """Return the command up to Python's own arguments.

    Args:
        binds: further options of bubblewrap.
    """
    python = Path(os.path.realpath(getattr(sys, "_base_executable", sys.executable)))
    options = [str(shutil.which("bwrap")), *NAMESPACES.split()]
    for device in DEVICES:
        options += ["--dev-bind", device, device]
    for folder in _library_folders(python):
        if folder.is_symlink():
            options += ["--symlink", os.readlink(folder), str(folder)]
        elif folder.is_dir():
            options += _read_only(folder)
            for hidden in OTHERS:
                for packages in folder.glob(hidden):
                    options += ["--tmpfs", str(packages), "--remount-ro", str(packages)]
    options += ["--ro-bind-try", "/etc/ld.so.cache", "/etc/ld.so.cache"]
    options += _read_only(python) + (binds or [])
    return [*options, "--remount-ro", "/", "--chdir", "/", "--", str(python)]


def _library_folders(python: Path) -> list[Path]:
    """Return where the system's libraries are and Python's own, without repetition."""
    own = {python.parent.parent, Path(os.path.realpath(sys.base_prefix))}
    folders = [*map(Path, SYSTEM)]
    folders += [place / name for place in sorted(own) for name in ("lib", "lib64")]
    return list(dict.fromkeys(folders))


def _read_only(path: Path, at: str = "") -> list[str]:
    return ["--ro-bind", str(path), at or str(path)]
