"""Mistakes in tasks 6.8 `set_point_for_force` and 6.9 `hybrid_wrench`."""

from . import named

Z, MOMENT_Z = 5, 2  # of (moment; force)


def _at(wrench, row, value):
    out = wrench.copy()
    out[row] = value
    return out


SET_POINT = [
    named(
        "above-the-surface",
        "the target is above the surface: the hand never touches it and presses with 0",
        lambda f, k, s: s + f / k,
        "surface + force / k",
    ),
    named(
        "force-times-k",
        "force is multiplied by k; a stiffer spring needs less depth",
        lambda f, k, s: s - f * k,
        "surface - force k",
    ),
    named(
        "k-over-force",
        "the fraction is upside down: N divided by N/m is m",
        lambda f, k, s: s - k / f,
        "surface - k / force",
    ),
    named(
        "depth-only",
        "this is how deep below the surface; the height to command is asked for",
        lambda f, k, s: f / k,
        "force / k",
    ),
    named(
        "depth-negative",
        "the height of the surface is missing",
        lambda f, k, s: -f / k,
        "-force / k",
    ),
    named(
        "millimetres",
        "the depth is in millimetres; here everything is in metres",
        lambda f, k, s: s - 1000.0 * f / k,
        "the right one with the depth in mm",
    ),
    named(
        "half-a-spring",
        "there is a 2 too many: force is k times depth, its half belongs to energy",
        lambda f, k, s: s - 2.0 * f / k,
        "surface - 2 force / k",
    ),
    named(
        "surface-only",
        "force and k are not used: at the surface itself the spring pulls with 0 N",
        lambda f, k, s: s,
        "surface",
    ),
    named(
        "whole-metres",
        "// leaves whole numbers only, here whole metres of depth; / divides",
        lambda f, k, s: s - f // k,
        "surface - force // k",
    ),
    named(
        "docstrings-numbers",
        "k is 400, as in the docstring, whatever it is given",
        lambda f, k, s: s - f / 400.0,
        "surface - force / 400",
    ),
    named(
        "docstrings-numbers",
        "the surface is at 0.42, as in the docstring, whatever it is given",
        lambda f, k, s: 0.42 - f / k,
        "0.42 - force / k",
    ),
    named(
        "half-a-depth",
        "half of the depth is missing: force is k times depth, its half belongs to "
        "energy",
        lambda f, k, s: s - 0.5 * f / k,
        "surface - force / (2 k)",
    ),
]

HYBRID_WRENCH = [
    named(
        "pushes-up",
        "the force has the wrong sign: z points up, and the hand is to push down",
        lambda e, V, K, D, f: _at(K @ e + D @ V, Z, D[Z] @ V + f),
        "the right one with +force",
    ),
    named(
        "spring-left-in",
        "the spring along z is still there, and the force comes on top of it: the push "
        "then depends on how high the hand is",
        lambda e, V, K, D, f: _at(K @ e + D @ V, Z, K[Z] @ e + D[Z] @ V - f),
        "the right one with K e along z",
    ),
    named(
        "damper-left-out",
        "along z the damper is gone with the spring; it stays",
        lambda e, V, K, D, f: _at(K @ e + D @ V, Z, -f),
        "the right one without it",
    ),
    named(
        "damper-left-out",
        "the damper is gone in all six directions; it stays",
        lambda e, V, K, D, f: _at(K @ e, Z, -f),
        "the right one without any damper",
    ),
    named(
        "damper-sign",
        "the damper drives the hand on: V_err is the target's twist minus the hand's, "
        "so it is added",
        lambda e, V, K, D, f: _at(K @ e - D @ V, Z, -D[Z] @ V - f),
        "the right one with -D V_err",
    ),
    named(
        "moment-in-place-of-force",
        "entry 2 is replaced: that is the moment about z; forces are the last three",
        lambda e, V, K, D, f: _at(K @ e + D @ V, MOMENT_Z, D[MOMENT_Z] @ V - f),
        "the right one with entry 2 replaced",
    ),
    named(
        "moment-in-place-of-force",
        "entry 2 is replaced, and the damper with it: that is the moment about z",
        lambda e, V, K, D, f: _at(K @ e + D @ V, MOMENT_Z, -f),
        "the right one with entry 2 replaced",
    ),
    named(
        "force-only",
        "only the force is left; the other five directions are held by the spring",
        lambda e, V, K, D, f: _at(D @ V, Z, D[Z] @ V - f),
        "the right one without K e",
    ),
    named(
        "spring-everywhere",
        "force is not used: this is the spring in all six directions",
        lambda e, V, K, D, f: K @ e + D @ V,
        "K e + D V_err",
    ),
    named(
        "along-x",
        "the force is along x; it is to push along z",
        lambda e, V, K, D, f: _at(K @ e + D @ V, 3, D[3] @ V - f),
        "the right one with entry 3 replaced",
    ),
]
