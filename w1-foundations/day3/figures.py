"""The picture of Day 3, made with the lab's own functions; drawn by `make figures`.

singularity   step 5: singular values, joint speeds and misses along the circle
"""

import io

import matplotlib.pyplot as plt
import numpy as np
from day3_jacobian_ik import (
    DAMPING,
    DT,
    RADIUS,
    SPEED,
    best_miss,
    draw_circle,
    first_q,
)
from PIL import Image

from robo47 import jacobian, panda, screws


def singularity() -> Image.Image:
    """Return singular values, joint speeds in parts of their limits, and misses."""
    model = panda.load("panda_nohand")
    arm, limits = (panda.screws(model), panda.home_pose(model)), model.jnt_range
    q = first_q(arm, RADIUS, limits)
    _, plain, _ = draw_circle(arm, q, RADIUS, 0.0)
    off, damped, path = draw_circle(arm, q, RADIUS, DAMPING)
    least = best_miss(arm, q, RADIUS, limits)
    sigma = _singular_values(arm, path)
    time = DT * np.arange(len(damped))
    figure, panels = plt.subplots(
        3, 1, figsize=(8.0, 8.0), sharex=True, layout="constrained"
    )
    above, below, last = panels
    for panel in panels:
        panel.axvspan(*time[least > 1e-3][[0, -1]], color="0.9")
    above.semilogy(time, sigma[:, :-1], color="0.7", lw=1.2)
    above.semilogy(time, sigma[:, -1], color="tab:red", lw=2.0, label="the smallest")
    above.set_ylabel("singular values of J_site")
    above.legend(loc="lower right", frameon=False)
    below.semilogy(time, (plain / SPEED).max(axis=1), color="tab:orange", lw=1.2,
                   label="plain pseudo-inverse")  # fmt: skip
    below.semilogy(time, (damped / SPEED).max(axis=1), color="tab:blue", lw=2.0,
                   label=f"damping {DAMPING:g}")  # fmt: skip
    below.axhline(1.0, color="0.3", lw=0.8, ls="--")
    below.set_ylabel("fastest joint / its limit")
    below.legend(loc="upper right", frameon=False)
    last.plot(time, off, color="tab:blue", lw=2.0, label=f"damping {DAMPING:g}")
    last.plot(time, least, color="0.3", lw=1.5, label="the best joint angles")
    last.set_ylabel("off the circle, mm")
    last.set_xlabel("seconds along the circle")
    last.legend(loc="upper right", frameon=False)
    title = f"A circle of {RADIUS} m: grey is out of reach"
    above.set_title(f"{title}; near 4.6 s it is nearly singular", loc="left")
    return _picture(figure)


def _singular_values(arm: tuple, path: np.ndarray) -> np.ndarray:
    """Return the six singular values of J_site along a path, (n, 6)."""
    S, M = arm
    p = screws.fk_space(S, M, path)[:, :3, 3]
    J = jacobian.site_jacobian(jacobian.space_jacobian(S, path), p)
    return np.linalg.svd(J, compute_uv=False)


def _picture(figure: plt.Figure) -> Image.Image:
    buffer = io.BytesIO()
    figure.savefig(buffer, dpi=110)
    plt.close(figure)
    buffer.seek(0)
    return Image.open(buffer).convert("RGB")


FIGURES = {"singularity": singularity}
