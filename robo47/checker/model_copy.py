"""A compiled model as plain data, for the sandbox's stand-in of MjModel."""

from functools import cache
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from robo47 import panda
from robo47.checker.inside.standins import KINDS
from robo47.checker.inside.wire import pack_array


def copy_model(model: mujoco.MjModel) -> dict[str, Any]:
    """Return a model's sizes, names and arrays as JSON.

    Args:
        model: any compiled model; what it only looks like should be dropped before.
    """
    values = {
        name: getattr(model, name) for name in dir(model) if not name.startswith("_")
    }
    return {
        "sizes": {n: v for n, v in values.items() if isinstance(v, int)},
        "arrays": {
            n: pack_array(v) for n, v in values.items() if isinstance(v, np.ndarray)
        },
        "names": {
            kind: [getattr(model, kind)(i).name for i in range(values[count])]
            for kind, (_, count, _) in KINDS.items()
        },
    }


@cache
def facts() -> dict[str, Any]:
    """Return what the stand-ins of `mujoco` and `robo47` need to know, as JSON."""
    kit = Path(panda.__file__).parent
    return {
        "version": mujoco.__version__,
        "enums": {
            name: {k: int(v) for k, v in getattr(mujoco, name).__members__.items()}
            for name in dir(mujoco)
            if name.startswith("mjt") and hasattr(getattr(mujoco, name), "__members__")
        },
        "constants": {"READY_Q": panda.READY_Q.tolist()},
        "modules": sorted(
            path.stem
            for path in kit.iterdir()
            if path.name[0] != "_" and (path.suffix == ".py" or path.is_dir())
        ),
    }
