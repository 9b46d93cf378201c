"""A fake of MuJoCo's MjModel: plain data under MuJoCo's own names.

Its arrays, counts, names and named views are those of a compiled model, which
`labkit.sandbox.messages` has copied; there is nothing in it to compute with.
"""

from typing import Any

import numpy as np

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
    """A fake MjModel: the same names, the same arrays, nothing to simulate."""

    def __init__(self, data: dict[str, Any], arrays: dict[str, np.ndarray]) -> None:
        """Take the model's numbers.

        Args:
            data: "sizes", {"nq": 7, ...}, and "names", {"body": ["world", ...], ...}.
            arrays: {"body_pos": (nbody, 3), ...}; each is copied when it is first asked
                for, so a task may change it.
        """
        self.__dict__.update(data["sizes"])
        self._arrays = arrays
        self._names: dict[str, list[str]] = data["names"]

    def __getattr__(self, name: str) -> Any:  # noqa: D105
        if name in self.__dict__.get("_arrays", ()):
            self.__dict__[name] = own = self._arrays[name].copy()
            return own
        kind = _SHORT.get(name, name)
        if kind in KINDS:
            return lambda key: View(self, kind, self._index(kind, key))
        raise AttributeError(f"the checker's copy of the model has no {name!r}")

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


class View:
    """One object's rows, as `model.body("link1")` gives them; looked up when asked."""

    def __init__(self, model: MjModel, kind: str, index: int) -> None:
        """Take whose rows: of a kind, the one at a place."""
        self.id = index
        self.name = model._names[kind][index]
        self._model, self._kind = model, kind

    def __getattr__(self, name: str) -> Any:  # noqa: D105
        if name.startswith("_"):  # a copy that is not complete yet asks, too
            raise AttributeError(name)
        model = self._model
        prefix = KINDS[self._kind][0]
        if prefix + name in model._arrays:
            row = getattr(model, prefix + name)[self.id : self.id + 1]
            return row.reshape(row.shape[1:] or (1,))
        if self._kind == "joint" and f"dof_{name}" in model._arrays:
            return getattr(model, f"dof_{name}")[self._joints("dof", _VELOCITIES)]
        if self._kind == "joint" and name in ("qpos0", "qpos_spring"):
            return getattr(model, name)[self._joints("qpos", _POSITIONS)]
        raise AttributeError(f"the checker's copy of a {self._kind} has no {name!r}")

    def _joints(self, among: str, sizes: dict[int, int]) -> slice:
        """Return where a joint's numbers are among all joints'."""
        start = getattr(self._model, f"jnt_{among}adr")[self.id]
        return slice(start, start + sizes[int(self._model.jnt_type[self.id])])
