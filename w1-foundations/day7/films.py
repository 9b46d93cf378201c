"""The film of Day 7, recorded by the site: the pick, with the lab's own functions."""

import day7_trajectory

from labkit.inspector.recording import Recording
from labkit.proof.capstone import recorded
from robo47 import capstone


def pick() -> Recording:
    """Return the cube being picked up and put down."""
    picked = capstone.pick(capstone.with_own(vars(day7_trajectory)))
    return recorded(capstone.film(picked))


FILMS = {"pick": pick}
