"""Day 19: from pixels, with a camera in place of the four coordinates.

    make day19                       in the clone: sets all up, then runs this
    python src/day19_pixels.py       in w3-learning/, once that is done

An image is an array (h, w): the first index goes along y and the second along x. The
camera has 12 x 12 pixels, 100 mm apart, and one channel each for pusher and puck. A
network is six arrays, as on Day 15, and losses are computed on normalised actions.
"""

import kit  # noqa: F401 (goes on in the kit's own Python)
import mujoco
import numpy as np

from robo47 import cli, cloning, pixels
from robo47.lesson.lab import Lab
from robo47.policy import success_rate

import day15_mujoco
import day19_mujoco

SEED = 2  # of the demonstrations, the initial weights and the batches
DEMOS = 60  # episodes of each training
HELD_OUT = 20  # further episodes that have no part in it
STARTS_SEED = 1000  # of the starts that policies are tested on
TESTED = 100  # starts
UNITS = 24  # of each hidden layer
UPDATES = 1500  # steps of Adam
BATCH = 256  # rows of a step
RATE = 0.003  # step size at the first update; it falls to 0 as a cosine
CELL = 0.1  # m between two pixels of the camera
GRID = CELL * (np.arange(12) - 5.5)  # m, their coordinates along x, and along y
BLUR = 0.5  # pixels, standard deviation of the camera's blur
BLURS = (0.3, 0.4, 0.5, 0.6)  # pixels, compared in step 4
FINER = 8  # points of the fine grid per pixel, before the image is sampled
PINHOLES = 4000  # images of the camera without blur
OFFSETS = (0.005, 0.01, 0.02)  # m, offsets of the camera along x
# The learned kernel.
SMALL, LARGE = 0.02, 0.05  # m, radii of the two spheres
SCENES = 200  # height maps for the training, and as many others for the test
TABLE = 0.02 * (np.arange(21) - 10)  # m, coordinates of the pixels of a height map
ROOM = 0.14  # m, the largest coordinate of a centre
TEMPERATURE = 0.1  # of the softmax
KERNEL_UPDATES, KERNEL_BATCH, KERNEL_RATE = 200, 8, 0.03


def height_map(
    centres: np.ndarray, radii: np.ndarray, xs: np.ndarray, ys: np.ndarray
) -> np.ndarray:
    """Return the height, m, at which a vertical ray hits the highest sphere, (h, w).

    The centres (k, 2) of the spheres have the height 0, and radii (k,) are their radii,
    m. Pixel [i, j] is at (xs[j], ys[i]); the coordinates are xs (w,) and ys (h,), m.
    Where a ray hits no sphere, the height is 0.
    height_map([[0, 0]], [0.05], [0, 0.03], [0]) -> [[0.05, 0.04]]
    """
    # region 19.1
    highest = np.zeros((len(ys), len(xs)))  # the image of an empty table
    for (x, y), r in zip(centres, radii, strict=True):
        square = (xs - x) ** 2 + (ys[:, None] - y) ** 2  # squared distance of each ray
        height = np.sqrt(np.maximum(r**2 - square, 0))  # height of one sphere
        highest = np.maximum(highest, height)  # largest height at each pixel
    return highest  # the height map
    # endregion 19.1


def gaussian_kernel(sigma: float, half: int) -> np.ndarray:
    """Return a square kernel with the values of a Gaussian, whose entries sum to 1.

    sigma is the standard deviation, pixels. The kernel has 2 half + 1 rows and columns,
    and the Gaussian is centred on the middle entry.
    gaussian_kernel(1, 1) -> [[0.075114, 0.123841, 0.075114], [0.123841, 0.204180,
    0.123841], [0.075114, 0.123841, 0.075114]]
    """
    # region 19.2
    at = np.arange(-half, half + 1)  # pixels from the middle
    row = np.exp(-(at**2) / (2 * sigma**2))  # the Gaussian along one axis
    kernel = np.outer(row, row)  # the Gaussian in two dimensions
    return kernel / kernel.sum()  # the kernel with the sum 1
    # endregion 19.2


