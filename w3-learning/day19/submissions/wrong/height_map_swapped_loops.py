# task 19.1: swapped
# The first index of the image is the one of x.
import numpy as np


def height_map(centres, radii, xs, ys):
    image = np.zeros((len(ys), len(xs)))
    for i, x in enumerate(xs):
        for j, y in enumerate(ys):
            for c, r in zip(centres, radii):
                d = np.hypot(x - c[0], y - c[1])
                if d < r:
                    image[i, j] = max(image[i, j], np.sqrt(r * r - d * d))
    return image
