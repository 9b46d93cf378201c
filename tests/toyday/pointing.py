"""A capstone of the toy week: the arm turns its base until it points at a mark."""

from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np

from robo47 import panda
from robo47.attempt import Film, Summary

NAME = "the pointing"
THING = "mark"
GOAL = "pointed at within 1 mrad"
HEAD = "\n              off, mrad"
USES = {46: ("angle_between", "polar")}


class Result(NamedTuple):
    """What came of it."""

    off: float  # radians
    qpos: Any  # (N, 7)

    @property
    def failed(self) -> bool:
        """Whether it points beside its mark."""
        return not self.off < 1e-3


def library() -> SimpleNamespace:
    """Return the right functions."""
    return SimpleNamespace(
        angle_between=lambda a, b: np.arctan2(np.linalg.norm(np.cross(a, b)), a @ b),
        polar=lambda x, y: (np.hypot(x, y), np.arctan2(y, x)),
    )


def attempt(fns: Any, seed: int | None = None) -> Result:
    """Turn to the mark that is always the same, or to a random one."""
    angle = 0.7 if seed is None else np.random.default_rng(seed).uniform(-2.0, 2.0)
    mark = np.array([np.cos(angle), np.sin(angle), 0.0])
    _, turn = fns.polar(mark[0], mark[1])
    end = np.array([np.cos(turn), np.sin(turn), 0.0])
    qpos = np.outer(np.linspace(0.0, 1.0, 11), turn * np.eye(7)[0]) + panda.READY_Q
    return Result(float(fns.angle_between(end, mark)), qpos)


def row(name: str, result: Result) -> str:
    """Return one line of the table."""
    return f"{name:12}{1e3 * result.off:11.2f}"


def summary(result: Result) -> Summary:
    """Return what is said of a result besides."""
    return Summary(
        before=["  0.00 s  turn"],
        after=["it points with its base alone"],
        number=f"{1e3 * result.off:.2f} mrad",
        of="from the arm to its mark",
        came="The arm turns to its mark; 1 mrad is allowed.",
        way="It takes one second.",
    )


def film(result: Result) -> Film:
    """Return what it looked like."""
    return Film(
        seconds=1.0,
        t=np.linspace(0.0, 1.0, len(result.qpos)),
        qpos=result.qpos,
        phases=[("turn", 0.0)],
        moments=("turn",),
        blocks=lambda qpos: [],
        model=lambda: panda.load("panda_nohand"),
        back=1.0,
    )
