"""13.1 `gravity_stiffness(J_space, masses, coms, g)`: questions, mistakes."""

import itertools
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
    """Return column j: the gravity torques with turned[j] as gravity."""
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
    """Return the stiffness if only centres moved: omega_i x (omega_j x c + v_j)."""
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


def by_pairs(J_space, masses, coms, g, *, first=max, swapped=False):
    """Return the stiffness joint by joint, with other links or with roles swapped."""
    n = len(masses)
    K = np.zeros((n, n))
    for i, j in itertools.combinations_with_replacement(range(n), 2):
        moving, turning = (i, j) if swapped else (j, i)
        for k in range(first(i, j), n):
            speed = J_space[3:, moving] + np.cross(J_space[:3, moving], coms[k])
            K[i, j] -= masses[k] * (g @ np.cross(J_space[:3, turning], speed))
        K[j, i] = K[i, j]
    return K


@row.wrongs
def _(J_space, masses, coms, g):
    """sign: your code negates the stiffness. Check the signs and the order of the
      factors in each cross product, because, relative to the links, gravity rotates in
      the direction opposite to the rotation of the joint
    gravity-not-turned: your code uses g instead of g x omega. Use g x omega, because
      the stiffness is the derivative of the gravity torque
    gravity-not-turned 2: your code uses g instead of g x omega, so each column is the
      gravity torque itself. Use g x omega on and below the diagonal, and copy these
      entries to the upper triangle
    g-times-omega: your code multiplies g and omega entry by entry. Use the cross
      product g x omega instead
    link-i-only: in each entry, your code includes only the weight of the link of the
      later joint. Include the weights of all links distal to it too, because both
      joints carry these links
    only-links-after: in each entry, your code omits the weight of the link of the later
      joint. Include this weight, because both joints move this link
    all-links: in each entry, your code includes the weights of all links. Start with
      the link of the later joint, because this joint does not carry the links before it
    lever-sign: your code uses v - omega x c as the velocity of a centre of mass c. Use
      v + omega x c instead
    halves-swapped: your code swaps omega and v. The upper three rows of `J_space`
      contain omega, and the lower three contain v
    upper-half-zero: your code leaves all entries above the diagonal at 0. Copy the
      entries from below the diagonal to these positions, because the matrix is
      symmetric
    lower-half-zero: your code leaves all entries below the diagonal at 0. Copy the
      entries from above the diagonal to these positions, because the matrix is
      symmetric
    upper-half-sign: your code negates the entries above the diagonal. Copy them from
      below the diagonal without a change of sign, because the matrix is symmetric
    half-beside-the-diagonal: your off-diagonal entries are too small by a factor of 2.
      If your code adds a triangular matrix and its transpose, halve only the diagonal
      of the sum
    diagonal-zero: your code leaves the diagonal at 0. Compute the diagonal entries too,
      because the rotation of each joint can also change the torque at that joint
    not-symmetrised: your code also uses the formula above the diagonal. Copy the lower
      triangle to the upper one instead, because the formula holds only on and below the
      diagonal
    not-symmetrised 2: your entries above the diagonal are correct, but the entries
      below the diagonal are wrong. Copy the upper triangle to the lower one, because
      the matrix is symmetric
    averaged: your code averages the two triangles. Copy the lower triangle to the upper
      one instead, because the formula holds only on and below the diagonal
    other-half: both triangles of your result contain the values of the formula above
      the diagonal. Use the values below the diagonal in both triangles, because the
      formula holds only on and below the diagonal
    diagonal-doubled: your diagonal entries are twice the correct values. If your code
      adds two triangles, include the diagonal in only one of them
    diagonal-only: your code leaves all off-diagonal entries at 0. Compute them too,
      because the rotation of one joint can also change the torque at other joints
    only-z: your code uses only the z component of g. Use the whole vector, because
      gravity may have any direction
    minus-9.81: your code uses (0, 0, -9.81) instead of the argument g. Use g, because
      gravity may have any direction
    minus-9.81 2: your code uses a vertical vector with the norm of g. Use g itself,
      because gravity may have any direction
    axis-before: your code uses the axis of joint `j - 1` in column j. Use the axis of
      joint j instead
    axes-summed: your code uses the sum of all axes up to joint j in column j. Use only
      the axis of joint j
    g-along-omega: your code uses the component of g along omega. Use the cross product
      g x omega instead
    total-mass: your code uses the mass of the whole arm for every link. Use the mass of
      each link instead
    differences: your code computes a finite difference with a large step of 0.05 rad.
      Use the formula with g x omega instead, which gives the exact derivative
    last-axis: your code uses the axis of the last joint in every column. Use the axis
      of joint j in column j
    z-axis: your code uses the z axis as the axis of every joint. Use the axis of joint
      j in column j
    turned-twice: your code rotates gravity about omega_j twice. Rotate gravity about
      omega_j only once
    v-for-omega: your code uses v_j as the rotation axis of joint j. Use omega_j
      instead, which is in the upper three rows of column j of `J_space`
    torque-added: your code uses g + g x omega_j, so it adds the gravity torque itself.
      Use g x omega_j alone, because the stiffness is the derivative of this torque
    distal-joints-too: your code also sums over links that only one of the two joints
      moves. Start the sum with the link of the later joint, because only that link and
      the links after it are moved by both joints
    roles-swapped: your code swaps the roles of the two joints. Use the later joint for
      the velocity of the centre of mass, and rotate this velocity about the axis of the
      earlier joint
    screws-stay: when joint j moves, your code moves only the centres of mass. Also move
      the axes of all joints after joint j
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
    at = np.arange(len(masses))
    straight = np.array([0.0, 0.0, -np.linalg.norm(g)])

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
        "lever-sign": of(*given, turned, lever=-1.0),
        "halves-swapped": of(swapped, masses, coms, np.cross(g, swapped[:3].T)),
        "upper-half-zero": np.tril(right),
        "lower-half-zero": np.triu(right),
        "upper-half-sign": np.tril(right) - np.triu(right, 1),
        "half-beside-the-diagonal": (right + np.diag(np.diag(right))) / 2,
        "diagonal-zero": right - np.diag(np.diag(right)),
        "not-symmetrised": full,
        "not-symmetrised 2": full.T,
        "averaged": (full + full.T) / 2,
        "other-half": mirrored(full.T),
        "diagonal-doubled": right + np.diag(np.diag(right)),
        "diagonal-only": np.diag(np.diag(right)),
        "only-z": of(*given, np.cross(g_z, omega)),
        "minus-9.81": of(*given, np.cross(DOWN, omega)),
        "minus-9.81 2": of(*given, np.cross(straight, omega)),
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
        "distal-joints-too": by_pairs(*given, g, first=min),
        "roles-swapped": by_pairs(*given, g, swapped=True),
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
