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
    in_drop=1, right_fx=False, short=0.0, keep=(), sum_drop=True, quad=0.5, cross=1.0,
    cross_xx=1.0, gain=True, first=1.0, quu_x=1.0, quu_xx=1.0, signs=(-1.0, -1.0),
    turned_in_Qx=False, but=(), solve=np.linalg.solve,
    lux_in_K=True, Vx_in_k=True, mu_by=1.0, Vxx_in_Quu=True, fx_twice=True,
):  # fmt: skip
    """Return k, K and drop of a pass whose parts may be wrong."""
    T, n, m = fu.shape
    k, K, drop = np.zeros((T, m)), np.zeros((T, m, n)), np.zeros(2)
    for t in range(T)[::order]:
        if t - T in but or t in but:
            continue
        F = fx[t] if not right_fx else fx[t].T
        Qx = lx[t] + (F if turned_in_Qx else F.T) @ Vx
        Qu = lu[t] + fu[t].T @ Vx
        Qxx = lxx[t] + (F.T if fx_twice else np.eye(n)) @ Vxx @ F
        bare = luu[t] + fu[t].T @ (Vxx if Vxx_in_Quu else np.eye(n)) @ fu[t]
        Qux = lux[t] + fu[t].T @ Vxx @ F
        more = mu * np.eye(m)
        pulls = Qu if Vx_in_k else lu[t]
        bends = Qux if lux_in_K else Qux - lux[t]
        k[t] = signs[0] * solve(bare + in_k * more, pulls)
        K[t] = signs[1] * solve(bare + in_K * more, bends)
        mu = mu * mu_by
        V = bare + in_V * more
        now = np.array(
            [first * k[t] @ Qu, quad * k[t] @ (bare + in_drop * more) @ k[t]]
        )
        drop = drop + now if sum_drop else now
        sign = 1.0 - short
        if "Vx" not in keep:
            part = sign * Qux.T @ k[t] + K[t].T @ (Qu + quu_x * V @ k[t])
            Vx = Qx + cross * part if gain else Qx
        if "Vxx" not in keep:
            part = Qux.T @ K[t] + K[t].T @ (Qux + quu_xx * V @ K[t])
            Vxx = Qxx + cross_xx * part if gain else Qxx
    return k, K, drop


def by_diagonal(Quu, right):
    """Return what Quu's diagonal alone makes of a gain's right side."""
    return (right.T / np.diag(Quu)).T


def sum_of(k, luu):
    """Return the sum of k . luu k over all steps."""
    return np.einsum("ti,tij,tj->", k, luu, k)


