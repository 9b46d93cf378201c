"""The page of a browser that draws no 3D: the numbers, and a slider for each joint.

Without WebGL viser shows nothing but its own panel. So `client.js` hides all of viser
and shows what is made here: it asks for it again and again, and it moves the arm as an
address does, by `/go?q=...`.
"""

import json
from typing import TYPE_CHECKING, Any

import mujoco
import numpy as np

from labkit.inspector import words
from labkit.inspector.common_tabs import listed

if TYPE_CHECKING:
    from labkit.inspector.app import Inspector


def page_of(page: "Inspector") -> str:
    """Return what such a page shows now, as JSON.

    Returns:
        "html": the panel's lines and matrices, and the day's tasks; "joints": the name,
        unit and ends of each; "q": their values; "named": {name: q}; "frames": which
        can be chosen; "frame": the one that is; "heard": the number of the last word
        from a browser.
    """
    arm, name = page.arm, page.frame.value
    whose = page.day.ghost.frames if page.day.ghost else ()
    parts = [page.yours.content, page.tasks.content, page.limits.content]
    parts += [words.proof(arm, name, page.seen, name in whose), listed(page.standing)]
    told = {
        "html": "".join(parts),
        "joints": [_joint(arm.model, i, name) for i, name in enumerate(arm.joints)],
        "q": page.q.tolist(),
        "named": {name: q.tolist() for name, q in arm.named_q.items()},
        "frames": list(arm.names),
        "frame": name,
        "heard": page.heard_words,
    }
    return json.dumps(told)


def _joint(model: mujoco.MjModel, i: int, name: str) -> dict[str, Any]:
    """Return what a slider needs to know of the i-th joint."""
    slides = model.jnt_type[i] == mujoco.mjtJoint.mjJNT_SLIDE
    ends = model.jnt_range[i] if model.jnt_limited[i] else (-np.pi, np.pi)
    low, high = map(float, ends)
    return {"name": name, "unit": "m" if slides else "rad", "low": low, "high": high}
