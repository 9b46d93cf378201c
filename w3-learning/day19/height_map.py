"""19.1 `height_map(centres, radii, xs, ys)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row, Slip

SWAPPED = (
    "Your code uses one row for each entry of xs. Use one row for each entry of ys "
    "instead, because pixel [i, j] is at (xs[j], ys[i])."
)
ROWS_OF_XS = (  # a loop over xs whose index is an entry's first
    r"for (\w+)(, \w+ in enumerate\(| in range\(len\()xs\)"
    r"[\s\S]{1,400}\[\1, ?\w+\]"
)
row = Row(
    Matrix((None, None), "m", scale=0.05),
    slips=(
        Slip(
            r"^ValueError.*broadcast.*\((\d+),(\d+)\) \(\2,\1\)", "", "swapped", SWAPPED
        ),
        Slip(
            "^IndexError.*out of bounds for axis",
            ROWS_OF_XS,
            "swapped",
            SWAPPED,
        ),
    ),
)


def view(rng, k, w, h, size=0.05):
    """Return k spheres and the coordinates of w columns and h rows, m."""
    xs, ys = (np.sort(size * rng.numbers(-2, 2, n)) for n in (w, h))
    radii = size * rng.numbers(0.5, 2, k)
    return size * rng.numbers(-1.5, 1.5, k, 2), radii, xs, ys


@row.inputs
def _(rng):
    yield np.zeros((1, 2)), np.array([0.05]), np.array([0.0, 0.03]), np.zeros(1)
    # The later sphere is lower where both are hit, and then higher.
    both = np.array([[0.0, 0], [0.03, 0.01]])
    line = np.array([-0.02, 0.0, 0.02, 0.05])
    for radii in ((0.05, 0.03), (0.03, 0.05)):
        yield both, np.array(radii), line, np.array([-0.01, 0.01])
    for k, w, h in ((1, 4, 2), (2, 3, 5), (3, 5, 4), (2, 4, 4)):
        yield view(rng, k, w, h)
    yield view(rng, *(int(n) for n in rng.integers(2, 6, 3)))


row.cases(
    one_sphere=lambda centres, radii, xs, ys: len(radii) == 1,
    several_spheres=lambda centres, radii, xs, ys: len(radii) > 1,
)


@row.wrongs
def _(centres, radii, xs, ys):
    """added: your code adds the heights of several spheres at the same pixel. A ray
      from above stops at the highest sphere, so use the largest height
    flat: your code returns the radius r as the height at every pixel that the sphere
      covers. At the horizontal distance d from the centre, the height is sqrt(r^2 -
      d^2)
    cone: your code uses r - d as the height, where d is the horizontal distance from
      the centre. In a sphere, r is the hypotenuse of a right triangle whose legs are d
      and the height
    last-wins: your code replaces the height of an earlier sphere even where the later
      sphere is lower. A ray from above stops at the highest sphere, so use the largest
      height
    lowest: your code returns the smallest of the spheres' heights at each pixel. A ray
      from above stops at the highest sphere, so use the largest height
    first-hit: your code returns the height of the first sphere in the list that the ray
      hits. A ray from above stops at the highest sphere, so compare the heights of all
      spheres
    nearest-centre: your code considers only the sphere whose centre is nearest to the
      ray. A larger sphere farther away can be higher at this pixel, so compare the
      heights of all spheres
    sum-of-distances: your code uses |dx| + |dy| as the horizontal distance. Use
      sqrt(dx^2 + dy^2) instead, where dx and dy are the distances along x and y
    transposed: your image has one row for each entry of xs. Return one row for each
      entry of ys instead, because pixel [i, j] is at (xs[j], ys[i])
    """
    dx = xs - centres[:, 0, None, None]
    dy = ys[:, None] - centres[:, 1, None, None]
    d2 = dx**2 + dy**2
    r = radii[:, None, None]
    hit = d2 < r**2
    square = np.maximum(r**2 - d2, 0)
    heights = np.sqrt(square)
    last = np.zeros(square.shape[1:])
    for one, some in zip(heights, hit):
        last[some] = one[some]

    def of_sphere(chosen):
        return np.take_along_axis(heights, chosen[None], axis=0)[0]

    return {
        "added": heights.sum(axis=0),
        "flat": (hit * r).max(axis=0),
        "cone": np.maximum(r - np.sqrt(d2), 0).max(axis=0),
        "last-wins": last,
        "lowest": heights.min(axis=0),
        "first-hit": of_sphere(hit.argmax(axis=0)),
        "nearest-centre": of_sphere(d2.argmin(axis=0)),
        "sum-of-distances": np.sqrt(
            np.maximum(r**2 - (abs(dx) + abs(dy)) ** 2, 0).max(axis=0)
        ),
        "transposed": heights.max(axis=0).T,
    }


row.at_least_0(radii="a radius", answer="a height above the table")


@row.right  # Ray by ray.
def _(centres, radii, xs, ys):
    image = np.zeros((len(ys), len(xs)))
    for i in range(len(ys)):
        for j in range(len(xs)):
            for k in range(len(radii)):
                d = np.hypot(xs[j] - centres[k, 0], ys[i] - centres[k, 1])
                if d < radii[k]:
                    image[i, j] = max(image[i, j], (radii[k] ** 2 - d**2) ** 0.5)
    return image


@row.right  # All spheres at once.
def _(centres, radii, xs, ys):
    X, Y = np.meshgrid(xs, ys)
    d2 = (X[..., None] - centres[:, 0]) ** 2 + (Y[..., None] - centres[:, 1]) ** 2
    return np.sqrt(np.clip(radii**2 - d2, 0, None).max(axis=-1))


@row.spans
def _(rng):
    for size in (0.002, 0.01, 0.1):
        yield view(rng, 3, 9, 12, size)
    grid = np.linspace(-0.55, 0.55, 12)
    yield np.array([[-0.4, 0.4]]), np.array([0.05]), grid, grid