def conv2d(image: np.ndarray, kernel: np.ndarray, stride: int) -> np.ndarray:
    """Return the cross-correlation of an image with a kernel.

    Output [i, j] is the sum of the products of corresponding entries of the kernel (p,
    q) and a window of the same size, which begins at [i stride, j stride] of the image
    (h, w). The kernel is not flipped. There is one output for each window that lies in
    the image.
    conv2d([[0, 1, 2], [3, 4, 5], [6, 7, 8]], [[1, 0], [0, 2]], 1) -> [[8, 11], [17,
    20]]
    """
    # region 19.3
    p, q = kernel.shape  # rows and columns of the kernel
    rows = (image.shape[0] - p) // stride + 1  # number of windows along y
    columns = (image.shape[1] - q) // stride + 1  # number of windows along x
    out = 0  # the initial sum
    for a in range(p):
        for b in range(q):
            seen = image[a::stride, b::stride]  # entry [a, b] of the windows
            out = out + kernel[a, b] * seen[:rows, :columns]  # the accumulated sum
    return out  # the sum of each window
    # endregion 19.3


def conv2d_gradient(
    image: np.ndarray, kernel: np.ndarray, stride: int, d: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the gradients of a loss with respect to the kernel and to the image.

    image (h, w), kernel (p, q) and stride are as in `conv2d`. d (m, n) is the gradient
    of the loss with respect to the output of `conv2d`.
    conv2d_gradient([[0, 1, 2], [3, 4, 5], [6, 7, 8]], [[1, 0], [0, 2]], 1, [[1, 0], [0,
    0]]) -> ([[0, 1], [3, 4]], [[1, 0, 0], [0, 2, 0], [0, 0, 0]])
    """
    # region 19.4
    of_kernel = np.zeros(kernel.shape)  # initial gradient with respect to the kernel
    of_image = np.zeros(image.shape)  # initial gradient with respect to the image
    rows, columns = d.shape  # numbers of windows along y and x
    for a in range(kernel.shape[0]):
        for b in range(kernel.shape[1]):
            seen = (  # entry [a, b] of all windows
                slice(a, a + stride * (rows - 1) + 1, stride),
                slice(b, b + stride * (columns - 1) + 1, stride),
            )
            of_kernel[a, b] = np.sum(d * image[seen])  # derivative for one kernel entry
            of_image[seen] += d * kernel[a, b]  # accumulated gradient for the pixels
    return of_kernel, of_image  # both gradients
    # endregion 19.4


def spatial_softmax(
    maps: np.ndarray, xs: np.ndarray, ys: np.ndarray, temperature: float
) -> np.ndarray:
    """Return the expected position (x, y) in each map, (c, 2).

    The weights of each of the maps (c, h, w) are the softmax of its entries divided by
    the temperature. Pixel [i, j] is at (xs[j], ys[i]), with xs (w,) and ys (h,). An
    entry may be -inf: its weight is 0. Entries may be large, but exp must not overflow.
    Complex arrays are accepted.
    spatial_softmax([[[0, log(3)]]], [0, 1], [5], 1) -> [[0.75, 5]]
    """
    # region 19.5
    most = maps.max(axis=(1, 2), keepdims=True)  # the largest entry of each map
    weight = np.exp((maps - most) / temperature)  # unnormalised weights
    p = weight / weight.sum(axis=(1, 2), keepdims=True)  # the weights of the pixels
    x = np.sum(p * xs, axis=(1, 2))  # the expected x
    y = np.sum(p * ys[:, None], axis=(1, 2))  # the expected y
    return np.stack([x, y], axis=1)  # the expected positions
    # endregion 19.5


def spatial_softmax_gradient(
    maps: np.ndarray, xs: np.ndarray, ys: np.ndarray, temperature: float, d: np.ndarray
) -> np.ndarray:
    """Return the gradient of a loss with respect to maps, of their shape (c, h, w).

    The maps, xs (w,), ys (h,) and temperature are as in `spatial_softmax`. d (c, 2) is
    the gradient of the loss with respect to the result of `spatial_softmax`.
    spatial_softmax_gradient([[[0, log(3)]]], [0, 1], [5], 1, [[1, 0]]) -> [[[-0.1875,
    0.1875]]]
    """
    # region 19.6
    most = maps.max(axis=(1, 2), keepdims=True)  # the largest entry of each map
    weight = np.exp((maps - most) / temperature)  # unnormalised weights
    p = weight / weight.sum(axis=(1, 2), keepdims=True)  # the weights of the pixels
    at = d[:, 0, None, None] * xs + d[:, 1, None, None] * ys[:, None]  # x d_x + y d_y
    mean = np.sum(p * at, axis=(1, 2), keepdims=True)  # expected value of x d_x + y d_y
    return p * (at - mean) / temperature  # the gradient
    # endregion 19.6


def centroid_error(spacing: float, sigma: float) -> float:
    """Return the largest error of the centroid of a blurred point that is sampled.

    The pixels are spacing apart, and sigma is the standard deviation of the blur; the
    result has their unit. Only the lowest frequency of the error is considered.
    centroid_error(1, 0.5) -> 0.022594
    """
    # region 19.7
    ratio = sigma / spacing  # the blur in pixels
    decay = np.exp(-2 * np.pi**2 * ratio**2)  # the first term of Poisson's sum
    return 4 * np.pi * ratio**2 * decay * spacing  # the largest error
    # endregion 19.7


def quarter_turn(
    images: np.ndarray, action: np.ndarray, k: int
) -> tuple[np.ndarray, np.ndarray]:
    """Return images (c, h, h) and action (2,) after k quarter turns of the scene.

    A quarter turn maps the point (x, y) to (-y, x), and k may be negative. Pixel [i, j]
    of an image is at the x of column j and the y of row i; both increase with the index
    and are 0 in the middle of the image. Return copies.
    quarter_turn([[[1, 2], [3, 4]]], [0.1, 0.2], 1) -> ([[[3, 1], [4, 2]]], [-0.2, 0.1])
    """
    # region 19.8
    for _ in range(k % 4):
        images = images[:, ::-1].transpose(0, 2, 1)  # rotated images
        action = np.array([-action[1], action[0]])  # the rotated vector
    return images.copy(), action.copy()  # the rotated images and the action
    # endregion 19.8


def check_rays(lab: Lab) -> None:
    """Compare your height map with a ray of MuJoCo's for each pixel."""
    centres = np.array([[0.011, -0.032], [0.053, 0.021], [-0.204, 0.103]])
    radii = np.array([0.0501, 0.0303, 0.1503])  # no ray is tangent to a sphere
    xs = np.linspace(-0.1, 0.1, 41)
    ys = np.linspace(-0.08, 0.12, 41)
    # mujoco.mj_ray starts a ray above each pixel
    truth = day19_mujoco.ray_heights(centres, radii, xs, ys)
    off = height_map(centres, radii, xs, ys) - truth
    lab.record("ray", off, label=f"|height_map - mj_ray|, {off.size} rays")


def pinholes(lab: Lab, rng: np.random.Generator) -> None:
    """Count the images without blur in which no pixel shows a body."""
    for name, r in (("pusher", day15_mujoco.PUSHER), ("puck", day15_mujoco.PUCK)):
        places = rng.uniform(-0.4, 0.4, (PINHOLES, 1, 2))
        missed = [not height_map(at, np.array([r]), GRID, GRID).any() for at in places]
        predicted = 1 - np.pi * r**2 / CELL**2
        print(f"  no pixel shows the {name:6}: predicted {predicted:.3f}, "
              f"measured {np.mean(missed):.3f}")  # fmt: skip
        lab.measured(f"images that do not show the {name}, fraction", np.mean(missed))


def check_convolution(lab: Lab, rng: np.random.Generator) -> list[float]:
    """Check kernel and convolution; return the errors of the convolution's gradient."""
    kernel = gaussian_kernel(1.5, 4)
    at = np.arange(-4, 5)
    square = at**2 + at[:, None] ** 2
    lab.check("gaussian_kernel: the sum - 1", kernel.sum() - 1)
    falls = np.log(kernel[4, 4] / kernel) - square / (2 * 1.5**2)
    lab.check("its logarithm - by its definition", falls)
    image, kernel, other = (rng.normal(size=size) for size in ((10, 9), (3, 2), (3, 2)))
    wanted = [[np.sum(image[i : i + 3, j : j + 2] * kernel) for j in (0, 2, 4, 6)]
              for i in (0, 2, 4, 6)]  # fmt: skip
    out = conv2d(image, kernel, 2)
    lab.check("conv2d - by its definition", out - wanted)
    d = rng.normal(size=out.shape)
    of_kernel, of_image = conv2d_gradient(image, kernel, 2, d)
    noise = rng.normal(size=image.shape)
    return [
        np.sum(d * conv2d(image, other, 2)) - np.sum(of_kernel * other),
        np.sum(d * conv2d(noise, kernel, 2)) - np.sum(of_image * noise),
    ]


def check_softmax(lab: Lab, rng: np.random.Generator) -> np.ndarray:
    """Check the softmax; return the errors of its gradient."""
    maps, xs, ys = rng.normal(size=(2, 3, 4)), rng.normal(size=4), rng.normal(size=3)
    heat = 0.7
    weight = np.exp(maps / heat)
    places = [[np.average(x, weights=one) for x in np.meshgrid(xs, ys)]
              for one in weight]  # fmt: skip
    lab.check("spatial_softmax - by weighted means",
              spatial_softmax(maps, xs, ys, heat) - places)  # fmt: skip
    d = rng.normal(size=(2, 2))
    wanted = cloning.complex_step(
        lambda some: np.sum(d * spatial_softmax(some, xs, ys, heat)), [maps]
    )[0]
    return spatial_softmax_gradient(maps, xs, ys, heat, d) - wanted


def check_gradients(lab: Lab, rng: np.random.Generator) -> None:
    """Compare both gradients with the definition of a gradient."""
    off = [*check_convolution(lab, rng), *np.ravel(check_softmax(lab, rng))]
    lab.record("gradient", off, label="|gradients - by products and complex step|")


def scenes(rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Return height maps of two spheres, in units of LARGE, and both centres."""
    images, places = [], []
    while len(images) < SCENES:
        both = rng.uniform(-ROOM, ROOM, (2, 2))
        if np.linalg.norm(both[0] - both[1]) > SMALL + LARGE:
            some = height_map(both, np.array([SMALL, LARGE]), TABLE, TABLE)
            images.append(some / LARGE)
            places.append(both)
    return np.array(images), np.array(places)


def found(image: np.ndarray, kernel: np.ndarray) -> np.ndarray:
    """Return the map of an image, (1, h, w), and the position in it, m, (1, 2)."""
    some = conv2d(image, kernel, 1)[None]
    inner = TABLE[2:-2]  # the middles of the windows
    return some, spatial_softmax(some, inner, inner, TEMPERATURE)


def learned_kernel(lab: Lab) -> tuple[np.ndarray, list[float]]:
    """Return a kernel that finds the small sphere, and the loss of each step."""
    rng = np.random.default_rng(SEED)
    images, places = scenes(rng)
    kernel = np.zeros((5, 5))
    kernel[2, 2] = 1.0  # the map is the image at first
    losses: list[float] = []

    def gradient(rows, arrays):
        total = np.zeros_like(kernel)
        losses.append(0.0)
        for row in rows:
            some, place = found(images[row], arrays[0])
            error = (place - places[row, :1]) / CELL
            losses[-1] += np.sum(error**2) / len(rows)
            d = 2 * error / CELL / len(rows)
            inner = TABLE[2:-2]
            slope = spatial_softmax_gradient(some, inner, inner, TEMPERATURE, d)
            total += conv2d_gradient(images[row], arrays[0], 1, slope[0])[0]
        return [total]

    updates = lab.training("a kernel", KERNEL_UPDATES)
    steps = cloning.batches(rng, SCENES, KERNEL_BATCH, updates)
    (kernel,) = cloning.fit(
        [kernel],
        gradient,
        steps,
        lambda k: cloning.cosine_rate(k, KERNEL_UPDATES, KERNEL_RATE),
    )
    return kernel, losses


def learn_kernel(lab: Lab) -> None:
    """Learn a kernel, and test it on other scenes."""
    kernel, losses = learned_kernel(lab)
    first, last = losses[0], np.mean(losses[-20:])
    print(f"  loss {first:.1f} at first, {last:.2f} in the last steps")
    images, places = scenes(np.random.default_rng(STARTS_SEED))
    ends = np.array([found(image, kernel)[1][0] for image in images])
    for name, of in zip(("small", "large"), places.transpose(1, 0, 2), strict=True):
        off = np.median(np.linalg.norm(ends - of, axis=1))
        print(f"  from the {name} sphere: {1e3 * off:.0f} mm, the median")
    edge = np.r_[kernel[0], kernel[-1], kernel[1:-1, 0], kernel[1:-1, -1]]
    print(f"  kernel: {kernel[2, 2]:.1f} in the middle, "
          f"{edge.mean():.1f} on average at the edge")  # fmt: skip


def sampled_centroid(blur: float, shift: int) -> float:
    """Return the error of the centroid of a point of light, m.

    The point is on a grid that is FINER than the pixels, shift of its cells from the
    middle pixel along x. Your kernel blurs it, and your convolution samples it.
    """
    half = int(6 * blur * FINER)
    fine = pixels.pixel_grid(finer=FINER, margin=half)
    middle = half + FINER * (len(GRID) // 2)
    image = np.zeros((len(fine), len(fine)))
    image[middle, middle + shift] = 1.0
    kernel = gaussian_kernel(blur * FINER, half)
    seen = conv2d(image, kernel, FINER)
    return place_of(seen[None])[0, 0] - fine[middle + shift]


def place_of(images: np.ndarray) -> np.ndarray:
    """Return the centroid of each image (n, h, w), m, by the spatial softmax."""
    return spatial_softmax(np.log(images + 1e-300), GRID, GRID, 1.0)


def alias(lab: Lab) -> None:
    """Compare the largest error of a centroid with the prediction."""
    print("  blur, pixels   predicted   measured, mm")
    for blur in BLURS:
        errors = [sampled_centroid(blur, shift) for shift in range(FINER // 2)]
        predicted, worst = centroid_error(CELL, blur * CELL), np.max(np.abs(errors))
        print(f"{blur:14.1f}{1e3 * predicted:12.3f}{1e3 * worst:15.3f}")
        if blur == BLUR:
            lab.measured("largest error of a centroid, mm", 1e3 * worst)
            lab.record("alias", worst / predicted - 1, metric="ratio_off",
                       label="|measured / predicted - 1| at half a pixel")  # fmt: skip


def camera(seen: np.ndarray, offset: float = 0.0) -> np.ndarray:
    """Return the images of observations (n, 4), (n, 2, 12, 12).

    A camera with an `offset` along x, m, sees everything as far to the left.
    """
    points = seen.reshape(-1, 2, 2) - np.array([offset, 0.0])
    return pixels.spot_images(points, GRID, GRID, BLUR * CELL)


def as_pixels(images: np.ndarray) -> np.ndarray:
    """Return the pixels of each image as a row, (n, 288)."""
    return images.reshape(len(images), -1)


def as_centroids(images: np.ndarray) -> np.ndarray:
    """Return both centroids of each image as a row, (n, 4)."""
    n, c, h, w = images.shape
    return place_of(images.reshape(n * c, h, w)).reshape(n, -1)


class Policy:
    """A network with the features of an image that it observes."""

    def __init__(self, lab: Lab, title: str, features, images, action) -> None:
        """Train the network on images and actions."""
        self.features = features
        x = features(images)
        self.inputs, self.actions = cloning.fit_scaler(x), cloning.fit_scaler(action)
        z = cloning.normalise(x, self.inputs)
        target = cloning.normalise(action, self.actions)
        rng = np.random.default_rng(SEED)
        updates = lab.training(title, UPDATES)
        self.net = cloning.fit(
            cloning.random_net(rng, x.shape[1], UNITS, 2),
            lambda rows, net: cloning.mlp_gradient(z[rows], target[rows], *net),
            cloning.batches(rng, len(x), BATCH, updates),
            lambda k: cloning.cosine_rate(k, UPDATES, RATE),
        )

    def predict(self, images: np.ndarray) -> np.ndarray:
        """Return the normalised action for each image, (n, 2)."""
        x = cloning.normalise(self.features(images), self.inputs)
        return cloning.mlp(x, *self.net)

    def loss(self, images: np.ndarray, action: np.ndarray) -> float:
        """Return the mean squared error of the normalised actions."""
        wanted = cloning.normalise(action, self.actions)
        return cloning.mse(self.predict(images), wanted)[0]

    def tested(self, offset: float = 0.0) -> day15_mujoco.Episodes:
        """Return the episodes from the starts of the test, with an offset camera."""
        start = day15_mujoco.starts(TESTED, np.random.default_rng(STARTS_SEED))

        def act(seen: np.ndarray) -> np.ndarray:
            return cloning.denormalise(self.predict(camera(seen, offset)), self.actions)

        # mujoco.mj_step runs the policy
        return day15_mujoco.run(*day15_mujoco.scene(), start, act)


def demonstrations():
    """Return images and actions for the training, and the same held out."""
    episodes = day15_mujoco.demonstrations(DEMOS + HELD_OUT, SEED)
    seen, action, episode = episodes.rows()
    images = camera(seen)
    known = episode < DEMOS
    return images[known], action[known], (images[~known], action[~known])


def home(policy: Policy, title: str, held) -> day15_mujoco.Episodes:
    """Print how well a policy predicts and pushes; return its episodes."""
    run = policy.tested()
    came = run.home()
    n = 10 * round(np.sum(came) / 10)  # it may differ between machines
    _, low, high = success_rate(np.arange(len(came)) < n)
    print(f"  {title:18} held out {policy.loss(*held):.1g}, home about {n:3} of "
          f"{len(came)}, 95 %: {low:.2f} to {high:.2f}")  # fmt: skip
    return run


def from_pixels(lab: Lab, images, action, held):
    """Train on pixels and on centroids; return the second policy and both runs."""
    runs = []
    for title, features in (("288 pixels", as_pixels), ("4 centroids", as_centroids)):
        policy = Policy(lab, title, features, images, action)
        print(f"  {title:18} loss {policy.loss(images, action):.3f}")
        runs.append(home(policy, "", held))
    return policy, *runs


def offset_camera(lab: Lab, policy: Policy, run: day15_mujoco.Episodes) -> None:
    """Measure where the puck ends if the camera has an offset."""
    print("  camera off by   shift of the puck   home")
    base = ends_of(run)
    for offset in OFFSETS:
        run = policy.tested(offset)
        shift = ends_of(run) - base
        n = 5 * round(np.sum(run.home()) / 5)
        print(
            f"{1e3 * offset:13.0f} mm{1e3 * shift:17.0f} mm   about {n:3} of {TESTED}"
        )
        if offset == 0.01:
            lab.measured("shift of the puck, camera off by 10 mm, mm", 1e3 * shift)
            lab.record("beside", 1e3 * (shift - offset), metric="mm_off",
                       label="|shift - 10 mm|")  # fmt: skip


def ends_of(run: day15_mujoco.Episodes) -> float:
    """Return the mean of the x at which the pucks end, m."""
    return float(np.mean(run.observation[:, -1, 2]))


def check_turns(lab: Lab, rng: np.random.Generator) -> None:
    """Compare rotated images with images of rotated points."""
    off = []
    for k in (-1, 0, 1, 2, 7):
        points = rng.uniform(-0.4, 0.4, (2, 2))
        angle = np.pi / 2 * k
        R = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        images = pixels.spot_images(points, GRID, GRID, CELL)
        turned, action = quarter_turn(images, points[0], k)
        wanted = pixels.spot_images(points @ R.T, GRID, GRID, CELL)
        off += [np.max(np.abs(turned - wanted)), *(action - R @ points[0])]
    lab.check("quarter_turn - by rotated points", off)


def turned_data(images: np.ndarray, action: np.ndarray):
    """Return four times the data: every image and action after 0 to 3 quarter turns."""
    pairs = [
        quarter_turn(one, some, k)
        for k in range(4)
        for one, some in zip(images, action, strict=True)
    ]
    return tuple(np.array(some) for some in zip(*pairs, strict=True))


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    rng = np.random.default_rng(SEED)
    print(f"MuJoCo {mujoco.mj_versionString()}: a camera above the table")

    lab.step("1. A ray for each pixel, and what pinholes miss")
    check_rays(lab)
    pinholes(lab, rng)

    lab.step("2. Convolution and spatial softmax, with their gradients")
    check_gradients(lab, rng)

    lab.step("3. A kernel that is learned")
    if lab.failed:
        print("  not trained, because a check above failed")
    else:
        learn_kernel(lab)

    lab.step("4. Blur before you sample")
    alias(lab)
    if lab.failed:
        print("\nNot trained, because a check above failed. ARGS=--try trains anyway.")
        return lab.finish()

    lab.step(f"5. From pixels to the robot: {DEMOS} demonstrations")
    images, action, held = demonstrations()
    policy, before, run = from_pixels(lab, images, action, held)

    lab.step("6. The camera has moved")
    offset_camera(lab, policy, run)

    lab.step("7. Four demonstrations from one")
    check_turns(lab, rng)
    four = turned_data(images, action)
    title = "288 pixels, turned"
    turned = Policy(lab, title, as_pixels, *four)
    print(f"  {title:18} loss {turned.loss(*four):.2f}")
    gain = np.sum(home(turned, "", held).home()) - np.sum(before.home())
    lab.record("turned", 10 * round(gain / 10), metric="starts", seed=SEED,
               label="pucks with quarter turns minus without")  # fmt: skip
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
