"""13.1 `gravity_stiffness(J_space, masses, coms, g)`: questions, mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Row, Symmetric

from .asked import hinges

row = Row(Symmetric((None, None), "N m/rad", scale=10.0))
DOWN = np.array([0.0, 0.0, -9.81])


@row.inputs
def _(rng):
    one = np.array([[0.0, 1, 0, 0, 0, 0]]).T
    two = np.array([[0.0, 1, 0, 0, 0, 0], [0, 1, 0, -1, 0, 0]]).T
    up = np.array([[0.0, 0, 1]])
    return [
        (one, np.array([2.0]), up, DOWN),
        (one, np.array([2.0]), -up, DOWN),
        (two, np.array([0.5, 1.0]), np.vstack([up / 2, 2 * up]), DOWN),
        *hinges(rng),
    ]


def felt(J, masses, coms, turned, carried=np.greater_equal, lever=1.0):
    """Return column j: what each joint feels of the weights in g's place turned[j]."""
    omega, v = J[:3].T, J[3:].T
    n = len(masses)
    slope = np.zeros((n, n))
    for i in range(n):
        for k in range(n):
            if carried(k, i):
                moved = v[i] + lever * np.cross(omega[i], coms[k])
                slope[i] -= masses[k] * turned @ moved
    return slope


def screws_stay(J, masses, coms, g):
    """Return the slope if only centres of mass moved: omega_i x (omega_j x c + v_j)."""
    omega, v = J[:3].T, J[3:].T
    n = len(masses)
    slope = np.zeros((n, n))
    for i in range(n):
        for j in range(n):
            for k in range(max(i, j), n):
                moved = np.cross(omega[j], coms[k]) + v[j]
                slope[i, j] -= masses[k] * g @ np.cross(omega[i], moved)
    return slope


def mirrored(full):
    """Return a symmetric matrix with the lower half of another."""
    return np.tril(full) + np.tril(full, -1).T