@row.wrongs
def _(fx, fu, lx, lu, lxx, luu, lux, Vx, Vxx, mu):
    """lu-forgotten: lu is missing in Qu: what torque costs already does not pull it
      down => with lu 0
    lx-forgotten: lx is missing in Qx: what the steps cost is not handed on => with lx 0
    lux-forgotten: lux is missing in Qux => with lux 0
    lux-sign: lux has the wrong sign in Qux => with -lux
    lxx-forgotten: lxx is missing in Qxx => with lxx 0
    luu-forgotten: luu is missing in Quu => with luu 0
    mu-forgotten: mu is missing => with mu 0
    mu-in-k-only: mu is missing in K => with mu in k alone
    mu-in-k-only 2: mu is missing in K => with mu in all but K
    mu-in-K-only: mu is missing in k => with mu in all but k
    mu-squared: mu is squared
    mu-not-in-V: Vx and Vxx are made with a Quu that has no mu in it; the gains have it
      => with mu in the gains alone
    mu-not-in-V 2: Vx, Vxx and the drop are made with a Quu that has no mu in it; the
      gains have it
    mu-not-in-the-drop: the drop is made with a Quu that has no mu in it
    mu-on-Vxx: mu is added to Vxx; it belongs to Quu => with fu^T (Vxx + mu) fu
    mu-on-Vxx 2: mu is added to Vxx in Quu; it belongs to Quu itself
    mu-on-all-entries: mu is added to all of Quu; it belongs on its diagonal => with Quu
      + mu in every entry
    Vx-not-passed-on: Vx stays that of the end; each step has its own => with Vx of the
      end
    Vxx-not-passed-on: Vxx stays that of the end; each step has its own => with Vxx of
      the end
    Vx-without-the-gain: Vx is Qx: what the inputs save is missing in it => with Vx = Qx
    Vxx-without-the-gain: Vxx is Qxx: what the inputs save is missing in it => with Vxx
      = Qxx
    V-signs: in Vx and Vxx what the inputs save has the wrong sign => with Qx - Qux^T k
      and Qxx - Qux^T K
    nothing-saved: Vx and Vxx are Qx and Qxx: what the inputs save is missing => with Vx
      = Qx and Vxx = Qxx
    Vx-sign: in Vx what the inputs save has the wrong sign => with Qx - Qux^T k
    Vx-without-Quu: in Vx K^T Quu k is missing => with Qx + K^T Qu + Qux^T k
    Vx-Quu-sign: in Vx K^T Quu k has the wrong sign
    Vxx-without-Quu: in Vxx K^T Quu K is missing => with Qxx + K^T Qux + Qux^T K
    Vxx-sign: in Vxx what the inputs save has the wrong sign => with Qxx - Qux^T K
    drop-last-step: the drop is that of one step; they add up => with the drop of the
      first step
    no-half: the half before k . Quu k is missing: the drop's second entry is twice as
      large => the right ones, and k . Quu k
    half-in-the-first: the drop's first entry is halved; only its second has a half
    drop-summed: the drop's entries are added to one number; each is to be by itself =>
      with (sum, 0)
    drop-of-lu: the drop's first entry is made with lu; it is k . Qu
    drop-of-luu: the drop's second entry is made with luu; it is k . Quu k / 2
    drop-signs: the drop's signs are turned round: it is what the cost changes by => the
      right ones, and -drop
    drop-swapped: the drop's two entries are swapped
    drop-added: the drop's two entries are added in each of them
    drop-quadratic-sign: the drop's second entry has the wrong sign
    gain-signs: k and K have the other sign: each u changes by k + K dx => with -k, -K
    k-sign: k has the other sign => with -k
    K-sign: K has the other sign: here u changes by +K dx => with -K
    gain-signs 2: k and K have the other sign: each u changes by k + K dx => with the
      minus forgotten in both
    k-sign 2: k has the other sign => with the minus forgotten
    K-sign 2: K has the other sign: here u changes by +K dx => with the minus forgotten
    diagonal-of-Quu: Quu is taken for its diagonal in k and K; its inputs act together
      => divided by Quu's diagonal
    last-step-left-out: the last step is left out: its k and K stay 0 => from the last
      but one
    first-step-left-out: the first step is left out: its k and K stay 0
    forwards: it goes from the first step to the last; what follows is known at the end
    fx-not-transposed: fx stands where fx^T should, and the other way round => with fx^T
      for fx
    fx-not-transposed 2: fx stands where fx^T should in Qx => with fx Vx
    first-slopes 3: all steps have the first one's fu
    lux-not-in-K: lux is missing in K, and only there
    Vx-not-in-k: k is made with lu alone; what follows has its Vx in it
    mu-halved-each-step: mu is halved from step to step; it is the same everywhere
    lx-of-the-next: lx is that of the next step
    Vxx-forgotten-in-Quu: in Quu Vxx is missing => with luu + fu^T fu
    fx-once: fx stands on one side of Vxx in Qxx; it is on both => with Vxx fx
    lxx-halved: lxx is halved; it is a second slope as it is
    luu-halved: luu is halved; it is a second slope as it is
    drop-mean: the drop is divided by the number of steps; they add up
    drop-halved: both of the drop's entries are halved
    first-slopes 2: all steps have the first one's fx
    last-lu: all steps have the last one's lu
    first-lu: all steps have the first one's lu
    first-slopes: all steps have the first one's fx and fu
    last-slopes: all steps have the last one's fx and fu
    K-reversed: k and K come in the order in which they are made: the last step first
    end-forgotten: what the end costs is missing: it begins with Vx = 0 and Vxx = 0
    Vx-forgotten: the slope of what the end costs is missing => with Vx 0 at the end
    """
    given = (fx, fu, lx, lu, lxx, luu, lux, Vx, Vxx, mu)
    _, n, m = fu.shape
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
        "lu-forgotten": of(lu=0 * lu),
        "lx-forgotten": of(lx=0 * lx),
        "lux-forgotten": of(lux=0 * lux),
        "lux-sign": of(lux=-lux),
        "lxx-forgotten": of(lxx=0 * lxx),
        "luu-forgotten": of(luu=0 * luu + 1e-300) if mu or m <= n else (k, K, drop),
        "mu-forgotten": of(mu=0.0),
        "mu-in-k-only": of(in_K=0, in_V=0, in_drop=0),
        "mu-in-k-only 2": of(in_K=0),
        "mu-in-K-only": of(in_k=0),
        "mu-squared": of(mu=mu**2),
        "mu-not-in-V": of(in_V=0),
        "mu-not-in-V 2": of(in_V=0, in_drop=0),
        "mu-not-in-the-drop": of(in_drop=0),
        "mu-on-Vxx": on_V,
        "mu-on-Vxx 2": of(mu=0.0, luu=luu + mu * np.swapaxes(fu, 1, 2) @ fu),
        "mu-on-all-entries": of(luu=luu + mu, mu=0.0),
        "Vx-not-passed-on": of(keep=("Vx",)),
        "Vxx-not-passed-on": of(keep=("Vxx",)),
        "Vx-without-the-gain": of(cross=0.0),
        "Vxx-without-the-gain": of(cross_xx=0.0),
        "V-signs": of(cross=-1.0, cross_xx=-1.0),
        "nothing-saved": of(gain=False),
        "Vx-sign": of(cross=-1.0),
        "Vx-without-Quu": of(quu_x=0.0),
        "Vx-Quu-sign": of(quu_x=-1.0),
        "Vxx-without-Quu": of(quu_xx=0.0),
        "Vxx-sign": of(cross_xx=-1.0),
        "drop-last-step": of(sum_drop=False),
        "no-half": of(quad=1.0),
        "half-in-the-first": (k, K, drop * [0.5, 1]),
        "drop-summed": (k, K, drop.sum() * np.array([1.0, 0.0])),
        "drop-of-lu": (k, K, np.array([np.sum(k * lu), drop[1]])),
        "drop-of-luu": (k, K, np.array([drop[0], sum_of(k, luu) / 2])),
        "drop-signs": (k, K, -drop),
        "drop-swapped": (k, K, drop[::-1].copy()),
        "drop-added": (k, K, drop.sum() * np.ones(2)),
        "drop-quadratic-sign": (k, K, drop * [1, -1]),
        "gain-signs": (-k, -K, drop),
        "k-sign": (-k, K, drop),
        "K-sign": (k, -K, drop),
        "gain-signs 2": of(signs=(1.0, 1.0)),
        "k-sign 2": of(signs=(1.0, -1.0)),
        "K-sign 2": of(signs=(-1.0, 1.0)),
        "diagonal-of-Quu": of(solve=by_diagonal),
        "last-step-left-out": of(but=(-1,)),
        "first-step-left-out": of(but=(0,)),
        "forwards": of(order=1),
        "fx-not-transposed": of(right_fx=True),
        "fx-not-transposed 2": of(turned_in_Qx=True),
        "first-slopes 3": of(fu=0 * fu + fu[:1]),
        "lux-not-in-K": of(lux_in_K=False),
        "Vx-not-in-k": of(Vx_in_k=False),
        "mu-halved-each-step": of(mu_by=0.5),
        "lx-of-the-next": of(lx=np.concatenate([lx[1:], lx[-1:]])),
        "Vxx-forgotten-in-Quu": of(Vxx_in_Quu=False),
        "fx-once": of(fx_twice=False),
        "lxx-halved": of(lxx=lxx / 2),
        "luu-halved": of(luu=luu / 2),
        "drop-mean": (k, K, drop / len(fx)),
        "drop-halved": (k, K, drop / 2),
        "first-slopes 2": of(fx=0 * fx + fx[:1]),
        "last-lu": of(lu=0 * lu + lu[-1:]),
        "first-lu": of(lu=0 * lu + lu[:1]),
        "first-slopes": of(fx=0 * fx + fx[:1], fu=0 * fu + fu[:1]),
        "last-slopes": of(fx=0 * fx + fx[-1:], fu=0 * fu + fu[-1:]),
        "K-reversed": (k[::-1].copy(), K[::-1].copy(), drop),
        "end-forgotten": of(Vx=0 * Vx, Vxx=0 * Vxx),
        "Vx-forgotten": of(Vx=0 * Vx),
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
