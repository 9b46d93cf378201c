"""One comparator for poses: shape, NaN and the largest entry, both printed."""

import numpy as np


def assert_same(ours, truth, tol=1e-12):
    """Fail unless two arrays agree in shape and in every entry to tol."""
    ours, truth = np.asarray(ours), np.asarray(truth)
    assert ours.shape == truth.shape, f"shapes {ours.shape} and {truth.shape}"
    off = np.abs(ours - truth)
    assert bool((off <= tol).all()), f"off by {off.max():.3g}\n{ours}\n{truth}"
