"""The result of a push. Metres, seconds; in names millimetres."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from robo47.checks import Array
from robo47.pushing import task

SEEN_MM = 4.0  # mm: an eye that is further off than this is not the one that was built
LAG_MM = 15.0  # mm: a sphere that lags further does not follow its set point


class Result(NamedTuple):
    """The result of a push."""

    place_mm: float  # distance of the puck from home, at the end
    time: float  # since when it stays home, s after the push began; nan if it does not
    left: bool  # the sphere goes around the puck on the left, seen towards home
    seen_mm: float  # worst error of the eye
    lag_mm: float  # worst distance of the sphere from its set point
    new: float  # largest distance from the demonstrations, standard deviations
    limit: float  # of the guard
    moved: bool  # the simulation moved the puck aside once
    stopped: str  # why it did not go on; "" where it did
    observed: Array  # observations at the ticks, (ticks, 4)
    seconds: float  # the duration of the task in the simulation
    phases: list[tuple[str, float]]  # (name, when it began in seconds), in order
    t: Array  # time of each control instant, seconds, (N,)
    qpos: Array  # everything's configuration then, (N, nq): for pictures and replays
    homes: tuple[bool, ...] = ()  # of several pucks: which come home, and ...
    places_mm: tuple[float, ...] = ()  # ... where each ends

    @property
    def home(self) -> bool:
        """The puck is home at the end, and nothing stopped the arm."""
        return not self.stopped and self.place_mm < task.HOME_MM

    @property
    def failed(self) -> bool:
        """The puck is not home, or an important number is off."""
        return not (self.home and self.seen_mm < SEEN_MM and self.lag_mm < LAG_MM)


def of(done: task.Push) -> Result:
    """Return the result of a push, as far as it went."""
    qpos = np.array([seen for run in done.runs for seen in run.seen])
    t = np.linspace(done.now / len(qpos), done.now, len(qpos))
    observed = np.array(done.observed)
    puck = qpos[:, done.address : done.address + 2]
    place = 1e3 * np.linalg.norm(puck, axis=1)
    time = _home_since(place, t - done.began)
    home = [] if np.isnan(time) else [("home", done.began + time)]
    return Result(
        place_mm=float(place[-1]),
        time=time,
        left=_on_the_left(observed),
        seen_mm=1e3 * max(done.seen_off),
        lag_mm=1e3 * done.arm.worst,
        new=max(done.guard.scores),
        limit=done.guard.limit,
        moved=done.options.moved,
        stopped=done.stopped,
        observed=observed,
        seconds=done.now,
        phases=sorted([*done.phases, *home], key=lambda phase: phase[1]),
        t=t,
        qpos=qpos,
    )


def worst(results: Sequence[Result]) -> Result:
    """Return the first of several results, with the worst number of all of them."""

    def most(name: str) -> float:
        return float(np.max([getattr(one, name) for one in results]))  # NaN stays

    return results[0]._replace(
        place_mm=most("place_mm"),
        time=most("time"),
        seen_mm=most("seen_mm"),
        lag_mm=most("lag_mm"),
        new=most("new"),
        stopped=next(filter(None, (one.stopped for one in results)), ""),
        homes=tuple(one.home for one in results),
        places_mm=tuple(one.place_mm for one in results),
    )


def _home_since(place: Array, t: Array) -> float:
    """Return the time since when the puck stays home; nan if it is not home."""
    away = np.flatnonzero(place >= task.HOME_MM)
    if len(away) == 0:
        return 0.0
    return float(t[away[-1] + 1]) if away[-1] + 1 < len(t) else np.nan


def _on_the_left(observed: Array) -> bool:
    """Return on which side the sphere first goes around the puck, seen towards home."""
    puck = observed[0, 2:]
    left = np.array([puck[1], -puck[0]])
    before = observed[: int(task.ROUND_SECONDS * 10), :2] - puck
    beside = before @ left
    return bool(beside[np.argmax(np.abs(beside))] > 0.0)
