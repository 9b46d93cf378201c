"""Print what wrong formulas for the gravity stiffness do to the arm: Day 13's opening.

    python3 w2-autonomy/day13/wrong_stiffness.py

Each row is one mistake of task 13.1. The controller is designed with it and holds
the arm in MuJoCo, from two opposite starts 10 mrad away from the ready configuration.
"""

import sys
from collections.abc import Iterator
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "src"))

import kit  # noqa: F401 (goes on in the kit's own Python)
import numpy as np

from labkit.judge.row import row_of
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47 import cli, optimal, panda

DAY = find_day(13)
LAB = lab_of(DAY)
# On a table the gravity vector is vertical, so these two formulas are right there.
RIGHT_ON_A_TABLE = {"only-z", "minus-9.81"}


def slips(
    J: np.ndarray, masses: np.ndarray, coms: np.ndarray, g: np.ndarray
) -> dict[str, np.ndarray]:
    """Return the stiffness of slips that the checker finds without an entry."""
    right = optimal.gravity_stiffness
    full = right(J, masses, coms, g)
    last = np.zeros_like(full)
    last[-1, -1] = full[-1, -1]
    return {
        "no-lever": right(J, masses, 0 * coms, g),
        "last-joint-left-out": full - last,
        "mass-forgotten": right(J, np.ones_like(masses), coms, g),
        "first-mass": right(J, np.full_like(masses, masses[0]), coms, g),
        "length-1": right(J, masses, coms, g / np.linalg.norm(g)),
    }


def formulas(*given: np.ndarray) -> dict[str, np.ndarray]:
    """Return the stiffness of each wrong formula, by the name of the mistake."""
    named = row_of(DAY, "gravity_stiffness").named
    found = {one.slug: one.code for one in named[::-1]}  # the first of each name
    wrong = {slug: found[slug](*given) for slug in dict.fromkeys(m.slug for m in named)}
    return {
        k: v for k, v in (wrong | slips(*given)).items() if k not in RIGHT_ON_A_TABLE
    }


def rows() -> Iterator[tuple[str, bool, float, float]]:
    """Yield the name of each mistake, whether the arm stays, and two cost ratios."""
    model = LAB.day13_mujoco.arm()
    arm, h = panda.arm(model), model.opt.timestep
    now = arm.at(LAB.READY_Q)
    _, A, B = LAB.at_rest(model, LAB.READY_Q, h)
    x = LAB.JUDGED * np.append(LAB.WAY, np.zeros(7))
    optimum = optimal.cost_to_go(LAB.promise(A, B, h)[0], x)
    given = now.J_space, arm.masses, now.coms_world, arm.gravity
    for name, wrong in formulas(*given).items():
        P, K = LAB.promise(*optimal.linearise(now.M, wrong, arm.damping, h), h)
        cost = np.mean([LAB.paid(model, K, side * x) for side in (1, -1)])
        stays = bool(np.abs(np.linalg.eigvals(A - B @ K)).max() < 1)
        yield name, stays, cost / optimum, cost / optimal.cost_to_go(P, x)


def main() -> int:
    """Print the table; return 0."""
    print(f"{'mistake':32}{'the arm':>10}{'cost /':>12}{'measured /':>14}")
    print(f"{'':32}{'':>10}{'optimum':>12}{'predicted':>14}")
    for name, stays, over_best, over_predicted in sorted(rows(), key=lambda r: r[2]):
        dear = f"{over_best:12.3f}" if over_best < 1000 else f"{'over 1000':>12}"
        off = f"{over_predicted:14.3f}" if over_best < 1000 else f"{'':14}"
        print(f"{name:32}{'stays' if stays else 'falls':>10}{dear}{off}")
    return 0


if __name__ == "__main__":
    cli.run(main)
