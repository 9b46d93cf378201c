"""46.6 `normal(v)`: a vector to which many answers are right."""

import numpy as np

from labkit.judge import Finding, Row, Vector

from .pairs import vectors


def is_normal(v, n):
    """Return what is wrong with an answer, or None."""
    if abs(np.linalg.norm(n) - 1.0) > 1e-9:
        return Finding("not-unit", f"Its length is {np.linalg.norm(n):.3g}, not 1.")
    if abs(n @ v) > 1e-9:
        return Finding("not-normal", "It is not at a right angle to v.")
    return None


row = Row(Vector((3,)), accept=is_normal)
row.inputs(vectors)
