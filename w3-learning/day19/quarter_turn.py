"""19.8 `quarter_turn(images, action, k)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector
from labkit.judge.kinds import Kind

row = Row((
    Kind((None, None, None), called="the array of images"),
    Vector((2,), called="the action"),
))  # fmt: skip


@row.inputs
def _(rng):
    yield np.array([[[1.0, 2], [3, 4]]]), np.array([0.1, 0.2]), 1
    for c, h, k in ((1, 2, 2), (2, 3, 3), (3, 2, -1), (2, 4, 0), (2, 3, 5), (1, 3, -6)):
        yield rng.numbers(-1, 1, c, h, h), rng.numbers(-1, 1, 2), k
    c, h = (int(n) for n in rng.integers(2, 5, 2))
    yield rng.numbers(-1, 1, c, h, h), rng.numbers(-1, 1, 2), int(rng.integers(-4, 9))


row.cases(
    a_quarter_turn=lambda images, action, k: k % 4 == 1,
    a_half_turn=lambda images, action, k: k % 4 == 2,
    three_quarter_turns=lambda images, action, k: k % 4 == 3,
    no_turn=lambda images, action, k: k % 4 == 0,
)


@row.wrongs
def _(images, action, k):
    """action-not-turned: your code rotates the images, but not the action. The action
      is a velocity in the same plane, so rotate the action with the scene
    action-the-other-way: your code rotates the action from y towards x. Rotate the
      action from x towards y instead, in the same direction as the scene
    image-the-other-way: your code rotates the images from y towards x. The row index
      increases with y, so `np.rot90` needs -k to rotate the images from x towards y
    mirrored: your code mirrors the images instead of rotating them. A mirrored image
      differs from a rotated image by a flip along one axis, so add this flip
    mirrored 2: your code transposes the images, which mirrors them about a diagonal. A
      quarter turn is a transpose and a flip along one axis, so add this flip
    action-turned-once: your code rotates the action by one quarter turn for every k.
      Rotate the action by k quarter turns, like the images
    x-overwritten: your code computes the new y of the action from the new x. Store the
      old x first, and compute the new y from the old x
    sign-of-k-lost: your code rotates in the same direction for k and -k. For a negative
      k, rotate from y towards x
    degrees: your code passes 90 * k to cos and sin, which take radians. Use k * pi / 2
      instead
    first-axes: your code rotates the images in the plane of axes 0 and 1. Axis 0
      contains the channels, so use axes 1 and 2 instead
    """
    right = np.rot90(images, -k, (1, 2))
    x, y = action
    turned = np.array([(x, y), (-y, x), (-x, -y), (y, -x)][k % 4])
    back = np.array([(x, y), (y, -x), (-x, -y), (-y, x)][k % 4])
    mirror = images[:, :, ::-1] if k % 4 == 2 else images.transpose(0, 2, 1)
    over = np.array(action)
    for _ in range(k % 4):
        over[:] = -over[1], -over[1]
    c, s = np.cos(90 * k), np.sin(90 * k)
    return {
        "action-not-turned": (right, action),
        "action-the-other-way": (right, back),
        "image-the-other-way": (np.rot90(images, k, (1, 2)), turned),
        "mirrored": (images if k % 4 == 0 else mirror, turned),
        "mirrored 2": (images.transpose(0, 2, 1) if k % 2 else images, turned),
        "action-turned-once": (right, np.array([-y, x])),
        "x-overwritten": (right, over),
        "sign-of-k-lost": (
            np.rot90(images, -abs(k), (1, 2)),
            turned if k > 0 else back,
        ),
        "degrees": (right, np.array([c * x - s * y, s * x + c * y])),
        "first-axes": (np.rot90(images, -k), turned),
    }


row.same(
    "for _ in range(k % 4): => for _ in range(k % 8):",
    "four quarter turns change nothing",
)


@row.right  # By np.rot90 and a rotation matrix.
def _(images, action, k):
    c, s = round(np.cos(k * np.pi / 2)), round(np.sin(k * np.pi / 2))
    turned = np.array([[c, -s], [s, c]]) @ action
    return np.rot90(images, -k, axes=(1, 2)).copy(), turned


@row.right  # Pixel by pixel, one turn after the other.
def _(images, action, k):
    h = images.shape[1]
    for _ in range(k % 4):
        new = np.zeros(images.shape)
        for i in range(h):
            for j in range(h):
                new[:, i, j] = images[:, h - 1 - j, i]
        images, action = new, np.array([-action[1], action[0]])
    return np.array(images), np.array(action)


@row.spans
def _(rng):
    for size in (1e-3, 0.2):
        yield size * rng.numbers(0, 1, 2, 12, 12), size * rng.numbers(-1, 1, 2), 7
