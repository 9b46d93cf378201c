"""Stand-ins for `mujoco` and `robo47`: what a task may use, and a clear no to the rest.

The student's file imports both at its top, and its functions read the Panda from an
MjModel. Here a model is plain data under MuJoCo's own names, and every function that
would compute the answer refuses, saying why.
"""

import enum
import sys
import types
from collections.abc import Callable
from typing import Any

import numpy as np

Refuse = Callable[[str], Exception]

# How MjModel names things: the accessor, its arrays' prefix, the count, mjtObj's name.
KINDS = {
    "body": ("body_", "nbody", "mjOBJ_BODY"),
    "joint": ("jnt_", "njnt", "mjOBJ_JOINT"),
    "geom": ("geom_", "ngeom", "mjOBJ_GEOM"),
    "site": ("site_", "nsite", "mjOBJ_SITE"),
    "camera": ("cam_", "ncam", "mjOBJ_CAMERA"),
    "light": ("light_", "nlight", "mjOBJ_LIGHT"),
    "actuator": ("actuator_", "nu", "mjOBJ_ACTUATOR"),
    "tendon": ("tendon_", "ntendon", "mjOBJ_TENDON"),
    "equality": ("eq_", "neq", "mjOBJ_EQUALITY"),
    "key": ("key_", "nkey", "mjOBJ_KEY"),
}
_SHORT = {"jnt": "joint", "cam": "camera", "eq": "equality", "keyframe": "key"}
_POSITIONS = {0: 7, 1: 4, 2: 1, 3: 1}  # numbers in qpos by joint type: free, ball, ...
_VELOCITIES = {0: 6, 1: 3, 2: 1, 3: 1}


class MjModel:
    """An MjModel to read from: the same names, the same arrays, nothing to simulate."""

    def __init__(self, data: dict[str, Any], arrays: dict[str, np.ndarray]) -> None:
        """Take the model's numbers.

        Args:
            data: "sizes", {"nq": 7, ...}, and "names", {"body": ["world", ...], ...}.
            arrays: {"body_pos": (nbody, 3), ...}; copied, so a task may change them.
        """
        self.__dict__.update(data["sizes"])
        self.__dict__.update({name: array.copy() for name, array in arrays.items()})
        self._names: dict[str, list[str]] = data["names"]

    def __getattr__(self, name: str) -> Any:  # noqa: D105
        kind = _SHORT.get(name, name)
        if kind in KINDS:
            return lambda key: self._view(kind, key)
        raise AttributeError(f"the checker's copy of the model has no {name!r}")

    def _view(self, kind: str, key: str | int) -> types.SimpleNamespace:
        """Return one object's rows, as `model.body("link1")` gives them."""
        index = self._index(kind, key)
        prefix = KINDS[kind][0]
        rows = {
            name[len(prefix) :]: array[index : index + 1].reshape(
                array.shape[1:] or (1,)
            )
            for name, array in vars(self).items()
            if name.startswith(prefix) and isinstance(array, np.ndarray)
        }
        if kind == "joint":
            rows = {**self._joint_rows(index), **rows}
        return types.SimpleNamespace(id=index, name=self._names[kind][index], **rows)

    def _joint_rows(self, index: int) -> dict[str, np.ndarray]:
        """Return what a joint's view has from elsewhere: its rows of qpos and dof."""
        kind = int(self.jnt_type[index])
        start, first = self.jnt_qposadr[index], self.jnt_dofadr[index]
        qpos = slice(start, start + _POSITIONS[kind])
        dof = slice(first, first + _VELOCITIES[kind])
        rows = {
            name[len("dof_") :]: array[dof]
            for name, array in vars(self).items()
            if name.startswith("dof_")
        }
        for name in ("qpos0", "qpos_spring"):
            rows[name] = vars(self)[name][qpos]
        return rows

    def _index(self, kind: str, key: str | int) -> int:
        names = self._names[kind]
        if isinstance(key, str):
            if key not in names:
                raise KeyError(f"Invalid name '{key}'. Valid names: {sorted(names)}")
            return names.index(key)
        if not 0 <= key < len(names):
            raise IndexError(
                f"Invalid index {key}. Valid indices from 0 to {len(names) - 1}"
            )
        return int(key)


