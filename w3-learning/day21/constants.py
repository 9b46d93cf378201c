"""The sensitivity of Day 21's numbers: each constant doubled, measured, explained."""

from unittest.mock import patch

import numpy as np

from labkit.lesson.constants import Numbers, between, same, times
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47 import cloning, push

LAB = lab_of(find_day(21))

numbers = Numbers(
    speed="velocity along x: {} m/s",
    limit="speed limit: {} m/s",
    parts="parts of an action: {}",
    path="path of the push: {} m",
    touch="distance of contact: {} m",
    mass="mass of the puck: {} kg",
    damping="damping of the puck: {} N s/m",
    step="time step of MuJoCo: {} s",
    around="speed around the puck: {} m/s",
    wall="half of the box: {} m",
    known="known scores: {}",
    share="permitted fraction: {}",
)


@numbers.add(
    "rotation by a clamp of each entry", "{:.2f} degrees",
    speed=between(2.0, 2.2, "26.6 - 9.5 degrees: (0.2, 0.1) for (0.6, 0.1)"),
    limit=times(0.0, "0.3 is below the limit"),
)  # fmt: skip
def rotation(speed=0.3, limit=0.2):
    """Return the angle by which the clamp rotates (speed, 0.1), degrees."""
    x, y = np.clip([speed, 0.1], -limit, limit)
    return np.degrees(np.arctan2(y, x) - np.arctan2(0.1, speed))


@numbers.add(
    "error of the contact angle", "{:.2f} mrad",
    parts=times(0.5, "the error is proportional to the length of a part", within=0.03),
    path=between(5.0, 6.5, "parts twice as long, of an angle that grows faster"),
    touch=between(0.15, 0.3, "the angle changes more slowly: its rate is sin(phi) / R"),
)  # fmt: skip
def contact(parts=LAB.PARTS, path=0.04, touch=LAB.TOUCH):
    """Return the error of a push from 0.3 rad with four actions, mrad."""
    start = np.array([0.0, 0.0, touch * np.cos(0.3), touch * np.sin(0.3)])
    along = np.tile([path / 4 / LAB.TICK, 0.0], (4, 1))
    x, y, u, v = LAB.push_ahead(start, along, LAB.TICK, round(parts), touch)
    exact = cloning.contact_angle(0.3, path, touch)
    return 1e3 * (np.arctan2(v - y, u - x) - exact)


@numbers.add(
    "largest error of push_ahead after 0.3 s", "{:.1f} mm",
    step=between(2.0, 3.0, "a contact is noticed later, and is softer"),
    mass=between(0.8, 1.25, "a push that goes on hides the mass"),
    damping=between(0.8, 1.4, "a push that goes on hides the damping"),
    parts=same("it occurs at the beginning of a contact"),
)  # fmt: skip
def predicted(step=push.STEP, mass=push.MASS, damping=push.DAMPING, parts=LAB.PARTS):
    """Return the largest error of where the puck is, mm."""
    world = push.scene(step=step, mass=mass, damping=damping)
    with patch.object(LAB, "PARTS", round(parts)):
        return np.max(LAB.push_errors(world)[0])


@numbers.add(
    "pucks that come home in the box", "{:.0f}",
    wall=between(1.4, 1.6, "all of the 100: no position behind a puck is outside"),
)  # fmt: skip
def boxed(wall=LAB.WALL):
    """Return the number of pucks at home, of 100."""
    with patch.object(LAB, "WALL", wall):
        start = push.dock(LAB.TESTED, np.random.default_rng(LAB.STARTS_SEED))
        return np.sum(LAB.in_the_box(start).home())


@numbers.add(
    "false alarms of the conformal limit, from 39 scores", "{:.1f} %",
    share=times(2.0, "40 scores have 40 ranks, and 4 of them give an alarm"),
    known=between(0.7, 0.8, "3 of 79 ranks; 4 of 79 would be over 5 %"),
)  # fmt: skip
def alarms(known=39, share=LAB.SHARE):
    """Return the false alarms by all ranks of a new score, %."""
    n = round(known)
    limit = [LAB.conformal_limit(np.delete(np.arange(n + 1.0), i), share)
             for i in range(n + 1)]  # fmt: skip
    return 100 * np.mean(np.arange(n + 1) > limit)
