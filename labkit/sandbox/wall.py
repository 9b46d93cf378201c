"""What stands between student code and this machine: the wall is the kernel's.

Three kinds, the first that works here:

    bubblewrap   a tool of every Linux distribution: its own processes, no network, and
                 of the file system Python and NumPy alone, read-only
    landlock     Linux's own rules and its filter of system calls, where bubblewrap
                 is not to be had
    none         other systems: the code runs with the rights of whoever checks it

ROBO47_WALL=bubblewrap, landlock or none asks for one by name, for tests. The commands
that run other people's code say which wall stands, and so cannot be fooled by it.
"""

import functools
import importlib.metadata
import importlib.util
import os
import shutil
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from labkit.sandbox.inside import landlock, seccomp
from robo47.errors import FaultError, Robo47Error
from robo47.paths import shown

INSIDE = Path(__file__).parent / "inside"
FLAGS = ["-I", "-S", "-B", "-X", "utf8"]
PROBE_SECONDS = 20.0
# What bubblewrap shows: the interpreter, its standard library, the system's libraries,
# NumPy and `inside/`, all read-only; one process, no network, no folder to write to.
NAMESPACES = "--unshare-all --die-with-parent --new-session --as-pid-1 --cap-drop ALL"
DEVICES = ("/dev/null", "/dev/zero", "/dev/urandom")
SYSTEM = ("/lib", "/lib32", "/lib64", "/usr/lib", "/usr/lib32", "/usr/lib64")
OTHERS = ("python*/site-packages", "python*/dist-packages")  # packages of this machine
_SAYS = {
    "bubblewrap": "student code runs behind bubblewrap: Python and NumPy, read-only, "
    "and nothing else of this machine",
    "landlock": "student code runs behind Linux's Landlock: opens no file of yours (it "
    "can tell names and sizes), no network, no other process. Stronger: install "
    "bubblewrap",
    "none": "nothing keeps student code from this machine: it runs with your rights",
}


@dataclass(frozen=True)
class Wall:
    """What student code is kept behind."""

    name: str  # "bubblewrap", "landlock" or "none"
    says: str  # a sentence for people, without a full stop


@functools.cache
def wall() -> Wall:
    """Return the strongest wall of this machine.

    Raises:
        Robo47Error: ROBO47_WALL asks for one that it does not have.
    """
    tests = {"bubblewrap": _bubblewrap_works, "landlock": _landlock_works}
    wanted = os.environ.get("ROBO47_WALL", "")
    if wanted not in ("", *_SAYS):
        raise Robo47Error(f"ROBO47_WALL is {wanted!r}; known are {', '.join(_SAYS)}")
    for name in (wanted,) if wanted else _SAYS:
        if name == "none" or tests[name]():
            asked = " (ROBO47_WALL asks for it)" if wanted else ""
            return Wall(name, _SAYS[name] + asked)
    raise FaultError(f"ROBO47_WALL asks for {wanted}, which does not work here")


def in_container() -> bool:
    """Return whether this is a container, where root is not root outside."""
    marks = ("/.dockerenv", "/run/.containerenv")
    told = ("container", "KUBERNETES_SERVICE_HOST")  # systemd's and podman's; a pod's
    return any(map(os.environ.get, told)) or any(Path(mark).exists() for mark in marks)


def refusal() -> str:
    """Return why other people's code should not run here; "" where it may."""
    if wall().name == "none":  # a container may share the home, as Toolbox's does
        return "these submissions would run with your rights"
    if hasattr(os, "geteuid") and os.geteuid() == 0 and not in_container():
        return "you are root, and this is no container: be an ordinary user"
    return ""


def command(chosen: Wall, extras: Sequence[str] = ()) -> list[str]:
    """Return the command that starts the sandbox's interpreter behind a wall.

    Args:
        chosen: the wall.
        extras: packages that student code may import besides NumPy: "scipy==1.17.1".

    Raises:
        Robo47Error: NumPy is not installed, or an extra is not, in that version.
    """
    packages = [name for extra in extras for name in _folders_of(extra)]
    spec = importlib.util.find_spec("numpy")
    if spec is None or spec.origin is None:
        raise Robo47Error("NumPy is not installed: run `make day1` once")
    libraries = Path(spec.origin).parent.parent
    if chosen.name == "bubblewrap":
        return _behind_bubblewrap(libraries, chosen.name, packages)
    return [sys.executable, *FLAGS, str(INSIDE), chosen.name, str(libraries), *packages]


def _folders_of(extra: str) -> list[str]:
    """Return the folders that a pinned package brings, beside NumPy's."""
    name, _, version = extra.partition("==")
    try:
        found = importlib.metadata.distribution(name)
    except importlib.metadata.PackageNotFoundError:
        found = None
    if found is None or found.version != version:
        here = f"here is {found.version}" if found else "it is not installed"
        raise Robo47Error(
            f"this week's code may import {extra}, and {here}. To install it: "
            f"{shown(Path(sys.executable))} -m pip install {extra}"
        )
    tops = {file.parts[0] for file in found.files or () if len(file.parts) > 1}
    return sorted(top for top in tops if not top.endswith((".dist-info", "..")))


def _landlock_works() -> bool:
    return landlock.version() > 0 and seccomp.known()


def _bubblewrap_works() -> bool:
    """Return whether bubblewrap starts a Python here, with what it is to see."""
    if not sys.platform.startswith("linux") or shutil.which("bwrap") is None:
        return False
    try:
        tried = subprocess.run(
            [*_bubblewrap(), "-I", "-S", "-c", ""],
            stdin=subprocess.DEVNULL,
            capture_output=True,
            timeout=PROBE_SECONDS,
            check=False,
        )
    except (OSError, subprocess.TimeoutExpired):
        return False
    return tried.returncode == 0


def _behind_bubblewrap(libraries: Path, name: str, packages: list[str]) -> list[str]:
    """Return the command that runs the sandbox's program behind bubblewrap."""
    binds = _read_only(INSIDE, "/checker")
    for package in ("numpy", "numpy.libs", *packages):
        if (libraries / package).is_dir():
            binds += _read_only(libraries / package, f"/libraries/{package}")
    return [*_bubblewrap(binds), *FLAGS, "/checker", name, "/libraries", *packages]


def _bubblewrap(binds: list[str] | None = None) -> list[str]:
    """Return the command up to Python's own arguments; see bwrap(1)."""
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
