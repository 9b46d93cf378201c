"""13.7 `ilqr_backward(fx, fu, lx, lu, ..., Vx, Vxx, mu)`: questions and mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Matrix, Row, Vector
from labkit.judge.kinds import Kind
from robo47.optimal import ilqr_backward

from .asked import motions

row = Row((
    Matrix((None, None), called="k"),
    Kind((None, None, None), called="K"),
    Vector((2,), called="the drop"),
))  # fmt: skip


@row.inputs
def _(rng):
    one = np.ones((2, 1, 1))
    zero = np.zeros((2, 1))
    end = np.ones(1), np.ones((1, 1)), 0.0
    case = (one, one, zero, zero, one, one, 0 * one, *end)
    return [case, *motions(rng)]


@row.spans
def _(rng):  # large gains: the inputs cost little and do little
    fx, fu, lx, lu, lxx, luu, lux, Vx, Vxx, _ = motions(rng)[0]
    yield fx, 0.1 * fu, lx, lu, lxx, 0.02 * luu, 0.1 * lux, Vx, Vxx, 0.0
    yield fx, fu, lx, lu, lxx, luu, lux, Vx, Vxx, 1e4


def backward(
    fx, fu, lx, lu, lxx, luu, lux, Vx, Vxx, mu, *, order=-1, in_k=1, in_K=1, in_V=1,
    in_drop=1, keep=(), sum_drop=True, cross=1.0, gain=True, signs=(-1.0, -1.0), but=(),
    solve=np.linalg.solve, lux_in_K=True, Vx_in_k=True, mu_by=1.0,
):  # fmt: skip
    """Return k, K and drop of a pass whose parts may be wrong."""
    T, n, m = fu.shape
    k, K, drop = np.zeros((T, m)), np.zeros((T, m, n)), np.zeros(2)
    for t in range(T)[::order]:
        if t - T in but or t in but:
            continue
        Qx = lx[t] + fx[t].T @ Vx
        Qu = lu[t] + fu[t].T @ Vx
        Qxx = lxx[t] + fx[t].T @ Vxx @ fx[t]
        bare = luu[t] + fu[t].T @ Vxx @ fu[t]
        Qux = lux[t] + fu[t].T @ Vxx @ fx[t]
        more = mu * np.eye(m)
        pulls = Qu if Vx_in_k else lu[t]
        bends = Qux if lux_in_K else Qux - lux[t]
        k[t] = signs[0] * solve(bare + in_k * more, pulls)
        K[t] = signs[1] * solve(bare + in_K * more, bends)
        mu = mu * mu_by
        V = bare + in_V * more
        now = np.array([k[t] @ Qu, k[t] @ (bare + in_drop * more) @ k[t] / 2])
        drop = drop + now if sum_drop else now
        if "Vx" not in keep:
            part = Qux.T @ k[t] + K[t].T @ (Qu + V @ k[t])
            Vx = Qx + cross * part if gain else Qx
        if "Vxx" not in keep:
            part = Qux.T @ K[t] + K[t].T @ (Qux + V @ K[t])
            Vxx = Qxx + cross * part if gain else Qxx
    return k, K, drop


def by_diagonal(Quu, right):
    """Return what Quu's diagonal alone makes of a gain's right side."""
    return (right.T / np.diag(Quu)).T


def sum_of(k, luu):
    """Return the sum of k . luu k over all steps."""
    return np.einsum("ti,tij,tj->", k, luu, k)


@row.wrongs
def _(fx, fu, lx, lu, lxx, luu, lux, Vx, Vxx, mu):
    """mu-in-k-only: your code uses `mu` for the gain k, but not in every other
      equation. Add `mu` to the diagonal of `Quu` before you use `Quu` in any equation
    mu-in-k-only 2: your code omits `mu` in K. Add `mu` to the diagonal of `Quu` before
      you use `Quu` in any equation
    mu-in-K-only: your code omits `mu` in k. Add `mu` to the diagonal of `Quu` before
      you use `Quu` in any equation
    mu-squared: your code squares `mu`. Add `mu` itself to the diagonal of `Quu`
    mu-not-in-V: your code uses `Quu` without `mu` for `Vx` and `Vxx`. Use the same
      `Quu` as for the gains
    mu-not-in-V 2: your code uses `Quu` without `mu` for `Vx`, `Vxx` and `drop`. Use the
      same `Quu` as for the gains
    mu-not-in-the-drop: your code uses `Quu` without `mu` for `drop`. Use the same `Quu`
      as for the gains
    mu-on-Vxx: your code adds `mu` to the diagonal of `Vxx` in the formulas for `Quu`
      and `Qux`. Add `mu` to the diagonal of `Quu` instead
    mu-on-Vxx 2: your code adds `mu` to the diagonal of `Vxx` in the formula for `Quu`.
      Add `mu` to the diagonal of `Quu` itself
    Vx-not-passed-on: your code uses `Vx` of the final cost in every step. Update `Vx`
      in each step
    Vxx-not-passed-on: your code uses `Vxx` of the final cost in every step. Update
      `Vxx` in each step
    V-signs: your code subtracts `Qux.T @ k` in `Vx` and `Qux.T @ K` in `Vxx`. Add these
      terms, because k and K already contain the minus sign
    nothing-saved: your code uses `Qx` as `Vx` and `Qxx` as `Vxx`. Add the terms that
      contain k and K, because the change in the input reduces the cost-to-go
    drop-last-step: your code returns the `drop` of only one step. Sum both entries over
      all steps
    half-in-the-first: your code halves the first entry of `drop`. Halve only the second
      entry
    drop-summed: your code adds the two entries of `drop`. Return the two entries
      separately
    drop-of-lu: your code uses the sum of `k @ lu` as the first entry of `drop`. Use the
      sum of `k @ Qu` instead
    drop-of-luu: your code uses the sum of `k @ luu @ k / 2` as the second entry of
      `drop`. Use the sum of `k @ Quu @ k / 2` instead
    drop-signs: your code negates `drop`. Because `drop` is the change in cost, its
      first entry should be negative
    drop-added: your code returns the sum of the two parts as both entries of `drop`.
      Return the two parts separately
    drop-quadratic-sign: your code negates the second entry of `drop`. Use the sum of `k
      @ Quu @ k / 2`, which is positive if `Quu` is positive definite
    gain-signs: your code returns k and K without their minus sign. Return both with
      this sign, because `du = k + K dx` should reduce the cost
    K-sign: your code returns K without its minus sign. Return K with this sign, because
      iLQR uses `du = k + K dx`, whereas the LQR uses `u = -K x`
    gain-signs 2: your code omits the minus sign in k and K. Include it in both, because
      `du = k + K dx` should reduce the cost
    K-sign 2: your code omits the minus sign in K. Include it, because iLQR uses `du = k
      + K dx`, whereas the LQR uses `u = -K x`
    diagonal-of-Quu: your code uses only the diagonal of `Quu` for the gains. Use the
      whole matrix `Quu`
    last-step-left-out: your code omits the last time step, so k and K of this step are
      0. Begin the backward pass with the last time step
    first-step-left-out: your code omits the first time step, so k and K of this step
      are 0. End the backward pass with the first time step
    forwards: your code runs from the first step to the last. Begin with the last step,
      because only the cost-to-go of the final state is known at first
    lux-not-in-K: your code omits `lux` in K, but not in `Vx` and `Vxx`. Use the same
      `Qux`, which contains `lux`, in K, `Vx` and `Vxx`
    Vx-not-in-k: your code uses only `lu` in k. Use `Qu` instead, which also contains
      `fu.T @ Vx`
    mu-halved-each-step: your code halves `mu` in each step. Use the same `mu` in all
      steps
    lx-of-the-next: your code uses `lx[t + 1]` in step t. Use `lx[t]` instead
    drop-mean: your code divides `drop` by the number of steps. Return the sums over the
      steps
    drop-halved: your code halves both entries of `drop`. Halve only the second entry
    first-slopes: your code uses `fx` and `fu` of the first step in every step. Use
      `fx[t]` and `fu[t]` in step t
    last-slopes: your code uses `fx` and `fu` of the last step in every step. Use
      `fx[t]` and `fu[t]` in step t
    K-reversed: your code returns k and K in reverse order. Put the first step first
    K-reversed 2: your code returns k in reverse order. Put the first step first
    K-reversed 3: your code returns K in reverse order. Put the first step first
    end-forgotten: your code begins with `Vx` = 0 and `Vxx` = 0. Begin with the
      derivatives of the final cost (the arguments `Vx` and `Vxx`)
    """
    given = (fx, fu, lx, lu, lxx, luu, lux, Vx, Vxx, mu)
    k, K, drop = ilqr_backward(*given)

    def of(**more):
        names = ("fx", "fu", "lx", "lu", "lxx", "luu", "lux", "Vx", "Vxx", "mu")
        parts = dict(zip(names, given, strict=True))
        changed = {name: one for name, one in more.items() if name in parts}
        rest = {name: one for name, one in more.items() if name not in parts}
        return partial(backward, *(parts | changed).values(), **rest)

    on_V = of(mu=0.0, luu=luu + mu * np.swapaxes(fu, 1, 2) @ fu,
              lux=lux + mu * np.swapaxes(fu, 1, 2) @ fx)  # fmt: skip
    return {
        "mu-in-k-only": of(in_K=0, in_V=0, in_drop=0),
        "mu-in-k-only 2": of(in_K=0),
        "mu-in-K-only": of(in_k=0),
        "mu-squared": of(mu=mu**2),
        "mu-not-in-V": of(in_V=0),
        "mu-not-in-V 2": of(in_V=0, in_drop=0),
        "mu-not-in-the-drop": of(in_drop=0),
        "mu-on-Vxx": on_V,
        "mu-on-Vxx 2": of(mu=0.0, luu=luu + mu * np.swapaxes(fu, 1, 2) @ fu),
        "Vx-not-passed-on": of(keep=("Vx",)),
        "Vxx-not-passed-on": of(keep=("Vxx",)),
        "V-signs": of(cross=-1.0),
        "nothing-saved": of(gain=False),
        "drop-last-step": of(sum_drop=False),
        "half-in-the-first": (k, K, drop * [0.5, 1]),
        "drop-summed": (k, K, drop.sum() * np.array([1.0, 0.0])),
        "drop-of-lu": (k, K, np.array([np.sum(k * lu), drop[1]])),
        "drop-of-luu": (k, K, np.array([drop[0], sum_of(k, luu) / 2])),
        "drop-signs": (k, K, -drop),
        "drop-added": (k, K, drop.sum() * np.ones(2)),
        "drop-quadratic-sign": (k, K, drop * [1, -1]),
        "gain-signs": (-k, -K, drop),
        "K-sign": (k, -K, drop),
        "gain-signs 2": of(signs=(1.0, 1.0)),
        "K-sign 2": of(signs=(-1.0, 1.0)),
        "diagonal-of-Quu": of(solve=by_diagonal),
        "last-step-left-out": of(but=(-1,)),
        "first-step-left-out": of(but=(0,)),
        "forwards": of(order=1),
        "lux-not-in-K": of(lux_in_K=False),
        "Vx-not-in-k": of(Vx_in_k=False),
        "mu-halved-each-step": of(mu_by=0.5),
        "lx-of-the-next": of(lx=np.concatenate([lx[1:], lx[-1:]])),
        "drop-mean": (k, K, drop / len(fx)),
        "drop-halved": (k, K, drop / 2),
        "first-slopes": of(fx=0 * fx + fx[:1], fu=0 * fu + fu[:1]),
        "last-slopes": of(fx=0 * fx + fx[-1:], fu=0 * fu + fu[-1:]),
        "K-reversed": (k[::-1].copy(), K[::-1].copy(), drop),
        "K-reversed 2": (k[::-1].copy(), K, drop),
        "K-reversed 3": (k, K[::-1].copy(), drop),
        "end-forgotten": of(Vx=0 * Vx, Vxx=0 * Vxx),
    }


row.at_least_0(mu="it is a damping")


@row.right  # The short forms, one gain for both.
def _(fx, fu, lx, lu, lxx, luu, lux, Vx, Vxx, mu):
    ks, Ks, drop = [], [], np.zeros(2)
    parts = zip(fx, fu, lx, lu, lxx, luu, lux, strict=True)
    for A, B, a, b, Q, R, N in list(parts)[::-1]:
        S = R + B.T @ Vxx @ B + mu * np.eye(len(b))
        F = N + B.T @ Vxx @ A
        c = b + B.T @ Vx
        inverse = np.linalg.inv(S)
        k, K = -inverse @ c, -inverse @ F
        drop = drop + np.array([k @ c, -k @ c / 2])
        Vx = a + A.T @ Vx + F.T @ k
        Vxx = Q + A.T @ Vxx @ A + F.T @ K
        ks.insert(0, k)
        Ks.insert(0, K)
    return np.array(ks), np.array(Ks), drop


@row.wrong("not-at-every-size")  # k within +-1, K within +-2.
def _(fx, fu, lx, lu, lxx, luu, lux, Vx, Vxx, mu):
    k, K, drop = backward(fx, fu, lx, lu, lxx, luu, lux, Vx, Vxx, mu)
    return np.clip(k, -1, 1), np.clip(K, -2, 2), drop


row.spans(  # as small, or as large, as in the lab
    lx=(lambda lx: 0.02 * lx,),
    lu=(lambda lu: 0.02 * lu,),
    lxx=(lambda lxx: 0.002 * lxx,),
    luu=(
        lambda luu: 0.0003 * luu,
        lambda luu: 6 * luu,
    ),
    lux=(lambda lux: 4 * lux,),
    Vx=(lambda Vx: 800 * Vx,),
    Vxx=(lambda Vxx: 600 * Vxx,),
)
