"""2.6 `fk_space(screws, M, q)`: its questions and its mistakes."""

import numpy as np

from robo47 import screws as library
from robo47 import se3
from robo47.screws import adjoint

from .arms import arms
from .exp_screw import motion
from .products import body, either_form, product_row, space

row = product_row(library.fk_space, arms)
either_form(row, space)


@row.wrongs
def _(screws, M, q):
    """M-first: your code multiplies by M on the left of the exponentials. For screws
      expressed in the world frame, M belongs on the right
    M-only-added: your code adds only the translation of M. Multiply by M instead,
      because the exponentials rotate this translation, and M also contains a rotation
    space-screws-in-body-form: your product contains screws expressed in the
      end-effector frame, but M on the right. Use the screws unchanged, because a
      product with M on the right requires screws expressed in the world frame
    """
    added = np.zeros((4, 4))
    added[:3, 3] = M[:3, 3]
    by_the_hand = screws @ adjoint(se3.inverse(M)).T
    return {
        "M-first": lambda: body(screws, M, q),
        "M-only-added": lambda: space(screws, np.eye(4), q) + added,
        "space-screws-in-body-form": lambda: space(by_the_hand, M, q),
    }


@row.wrong
def screws_moved_along(screws, M, q):
    """your code transforms each screw by the motions of the joints before it. The
    product already includes these motions, so use the screws at q = 0 unchanged"""
    T = np.eye(4)
    for S, theta in zip(screws, q, strict=True):
        T = T @ motion(adjoint(T) @ S, theta)
    return T @ M


@row.wrong
def screws_only_rotated(screws, M, q):
    """your code moves the screws of the later joints, but it only rotates omega and v.
    A screw that moves with the pose (R, p) also has the term p x (R omega) in v, so
    multiply it by the adjoint of the pose"""
    T = np.eye(4)
    for S, theta in zip(screws, q, strict=True):
        turned = np.concatenate([T[:3, :3] @ S[:3], T[:3, :3] @ S[3:]])
        T = motion(turned, theta) @ T
    return T @ M


# One slip: what `places` names.

for slug, slip in (
    ("joint-angle-off", lambda q: np.clip(q, -2.8973, 2.8973)),  # joint1's limits
    ("joint-fed-another", lambda q: q[[0, 1, 4, 3, 4, 5, 6]]),  # a line at q = 0
    ("turns-backwards", lambda q: q * [1, 1, 1, -1, 1, 1, 1]),
    ("joint-skipped", lambda q: q * [1, 1, 1, 0, 1, 1, 1]),
):
    row.wrong(slug)(lambda screws, M, q, slip=slip: space(screws, M, slip(q)))


@row.wrong("pose-off")  # joint2 and joint3 in the wrong order.
def _(screws, M, q):
    order = [0, 2, 1, 3, 4, 5, 6]
    return space(screws[order], M, q[order])


row.spans(  # as small, or as large, as in the lab
    q=(lambda q: 100 * q,),
)