class _Stand(types.ModuleType):
    """A module that has what it was given; anything else refuses when it is called."""

    def __init__(self, name: str, refuse: Refuse, **has: Any) -> None:
        super().__init__(name)
        self.__path__: list[str] = []  # lets `import name.inner` look for inner
        self._refuse = refuse
        self.__dict__.update(has)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return _Refusing(f"{self.__name__}.{name}", self._refuse)


class _Refusing:
    """A function, class or constant of MuJoCo or the kit that a task does without."""

    def __init__(self, name: str, refuse: Refuse) -> None:
        self._name, self._refuse = name, refuse

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        raise self._refuse(f"call {self._name}")

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return _Refusing(f"{self._name}.{name}", self._refuse)

    def __or__(self, other: Any) -> "_Refusing":  # in hints: mujoco.MjData | None
        return self

    __ror__ = __or__


class _Lab:
    """Takes the place of the lab's recorder: a check runs no lab."""

    def __init__(self, *args: Any, **kwargs: Any) -> None: ...

    def __getattr__(self, name: str) -> Callable[..., None]:
        return lambda *args, **kwargs: None


def note_use(names: list[str]) -> list[str]:
    """Make functions of NumPy note in the returned list that they were called.

    Args:
        names: such as "numpy.linalg.inv"; works however student code imports them,
            since it happens before.
    """
    used: list[str] = []

    def noting(name: str, original: Callable[..., Any]) -> Callable[..., Any]:
        def call(*args: Any, **kwargs: Any) -> Any:
            used.append(name)
            return original(*args, **kwargs)

        return call

    for name in names:
        path, _, attribute = name.rpartition(".")
        module = sys.modules[path]
        setattr(module, attribute, noting(name, getattr(module, attribute)))
    return used


def make_modules(
    refuse: Refuse, panda: Callable[[], MjModel], facts: dict[str, Any]
) -> dict[str, types.ModuleType]:
    """Return what to put in `sys.modules`.

    Args:
        refuse: takes what was tried, returns the exception to raise.
        panda: makes a fresh stand-in of the Panda.
        facts: "enums", {"mjtObj": {"mjOBJ_BODY": 1, ...}, ...}; "constants" of
            robo47.panda, {"READY_Q": [...], ...}; "version" of MuJoCo.
    """
    enums = {
        name: enum.IntEnum(name, members) for name, members in facts["enums"].items()
    }
    mujoco = _Stand(
        "mujoco", refuse, MjModel=MjModel, __version__=facts["version"], **enums
    )
    objects = facts["enums"]["mjtObj"]
    kinds = {objects[row[2]]: kind for kind, row in KINDS.items()}
    mujoco.mj_name2id = lambda model, kind, name: (  # type: ignore[attr-defined]
        model._names[kinds[int(kind)]].index(name)
        if name in model._names[kinds[int(kind)]]
        else -1
    )
    mujoco.mj_id2name = lambda model, kind, index: (  # type: ignore[attr-defined]
        model._names[kinds[int(kind)]][index] or None
    )
    robo47, viewer = _Stand("robo47", refuse), _Stand("mujoco.viewer", refuse)
    mujoco.viewer = viewer  # type: ignore[attr-defined]
    modules: dict[str, types.ModuleType] = {
        "mujoco": mujoco,
        "mujoco.viewer": viewer,
        "robo47": robo47,
    }
    has: dict[str, dict[str, Any]] = {
        "panda": {
            **{name: np.array(value) for name, value in facts["constants"].items()},
            "load": lambda entry="panda_nohand", *, meshes=False: panda(),
            "describe": lambda entry="panda_nohand": "robot: the checker's copy",
        },
        "lab": {"Lab": _Lab},
        "errors": {"Robo47Error": type("Robo47Error", (Exception,), {})},
        "cli": {"run": lambda main: None},
    }
    for name in facts["modules"]:
        inner = _Stand(f"robo47.{name}", refuse, **has.get(name, {}))
        modules[f"robo47.{name}"] = inner
        setattr(robo47, name, inner)
    return modules
