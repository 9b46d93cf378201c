"""Checks of arguments: shape, finite numbers, rigid matrices.

Each check returns the value as float64, or raises a ValueError that names the
argument, its value and the expected one.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

# How far a matrix may be from rigid and still be taken for a pose. Wide enough for
# float32 and for quaternions printed with 7 digits, far too narrow for any mistake.
RIGID_TOL = 1e-6
_EYE = np.eye(3)
_LAST_ROW = np.array([0.0, 0.0, 0.0, 1.0])


def array(value: ArrayLike, name: str, shape: tuple[int | str, ...]) -> Array:
    """Return value as float64 after checking its trailing shape and finiteness.

    A letter in the shape, as in (6, "n"), stands for any size of at least 1.
    """
    try:
        checked = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise ValueError(f"{name} is not an array of numbers: {error}") from None
    sizes = checked.shape[max(checked.ndim - len(shape), 0) :]
    if sizes != shape and not _fits(sizes, shape):
        wanted = ", ".join(["...", *map(str, shape)])
        raise ValueError(f"{name} has shape {checked.shape}; expected ({wanted})")
    if not np.isfinite(checked).all():
        raise ValueError(f"{name} holds a number that is not finite (NaN or infinity)")
    return checked


def _fits(sizes: tuple[int, ...], shape: tuple[int | str, ...]) -> bool:
    return len(sizes) == len(shape) and all(
        size > 0 if isinstance(wanted, str) else size == wanted
        for size, wanted in zip(sizes, shape, strict=True)
    )


def same_size(**named: ArrayLike) -> list[Array]:
    """Return vectors as float64 after checking that their last sizes are equal."""
    (first, value), *others = named.items()
    vectors = [array(value, first, ("n",))]
    n = vectors[0].shape[-1]
    return vectors + [array(value, name, (n,)) for name, value in others]


def per_joint(value: ArrayLike, name: str, like: Array) -> Array:
    """Return one number for all joints, or one for each as in `like`, as float64."""
    value = array(value, name, ())
    return array(value, name, like.shape[-1:]) if value.ndim else value


def positive(value: ArrayLike, name: str) -> Array:
    """Return numbers as float64 after checking that all are above 0."""
    value = array(value, name, ())
    if np.any(value <= 0.0):
        raise ValueError(f"{name} is {value.min():g}; it must be above 0")
    return value


def not_negative(value: ArrayLike, name: str) -> Array:
    """Return numbers as float64 after checking that none is below 0."""
    value = array(value, name, ())
    if np.any(value < 0.0):
        raise ValueError(f"{name} is {value.min():g}; it must not be below 0")
    return value


def unit(v: Array, name: str) -> Array:
    """Return v scaled to norm 1 along its last axis; norm 0 is an error."""
    scale = np.max(np.abs(v), axis=-1, keepdims=True)  # 1e-200 squared would be 0
    if np.any(scale == 0.0):
        raise ValueError(f"{name} has length 0, so it has no direction")
    v = v / scale
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def unit_vector(v: ArrayLike, name: str) -> Array:
    """Return v as float64, (..., 3), after checking that its norm is 1."""
    v = array(v, name, (3,))
    length = np.linalg.norm(v, axis=-1)
    if (bad := np.abs(length - 1.0) > RIGID_TOL).any():
        raise ValueError(
            f"{_first(bad, name)} has length {length[bad][0]:.6g}; expected 1: "
            "divide it by its length"
        )
    return v


def screws(S: ArrayLike, name: str) -> Array:
    """Return S as float64, (..., 6), after checking that omega has norm 1 or 0."""
    S = array(S, name, (6,))
    length = np.linalg.norm(S[..., :3], axis=-1)
    if (bad := np.minimum(np.abs(length - 1.0), length) > RIGID_TOL).any():
        raise ValueError(
            f"{_first(bad, name)} is no screw: omega, its first three numbers, has "
            f"length {length[bad][0]:.6g}; expected 1 (a hinge) or 0 (a slide)"
        )
    return S


def screws_and_q(S: ArrayLike, q: ArrayLike) -> tuple[Array, Array]:
    """Return an arm's screws, (..., n, 6), and q, (..., n), checked together."""
    S = screws(S, "screws")
    if S.ndim < 2:
        raise ValueError(f"screws has shape {S.shape}; expected (..., n, 6)")
    return S, array(q, "q", S.shape[-2:-1])


def rotation(R: ArrayLike, name: str) -> Array:
    """Return R as float64, (..., 3, 3), after checking that it is a rotation."""
    R = array(R, name, (3, 3))
    if flaw := rotation_flaw(R, RIGID_TOL):
        raise ValueError(f"{name} is not a rotation: {flaw}")
    return R


def pose(T: ArrayLike, name: str) -> Array:
    """Return T as float64, (..., 4, 4), after checking that it is a pose."""
    T = array(T, name, (4, 4))
    if flaw := pose_flaw(T, RIGID_TOL):
        raise ValueError(f"{name} is not a pose: {flaw}")
    return T


def rotation_flaw(R: Array, tol: float) -> str | None:
    """Return the reason why R, (..., 3, 3), is no rotation, or None."""
    off = np.abs(R @ R.mT - _EYE).max(initial=0.0)
    if off > tol:
        return f"R R^T differs from the identity by {off:.3g} (allowed {tol:.0e})"
    if np.any(np.linalg.det(R) < 0.0):
        return "det R = -1, a mirror image (left-handed)"
    return None


def pose_flaw(T: Array, tol: float) -> str | None:
    """Return the reason why T, (..., 4, 4), is no pose, or None."""
    if np.abs(T[..., 3, :] - _LAST_ROW).max(initial=0.0) > tol:
        worst = T.reshape(-1, 4, 4)[:, 3]
        row = worst[np.argmax(np.abs(worst - [0, 0, 0, 1]).max(axis=-1))]
        return f"its bottom row is {np.round(row, 6).tolist()}; expected [0, 0, 0, 1]"
    return rotation_flaw(T[..., :3, :3], tol)


def _first(bad: NDArray[np.bool_], name: str) -> str:
    """Return the first bad one's name: "screws[2]", or "S" where there is only one."""
    return name + "".join(f"[{i}]" for i in np.argwhere(bad)[0])