@row.wrongs
def _(J_space, masses, coms, g):
    """sign: the sign is the other way: seen from an arm that has turned, gravity turns
      back, so it is g x omega, not omega x g => with omega x g
    gravity-not-turned: g itself stands for g x omega: that is the torque, in each
      column, and not how it changes => with g in all columns
    gravity-not-turned 2: g itself stands for g x omega, above the diagonal too
    g-times-omega: g and omega are multiplied entry by entry; it is g x omega => with *
      for x
    link-i-only: joint i is given the weight of link i alone; it carries all after it,
      too => without the links after i
    only-links-after: joint i is given the links after i; link i turns with it as well
      => without link i
    all-links: joint i is given all links; those before it stay where they are => with
      the links before i
    no-lever: the centres of mass are left out: v is the velocity of the world's origin,
      a centre has v + omega x c => with v alone
    lever-sign: the lever has the wrong sign: a centre moves with v + omega x c => with
      v - omega x c
    halves-swapped: omega and v are taken for each other: J_space has omega above
      => with the halves swapped
    upper-half-zero: all above the diagonal is 0; the matrix is symmetric => its lower
      half
    lower-half-zero: all below the diagonal is 0; the matrix is symmetric => its upper
      half
    upper-half-sign: the half above the diagonal has the wrong sign: a mirror image
      keeps it => with its upper half times -1
    half-beside-the-diagonal: all beside the diagonal is half as large: a lower half is
      averaged with its mirror image, and each has 0 where the other has a number
    diagonal-zero: the diagonal is 0; it belongs to the lower half
    last-joint-left-out: the last joint's turn is left out
    not-symmetrised: the formula is used above the diagonal too; there joint j moves
      less than joint i carries, and only i >= j holds: mirror the rest => with the
      formula in both halves
    not-symmetrised 2: the formula is used above the diagonal too, and rows stand for
      columns; it holds for i >= j: mirror the rest => with the formula in both halves,
      transposed
    averaged: both halves are averaged; only the lower one is right: mirror it => the
      mean of both halves
    other-half: the half above the diagonal is taken and mirrored: there joint i is the
      earlier one, and g x omega_j holds for i >= j => with the upper half mirrored
    diagonal-doubled: the diagonal is twice as large: it is in both of the triangles
      that are added => with its diagonal doubled
    diagonal-only: all beside the diagonal is 0; joints feel each other's turns
    mass-forgotten: the masses are missing: each link counts as 1 kg => with masses 1
    first-mass: all links have the first one's mass
    only-z: of gravity only its z is used; it may point anywhere => with (0, 0, g_z)
    minus-9.81: g is taken for (0, 0, -9.81); it may point anywhere => with that g
    minus-9.81 2: g's length is taken, straight down; it may point anywhere => with (0,
      0, -|g|)
    length-1: g is divided by its length: only where it points is left => with g / |g|
    axis-before: gravity is turned about the axis of the joint before; joint j's turn is
      its own axis
    axes-summed: gravity is turned about the sum of all axes up to joint j; it is
      joint j alone that turns
    g-along-omega: g's part along omega stands for g x omega
    total-mass: each link counts with the mass of all
    differences: a difference of two torques is divided by the turn, and the turn is
      large: what is asked is the slope => with a turn of 0.05
    last-axis: gravity is turned about the last joint's axis in every column; each
      joint has its own
    z-axis: gravity is turned about z in every column; each joint has its own axis
    turned-twice: gravity is turned twice, by omega_i and by omega_j
    v-for-omega: gravity is turned by v_j; the turn of a joint is its omega, the upper
      three rows of J_space => with g x v_j
    torque-added: g is added to g x omega_j: the torque itself is in it; only what
      changes is asked => with g + g x omega_j
    screws-stay: only the centres of mass move when joint j turns; the screws of the
      joints after it turn as well => with the screws where they were
    """
    omega = J_space[:3].T
    turned = np.cross(g, omega)
    given = J_space, masses, coms
    full = felt(*given, turned)
    right = mirrored(full)
    swapped = np.vstack([J_space[3:], J_space[:3]])
    twice = np.array([
        felt(*given, np.cross(np.cross(g, o), omega))[:, j] for j, o in enumerate(omega)
    ]).T  # fmt: skip
    g_z = np.array([0.0, 0.0, g[2]])
    length = np.linalg.norm(g)
    at = np.arange(len(masses))
    straight = np.array([0.0, 0.0, -length])
    last = np.zeros_like(right)
    last[-1, -1] = right[-1, -1]

    def of(*some, **how):
        return lambda: mirrored(felt(*some, **how))

    return {
        "sign": -right,
        "gravity-not-turned": of(*given, np.tile(g, (len(masses), 1))),
        "gravity-not-turned 2": partial(felt, *given, np.tile(g, (len(masses), 1))),
        "g-times-omega": of(*given, g * omega),
        "link-i-only": of(*given, turned, np.equal),
        "only-links-after": of(*given, turned, np.greater),
        "all-links": of(*given, turned, lambda k, i: True),
        "no-lever": of(*given, turned, lever=0.0),
        "lever-sign": of(*given, turned, lever=-1.0),
        "halves-swapped": of(swapped, masses, coms, np.cross(g, swapped[:3].T)),
        "upper-half-zero": np.tril(right),
        "lower-half-zero": np.triu(right),
        "upper-half-sign": np.tril(right) - np.triu(right, 1),
        "half-beside-the-diagonal": (right + np.diag(np.diag(right))) / 2,
        "diagonal-zero": right - np.diag(np.diag(right)),
        "last-joint-left-out": right - last,
        "not-symmetrised": full,
        "not-symmetrised 2": full.T,
        "averaged": (full + full.T) / 2,
        "other-half": mirrored(full.T),
        "diagonal-doubled": right + np.diag(np.diag(right)),
        "diagonal-only": np.diag(np.diag(right)),
        "mass-forgotten": of(J_space, 0 * masses + 1, coms, turned),
        "first-mass": of(J_space, 0 * masses + masses[0], coms, turned),
        "only-z": of(*given, np.cross(g_z, omega)),
        "minus-9.81": of(*given, np.cross(DOWN, omega)),
        "minus-9.81 2": of(*given, np.cross(straight, omega)),
        "length-1": right / length,
        "axis-before": of(*given, turned[np.maximum(at - 1, 0)]),
        "axes-summed": of(*given, np.cumsum(turned, axis=0)),
        "g-along-omega": of(*given, (omega @ g)[:, None] * omega),
        "total-mass": of(J_space, 0 * masses + masses.sum(), coms, turned),
        "differences": of(*given, turned + 0.025 * np.cross(turned, omega)),
        "last-axis": of(*given, np.cross(g, 0 * omega + omega[-1])),
        "z-axis": of(*given, np.cross(g, 0 * omega + [0, 0, 1])),
        "turned-twice": mirrored(twice),
        "v-for-omega": of(*given, np.cross(g, J_space[3:].T)),
        "torque-added": of(*given, g + turned),
        "screws-stay": partial(screws_stay, *given, g),
    }


row.at_least_0(masses="a mass")


@row.right  # The second derivative of the height energy, a pair of joints at a time.
def _(J_space, masses, coms, g):
    n = len(masses)
    slope = np.zeros((n, n))
    for i in range(n):
        for j in range(n):
            first, last = min(i, j), max(i, j)
            for k in range(last, n):
                moved = J_space[3:, last] + np.cross(J_space[:3, last], coms[k])
                slope[i, j] -= masses[k] * g @ np.cross(J_space[:3, first], moved)
    return slope
