"""The modules that student code may import besides Python's own and NumPy.

All of it comes as text with the request: the student's other files, and the kit's
library of the days before. No file of theirs is to be seen from here.

Everything else of `robo47` and `mujoco` is a fake. The student's file imports both at
its top. That always works, as does whatever a file does with names while it is loaded
(hints, defaults, subscripts); only what would compute an answer refuses, saying what it
was.
"""

import base64
import enum
import importlib
import sys
import types
from collections.abc import Callable, Iterator, Sequence
from importlib.machinery import ModuleSpec, PathFinder
from typing import Any

import numpy as np
from fake_model import KINDS, MjModel

Refuse = Callable[[str], Exception]
_READERS = ("from_xml_path", "from_xml_string", "from_binary_path")


class FakeModule(types.ModuleType):
    """A module that has what it was given; anything else refuses when it is used."""

    def __init__(self, name: str, refuse: Refuse, known: set[str], **has: Any) -> None:
        """Make it.

        Args:
            name: of the module, dotted.
            refuse: takes what was tried, returns the exception to raise.
            known: names of all modules that can be imported here.
            has: what it really has.
        """
        super().__init__(name)
        self._refuse, self._known = refuse, known
        self.__dict__.update(has)

    def __getattr__(self, name: str) -> Any:  # noqa: D105
        whole = f"{self.__name__}.{name}"
        if name.startswith("__"):
            raise AttributeError(name)
        if whole in self._known:
            return importlib.import_module(whole)
        return Refusing(whole, self._refuse)


class Refusing:
    """A function, class or constant that a task does without.

    It can be named, passed on, subscripted, combined and subclassed; it refuses to be
    called and to be a number.
    """

    def __init__(self, name: str, refuse: Refuse) -> None:
        """Take its dotted name, and what makes the exception to raise."""
        self._name, self._refuse = name, refuse

    def __call__(self, *args: Any, **kwargs: Any) -> Any:  # noqa: D102
        raise self._refuse(f"call {self._name}")

    def __getattr__(self, name: str) -> Any:  # noqa: D105
        if name.startswith("__"):
            raise AttributeError(name)
        return Refusing(f"{self._name}.{name}", self._refuse)

    def __getitem__(self, key: Any) -> "Refusing":  # noqa: D105
        return self

    def __setitem__(self, key: Any, value: Any) -> None:
        """Take a setting, such as one of rcParams."""

    def __iter__(self) -> Iterator[Any]:  # noqa: D105
        return iter(())

    def __mro_entries__(self, bases: tuple[Any, ...]) -> tuple[type, ...]:  # noqa: D105
        return ()

    def __repr__(self) -> str:  # noqa: D105
        return self._name

    def _combine(self, *others: Any) -> "Refusing":
        return self

    # In hints (mujoco.MjData | None) and in constants of a module (2 * panda.REACH).
    __or__ = __ror__ = __add__ = __radd__ = __sub__ = __rsub__ = _combine
    __mul__ = __rmul__ = __truediv__ = __rtruediv__ = __pow__ = __neg__ = _combine
    __matmul__ = __rmatmul__ = _combine

    def _number(self, *args: Any, **kwargs: Any) -> Any:
        raise self._refuse(f"use {self._name}")

    __float__ = __int__ = __index__ = __len__ = __array__ = _number
    __lt__ = __le__ = __gt__ = __ge__ = _number
    __array_ufunc__ = None  # NumPy leaves `array * this` to the methods above


