"""How tests look at pictures."""

import numpy as np


def pixels(picture):
    return np.asarray(picture).astype(int)


def differing(a, b):
    """Return the share of pixels that differ by more than drivers' rounding."""
    return float((np.abs(pixels(a) - pixels(b)).max(axis=2) > 40).mean())


def count(picture, colour):
    """Return how many pixels have nearly that colour."""
    return int((np.abs(pixels(picture) - colour).max(axis=2) < 12).sum())
