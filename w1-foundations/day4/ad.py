"""4.5 `ad(V)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row
from robo47 import dynamics
from robo47.screws import adjoint, exp_screw, skew

from .states import SIX

row = Row(SIX, truth=dynamics.ad)
NONE = np.zeros((3, 3))


@row.inputs
def _(rng):
    case = np.eye(6)[2] + np.eye(6)[3]
    shift = np.array([0, 0, 0, 0.3, -0.2, 0.5])
    return [(V,) for V in (case, shift, *rng.numbers(-2, 2, 9, 6))]


@row.wrongs
def _(V):
    """v-on-top: your code puts the block [v] in the upper right. The block belongs in
      the lower left, because a linear velocity does not change an angular velocity
    v-forgotten: your code omits the block [v] in the lower left. For a twist (omega2;
      v2), this block adds v x omega2 to the linear part of the result
    second-omega-forgotten: your lower right block is 0. This block should be [omega].
      For a twist (omega2; v2), this block adds omega x v2 to the linear part of the
      result
    v-in-both-corners: your code puts [v] in both off-diagonal blocks. The upper right
      block should be 0, because v does not change an angular velocity
    v-last: your lower right block is [v], and your lower left block is 0. The lower
      right block should be [omega], and the lower left block should be [v]
    identity-added: your code adds the identity matrix. Omit the identity matrix,
      because ad(0) should be 0
    product-for-v: your lower left block is [v] [omega]. This block should be [v],
      because only the adjoint of a pose contains a product such as [p] R
    omega-everywhere: your lower left block is [omega]. This block should be [v]
    """
    W = skew(V[:3])
    U = skew(V[3:])
    ONE = np.eye(3)
    blocks = {
        "v-on-top": [[W, U], [NONE, W]],
        "v-forgotten": [[W, NONE], [NONE, W]],
        "second-omega-forgotten": [[W, NONE], [U, NONE]],
        "v-in-both-corners": [[W, U], [U, W]],
        "v-last": [[W, NONE], [NONE, U]],
        "identity-added": [[W + ONE, NONE], [U, W + ONE]],
        "product-for-v": [[W, NONE], [U @ W, W]],
        "omega-everywhere": [[W, NONE], [W, W]],
    }
    return {slug: np.block(four) for slug, four in blocks.items()}


@row.close("rounded-somewhere")  # The derivative of the adjoint, by a difference.
def _(V):
    h = 3e-4
    size = np.linalg.norm(V[:3]) or np.linalg.norm(V[3:])
    there, back = (adjoint(exp_screw(V / size, x * size)) for x in (h, -h))
    return (there - back) / (2 * h)


@row.wrong("transposed")  # What forces need, a task too early.
def _(V):
    return dynamics.ad(V).T


@row.wrong(
    "part-off", hidden="the lab's twists all turn"
)  # What does not turn is forgotten.
def _(V):
    return dynamics.ad(V) if V[:3].any() else np.zeros((6, 6))


row.spans(  # as small, or as large, as in the lab
    V=(lambda V: 0.007 * V,),
)
