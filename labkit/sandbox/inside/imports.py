"""What student code may import besides Python's own modules and NumPy.

All of it comes as text with the request: the student's other files, and the kit's
library of the days before. No file of theirs is to be seen from here. Everything else
of `robo47` and `mujoco` is a fake.
"""

import base64
import sys
from importlib.machinery import ModuleSpec, PathFinder
from types import ModuleType
from typing import Any

from fakes import FakeModule, Refuse


class Finder:
    """Finds and loads modules from texts, and makes the fakes."""

    def __init__(
        self,
        request: dict[str, Any],
        fakes: dict[str, dict[str, Any]],
        refuse: Refuse,
        libraries: str,
        extras: list[str],
    ) -> None:
        """Take what there is.

        Args:
            request: with the "library", source by dotted name, {"robo47.se3": "..."},
                and "beside", the student's other files in base64.
            fakes: what each fake module has, by dotted name.
            refuse: takes what was tried, returns the exception to raise.
            libraries: the folder where NumPy is.
            extras: packages in it that may be imported too.
        """
        library, beside = request["library"], request["beside"]
        self._libraries, self._extras = libraries, extras
        self._fakes, self._refuse = fakes, refuse
        own = {name: code for name, code in beside.items() if name not in fakes}
        self._sources = {
            **{name: (text.encode(), f"<{name}>") for name, text in library.items()},
            **{name: (base64.b64decode(own[name]), f"{name}.py") for name in own},
        }
        parts = [name.split(".") for name in library]  # robo47.a.b is in robo47.a
        packages = {".".join(p[:n]) for p in parts for n in range(1, len(p))}
        self._known = {*fakes, *library, *packages}

    def install(self) -> None:
        """Look here right before looking into folders, as beside a script."""
        sys.meta_path.insert(sys.meta_path.index(PathFinder), self)  # type: ignore

    def find_spec(self, name: str, path: Any = None, target: Any = None) -> Any:
        """Return how to make a module, or None where it is not from here."""
        if name in self._sources:
            return ModuleSpec(name, self, origin=self._sources[name][1])  # type: ignore
        if name in self._known or name.startswith("mujoco."):
            return ModuleSpec(name, self, is_package=True)  # type: ignore
        if name in self._extras:
            return PathFinder.find_spec(name, [self._libraries])
        return None

    def create_module(self, spec: ModuleSpec) -> ModuleType | None:
        """Return a fake, or None: Python makes the module of a text."""
        if spec.name in self._sources:
            return None
        has = self._fakes.get(spec.name, {})
        return FakeModule(spec.name, self._refuse, self._known, **has)

    def exec_module(self, module: ModuleType) -> None:
        """Run a text as a module."""
        if module.__name__ in self._sources:
            source, file = self._sources[module.__name__]
            module.__file__ = file
            exec(compile(source, file, "exec"), vars(module))
