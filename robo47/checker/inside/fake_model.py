"""A fake of MuJoCo's MjModel: plain data under MuJoCo's own names.

Its arrays, counts, names and named views are those of a compiled model, which
`robo47.checker.model_copy` has copied; there is nothing in it to compute with.
"""

import types
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
            arrays: {"body_pos": (nbody, 3), ...}; copied, so a task may change them.
        """
        self.__dict__.update(data["sizes"])
        self.__dict__.update({name: array.copy() for name, array in arrays.items()})
        self._names: dict[str, list[str]] = data["names"]
        if "rows" not in data:  # once for all copies: a chain asks for many views
            data["rows"] = _rows(arrays)
        self._rows: dict[str, list[str]] = data["rows"]

    def __getattr__(self, name: str) -> Any:  # noqa: D105
        kind = _SHORT.get(name, name)
        if kind in KINDS:
            return lambda key: self._view(kind, key)
        raise AttributeError(f"the checker's copy of the model has no {name!r}")

    def _view(self, kind: str, key: str | int) -> types.SimpleNamespace:
        """Return one object's rows, as `model.body("link1")` gives them."""
        index = self._index(kind, key)
        prefix = KINDS[kind][0]
        mine = vars(self)
        rows = {
            name[len(prefix) :]: mine[name][index : index + 1].reshape(
                mine[name].shape[1:] or (1,)
            )
            for name in self._rows[prefix]
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
        mine = vars(self)
        rows = {name[len("dof_") :]: mine[name][dof] for name in self._rows["dof_"]}
        for name in ("qpos0", "qpos_spring"):
            rows[name] = mine[name][qpos]
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


def _rows(arrays: dict[str, np.ndarray]) -> dict[str, list[str]]:
    """Return the names of the arrays by what they begin with, such as "body_"."""
    prefixes = ["dof_", *(kind[0] for kind in KINDS.values())]
    return {p: [name for name in arrays if name.startswith(p)] for p in prefixes}