class FakeLab:
    """Takes the place of the lab's recorder: a check runs no lab."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        """Take what the real one takes."""

    def __getattr__(self, name: str) -> Callable[..., None]:  # noqa: D105
        return lambda *args, **kwargs: None


def _fakes(
    refuse: Refuse, robots: Sequence[Any], facts: Any
) -> dict[str, dict[str, Any]]:
    """Return what each fake module has, by its dotted name."""

    def load(entry: str = "panda_nohand", **options: Any) -> Any:
        """Return a copy of the Panda, as `robo47.panda.load` would."""
        if options.get("edit"):
            raise refuse("call robo47.panda.load with edit")
        for robot in robots:
            if robot.entry == entry:
                return robot()
        raise refuse(f"load {entry!r}, which the checker has no copy of")

    panda = {
        name: np.array(value) if isinstance(value, list) else value
        for name, value in facts["constants"].items()
    }
    panda["load"] = load
    panda["describe"] = lambda entry="panda_nohand": "robot: the checker's copy"
    empty = (*facts["modules"], "mujoco.viewer", "robo47", "robo47.lesson")
    return {
        **{name: {} for name in empty},
        "mujoco": _mujoco(refuse, facts),
        "kit": {},  # a lab's first import, which finds the kit's Python
        "robo47.panda": panda,
        "robo47.lesson.lab": {"Lab": FakeLab},
        "labkit.lesson.lab": {"Lab": FakeLab},
        "robo47.errors": {"Robo47Error": type("Robo47Error", (Exception,), {})},
        "robo47.cli": {"run": lambda main: None},
    }


def _mujoco(refuse: Refuse, facts: dict[str, Any]) -> dict[str, Any]:
    """Return what the fake of `mujoco` has."""
    for name in _READERS:
        reader = Refusing(f"mujoco.MjModel.{name}", refuse)
        setattr(MjModel, name, staticmethod(reader))
    objects = facts["enums"]["mjtObj"]
    kinds = {objects[row[2]]: kind for kind, row in KINDS.items()}

    def mj_name2id(model: Any, kind: int, name: str) -> int:
        names = model._names[kinds[int(kind)]]
        return int(names.index(name)) if name in names else -1

    def mj_id2name(model: Any, kind: int, index: int) -> str | None:
        return model._names[kinds[int(kind)]][index] or None

    enums = {name: enum.IntEnum(name, known) for name, known in facts["enums"].items()}
    return {
        **enums,
        "MjModel": MjModel,
        "__version__": facts["version"],
        "mj_name2id": mj_name2id,
        "mj_id2name": mj_id2name,
    }


class Finder:
    """Finds and loads modules from texts, and makes the fakes."""

    def __init__(
        self,
        request: dict[str, Any],
        robots: Sequence[Any],
        refuse: Refuse,
        libraries: str,
        extras: list[str],
    ) -> None:
        """Take what there is.

        Args:
            request: with the "library", source by dotted name, {"robo47.se3": "..."},
                "beside", the student's other files in base64, the packages "absent",
                which refuse to be used, and the "facts" of `labkit.sandbox.messages`.
            robots: whose call makes a fresh copy of a model, with its "entry".
            refuse: takes what was tried, returns the exception to raise.
            libraries: the folder where NumPy is.
            extras: packages in it that may be imported too.
        """
        library, beside = request["library"], request["beside"]
        self._libraries, self._extras = libraries, extras
        self._fakes = fakes = _fakes(refuse, robots, request["facts"])
        self._refuse = refuse
        own = {name: code for name, code in beside.items() if name not in fakes}
        self._sources = {
            **{name: (text.encode(), f"<{name}>") for name, text in library.items()},
            **{name: (base64.b64decode(own[name]), f"{name}.py") for name in own},
        }
        parts = [name.split(".") for name in library]  # robo47.a.b is in robo47.a
        packages = {".".join(p[:n]) for p in parts for n in range(1, len(p))}
        self._known = {*fakes, *library, *packages}
        self._absent = {*request["absent"]} - {*self._sources, *extras}

    def install(self) -> None:
        """Look here right before looking into folders, as beside a script."""
        sys.meta_path.insert(sys.meta_path.index(PathFinder), self)  # type: ignore

    def find_spec(self, name: str, path: Any = None, target: Any = None) -> Any:
        """Return how to make a module, or None where it is not from here."""
        if name in self._sources:
            return ModuleSpec(name, self, origin=self._sources[name][1])  # type: ignore
        if name in self._known or name.startswith("mujoco."):
            return ModuleSpec(name, self, is_package=True)  # type: ignore
        if name.partition(".")[0] in self._absent:
            return ModuleSpec(name, self, is_package=True)  # type: ignore
        if name in self._extras:
            return PathFinder.find_spec(name, [self._libraries])
        return None

    def create_module(self, spec: ModuleSpec) -> types.ModuleType | None:
        """Return a fake, or None: Python makes the module of a text."""
        if spec.name in self._sources:
            return None
        has = self._fakes.get(spec.name, {})
        return FakeModule(spec.name, self._refuse, self._known, **has)

    def exec_module(self, module: types.ModuleType) -> None:
        """Run a text as a module."""
        if module.__name__ in self._sources:
            source, file = self._sources[module.__name__]
            module.__file__ = file
            exec(compile(source, file, "exec"), vars(module))
