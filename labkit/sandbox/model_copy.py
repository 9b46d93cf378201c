"""A compiled model as plain data, for the sandbox's fake of MjModel."""

from functools import cache, lru_cache
from typing import Any

import mujoco
import numpy as np

from labkit.judge.ask import Robot
from labkit.sandbox.inside.fake_model import KINDS
from labkit.sandbox.inside.wire import pack_array
from robo47 import panda
from robo47.paths import ROOT


@lru_cache(8)  # a class is asked with the same few robots
def copy_of(robot: Robot | mujoco.MjModel) -> dict[str, Any]:
    """Return a robot as it travels; only an unchanged one is what `load` returns."""
    if isinstance(robot, mujoco.MjModel):
        return copy_model(robot)
    return copy_model(robot.model, "" if robot.change else robot.entry)


def copy_model(model: mujoco.MjModel, entry: str = "") -> dict[str, Any]:
    """Return a model's sizes, names and arrays as JSON.

    Args:
        model: any compiled model; what it only looks like should be dropped before.
        entry: of the Panda, which `panda.load(entry)` returns in the sandbox.
    """
    values = {
        name: getattr(model, name) for name in dir(model) if not name.startswith("_")
    }
    return {
        "entry": entry,
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
    """Return what the fakes of `mujoco` and `robo47` need to know, as JSON."""
    return {
        "version": mujoco.__version__,
        "enums": {
            name: {k: int(v) for k, v in getattr(mujoco, name).__members__.items()}
            for name in dir(mujoco)
            if name.startswith("mjt") and hasattr(getattr(mujoco, name), "__members__")
        },
        "constants": {"READY_Q": panda.READY_Q.tolist(), "END_FRAME": panda.END_FRAME},
        "modules": sorted(
            ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(
                ".__init__"
            )
            for package in ("robo47", "labkit")
            for path in (ROOT / package).rglob("*.py")
        ),
    }
