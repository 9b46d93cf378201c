# task 19.1: swapped
# The distances have a row for each x, and the image has a row for each y.
import numpy as np


def height_map(centres, radii, xs, ys):
    image = np.zeros((len(ys), len(xs)))
    for (x, y), r in zip(centres, radii):
        square = (xs[:, None] - x) ** 2 + (ys - y) ** 2
        image = np.maximum(image, np.sqrt(np.maximum(r**2 - square, 0)))
    return image
