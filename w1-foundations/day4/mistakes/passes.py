"""The recursive Newton-Euler algorithm, with parts that mistakes replace."""

from collections.abc import Callable

import numpy as np

from labkit.judge.matrices import transposed
from robo47.checks import Array
from robo47.screws import ad

Pass = Callable[[Array], Array]


def outwards(x: Array) -> Array:
    """Return the sums from the base to each link, (n, 7, 6)."""
    return np.cumsum(x, axis=1)


def inwards(x: Array) -> Array:
    """Return the sums from each link to the tip."""
    return np.cumsum(x[:, ::-1], axis=1)[:, ::-1]


def times(A: Array, x: Array) -> Array:
    """Return A x for stacks of both."""
    return (A @ x[..., None])[..., 0]


def velocity_product(ad_V: Array, momentum: Array) -> Array:
    """Return -ad(V)^T G V, what moving changes of a momentum."""
    return -times(transposed(ad_V), momentum)


def torque(
    *,
    bracket: Callable[[Array], Array] = ad,
    base: Callable[[Array], Array] = lambda g: np.hstack([0 * g, -g]),
    turned: float = 1.0,
    joint: Callable[[Array, Array], Array] = lambda S, qd: S * qd[..., None],
    swing: Callable[[Array, Array], Array] = velocity_product,
    moving: Callable[[Array, Array], Array] = lambda V, A: V,
    speeds: Pass = outwards,
    rates: Pass = outwards,
    wrenches: Pass = inwards,
    every_link: bool = False,
    felt: Array = np.ones(6),  # noqa: B008 (only read)
) -> Callable[..., Array]:
    """Return inverse_dynamics with other parts.

    Args:
        bracket: for ad.
        base: A_0 from g.
        turned: factor of ad(V) S qd in the acceleration.
        joint: for S qd in that.
        swing: the velocity product, from ad(V) and G V.
        moving: for V in that G V, from V and A.
        speeds, rates, wrenches: how V, A and F are summed along the arm.
        every_link: add A_0 at each link, not at the base alone.
        felt: which of the six entries of a wrench a motor feels.
    """

    def redo(J: Array, G: Array, qd: Array, qdd: Array, g: Array) -> Array:
        S = transposed(J)
        V = speeds(S * qd[..., None])
        ad_V = bracket(V)
        A_0 = base(g)[:, None]
        dA = S * qdd[..., None] + turned * times(ad_V, joint(S, qd))
        A = rates(dA + A_0) if every_link else rates(dA) + A_0
        F = wrenches(times(G, A) + swing(ad_V, times(G, moving(V, A))))
        return np.sum(S * F * felt, axis=-1)

    return redo


RIGHT = torque()


def itself(x: Array) -> Array:
    """Return what belongs to each link alone."""
    return x


def everything(x: Array) -> Array:
    """Return the sum over all links, for each."""
    return np.broadcast_to(x.sum(axis=1, keepdims=True), x.shape)


def beyond(x: Array) -> Array:
    """Return the sums from the link after each to the tip."""
    return inwards(x) - x


def velocity_before(J: Array, G: Array, qd: Array, qdd: Array, g: Array) -> Array:
    """Return the torque where F takes V of the link before."""
    S = transposed(J) * qd[..., None]
    before = outwards(S) - S
    F = velocity_product(ad(before), times(G, before)) - velocity_product(
        ad(outwards(S)), times(G, outwards(S))
    )
    return RIGHT(J, G, qd, qdd, g) + np.sum(transposed(J) * inwards(F), axis=-1)


def gravity_at_base_and_links(J: Array, G: Array, *motion: Array) -> Array:
    """Return the torque where link i counts gravity i + 1 times."""
    _, _, g = motion
    once = RIGHT(J, G, 0 * motion[0], 0 * motion[1], g)
    return torque(every_link=True)(J, G, *motion) + once
